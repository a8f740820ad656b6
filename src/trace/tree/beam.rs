//! Bounds of all rays of a group, tested against eight boxes at once.
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
//! boxes are wider by [`PAD`] (D + |o|) on all sides. No hit is found before the ray enters that box:
//!
//! - The spheres' test errs as if the sphere were larger by 12 ε |f|, which is 21 ε D at most, as |f| ≤ √3 D. Their boxes,
//!   rounded to nearest, add ε (D + |o|), a direction that is 84 ε too long or short, as a ray file's may be, less than
//!   30 ε of a radius: less than 64 in all.
//! - The cylinders' and cones' tests err as if the ray were moved by 12 ε (|f| + length + radius) and turned by 8 ε, so
//!   that a hit lies within 35 ε D + 12 ε (length + radius) of the surface, and of the piece that the tree has cut there.
//!   The first is less than 64 ε D; the boxes of these bodies and of their pieces are made wider by 32 ε of the body's
//!   size and place, which is more than the second.
//! - All others keep their hits within boxes of their own, wider by 32 ε D ([`crate::geometry::triangle::Flat`],
//!   [`crate::trace::packet`]).
//!
//! So a hit at t lies deeper in the wider box than rounding moves its faces, and the ray enters that strictly before t and
//! leaves it strictly after. Where a box is met, `<` would do for `<=`, here and in [`super::line`], [`super::packet`] and
//! [`super::stack`], where the end is the nearest hit so far; the margin is what keeps equal distances, and the tests
//! take it away. (All that is left is a scene without extent at the world's origin, with rays from there: D + |o| is 0.)

use crate::bvh::Bvh;
use crate::math::{LaneMask, Lanes};
use wide::f32x8;

/// 64 ε.
pub const PAD: f32 = 1.0 / (1 << 18) as f32;
/// A direction's component below this counts as both above and below zero in a group, and as this for a single ray: its
/// inverse times any distance is beyond all others.
pub const TINY: f32 = 1e-18;

/// Bounds of the active rays of a group.
pub struct Beam {
    /// Per axis: the inverse that the faces where rays enter are multiplied by, and what is taken from that.
    pub near: [(f32x8, f32x8); 3],
    /// The inverse and what is taken, for the faces where rays leave; for an axis with rays of both directions, where
    /// the others enter.
    pub far: [(f32x8, f32x8); 3],
    /// Which end of a box is the near one: 0 for `min`.
    pub side: [usize; 3],
    /// Axes with rays of both directions.
    pub both: [bool; 3],
    /// Whether there is any such axis.
    pub mixed: bool,
    /// The axis of the directions' largest component, where the bounds tell.
    pub major: Option<usize>,
}

impl Beam {
    /// What rounding grows with: how far a corner of the scene may lie from an origin, and that from zero.
    #[inline(always)]
    pub fn reach([o_min, o_max]: [glam::Vec3; 2], bvh: &Bvh) -> f32 {
        let reach = (bvh.bounds.max - o_min).max(o_max - bvh.bounds.min).max_element().max(0.0);
        reach + o_min.abs().max(o_max.abs()).max_element()
    }

    /// From the least and greatest origins and directions.
    #[inline(always)]
    pub fn new([o_min, o_max]: [glam::Vec3; 2], [d_min, d_max]: [glam::Vec3; 2], bvh: &Bvh) -> Self {
        let pad = PAD * Self::reach([o_min, o_max], bvh);
        let zero = (f32x8::ZERO, f32x8::ZERO);
        let mut beam = Self {
            near: [zero; 3],
            far: [zero; 3],
            side: [0; 3],
            both: [false; 3],
            mixed: false,
            major: major(d_min, d_max),
        };
        for axis in 0..3 {
            let (least, most) = (d_min[axis], d_max[axis]);
            let both = !(least >= TINY || most <= -TINY);
            let (r, q) = match both {
                false => (1.0 / most, 1.0 / least),
                true => (1.0 / most.max(TINY), 1.0 / least.min(-TINY)),
            };
            let low = (f32x8::splat(r), f32x8::splat((o_max[axis] + pad) * r));
            let high = (f32x8::splat(q), f32x8::splat((o_min[axis] - pad) * q));
            let behind = most <= -TINY;
            (beam.near[axis], beam.far[axis]) = if behind { (high, low) } else { (low, high) };
            beam.side[axis] = usize::from(behind);
            beam.both[axis] = both;
            beam.mixed |= both;
        }
        beam
    }

    /// Eight boxes' entries, not below zero, and which are met no later than at `end`. `faces` gives the boxes' near and far
    /// coordinates along an axis, told which end is near (0 for the least); `MIXED` may be false where
    /// [`Beam::mixed`] is.
    #[inline(always)]
    pub fn meets<const MIXED: bool>(&self, faces: impl Fn(usize, usize) -> [f32x8; 2], end: f32x8) -> (f32x8, u32) {
        debug_assert!(MIXED || !self.mixed);
        let mut enter = f32x8::ZERO;
        let mut exit = end;
        for axis in 0..3 {
            let (r, a) = self.near[axis];
            let (q, b) = self.far[axis];
            let [near, far] = faces(axis, self.side[axis]);
            // What is NaN (∞ − ∞) is passed over.
            enter = Lanes::max(near.mul_sub(r, a), enter);
            let other = far.mul_sub(q, b);
            if MIXED && self.both[axis] {
                enter = Lanes::max(other, enter);
            } else {
                exit = Lanes::min(other, exit);
            }
        }
        (enter, LaneMask::bits(Lanes::le(enter, exit)))
    }
}

/// The axis along which all directions between these are larger than along the others, as
/// [`crate::geometry::triangle::Aim`] has it.
#[inline(always)]
fn major(min: glam::Vec3, max: glam::Vec3) -> Option<usize> {
    let least = min.max(-max).max(glam::Vec3::ZERO);
    let most = max.max(-min);
    match () {
        _ if least.x >= most.y && least.x >= most.z => Some(0),
        _ if least.y > most.x && least.y >= most.z => Some(1),
        _ if least.z > most.x && least.z > most.y => Some(2),
        _ => None,
    }
}
