//! The source that a tree is built from.

use super::aabb::Aabb;
use super::block::Blocks;
use super::kind::Class;
use super::limits::BLOCK;

/// The source that a tree is built from: primitives 0, 1 … `len` − 1.
pub trait Source: Sync {
    /// The number of primitives, at most [`MAX_PRIMITIVES`](super::MAX_PRIMITIVES).
    fn len(&self) -> usize;
    /// Whether there is none.
    fn is_empty(&self) -> bool {
        self.len() == 0
    }
    /// A box around primitive `i`. What is not finite counts as ±[`f32::MAX`].
    fn bounds(&self, i: usize) -> Aabb;
    /// Shows the boxes around the pieces that primitive `i` is cut into: itself, if it is in one.
    #[inline(always)]
    fn pieces(&self, i: usize, mut show: impl FnMut(Aabb)) {
        show(self.bounds(i));
    }
    /// Whether any primitive is cut.
    fn cut(&self) -> bool {
        false
    }
    /// The class of primitive `i`.
    fn class(&self, i: usize) -> Class;
    /// Its id, which rises with `i`.
    fn id(&self, i: usize) -> u32;
    /// The blocks, by the ids of each; a list a kind, in the order of [`Kind::BLOCKS`](super::Kind::BLOCKS).
    fn blocks(&self, ids: &[Vec<[u32; BLOCK]>]) -> Blocks;
}
