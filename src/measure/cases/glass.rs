//! Refraction: at the critical angle, through thin glass and through narrow gaps.

use glam::{Vec3, vec3};

use super::draw::{along, closest, empty, foot_and_normal, log_between, off, passes_by, side, towards, until};
use super::{Made, Pcg};
use crate::scene::{Cuboid, Description, Material, Plane, Sides, Sky, Sphere};

/// Of glass.
const IOR: f32 = 1.5;

/// Glass in which nothing is lost, and air in it, under a sky that tells directions apart.
fn scene() -> Description {
    let clear = |name: &str, ior| Material { name: name.into(), transmission: 1.0, ior, ..Material::default() };
    let mut scene = empty();
    scene.materials = vec![clear("glass", IOR), clear("air", 1.0)];
    scene.sky = Sky::Gradient { below: vec3(0.1, 0.2, 0.8), above: vec3(0.9, 0.5, 0.2) };
    scene.settings.max_depth = 8;
    scene
}

/// From within a half-space of glass, rays at the critical angle to the border's normal, `dial` degrees steeper and as
/// much flatter in turn; flatter ones are reflected totally.
pub fn critical(dial: f64, rays: usize, rng: &mut Pcg) -> Made {
    let plane = Plane { normal: rng.unit(), distance: rng.range(-1.0, 1.0), material: 0 };
    let (foot, n) = foot_and_normal(&plane);
    let critical = (1.0 / f64::from(IOR)).asin();
    let aim = |i| {
        let angle = critical - side(i) * dial.to_radians();
        let draw = || {
            let depth = log_between(rng, 0.1, 10.0);
            let origin = (foot + rng.across(n) - n * depth).as_vec3();
            along(origin, rng.across(n) * angle.sin() + n * angle.cos())
        };
        closest(draw, |ray| {
            let (_, d) = ray.line();
            off((critical - d.cross(n).length().atan2(d.dot(n))) * side(i), dial.to_radians())
        })
    };
    let rays = (0..rays).map(aim).collect();
    (Description { planes: vec![plane], ..scene() }, rays)
}

/// A bubble of glass of radius 1, `dial` thick, with air in it; rays through both surfaces and through the rim alone,
/// in turn.
pub fn shell(dial: f64, rays: usize, rng: &mut Pcg) -> Made {
    let center = rng.cube();
    let c = center.as_dvec3();
    let inner = (1.0 - dial) as f32;
    let ball = |radius, material| Sphere { center, radius, sides: Sides::Both, material };
    let spheres = vec![ball(1.0, 0), ball(inner, 1)];
    let aim = |i| {
        let rim = side(i) < 0.0;
        let draw = || {
            let origin = (c + rng.direction() * rng.between(2.0, 5.0)).as_vec3();
            let to = c - origin.as_dvec3();
            let radius = f64::from(inner);
            let by = if rim { rng.between(radius, 1.0) } else { radius * rng.between(0.0, 1.0).sqrt() };
            let sin = by / to.length();
            let to = to.normalize();
            along(origin, to * (1.0 - sin * sin).sqrt() + rng.across(to) * sin)
        };
        until(draw, |ray| {
            let by = passes_by(ray, c);
            by < 1.0 && (by > f64::from(inner)) == rim
        })
    };
    let rays = (0..rays).map(aim).collect();
    (Description { spheres, ..scene() }, rays)
}

/// Two blocks of glass on both sides of a gap from x = 0 to `dial`; rays from without, through one into the other.
pub fn gap(dial: f64, rays: usize, rng: &mut Pcg) -> Made {
    let block = |low: f32, high: f32| Cuboid {
        min: vec3(low, -2.0, -2.0),
        max: vec3(high, 2.0, 2.0),
        rotation: Vec3::ZERO,
        material: 0,
    };
    let cuboids = vec![block(-1.0, 0.0), block(dial as f32, dial as f32 + 1.0)];
    let aim = |_| {
        let origin = vec3(rng.range(-5.0, -2.0), rng.range(-1.0, 1.0), rng.range(-1.0, 1.0));
        let face = vec3(-1.0, rng.range(-1.0, 1.0), rng.range(-1.0, 1.0));
        towards(origin, face.as_dvec3())
    };
    let rays = (0..rays).map(aim).collect();
    (Description { cuboids, ..scene() }, rays)
}
