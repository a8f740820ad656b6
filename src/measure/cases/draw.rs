//! Helpers that the makers of cases share: rays by rounding, and drawing again until the rounded numbers are as wanted.

use glam::{DVec3, Vec3};

use super::{Pcg, Ray};
use crate::scene::{Description, Material, Plane};

/// How far off, as a fraction, what is drawn may be.
const CLOSE: f64 = 0.25;

/// How often it is drawn at the most: within [`CLOSE`] of 10⁻⁹ of an edge falls one in some 500 rays.
const TRIES: usize = 2000;

/// Draws until `error` is at most [`CLOSE`]; the best of [`TRIES`] when it never is.
pub fn closest<T>(mut draw: impl FnMut() -> T, error: impl Fn(&T) -> f64) -> T {
    let mut best = draw();
    let mut least = error(&best);
    for _ in 1..TRIES {
        if least <= CLOSE {
            break;
        }
        let next = draw();
        let off = error(&next);
        // A NaN gives way to anything.
        if off < least || least.is_nan() {
            (best, least) = (next, off);
        }
    }
    best
}

/// Draws until it is `right`; the last of [`TRIES`] when it never is.
pub fn until<T>(draw: impl FnMut() -> T, right: impl Fn(&T) -> bool) -> T {
    closest(draw, |x| if right(x) { 0.0 } else { 1.0 })
}

/// How far `found` is from `wanted`, as a fraction of it.
pub fn off(found: f64, wanted: f64) -> f64 {
    (found / wanted - 1.0).abs()
}

/// From `low` to `high`, evenly in the logarithm.
pub fn log_between(rng: &mut Pcg, low: f64, high: f64) -> f64 {
    low * (high / low).powf(rng.between(0.0, 1.0))
}

/// A ray along `direction`, of any length but zero, without an end.
pub fn along(origin: Vec3, direction: DVec3) -> Ray {
    Ray { origin, direction: direction.normalize().as_vec3(), t_min: 0.0, t_max: f32::INFINITY }
}

/// A ray to `target`.
pub fn towards(origin: Vec3, target: DVec3) -> Ray {
    along(origin, target - origin.as_dvec3())
}

/// 1 for even rays, −1 for odd ones.
pub fn side(i: usize) -> f64 {
    if i.is_multiple_of(2) { 1.0 } else { -1.0 }
}

/// How far a ray's line passes a point by.
pub fn passes_by(ray: &Ray, point: DVec3) -> f64 {
    let (o, d) = ray.line();
    (point - o).cross(d).length()
}

/// The point of a plane that is nearest to the world's origin, and its unit normal.
pub fn foot_and_normal(plane: &Plane) -> (DVec3, DVec3) {
    let length = plane.normal.as_dvec3().length();
    let normal = plane.normal.as_dvec3() / length;
    (normal * (-f64::from(plane.distance) / length), normal)
}

/// A scene without anything but a matt material.
pub fn empty() -> Description {
    Description { materials: vec![Material::default()], ..Description::default() }
}
