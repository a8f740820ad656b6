//! From primitives to the tree.

use super::aabb::Aabb;
use super::block::Blocks;
use super::kind::Child;
use super::limits::{MAX_DEPTH, MAX_PRIMITIVES};
use super::source::Source;
use super::tree::Bvh;
use super::{build, layout, refs};

impl Bvh {
    /// Builds the tree, in the caller's thread pool. Panics with more than [`MAX_PRIMITIVES`].
    pub fn build(source: &impl Source) -> Self {
        assert!(source.len() <= MAX_PRIMITIVES, "too many primitives");
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
        layout::layout(source, &build::build(refs::collect(source), MAX_DEPTH))
    }
}
