//! Where to split a range: the surface area heuristic over bins of the primitives' middles.
//!
//! Wald, *On fast Construction of SAH-based Bounding Volume Hierarchies* (RT 2007). Deviations: all three axes are
//! tried, small ranges get fewer bins, areas are relative to the range's own box, so that they neither overflow nor
//! vanish, and of splits of equal cost the more even one wins, which keeps boxes without area apart.

use glam::Vec3A;
use rayon::prelude::*;

use super::aabb::Bounds;
use super::refs::{Extent, Ref};

/// The most bins an axis has.
const MOST_BINS: usize = 32;
/// From here on a range is binned in parallel, in pieces of this size.
const PIECE: usize = 1 << 15;

/// Which bin a primitive belongs to.
#[derive(Clone, Copy, Debug)]
pub(super) struct Grid {
    low: Vec3A,
    scale: Vec3A,
    last: f32,
}

/// Added to a number from 0 to 2²², this leaves its nearest integer in the low bits.
const TO_INTEGER: f32 = (1 << 23) as f32;

impl Grid {
    fn new(centers: &Bounds, bins: usize) -> Self {
        // An axis without extent gets a finite scale: all its primitives are in bin 0 then.
        let scale = (Vec3A::splat(bins as f32) / (centers.max - centers.min)).min(Vec3A::splat(f32::MAX));
        Self { low: centers.min, scale, last: (bins - 1) as f32 }
    }

    /// The bins on the three axes.
    #[inline(always)]
    fn bins(&self, r: &Ref) -> [usize; 3] {
        let at = (r.center() - self.low) * self.scale - 0.5;
        let at = at.max(Vec3A::ZERO).min(Vec3A::splat(self.last)) + TO_INTEGER;
        [at.x, at.y, at.z].map(|v| v.to_bits() as usize & (MOST_BINS - 1))
    }
}

/// A plane between two bins; there are primitives on both sides.
#[derive(Clone, Copy, Debug)]
pub(super) struct Split {
    grid: Grid,
    axis: usize,
    /// The first bin to the right.
    bin: usize,
}

impl Split {
    #[inline(always)]
    pub fn is_left(&self, r: &Ref) -> bool {
        self.grid.bins(r)[self.axis] < self.bin
    }
}

/// The builder's working memory.
#[derive(Clone)]
pub(super) struct Bins {
    bounds: [[Bounds; MOST_BINS]; 3],
    count: [[u32; MOST_BINS]; 3],
}

impl Default for Bins {
    fn default() -> Self {
        Self { bounds: [[Bounds::EMPTY; MOST_BINS]; 3], count: [[0; MOST_BINS]; 3] }
    }
}

impl Bins {
    /// The best split of a range; `None` where all middles coincide.
    pub fn split(&mut self, refs: &[Ref], extent: &Extent) -> Option<Split> {
        if extent.centers.min == extent.centers.max {
            return None;
        }
        let bins = (4 + refs.len() / 16).min(MOST_BINS);
        let grid = Grid::new(&extent.centers, bins);
        self.clear(bins);
        if refs.len() >= 2 * PIECE && rayon::current_num_threads() > 1 {
            let piece = |refs: &[Ref]| {
                let mut part = Box::<Self>::default();
                part.fill(refs, &grid);
                part
            };
            let parts: Vec<_> = refs.par_chunks(PIECE).map(piece).collect();
            parts.iter().for_each(|part| self.add(part));
        } else {
            self.fill(refs, &grid);
        }
        self.cheapest(&grid, bins, refs.len(), &extent.bounds)
    }

    fn clear(&mut self, bins: usize) {
        for axis in 0..3 {
            self.bounds[axis][..bins].fill(Bounds::EMPTY);
            self.count[axis][..bins].fill(0);
        }
    }

    #[inline(never)]
    fn fill(&mut self, refs: &[Ref], grid: &Grid) {
        for r in refs {
            let (at, bounds) = (grid.bins(r), r.bounds());
            for axis in 0..3 {
                self.bounds[axis][at[axis]].add(&bounds);
                self.count[axis][at[axis]] += 1;
            }
        }
    }

    fn add(&mut self, other: &Self) {
        for axis in 0..3 {
            for bin in 0..MOST_BINS {
                self.bounds[axis][bin].add(&other.bounds[axis][bin]);
                self.count[axis][bin] += other.count[axis][bin];
            }
        }
    }

    /// The split of least cost: area · number of primitives, left and right.
    fn cheapest(&self, grid: &Grid, bins: usize, len: usize, bounds: &Bounds) -> Option<Split> {
        let longest = (bounds.max * 0.25 - bounds.min * 0.25).max_element();
        let scale = 0.25 * (1.0 / longest).min(f32::MAX);
        let mut best = (f32::INFINITY, usize::MAX);
        let mut split = None;
        for axis in 0..3 {
            let (boxes, count) = (&self.bounds[axis], &self.count[axis]);
            let mut right_cost = [0.0; MOST_BINS];
            let (mut side, mut n) = (Bounds::EMPTY, 0);
            for bin in (1..bins).rev() {
                side.add(&boxes[bin]);
                n += count[bin];
                right_cost[bin] = side.scaled_area(scale) * n as f32;
            }
            let (mut side, mut n) = (Bounds::EMPTY, 0);
            for bin in 1..bins {
                side.add(&boxes[bin - 1]);
                n += count[bin - 1];
                let left = n as usize;
                let cost = side.scaled_area(scale) * n as f32 + right_cost[bin];
                if cost > best.0 || left == 0 || left == len {
                    continue;
                }
                let candidate = (cost, left.abs_diff(len - left));
                if candidate < best {
                    best = candidate;
                    split = Some(Split { grid: *grid, axis, bin });
                }
            }
        }
        split
    }
}
