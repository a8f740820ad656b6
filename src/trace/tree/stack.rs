//! Children that are still to be visited, the nearest on top.

use crate::bvh::{Child, MAX_DEPTH, Node};

/// A node leaves at most seven of its children behind; while they are sorted in there are all eight.
const ROOM: usize = 7 * MAX_DEPTH + 8;

/// A child, and the distance from which on it may be hit: as bits above the child's, since distances are not below
/// zero and such bits rise with them.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub struct Entry(u64);

impl Entry {
    /// `child`, from `enter` on.
    #[inline(always)]
    pub fn new(enter: f32, child: Child) -> Self {
        Self((u64::from(enter.to_bits()) << 32) | u64::from(child.bits()))
    }

    /// From where on.
    #[inline(always)]
    pub fn enter(self) -> f32 {
        f32::from_bits((self.0 >> 32) as u32)
    }

    /// The child.
    #[inline(always)]
    pub fn child(self) -> Child {
        Child::from_bits(self.0 as u32)
    }
}

/// Entries still to be visited, the nearest of every node's on top.
#[derive(Clone, Debug)]
pub struct Stack {
    entries: [Entry; ROOM],
    len: usize,
}

impl Default for Stack {
    fn default() -> Self {
        Self { entries: [Entry::default(); ROOM], len: 0 }
    }
}

impl Stack {
    /// Forgets all entries.
    #[inline(always)]
    pub fn clear(&mut self) {
        self.len = 0;
    }

    /// The next entry that begins no later than `end`: at equal distance a lower id may be there.
    #[inline(always)]
    pub fn pop(&mut self, end: f32) -> Option<Entry> {
        while self.len > 0 {
            self.len -= 1;
            let entry = self.entries[self.len];
            if entry.enter() <= end {
                return Some(entry);
            }
        }
        None
    }

    /// The nearest of the children of `node` whose bits are set, at least one, hit from `enter` on; the others are put
    /// aside.
    #[inline(always)]
    pub fn nearest(&mut self, node: &Node, enter: &[f32; 8], mut bits: u32) -> Entry {
        let mut take = || {
            let lane = bits.trailing_zeros() as usize & 7;
            bits &= bits - 1;
            (Entry::new(enter[lane], node.child[lane]), bits != 0)
        };
        let (first, more) = take();
        if !more {
            return first;
        }
        let (second, more) = take();
        let (near, far) = (first.min(second), first.max(second));
        if !more {
            self.push(far);
            return near;
        }
        let base = self.len;
        self.push(far);
        self.push(near);
        loop {
            let (entry, more) = take();
            self.sort_in(base, entry);
            if !more {
                break;
            }
        }
        self.len -= 1;
        self.entries[self.len]
    }

    /// Any of the children of `node` whose bits are set, at least one; the others are put aside as they come. For rays
    /// that any hit will do for, which sorting would cost more than it saves.
    #[inline(always)]
    pub fn any(&mut self, node: &Node, enter: &[f32; 8], mut bits: u32) -> Entry {
        loop {
            let lane = bits.trailing_zeros() as usize & 7;
            bits &= bits - 1;
            let entry = Entry::new(enter[lane], node.child[lane]);
            if bits == 0 {
                return entry;
            }
            self.push(entry);
        }
    }

    #[inline(always)]
    fn push(&mut self, entry: Entry) {
        self.entries[self.len] = entry;
        self.len += 1;
    }

    /// Adds an entry where it belongs above `base`.
    #[inline(always)]
    fn sort_in(&mut self, base: usize, entry: Entry) {
        let mut at = self.len;
        while at > base && self.entries[at - 1] < entry {
            self.entries[at] = self.entries[at - 1];
            at -= 1;
        }
        self.entries[at] = entry;
        self.len += 1;
    }
}

/// A child, the distance from which on rays may hit it, and the rays or groups that may.
#[derive(Clone, Copy, Debug)]
pub struct Part<E> {
    /// The distance that parts are sorted by.
    pub near: f32,
    /// What the one who puts it aside knows of the rays' distances.
    pub enter: E,
    pub child: Child,
    pub lanes: u32,
}

/// Parts of a way that are still to be visited, the nearest of every node's on top.
#[derive(Clone, Debug)]
pub struct Parts<E> {
    parts: [Part<E>; ROOM],
    len: usize,
}

impl<E: Copy + Default> Default for Parts<E> {
    fn default() -> Self {
        Self { parts: [Part { near: 0.0, enter: E::default(), child: Child::EMPTY, lanes: 0 }; ROOM], len: 0 }
    }
}

impl<E: Copy> Parts<E> {
    /// Forgets all.
    #[inline(always)]
    pub fn clear(&mut self) {
        self.len = 0;
    }

    /// How many there are.
    #[inline(always)]
    pub fn len(&self) -> usize {
        self.len
    }

    /// The next one.
    #[inline(always)]
    pub fn pop(&mut self) -> Option<&Part<E>> {
        self.len = self.len.checked_sub(1)?;
        Some(&self.parts[self.len])
    }

    /// Adds a part where it belongs above `base`.
    #[inline(always)]
    pub fn sort_in(&mut self, base: usize, part: Part<E>) {
        let mut at = self.len;
        while at > base && self.parts[at - 1].near < part.near {
            self.parts[at] = self.parts[at - 1];
            at -= 1;
        }
        self.parts[at] = part;
        self.len += 1;
    }
}
