//! One ray against eight boxes, triangles or spheres at a time.

use super::alone::Alone;
use super::leaf::block;
use super::line::Line;
use super::walk::Walk;
use crate::bvh::{Child, Kind};
use crate::trace::query::Query;
use wide::f32x8;

impl Walk<'_> {
    /// Traces ray `i` through a node and what is below, unless it is done; its [`Line`] is known.
    #[inline(never)]
    pub fn single<Q: Query>(&mut self, i: usize, from: Child) {
        let mut limit = self.state.t[i];
        if limit.is_nan() || limit < 0.0 {
            return;
        }
        let bvh = self.bvh;
        let line = Line::new(&self.state.lines, i);
        let ray = Alone::new(self, i);
        self.state.stack.clear();
        let mut child = from;
        loop {
            let closer = match child.kind() {
                Kind::Node => {
                    let node = &bvh.nodes[child.index()];
                    let (enter, met) = line.meets(node, f32x8::splat(limit));
                    if met != 0 {
                        self.places.fetch(node, met);
                        let (stack, enter) = (&mut self.state.stack, enter.to_array());
                        let next = if Q::ANY { stack.any(node, &enter, met) } else { stack.nearest(node, &enter, met) };
                        child = next.child();
                        continue;
                    }
                    false
                }
                _ => block::<Q, _>(self, child, &ray),
            };
            if closer {
                limit = self.state.t[i];
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
