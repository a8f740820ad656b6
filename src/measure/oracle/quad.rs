//! Parallelograms: t is a ratio, and every decision the sign of a polynomial.

use super::body::{Body, Crossing, Line, ball_around, exact3, height};
use super::exact::{Exact, along, cross, dot, minus, times};
use super::root::Root;
use crate::scene::Quad;
use glam::DVec3;

impl Body for Quad {
    /// corner + a u + b v, a and b from 0 to 1, both included.
    fn first(&self, line: &Line) -> Option<Crossing> {
        let (corner, u, v) = (exact3(self.corner)?, exact3(self.u)?, exact3(self.v)?);
        let normal = cross(&u, &v);
        let from_corner = minus(&line.origin, &corner);
        let (height, slope) = (-dot(&normal, &from_corner), dot(&normal, &line.direction));
        // The point from the corner, times the slope.
        let point = along(&times(&slope, &from_corner), &height, &line.direction);
        // a = (point × v)·n / n², b = (u × point)·n / n²
        let whole = &slope * dot(&normal, &normal);
        let share = |part: Exact| {
            let (part, whole) = if slope.sign().is_lt() { (-&part, -&whole) } else { (part, whole.clone()) };
            part.sign().is_ge() && part <= whole
        };
        let inside = share(dot(&cross(&point, &v), &normal)) && share(dot(&cross(&u, &point), &normal));
        let t = Root::ratio(height, slope)?;
        (inside && line.span.contains(&t)).then(|| Crossing { t: t.value(), normal })
    }

    fn tips(&self, _width: f64) -> Vec<DVec3> {
        let [corner, u, v] = [self.corner, self.u, self.v].map(|p| p.as_dvec3());
        vec![corner, corner + u, corner + v, corner + u + v]
    }

    fn ball(&self) -> Option<(DVec3, f64)> {
        Some(ball_around(&self.tips(0.0), 0.0))
    }

    fn thickness(&self) -> f64 {
        height(self.u.as_dvec3(), self.v.as_dvec3())
    }
}
