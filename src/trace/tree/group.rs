//! A group of rays together: a node is entered when the beam around them meets it.

use super::beam::Beam;
use super::leaf::{Group, block};
use super::walk::Walk;
use crate::bvh::Kind;
use crate::math::Lanes;
use crate::trace::query::Query;
use std::marker::PhantomData;
use std::ops::Range;
use wide::f32x8;

/// Cache lines of the next batch that are fetched at every step of the descent.
const LINES: usize = 8;

impl Walk<'_> {
    /// Traces the rays of a range, which all are in the beam.
    #[inline(always)]
    pub fn group<Q: Query, L: Lanes>(&mut self, beam: &Beam, range: Range<usize>) {
        match beam.mixed {
            false => self.descend::<Q, L, false>(beam, range),
            true => self.descend::<Q, L, true>(beam, range),
        }
    }

    #[inline(never)]
    fn descend<Q: Query, L: Lanes, const MIXED: bool>(&mut self, beam: &Beam, range: Range<usize>) {
        let bvh = self.bvh;
        let end = |walk: &Self| walk.state.furthest::<L>(range.clone());
        let mut limit = end(self);
        self.state.stack.clear();
        let mut child = bvh.root;
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
                _ => {
                    let group = Group::<L, MIXED> { beam, limit, range: range.clone(), lanes: PhantomData };
                    block::<Q, _>(self, child, &group)
                }
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
