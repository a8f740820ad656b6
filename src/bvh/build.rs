//! The binary tree: split until a block is filled.

use glam::Vec3A;
use rayon::join;

use super::aabb::{Aabb, Bounds};
use super::bins::Bins;
use super::collapse::{Choices, Costs};
use super::kind::Class;
use super::limits::BLOCK;
use super::refs::{Extent, Ref};

/// A range of one class that is no longer is not split further.
const SMALLEST: usize = 2;
/// The longest range that is not split further where there are more than [`MANY`] primitives: all that a block holds. By the
/// heuristic that costs rays 1 to 2 % (on a height field of a million triangles), but a third of the memory is saved, and so
/// rays are 5 to 10 % faster.
const SMALLEST_OF_MANY: usize = BLOCK;
/// Primitives that cost more visits of a node than this are split down to single ones: rings gain 4 %.
const DEAR: f64 = 3.0;
/// From here on memory and building matter more than the last per cent.
const MANY: usize = 1 << 15;
/// Ranges of this length and more are worth a task of their own.
const TASK: usize = 1 << 12;

/// A node of the binary tree.
///
/// A range of n primitives owns 2 n − 1 places: its node, then its left part's, then its right part's. So the tree
/// needs no links, and threads write to slices of their own.
#[derive(Clone, Copy, Debug)]
pub(super) struct Binary {
    pub bounds: Aabb,
    /// The number of primitives below.
    pub len: u32,
    /// How it becomes wide nodes and blocks.
    pub choices: Choices,
}

impl Default for Binary {
    fn default() -> Self {
        Self { bounds: Aabb { min: glam::Vec3::ZERO, max: glam::Vec3::ZERO }, len: 0, choices: Choices::default() }
    }
}

/// The finished binary tree over `order`, a permutation of the primitives.
pub(super) struct Tree {
    pub nodes: Vec<Binary>,
    pub order: Vec<u32>,
}

/// The result of building a subtree.
struct Done {
    costs: Costs,
    /// The class of its primitives, if they have one in common.
    class: Option<Class>,
}

/// A range to build a subtree over.
struct Range<'a> {
    refs: &'a mut [Ref],
    /// As long as `refs`: where the parts go.
    spare: &'a mut [Ref],
    order: &'a mut [u32],
    nodes: &'a mut [Binary],
    extent: Extent,
    /// How many levels may follow below; at least ⌈log₂⌉ of the number of primitives.
    levels: usize,
    /// How long a range is not split any more.
    smallest: usize,
}

/// Builds the tree, at most `levels` deep; there must be at least one primitive and at most 2^`levels`.
pub(super) fn build(mut refs: Vec<Ref>, levels: usize) -> Tree {
    let len = refs.len();
    let mut spare = vec![Ref::default(); len];
    let mut tree = Tree { nodes: vec![Binary::default(); 2 * len - 1], order: vec![0; len] };
    let extent = extent(&refs);
    let smallest = if len > MANY { SMALLEST_OF_MANY } else { SMALLEST };
    let range = Range {
        refs: &mut refs,
        spare: &mut spare,
        order: &mut tree.order,
        nodes: &mut tree.nodes,
        extent,
        levels,
        smallest,
    };
    subtree(range, &mut Bins::default());
    tree
}

fn extent(refs: &[Ref]) -> Extent {
    if refs.len() < 2 * TASK {
        return Extent::of(refs);
    }
    let (a, b) = refs.split_at(refs.len() / 2);
    let (a, b) = join(|| extent(a), || extent(b));
    a.union(b)
}

fn subtree(range: Range, bins: &mut Bins) -> Done {
    let len = range.refs.len();
    let bounds = range.extent.bounds.aabb();
    let one_class = len <= BLOCK && range.refs.iter().all(|r| r.class() == range.refs[0].class());
    // Single primitives that cost more than the steps to them.
    let smallest = if range.refs[0].class().cost(1) > DEAR { 1 } else { range.smallest };
    if one_class && len <= smallest {
        range.order.iter_mut().zip(range.refs.iter()).for_each(|(to, r)| *to = r.index());
        range.nodes[0] = Binary { bounds, len: len as u32, choices: Choices::LEAF };
        return Done { costs: Costs::leaf(bounds, range.refs[0].class(), len), class: Some(range.refs[0].class()) };
    }
    if range.coincides() {
        return coincident(range.refs, range.order, range.nodes, bounds);
    }
    let ([left, right], node) = range.split(bins, one_class);
    let (left, right) = if len >= TASK {
        join(|| subtree(left, &mut Bins::default()), || subtree(right, &mut Bins::default()))
    } else {
        (subtree(left, bins), subtree(right, bins))
    };
    let class = left.class.filter(|_| left.class == right.class);
    let (costs, choices) = Costs::parent(&left.costs, &right.costs, bounds, class.map(|class| (class, len)));
    *node = Binary { bounds, len: len as u32, choices };
    Done { costs, class }
}

/// A subtree of primitives of one class that all have the same box. A ray that meets one meets all, so nothing is gained by
/// parting them: they fill blocks, in the order that they come in, and time is linear in their number.
fn coincident(refs: &[Ref], order: &mut [u32], nodes: &mut [Binary], bounds: Aabb) -> Done {
    let (len, class) = (refs.len(), refs[0].class());
    if len <= BLOCK {
        order.iter_mut().zip(refs).for_each(|(to, r)| *to = r.index());
        nodes[0] = Binary { bounds, len: len as u32, choices: Choices::LEAF };
        return Done { costs: Costs::leaf(bounds, class, len), class: Some(class) };
    }
    // As many full blocks as make a full tree.
    let left = BLOCK * len.div_ceil(BLOCK).next_power_of_two() / 2;
    let (a, b) = order.split_at_mut(left);
    let (node, below) = nodes.split_first_mut().expect("a range has nodes");
    let (c, d) = below.split_at_mut(2 * left - 1);
    let left = coincident(&refs[..left], a, c, bounds);
    let right = coincident(&refs[refs.len() - b.len()..], b, d, bounds);
    let (costs, choices) = Costs::parent(&left.costs, &right.costs, bounds, None);
    *node = Binary { bounds, len: len as u32, choices };
    Done { costs, class: Some(class) }
}

impl<'a> Range<'a> {
    /// Whether all primitives have the same box and class.
    fn coincides(&self) -> bool {
        self.extent.centers.min == self.extent.centers.max && self.refs.iter().all(|r| r.coincides(&self.refs[0]))
    }

    /// The two parts, and the place of the range's own node.
    fn split(self, bins: &mut Bins, one_class: bool) -> ([Self; 2], &'a mut Binary) {
        let len = self.refs.len();
        // Halving by count takes ⌈log₂ len⌉ levels down to single primitives: free choice ends when just these are
        // left.
        let free = (len.next_power_of_two().ilog2() as usize) < self.levels;
        let (left, extents) = if free && len <= BLOCK && !one_class {
            let class = self.refs[0].class();
            let side = |of_class| {
                let side = self.refs.iter().filter(|r| (r.class() == class) == of_class);
                side.fold(Bounds::EMPTY, |a, r| a.union(r.bounds()))
            };
            partition(self.refs, self.spare, [side(true), side(false)], |r, _| r.class() == class)
        } else if let Some(split) = free.then(|| bins.split(self.refs, &self.extent)).flatten() {
            partition(self.refs, self.spare, split.sides, |_, center| split.is_left(center))
        } else {
            self.spare.copy_from_slice(self.refs);
            let (left, right) = self.refs.split_at(len / 2);
            (left.len(), [Extent::of(left), Extent::of(right)])
        };
        // The parts are in the spare memory now, and what they were copied from is spare.
        let (refs, spare) = (self.spare.split_at_mut(left), self.refs.split_at_mut(left));
        let order = self.order.split_at_mut(left);
        let (node, nodes) = self.nodes.split_first_mut().expect("a range has nodes");
        let nodes = nodes.split_at_mut(2 * left - 1);
        let (levels, smallest) = (self.levels - 1, self.smallest);
        let [a, b] = extents;
        let left = Range { refs: refs.0, spare: spare.0, order: order.0, nodes: nodes.0, extent: a, levels, smallest };
        let right = Range { refs: refs.1, spare: spare.1, order: order.1, nodes: nodes.1, extent: b, levels, smallest };
        ([left, right], node)
    }
}

/// Copies the primitives of the left side from the front on, the others from the back on, and finds the boxes around
/// their middles; `sides` are the boxes around the primitives themselves.
#[inline(always)]
fn partition(
    from: &[Ref],
    to: &mut [Ref],
    sides: [Bounds; 2],
    is_left: impl Fn(&Ref, Vec3A) -> bool,
) -> (usize, [Extent; 2]) {
    let [mut a, mut b] = [Bounds::EMPTY; 2];
    let (mut left, mut right) = (0, to.len());
    for r in from {
        let center = r.center();
        let is_left = is_left(r, center);
        right -= usize::from(!is_left);
        to[if is_left { left } else { right }] = *r;
        left += usize::from(is_left);
        // Without a branch, which would be guessed wrong half the time: a point at infinity widens nothing.
        let away = if is_left { [0.0, f32::INFINITY] } else { [f32::INFINITY, 0.0] };
        a.min = a.min.min(center + away[0]);
        a.max = a.max.max(center - away[0]);
        b.min = b.min.min(center + away[1]);
        b.max = b.max.max(center - away[1]);
    }
    (left, [Extent { bounds: sides[0], centers: a }, Extent { bounds: sides[1], centers: b }])
}
