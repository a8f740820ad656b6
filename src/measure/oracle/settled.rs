//! Whether an answer holds for all rays nearby, or is a matter of rounding.

use std::f64::consts::{PI, TAU};

use glam::DVec3;

use super::{Ray, Shape, nearest_from};

/// Rays around the one that is asked for.
///
/// The rays nearby are displaced across themselves by up to `width`: a disc, seen along the ray. The samples lie on a
/// circle that is so much larger that the polygon between them holds the disc. So what is convex, seen along the ray,
/// and hit by all samples is hit by the whole disc; and a straight silhouette cannot enter the disc without parting the
/// samples, nor can a round one whose radius is at least `width`. What can is a corner or something thinner: these are
/// looked at by themselves ([`super::body::Body::tips`], [`super::body::Body::thickness`]).
const SAMPLES: u32 = 16;

/// The answers to the rays nearby.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Answers {
    /// All hit, with t between these.
    Hit {
        /// The least t.
        low: f64,
        /// The greatest.
        high: f64,
    },
    /// All miss.
    Miss,
    /// Some hit and some miss, or may do so.
    Mixed,
}

/// The answers when the ray is displaced across itself by up to `width` world units, and the ends of the interval by as
/// much along it; t is sampled, hit or miss decided as [`settled`] says. Of a `width` that is none they are mixed.
pub fn around(shape: &Shape, ray: &Ray, t_min: f64, t_max: f64, width: f64) -> Answers {
    let (origin, direction) = (ray.origin.as_dvec3(), ray.direction.as_dvec3());
    let length = direction.length();
    if !(origin.is_finite() && length > 0.0 && length.is_finite()) {
        return Answers::Miss;
    }
    if !(0.0..f64::INFINITY).contains(&width) {
        return Answers::Mixed;
    }
    let forward = direction / length;
    let (a, b) = forward.any_orthonormal_pair();
    let reach = width / (PI / f64::from(SAMPLES)).cos();
    let ring = (0..SAMPLES).map(|i| {
        let (sin, cos) = (TAU * f64::from(i) / f64::from(SAMPLES)).sin_cos();
        origin + reach * (cos * a + sin * b)
    });
    let shift = if ray.normalized { width } else { width / length };
    let wide = [t_min - shift, t_max + shift];
    let narrow = [t_min + shift, t_max - shift];
    let (mut low, mut high, mut hits, mut misses) = (f64::INFINITY, f64::NEG_INFINITY, false, false);
    for origin in std::iter::once(origin).chain(ring) {
        for interval in [narrow, wide] {
            match nearest_from(shape, origin, ray, interval) {
                Some(truth) => (low, high, hits) = (low.min(truth.t), high.max(truth.t), true),
                None => misses = true,
            }
            if hits && misses {
                return Answers::Mixed;
            }
        }
    }
    let distance = |p: DVec3| (p - origin).reject_from_normalized(forward).length();
    let body = shape.body();
    let slips = body.tips(width).into_iter().any(|corner| distance(corner) <= width)
        || body
            .ball()
            .is_some_and(|(center, radius)| body.thickness() < 2.0 * width && distance(center) <= radius + width);
    match (hits, slips) {
        (_, true) => Answers::Mixed,
        (true, false) => Answers::Hit { low, high },
        (false, false) => Answers::Miss,
    }
}

/// Whether hit or miss stays what it is when the ray is displaced across itself by up to `width` world units, and the ends
/// of the interval by as much along it. The caller's `width` is what its method's rounding amounts to.
///
/// Samples decide, 16 on a circle around the ray; that is proof for what has no feature smaller than `width` but
/// corners, and corners, and all of what is thinner, near the ray count as not settled. Fractals are sampled only.
/// It costs as much as 34 calls of [`super::nearest`], so ask only about rays whose answer is in doubt.
pub fn settled(shape: &Shape, ray: &Ray, t_min: f64, t_max: f64, width: f64) -> bool {
    around(shape, ray, t_min, t_max, width) != Answers::Mixed
}
