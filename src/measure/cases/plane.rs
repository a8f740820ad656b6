//! Planes, seen flat.

use super::draw::{along, closest, empty, foot_and_normal, log_between, off, side};
use super::{Made, Pcg};
use crate::scene::{Description, Plane};

/// Rays at `dial` degrees to a plane, from 0.01 to 100 off it; towards it and away from it in turn.
pub fn grazing(dial: f64, rays: usize, rng: &mut Pcg) -> Made {
    let plane = Plane { normal: rng.unit(), distance: rng.range(-1.0, 1.0), material: 0 };
    let (foot, n) = foot_and_normal(&plane);
    let (sin, cos) = dial.to_radians().sin_cos();
    let aim = |i| {
        let up = n * rng.sign();
        let draw = || {
            let beside = rng.across(n) * rng.between(0.0, 1.0);
            let origin = (foot + beside + up * log_between(rng, 0.01, 100.0)).as_vec3();
            along(origin, rng.across(n) * cos - up * (sin * side(i)))
        };
        closest(draw, |ray| off(-ray.line().1.dot(up) * side(i), sin))
    };
    let rays = (0..rays).map(aim).collect();
    (Description { planes: vec![plane], ..empty() }, rays)
}
