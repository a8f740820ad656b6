//! Bringing what a traversal comes to later nearer, while it is busy with what comes first: a tree that outgrows the
//! caches is mostly waited for.

use super::{Bvh, Child, Kind, Node};
use prefetch_index::prefetch_index;

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
        let i = child.index();
        match child.kind() {
            Kind::Node => lines::<4>(self.nodes.get(i).map(|node| &node.ends[0][0])),
            Kind::Triangles => lines::<5>(self.triangles.get(i).map(|block| &block.corners[0][0])),
            Kind::Spheres => lines::<3>(self.spheres.get(i).map(|block| &block.center[0])),
            Kind::Others => (),
        }
    }
}

#[inline(always)]
fn lines<const LINES: usize>(first: Option<&[f32; 8]>) {
    if let Some(first) = first {
        (0..LINES).for_each(|line| prefetch_index(first, 16 * line));
    }
}
