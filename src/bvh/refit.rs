//! A tree over primitives that have moved: the same nodes and blocks, with new boxes and numbers.

use rayon::prelude::*;

use super::aabb::Aabb;
use super::grain::Grain;
use super::kind::{Child, Class, Kind};
use super::limits::BLOCK;
use super::refs::Ref;
use super::source::Source;
use super::tree::Bvh;
use crate::math::NONE;

impl Bvh {
    /// Takes the primitives as they are now, in the caller's rayon pool. Ids and classes are those that the tree was
    /// built from; `first` is the id of the source's first.
    pub(crate) fn refit(&mut self, source: &impl Source, first: u32) {
        let ids = self.blocks.lists();
        let around = |block: &[u32; BLOCK]| {
            let ids = block.iter().take_while(|&&id| id != NONE);
            // As the builder takes boxes. Of a primitive in pieces all is taken, since which piece it was is forgotten.
            let finite = |bounds| Ref::new(0, bounds, Class(0)).bounds().aabb();
            ids.map(|id| finite(source.bounds((id - first) as usize))).fold(Aabb::EMPTY, Aabb::union)
        };
        let boxes: Vec<Vec<Aabb>> =
            ids.iter().map(|list| list.par_iter().with_min_len(256).map(around).collect()).collect();
        self.blocks = source.blocks(&ids);
        let nodes = &mut self.nodes;
        for at in (0..nodes.len()).rev() {
            let mut node = nodes[at];
            for lane in 0..node.len() {
                let child = node.child[lane];
                let bounds = match child.kind() {
                    Kind::Node => nodes[child.index()].around(),
                    kind => boxes[kind as usize - 1][child.index()],
                };
                node.set(lane, bounds, child);
            }
            nodes[at] = node;
        }
        self.bounds = match self.root {
            Child::EMPTY => Aabb::EMPTY,
            root if root.kind() == Kind::Node => self.nodes[root.index()].around(),
            root => boxes[root.kind() as usize - 1][root.index()],
        };
        let mut grain = Grain::default();
        boxes.iter().flatten().for_each(|&block| grain.add(block, self.bounds));
        self.grain = if self.root == Child::EMPTY { 0.0 } else { grain.of(self.bounds) };
    }
}
