//! The state of a batch's rays on their way through a tree.

use crate::geometry::triangle::Aim;
use crate::math::{BATCH, LaneMask, Lanes, MAX_LANES, NONE, RayBatch, Vec3};

use super::bits::Bits;
use super::covered::Covered;
use super::entries::{Enter, Entries};
use super::line::Lines;
use super::stack::{Parts, Stack};
use crate::trace::query::Query;
use wide::f32x16;

/// Per ray: the end of its interval, the hit that set it, and what the triangles' test needs of its direction. Kept
/// from batch to batch.
#[derive(Clone, Debug)]
#[repr(align(64))]
pub struct State {
    /// The nearest distance so far, the ray's `t_max` before there is any; −∞ for a blocked ray when any hit will do; NaN
    /// for an inactive one and one with NaN or components beyond 2⁶⁸, which hits nothing.
    pub t: [f32; BATCH],
    /// The primitive there, or [`NONE`].
    pub id: [u32; BATCH],
    /// The directions' [`Aim::shear`], for triangles.
    shear: [[f32; BATCH]; 2],
    /// Groups of rays whose shears are made, as bits.
    sheared: u32,
    /// Triangles of the block on its turn, and packets that they cover rays of.
    pub covered: Covered,
    /// Rays of packets, and those traced alone.
    pub lines: Lines,
    /// Entries that the ray or the group on its way has put aside.
    pub stack: Stack,
    /// What the packet on its way finds at a node.
    pub entries: Entries,
    /// Parts that the groups on their way have put aside.
    pub parts: Parts<()>,
    /// Parts that the packet on its way has put aside.
    pub apart: Parts<Enter>,
}

impl Default for State {
    fn default() -> Self {
        Self {
            t: [0.0; BATCH],
            id: [NONE; BATCH],
            shear: [[0.0; BATCH]; 2],
            sheared: 0,
            covered: Covered::default(),
            lines: Lines::default(),
            stack: Stack::default(),
            entries: Entries::default(),
            parts: Parts::default(),
            apart: Parts::default(),
        }
    }
}

/// The largest number over the largest coordinate, 2⁶⁸, that a ray may start at: from beyond, products of the boxes'
/// arithmetic would overflow, and whether a box is met would hang on the company.
pub const TOO_FAR: f32 = (1u64 << 60) as f32;

impl State {
    /// For a new batch.
    #[inline(always)]
    pub fn start<L: Lanes>(&mut self, rays: &RayBatch) {
        // Beams look at eight rays at a time and packets at sixteen, whatever the width.
        if !rays.len.is_multiple_of(MAX_LANES) {
            self.t[rays.len..rays.len.next_multiple_of(MAX_LANES)].fill(f32::NAN);
        }
        let too_far = L::splat(TOO_FAR);
        // 0 · ∞ is NaN.
        let strange = |v: Vec3<L>, t: L| {
            let far = |v: L, t: L| (v * too_far).mul_add(L::zero(), t);
            far(v.x, far(v.y, far(v.z, t)))
        };
        for at in (0..rays.len).step_by(L::WIDTH) {
            let mut t = strange(Vec3::load(&rays.direction, at), L::load(&rays.t_max[at..]));
            if !rays.common_origin {
                t = strange(Vec3::load(&rays.origin, at), t);
            }
            // NaN is not equal to itself.
            let t_min = L::load(&rays.t_min[at..]);
            let looks = t.ge(L::zero()) & t_min.eq(t_min);
            t.select(looks, L::splat(f32::NAN)).store(&mut self.t[at..]);
            L::splat_id(NONE).store_ids(&mut self.id[at..]);
        }
        if rays.common_origin && !(rays.first_origin() * TOO_FAR).is_finite() {
            self.t[..rays.len].fill(f32::NAN);
        }
        self.sheared = 0;
    }

    /// Makes the shears of these groups of rays, a bit each, where they are not made yet.
    #[inline(always)]
    pub fn make_shears(&mut self, rays: &RayBatch, groups: u32) {
        let missing = groups & !self.sheared;
        if missing != 0 {
            self.make_more_shears(rays, missing);
        }
    }

    #[inline(never)]
    fn make_more_shears(&mut self, rays: &RayBatch, missing: u32) {
        for group in Bits(missing) {
            let at = f32x16::WIDTH * group;
            let aim = Aim::new(Vec3::<f32x16>::load(&rays.direction, at));
            aim.shear[0].store(&mut self.shear[0][at..]);
            aim.shear[1].store(&mut self.shear[1][at..]);
        }
        self.sheared |= missing;
    }

    /// The shear of packet `at` for the triangles' test.
    #[inline(always)]
    pub fn shear<L: Lanes>(&self, at: usize) -> [L; 2] {
        [L::load(&self.shear[0][at..]), L::load(&self.shear[1][at..])]
    }

    /// Takes hits of one primitive at `t` in packet `at`, where `inside` is true: whether any is nearer than what there
    /// was, or as near with a lower id.
    #[inline(always)]
    pub fn take<Q: Query, L: Lanes>(&mut self, at: usize, t: L, inside: L::Mask, id: u32) -> bool {
        let old = L::load(&self.t[at..]);
        let mut closer = inside & t.lt(old);
        if Q::ANY {
            L::splat(f32::NEG_INFINITY).select(closer, old).store(&mut self.t[at..]);
            return closer.any();
        }
        let tie = inside & t.eq(old);
        if tie.any() {
            closer = closer | self.lower::<L>(at, tie, id);
        }
        if closer.any() {
            t.select(closer, old).store(&mut self.t[at..]);
            L::splat_id(id).select(closer, L::load_ids(&self.id[at..])).store_ids(&mut self.id[at..]);
        }
        closer.any()
    }

    /// Where there is a primitive already whose id is higher.
    #[inline(never)]
    fn lower<L: Lanes>(&self, at: usize, tie: L::Mask, id: u32) -> L::Mask {
        let lower = self.id[at..at + L::WIDTH].iter().map(|&old| old != NONE && id < old);
        let bits = lower.enumerate().fold(0, |bits, (lane, lower)| bits | (u32::from(lower) << lane));
        tie & L::Mask::from_bits(bits)
    }

    /// The furthest that any of the rays still looks.
    #[inline(always)]
    pub fn furthest<L: Lanes>(&self, range: std::ops::Range<usize>) -> f32 {
        let mut most = L::splat(f32::NEG_INFINITY);
        for at in range.step_by(L::WIDTH) {
            most = L::load(&self.t[at..]).max(most);
        }
        most.greatest()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::Vec3 as V;
    use wide::{f32x4, f32x8};

    fn rays(len: usize) -> RayBatch {
        let mut rays = RayBatch::default();
        (0..len).for_each(|i| rays.push(V::splat(i as f32), V::X, 0.0, f32::INFINITY));
        rays
    }

    /// What lies beyond a batch's end does not look, whatever the batch before left there, up to what packets and beams read.
    #[test]
    fn nothing_beyond_the_end_looks() {
        for len in [1, 3, 8, 9, 15, 16, 17, 100, 255, 256] {
            let starts: [fn(&mut State, &RayBatch); 4] =
                [State::start::<f32>, State::start::<f32x4>, State::start::<f32x8>, State::start::<f32x16>];
            for start in starts {
                let mut state = Box::<State>::default();
                state.t = [1.0; BATCH];
                start(&mut state, &rays(len));
                assert!(state.t[..len].iter().all(|t| *t == f32::INFINITY), "{len}");
                let tail = &state.t[len..len.next_multiple_of(MAX_LANES)];
                assert!(tail.iter().all(|t| t.is_nan()), "{len}: {tail:?}");
            }
        }
    }
}
