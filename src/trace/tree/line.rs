//! A single ray against eight boxes at once; the bounds of [`super::beam`] for one ray.

use crate::bvh::{Bvh, Node};
use crate::math::{BATCH, LaneMask, Lanes, RayBatch, Vec3};
use std::ops::Range;
use wide::{f32x8, f32x16};

use super::beam::{PAD, TINY};

/// The rays as boxes are tested with them, a column a number, made for many rays at once.
#[derive(Clone, Debug)]
#[repr(align(64))]
pub struct Lines {
    /// Per axis, 1 / d.
    pub inverse: [[f32; BATCH]; 3],
    /// The number subtracted from the near face times the inverse.
    pub near: [[f32; BATCH]; 3],
    /// The number subtracted from the far face times the inverse.
    pub far: [[f32; BATCH]; 3],
}

impl Default for Lines {
    fn default() -> Self {
        let zero = [[0.0; BATCH]; 3];
        Self { inverse: zero, near: zero, far: zero }
    }
}

impl Lines {
    /// For the rays of a range.
    #[inline(always)]
    pub fn prepare(&mut self, rays: &RayBatch, bvh: &Bvh, range: Range<usize>) {
        let (min, max) = (Vec3::<f32x16>::splat(bvh.bounds.min), Vec3::splat(bvh.bounds.max));
        for at in range.step_by(16) {
            let origin = rays.origins::<f32x16>(at);
            let reach = Lanes::max((max - origin).max_abs(), (origin - min).max_abs()) + origin.max_abs();
            let pad = reach * f32x16::splat(PAD);
            let d = Vec3::<f32x16>::load(&rays.direction, at);
            for (axis, (o, d)) in [(origin.x, d.x), (origin.y, d.y), (origin.z, d.z)].into_iter().enumerate() {
                let tiny = Lanes::lt(Lanes::abs(d), f32x16::splat(TINY));
                let least = Lanes::select(f32x16::splat(-TINY), Lanes::lt(d, f32x16::ZERO), f32x16::splat(TINY));
                let inverse = f32x16::ONE / Lanes::select(least, tiny, d);
                let wider = Lanes::abs(inverse) * pad;
                let at_origin = o * inverse;
                inverse.store(&mut self.inverse[axis][at..]);
                (at_origin + wider).store(&mut self.near[axis][at..]);
                (at_origin - wider).store(&mut self.far[axis][at..]);
            }
        }
    }
}

/// A ray in every lane.
pub struct Line {
    /// Per axis, 1 / d.
    pub inverse: [f32x8; 3],
    /// The number subtracted from the near face times the inverse.
    pub near: [f32x8; 3],
    /// The number subtracted from the far face times the inverse.
    pub far: [f32x8; 3],
    /// Which end of a box is the near one.
    pub side: [usize; 3],
}

impl Line {
    /// Ray `i`, which is prepared.
    #[inline(always)]
    pub fn new(lines: &Lines, i: usize) -> Self {
        let Lines { inverse, near, far } = lines;
        let splat = |columns: &[[f32; BATCH]; 3]| {
            [f32x8::splat(columns[0][i]), f32x8::splat(columns[1][i]), f32x8::splat(columns[2][i])]
        };
        let behind = |axis: usize| usize::from(inverse[axis][i] < 0.0);
        Self { inverse: splat(inverse), near: splat(near), far: splat(far), side: [behind(0), behind(1), behind(2)] }
    }

    /// Eight boxes' entries, not below zero, and which are met no later than at `end`.
    #[inline(always)]
    pub fn meets(&self, node: &Node, end: f32x8) -> (f32x8, u32) {
        let mut enter = f32x8::ZERO;
        let mut exit = end;
        for axis in 0..3 {
            let [near, far] = node.faces(axis, self.side[axis]);
            let inverse = self.inverse[axis];
            // What is NaN (∞ − ∞) is passed over.
            enter = Lanes::max(near.mul_sub(inverse, self.near[axis]), enter);
            exit = Lanes::min(far.mul_sub(inverse, self.far[axis]), exit);
        }
        (enter, LaneMask::bits(Lanes::le(enter, exit)))
    }
}
