//! Discs: t is a ratio, and every decision the sign of a polynomial.

use super::body::{Body, Crossing, Line, exact3};
use super::exact::{Exact, along, dot, minus, times};
use super::root::Root;
use crate::scene::Disc;
use glam::DVec3;

impl Body for Disc {
    /// inner radius ≤ |p − center| ≤ radius in the plane, both included; the normal's length does not count.
    fn first(&self, line: &Line) -> Option<Crossing> {
        let (center, normal) = (exact3(self.center)?, exact3(self.normal)?);
        let f = minus(&line.origin, &center);
        let (height, slope) = (-dot(&normal, &f), dot(&normal, &line.direction));
        // The point from the middle, times the slope.
        let point = along(&times(&slope, &f), &height, &line.direction);
        let (out, scale) = (dot(&point, &point), slope.squared());
        let [inner, radius] = [Exact::from_f32(self.inner_radius)?, Exact::from_f32(self.radius)?];
        let within = inner.squared() * &scale <= out && out <= radius.squared() * &scale;
        let t = Root::ratio(height, slope)?;
        (within && line.span.contains(&t)).then(|| Crossing { t: t.value(), normal })
    }

    /// A hole that is smaller.
    fn tips(&self, width: f64) -> Vec<DVec3> {
        let inner = f64::from(self.inner_radius);
        if 0.0 < inner && inner < width { vec![self.center.as_dvec3()] } else { vec![] }
    }

    fn ball(&self) -> Option<(DVec3, f64)> {
        Some((self.center.as_dvec3(), self.radius.into()))
    }

    fn thickness(&self) -> f64 {
        let [inner, radius] = [self.inner_radius, self.radius].map(f64::from);
        if inner > 0.0 { radius - inner } else { 2.0 * radius }
    }
}
