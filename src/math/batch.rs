//! Rays and their answers in structure-of-arrays batches, the unit that both queries work on.

use glam::Vec3;
use prefetch_index::prefetch_index;

use super::{Lanes, MAX_LANES, Vec3 as Lane3};

/// The most rays a batch holds: a tile of 16 × 16 pixels, or any other rays that belong together.
pub const BATCH: usize = 256;

/// No primitive: the id that a ray which hits nothing gets.
pub const NONE: u32 = u32::MAX;

/// Up to [`BATCH`] rays, column by column; the columns lie one after the other, each from a cache line's start.
///
/// A ray is active when its `t_max` ≥ 0 (NaN is not). Directions have unit length, to within 4 ε (those of a ray file to
/// within 84 ε); distances are then in world units. A query looks at the open interval (`t_min`, `t_max`), 0 ≤ `t_min`.
/// A ray with a NaN or infinite component, or one that starts more than 2⁶⁸ away along an axis, hits nothing, or whatever
/// the arithmetic makes of it, and leaves the other rays of its batch alone.
#[derive(Clone, Debug)]
#[repr(C, align(64))]
pub struct RayBatch {
    /// Where the rays start, a column a component.
    pub origin: [[f32; BATCH]; 3],
    /// Unit directions.
    pub direction: [[f32; BATCH]; 3],
    /// Start of the interval, excluded.
    pub t_min: [f32; BATCH],
    /// End of the interval, excluded; below zero for an inactive ray.
    pub t_max: [f32; BATCH],
    /// Rays at `len` and beyond are inactive; kept so by [`RayBatch::push`] and [`RayBatch::set_len`].
    pub len: usize,
    /// All active rays start where ray 0 does; nothing else of `origin` is read then. Whoever fills a batch mostly
    /// knows: eye rays and a light's shadow rays do. When false they may still start at one point, only slower.
    pub common_origin: bool,
}

impl Default for RayBatch {
    fn default() -> Self {
        Self {
            len: 0,
            common_origin: false,
            origin: [[0.0; BATCH]; 3],
            direction: [[0.0; BATCH]; 3],
            t_min: [0.0; BATCH],
            t_max: [-1.0; BATCH],
        }
    }
}

impl RayBatch {
    /// Cache lines that the columns fill.
    pub(crate) const LINES: usize = 8 * BATCH / 16;

    /// The first of them that a query reads.
    pub(crate) fn first_line(&self) -> usize {
        if self.common_origin { 3 * BATCH / 16 } else { 0 }
    }

    /// Begins to bring one of them near.
    #[inline(always)]
    pub(crate) fn fetch(&self, line: usize) {
        prefetch_index(self.origin[0].as_slice(), 16 * line);
    }

    /// Forgets all rays.
    pub fn clear(&mut self) {
        self.set_len(0);
        self.common_origin = false;
    }

    /// Keeps the first `len` rays, or makes room for as many. Panics when that is more than [`BATCH`].
    pub fn set_len(&mut self, len: usize) {
        // A packet may have written beyond the end.
        let end = self.len.next_multiple_of(MAX_LANES).max(len);
        self.t_max[len..end].fill(-1.0);
        self.len = len;
    }

    /// Adds a ray. Panics when the batch is full.
    pub fn push(&mut self, origin: Vec3, direction: Vec3, t_min: f32, t_max: f32) {
        let at = self.len;
        for axis in 0..3 {
            self.origin[axis][at] = origin[axis];
            self.direction[axis][at] = direction[axis];
        }
        self.t_min[at] = t_min;
        self.t_max[at] = t_max;
        self.len = at + 1;
        if self.t_max[..at].iter().any(|&t| t >= 0.0) {
            self.common_origin &= origin == self.first_origin();
        } else {
            self.set_common_origin(origin);
        }
    }

    /// Adds an inactive ray: a place that is passed over. Panics when the batch is full.
    pub fn push_inactive(&mut self) {
        let at = self.len;
        for (axis, value) in Vec3::Z.to_array().into_iter().enumerate() {
            self.direction[axis][at] = value;
        }
        self.t_min[at] = 0.0;
        self.t_max[at] = -1.0;
        self.len = at + 1;
    }

    /// Where the rays of the packet that starts at ray `at` start.
    #[inline(always)]
    pub fn origins<L: Lanes>(&self, at: usize) -> Lane3<L> {
        if self.common_origin { Lane3::splat(self.first_origin()) } else { Lane3::load(&self.origin, at) }
    }

    /// Where ray 0 starts.
    #[inline(always)]
    pub fn first_origin(&self) -> Vec3 {
        Vec3::new(self.origin[0][0], self.origin[1][0], self.origin[2][0])
    }

    /// Makes `origin` the start of all rays.
    #[inline(always)]
    pub fn set_common_origin(&mut self, origin: Vec3) {
        for axis in 0..3 {
            self.origin[axis][0] = origin[axis];
        }
        self.common_origin = true;
    }

    /// The number of active rays.
    pub fn active(&self) -> usize {
        self.t_max[..self.len].iter().filter(|&&t| t >= 0.0).count()
    }
}

/// The nearest hits of a [`RayBatch`]. Entries of inactive rays are left as they were.
#[derive(Clone, Debug, PartialEq)]
#[repr(C, align(64))]
pub struct HitBatch {
    /// Distance; infinite for an active ray that hits nothing.
    pub t: [f32; BATCH],
    /// Primitive id; [`NONE`] for an active ray that hits nothing.
    pub primitive: [u32; BATCH],
}

impl Default for HitBatch {
    fn default() -> Self {
        Self { t: [f32::INFINITY; BATCH], primitive: [NONE; BATCH] }
    }
}

impl HitBatch {
    /// Cache lines that the columns fill.
    pub(crate) const LINES: usize = 2 * BATCH / 16;

    /// Begins to bring one of them near.
    #[inline(always)]
    pub(crate) fn fetch(&self, line: usize) {
        prefetch_index(self.t.as_slice(), 16 * line);
    }
}

/// Which rays of a [`RayBatch`] are blocked, a bit each; bits of inactive rays are left as they were.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Blocked {
    words: [u64; BATCH / 64],
}

impl Blocked {
    /// Bits `at..at + width`, `at` a multiple of `width`, `width` a power of two up to 32.
    #[inline(always)]
    pub fn get(&self, at: usize, width: usize) -> u32 {
        ((self.words[at / 64] >> (at % 64)) & ((1 << width) - 1)) as u32
    }

    /// Sets those bits where `mask` has ones to those of `bits`.
    #[inline(always)]
    pub fn set(&mut self, at: usize, mask: u32, bits: u32) {
        let word = &mut self.words[at / 64];
        *word = (*word & !(u64::from(mask) << (at % 64))) | (u64::from(bits & mask) << (at % 64));
    }

    /// The number of blocked rays.
    pub fn count(&self) -> usize {
        self.words.iter().map(|w| w.count_ones() as usize).sum()
    }
}
