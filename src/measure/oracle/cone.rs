//! Cones and frusta.

use super::body::{Body, Crossing, Line, ball_around};
use super::frustum::Frustum;
use crate::scene::Cone;
use glam::DVec3;

impl Body for Cone {
    fn first(&self, line: &Line) -> Option<Crossing> {
        let Self { base, apex, caps, sides, .. } = *self;
        Frustum { base, apex, radii: [self.base_radius, self.apex_radius], caps, sides }.first(line)
    }

    fn tips(&self, width: f64) -> Vec<DVec3> {
        let [base, apex] = [(self.base_radius, self.base), (self.apex_radius, self.apex)];
        let (radius, tip) = if base.0 < apex.0 { base } else { apex };
        if f64::from(radius) < width { vec![tip.as_dvec3()] } else { vec![] }
    }

    fn ball(&self) -> Option<(DVec3, f64)> {
        let more = self.base_radius.max(self.apex_radius);
        Some(ball_around(&[self.base.as_dvec3(), self.apex.as_dvec3()], more.into()))
    }

    fn thickness(&self) -> f64 {
        let wide = 2.0 * f64::from(self.base_radius.max(self.apex_radius));
        wide.min(self.base.as_dvec3().distance(self.apex.as_dvec3()))
    }
}
