//! What holds for all rays of a group, against eight boxes at once.
//!
//! A ray is between two faces across an axis from (low − o) / d to (high − o) / d. Of rays that start from `o` between
//! `min` and `max` and run along `d` likewise, none enters before u = (low − max) / d.max and none leaves after
//! v = (high − min) / d.min when all d are above zero; the other way round when all are below; and from max(u, v) on
//! without an end when there are both (after Boulos, Wald, Benthin, *Geometric and Arithmetic Culling Methods for
//! Entire Ray Packets*, 2006). A box is met when the last entry is not after the first exit.
//!
//! **Nothing is lost to rounding.** The primitives' tests find a hit where a ray passes within a few ε of the primitive's
//! distance (see their files: at most 32 ε (D + |o|), with D the distance of the scene's farthest corner along any
//! axis), and the arithmetic here moves a face by at most 8 ε (D + |o|) (as Ize, *Robust BVH Ray Traversal*, JCGT 2
//! (2013), adds it to the exit; here every face is moved, as the primitives' own error goes across the ray as well). So all
//! boxes are wider by [`PAD`] (D + |o|) on all sides. A hit may also be found before the ray enters the primitive's box, by
//! at most [`SLACK`] (D + |o|) ([`crate::geometry::triangle`] sees to that), so a box is left out only when it is that
//! much farther than what was hit.

use crate::bvh::{Bvh, Node};
use crate::geometry::triangle::SLACK;
use crate::math::{LaneMask, Lanes, RayBatch, Vec3};
use std::ops::Range;
use wide::f32x8;

use super::super::bounds::{Bounds, Extent};
use super::State;

/// 64 ε.
const PAD: f32 = 1.0 / (1 << 18) as f32;
/// A direction's component below this counts as both above and below zero: its inverse times any distance is beyond
/// all others.
const TINY: f32 = 1e-18;

/// Bounds of the active rays of a group, or a single ray.
pub struct Beam {
    /// Per axis: 1 / d.max, and what `low` times that is lessened by.
    low: [(f32x8, f32x8); 3],
    /// The same of 1 / d.min and `high`.
    high: [(f32x8, f32x8); 3],
    sign: [Sign; 3],
    /// Whether any axis has rays of both directions.
    mixed: bool,
    /// SLACK (D + |o|).
    pub slack: f32,
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Sign {
    Plus,
    Minus,
    Both,
}

impl Beam {
    /// Around the rays of a range that are not done, and whether they run together; `None` when all are done.
    #[inline(always)]
    pub fn around(
        rays: &RayBatch,
        state: &State,
        range: Range<usize>,
        bvh: &Bvh,
        bounds: &Bounds,
    ) -> Option<(Self, bool)> {
        let (mut origins, mut directions) = (Extent::<f32x8>::empty(), Extent::<f32x8>::empty());
        let mut any = false;
        for at in range.step_by(8) {
            let active = Lanes::ge(f32x8::load(&state.t[at..]), f32x8::zero());
            if !LaneMask::any(active) {
                continue;
            }
            any = true;
            directions.include(Vec3::load(&rays.direction, at), active);
            if !bounds.shared {
                origins.include(Vec3::load(&rays.origin, at), active);
            }
        }
        if !any {
            return None;
        }
        let directions = directions.ends();
        let origins = if bounds.shared { [bounds.origin.middle.into(); 2] } else { origins.ends() };
        let spread = (directions[1] - directions[0]).max_element();
        let apart = (origins[1] - origins[0]).max_element();
        let size = (bvh.bounds.max - bvh.bounds.min).max_element();
        // NaN and infinity fail these.
        let coherent = spread < super::SPREAD && apart < super::APART * size;
        Some((Self::new(origins, directions, bvh), coherent))
    }

    /// From the least and greatest origins and directions.
    #[inline(always)]
    pub fn new([o_min, o_max]: [glam::Vec3; 2], [d_min, d_max]: [glam::Vec3; 2], bvh: &Bvh) -> Self {
        let reach = (bvh.bounds.max - o_min).max(o_max - bvh.bounds.min).max_element().max(0.0);
        let reach = reach + o_min.abs().max(o_max.abs()).max_element();
        let pad = PAD * reach;
        let mut beam = Self {
            low: [(f32x8::ZERO, f32x8::ZERO); 3],
            high: [(f32x8::ZERO, f32x8::ZERO); 3],
            sign: [Sign::Both; 3],
            mixed: false,
            slack: SLACK * reach,
        };
        for axis in 0..3 {
            let (least, most) = (d_min[axis], d_max[axis]);
            let (r, q) = if least >= TINY {
                beam.sign[axis] = Sign::Plus;
                (1.0 / most, 1.0 / least)
            } else if most <= -TINY {
                beam.sign[axis] = Sign::Minus;
                (1.0 / most, 1.0 / least)
            } else {
                beam.mixed = true;
                (1.0 / most.max(TINY), 1.0 / least.min(-TINY))
            };
            beam.low[axis] = (f32x8::splat(r), f32x8::splat((o_max[axis] + pad) * r));
            beam.high[axis] = (f32x8::splat(q), f32x8::splat((o_min[axis] - pad) * q));
        }
        beam
    }

    /// Eight boxes' entries, not below zero, and where they are met before `end`.
    #[inline(always)]
    pub fn meets(&self, min: &[[f32; 8]; 3], max: &[[f32; 8]; 3], end: f32x8) -> (f32x8, u32) {
        let mut enter = f32x8::ZERO;
        let mut exit = end;
        for axis in 0..3 {
            let (r, a) = self.low[axis];
            let (q, b) = self.high[axis];
            let u = f32x8::from(min[axis]).mul_sub(r, a);
            let v = f32x8::from(max[axis]).mul_sub(q, b);
            // What is NaN (∞ − ∞) is passed over.
            match self.sign[axis] {
                Sign::Plus => {
                    enter = Lanes::max(u, enter);
                    exit = Lanes::min(v, exit);
                }
                Sign::Minus => {
                    enter = Lanes::max(v, enter);
                    exit = Lanes::min(u, exit);
                }
                Sign::Both => {
                    enter = Lanes::max(v, Lanes::max(u, enter));
                }
            }
        }
        (enter, LaneMask::bits(Lanes::le(enter, exit)))
    }

    /// The children of a node that are met before `end`.
    #[inline(always)]
    pub fn children(&self, node: &Node, end: f32x8) -> (f32x8, u32) {
        self.meets(&node.min, &node.max, end)
    }
}
