//! One ray's answer against the truth.

use std::f64::consts::TAU;

use raypacket::measure::cases::Ray;
use raypacket::measure::oracle::{self, Answers, Shape, Truth, around, nearest};
use raypacket::scene::Scene;

use crate::common::ROUNDOFF;
use crate::{Found, at, bounds, surface};

/// Rays around one that is looked at more closely.
const RING: u32 = 16;

/// What came of a ray.
#[derive(Clone, Copy, Debug, Default)]
pub struct Verdict {
    /// Whether the answer is not the exact one, up to the documented error of t.
    pub differs: bool,
    /// Whether no ray in the neighbourhood has it either.
    pub wrong: bool,
    /// The neighbourhood that explains a difference, in parts of the documented one; only where it is asked for.
    pub needs: f64,
    /// Of a hit that is the true one.
    pub hit: Option<Hit>,
}

/// How a true hit is off.
#[derive(Clone, Copy, Debug)]
pub struct Hit {
    /// The error of t, in ulps of the true one.
    pub ulps: f64,
    /// The same in parts of the documented bound.
    pub share: f64,
    /// (D + |o|) / (t cos θ), for triangles and quads also over the sine of the smallest angle: rounding is some ε times
    /// that, in parts of t.
    pub condition: f64,
    /// D over the primitive's size.
    pub distance: f64,
    /// The normal's error, in degrees.
    pub degrees: f64,
}

/// A ray, its answer and the truth of every primitive.
pub struct Judge<'a> {
    pub scene: &'a Scene,
    pub shapes: &'a [Shape],
    pub ray: &'a Ray,
    pub found: Found,
    truths: Vec<Option<Truth>>,
}

impl<'a> Judge<'a> {
    pub fn new(scene: &'a Scene, shapes: &'a [Shape], ray: &'a Ray, found: Found) -> Self {
        let truths = shapes.iter().map(|shape| truth(shape, ray)).collect();
        Self { scene, shapes, ray, found, truths }
    }

    /// The nearest true hit; of equals the first.
    fn best(&self) -> Option<(usize, Truth)> {
        let hits = self.truths.iter().enumerate().filter_map(|(id, truth)| truth.map(|truth| (id, truth)));
        hits.min_by(|a, b| a.1.t.total_cmp(&b.1.t))
    }

    /// k ε (D + |o|), or `part` of it.
    fn width(&self, id: usize, part: f64) -> f64 {
        let answers = [self.truths[id].map(|truth| truth.t), self.found.map(|(t, _)| t.into())];
        part * bounds::k(&self.shapes[id]) * ROUNDOFF * bounds::scale(&self.shapes[id], self.ray, answers)
    }

    pub fn verdict(&self, look_closer: bool) -> Verdict {
        let best = self.best();
        let agrees = match (self.found, best) {
            (None, None) => true,
            (Some((t, id)), Some((_, best))) => self.truths[id].is_some_and(|own| {
                let error = bounds::error_of_t(&self.shapes[id], self.ray, &own);
                (f64::from(t) - own.t).abs() <= error && (own.t - best.t).abs() <= 2.0 * error
            }),
            _ => false,
        };
        let hit = self.found.and_then(|(t, id)| Some(self.measure(t, id, self.truths[id].as_ref()?)));
        if agrees {
            return Verdict { hit, ..Verdict::default() };
        }
        // Neighbourhoods nest, their samples do not.
        let wrong = ![1.0, 0.25, 0.0625].into_iter().any(|part| self.explained(part));
        let parts = (-4..=14).map(|e| 2f64.powi(e));
        let needs = if look_closer { parts.into_iter().find(|&part| self.explained(part)) } else { None };
        let needs = needs.unwrap_or(if look_closer { f64::INFINITY } else { 0.0 });
        Verdict { differs: true, wrong, needs, hit }
    }

    fn measure(&self, t: f32, id: usize, truth: &Truth) -> Hit {
        let shape = &self.shapes[id];
        let error = (f64::from(t) - truth.t).abs();
        let scale = bounds::scale(shape, self.ray, [Some(truth.t), None]);
        let far = scale - self.ray.origin.as_dvec3().abs().max_element();
        let distance = far / bounds::size(shape);
        let found = glam::Vec3::from(surface(self.scene, shape, id, at(self.ray, t)).normal).as_dvec3();
        // Of two crossings, one of which is a matter of rounding, the answer may be the other.
        let cosine = bounds::cosine(self.ray, truth).min(self.ray.line().1.dot(found).abs());
        let along = truth.t.min(t.into()) * cosine * bounds::angle(shape);
        let condition = scale / along;
        let degrees = |n: glam::DVec3| found.cross(n).length().atan2(found.dot(n)).to_degrees();
        let mut off = degrees(truth.normal);
        // Next to an edge the answer's face and the true one may differ: that is a decision.
        if off > 0.1 && distance < 1e4 {
            let near = self.ring(self.width(id, 1.0));
            let near: Vec<_> = near.iter().filter_map(|ray| truth_of(shape, ray)).collect();
            off = near.iter().map(|truth| degrees(truth.normal)).fold(off, f64::min);
            // At a silhouette's edge the other face is one that no ray meets.
            off = if near.len() < RING as usize { f64::NAN } else { off };
        }
        let share = error / bounds::error_of_t(shape, self.ray, truth);
        Hit { ulps: error / bounds::ulp(truth.t), share, condition, distance, degrees: off }
    }

    /// Rays on a circle around the ray, as well as `f32` can tell: where `width` is a few of its steps, well.
    fn ring(&self, width: f64) -> Vec<Ray> {
        let (origin, direction) = self.ray.line();
        let (a, b) = direction.any_orthonormal_pair();
        let moved = |i| {
            let (sin, cos) = (TAU * f64::from(i) / f64::from(RING)).sin_cos();
            Ray { origin: (origin + width * (cos * a + sin * b)).as_vec3(), ..*self.ray }
        };
        (0..RING).map(moved).collect()
    }

    /// Whether the answer is right for some ray of the neighbourhood.
    fn explained(&self, part: f64) -> bool {
        match self.found {
            Some((t, id)) => self.hit_explained(f64::from(t), id, part),
            None => self.miss_explained(part),
        }
    }

    fn around(&self, id: usize, width: f64) -> Answers {
        around(&self.shapes[id], &exact(self.ray), self.ray.t_min.into(), self.ray.t_max.into(), width)
    }

    fn hit_explained(&self, t: f64, id: usize, part: f64) -> bool {
        let width = self.width(id, part);
        // Along the ray the place is as uncertain as across it, and t is rounded.
        let slack = width.max(bounds::plane_off(&self.shapes[id], self.ray)) + 8.0 * ROUNDOFF * t;
        let own = match self.around(id, width) {
            Answers::Hit { low, high } => low - slack <= t && t <= high + slack,
            // The samples may all miss where rays that hit are few: along the side of an open tube.
            Answers::Miss | Answers::Mixed => {
                self.ring_has(t, id, width, slack)
                    || self.line_has(t, id, width, slack)
                    || self.on_surface(t, id, slack)
            }
        };
        let nearer = |(other, truth): (usize, &Option<Truth>)| {
            let width = self.width(other, part);
            let before = t - slack - width;
            other != id
                && truth.is_some_and(|truth| truth.t < before)
                && matches!(self.around(other, width), Answers::Hit { high, .. } if high < before)
        };
        own && !self.truths.iter().enumerate().any(nearer)
    }

    /// Whether t lies between those of rays nearby; of what is so small that they pass around it, whether the place at t
    /// is within `slack` of the ball around it.
    fn ring_has(&self, t: f64, id: usize, width: f64, slack: f64) -> bool {
        let shape = &self.shapes[id];
        let near: Vec<_> = self.ring(width).iter().filter_map(|ray| truth(shape, ray)).chain(self.truths[id]).collect();
        let low = near.iter().map(|truth| truth.t).fold(f64::INFINITY, f64::min);
        let high = near.iter().map(|truth| truth.t).fold(0.0, f64::max);
        let place = self.ray.origin.as_dvec3() + self.ray.direction.as_dvec3() * t;
        let in_ball = |(center, radius): (glam::DVec3, f64)| radius < width && place.distance(center) <= radius + slack;
        (low - slack <= t && t <= high + slack) || bounds::ball(shape).is_some_and(in_ball)
    }

    /// The same for a triangle so thin that no ray of the ring need meet it: whether the ray passes an edge within `width`.
    fn line_has(&self, t: f64, id: usize, width: f64, slack: f64) -> bool {
        let Shape::Triangle(it) = &self.shapes[id] else { return false };
        let (o, d) = self.ray.line();
        let thin = bounds::size(&self.shapes[id]) < 2.0 * width;
        let passes = |from: glam::Vec3, to: glam::Vec3| {
            let (from, along) = (from.as_dvec3() - o, (to - from).as_dvec3());
            let (start, step) = (from.reject_from_normalized(d), along.reject_from_normalized(d));
            let nearest = (-start.dot(step) / step.length_squared()).clamp(0.0, 1.0);
            let at = d.dot(from + along * nearest);
            (start + step * nearest).length() <= width && (t - at).abs() <= slack.min(along.length() + width)
        };
        let [a, b, c] = it.corners;
        thin && (passes(a, b) || passes(b, c) || passes(c, a))
    }

    /// Whether the place at t is within `slack` of the surface, where it is smooth: then a ray in the neighbourhood hits
    /// there. Next to a tangent t is as uncertain as a root, and none of the samples need have this one.
    fn on_surface(&self, t: f64, id: usize, slack: f64) -> bool {
        let (o, d) = (self.ray.origin.as_dvec3(), self.ray.direction.as_dvec3());
        let place = (o + d * t).as_vec3();
        // A tip is too thin for the probes below.
        if let Shape::Cone(it) = &self.shapes[id] {
            let ends = [(it.base, it.base_radius), (it.apex, it.apex_radius)];
            let meets = |(end, radius): (glam::Vec3, f32)| {
                f64::from(radius) < slack && place.as_dvec3().distance(end.as_dvec3()) <= slack
            };
            if ends.into_iter().any(meets) {
                return true;
            }
        }
        // Of these directions one is within 28° of the normal; the place is rounded.
        let reach = slack / 28f64.to_radians().cos() + ROUNDOFF * 3f64.sqrt() * place.as_dvec3().abs().max_element();
        let digit = |i: i32| (i % 3 - 1) as f32;
        let directions = (0..27).map(|i| glam::vec3(digit(i), digit(i / 3), digit(i / 9)));
        let meets = |v: glam::Vec3| {
            let ray = oracle::Ray { normalized: true, ..oracle::Ray::new(place, v) };
            nearest(&self.shapes[id], &ray, -reach, reach).is_some()
        };
        directions.filter(|v| *v != glam::Vec3::ZERO).any(meets)
    }

    fn miss_explained(&self, part: f64) -> bool {
        let hits = || (0..self.shapes.len()).filter(|&id| self.truths[id].is_some());
        if hits().any(|id| matches!(self.around(id, self.width(id, part)), Answers::Hit { .. })) {
            return false;
        }
        // No primitive by itself is surely hit, but together they may be: between two triangles of a mesh.
        let width = hits().map(|id| self.width(id, part)).fold(0.0, f64::max);
        let met = |ray: &Ray| self.shapes.iter().any(|shape| truth(shape, ray).is_some());
        self.shapes.len() == 1 || !self.ring(width).iter().all(met)
    }
}

fn exact(ray: &Ray) -> oracle::Ray {
    oracle::Ray::new(ray.origin, ray.direction)
}

fn truth_of(shape: &Shape, ray: &Ray) -> Option<Truth> {
    nearest(shape, &exact(ray), ray.t_min.into(), ray.t_max.into())
}

/// The true hit. What the ray passes by far is not asked about.
fn truth(shape: &Shape, ray: &Ray) -> Option<Truth> {
    if let Some((center, radius)) = bounds::ball(shape) {
        let (o, d) = ray.line();
        let f = center - o;
        if f.reject_from_normalized(d).length() > radius * 1.01 + 1e-9 * f.length() {
            return None;
        }
    }
    truth_of(shape, ray)
}
