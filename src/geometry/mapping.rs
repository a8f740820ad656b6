//! Where a primitive's texture coordinates end.

use crate::math::{LaneMask, Lanes};

/// How the texture coordinates at points of a surface go on: either has no end there, or runs from 0 to 1.
#[derive(Clone, Copy, Debug)]
pub struct Mapping<L: Lanes> {
    /// Where u ends at 0 and 1, and where v does.
    pub ends: [L::Mask; 2],
    /// Whether v = 0 and v = 1 are each a single point, for lanes in which v ends and u does not.
    pub points: [bool; 2],
}

impl<L: Lanes> Mapping<L> {
    /// Without an end.
    #[inline(always)]
    pub fn endless() -> Self {
        Self::of([false; 2])
    }

    /// Across a face.
    #[inline(always)]
    pub fn face() -> Self {
        Self::of([true; 2])
    }

    /// Around in u, and from one end to the other in v.
    #[inline(always)]
    pub fn around(points: [bool; 2]) -> Self {
        Self { points, ..Self::of([false, true]) }
    }

    /// With a face where the mask is true.
    #[inline(always)]
    pub fn capped(self, cap: L::Mask) -> Self {
        let [u, v] = self.ends;
        Self { ends: [u | cap, v | cap], ..self }
    }

    #[inline(always)]
    fn of([u, v]: [bool; 2]) -> Self {
        let all = |ends: bool| L::Mask::from_bits(if ends { u32::MAX } else { 0 });
        Self { ends: [all(u), all(v)], points: [false; 2] }
    }
}
