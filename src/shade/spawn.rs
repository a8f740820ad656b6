//! Secondary rays: the one place that says where they start and where they end.
//!
//! A fixed epsilon is either too small far from the origin (acne) or too large close to it (leaks). The lift here
//! is a bound on what rounding can do. With ε = 2⁻²⁴, M the point's largest coordinate and s the primitive's
//! `reach`, in units of distance from the surface:
//!
//! - the point was moved onto the surface: at most 4.5 ε s + √3 ε M off it ([`crate::geometry::Surface`]);
//! - adding the lift rounds: √3 ε M;
//! - the test of the surface's own primitive sees a ray that starts there off by 3 ε s (c = |f|² − r² of a sphere)
//!   or 5 ε M (n·o + distance of a plane);
//! - a shadow ray comes from its light, D away: its direction, its length and the test from there add 12 ε D.
//!
//! So the lift is ε (8 s + 9 M), plus 12 ε D for a shadow ray. A ray that starts or ends so far from the surface,
//! along the normal on the side it belongs to, does not meet it by mistake, and needs no `t_min` and no shortened
//! `t_max`; only a ray that ends at a light itself is shortened, for the surface the light may lie on.

use crate::math::{Lanes, Vec3};

/// ε, the unit roundoff: half the distance from 1 to the next number.
const ROUNDOFF: f32 = 0.5 * f32::EPSILON;

/// A shadow ray between a light and a point, and what the light does there.
#[derive(Clone, Copy, Debug)]
pub struct ShadowRay<L> {
    /// Where it starts: at the light or at the lifted point.
    pub origin: Vec3<L>,
    /// Unit direction.
    pub direction: Vec3<L>,
    /// The end of the ray: the lifted point, or just before the light.
    pub t_max: L,
    /// n·l; the light is on the surface's other side when not above zero, or NaN.
    pub cosine: L,
    /// 1 / distance.
    pub inverse: L,
}

/// The ray from `light` to `point`, on the side of the surface that `normal` points to; `lift` is [`lift`]'s.
#[inline(always)]
pub fn shadow_from_light<L: Lanes>(light: Vec3<L>, point: Vec3<L>, normal: Vec3<L>, lift: L) -> ShadowRay<L> {
    let away = point - light;
    // The sum of the magnitudes stands for the distance; it is never less.
    let length = away.x.abs() + away.y.abs() + away.z.abs();
    let lifted = normal.mul_add(length.mul_add(L::splat(12.0 * ROUNDOFF), lift), point);
    let (direction, t_max, inverse) = unit(lifted - light);
    ShadowRay { origin: light, direction, t_max, cosine: -normal.dot(direction), inverse }
}

/// The same ray from `point` to `light`: for a light so far away that a ray from there would miss small things. It ends
/// a lift before the light, by the same bound, so that a surface through the light does not block it.
#[inline(always)]
pub fn shadow_from_point<L: Lanes>(light: Vec3<L>, point: Vec3<L>, normal: Vec3<L>, lift: L) -> ShadowRay<L> {
    let origin = normal.mul_add(lift, point);
    let (direction, length, inverse) = unit(light - origin);
    let slack = length.mul_add(L::splat(12.0 * ROUNDOFF), light.max_abs() * L::splat(9.0 * ROUNDOFF));
    // Not below 0, which would mark the ray inactive: a point that close to the light is lit.
    let t_max = (length - slack).max(L::zero());
    ShadowRay { origin, direction, t_max, cosine: normal.dot(direction), inverse }
}

/// A vector's direction, length and the length's inverse.
#[inline(always)]
fn unit<L: Lanes>(v: Vec3<L>) -> (Vec3<L>, L, L) {
    let length = v.dot(v).sqrt();
    let inverse = L::splat(1.0) / length;
    (v * inverse, length, inverse)
}

/// d − 2 (d·n) n, kept at unit length by one Newton step, so that errors do not add up over bounces.
#[inline(always)]
pub fn mirror<L: Lanes>(direction: Vec3<L>, normal: Vec3<L>) -> Vec3<L> {
    let twice = direction.dot(normal) * L::splat(-2.0);
    let r = normal.mul_add(twice, direction);
    r * r.dot(r).mul_add(L::splat(-0.5), L::splat(1.5))
}

/// [`mirror`], by the `geometric` normal where an interpolated one would send the ray below the surface; both are
/// turned against the ray.
#[inline(always)]
pub fn mirror_above<L: Lanes>(direction: Vec3<L>, normal: Vec3<L>, geometric: Vec3<L>) -> Vec3<L> {
    let r = mirror(direction, normal);
    r.select(r.dot(geometric).gt(L::zero()), mirror(direction, geometric))
}

/// How far from the surface a ray starts that leaves it at `point`.
#[inline(always)]
pub fn lift<L: Lanes>(point: Vec3<L>, reach: L) -> L {
    point.max_abs().mul_add(L::splat(9.0 * ROUNDOFF), reach * L::splat(8.0 * ROUNDOFF))
}
