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
        match child.kind() {
            Kind::Node => {
                let node = self.nodes.get(child.index());
                lines(size_of::<Node>(), node.map(|node| &node.ends[0][0][..]));
            }
            _ => self.blocks.fetch(child),
        }
    }
}

/// All cache lines of what is so large and begins with these numbers.
#[inline(always)]
pub(super) fn lines<T>(bytes: usize, first: Option<&[T]>) {
    let numbers = LINE / size_of::<T>();
    if let Some(first) = first {
        (0..bytes.div_ceil(LINE)).for_each(|line| prefetch_index(first, numbers * line));
    }
}

/// Bytes of a cache line.
const LINE: usize = 64;
