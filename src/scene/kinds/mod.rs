//! A file a kind of primitive, with all that the description's side knows of it: what the user writes, its TOML table,
//! its rules, and what it means to the plan.
//!
//! A new kind is a row in `src/kinds.rs`, a file here with its description, its [`Kind`] and its table, and its module
//! below.

mod cone;
mod cuboid;
mod cylinder;
mod disc;
mod fractal;
mod plane;
mod quad;
mod sphere;
mod torus;
mod triangle;

use glam::Vec3;

use super::rules::At;
use super::{Description, Invalid, Plan, Sides};
use crate::bvh::Aabb;
use crate::geometry::methods::Methods;
use crate::kinds::for_each_kind;

/// The names of a kind of primitive and of its default method.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct KindName {
    /// One of them, as the scene file spells it: `box`.
    pub one: &'static str,
    /// Several: `boxes`.
    pub many: &'static str,
    /// Its default method, for a person.
    pub method: &'static str,
}

/// A kind of primitive as the user writes it: one value is one element of a scene file.
pub(crate) trait Kind: Sized {
    /// The kind's names.
    const NAME: KindName;
    /// The key of its array, as messages spell it.
    const KEY: &'static str = Self::NAME.one;
    /// The weight of a primitive when the plan decides whether a tree is faster (measured).
    const WEIGHT: usize = 4;
    /// Whether scenes of nothing rarer have kernels of their own, that test it.
    const PLAIN: bool = false;
    /// The arrays that it is traced from.
    type Storage: Default;

    /// Whether it is sound.
    fn check(&self, at: &At) -> Result<(), Invalid>;
    /// Tells all materials that it wears.
    fn materials(&self, wear: &mut impl FnMut(usize));
    /// Whether the shadow rays of a light may start there; `near` says so of a place, for something of a size.
    fn near(&self, near: &impl Fn(Vec3, f64) -> bool) -> bool;
    /// Which side of it is there.
    fn sides(&self) -> Sides {
        Sides::Both
    }
    /// How many primitives it is.
    fn count(&self) -> usize {
        1
    }

    /// Adds it to the arrays.
    fn store(&self, to: &mut Self::Storage);
    /// Tells the arrays by which methods they are tested.
    fn set_methods(_to: &mut Self::Storage, _methods: &Methods) {}
    /// A box around primitive `i` of the arrays; none for planes, spheres and triangles.
    fn bounds(of: &Self::Storage, i: usize) -> Option<Aabb>;

    /// The method that it is tested by, if it is not the default.
    fn other_method(_methods: &Methods) -> Option<&'static str> {
        None
    }
    /// Why by that method, where the scene decides it.
    fn reason(_plan: &Plan) -> Option<&str> {
        None
    }
}

/// Walks the list of kinds, and makes an array of what an expression gives for each:
/// `each_kind!(description, |all| all.len())`, where `all` is the slice of a kind's elements, or
/// `each_kind!(|K| K::NAME)`, where `K` is its type.
macro_rules! each_kind {
    (|$K:ident| $body:expr) => {
        $crate::kinds::for_each_kind! { each_kind @types $K ($body) }
    };
    ($description:expr, |$all:ident| $body:expr) => {
        $crate::kinds::for_each_kind! { each_kind @lists ($description) $all ($body) }
    };
    (@types $K:ident $body:tt $($group:ident {
        $(($storage:ident: $Storage:ident, $field:ident: $Kind:ident, $module:ident))*
    })*) => {
        [$($({
            type $K = $crate::scene::$Kind;
            $body
        },)*)*]
    };
    (@lists $description:tt $all:ident $body:tt $($group:ident {
        $(($storage:ident: $Storage:ident, $field:ident: $Kind:ident, $module:ident))*
    })*) => {
        [$($({
            let $all = $description.$field.as_slice();
            $body
        },)*)*]
    };
}
pub(super) use each_kind;

/// Makes the descriptions public, and checks that each kind has one.
macro_rules! descriptions {
    ($($group:ident { $(($storage:ident: $Storage:ident, $field:ident: $Kind:ident, $module:ident))* })*) => {
        $($(pub use self::$module::$Kind;)*)*
    };
}
for_each_kind! { descriptions }

/// The kinds of primitive, in the order of their ids.
pub const KINDS: &[KindName] = &each_kind!(|K| K::NAME);

impl Description {
    /// The numbers of primitives by kind, in the order of [`KINDS`]; a mesh counts by its triangles.
    pub fn counts(&self) -> [usize; KINDS.len()] {
        each_kind!(self, |all| all.iter().map(Kind::count).sum())
    }

    /// The number of primitives; their ids run from 0 to one less.
    pub fn primitives(&self) -> usize {
        self.counts().iter().sum()
    }
}

/// [`Kind::near`] of a triangle by a corner and the two edges from there: its size is its least height.
fn triangle_near(corner: Vec3, u: Vec3, v: Vec3, near: &impl Fn(Vec3, f64) -> bool) -> bool {
    let [e1, e2] = [u, v].map(|e| e.as_dvec3());
    let least_height = e1.cross(e2).length() / e1.length().max(e2.length()).max((e2 - e1).length());
    // A triangle without area casts no shadow.
    let nothing = least_height.is_nan() || least_height == 0.0;
    nothing || [corner, corner + u, corner + v].iter().all(|&p| near(p, least_height))
}
