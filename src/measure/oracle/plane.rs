//! Planes: t is a ratio.

use super::body::{Body, Crossing, Line, exact3};
use super::exact::{Exact, dot};
use super::root::Root;
use crate::scene::Plane;
use glam::DVec3;

impl Body for Plane {
    /// p·n + D = 0. A ray that runs in parallel hits nothing, not even from within.
    fn first(&self, line: &Line) -> Option<Crossing> {
        let normal = exact3(self.normal)?;
        let height = dot(&normal, &line.origin) + Exact::from_f32(self.distance)?;
        let t = Root::ratio(-&height, dot(&normal, &line.direction))?;
        line.span.contains(&t).then(|| Crossing { t: t.value(), normal })
    }

    fn tips(&self, _width: f64) -> Vec<DVec3> {
        vec![]
    }

    fn ball(&self) -> Option<(DVec3, f64)> {
        None
    }

    fn thickness(&self) -> f64 {
        f64::INFINITY
    }
}
