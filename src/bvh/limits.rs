//! How large a tree and its parts may be, and what they cost a ray.

/// The children of a node.
pub const WIDTH: usize = 8;
/// The most primitives of a block.
pub const BLOCK: usize = 8;
/// The most nodes on a way from the root to a block, whatever the primitives.
///
/// By design: the binary tree is split freely only while what is left could still be halved by count within this
/// depth, and a wide node is at least one binary one.
pub const MAX_DEPTH: usize = 64;

/// The cost of a node for a ray that visits it: the unit of the other costs.
pub const NODE_COST: f64 = 1.0;
/// Bits of a [`Child`](super::Child) that hold an index.
pub(super) const INDEX_BITS: u32 = 28;

/// The most primitives a tree can hold: 2²⁸ − 1, so that every index fits a [`Child`](super::Child).
pub const MAX_PRIMITIVES: usize = (1 << INDEX_BITS) - 1;
