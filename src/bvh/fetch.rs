//! Bringing what a traversal comes to later nearer, while it is busy with what comes first: a tree that outgrows the
//! caches is mostly waited for.

use super::kind::{Child, Kind};
use super::node::Node;
use super::prefetch::lines;
use super::tree::Bvh;

impl Bvh {
    /// The children of a node whose bits are set, at least one.
    #[inline(always)]
    pub(crate) fn fetch(&self, node: &Node, mut met: u32) {
        // One alone is next.
        if met & (met - 1) == 0 {
            return;
        }
        while met != 0 {
            self.fetch_child(node.child[met.trailing_zeros() as usize & 7]);
            met &= met - 1;
        }
    }

    /// One child, from its first cache line to its last.
    #[inline(always)]
    pub(crate) fn fetch_child(&self, child: Child) {
        match child.kind() {
            Kind::Node => {
                let node = self.nodes.get(child.index());
                lines(size_of::<Node>(), node.map(|node| &node.ends[0][0][..]));
            }
            _ => self.blocks.fetch(child),
        }
    }
}
