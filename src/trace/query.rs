//! The few lines in which the two queries differ: what becomes of a hit.

use crate::geometry::Variant;
use crate::math::{LaneMask, Lanes, NONE};

/// One of the two queries.
pub trait Query: 'static {
    /// Whether any hit will do, so that a ray is done with its first.
    const ANY: bool;
    /// The findings of a packet.
    type Found<L: Lanes>: Found<L>;
    /// A primitive's variant as this query meets it: light is stopped by a side that is not there to be seen.
    #[inline(always)]
    fn variant<V: Variant>(variant: V) -> V {
        if Self::ANY { variant.both_sides() } else { variant }
    }
}

/// The nearest hit.
pub struct Intersect;

impl Query for Intersect {
    const ANY: bool = false;
    type Found<L: Lanes> = Nearest<L>;
}

/// Whether there is any hit.
pub struct Occluded;

impl Query for Occluded {
    const ANY: bool = true;
    type Found<L: Lanes> = Blockers<L>;
}

/// The findings of a packet, made of the hits that the primitives' tests report.
pub trait Found<L: Lanes> {
    /// No hit yet, in intervals that end at `t_max`; only where `active`.
    fn nothing(t_max: L, active: L::Mask) -> Self;
    /// From columns: the distances and ids of nearest hits, or −∞ for a blocked ray.
    fn load(t: &[f32], id: &[u32]) -> Self;
    /// Where the interval ends for the next test.
    fn t_max(&self) -> L;
    /// Takes hits at `t`, all inside the interval, where `inside` is true.
    fn hit(&mut self, t: L, inside: L::Mask, primitive: u32);
    /// Whether no further hit can change the answer.
    fn done(&self) -> bool;
}

/// The nearest hits of a packet.
pub struct Nearest<L: Lanes> {
    /// Its distance, or the end of the interval.
    pub t: L,
    /// Its primitive id as bits, or [`NONE`].
    pub primitive: L,
    /// Where there is one.
    pub found: L::Mask,
}

impl<L: Lanes> Found<L> for Nearest<L> {
    #[inline(always)]
    fn nothing(t_max: L, active: L::Mask) -> Self {
        // Nothing lies before −∞, so inactive lanes take no hit.
        let t = t_max.select(active, L::splat(f32::NEG_INFINITY));
        Self { t, primitive: L::splat_id(NONE), found: L::Mask::from_bits(0) }
    }
    #[inline(always)]
    fn load(t: &[f32], id: &[u32]) -> Self {
        Self { t: L::load(t), primitive: L::load_ids(id), found: !L::id_mask(id, NONE) }
    }
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

/// Which rays of a packet are blocked.
pub struct Blockers<L: Lanes> {
    /// Lanes that are blocked, or inactive.
    pub settled: L::Mask,
    t_max: L,
}

impl<L: Lanes> Found<L> for Blockers<L> {
    #[inline(always)]
    fn nothing(t_max: L, active: L::Mask) -> Self {
        Self { settled: !active, t_max }
    }
    #[inline(always)]
    fn load(t: &[f32], _: &[u32]) -> Self {
        let t_max = L::load(t);
        Self { settled: t_max.lt(L::zero()), t_max }
    }
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
