//! From the binary tree to eight children a node, by dynamic programming over the surface area heuristic.
//!
//! Ylitie, Karras, Laine, *Efficient Incoherent Ray Traversal on GPUs Through Compressed Wide BVHs* (HPG 2017),
//! section 4.1: for every binary subtree and every i, the least cost of showing it as at most i children of a wide
//! node. Deviations: a block is a leaf of at most eight primitives of one class, and costs are f64, in which areas of
//! f32 boxes neither overflow nor vanish.

use super::aabb::Aabb;
use super::{BLOCK, BLOCK_COST, NODE_COST, PRIMITIVE_COST, WIDTH};

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
        (self.0 >> (3 * (children - 2))) as usize & 7
    }
}

impl Costs {
    /// A range of one class that is not split.
    pub fn leaf(bounds: Aabb, len: usize) -> Self {
        Self([bounds.area_f64() * block(len); WIDTH - 1])
    }

    /// Two subtrees together; with `len` when all primitives have the same class.
    pub fn parent(left: &Self, right: &Self, bounds: Aabb, len: Option<usize>) -> (Self, Choices) {
        let mut choices = 0;
        // At exactly two children and more, before it is known what one child costs.
        let mut apart = [f64::INFINITY; WIDTH + 1];
        for children in 2..=WIDTH {
            let mut best = (f64::INFINITY, 0);
            for k in 1..children {
                let cost = left.0[k - 1] + right.0[children - k - 1];
                if cost < best.0 {
                    best = (cost, k as u32);
                }
            }
            apart[children] = best.0;
            choices |= best.1 << (3 * (children - 2));
        }
        let area = bounds.area_f64();
        let as_node = area * NODE_COST + apart[WIDTH];
        let as_block = len.filter(|&len| len <= BLOCK).map_or(f64::INFINITY, |len| area * block(len));
        let mut costs = [as_node; WIDTH - 1];
        if as_block <= as_node {
            costs[0] = as_block;
            choices |= Choices::BLOCK;
        }
        for children in 2..WIDTH {
            costs[children - 1] = apart[children];
            if costs[children - 2] <= apart[children] {
                costs[children - 1] = costs[children - 2];
                choices &= !(7 << (3 * (children - 2)));
            }
        }
        (Self(costs), Choices(choices))
    }
}

/// What a block costs a ray that enters its box.
fn block(len: usize) -> f64 {
    BLOCK_COST + PRIMITIVE_COST * len as f64
}
