//! A tree over boxes of the caller's own, for geometry that this crate does not know.
//!
//! Built as the scene's tree is, but every box is a child of a node, so that it is tested itself, eight side by side,
//! and only then the caller's code is asked. How rays go through it stands in `trace`.

use super::aabb::Aabb;
use super::block::Blocks;
use super::kind::{Child, Class, Kind};
use super::layout::{Arranged, arrange};
use super::limits::{BLOCK, MAX_DEPTH, MAX_PRIMITIVES, WIDTH};
use super::node::Node;
use super::refs::Ref;
use super::source::Source;
use super::{build, refs};
use crate::math::NONE;

/// A tree over boxes, each of which is known by its place in the slice that the tree was built from.
///
/// What the boxes are around is the caller's matter: rays ask it by a closure, in
/// [`intersect`](BoxTree::intersect), [`occluded`](BoxTree::occluded) and [`traverse`](BoxTree::traverse).
#[derive(Clone, Debug)]
pub struct BoxTree {
    /// The root first, a node after its parent; children that are no nodes are boxes, by their places.
    nodes: Vec<Node>,
    bounds: Aabb,
    len: usize,
}

/// The kind that a box is counted as: one so dear that the builder keeps every primitive apart.
const AS: Kind = Kind::Tori;

impl BoxTree {
    /// Builds the tree, in the caller's rayon pool; it is the same for every number of threads.
    ///
    /// A coordinate that is not finite counts as ±[`f32::MAX`]. A box that is empty ([`Aabb::EMPTY`]) is met by no ray
    /// that starts in or near the other boxes.
    ///
    /// # Panics
    /// With more than [`MAX_PRIMITIVES`] boxes.
    pub fn build(boxes: &[Aabb]) -> Self {
        assert!(boxes.len() <= MAX_PRIMITIVES, "too many boxes");
        let mut tree = Self { nodes: Vec::new(), bounds: Aabb::EMPTY, len: boxes.len() };
        if boxes.is_empty() {
            return tree;
        }
        let source = Boxes(boxes);
        let binary = build::build(refs::collect(&source), MAX_DEPTH);
        tree.bounds = binary.nodes[0].bounds;
        let Arranged { nodes, ids, root, .. } = arrange(&source, &binary);
        tree.nodes = nodes;
        let ids = &ids[AS as usize - 1];
        if root.kind() != Kind::Node {
            tree.add_leaf(boxes, &ids[root.index()]);
            return tree;
        }
        for at in 0..tree.nodes.len() {
            for lane in 0..WIDTH {
                let child = tree.nodes[at].child[lane];
                if child != Child::EMPTY && child.kind() != Kind::Node {
                    tree.nodes[at].child[lane] = match ids[child.index()] {
                        [only, NONE, ..] => Child::new(AS, only as usize),
                        ref several => tree.add_leaf(boxes, several),
                    };
                }
            }
        }
        tree
    }

    /// A node of boxes that the builder would not part, as they coincide.
    fn add_leaf(&mut self, boxes: &[Aabb], ids: &[u32; BLOCK]) -> Child {
        let mut node = Node::EMPTY;
        for (lane, &id) in ids.iter().take_while(|&&id| id != NONE).enumerate() {
            node.set(lane, finite(boxes[id as usize]), Child::new(AS, id as usize));
        }
        self.nodes.push(node);
        Child::new(Kind::Node, self.nodes.len() - 1)
    }

    /// Takes new boxes for the same things, and makes the tree's own fit: much faster than building it anew, in time
    /// proportional to the number of boxes. Answers are those of a tree built anew, but the more the things have moved
    /// against each other, the slower they come.
    ///
    /// # Panics
    /// When there are more or fewer boxes than the tree was built from.
    pub fn refit(&mut self, boxes: &[Aabb]) {
        assert_eq!(boxes.len(), self.len, "a box for each");
        for at in (0..self.nodes.len()).rev() {
            let mut node = self.nodes[at];
            for lane in 0..node.len() {
                let child = node.child[lane];
                let bounds = match child.kind() {
                    Kind::Node => self.nodes[child.index()].around(),
                    _ => finite(boxes[child.index()]),
                };
                node.set(lane, bounds, child);
            }
            self.nodes[at] = node;
        }
        self.bounds = self.nodes.first().map_or(Aabb::EMPTY, Node::around);
    }

    /// The number of boxes.
    pub fn len(&self) -> usize {
        self.len
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.len == 0
    }

    /// The box around all.
    pub fn bounds(&self) -> Aabb {
        self.bounds
    }

    /// The nodes; children that are not of [`Kind::Node`] are boxes, by their places.
    pub(crate) fn nodes(&self) -> &[Node] {
        &self.nodes
    }
}

/// A box as the builder takes it.
fn finite(bounds: Aabb) -> Aabb {
    Ref::new(0, bounds, Class::new(AS, 0)).bounds().aabb()
}

/// The boxes as a source; their ids are their places.
struct Boxes<'a>(&'a [Aabb]);

impl Source for Boxes<'_> {
    fn len(&self) -> usize {
        self.0.len()
    }
    fn bounds(&self, i: usize) -> Aabb {
        self.0[i]
    }
    fn class(&self, _: usize) -> Class {
        Class::new(AS, 0)
    }
    fn id(&self, i: usize) -> u32 {
        i as u32
    }
    fn blocks(&self, _: &[Vec<[u32; BLOCK]>]) -> Blocks {
        Blocks::default()
    }
}
