//! Tori: with q = p − center, the axis w of any length, A = q² + R² − r² and ρ² = |q × w|² / w², a point is on the torus
//! where w² A² − 4 R² |q × w|² = 0: a quartic in t with exact coefficients.

use super::body::{Body, Crossing, Line, exact3};
use super::exact::{Exact, along, cross, dot, minus, times};
use super::polynomial::Sturm;
use crate::scene::Torus;
use glam::DVec3;

/// t is known to 2⁻⁹⁰ of itself, and the point to as much of the minor radius.
const NARROW: isize = 90;

impl Body for Torus {
    /// A tangent, which is a double root, is a hit.
    fn first(&self, line: &Line) -> Option<Crossing> {
        let (f, w) = (minus(&line.origin, &exact3(self.center)?), exact3(self.axis)?);
        let (major, minor) = (Exact::from_f32(self.major_radius)?, Exact::from_f32(self.minor_radius)?);
        let d = &line.direction;
        let (d2, fd, f2) = (dot(d, d), dot(&f, d), dot(&f, &f));
        // A sphere around it.
        let passes = fd.squared() < &d2 * (&f2 - (&major + &minor).squared());
        let w2 = dot(&w, &w);
        if passes || w2.is_zero() {
            return None;
        }
        let offset = major.squared() - minor.squared();
        let [a0, a1, a2] = [&f2 + &offset, fd.scaled(1), d2.clone()];
        let (x, y) = (cross(&f, &w), cross(d, &w));
        let four = major.squared().scaled(2);
        let [b0, b1, b2] = [dot(&x, &x), dot(&x, &y).scaled(1), dot(&y, &y)].map(|b| &four * b);
        let quartic = [
            &w2 * a0.squared() - b0,
            &w2 * (&a0 * &a1).scaled(1) - b1,
            &w2 * ((&a0 * &a2).scaled(1) + a1.squared()) - b2,
            &w2 * (&a1 * &a2).scaled(1),
            &w2 * a2.squared(),
        ];
        let sturm = Sturm::new(&quartic)?;
        let bound = sturm.bound();
        let low = line.span.low.clone().map_or(-&bound, |low| low.max(-&bound));
        let high = line.span.high.clone().map_or(bound.clone(), |high| high.min(bound));
        // In units of t.
        let radius = minor.magnitude() - (d2.magnitude() + 1) / 2;
        let t = sturm.first_root(low, high, |low, high| {
            (high - low).magnitude() + NARROW <= high.magnitude().min(low.magnitude()).min(radius)
        })?;
        let q = along(&f, &t, d);
        // A quarter of the gradient; on a horn torus's middle, where it is 0, the axis.
        let radial = minus(&times(&w2, &q), &times(&dot(&q, &w), &w));
        let outward = times(&(&w2 * (dot(&q, &q) + offset)), &q);
        let gradient = minus(&outward, &times(&major.squared().scaled(1), &radial));
        let normal = if gradient.iter().all(Exact::is_zero) { w } else { gradient };
        Some(Crossing { t, normal })
    }

    fn tips(&self, width: f64) -> Vec<DVec3> {
        let hole = f64::from(self.major_radius) - f64::from(self.minor_radius);
        if hole < width { vec![self.center.as_dvec3()] } else { vec![] }
    }

    fn ball(&self) -> Option<(DVec3, f64)> {
        Some((self.center.as_dvec3(), f64::from(self.major_radius) + f64::from(self.minor_radius)))
    }

    fn thickness(&self) -> f64 {
        2.0 * f64::from(self.minor_radius)
    }
}
