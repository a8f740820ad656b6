//! A scene's primitives as the tree is built from them.

use super::Scene;
use crate::bvh::{self, Aabb, BLOCK, BlockList, Blocks, Class, Source};
use crate::geometry::{Bounded, Primitives, Variant};
use crate::kinds::for_each_kind;

/// All of a scene's primitives that have bounds, for the tree.
pub(super) struct InTree<'a>(pub &'a Scene);

macro_rules! source {
    (unbounded { $($unbounded:tt)* } bounded { $(($field:ident: $Storage:ident, $($rest:tt)*))* }) => {
        impl Source for InTree<'_> {
            fn len(&self) -> usize {
                0 $(+ self.0.$field.len())*
            }
            fn bounds(&self, i: usize) -> Aabb {
                let mut i = i;
                $(
                    if i < self.0.$field.len() {
                        let [min, max] = self.0.$field.around(i);
                        return Aabb { min, max };
                    }
                    i -= self.0.$field.len();
                )*
                unreachable!("{i} beyond the last primitive")
            }
            fn pieces(&self, i: usize, mut show: impl FnMut(Aabb)) {
                let mut i = i;
                $(
                    if i < self.0.$field.len() {
                        let kind = &self.0.$field;
                        let n = kind.pieces(i);
                        return (0..n).map(|k| kind.piece(i, k, n)).for_each(|[min, max]| show(Aabb { min, max }));
                    }
                    i -= self.0.$field.len();
                )*
                unreachable!("{i} beyond the last primitive")
            }
            fn cut(&self) -> bool {
                false $(|| (0..self.0.$field.len()).any(|i| self.0.$field.pieces(i) > 1))*
            }
            fn class(&self, i: usize) -> Class {
                let mut i = i;
                $(
                    if i < self.0.$field.len() {
                        return Class::new(bvh::Kind::$Storage, self.0.$field.variant(i).code());
                    }
                    i -= self.0.$field.len();
                )*
                unreachable!("{i} beyond the last primitive")
            }
            fn id(&self, i: usize) -> u32 {
                self.0.first.spheres + i as u32
            }
            fn blocks(&self, ids: &[Vec<[u32; BLOCK]>]) -> Blocks {
                let mut ids = ids.iter();
                let mut next = || ids.next().map_or(&[][..], |ids| &ids[..]);
                Blocks { $($field: BlockList::of(&self.0.$field, self.0.first.$field, next()),)* }
            }
        }
    };
}
for_each_kind!(source);
