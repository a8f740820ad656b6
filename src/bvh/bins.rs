//! Where to split a range: the surface area heuristic over bins of the primitives' middles.
//!
//! Wald, *On fast Construction of SAH-based Bounding Volume Hierarchies* (RT 2007). Deviations: all three axes are
//! tried, small ranges get fewer bins, areas are relative to the range's own box, so that they neither overflow nor
//! vanish, and of splits of equal cost the more even one wins, which keeps boxes without area apart.

use glam::Vec3A;
use rayon::prelude::*;

use super::aabb::Bounds;
use super::limits::BLOCK;
use super::refs::{Extent, Ref};

/// The most bins an axis has.
const MAX_BINS: usize = 32;
/// Up to this length of a range, its parts count as the blocks that they fill: else halving may leave blocks half empty, as
/// on a height field of 2²⁰ triangles, whose rays gain 1 to 3 % by this.
const FEW: usize = 16 * BLOCK;
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

    /// The bins of a middle on the three axes, plus [`TO_INTEGER`].
    #[inline(always)]
    fn bins(&self, center: Vec3A) -> Vec3A {
        let at = (center - self.low) * self.scale - 0.5;
        at.max(Vec3A::ZERO).min(Vec3A::splat(self.last)) + TO_INTEGER
    }
}

/// A plane between two bins; there are primitives on both sides.
#[derive(Clone, Copy, Debug)]
pub(super) struct Split {
    grid: Grid,
    /// The first bin to the right, plus [`TO_INTEGER`], on the axis of the split; −∞ on the others.
    plane: Vec3A,
    /// The boxes of both sides.
    pub sides: [Bounds; 2],
}

impl Split {
    /// Whether a primitive with this middle is to the left.
    #[inline(always)]
    pub fn is_left(&self, center: Vec3A) -> bool {
        self.grid.bins(center).cmplt(self.plane).any()
    }
}

/// The builder's working memory.
#[derive(Clone)]
pub(super) struct Bins {
    bounds: [[Bounds; MAX_BINS]; 3],
    count: [[u32; MAX_BINS]; 3],
}

impl Default for Bins {
    fn default() -> Self {
        Self { bounds: [[Bounds::EMPTY; MAX_BINS]; 3], count: [[0; MAX_BINS]; 3] }
    }
}

impl Bins {
    /// The best split of a range; `None` where all middles coincide.
    pub fn split(&mut self, refs: &[Ref], extent: &Extent) -> Option<Split> {
        if extent.centers.min == extent.centers.max {
            return None;
        }
        let bins = (4 + refs.len() / 16).min(MAX_BINS);
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

    fn fill(&mut self, refs: &[Ref], grid: &Grid) {
        // Neighbours mostly belong to the same bin, and would wait for each other: so those far apart alternate.
        let (a, b) = refs.split_at(refs.len() / 2);
        for (a, b) in a.iter().zip(b) {
            self.put(a, grid);
            self.put(b, grid);
        }
        if let Some(last) = b.get(a.len()) {
            self.put(last, grid);
        }
    }

    #[inline(always)]
    fn put(&mut self, r: &Ref, grid: &Grid) {
        let (at, bounds) = (grid.bins(r.center()), r.bounds());
        for (axis, at) in [at.x, at.y, at.z].into_iter().enumerate() {
            let bin = at.to_bits() as usize & (MAX_BINS - 1);
            self.bounds[axis][bin].add(&bounds);
            self.count[axis][bin] += 1;
        }
    }

    fn add(&mut self, other: &Self) {
        for axis in 0..3 {
            for bin in 0..MAX_BINS {
                self.bounds[axis][bin].add(&other.bounds[axis][bin]);
                self.count[axis][bin] += other.count[axis][bin];
            }
        }
    }

    /// The split of least cost: area · number of primitives, or of places for them in blocks, left and right.
    fn cheapest(&self, grid: &Grid, bins: usize, len: usize, bounds: &Bounds) -> Option<Split> {
        let longest = (bounds.max * 0.25 - bounds.min * 0.25).max_element();
        let whole = if (BLOCK + 1..=FEW).contains(&len) { BLOCK as u32 } else { 1 };
        let work = |n: u32| n.next_multiple_of(whole) as f32;
        let scale = 0.25 * (1.0 / longest).min(f32::MAX);
        let mut best = (f32::INFINITY, usize::MAX);
        let mut split: Option<(usize, usize)> = None;
        for axis in 0..3 {
            let (boxes, count) = (&self.bounds[axis], &self.count[axis]);
            let mut right_cost = [0.0; MAX_BINS];
            let (mut side, mut n) = (Bounds::EMPTY, 0);
            for bin in (1..bins).rev() {
                side.add(&boxes[bin]);
                n += count[bin];
                right_cost[bin] = side.scaled_area(scale) * work(n);
            }
            let (mut side, mut n) = (Bounds::EMPTY, 0);
            for bin in 1..bins {
                side.add(&boxes[bin - 1]);
                n += count[bin - 1];
                let left = n as usize;
                let cost = side.scaled_area(scale) * work(n) + right_cost[bin];
                if cost > best.0 || left == 0 || left == len {
                    continue;
                }
                let candidate = (cost, left.abs_diff(len - left));
                if candidate < best {
                    best = candidate;
                    split = Some((axis, bin));
                }
            }
        }
        let (axis, bin) = split?;
        let mut plane = Vec3A::NEG_INFINITY;
        plane[axis] = bin as f32 + TO_INTEGER;
        let side = |boxes: &[Bounds]| boxes.iter().fold(Bounds::EMPTY, |a, b| a.union(*b));
        let (left, right) = self.bounds[axis][..bins].split_at(bin);
        Some(Split { grid: *grid, plane, sides: [side(left), side(right)] })
    }
}
