//! The acceleration structure: how it is built and how it lies in memory.
//!
//! 1. `refs`: the primitives' boxes, 32 bytes each.
//! 2. `bins`, `build`: a binary tree by the surface area heuristic, in parallel.
//! 3. `collapse`: which of its nodes become nodes with eight children and which become blocks, at the least expected
//!    cost.
//! 4. `layout`: [`Node`]s and blocks side by side, for eight lanes.
//!
//! Built here rather than by a crate: `obvhs` 0.4 takes 0.46, 1.63 and 693 ms on one thread for the trees of 1,282, 3,676
//! and 1,036,800 triangles that this builds in 0.32, 1.12 and 389 ms, and its own single-ray traversal of them gives 8.7, 8.7
//! and 1.6 million diffuse rays a second where ours gives 21.5, 19.4 and 3.2 (Zen 4, its best presets for a build's time
//! and medium ones for rays).
//!
//! The tree is the same for every number of threads. No input is too bad for it: depth is bounded by [`MOST_DEPTH`],
//! memory while building by 140 bytes a primitive beside the finished tree.

mod aabb;
mod bins;
mod block;
mod build;
mod collapse;
mod fetch;
mod layout;
mod refs;
mod stats;
#[cfg(test)]
mod tests;

use wide::f32x8;

pub use aabb::Aabb;
pub use block::{Block, BlockList, Blocks, Kind};
pub use stats::Stats;

/// The children of a node.
pub const WIDTH: usize = 8;
/// The most primitives of a block.
pub const BLOCK: usize = 8;
/// The most nodes on a way from the root to a block, whatever the primitives.
///
/// By design: the binary tree is split freely only while what is left could still be halved by count within this
/// depth, and a wide node is at least one binary one.
pub const MOST_DEPTH: usize = 64;

/// What it costs a ray to visit a node: the unit of the other costs.
pub const NODE_COST: f64 = 1.0;
/// What it costs a ray to visit a block, however many primitives are in it: load, transform, a test of eight lanes.
pub const BLOCK_COST: f64 = 1.5;
/// What every primitive of a block adds: packets test those that a cull leaves one by one.
pub const PRIMITIVE_COST: f64 = 0.05;

/// What primitives of a block have in common: a kind and a variant of it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Class(u16);

impl Class {
    /// Of a kind and the code of a variant, which is below 32.
    pub fn new(kind: Kind, code: u8) -> Self {
        Self((kind as u16) << 5 | u16::from(code & 31))
    }

    /// The kind.
    pub fn kind(self) -> Kind {
        Kind::BY_NUMBER[usize::from(self.0 >> 5) & 15]
    }
}

/// A child of a node: what it is in the four highest bits, and an index in the others: of a node, or of a block of its
/// kind.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Child(u32);

impl Child {
    /// No child. Its box is empty; a ray with an infinite margin may ask nonetheless, and finds nothing.
    pub const EMPTY: Self = Self(u32::MAX);

    /// The node or block `i` of its kind.
    pub fn new(kind: Kind, i: usize) -> Self {
        debug_assert!(i <= MOST_PRIMITIVES);
        Self((kind as u32) << INDEX_BITS | i as u32)
    }

    /// What it is; [`Kind::Nothing`] for [`Child::EMPTY`].
    #[inline(always)]
    pub fn kind(self) -> Kind {
        Kind::BY_NUMBER[(self.0 >> INDEX_BITS) as usize]
    }

    /// As a number.
    #[inline(always)]
    pub(crate) fn bits(self) -> u32 {
        self.0
    }

    /// From [`Child::bits`].
    #[inline(always)]
    pub(crate) fn from_bits(bits: u32) -> Self {
        Self(bits)
    }

    /// Which one of its kind.
    #[inline(always)]
    pub fn index(self) -> usize {
        (self.0 & (u32::MAX >> (32 - INDEX_BITS))) as usize
    }
}

/// Bits of a [`Child`] that hold an index.
const INDEX_BITS: u32 = 28;

/// The most primitives a tree can hold: 2²⁸ − 1, so that every index fits a [`Child`].
pub const MOST_PRIMITIVES: usize = (1 << INDEX_BITS) - 1;

/// Eight children side by side, in 256 bytes.
///
/// Used children come first. The others are [`Child::EMPTY`] and have boxes from +∞ to −∞.
#[repr(C, align(64))]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Node {
    /// The boxes' least coordinates, then their greatest: component, child.
    pub ends: [[[f32; WIDTH]; 3]; 2],
    /// The children.
    pub child: [Child; WIDTH],
}

impl Node {
    /// Without children.
    pub const EMPTY: Self =
        Self { ends: [[[f32::INFINITY; WIDTH]; 3], [[f32::NEG_INFINITY; WIDTH]; 3]], child: [Child::EMPTY; WIDTH] };

    fn set(&mut self, lane: usize, bounds: Aabb, child: Child) {
        for axis in 0..3 {
            self.ends[0][axis][lane] = bounds.min[axis];
            self.ends[1][axis][lane] = bounds.max[axis];
        }
        self.child[lane] = child;
    }

    /// The box of a child.
    pub fn bounds(&self, lane: usize) -> Aabb {
        let [min, max] = self.ends.map(|end| end.map(|c| c[lane]).into());
        Aabb { min, max }
    }

    /// The boxes' coordinates along an axis at one end (0 for the least) and at the other.
    #[inline(always)]
    pub fn faces(&self, axis: usize, end: usize) -> [f32x8; 2] {
        [end & 1, !end & 1].map(|end| self.ends[end][axis].into())
    }

    /// One child's coordinate along an axis at one end.
    #[inline(always)]
    pub fn end(&self, axis: usize, end: usize, lane: usize) -> f32 {
        self.ends[end & 1][axis][lane]
    }

    /// The number of used children.
    pub fn len(&self) -> usize {
        self.child.iter().take_while(|&&child| child != Child::EMPTY).count()
    }

    /// Whether there is no child.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }
}

/// What a tree is built from: primitives 0, 1 … `len` − 1.
pub trait Source: Sync {
    /// The number of primitives, at most [`MOST_PRIMITIVES`].
    fn len(&self) -> usize;
    /// Whether there is none.
    fn is_empty(&self) -> bool {
        self.len() == 0
    }
    /// A box around primitive `i`. What is not finite counts as ±[`f32::MAX`].
    fn bounds(&self, i: usize) -> Aabb;
    /// Shows the boxes around the pieces that primitive `i` is cut into: itself, if it is in one.
    #[inline(always)]
    fn pieces(&self, i: usize, mut show: impl FnMut(Aabb)) {
        show(self.bounds(i));
    }
    /// Whether any primitive is cut.
    fn cut(&self) -> bool {
        false
    }
    /// What primitive `i` is.
    fn class(&self, i: usize) -> Class;
    /// Its id, which rises with `i`.
    fn id(&self, i: usize) -> u32;
    /// The blocks, by the ids of each; a list a kind, in the order of [`Kind::BLOCKS`].
    fn blocks(&self, ids: &[Vec<[u32; BLOCK]>]) -> Blocks;
}

/// The tree.
#[derive(Clone, Debug)]
pub struct Bvh {
    /// Nodes, the root first, a child after its parent.
    pub nodes: Vec<Node>,
    /// Blocks of primitives.
    pub blocks: Blocks,
    /// Where to start: a node, a block when there is but one, [`Child::EMPTY`] when there is none.
    pub root: Child,
    /// The box around everything.
    pub bounds: Aabb,
    /// The most nodes on a way from the root to a block; at most [`MOST_DEPTH`].
    pub depth: usize,
    /// How large blocks are: the mean of their largest extents, weighted by area, without those of an eighth of the
    /// whole and more; an eighth of the whole when there are no others.
    pub grain: f32,
}

impl Bvh {
    /// Builds the tree, in the caller's thread pool. Panics with more than [`MOST_PRIMITIVES`].
    pub fn build(source: &impl Source) -> Self {
        assert!(source.len() <= MOST_PRIMITIVES, "too many primitives");
        if source.is_empty() {
            return Self {
                nodes: Vec::new(),
                blocks: Blocks::default(),
                root: Child::EMPTY,
                bounds: Aabb::EMPTY,
                depth: 0,
                grain: 0.0,
            };
        }
        layout::layout(source, &build::build(refs::collect(source), MOST_DEPTH))
    }

    /// The memory of nodes and blocks.
    pub fn bytes(&self) -> usize {
        size_of_val(&self.nodes[..]) + self.blocks.bytes()
    }
}
