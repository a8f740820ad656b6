//! The tree as it lies in memory.

use super::aabb::Aabb;
use super::block::Blocks;
use super::kind::Child;
use super::node::Node;

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
    /// The most nodes on a way from the root to a block; at most [`MAX_DEPTH`](super::MAX_DEPTH).
    pub depth: usize,
    /// How large blocks are: the mean of their largest extents, or of the edges of squares of half their area where those
    /// are less, weighted by area, without those of an eighth of the whole and more; an eighth of the whole's largest
    /// extent when there are no others.
    pub grain: f32,
}

impl Bvh {
    /// The memory of nodes and blocks.
    pub fn bytes(&self) -> usize {
        size_of_val(&self.nodes[..]) + self.blocks.bytes()
    }
}
