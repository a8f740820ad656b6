//! Boxes, along their faces.

use glam::{Vec2, Vec3};

use super::draw::empty;
use super::{Made, Pcg, Ray};
use crate::scene::{Cuboid, Description};

/// `x`, as many steps of `f32` away from zero; towards it when below zero.
fn steps(x: f32, count: i32) -> f32 {
    f32::from_bits(x.to_bits().wrapping_add_signed(count))
}

/// Rays along a face: in turn exactly in its plane, `dial` steps of `f32` outside and as many inside. Their direction
/// is 0 or −0 across the face, in half of them along a second axis as well.
pub fn in_face(dial: f64, rays: usize, rng: &mut Pcg) -> Made {
    let corner = |rng: &mut Pcg| Vec3::new(rng.range(0.5, 1.0), rng.range(0.5, 1.0), rng.range(0.5, 1.0));
    let cuboid = Cuboid { min: -corner(rng), max: corner(rng), rotation: Vec3::ZERO, material: 0 };
    let zero = |rng: &mut Pcg| 0.0 * rng.sign() as f32;
    let aim = |i: usize| {
        let k = rng.below(3);
        let (u, v) = ((k + 1) % 3, (k + 2) % 3);
        let face = rng.pick(&[cuboid.min, cuboid.max])[k];
        // Both faces lie away from zero, so that outside is where the magnitude is greater.
        let offset = [0, 1, -1][i % 3] * dial.round() as i32;
        let (sin, cos) = rng.between(0.0, std::f64::consts::TAU).sin_cos();
        let level = match rng.below(4) {
            0 => Vec2::new(rng.sign() as f32, zero(rng)),
            1 => Vec2::new(zero(rng), rng.sign() as f32),
            _ => Vec2::new(cos as f32, sin as f32),
        };
        let back = rng.range(0.0, 5.0);
        let mut start =
            |a: usize, d: f32| cuboid.min[a] + (cuboid.max - cuboid.min)[a] * rng.range(0.0, 1.0) - d * back;
        let (mut origin, mut direction) = (Vec3::ZERO, Vec3::ZERO);
        (origin[k], origin[u], origin[v]) = (steps(face, offset), start(u, level.x), start(v, level.y));
        (direction[k], direction[u], direction[v]) = (zero(rng), level.x, level.y);
        Ray { origin, direction, t_min: 0.0, t_max: f32::INFINITY }
    };
    let rays = (0..rays).map(aim).collect();
    (Description { cuboids: vec![cuboid], ..empty() }, rays)
}
