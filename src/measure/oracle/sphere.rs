//! Spheres: a quadratic, with f = o − center: d² t² + 2 (f·d) t + f² − r² = 0.

use super::body::{Body, Crossing, Line, exact3, visible};
use super::exact::{Exact, along, dot, minus};
use super::root::Root;
use crate::scene::Sphere;
use glam::DVec3;

impl Body for Sphere {
    /// A tangent is a hit, on either side.
    fn first(&self, line: &Line) -> Option<Crossing> {
        let f = minus(&line.origin, &exact3(self.center)?);
        let d = &line.direction;
        let c = dot(&f, &f) - Exact::from_f32(self.radius)?.squared();
        let roots = Root::quadratic(dot(d, d), dot(&f, d), &c);
        let (t, _) = roots.into_iter().find(|(t, slope)| visible(self.sides, *slope) && line.span.contains(t))?;
        let t = t.value();
        Some(Crossing { normal: along(&f, &t, d), t })
    }

    fn tips(&self, _width: f64) -> Vec<DVec3> {
        vec![]
    }

    fn ball(&self) -> Option<(DVec3, f64)> {
        Some((self.center.as_dvec3(), self.radius.into()))
    }

    fn thickness(&self) -> f64 {
        2.0 * f64::from(self.radius)
    }
}
