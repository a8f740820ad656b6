//! Spheres: far, near, touched, from inside.

use glam::{DVec3, Vec3};

use super::draw::{along, closest, empty, log_between, off, passes_by, side, towards, until};
use super::{Made, Pcg};
use crate::scene::{Description, Sides, Sphere};

/// A sphere alone.
pub fn alone(center: Vec3, radius: f32) -> Description {
    Description { spheres: vec![Sphere { center, radius, sides: Sides::Both, material: 0 }], ..empty() }
}

/// A sphere of radius 1 `dial` away; the rays pass its centre by up to 1.1.
pub fn far(dial: f64, rays: usize, rng: &mut Pcg) -> Made {
    let center = rng.cube();
    let c = center.as_dvec3();
    let aim = |_| {
        let draw = || {
            let back = rng.direction();
            let origin = (c + back * (1.0 + dial)).as_vec3();
            let by = rng.across(back) * (1.1 * rng.between(0.0, 1.0).sqrt());
            towards(origin, c + by)
        };
        until(draw, |ray| passes_by(ray, c) <= 1.1)
    };
    let rays = (0..rays).map(aim).collect();
    (alone(center, 1.0), rays)
}

/// A planet of radius `dial` below an eye at height 1, near the world's origin. Three of four rays go below the horizon,
/// from 10⁻⁶ of the way down on; the others go as much above it.
pub fn close(dial: f64, rays: usize, rng: &mut Pcg) -> Made {
    let center = (rng.direction() * (dial + 1.0)).as_vec3();
    let up = -center.as_dvec3().normalize();
    let radius = (center.as_dvec3().length() - 1.0) as f32;
    let eye = (center.as_dvec3() + up * (f64::from(radius) + 1.0)).as_vec3();
    // Exactly, for the eye as it is.
    let up = (eye.as_dvec3() - center.as_dvec3()).normalize();
    let sine = f64::from(radius) / (eye.as_dvec3() - center.as_dvec3()).length();
    let horizon = (1.0 - sine * sine).max(0.0).sqrt().atan2(sine);
    let aim = |i| {
        let below = if i % 4 == 3 { -1.0 } else { 1.0 };
        let part = log_between(rng, 1e-6, 1.0) * (std::f64::consts::FRAC_PI_2 - horizon);
        let (sin, cos) = (horizon + below * part).sin_cos();
        along(eye, rng.across(up) * cos - up * sin)
    };
    let rays = (0..rays).map(aim).collect();
    (alone(center, radius), rays)
}

/// Rays from 3 to 10 radii away that pass the silhouette by `dial` radii, inside and outside in turn.
pub fn tangent(dial: f64, rays: usize, rng: &mut Pcg) -> Made {
    let center = rng.cube();
    let c = center.as_dvec3();
    let aim = |i| {
        let draw = || {
            let origin = (c + rng.direction() * rng.between(3.0, 10.0)).as_vec3();
            let to = c - origin.as_dvec3();
            let sin = (1.0 - side(i) * dial) / to.length();
            let to = to.normalize();
            along(origin, to * (1.0 - sin * sin).sqrt() + rng.across(to) * sin)
        };
        closest(draw, |ray| off((1.0 - passes_by(ray, c)) * side(i), dial))
    };
    let rays = (0..rays).map(aim).collect();
    (alone(center, 1.0), rays)
}

/// Rays in all directions from `dial` radii below the surface.
pub fn inside(dial: f64, rays: usize, rng: &mut Pcg) -> Made {
    let center = rng.cube();
    let c = center.as_dvec3();
    let depth = |origin: &Vec3| 1.0 - DVec3::distance(origin.as_dvec3(), c);
    let aim = |_| {
        let origin = closest(|| (c + rng.direction() * (1.0 - dial)).as_vec3(), |o| off(depth(o), dial));
        along(origin, rng.direction())
    };
    let rays = (0..rays).map(aim).collect();
    (alone(center, 1.0), rays)
}
