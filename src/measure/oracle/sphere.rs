//! Spheres: a quadratic, with f = o − center: d² t² + 2 (f·d) t + f² − r² = 0.

use super::exact::{Exact, along, dot, minus};
use super::root::Root;
use super::{Crossing, Line, exact3, visible};
use crate::scene::Sphere;

/// A tangent is a hit, on either side.
pub fn sphere(sphere: &Sphere, line: &Line) -> Option<Crossing> {
    let f = minus(&line.origin, &exact3(sphere.center)?);
    let d = &line.direction;
    let c = dot(&f, &f) - Exact::from_f32(sphere.radius)?.squared();
    let roots = Root::quadratic(dot(d, d), dot(&f, d), &c);
    let (t, _) = roots.into_iter().find(|(t, slope)| visible(sphere.sides, *slope) && line.span.contains(t))?;
    let t = t.value();
    Some(Crossing { normal: along(&f, &t, d), t })
}
