//! A group of rays together: a node is entered when the beam around them meets it.

use crate::bvh::Kind;
use crate::math::Lanes;
use std::ops::Range;
use wide::f32x8;

use super::Walk;
use super::beam::Beam;

impl Walk<'_> {
    /// Traces the rays of a range, which all are in the beam.
    #[inline(never)]
    pub fn group<L: Lanes, const ANY: bool, const RARE: bool>(&mut self, beam: &Beam, range: Range<usize>) {
        let bvh = self.bvh;
        let end = |walk: &Self| walk.state.furthest::<L>(range.clone()) + beam.slack;
        let mut limit = end(self);
        self.state.stack.start(bvh.root);
        while let Some((enter, child)) = self.state.stack.pop() {
            if enter > limit {
                // The others lie no nearer than this one, but for those of nodes further up.
                continue;
            }
            let i = child.index();
            let closer = match child.kind() {
                Kind::Node => {
                    let node = &bvh.nodes[i];
                    let (enter, met) = beam.children(node, f32x8::splat(limit));
                    self.state.stack.push(node, &enter.to_array(), met);
                    continue;
                }
                Kind::Triangles => self.triangles::<L, ANY, RARE>(&bvh.triangles[i], beam, limit, range.clone()),
                Kind::Spheres => self.spheres::<L, ANY, RARE>(&bvh.spheres[i], beam, limit, range.clone()),
                Kind::Others => self.others::<L, ANY>(i, range.clone()),
            };
            if closer {
                limit = end(self);
                if limit < 0.0 {
                    return;
                }
            }
        }
    }
}
