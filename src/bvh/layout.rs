//! Wide nodes and blocks, in the order in which a traversal that goes left first comes by.

use rayon::prelude::*;

use super::build::{Binary, Tree};
use super::{BLOCK, Bvh, Child, Class, Node, OtherBlock, Source, SphereBlock, TriangleBlock, WIDTH};
use crate::math::NONE;

/// A binary subtree: the place of its node, and of its first primitive in the order.
#[derive(Clone, Copy, Debug, Default)]
struct Place {
    node: usize,
    first: usize,
}

/// A block to be filled.
#[derive(Clone, Copy, Debug)]
struct Leaf {
    first: u32,
    len: u32,
}

struct Layout<'a, S> {
    source: &'a S,
    tree: &'a Tree,
    nodes: Vec<Node>,
    /// A list a class.
    leaves: [Vec<Leaf>; 3],
    depth: usize,
    /// The sums of the squares and the cubes of the blocks' largest extents, but for the largest blocks.
    extents: [f64; 2],
}

/// The tree as it is traversed.
pub(super) fn layout(source: &impl Source, tree: &Tree) -> Bvh {
    let mut layout =
        Layout { source, tree, nodes: Vec::new(), leaves: [const { Vec::new() }; 3], depth: 0, extents: [0.0; 2] };
    let root = layout.child(Place::default(), 1);
    let [triangles, spheres, others] = &layout.leaves;
    let indices = |leaf: &Leaf| {
        let mut indices = [0; BLOCK];
        let indices_of = &tree.order[leaf.first as usize..][..leaf.len as usize];
        indices[..indices_of.len()].copy_from_slice(indices_of);
        indices[..indices_of.len()].sort_unstable();
        (indices, indices_of.len())
    };
    Bvh {
        triangles: fill(triangles, |leaf| triangle_block(source, indices(leaf))),
        spheres: fill(spheres, |leaf| sphere_block(source, indices(leaf))),
        others: fill(others, |leaf| other_block(source, indices(leaf))),
        root,
        bounds: tree.nodes[0].bounds,
        depth: layout.depth,
        grain: match layout.extents {
            // All are large.
            [0.0, _] => (tree.nodes[0].bounds.max - tree.nodes[0].bounds.min).max_element() / 8.0,
            [squares, cubes] => (cubes / squares) as f32,
        },
        nodes: layout.nodes,
    }
}

fn fill<B: Send>(leaves: &[Leaf], make: impl Fn(&Leaf) -> B + Sync + Send) -> Vec<B> {
    leaves.par_iter().with_min_len(256).map(make).collect()
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
        Child::node(at)
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
        let bounds = binary.bounds;
        let all = self.tree.nodes[0].bounds;
        let extent = f64::from((bounds.max - bounds.min).max_element());
        if extent * 8.0 <= f64::from((all.max - all.min).max_element()) {
            self.extents[0] += extent * extent;
            self.extents[1] += extent * extent * extent;
        }
        let leaves = &mut self.leaves[class as usize];
        let at = leaves.len();
        leaves.push(Leaf { first: place.first as u32, len: binary.len });
        match class {
            Class::Triangle => Child::triangles(at),
            Class::Sphere => Child::spheres(at),
            Class::Other => Child::others(at),
        }
    }
}

fn triangle_block(source: &impl Source, (indices, len): ([u32; BLOCK], usize)) -> TriangleBlock {
    let mut block = TriangleBlock::EMPTY;
    for (lane, &i) in indices[..len].iter().enumerate() {
        let corners = source.triangle(i as usize);
        block.id[lane] = source.id(i as usize);
        for (columns, corner) in block.corners.iter_mut().zip(corners) {
            columns.iter_mut().zip(corner.to_array()).for_each(|(column, value)| column[lane] = value);
        }
    }
    block
}

fn sphere_block(source: &impl Source, (indices, len): ([u32; BLOCK], usize)) -> SphereBlock {
    let mut block = SphereBlock::EMPTY;
    for (lane, &i) in indices[..len].iter().enumerate() {
        let (center, radius) = source.sphere(i as usize);
        block.id[lane] = source.id(i as usize);
        block.radius[lane] = radius;
        block.center.iter_mut().zip(center.to_array()).for_each(|(column, value)| column[lane] = value);
    }
    block
}

fn other_block(source: &impl Source, (indices, len): ([u32; BLOCK], usize)) -> OtherBlock {
    let mut block = OtherBlock { id: [NONE; BLOCK] };
    block.id.iter_mut().zip(&indices[..len]).for_each(|(id, &i)| *id = source.id(i as usize));
    block
}
