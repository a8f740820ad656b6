//! The textbook's formulae for boxes, cylinders and planes, each where it fails; ours hold there, by the exact truth.
//! Those for spheres, triangles, tori and refraction are tested where ours are.

use glam::{DVec3, Vec3, vec3};
use raypacket::geometry::{Cuboids, Cylinders, Planes, Primitives};
use raypacket::measure::oracle::{self, Shape, Truth};
use raypacket::scene::{self, Sides};

use crate::common::{Pcg, ROUNDOFF};

const RAYS: usize = 1000;

/// Our answer for the only primitive of a kind.
fn ours<K: Primitives>(kind: &K, origin: Vec3, direction: Vec3) -> Option<f32> {
    kind.test::<f32>(0, origin.into(), direction.into(), 0.0, f32::INFINITY).map(|(t, _)| t)
}

fn truth(shape: &Shape, origin: Vec3, direction: Vec3) -> Option<Truth> {
    oracle::nearest(shape, &oracle::Ray::new(origin, direction), 0.0, f64::INFINITY)
}

/// By the quotients as they come (Kay and Kajiya 1986), which the lesser of decides what is near: Williams, Barrus, Morley
/// and Shirley, *An Efficient and Robust Ray-Box Intersection Algorithm* (2005), is about how that fails for −0.
fn slabs(min: Vec3, max: Vec3, origin: Vec3, direction: Vec3) -> Option<f32> {
    let (mut enter, mut exit) = (f32::NEG_INFINITY, f32::INFINITY);
    for axis in 0..3 {
        let [a, b] = [min, max].map(|corner| (corner[axis] - origin[axis]) / direction[axis]);
        let (near, far) = if a > b { (b, a) } else { (a, b) };
        enter = if near > enter { near } else { enter };
        exit = if far < exit { far } else { exit };
    }
    let t = if enter > 0.0 { enter } else { exit };
    (enter <= exit && t > 0.0).then_some(t)
}

/// Rays that run in the plane of a face: one of the quotients is 0 / 0, and −0 turns the order of the other pair.
#[test]
fn in_a_faces_plane_slabs_fail() {
    let (min, max) = (vec3(-1.0, -2.0, -3.0), vec3(2.0, 1.0, 4.0));
    let shape = Shape::Cuboid(scene::Cuboid { min, max, rotation: Vec3::ZERO, material: 0 });
    let mut cuboids = Cuboids::default();
    cuboids.push(min, max, Vec3::ZERO, 0);
    let mut rng = Pcg::new(1);
    let mut wrong = 0;
    for i in 0..RAYS {
        let (axis, zero) = (i % 3, if i % 2 == 0 { 0.0 } else { -0.0 });
        let face = if i % 4 < 2 { min } else { max };
        let mut origin = rng.unit() * 9.0;
        let to = min + (max - min) * (rng.cube() * 0.4 + 0.5);
        origin[axis] = face[axis];
        let mut direction = to - origin;
        direction[axis] = 0.0;
        direction = direction.normalize();
        direction[axis] = zero;
        let exact = truth(&shape, origin, direction).map(|truth| truth.t);
        let found = ours(&cuboids, origin, direction).map(f64::from);
        let near = |t: f64| exact.is_some_and(|exact| (t - exact).abs() <= 3.0 * ROUNDOFF * exact);
        assert!(found.is_some_and(near), "ours, from {origin} along {direction}: {found:?} for {exact:?}");
        wrong += usize::from(!slabs(min, max, origin, direction).is_some_and(|t| near(t.into())));
    }
    assert!(wrong > RAYS / 3, "{wrong}");
}

/// From inside, |q − A (q·A)|² = r² multiplied out along the ray:
/// (1 − (d·A)²) t² + 2 (f·d − (f·A) (d·A)) t + |f|² − (f·A)² − r² = 0.
fn quadratic(it: &scene::Cylinder, origin: Vec3, direction: Vec3) -> f32 {
    let (f, axis) = (origin - it.base, (it.apex - it.base).normalize());
    let (along, height) = (direction.dot(axis), f.dot(axis));
    let a = 1.0 - along * along;
    let b = f.dot(direction) - height * along;
    let c = f.length_squared() - height * height - it.radius * it.radius;
    ((b * b - a * c).sqrt() - b) / a
}

/// Down a long pipe, nearly along its axis: 1 − (d·A)² is a matter of rounding.
#[test]
fn along_the_axis_a_cylinders_quadratic_fails() {
    let mut rng = Pcg::new(2);
    let mut wrong = 0;
    for _ in 0..RAYS {
        let (base, axis) = (rng.cube() * 10.0, rng.unit().as_dvec3());
        let apex = base + (axis * 3000.0).as_vec3();
        let it = scene::Cylinder { base, apex, radius: 1.0, caps: false, sides: Sides::Both, material: 0 };
        let mut cylinders = Cylinders::default();
        cylinders.push(base, apex, 1.0, false, Sides::Both, 0);
        let across = |rng: &mut Pcg| axis.cross(rng.unit().as_dvec3()).normalize();
        let offset: DVec3 = axis * 50.0 + across(&mut rng) * rng.between(0.0, 0.9);
        let origin = base + offset.as_vec3();
        let direction = (axis + across(&mut rng) * rng.between(1e-3, 2e-3)).normalize().as_vec3();
        let exact = truth(&Shape::Cylinder(it), origin, direction).expect("from inside");
        let cosine = exact.normal.dot(direction.as_dvec3()).abs();
        let off = |t: f32| (f64::from(t) - exact.t).abs() * cosine;
        let found = ours(&cylinders, origin, direction).expect("from inside");
        // The module's bound.
        let bound = ROUNDOFF * (8.0 * (f64::from((origin - base).length()) + 3001.0) + 6.0 * exact.t);
        assert!(off(found) <= bound, "ours, from {origin} along {direction}: {found} for {exact:?}");
        assert!(bound < 0.005, "{bound}");
        wrong += usize::from(!matches!(off(quadratic(&it, origin, direction)), off if off <= 0.05));
    }
    assert!(wrong > RAYS / 20, "{wrong}");
}

/// With a unit normal, and an epsilon for rays that count as parallel.
fn plane(normal: Vec3, distance: f32, origin: Vec3, direction: Vec3) -> Option<f32> {
    let (length, n) = (normal.length(), normal.normalize());
    let slope = n.dot(direction);
    let t = -(n.dot(origin) + distance / length) / slope;
    (slope.abs() > 1e-6 && t > 0.0).then_some(t)
}

/// Towards the horizon of a floor or a slope: the epsilon cuts it off at 10⁶ times the eye's height. Ours hits there, and
/// the point is off the plane by what the module says.
#[test]
fn at_a_planes_horizon_the_epsilon_fails() {
    let mut rng = Pcg::new(3);
    let mut wrong = 0;
    for normal in [Vec3::Y, vec3(1.0, 3.0, 2.0)] {
        let it = scene::Plane { normal, distance: 0.25, material: 0 };
        let mut planes = Planes::default();
        planes.push(normal, 0.25, 0);
        let n = normal.as_dvec3();
        for _ in 0..RAYS {
            let origin = (n.normalize() * rng.between(0.5, 2.0) + n.cross(rng.unit().as_dvec3())).as_vec3();
            let level = n.cross(rng.unit().as_dvec3()).normalize();
            let slope = 10f64.powf(rng.between(-9.0, -3.0));
            let direction = (level - n.normalize() * slope).normalize().as_vec3();
            let Some(exact) = truth(&Shape::Plane(it), origin, direction) else { continue };
            let sine = direction.as_dvec3().dot(n).abs() / n.length();
            // So flat on a slope that the rounding of n·d is as large as it.
            if normal != Vec3::Y && sine < 16.0 * ROUNDOFF {
                continue;
            }
            let found = ours(&planes, origin, direction);
            let height = (n.dot(origin.as_dvec3()).abs() + 0.25) / n.length();
            let near = |t: f32| {
                let bound = 4.0 * ROUNDOFF * height + 3.0 * ROUNDOFF * f64::from(t);
                (f64::from(t) - exact.t).abs() * sine <= bound
            };
            assert!(found.is_some_and(near), "ours, from {origin} along {direction}: {found:?} for {exact:?}");
            wrong += usize::from(plane(normal, 0.25, origin, direction).is_none());
        }
    }
    assert!(wrong > RAYS / 3, "{wrong}");
}
