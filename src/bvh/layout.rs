//! Wide nodes and blocks, in the order in which a traversal that goes left first comes by.

use super::aabb::Aabb;
use super::build::{Binary, Tree};
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
    /// The sums of the squares and the cubes of the blocks' sizes, but for the largest blocks.
    sizes: [f64; 2],
}

/// The tree as it is traversed.
pub(super) fn layout(source: &impl Source, tree: &Tree) -> Bvh {
    let ids = vec![Vec::new(); Kind::BLOCKS.len()];
    let mut layout = Layout { source, tree, nodes: Vec::new(), ids, depth: 0, sizes: [0.0; 2] };
    let root = layout.child(Place::default(), 1);
    Bvh {
        blocks: source.blocks(&layout.ids),
        root,
        bounds: tree.nodes[0].bounds,
        depth: layout.depth,
        grain: match layout.sizes {
            // All are large.
            [0.0, _] => (tree.nodes[0].bounds.max - tree.nodes[0].bounds.min).max_element() / 8.0,
            [squares, cubes] => (cubes / squares) as f32,
        },
        nodes: layout.nodes,
    }
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
        let size = self::size(binary.bounds);
        if size * 8.0 <= self::size(self.tree.nodes[0].bounds) {
            self.sizes[0] += size * size;
            self.sizes[1] += size * size * size;
        }
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

/// A box's largest extent, or the edge of a square of half its area if that is less: what is long and thin is met by as
/// few rays as a smaller square.
fn size(bounds: Aabb) -> f64 {
    bounds.area_f64().sqrt().min(f64::from((bounds.max - bounds.min).max_element()))
}
