//! The truth that fast intersection methods are judged against: the nearest hit of one ray and one primitive, decided
//! exactly.
//!
//! The `f32` numbers of the primitive and the ray count as exact. They are whole multiples of powers of two, so every
//! polynomial of them can be, and is, computed without rounding, in whole numbers of any length; whether there is a hit
//! inside the interval, and which comes first, follows from signs alone. Only the answer is rounded. Nothing here is
//! shared with the methods that are judged, or with [`reference`](mod@crate::reference).
//!
//! | primitive | what t is | how it is decided |
//! |---|---|---|
//! | plane, triangle, quad, disc, box | a ratio | signs and cross products of ratios |
//! | sphere, cylinder, cone | (a ± √d) / c | the same, and squares |
//! | torus | a root of a quartic | Sturm's theorem; double roots by the greatest common divisor |
//! | fractal | a ratio | from plane to plane of its grid |
//!
//! One thing cannot be exact: a turned box, whose angles are degrees. Its axes are sines and cosines rounded to multiples
//! of 2⁻³⁸⁴ (quarter turns are exact), which turns it by less than 2⁻³⁷⁰; the box so turned counts as exact.
//!
//! # What counts as a hit
//!
//! A hit lies in the open interval (`t_min`, `t_max`). Surfaces are closed sets: edges, corners, rims and tips belong
//! to them, and a ray that only touches hits. A sphere's, cylinder's or cone's touching ray hits whichever side is
//! there. A ray within a plane, triangle, quad, disc or the side of a cylinder or cone hits nothing of it. Boxes and
//! fractals are solid: a ray meets them where it enters or leaves the closed body, also when it glides in a face; a
//! cylinder's or cone's caps are closed discs.
//!
//! A ray or primitive with NaN or infinity (but for an infinite `t_max`, or `t_min` = −∞) and a direction of length 0 miss.
//!
//! # What t is
//!
//! The parameter along the direction as it is given: a hit is at origin + t · direction, exactly. A method that only
//! solves for t, as those of plane, triangle, quad, disc, box, cylinder, cone and fractal do, answers that question
//! whatever the direction's length. A method that counts on |direction| = 1 and leaves it out of its formulae
//! ([`crate::geometry::sphere`], [`crate::geometry::torus`]) answers neither this question nor the one for the
//! normalised direction: with a length of 1 + δ its t is off by some δ t, and by δ t² / (r cos θ) where a term like t²
//! takes part in a cancellation, as in the textbook's quadratic for a sphere of radius r at incidence θ. δ is up to 4 ε
//! for the rays this program makes and up to 84 ε for ray files (ε = 2⁻²⁴). So that all methods are judged by one
//! question, t is along the direction as given unless asked otherwise; where δ matters, judge them on rays with small
//! δ, or ask for world units by [`Ray::normalized`]. The hits are at the same places; t and the interval then count in
//! units that differ by δ.

mod body;
mod cone;
mod cuboid;
mod cylinder;
mod disc;
mod exact;
mod fractal;
mod frustum;
mod plane;
mod polynomial;
mod quad;
mod root;
mod settled;
mod sphere;
mod torus;
mod triangle;
mod turn;

use std::cmp::Ordering;

use glam::{DVec3, Vec3};

use crate::kinds::for_each_kind;
use crate::scene::{self, Description};
use body::{Body, Crossing, Described, Line, exact3};
use exact::Exact;
use root::Span;
pub use settled::{Answers, around, settled};
pub use triangle::Triangle;

/// Makes [`Shape`] and [`shapes`] of the list. A variant has its description's name; what a mesh holds are triangles.
macro_rules! shapes {
    (unbounded { $($unbounded:tt)* } bounded { $($bounded:tt)* }) => { shapes!([] $($unbounded)* $($bounded)*); };
    ([$($done:tt)*] ($storage:ident: $Storage:ident, meshes: Mesh, $module:ident) $($rest:tt)*) => {
        shapes!([$($done)* (meshes: Triangle, Triangle)] $($rest)*);
    };
    ([$($done:tt)*] ($storage:ident: $Storage:ident, $field:ident: $Kind:ident, $module:ident) $($rest:tt)*) => {
        shapes!([$($done)* ($field: $Kind, scene::$Kind)] $($rest)*);
    };
    ([$(($field:ident: $Variant:ident, $Body:ty))*]) => {
        /// A primitive, as the description has it.
        #[derive(Clone, Debug, PartialEq)]
        pub enum Shape {
            $(
                #[doc = concat!("Of [`Description::", stringify!($field), "`].")]
                $Variant($Body),
            )*
        }

        impl Shape {
            fn body(&self) -> &dyn Body {
                match self {
                    $(Self::$Variant(it) => it,)*
                }
            }
        }

        /// All primitives of a description, by id. A triangle that names a vertex that does not exist is none, as it
        /// has no area.
        pub fn shapes(scene: &Description) -> Vec<Shape> {
            let mut all = Vec::with_capacity(scene.primitives());
            $(all.extend(scene.$field.iter().flat_map(Described::bodies).map(Shape::$Variant));)*
            all
        }
    };
}
for_each_kind!(shapes);

/// A ray.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ray {
    /// Where it starts.
    pub origin: Vec3,
    /// Where it goes; of any length but zero.
    pub direction: Vec3,
    /// Whether t counts in world units, along direction / |direction|, and not in the direction's own length. The interval
    /// and t are then scaled by the length to 320 bits, which is the only rounding beside the last.
    pub normalized: bool,
}

impl Ray {
    /// A ray whose t counts along the direction as it is.
    pub fn new(origin: Vec3, direction: Vec3) -> Self {
        Self { origin, direction, normalized: false }
    }
}

/// The nearest hit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Truth {
    /// The exact t, correctly rounded, except where it is closer than 2⁻⁹⁰ of itself to the middle between two numbers:
    /// then it is one of these.
    pub t: f64,
    /// Unit geometric normal at the exact hit, each component off by at most 2⁻⁵¹: outward, or as described or wound, not
    /// turned to the ray. On an edge, that of one of the faces; at a tip, and in the middle of a torus without a hole,
    /// along the axis.
    pub normal: DVec3,
}

/// The nearest hit at `t_min` < t < `t_max`, if there is one.
///
/// In a release build it takes 3 to 20 µs, and 0.1 ms for a turned box or a torus. A fractal takes 5 µs, and some 0.5 µs
/// more for every plane of its grid that the ray passes until it hits, of which there are up to 3 · 3^iterations.
pub fn nearest(shape: &Shape, ray: &Ray, t_min: f64, t_max: f64) -> Option<Truth> {
    nearest_from(shape, ray.origin.as_dvec3(), ray, [t_min, t_max])
}

/// The nearest hit of a ray that starts at `origin` instead of its own.
fn nearest_from(shape: &Shape, origin: DVec3, ray: &Ray, interval: [f64; 2]) -> Option<Truth> {
    let (origin, direction) = (exact::vector(origin)?, exact3(ray.direction)?);
    let square = exact::dot(&direction, &direction);
    if square.is_zero() || interval[0].partial_cmp(&interval[1]) != Some(Ordering::Less) {
        return None;
    }
    let length = if ray.normalized { square.sqrt() } else { Exact::integer(1) };
    let bound = |t: f64| Exact::from_f64(t).map(|t| if ray.normalized { t.quotient(&length) } else { t });
    let span = Span { low: bound(interval[0]), high: bound(interval[1]) };
    let Crossing { t, normal } = shape.body().first(&Line { origin, direction, span })?;
    Some(Truth { t: (t * length).to_f64(), normal: exact::unit(&normal) })
}

#[cfg(test)]
mod tests;
