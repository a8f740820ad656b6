//! From the binary tree to eight children a node, by dynamic programming over the surface area heuristic.
//!
//! Ylitie, Karras, Laine, *Efficient Incoherent Ray Traversal on GPUs Through Compressed Wide BVHs* (HPG 2017),
//! section 4.1: for every binary subtree and every i, the least cost of showing it as at most i children of a wide
//! node. Deviations: a block is a leaf of at most eight primitives of one class, and costs are f64, in which areas of
//! f32 boxes neither overflow nor vanish.

use std::array::from_fn;

use super::aabb::Aabb;
use super::limits::{BLOCK, BLOCK_COST, NODE_COST, PRIMITIVE_COST, WIDTH};

/// The least cost of a subtree as at most 1, 2 … 7 children: area · expected work.
#[derive(Clone, Copy, Debug)]
pub(super) struct Costs([f64; WIDTH - 1]);

/// How a subtree becomes at most i children, for every i; and whether, as one child, it is a block.
///
/// Three bits an i from 2 to 8: how many of the i children the left part gets, 0 for as with one child less.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Choices(u32);

impl Choices {
    const BLOCK: u32 = 1 << 31;
    /// Never anything but a block.
    pub const LEAF: Self = Self(Self::BLOCK);

    /// Whether it is a range that was not split.
    #[cfg(test)]
    pub fn is_leaf(self) -> bool {
        self.0 == Self::BLOCK
    }

    /// Whether it is a block when it is one child.
    pub fn is_block(self) -> bool {
        self.0 & Self::BLOCK != 0
    }

    /// How many of at most `children` children come from the left part; 0 when it is the same as with one less.
    pub fn left(self, children: usize) -> usize {
        (self.0 >> shift(children)) as usize & 7
    }
}

impl Costs {
    /// A range of one class that is not split.
    pub fn leaf(bounds: Aabb, len: usize) -> Self {
        Self([bounds.area_f64() * block(len); WIDTH - 1])
    }

    /// Two subtrees together; with `len` when all primitives have the same class.
    pub fn parent(left: &Self, right: &Self, bounds: Aabb, len: Option<usize>) -> (Self, Choices) {
        // Both parts shown, as at most 0, 1 … 8 children: what that costs, and how many the left one gets.
        let apart: [(f64, u32); WIDTH + 1] = from_fn(|children| {
            let cost = |k: usize| left.0[k - 1] + right.0[children - k - 1];
            (1..children).fold((f64::INFINITY, 0), |best, k| if cost(k) < best.0 { (cost(k), k as u32) } else { best })
        });
        let area = bounds.area_f64();
        let as_node = area * NODE_COST + apart[WIDTH].0;
        let as_block = len.filter(|&len| len <= BLOCK).map_or(f64::INFINITY, |len| area * block(len));
        let mut choices = apart[WIDTH].1 << shift(WIDTH);
        if as_block <= as_node {
            choices |= Choices::BLOCK;
        }
        let mut costs = [as_node.min(as_block); WIDTH - 1];
        for children in 2..WIDTH {
            let (cost, left) = apart[children];
            costs[children - 1] = costs[children - 2];
            if cost < costs[children - 2] {
                costs[children - 1] = cost;
                choices |= left << shift(children);
            }
        }
        (Self(costs), Choices(choices))
    }
}

/// Where the choice for at most `children` children lies.
fn shift(children: usize) -> usize {
    3 * (children - 2)
}

/// The cost of a block for a ray that enters its box.
fn block(len: usize) -> f64 {
    BLOCK_COST + PRIMITIVE_COST * len as f64
}
