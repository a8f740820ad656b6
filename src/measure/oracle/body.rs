//! The oracle's questions to every kind of primitive, and the helpers that their files share.

use std::cmp::Ordering;

use glam::{DVec3, Vec3};

use super::exact::{self, Exact, Exact3};
use super::root::Span;
use crate::scene::Sides;

/// A primitive.
pub trait Body {
    /// The nearest hit in the line's span.
    fn first(&self, line: &Line) -> Option<Crossing>;
    /// Points where a silhouette may end in a corner, or in something round that is smaller than `width`.
    fn tips(&self, width: f64) -> Vec<DVec3>;
    /// A ball around it; none around what has no end.
    fn ball(&self) -> Option<(DVec3, f64)>;
    /// The least width of it.
    fn thickness(&self) -> f64;
}

/// An element of a description: a primitive, or a mesh of them.
pub trait Described {
    /// The primitives' type.
    type Body: Body;
    /// The primitives, in the order of their ids.
    fn bodies(&self) -> impl Iterator<Item = Self::Body>;
}

impl<T: Body + Copy> Described for T {
    type Body = T;

    fn bodies(&self) -> impl Iterator<Item = T> {
        std::iter::once(*self)
    }
}

/// A ray for the primitives' tests.
pub struct Line {
    pub origin: Exact3,
    pub direction: Exact3,
    pub span: Span,
}

/// A hit: t to 2⁻⁹⁰ of itself or better, and the normal, of any length.
pub struct Crossing {
    pub t: Exact,
    pub normal: Exact3,
}

/// Whether a side is there, by the sign of the slope with which the ray's distance from it changes, outside being above 0.
pub fn visible(sides: Sides, slope: Ordering) -> bool {
    match sides {
        Sides::Both => true,
        Sides::Front => slope.is_le(),
        Sides::Back => slope.is_ge(),
    }
}

/// `None` where a component is not finite.
pub fn exact3(v: Vec3) -> Option<Exact3> {
    exact::vector(v.as_dvec3())
}

/// A ball around points that are that much thicker.
pub fn ball_around(points: &[DVec3], more: f64) -> (DVec3, f64) {
    let center = points.iter().sum::<DVec3>() / points.len() as f64;
    let radius = points.iter().map(|p| p.distance(center)).fold(0.0, f64::max);
    (center, radius + more)
}

/// The least height of the triangle that two vectors span.
pub fn height(u: DVec3, v: DVec3) -> f64 {
    u.cross(v).length() / u.length().max(v.length()).max((u - v).length())
}
