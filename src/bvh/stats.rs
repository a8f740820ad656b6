//! Statistics of a tree, for people.

use std::fmt;

use super::kind::{Child, Kind};
use super::tree::Bvh;
use crate::math::NONE;

/// The size and quality of a tree.
#[derive(Clone, Debug, PartialEq)]
pub struct Stats {
    /// Primitives in all blocks.
    pub primitives: usize,
    /// Wide nodes.
    pub nodes: usize,
    /// Blocks, for each of [`Kind::BLOCKS`].
    pub blocks: Vec<usize>,
    /// Mean number of children of a node; 0 without nodes.
    pub children: f64,
    /// Mean number of primitives of a block; 0 without blocks.
    pub fill: f64,
    /// Memory of nodes and blocks.
    pub bytes: usize,
    /// The most nodes on a way from the root to a block.
    pub depth: usize,
    /// Expected cost of a ray that meets the root's box, in visits of a node: the surface area heuristic with
    /// [`Kind::cost`]. 0 where that box has no area.
    pub sah: f64,
}

impl Stats {
    /// Bytes a primitive; 0 without primitives.
    pub fn bytes_per_primitive(&self) -> f64 {
        ratio(self.bytes, self.primitives)
    }
}

impl fmt::Display for Stats {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let kinds = Kind::BLOCKS.iter().zip(&self.blocks).filter(|(_, count)| **count > 0);
        let blocks: Vec<_> = kinds.map(|(kind, count)| format!("{count} of {}", kind.name())).collect();
        write!(
            f,
            "{} nodes with {:.1} children each, blocks: {}, with {:.1} primitives each, {:.0} bytes a primitive, depth \
             {}, SAH cost {:.1}",
            self.nodes,
            self.children,
            blocks.join(", "),
            self.fill,
            self.bytes_per_primitive(),
            self.depth,
            self.sah
        )
    }
}

fn ratio(a: usize, b: usize) -> f64 {
    if b == 0 { 0.0 } else { a as f64 / b as f64 }
}

impl Bvh {
    /// The number of primitives in a block.
    fn fill(&self, block: Child) -> usize {
        self.blocks.ids(block).iter().filter(|&&id| id != NONE).count()
    }

    fn cost(&self, child: Child) -> f64 {
        child.kind().cost(self.fill(child))
    }

    /// Looks at the whole tree.
    pub fn stats(&self) -> Stats {
        let (mut children, mut primitives, mut cost) = (0, 0, 0.0);
        let mut count = |child: Child, area: f64| {
            children += 1;
            cost += area * self.cost(child);
            if child.kind() != Kind::Node {
                primitives += self.fill(child);
            }
        };
        let whole = self.bounds.area_f64();
        if self.root != Child::EMPTY {
            count(self.root, whole);
        }
        for node in &self.nodes {
            (0..node.len()).for_each(|lane| count(node.child[lane], node.bounds(lane).area_f64()));
        }
        let blocks = self.blocks.counts();
        Stats {
            primitives,
            nodes: self.nodes.len(),
            // All but the root is somebody's child.
            children: ratio(children.max(1) - 1, self.nodes.len()),
            fill: ratio(primitives, blocks.iter().sum()),
            blocks,
            bytes: self.bytes(),
            depth: self.depth,
            sah: if whole > 0.0 { cost / whole } else { 0.0 },
        }
    }
}
