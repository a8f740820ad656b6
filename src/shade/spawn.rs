//! Secondary rays: the one place that says where they start and where they end.
//!
//! A fixed epsilon is either too small far from the origin (acne) or too large close to it (leaks). The offset here
//! is a bound on what rounding can do. With ε = 2⁻²⁴, M the point's largest coordinate and s the primitive's
//! `reach`, in units of distance from the surface:
//!
//! - the point was moved onto the surface: at most 4 ε (M + s) off it ([`crate::geometry::Surface`]);
//! - adding the offset rounds: ε M;
//! - the test of the surface's own primitive against the new ray places it off by at most 8 ε (s + D), D being the
//!   ray's length for a ray that comes from afar (a shadow ray from its light), for which its unit direction adds
//!   3 ε D of its own.
//!
//! The sum is below 12 ε (M + s + D); [`OFFSET`] takes 16. A ray that starts or ends so far from the surface, along
//! the normal on the side it belongs to, can not meet it by mistake, and needs no `t_min` and no shortened `t_max`.

use crate::math::{Lanes, Vec3};

/// 16 ε.
const OFFSET: f32 = 16.0 * 0.5 * f32::EPSILON;

/// A shadow ray, fired from the light at a point, and what the light does there.
#[derive(Clone, Copy, Debug)]
pub struct ShadowRay<L> {
    /// Unit direction, from the light.
    pub direction: Vec3<L>,
    /// Distance to the lifted point: the end of the ray.
    pub t_max: L,
    /// n·l; the light is on the surface's other side when not above zero, or NaN.
    pub cosine: L,
    /// 1 / distance.
    pub inverse: L,
}

/// The ray from `light` to `point`, on the side of the surface that `normal` points to; `grain` is M + s.
#[inline(always)]
pub fn shadow<L: Lanes>(light: Vec3<L>, point: Vec3<L>, normal: Vec3<L>, grain: L) -> ShadowRay<L> {
    let away = point - light;
    // The sum of the magnitudes stands for the distance; it is never less.
    let length = away.x.abs() + away.y.abs() + away.z.abs();
    let lifted = normal.mul_add(L::splat(OFFSET) * (grain + length), point);
    let v = lifted - light;
    let t_max = v.dot(v).sqrt();
    let inverse = L::splat(1.0) / t_max;
    let direction = v * inverse;
    ShadowRay { direction, t_max, cosine: -normal.dot(direction), inverse }
}

/// Origin and unit direction of the mirror's ray for one that came along `direction`; `grain` is M + s.
#[inline(always)]
pub fn reflected<L: Lanes>(direction: Vec3<L>, point: Vec3<L>, normal: Vec3<L>, grain: L) -> (Vec3<L>, Vec3<L>) {
    (normal.mul_add(L::splat(OFFSET) * grain, point), mirror(direction, normal))
}

/// d − 2 (d·n) n, kept at unit length by one Newton step, so that errors do not add up over bounces.
#[inline(always)]
pub fn mirror<L: Lanes>(direction: Vec3<L>, normal: Vec3<L>) -> Vec3<L> {
    let twice = direction.dot(normal) * L::splat(-2.0);
    let r = normal.mul_add(twice, direction);
    r * r.dot(r).mul_add(L::splat(-0.5), L::splat(1.5))
}

/// M + s: what the offset is proportional to.
#[inline(always)]
pub fn grain<L: Lanes>(point: Vec3<L>, reach: L) -> L {
    point.max_abs() + reach
}
