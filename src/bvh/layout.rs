//! Wide nodes and blocks, in the order in which a traversal that goes left first comes by.

use super::build::{Binary, Tree};
use super::grain::Grain;
use super::kind::{Child, Kind};
use super::limits::{BLOCK, WIDTH};
use super::node::Node;
use super::source::Source;
use super::tree::Bvh;
use crate::math::NONE;

/// A binary subtree: the place of its node, and of its first primitive in the order.
#[derive(Clone, Copy, Debug, Default)]
struct Place {
    node: usize,
    first: usize,
}

struct Layout<'a, S> {
    source: &'a S,
    tree: &'a Tree,
    nodes: Vec<Node>,
    /// The ids of every block; a list for each of [`Kind::BLOCKS`].
    ids: Vec<Vec<[u32; BLOCK]>>,
    depth: usize,
    grain: Grain,
}

/// Wide nodes, the ids of the blocks, and what else is known of them.
pub(super) struct Arranged {
    pub nodes: Vec<Node>,
    /// A list for each of [`Kind::BLOCKS`].
    pub ids: Vec<Vec<[u32; BLOCK]>>,
    pub root: Child,
    pub depth: usize,
    pub grain: f32,
}

/// The tree as it is traversed.
pub(super) fn layout(source: &impl Source, tree: &Tree) -> Bvh {
    let Arranged { nodes, ids, root, depth, grain } = arrange(source, tree);
    Bvh { blocks: source.blocks(&ids), root, bounds: tree.nodes[0].bounds, depth, grain, nodes }
}

/// The nodes of a binary tree, eight children each, and what lies in the blocks.
pub(super) fn arrange(source: &impl Source, tree: &Tree) -> Arranged {
    let ids = vec![Vec::new(); Kind::BLOCKS.len()];
    let mut layout = Layout { source, tree, nodes: Vec::new(), ids, depth: 0, grain: Grain::default() };
    let root = layout.child(Place::default(), 1);
    let grain = layout.grain.of(tree.nodes[0].bounds);
    Arranged { nodes: layout.nodes, ids: layout.ids, root, depth: layout.depth, grain }
}

impl<S: Source> Layout<'_, S> {
    /// A subtree as one child; `depth` is that of a node here, counted from 1.
    fn child(&mut self, place: Place, depth: usize) -> Child {
        let binary = &self.tree.nodes[place.node];
        if binary.choices.is_block() {
            return self.leaf(place, binary);
        }
        let at = self.nodes.len();
        self.nodes.push(Node::EMPTY);
        self.depth = self.depth.max(depth);
        let mut places = [Place::default(); WIDTH];
        let mut len = 0;
        self.gather(place, WIDTH, &mut places, &mut len);
        for (lane, &place) in places[..len].iter().enumerate() {
            let child = self.child(place, depth + 1);
            self.nodes[at].set(lane, self.tree.nodes[place.node].bounds, child);
        }
        Child::new(Kind::Node, at)
    }

    /// The at most `children` children that a subtree is shown as.
    fn gather(&self, place: Place, children: usize, to: &mut [Place; WIDTH], len: &mut usize) {
        let mut children = children;
        let choices = self.tree.nodes[place.node].choices;
        while children > 1 && choices.left(children) == 0 {
            children -= 1;
        }
        if children == 1 {
            to[*len] = place;
            *len += 1;
            return;
        }
        let left = choices.left(children);
        let below = self.tree.nodes[place.node + 1].len as usize;
        self.gather(Place { node: place.node + 1, ..place }, left, to, len);
        let right = Place { node: place.node + 2 * below, first: place.first + below };
        self.gather(right, children - left, to, len);
    }

    fn leaf(&mut self, place: Place, binary: &Binary) -> Child {
        let class = self.source.class(self.tree.order[place.first] as usize);
        self.grain.add(binary.bounds, self.tree.nodes[0].bounds);
        let mut ids = [NONE; BLOCK];
        let order = &self.tree.order[place.first..][..binary.len as usize];
        ids.iter_mut().zip(order).for_each(|(id, &i)| *id = self.source.id(i as usize));
        ids.sort_unstable();
        // Pieces of one primitive are it but once.
        let mut last = 0;
        for at in 1..BLOCK {
            if ids[at] != ids[last] {
                last += 1;
                ids[last] = ids[at];
            }
        }
        ids[last + 1..].fill(NONE);
        let list = &mut self.ids[class.kind() as usize - 1];
        list.push(ids);
        Child::new(class.kind(), list.len() - 1)
    }
}
