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
/// looked at by themselves ([`Shape::corners`], [`Shape::thickness`]).
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
    let slips = shape.corners(width).into_iter().any(|corner| distance(corner) <= width)
        || shape
            .ball()
            .is_some_and(|(center, radius)| shape.thickness() < 2.0 * width && distance(center) <= radius + width);
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

impl Shape {
    /// Points where a silhouette may end in a corner, or in something round that is smaller than `width`.
    fn corners(&self, width: f64) -> Vec<DVec3> {
        match self {
            Self::Plane(_) | Self::Sphere(_) | Self::Cylinder(_) | Self::Fractal(_) => vec![],
            Self::Triangle(it) => it.corners.map(|c| c.as_dvec3()).to_vec(),
            Self::Quad(it) => {
                let [corner, u, v] = [it.corner, it.u, it.v].map(|p| p.as_dvec3());
                vec![corner, corner + u, corner + v, corner + u + v]
            }
            Self::Cuboid(it) => {
                let [min, max, degrees] = [it.min, it.max, it.rotation].map(|p| p.as_dvec3());
                let [x, y, z] = (degrees % 360.0).to_array().map(f64::to_radians);
                let turn = glam::DQuat::from_euler(glam::EulerRot::ZYX, z, y, x);
                let (center, half) = ((min + max) / 2.0, (max - min) / 2.0);
                let signs =
                    (0..8).map(|i| DVec3::from_array([1, 2, 4].map(|bit| if i & bit == 0 { -1.0 } else { 1.0 })));
                signs.map(|sign| center + turn * (sign * half)).collect()
            }
            Self::Cone(it) => {
                let [base, apex] = [(it.base_radius, it.base), (it.apex_radius, it.apex)];
                let (radius, tip) = if base.0 < apex.0 { base } else { apex };
                if f64::from(radius) < width { vec![tip.as_dvec3()] } else { vec![] }
            }
            Self::Torus(it) => {
                let hole = f64::from(it.major_radius) - f64::from(it.minor_radius);
                if hole < width { vec![it.center.as_dvec3()] } else { vec![] }
            }
        }
    }

    /// A ball around it; none around a plane.
    fn ball(&self) -> Option<(DVec3, f64)> {
        let around = |points: &[DVec3], more: f64| {
            let center = points.iter().sum::<DVec3>() / points.len() as f64;
            let radius = points.iter().map(|p| p.distance(center)).fold(0.0, f64::max);
            (center, radius + more)
        };
        Some(match self {
            Self::Plane(_) => return None,
            Self::Sphere(it) => (it.center.as_dvec3(), it.radius.into()),
            Self::Triangle(_) | Self::Quad(_) | Self::Cuboid(_) => around(&self.corners(0.0), 0.0),
            Self::Cylinder(it) => around(&[it.base.as_dvec3(), it.apex.as_dvec3()], it.radius.into()),
            Self::Cone(it) => {
                around(&[it.base.as_dvec3(), it.apex.as_dvec3()], it.base_radius.max(it.apex_radius).into())
            }
            Self::Torus(it) => (it.center.as_dvec3(), f64::from(it.major_radius) + f64::from(it.minor_radius)),
            Self::Fractal(it) => (it.center.as_dvec3(), f64::from(it.radius) * 3f64.sqrt()),
        })
    }

    /// The least width of it.
    fn thickness(&self) -> f64 {
        let height = |u: DVec3, v: DVec3| u.cross(v).length() / u.length().max(v.length()).max((u - v).length());
        match self {
            Self::Plane(_) => f64::INFINITY,
            Self::Sphere(it) => 2.0 * f64::from(it.radius),
            Self::Triangle(it) => {
                let [a, b, c] = it.corners.map(|c| c.as_dvec3());
                height(b - a, c - a)
            }
            Self::Quad(it) => height(it.u.as_dvec3(), it.v.as_dvec3()),
            Self::Cuboid(it) => (it.max.as_dvec3() - it.min.as_dvec3()).min_element(),
            Self::Cylinder(it) => (2.0 * f64::from(it.radius)).min(it.base.as_dvec3().distance(it.apex.as_dvec3())),
            Self::Cone(it) => {
                let wide = 2.0 * f64::from(it.base_radius.max(it.apex_radius));
                wide.min(it.base.as_dvec3().distance(it.apex.as_dvec3()))
            }
            Self::Torus(it) => 2.0 * f64::from(it.minor_radius),
            Self::Fractal(it) => 2.0 * f64::from(it.radius) / 3f64.powi(it.iterations.min(8) as i32),
        }
    }
}
