//! Lights next to what they light.

use glam::{DVec3, Vec3, vec3};

use super::draw::{closest, empty, log_between, off};
use super::{Made, Pcg, Ray, sphere};
use crate::scene::{Description, Light, Plane};

/// From a light to a point of a surface: it ends at the rounded distance, where the surface is, to within rounding.
/// Nothing lies before.
fn shadow(light: Vec3, point: DVec3) -> Ray {
    let to = point - light.as_dvec3();
    let length = to.length();
    Ray { origin: light, direction: (to / length).as_vec3(), t_min: 0.0, t_max: length as f32 }
}

fn light(position: Vec3) -> Vec<Light> {
    vec![Light { position, power: Vec3::splat(100.0) }]
}

/// A light exactly `dial`, as `f32`, above the plane y = 0, and shadow rays to points of it, from as near as it to 10
/// away from below it.
pub fn plane(dial: f64, rays: usize, rng: &mut Pcg) -> Made {
    let plane = Plane { normal: Vec3::Y, distance: 0.0, material: 0 };
    let position = vec3(rng.range(-1.0, 1.0), dial as f32, rng.range(-1.0, 1.0));
    let foot = position.as_dvec3().with_y(0.0);
    let aim = |_| shadow(position, foot + rng.across(DVec3::Y) * log_between(rng, dial, 10.0));
    let rays = (0..rays).map(aim).collect();
    (Description { planes: vec![plane], lights: light(position), ..empty() }, rays)
}

/// A light `dial` off a sphere of radius 1, and shadow rays to points of it that face the light.
pub fn sphere(dial: f64, rays: usize, rng: &mut Pcg) -> Made {
    let center = rng.cube();
    let c = center.as_dvec3();
    let height = |p: &Vec3| p.as_dvec3().distance(c) - 1.0;
    let position = closest(|| (c + rng.direction() * (1.0 + dial)).as_vec3(), |p| off(height(p), dial));
    let up = (position.as_dvec3() - c).normalize();
    let horizon = (1.0 / (1.0 + height(&position).max(0.0))).acos();
    let aim = |_| {
        let (sin, cos) = (horizon * rng.between(0.0, 0.99)).sin_cos();
        shadow(position, c + up * cos + rng.across(up) * sin)
    };
    let rays = (0..rays).map(aim).collect();
    (Description { lights: light(position), ..sphere::alone(center, 1.0) }, rays)
}
