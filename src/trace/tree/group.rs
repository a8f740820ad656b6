//! Groups of rays together: a node is entered when a beam around them meets it.

use super::beam::Beam;
use super::beams::{Beams, RAYS};
use super::behind::{Group, Groups};
use super::bits::Bits;
use super::leaf::{Together, block};
use super::stack::Part;
use super::walk::Walk;
use crate::bvh::{Child, Kind};
use crate::math::{LaneMask, Lanes};
use crate::trace::query::Query;
use wide::{f32x8, f32x16};

/// Cache lines of the next batch that are fetched at every step of the descent.
const LINES: usize = 8;
/// As many beams go on one by one.
const FEW: u32 = 1;

impl Walk<'_> {
    /// Traces the beams whose bits are set.
    #[inline(always)]
    pub fn beams<Q: Query, L: Lanes>(&mut self, beams: &Beams, lanes: u32) {
        match beams.mixed {
            false => self.descend_beams::<Q, L, false>(beams, lanes),
            true => self.descend_beams::<Q, L, true>(beams, lanes),
        }
    }

    #[inline(never)]
    fn descend_beams<Q: Query, L: Lanes, const MIXED: bool>(&mut self, beams: &Beams, lanes: u32) {
        let bvh = self.bvh;
        let mut limits = beams.limits.to_array();
        let mut limit = beams.limits.greatest();
        self.state.parts.clear();
        let mut part = Part { near: 0.0, enter: (), child: bvh.root, lanes };
        loop {
            self.prefetch.step(LINES);
            let closer = match part.child.kind() {
                Kind::Node if part.lanes.count_ones() <= FEW => {
                    for lane in Bits(part.lanes) {
                        self.one::<Q, L>(&beams.one(lane), lane, part.child);
                    }
                    true
                }
                Kind::Node => {
                    self.children_of_beams::<MIXED>(beams, &part, f32x16::new(limits), limit);
                    false
                }
                _ => {
                    let limits = f32x16::new(limits);
                    let groups = Groups::<MIXED>::new(beams, part.lanes, limits, limit);
                    block::<Q, _>(self, part.child, &Together::<L>::new(&groups))
                }
            };
            if closer {
                for lane in Bits(part.lanes) {
                    limits[lane & 15] = self.state.furthest::<L>(RAYS * lane..RAYS * (lane + 1));
                }
                limit = f32x16::new(limits).greatest();
                if limit < 0.0 {
                    return;
                }
            }
            loop {
                let Some(&next) = self.state.parts.pop() else { return };
                let looking = LaneMask::bits(Lanes::ge(f32x16::new(limits), f32x16::splat(next.near)));
                part = Part { lanes: next.lanes & looking, ..next };
                if part.lanes != 0 {
                    break;
                }
            }
        }
    }

    /// Puts aside the children of a node that any of a part's beams meets.
    #[inline(always)]
    fn children_of_beams<const MIXED: bool>(&mut self, beams: &Beams, part: &Part<()>, limits: f32x16, limit: f32) {
        let node = &self.bvh.nodes[part.child.index()];
        let base = self.state.parts.len();
        let (enter, met) = beams.whole.meets::<MIXED>(|axis, near| node.faces(axis, near), f32x8::splat(limit));
        let enter = enter.to_array();
        for lane in Bits(met) {
            let lane = lane & 7;
            let lanes = part.lanes & beams.meets_child::<MIXED>(node, lane, limits);
            if lanes != 0 {
                let child = node.child[lane];
                self.places.fetch_child(child);
                self.state.parts.sort_in(base, Part { near: enter[lane], enter: (), child, lanes });
            }
        }
    }

    /// Traces one beam through a node and what is below.
    #[inline(always)]
    fn one<Q: Query, L: Lanes>(&mut self, beam: &Beam, lane: usize, from: Child) {
        match beam.mixed {
            false => self.descend::<Q, L, false>(beam, lane, from),
            true => self.descend::<Q, L, true>(beam, lane, from),
        }
    }

    #[inline(never)]
    fn descend<Q: Query, L: Lanes, const MIXED: bool>(&mut self, beam: &Beam, lane: usize, from: Child) {
        let bvh = self.bvh;
        let end = |walk: &Self| walk.state.furthest::<L>(RAYS * lane..RAYS * (lane + 1));
        let mut limit = end(self);
        self.state.stack.clear();
        let mut child = from;
        loop {
            self.prefetch.step(LINES);
            let closer = match child.kind() {
                Kind::Node => {
                    let node = &bvh.nodes[child.index()];
                    let (enter, met) = beam.meets::<MIXED>(|axis, near| node.faces(axis, near), f32x8::splat(limit));
                    if met != 0 {
                        self.places.fetch(node, met);
                        child = self.state.stack.nearest(node, &enter.to_array(), met).child();
                        continue;
                    }
                    false
                }
                _ => block::<Q, _>(self, child, &Together::<L>::new(&Group::<MIXED>::new(beam, lane, limit))),
            };
            if closer {
                limit = end(self);
                if limit < 0.0 {
                    return;
                }
            }
            match self.state.stack.pop(limit) {
                Some(next) => child = next.child(),
                None => return,
            }
        }
    }
}
