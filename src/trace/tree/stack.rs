//! Children that are still to be visited, the nearest on top.

use crate::bvh::{Child, MOST_DEPTH, Node};

/// A node leaves at most seven of its children behind.
const ROOM: usize = 7 * MOST_DEPTH + 8;

/// Entries are a child and the distance from which on it may be hit, as bits above the child's: distances are not
/// below zero, and such bits rise with them.
#[derive(Clone, Debug)]
pub struct Stack {
    entries: [u64; ROOM],
    len: usize,
}

impl Default for Stack {
    fn default() -> Self {
        Self { entries: [0; ROOM], len: 0 }
    }
}

impl Stack {
    /// Holds `root` alone.
    #[inline(always)]
    pub fn start(&mut self, root: Child) {
        self.entries[0] = u64::from(root.bits());
        self.len = 1;
    }

    /// The nearest entry: from where, and the child.
    #[inline(always)]
    pub fn pop(&mut self) -> Option<(f32, Child)> {
        self.len = self.len.checked_sub(1)?;
        let entry = self.entries[self.len];
        Some((f32::from_bits((entry >> 32) as u32), Child::from_bits(entry as u32)))
    }

    /// Adds the children of `node` whose bits are set, hit from `enter` on.
    #[inline(always)]
    pub fn push(&mut self, node: &Node, enter: &[f32; 8], mut bits: u32) {
        let base = self.len;
        while bits != 0 {
            let lane = bits.trailing_zeros() as usize & 7;
            bits &= bits - 1;
            let entry = (u64::from(enter[lane].to_bits()) << 32) | u64::from(node.child[lane].bits());
            // Sorted in from the top: few are hit at once.
            let mut at = self.len;
            while at > base && self.entries[at - 1] < entry {
                self.entries[at] = self.entries[at - 1];
                at -= 1;
            }
            self.entries[at] = entry;
            self.len += 1;
        }
    }
}
