//! Primitives side by side, as many as a node has children, and the lists of them by kind.

use std::fmt;

use super::kind::{Child, Kind};
use super::limits::BLOCK;
use crate::geometry::*;
use crate::kinds::for_each_kind;
use crate::math::NONE;

/// Up to eight primitives of one kind and variant, side by side; ids ascend.
///
/// Unused lanes repeat the first primitive; their id is [`NONE`].
#[repr(C, align(32))]
pub struct Block<K: Primitives> {
    /// Primitive ids.
    pub id: [u32; BLOCK],
    /// Their numbers, a column each.
    pub shape: K::Shape<[f32; BLOCK]>,
}

impl<K: Primitives> Clone for Block<K> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<K: Primitives> Copy for Block<K> {}

impl<K: Primitives> fmt::Debug for Block<K> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Block").field("id", &self.id).finish_non_exhaustive()
    }
}

impl<K: Primitives> Block<K> {
    /// Of the primitives with these ids, of which `first` is the kind's first; at least one.
    fn new(kind: &K, first: u32, id: [u32; BLOCK]) -> Self {
        let shape = |lane: usize| kind.shape((id[lane] - first) as usize);
        let mut columns = K::map(&shape(0), |number| [*number; BLOCK]);
        for lane in (1..BLOCK).take_while(|&lane| id[lane] != NONE) {
            columns = K::zip(&columns, &shape(lane), |column: &[f32; BLOCK], number| {
                let mut column = *column;
                column[lane] = *number;
                column
            });
        }
        Self { id, shape: columns }
    }

    /// The number of primitives.
    pub fn len(&self) -> usize {
        self.id.iter().take_while(|&&id| id != NONE).count()
    }

    /// Whether there is none; no tree has such a block.
    pub fn is_empty(&self) -> bool {
        self.id[0] == NONE
    }

    /// The numbers of one primitive.
    #[inline(always)]
    pub fn primitive(&self, lane: usize) -> K::Shape<f32> {
        K::map(&self.shape, |column: &[f32; BLOCK]| column[lane & (BLOCK - 1)])
    }
}

/// All blocks of a kind.
#[derive(Clone, Debug)]
pub struct BlockList<K: Primitives> {
    /// The blocks.
    pub blocks: Vec<Block<K>>,
    variants: Variants<K::Variant>,
}

/// The blocks' variants; a scene in which all are alike pays for none.
#[derive(Clone, Debug, PartialEq)]
enum Variants<V> {
    Same(V),
    Each(Vec<V>),
}

impl<K: Primitives + Sync> BlockList<K> {
    /// Of primitives of a kind, whose first has the id `first`, by the ids of each block.
    pub fn of(kind: &K, first: u32, ids: &[[u32; BLOCK]]) -> Self {
        use rayon::prelude::*;
        let blocks = ids.par_iter().with_min_len(256).map(|&id| Block::new(kind, first, id)).collect();
        let variant = |id: &[u32; BLOCK]| kind.variant((id[0] - first) as usize);
        let one = ids.first().map(variant).unwrap_or_default();
        let variants = match ids.iter().all(|id| variant(id) == one) {
            true => Variants::Same(one),
            false => Variants::Each(ids.iter().map(variant).collect()),
        };
        Self { blocks, variants }
    }
}

impl<K: Primitives> BlockList<K> {
    /// The variant of all primitives of block `i`.
    #[inline(always)]
    pub fn variant(&self, i: usize) -> K::Variant {
        match &self.variants {
            Variants::Same(variant) => *variant,
            Variants::Each(variants) => variants[i],
        }
    }

    /// The memory of the blocks.
    pub fn bytes(&self) -> usize {
        let variants = match &self.variants {
            Variants::Same(_) => 0,
            Variants::Each(variants) => size_of_val(&variants[..]),
        };
        size_of_val(&self.blocks[..]) + variants
    }
}

impl<K: Primitives> Default for BlockList<K> {
    fn default() -> Self {
        Self { blocks: Vec::new(), variants: Variants::Same(K::Variant::default()) }
    }
}

macro_rules! blocks {
    (unbounded { $($unbounded:tt)* } bounded { $(($field:ident: $Storage:ident, $($rest:tt)*))* }) => {
        /// All blocks, by kind.
        #[derive(Clone, Debug, Default)]
        pub struct Blocks {
            $(#[doc = concat!("Of ", stringify!($field), ".")] pub $field: BlockList<$Storage>,)*
        }

        impl Blocks {
            /// The number of blocks of each of [`Kind::BLOCKS`].
            pub fn counts(&self) -> Vec<usize> {
                vec![$(self.$field.blocks.len()),*]
            }

            /// The memory of all.
            pub fn bytes(&self) -> usize {
                0 $(+ self.$field.bytes())*
            }

            /// The ids in a block; nothing for a node.
            pub fn ids(&self, block: Child) -> &[u32; BLOCK] {
                match block.kind() {
                    $(Kind::$Storage => &self.$field.blocks[block.index()].id,)*
                    Kind::Node | Kind::Nothing => &[NONE; BLOCK],
                }
            }

            /// The ids of every block; a list for each of [`Kind::BLOCKS`].
            pub(super) fn lists(&self) -> Vec<Vec<[u32; BLOCK]>> {
                vec![$(self.$field.blocks.iter().map(|block| block.id).collect()),*]
            }

            /// Shows the ids that the first block of each kind begins with, and the bytes of a block.
            pub(super) fn places<'a>(&'a self, mut show: impl FnMut(Kind, &'a [u32], usize)) {
                $(if let Some(block) = self.$field.blocks.first() {
                    show(Kind::$Storage, &block.id, size_of::<Block<$Storage>>());
                })*
            }
        }
    };
}
for_each_kind!(blocks);
