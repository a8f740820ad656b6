//! A compiled scene whose things have moved: the tree is kept, and its boxes fit again.

use std::time::Instant;

use super::in_tree::InTree;
use super::{Description, Invalid, Scene, Structure};
use crate::bvh::Bvh;
use crate::geometry::Primitives;
use crate::kinds::for_each_kind;

/// Why a scene cannot be made to fit a description. The scene is as it was.
#[derive(Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum RefitError {
    /// The description has a fault.
    #[error(transparent)]
    Invalid(#[from] Invalid),
    /// There are more or fewer primitives of a kind.
    #[error("{found} {kind} where the scene was compiled from {compiled}")]
    Count {
        /// The kind, by the name of several.
        kind: &'static str,
        /// How many there are now.
        found: usize,
        /// How many the scene has.
        compiled: usize,
    },
    /// Primitives of a kind have other sides, or other variants of what they are: no longer caps, say.
    #[error("some of the {kind} are of another variant than those that the scene was compiled from")]
    Variant {
        /// The kind, by the name of several.
        kind: &'static str,
    },
}

macro_rules! unlike {
    ($($group:ident { $(($storage:ident: $Storage:ident, $field:ident: $Kind:ident, $module:ident))* })*) => {
        /// How the primitives differ but in their numbers, if they do.
        fn unlike(old: &Scene, new: &Scene) -> Option<RefitError> {
            $($(
                let (kind, was, is) = (stringify!($storage), &old.$storage, &new.$storage);
                if was.len() != is.len() {
                    return Some(RefitError::Count { kind, found: is.len(), compiled: was.len() });
                }
                if (0..was.len()).any(|i| was.variant(i) != is.variant(i)) {
                    return Some(RefitError::Variant { kind });
                }
            )*)*
            None
        }
    };
}
for_each_kind!(unlike);

impl Scene {
    /// Takes a description that differs from the one that the scene was compiled from only in where things are, how
    /// large they are, and in all that is no primitive: new vertex positions of meshes, say, or another light.
    /// Primitives keep their ids.
    ///
    /// Answers and pictures are those of a scene compiled anew, to the bit. Where the scene has a tree ([`Scene::bvh`])
    /// this is faster than [`compile`](super::compile()), as the tree is not built but only its boxes are made to
    /// fit. The more the things have moved against each other since the tree was built, the slower rays become:
    /// [`Stats::sah`](crate::bvh::Stats::sah) of [`Bvh::stats`](crate::bvh::Bvh::stats) tells by how much. Cylinders
    /// and cones that the tree had cut into pieces are found by larger boxes afterwards. [`Scene::build_time`] is then
    /// the time this took the tree. It works in the caller's rayon pool, and holds the arrays and blocks twice while it
    /// does.
    ///
    /// # Errors
    /// [`RefitError`] when the description is not sound, or primitives have come, gone or changed their variant. The
    /// scene is as it was then.
    pub fn refit(&mut self, description: &Description) -> Result<(), RefitError> {
        let mut new = Self::without_tree(description, &self.options)?;
        if let Some(fault) = unlike(self, &new) {
            return Err(fault);
        }
        if new.plan.structure == Structure::Tree {
            let started = Instant::now();
            new.bvh = Some(match self.bvh.take() {
                Some(mut bvh) => {
                    bvh.refit(&InTree(&new), new.first.spheres);
                    bvh
                }
                None => Bvh::build(&InTree(&new)),
            });
            new.build_time = started.elapsed();
        }
        *self = new;
        Ok(())
    }
}
