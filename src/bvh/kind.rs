//! The kinds of a node's children: blocks of a kind of primitive, or nodes.

use super::limits::{INDEX_BITS, MAX_PRIMITIVES, NODE_COST};
use crate::geometry::Bounded;
use crate::kinds::for_each_kind;

macro_rules! kinds {
    (unbounded { $($unbounded:tt)* } bounded { $(($field:ident: $Storage:ident, $($rest:tt)*))* }) => {
        /// The kind of a child.
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub enum Kind {
            /// A node.
            Node,
            $(#[doc = concat!("A block of ", stringify!($field), ".")] $Storage,)*
            /// Nothing.
            Nothing,
        }

        impl Kind {
            /// All kinds of blocks, in the order of their primitives' ids.
            pub const BLOCKS: &[Self] = &[$(Self::$Storage),*];

            /// As it is called.
            pub fn name(self) -> &'static str {
                match self {
                    Self::Node => "nodes",
                    $(Self::$Storage => stringify!($field),)*
                    Self::Nothing => "nothing",
                }
            }

            /// The cost of a visit: of a block itself, and of each of its primitives.
            fn costs(self) -> [f64; 2] {
                match self {
                    $(Self::$Storage => <crate::geometry::$Storage as Bounded>::COST,)*
                    Self::Node | Self::Nothing => [NODE_COST, 0.0],
                }
            }

            /// By the number in a [`Child`].
            pub(super) const BY_NUMBER: [Self; 16] = {
                let mut kinds = [Self::Nothing; 16];
                kinds[0] = Self::Node;
                $(kinds[Self::$Storage as usize] = Self::$Storage;)*
                kinds
            };
        }
    };
}
for_each_kind!(kinds);

impl Kind {
    /// The cost of a block of so many, or of a node, for a ray that visits it: in visits of a node.
    pub fn cost(self, len: usize) -> f64 {
        let [block, primitive] = self.costs();
        block + primitive * len as f64
    }
}

/// The class that primitives of a block have in common: a kind and a variant of it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Class(pub(super) u16);

impl Class {
    /// Of a kind and the code of a variant, which is below 32.
    pub fn new(kind: Kind, code: u8) -> Self {
        Self((kind as u16) << 5 | u16::from(code & 31))
    }

    /// The cost of a block of so many for a ray that visits it.
    pub fn cost(self, len: usize) -> f64 {
        self.kind().cost(len)
    }

    /// The kind.
    pub fn kind(self) -> Kind {
        Kind::BY_NUMBER[usize::from(self.0 >> 5) & 15]
    }
}

/// A child of a node: what it is in the four highest bits, and an index in the others: of a node, or of a block of its
/// kind.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Child(u32);

impl Child {
    /// No child. Its box is empty; a ray with an infinite margin may ask nonetheless, and finds nothing.
    pub const EMPTY: Self = Self(u32::MAX);

    /// The node or block `i` of its kind.
    pub fn new(kind: Kind, i: usize) -> Self {
        debug_assert!(i <= MAX_PRIMITIVES);
        Self((kind as u32) << INDEX_BITS | i as u32)
    }

    /// The child's kind; [`Kind::Nothing`] for [`Child::EMPTY`].
    #[inline(always)]
    pub fn kind(self) -> Kind {
        Kind::BY_NUMBER[self.number()]
    }

    /// The number of its kind, below 16.
    #[inline(always)]
    pub(super) fn number(self) -> usize {
        (self.0 >> INDEX_BITS) as usize
    }

    /// As a number.
    #[inline(always)]
    pub(crate) fn bits(self) -> u32 {
        self.0
    }

    /// From [`Child::bits`].
    #[inline(always)]
    pub(crate) fn from_bits(bits: u32) -> Self {
        Self(bits)
    }

    /// Which one of its kind.
    #[inline(always)]
    pub fn index(self) -> usize {
        (self.0 & (u32::MAX >> (32 - INDEX_BITS))) as usize
    }
}
