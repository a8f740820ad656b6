//! Triangles: at the edges and corners they share, and thin.

use glam::{DVec3, Vec3};

use super::draw::{closest, empty, off, passes_by, side, towards, until};
use super::{Made, Pcg, Ray};
use crate::scene::{Description, Mesh};

/// A mesh alone.
pub fn alone(positions: Vec<Vec3>, triangles: Vec<[u32; 3]>) -> Description {
    Description { meshes: vec![Mesh { positions, triangles, ..Mesh::default() }], ..empty() }
}

/// Along x, y and z: a random right-handed frame.
fn frame(rng: &mut Pcg) -> [DVec3; 3] {
    let x = rng.direction();
    let y = rng.across(x);
    [x, y, x.cross(y)]
}

/// From 1 to 3 above `at`, up to half as far aside.
fn eye(at: DVec3, [x, y, z]: [DVec3; 3], rng: &mut Pcg) -> Vec3 {
    let aside = x * rng.between(-0.35, 0.35) + y * rng.between(-0.35, 0.35);
    (at + (z + aside) * rng.between(1.0, 3.0)).as_vec3()
}

/// How far a ray's line passes the line from `a` to `b` by; above zero where (b − a) × direction points.
pub fn beside(ray: &Ray, a: DVec3, b: DVec3) -> f64 {
    let (o, d) = ray.line();
    (o - a).dot((b - a).cross(d).normalize())
}

/// A ridge of two triangles; rays pass the edge that they share by `dial` of its length, on either side in turn. All
/// hit: no other edge is near.
pub fn edge(dial: f64, rays: usize, rng: &mut Pcg) -> Made {
    let axes @ [x, y, z] = frame(rng);
    let a = rng.cube();
    let b = (a.as_dvec3() + x).as_vec3();
    let [slope, other] = [rng.between(0.0, 0.5), rng.between(0.0, 0.5)];
    let c = (a.as_dvec3() + x * 0.5 + y - z * slope).as_vec3();
    let d = (a.as_dvec3() + x * 0.5 - y - z * other).as_vec3();
    let description = alone(vec![a, b, c, d], vec![[0, 1, 2], [1, 0, 3]]);
    let [a, b] = [a, b].map(|v| v.as_dvec3());
    let length = a.distance(b);
    let aim = |i| {
        let draw = || {
            let on = a.lerp(b, rng.between(0.2, 0.8));
            let origin = eye(on, axes, rng);
            let across = (b - a).cross(on - origin.as_dvec3()).normalize();
            towards(origin, on + across * (side(i) * dial * length))
        };
        closest(draw, |ray| off(beside(ray, a, b) * side(i) / length, dial))
    };
    let rays = (0..rays).map(aim).collect();
    (description, rays)
}

/// Triangles of a fan.
const FAN: u32 = 7;

/// A fan about a vertex, its spokes about 1 long; rays pass the vertex by `dial`. All hit.
pub fn vertex(dial: f64, rays: usize, rng: &mut Pcg) -> Made {
    let axes @ [x, y, z] = frame(rng);
    let tip = rng.cube();
    let mut positions = vec![tip];
    for k in 0..FAN {
        let (sin, cos) = (std::f64::consts::TAU * f64::from(k) / f64::from(FAN)).sin_cos();
        positions.push((tip.as_dvec3() + x * cos + y * sin - z * rng.between(0.0, 0.3)).as_vec3());
    }
    let triangles = (0..FAN).map(|k| [0, 1 + k, 1 + (k + 1) % FAN]).collect();
    let at = tip.as_dvec3();
    let aim = |_| {
        let draw = || {
            let origin = eye(at, axes, rng);
            let back = (origin.as_dvec3() - at).normalize();
            towards(origin, at + rng.across(back) * dial)
        };
        closest(draw, |ray| off(passes_by(ray, at), dial))
    };
    let rays = (0..rays).map(aim).collect();
    (alone(positions, triangles), rays)
}

/// Whether a ray's line passes through a triangle.
pub fn through(ray: &Ray, corners: [DVec3; 3]) -> bool {
    let (o, d) = ray.line();
    let [a, b, c] = corners.map(|v| v - o);
    let volumes = [a.cross(b).dot(d), b.cross(c).dot(d), c.cross(a).dot(d)];
    volumes.iter().all(|&v| v > 0.0) || volumes.iter().all(|&v| v < 0.0)
}

/// The height over the first edge, in lengths of that edge.
pub fn thickness([a, b, c]: [DVec3; 3]) -> f64 {
    (b - a).cross(c - a).length() / (b - a).length_squared()
}

/// A triangle 1 long and `dial` high, as its rounded corners are; rays through it and past its base, by less than its
/// height, in turn.
pub fn sliver(dial: f64, rays: usize, rng: &mut Pcg) -> Made {
    let [a, b, c] = closest(
        || {
            let [x, y, _] = frame(rng);
            let a = rng.cube().as_dvec3();
            [a, a + x, a + x * rng.between(0.3, 0.7) + y * dial].map(|v| v.as_vec3())
        },
        |corners| off(thickness(corners.map(|v| v.as_dvec3())), dial),
    );
    let description = alone(vec![a, b, c], vec![[0, 1, 2]]);
    let corners = [a, b, c].map(|v| v.as_dvec3());
    let [a, b, c] = corners;
    let z = (b - a).cross(c - a).normalize();
    let x = (b - a).normalize();
    let axes = [x, z.cross(x), z];
    let height = thickness(corners) * a.distance(b);
    let aim = |i| {
        let hit = side(i) > 0.0;
        let draw = || {
            let [u, v] = [rng.between(0.0, 1.0), rng.between(0.1, 0.9)];
            let on_base = a.lerp(b, v);
            let target = if hit { c.lerp(on_base, u.sqrt()) } else { on_base - axes[1] * (height * u) };
            towards(eye(target, axes, rng), target)
        };
        until(draw, |ray| through(ray, corners) == hit)
    };
    let rays = (0..rays).map(aim).collect();
    (description, rays)
}
