//! A node.

use super::aabb::Aabb;
use super::kind::Child;
use super::limits::WIDTH;
use wide::f32x8;

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

    pub(super) fn set(&mut self, lane: usize, bounds: Aabb, child: Child) {
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

    /// The box around all children.
    pub fn around(&self) -> Aabb {
        (0..self.len()).map(|lane| self.bounds(lane)).fold(Aabb::EMPTY, Aabb::union)
    }

    /// The boxes' coordinates along an axis at one end (0 for the least) and at the other.
    #[inline(always)]
    pub fn faces(&self, axis: usize, end: usize) -> [f32x8; 2] {
        [self.ends[end & 1][axis].into(), self.ends[!end & 1][axis].into()]
    }

    /// One child's coordinate along an axis at one end.
    #[inline(always)]
    pub fn end(&self, axis: usize, end: usize, lane: usize) -> f32 {
        self.ends[end & 1][axis][lane]
    }

    /// The used children, as bits.
    #[inline(always)]
    pub fn used(&self) -> u32 {
        let mut bits = 0;
        for (lane, &child) in self.child.iter().enumerate() {
            bits |= u32::from(child != Child::EMPTY) << lane;
        }
        bits
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
