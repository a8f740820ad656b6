//! A scene's contents as a type: anything that it does not hold is not compiled into the loops over its lists.

use crate::geometry::Primitives;
use crate::scene::Scene;

/// The contents that a scene may have.
pub trait Contents: 'static {
    /// Whether there may be triangles.
    const TRIANGLES: bool;
    /// Whether there may be anything at all: other kinds, sides that are not there, methods by name, glass.
    const ALL: bool;
    /// Whether this holds for a scene's list.
    fn hold(scene: &Scene) -> bool {
        (Self::TRIANGLES || scene.triangles.is_empty()) && (Self::ALL || !scene.plan.rare)
    }
}

/// Planes and spheres.
pub struct Simple;

impl Contents for Simple {
    const TRIANGLES: bool = false;
    const ALL: bool = false;
}

/// Planes, spheres and triangles.
pub struct Meshes;

impl Contents for Meshes {
    const TRIANGLES: bool = true;
    const ALL: bool = false;
}

/// Anything.
pub struct Everything;

impl Contents for Everything {
    const TRIANGLES: bool = true;
    const ALL: bool = true;
}

/// Evaluates an expression with the type `$C` of a scene's contents, [`Everything`] where `$all`.
macro_rules! with_contents {
    ($scene:expr, $all:expr, $C:ident => $body:expr) => {
        match ($all, $crate::geometry::Primitives::is_empty(&$scene.triangles)) {
            (true, _) => {
                type $C = $crate::trace::contents::Everything;
                $body
            }
            (false, true) => {
                type $C = $crate::trace::contents::Simple;
                $body
            }
            (false, false) => {
                type $C = $crate::trace::contents::Meshes;
                $body
            }
        }
    };
}
pub(crate) use with_contents;
