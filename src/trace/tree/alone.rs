//! One ray as the primitives of a block are tested with it.

use super::walk::Walk;
use crate::geometry::triangle::Aim;
use crate::math::{Vec3, map2, map3};
use wide::f32x8;

/// One ray; in every lane, and with its axes in order, the direction's largest last, what triangles need of it: more tests
/// than one are worth preparing for.
pub struct Alone {
    /// Which.
    pub i: usize,
    /// The axes.
    pub order: [usize; 3],
    /// The origin's components.
    pub origin: [f32x8; 3],
    /// The direction's [`Aim::shear`].
    pub shear: [f32x8; 2],
}

impl Alone {
    /// Ray `i`.
    #[inline(always)]
    pub fn new(walk: &Walk, i: usize) -> Self {
        let direction = Vec3::<f32>::load(&walk.rays.direction, i);
        let major = Aim::major_of(direction);
        let order = [(major + 1) % 3, (major + 2) % 3, major];
        let Vec3 { x, y, z } = walk.rays.origins::<f32>(i);
        let origin = map3(order, |axis| f32x8::splat([x, y, z][axis]));
        let along = [direction.x, direction.y, direction.z];
        let shear = map2([order[0], order[1]], |axis| f32x8::splat(along[axis] / along[major]));
        Self { i, order, origin, shear }
    }
}
