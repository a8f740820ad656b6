//! The few lines in which the two queries differ: what becomes of a hit.

use crate::math::{LaneMask, Lanes, NONE};

/// What a packet does with the hits that the primitives' tests report.
pub trait Query<L: Lanes> {
    /// Where the interval ends for the next test.
    fn t_max(&self) -> L;
    /// Takes hits at `t`, all inside the interval, where `inside` is true.
    fn hit(&mut self, t: L, inside: L::Mask, primitive: u32);
    /// Whether no further hit can change the answer.
    fn done(&self) -> bool;
}

/// The nearest hit.
pub struct Nearest<L: Lanes> {
    /// Its distance, or the end of the interval.
    pub t: L,
    /// Its primitive id as bits, or [`NONE`].
    pub primitive: L,
    /// Where there is one.
    pub found: L::Mask,
}

impl<L: Lanes> Nearest<L> {
    /// No hit yet, in intervals that end at `t_max`.
    #[inline(always)]
    pub fn new(t_max: L) -> Self {
        Self { t: t_max, primitive: L::splat_id(NONE), found: L::Mask::from_bits(0) }
    }
}

impl<L: Lanes> Query<L> for Nearest<L> {
    #[inline(always)]
    fn t_max(&self) -> L {
        self.t
    }
    #[inline(always)]
    fn hit(&mut self, t: L, inside: L::Mask, primitive: u32) {
        self.t = t.select(inside, self.t);
        self.primitive = L::splat_id(primitive).select(inside, self.primitive);
        self.found = self.found | inside;
    }
    #[inline(always)]
    fn done(&self) -> bool {
        false
    }
}

/// Whether there is any hit.
pub struct Any<L: Lanes> {
    /// Lanes that are blocked, or inactive.
    pub settled: L::Mask,
    /// The end of the interval.
    pub t_max: L,
}

impl<L: Lanes> Query<L> for Any<L> {
    #[inline(always)]
    fn t_max(&self) -> L {
        self.t_max
    }
    #[inline(always)]
    fn hit(&mut self, _t: L, inside: L::Mask, _primitive: u32) {
        self.settled = self.settled | inside;
    }
    #[inline(always)]
    fn done(&self) -> bool {
        self.settled.all()
    }
}
