//! Cylinders.

use super::body::{Body, Crossing, Line, ball_around};
use super::frustum::Frustum;
use crate::scene::Cylinder;
use glam::DVec3;

impl Body for Cylinder {
    fn first(&self, line: &Line) -> Option<Crossing> {
        let Self { base, apex, caps, sides, .. } = *self;
        Frustum { base, apex, radii: [self.radius; 2], caps, sides }.first(line)
    }

    fn tips(&self, _width: f64) -> Vec<DVec3> {
        vec![]
    }

    fn ball(&self) -> Option<(DVec3, f64)> {
        Some(ball_around(&[self.base.as_dvec3(), self.apex.as_dvec3()], self.radius.into()))
    }

    fn thickness(&self) -> f64 {
        (2.0 * f64::from(self.radius)).min(self.base.as_dvec3().distance(self.apex.as_dvec3()))
    }
}
