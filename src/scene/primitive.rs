//! What a primitive's id stands for: an element of the description.

use super::kinds::Kind;
use super::{KindName, Scene};
use crate::geometry::Primitives;
use crate::kinds::for_each_kind;

/// A primitive of a compiled scene, by its place in the description that the scene was compiled from.
///
/// Whoever has ids of their own for what is in a scene keeps them in a list a kind, in the order of the description's,
/// and looks them up by `index`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub struct Primitive {
    /// What it is.
    pub kind: PrimitiveKind,
    /// Its place in the description's list of that kind: of a triangle, the place of its mesh in
    /// [`Description::meshes`](super::Description::meshes).
    pub index: usize,
    /// Of a triangle, its place in [`Mesh::triangles`](super::Mesh::triangles); 0 for all other kinds.
    pub triangle: usize,
    /// Its material, by its place in [`Scene::materials`].
    pub material: usize,
}

macro_rules! primitives {
    ($($group:ident { $(($storage:ident: $Storage:ident, $field:ident: $Kind:ident, $module:ident))* })*) => {
        /// A kind of primitive, in the order of the ids.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
        #[non_exhaustive]
        pub enum PrimitiveKind {
            $($(
                #[doc = concat!("An element of [`Description::", stringify!($field), "`](super::Description::",
                    stringify!($field), ").")]
                $Kind,
            )*)*
        }

        impl PrimitiveKind {
            /// Its names for a person, and that of its default method.
            pub fn name(self) -> KindName {
                match self {
                    $($(Self::$Kind => <super::$Kind as Kind>::NAME,)*)*
                }
            }
        }

        impl Scene {
            /// What the primitive with an id is; `None` for [`NONE`](crate::math::NONE) and ids that the scene does not
            /// have.
            pub fn primitive(&self, id: u32) -> Option<Primitive> {
                $($(
                    let i = id.wrapping_sub(self.first.$storage) as usize;
                    if i < self.$storage.len() {
                        return Some(self.element(PrimitiveKind::$Kind, i, self.$storage.material(i) as usize));
                    }
                )*)*
                None
            }
        }
    };
}
for_each_kind!(primitives);

impl Scene {
    /// Primitive `i` of a kind.
    fn element(&self, kind: PrimitiveKind, i: usize, material: usize) -> Primitive {
        if kind != PrimitiveKind::Mesh {
            return Primitive { kind, index: i, triangle: 0, material };
        }
        // The last mesh that begins no later; those without triangles begin where the next one does.
        let index = self.mesh_first.partition_point(|&first| first as usize <= i) - 1;
        Primitive { kind, index, triangle: i - self.mesh_first[index] as usize, material }
    }
}
