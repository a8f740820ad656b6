//! Rays that start on a surface, of every kind and size.

use glam::{DMat3, DVec3};

use super::draw::{along, empty, foot_and_normal, side};
use super::{Made, Pcg, mixed, triangle};
use crate::scene::{Cone, Cuboid, Cylinder, Description, Disc, Plane, Quad, Sides, Torus};

/// Draws a point of a surface, and the outward unit normal there.
type Draw = dyn Fn(&mut Pcg) -> (DVec3, DVec3);

/// A primitive, and how to draw points of its surface in `f64`, from its `f32`s as they are.
struct Shape {
    description: Description,
    point: Box<Draw>,
}

/// Half the rays leave to where the normal points, half to the other side. They start at the `f32`s nearest to a point
/// of the surface: off it by at most √3 ε of their largest coordinate.
fn leave(shape: &Shape, rays: usize, rng: &mut Pcg) -> Made {
    let aim = |i| {
        let (point, normal) = (shape.point)(rng);
        let direction = rng.direction();
        along(point.as_vec3(), direction * (direction.dot(normal).signum() * side(i)))
    };
    let rays = (0..rays).map(aim).collect();
    (shape.description.clone(), rays)
}

/// A plane of any direction, through a point up to 2 sizes from the world's origin.
pub fn plane(dial: f64, rays: usize, rng: &mut Pcg) -> Made {
    let plane = Plane { normal: rng.unit(), distance: (rng.between(-2.0, 2.0) * dial) as f32, material: 0 };
    let (foot, n) = foot_and_normal(&plane);
    let point = Box::new(move |rng: &mut Pcg| (foot + rng.across(n) * (rng.between(0.0, 2.0) * dial), n));
    leave(&Shape { description: Description { planes: vec![plane], ..empty() }, point }, rays, rng)
}

/// A sphere of that radius.
pub fn sphere(dial: f64, rays: usize, rng: &mut Pcg) -> Made {
    let (center, radius) = (mixed::place(dial, rng), dial as f32);
    let c = center.as_dvec3();
    let point = Box::new(move |rng: &mut Pcg| {
        let n = rng.direction();
        (c + n * f64::from(radius), n)
    });
    leave(&Shape { description: super::sphere::alone(center, radius), point }, rays, rng)
}

/// Two vectors about `dial` long, the angle between which is not small.
fn edges(dial: f64, rng: &mut Pcg) -> [DVec3; 2] {
    let u = rng.direction();
    [u, (rng.across(u) + u * rng.between(-0.5, 0.5)) * rng.between(0.5, 1.5)].map(|e| e * dial)
}

/// A triangle with edges about that long.
pub fn triangle(dial: f64, rays: usize, rng: &mut Pcg) -> Made {
    let a = mixed::place(dial, rng);
    let [b, c] = edges(dial, rng).map(|e| (a.as_dvec3() + e).as_vec3());
    let description = triangle::alone(vec![a, b, c], vec![[0, 1, 2]]);
    let [a, b, c] = [a, b, c].map(|v| v.as_dvec3());
    let n = (b - a).cross(c - a).normalize();
    let point = Box::new(move |rng: &mut Pcg| (a.lerp(b.lerp(c, rng.between(0.05, 0.95)), rng.between(0.1, 0.95)), n));
    leave(&Shape { description, point }, rays, rng)
}

/// A parallelogram with edges about that long.
pub fn quad(dial: f64, rays: usize, rng: &mut Pcg) -> Made {
    let corner = mixed::place(dial, rng);
    let [u, v] = edges(dial, rng).map(|e| e.as_vec3());
    let description = Description { quads: vec![Quad { corner, u, v, material: 0 }], ..empty() };
    let [corner, u, v] = [corner, u, v].map(|v| v.as_dvec3());
    let n = u.cross(v).normalize();
    let point = Box::new(move |rng: &mut Pcg| (corner + u * rng.between(0.05, 0.95) + v * rng.between(0.05, 0.95), n));
    leave(&Shape { description, point }, rays, rng)
}

/// A turned box, half its edges about that long.
pub fn cuboid(dial: f64, rays: usize, rng: &mut Pcg) -> Made {
    let low = mixed::place(dial, rng);
    let size = DVec3::ONE + rng.cube().as_dvec3() * 0.5;
    let high = (low.as_dvec3() + size * (2.0 * dial)).as_vec3();
    let rotation = rng.cube() * 180.0;
    let cuboid = Cuboid { min: low, max: high, rotation, material: 0 };
    let [x, y, z] = rotation.as_dvec3().to_array().map(f64::to_radians);
    let turn = DMat3::from_rotation_z(z) * DMat3::from_rotation_y(y) * DMat3::from_rotation_x(x);
    let [low, high] = [low, high].map(|v| v.as_dvec3());
    let (center, half) = ((low + high) * 0.5, (high - low) * 0.5);
    let point = Box::new(move |rng: &mut Pcg| {
        let (k, out) = (rng.below(3), rng.sign());
        let mut q = DVec3::from_array(std::array::from_fn(|_| rng.between(-0.95, 0.95)));
        q[k] = out;
        (center + turn * (q * half), turn.col(k) * out)
    });
    leave(&Shape { description: Description { cuboids: vec![cuboid], ..empty() }, point }, rays, rng)
}

/// A closed cylinder of that radius, three times as long.
pub fn cylinder(dial: f64, rays: usize, rng: &mut Pcg) -> Made {
    let (base, radius) = (mixed::place(dial, rng), dial as f32);
    let apex = (base.as_dvec3() + rng.direction() * (3.0 * dial)).as_vec3();
    let (sides, caps, material) = (Sides::Both, true, 0);
    let cylinder = Cylinder { base, apex, radius, caps, sides, material };
    let point = revolved([base, apex].map(|v| v.as_dvec3()), [radius; 2].map(f64::from));
    leave(&Shape { description: Description { cylinders: vec![cylinder], ..empty() }, point }, rays, rng)
}

/// A closed frustum of that radius, three times as long, its other end 0.4 as wide.
pub fn cone(dial: f64, rays: usize, rng: &mut Pcg) -> Made {
    let (base, base_radius, apex_radius) = (mixed::place(dial, rng), dial as f32, (0.4 * dial) as f32);
    let apex = (base.as_dvec3() + rng.direction() * (3.0 * dial)).as_vec3();
    let (sides, caps, material) = (Sides::Both, true, 0);
    let cone = Cone { base, base_radius, apex, apex_radius, caps, sides, material };
    let point = revolved([base, apex].map(|v| v.as_dvec3()), [base_radius, apex_radius].map(f64::from));
    leave(&Shape { description: Description { cones: vec![cone], ..empty() }, point }, rays, rng)
}

/// Points of a frustum: a third each on its side and both its ends.
fn revolved(ends: [DVec3; 2], radii: [f64; 2]) -> Box<Draw> {
    let [base, apex] = ends;
    let length = base.distance(apex);
    let axis = (apex - base) / length;
    Box::new(move |rng| {
        let out = rng.across(axis);
        let part = rng.between(0.05, 0.95);
        match rng.below(3) {
            0 => (base + out * (radii[0] * part), -axis),
            1 => (apex + out * (radii[1] * part), axis),
            _ => {
                let radius = radii[0] + (radii[1] - radii[0]) * part;
                let normal = (out * length + axis * (radii[0] - radii[1])).normalize();
                (base.lerp(apex, part) + out * radius, normal)
            }
        }
    })
}

/// A torus of that greater radius; the tube's is 0.4 of it.
pub fn torus(dial: f64, rays: usize, rng: &mut Pcg) -> Made {
    let (major_radius, minor_radius) = (dial as f32, (0.4 * dial) as f32);
    let torus = Torus { center: mixed::place(dial, rng), axis: rng.unit(), major_radius, minor_radius, material: 0 };
    let (c, axis) = (torus.center.as_dvec3(), torus.axis.as_dvec3().normalize());
    let point = Box::new(move |rng: &mut Pcg| {
        let out = rng.across(axis);
        let (sin, cos) = rng.between(0.0, std::f64::consts::TAU).sin_cos();
        let n = out * cos + axis * sin;
        (c + out * f64::from(major_radius) + n * f64::from(minor_radius), n)
    });
    leave(&Shape { description: Description { tori: vec![torus], ..empty() }, point }, rays, rng)
}

/// A disc of that radius, with a hole of 0.3 of it.
pub fn disc(dial: f64, rays: usize, rng: &mut Pcg) -> Made {
    let (radius, inner_radius) = (dial as f32, (0.3 * dial) as f32);
    let disc = Disc { center: mixed::place(dial, rng), normal: rng.unit() * 3.0, radius, inner_radius, material: 0 };
    let (c, n) = (disc.center.as_dvec3(), disc.normal.as_dvec3().normalize());
    let point = Box::new(move |rng: &mut Pcg| (c + rng.across(n) * (rng.between(0.35, 0.95) * dial), n));
    leave(&Shape { description: Description { discs: vec![disc], ..empty() }, point }, rays, rng)
}
