//! A group of rays together: a node is entered when the beam around them meets it.

use crate::bvh::Kind;
use crate::math::Lanes;
use std::ops::Range;
use wide::f32x8;

use super::Walk;
use super::beam::Beam;

/// Cache lines of the next batch that are fetched at every step of the descent and for every triangle.
pub const LINES: usize = 8;

impl Walk<'_> {
    /// Traces the rays of a range, which all are in the beam.
    #[inline(always)]
    pub fn group<L: Lanes, const ANY: bool, const RARE: bool>(&mut self, beam: &Beam, range: Range<usize>) {
        match beam.mixed {
            false => self.descend::<L, ANY, RARE, false>(beam, range),
            true => self.descend::<L, ANY, RARE, true>(beam, range),
        }
    }

    #[inline(never)]
    fn descend<L: Lanes, const ANY: bool, const RARE: bool, const MIXED: bool>(
        &mut self,
        beam: &Beam,
        range: Range<usize>,
    ) {
        let bvh = self.bvh;
        let end = |walk: &Self| walk.state.furthest::<L>(range.clone());
        let mut limit = end(self);
        self.state.stack.clear();
        let mut child = bvh.root;
        loop {
            let i = child.index();
            self.ahead.step(LINES);
            let closer = match child.kind() {
                Kind::Node => {
                    let node = &bvh.nodes[i];
                    let (enter, met) = beam.meets::<MIXED>(|axis, near| node.faces(axis, near), f32x8::splat(limit));
                    if met != 0 {
                        bvh.fetch(node, met);
                        child = self.state.stack.nearest(node, &enter.to_array(), met).child();
                        continue;
                    }
                    false
                }
                Kind::Triangles => self.triangles::<L, ANY, RARE, MIXED>(&bvh.triangles[i], beam, limit, range.clone()),
                Kind::Spheres => self.spheres::<L, ANY, RARE, MIXED>(&bvh.spheres[i], beam, limit, range.clone()),
                Kind::Others => self.others::<L, ANY>(i, range.clone()),
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
