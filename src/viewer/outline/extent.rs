//! How far something spreads, seen from above.

use glam::DVec2;

/// The least rectangle in (x, z), along the axes, that something is in.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Extent {
    /// The least x and z.
    pub low: DVec2,
    /// The greatest.
    pub high: DVec2,
}

impl Extent {
    /// As far to both sides.
    pub fn around(center: DVec2, spread: DVec2) -> Self {
        Self { low: center - spread, high: center + spread }
    }

    /// None of nothing.
    pub fn of(points: impl IntoIterator<Item = DVec2>) -> Option<Self> {
        let one = |p| Self { low: p, high: p };
        points.into_iter().map(one).reduce(Self::with)
    }

    /// Of both together.
    pub fn with(self, other: Self) -> Self {
        Self { low: self.low.min(other.low), high: self.high.max(other.high) }
    }
}
