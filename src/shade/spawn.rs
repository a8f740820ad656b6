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
//!
//! Where a body is transparent, a lift that is larger than the body is thick, or than the gap to the next one, loses a
//! surface. There M is only as much of the coordinates as counts along the normal n, N = Σ |nᵢ pᵢ|: the parts of M above
//! are roundings of single coordinates. Along a surface of curvature κ, √3 ε M are off it by 1.5 ε² M² κ. Rays are kept off
//! edges, across which the rounding along a surface would take them ([`crate::geometry::Footing`]). Cylinders, cones, tori
//! and fractals keep M.
//!
//! [`Offsets`] has the fixed epsilons, too, to be compared with.

use crate::geometry::Footing;
use crate::geometry::methods::{Methods, OffsetMethod};
use crate::math::{Lanes, Vec3, inverse_root};

/// ε, the unit roundoff: half the distance from 1 to the next number.
const ROUNDOFF: f32 = 0.5 * f32::EPSILON;

/// The fixed epsilon, and the one that scales with the coordinates.
const EPSILON: f32 = 1e-4;

/// How far off what they leave rays start and end, and how they come to unit length: a scene's methods as numbers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Offsets {
    /// Part of a primitive's reach.
    reach: f32,
    /// Part of a point's largest coordinate.
    coordinate: f32,
    /// Part of a shadow ray's length.
    length: f32,
    /// Whether of a coordinate's rounding only what is along the normal matters, where that is known.
    along: bool,
    /// World units.
    fixed: f32,
    /// See [`Vec3::normalize_by`].
    steps: Option<u32>,
}

impl Offsets {
    /// By a scene's methods.
    pub fn of(methods: &Methods) -> Self {
        let none = Self {
            reach: 0.0,
            coordinate: 0.0,
            length: 0.0,
            along: false,
            fixed: 0.0,
            steps: methods.normalize.steps(),
        };
        match methods.offset {
            OffsetMethod::Derived => {
                let [reach, coordinate, length] = [8.0 * ROUNDOFF, 9.0 * ROUNDOFF, 12.0 * ROUNDOFF];
                Self { reach, coordinate, length, along: true, ..none }
            }
            OffsetMethod::None => none,
            OffsetMethod::Fixed => Self { fixed: EPSILON, ..none },
            OffsetMethod::Scaled => Self { coordinate: EPSILON, ..none },
        }
    }

    /// So many world units.
    #[cfg(feature = "lab")]
    pub fn fixed(epsilon: f32) -> Self {
        Self { reach: 0.0, coordinate: 0.0, length: 0.0, along: false, fixed: epsilon, steps: None }
    }

    /// How far from the surface a ray starts that leaves it at `point`.
    #[inline(always)]
    pub fn lift<L: Lanes>(&self, point: Vec3<L>, reach: L) -> L {
        self.lift_by(point.max_abs(), reach)
    }

    /// [`Offsets::lift`] by what takes the largest coordinate's place: that, or [`Offsets::along`].
    #[inline(always)]
    pub fn lift_by<L: Lanes>(&self, coordinate: L, reach: L) -> L {
        coordinate.mul_add(L::splat(self.coordinate), reach * L::splat(self.reach)) + L::splat(self.fixed)
    }

    /// What takes the largest coordinate's place on the surface of a transparent body: Σ |nᵢ pᵢ|, and what the rounding
    /// along the surface adds where that is curved. So a body far from the origin may be as thin as its own place allows.
    #[inline(always)]
    pub fn along<L: Lanes>(&self, footing: &Footing<L>, normal: Vec3<L>) -> L {
        let most = footing.point.max_abs();
        if !self.along {
            return most;
        }
        let n_p = |n: L, p: L| (n * p).abs();
        let (n, p) = (normal, footing.point);
        let along = n_p(n.x, p.x) + n_p(n.y, p.y) + n_p(n.z, p.z);
        let curved = most * most * L::splat((ROUNDOFF * footing.curvature).min(f32::MAX));
        // No more than everywhere else; NaN is passed over.
        (along + curved).min(most)
    }
}

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

/// The ray from `light` to `point`, on the side of the surface that `normal` points to; `lift` is [`Offsets::lift`]'s.
#[inline(always)]
pub fn shadow_from_light<L: Lanes>(
    offsets: &Offsets,
    light: Vec3<L>,
    point: Vec3<L>,
    normal: Vec3<L>,
    lift: L,
) -> ShadowRay<L> {
    let away = point - light;
    // The sum of the magnitudes stands for the distance; it is never less.
    let length = away.x.abs() + away.y.abs() + away.z.abs();
    let lifted = normal.mul_add(length.mul_add(L::splat(offsets.length), lift), point);
    let (direction, t_max, inverse) = unit(lifted - light, offsets.steps);
    ShadowRay { origin: light, direction, t_max, cosine: -normal.dot(direction), inverse }
}

/// The ray of [`shadow_from_light`] reversed, from `point` to `light`: for a light so far away that a ray from there
/// would miss small things. It ends a lift before the light, by the same bound, so that a surface through the light
/// does not block it.
#[inline(always)]
pub fn shadow_from_point<L: Lanes>(
    offsets: &Offsets,
    light: Vec3<L>,
    point: Vec3<L>,
    normal: Vec3<L>,
    lift: L,
) -> ShadowRay<L> {
    let origin = normal.mul_add(lift, point);
    let (direction, length, inverse) = unit(light - origin, offsets.steps);
    let slack = length.mul_add(L::splat(offsets.length), offsets.lift(light, L::zero()));
    // Not below 0, which would mark the ray inactive: a point that close to the light is lit.
    let t_max = (length - slack).max(L::zero());
    ShadowRay { origin, direction, t_max, cosine: normal.dot(direction), inverse }
}

/// A point moved by `rise` off the surface, to the side of `normal`, for a shadow ray to start at instead. A bit more, for
/// the rounding of the sum, √3 ε M, and as the lift was meant for the M of the point.
#[inline(always)]
pub fn raise<L: Lanes>(point: Vec3<L>, rise: Vec3<L>, normal: Vec3<L>) -> Vec3<L> {
    let height = rise.max_abs();
    let more = point.max_abs().mul_add(L::splat(2.0 * ROUNDOFF), height * L::splat(11.0 * ROUNDOFF));
    point + normal.mul_add(more, rise)
}

/// A vector's direction, length and the length's inverse.
#[inline(always)]
fn unit<L: Lanes>(v: Vec3<L>, steps: Option<u32>) -> (Vec3<L>, L, L) {
    let length2 = v.dot(v);
    if let Some(steps) = steps {
        let inverse = inverse_root(length2, steps);
        return (v * inverse, length2 * inverse, inverse);
    }
    let length = length2.sqrt();
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

#[cfg(test)]
#[path = "spawn_tests.rs"]
mod tests;
