//! Bringing what a traversal comes to later nearer, while it is busy with what comes first: a tree that outgrows the
//! caches is mostly waited for.

use super::kind::{Child, Kind};
use super::node::Node;
use super::tree::Bvh;
use prefetch_index::prefetch_index;

/// Bytes of a cache line.
const LINE: usize = 64;

/// A tree of so many bytes stays in the second-level cache.
const NEAR: usize = 1 << 19;

/// Lines that are asked for at once; the processor fetches what follows by itself.
const LINES: usize = 4;

/// Where the nodes and the blocks of every kind lie: so a child's place is computed without a choice, which would be
/// guessed wrong as often as not.
#[derive(Clone, Copy, Debug)]
pub struct Places<'a> {
    /// The first of each kind, as numbers.
    first: [&'a [u32]; 16],
    /// Numbers from one to the next.
    stride: [usize; 16],
    /// Whether the tree outgrows the caches.
    far: bool,
}

impl<'a> Places<'a> {
    /// Of a tree.
    pub fn of(bvh: &'a Bvh) -> Self {
        let mut places = Self { first: [&[]; 16], stride: [0; 16], far: bvh.bytes() > NEAR };
        if let Some(node) = bvh.nodes.first() {
            places.put(Kind::Node, bytemuck::cast_slice(&node.ends[0][0]), size_of::<Node>());
        }
        bvh.blocks.places(|kind, first, bytes| places.put(kind, first, bytes));
        places
    }

    fn put(&mut self, kind: Kind, first: &'a [u32], bytes: usize) {
        (self.first[kind as usize], self.stride[kind as usize]) = (first, bytes / size_of::<u32>());
    }

    /// Fetches the children of a node whose bits are set, at least one; nothing of a tree that stays near.
    #[inline(always)]
    pub(crate) fn fetch(&self, node: &Node, mut met: u32) {
        // One alone is next.
        if !self.far || met & (met - 1) == 0 {
            return;
        }
        while met != 0 {
            self.fetch_child(node.child[met.trailing_zeros() as usize & 7]);
            met &= met - 1;
        }
    }

    /// Fetches one child, unless the tree stays near.
    #[inline(always)]
    pub(crate) fn fetch_child(&self, child: Child) {
        if !self.far {
            return;
        }
        let kind = child.number();
        let at = self.stride[kind] * child.index();
        for line in 0..LINES {
            prefetch_index(self.first[kind], at + LINE / size_of::<u32>() * line);
        }
    }
}
