//! Frusta: both cylinders and cones. With q = p − base, the axis w = apex − base and the radii r₀ and r₁, a point at
//! q·w between 0 and w² lies on the side where
//!
//! w² |q × w|² = (r₀ w² + (r₁ − r₀) q·w)²,
//!
//! and on an end where q·w is 0 or w² and |q × w|² ≤ r² w². No root is taken, so all coefficients are exact.

use std::cmp::Ordering;

use glam::Vec3;

use super::body::{Crossing, Line, exact3, visible};
use super::exact::{Exact, Exact3, along, cross, dot, minus, times};
use super::root::Root;
use crate::scene::Sides;

/// A cylinder or cone.
pub struct Frustum {
    pub base: Vec3,
    pub apex: Vec3,
    pub radii: [f32; 2],
    pub caps: bool,
    pub sides: Sides,
}

impl Frustum {
    /// The nearest of side and ends; a tangent is a hit on either side. A ray that lies in the side meets nothing of it.
    pub fn first(&self, line: &Line) -> Option<Crossing> {
        let (base, apex) = (exact3(self.base)?, exact3(self.apex)?);
        let (f, w) = (minus(&line.origin, &base), minus(&apex, &base));
        let setting = Setting {
            w2: dot(&w, &w),
            height: [dot(&f, &w), dot(&line.direction, &w)],
            across: [cross(&f, &w), cross(&line.direction, &w)],
            radii: [Exact::from_f32(self.radii[0])?, Exact::from_f32(self.radii[1])?],
            line,
            f,
            w,
        };
        if setting.w2.is_zero() {
            return None;
        }
        let side = setting.side(self.sides);
        let end = if self.caps { setting.end(self.sides) } else { None };
        match (side, end) {
            (Some(side), Some((end, _))) if side.cmp_ratio(&end).is_le() => Some(setting.on_side(&side)),
            (_, Some((end, outward))) => Some(Crossing { t: end.value(), normal: outward }),
            (side, None) => side.map(|t| setting.on_side(&t)),
        }
    }
}

/// The line and the body, seen from the base.
struct Setting<'a> {
    line: &'a Line,
    /// o − base.
    f: Exact3,
    w: Exact3,
    w2: Exact,
    /// f·w and d·w: the height q·w is their sum with the second times t.
    height: [Exact; 2],
    /// f × w and d × w.
    across: [Exact3; 2],
    radii: [Exact; 2],
}

impl Setting<'_> {
    fn growth(&self) -> Exact {
        &self.radii[1] - &self.radii[0]
    }

    /// The first visible root on the side between the ends.
    fn side(&self, sides: Sides) -> Option<Root> {
        let [x, y] = &self.across;
        let (k0, k1) = (&self.radii[0] * &self.w2 + self.growth() * &self.height[0], self.growth() * &self.height[1]);
        let a = &self.w2 * dot(y, y) - k1.squared();
        let b = &self.w2 * dot(x, y) - &k0 * &k1;
        let c = &self.w2 * dot(x, x) - k0.squared();
        let above_base = |t: &Root| t.sign_of(&self.height[0], &self.height[1]).is_ge();
        let below_apex = |t: &Root| t.sign_of(&(&self.height[0] - &self.w2), &self.height[1]).is_le();
        let mut roots = Root::quadratic(a, b, &c).into_iter();
        let found = roots
            .find(|(t, slope)| visible(sides, *slope) && above_base(t) && below_apex(t) && self.line.span.contains(t));
        found.map(|(t, _)| t)
    }

    /// The nearer visible end, with its outward normal.
    fn end(&self, sides: Sides) -> Option<(Root, Exact3)> {
        let [at, along] = &self.height;
        let down = times(&Exact::integer(-1), &self.w);
        // To run along the axis is to enter at the base and to leave at the apex.
        let base = (-at, &self.radii[0], along.sign().reverse(), down);
        let apex = (&self.w2 - at, &self.radii[1], along.sign(), self.w.clone());
        let ends = [base, apex].into_iter().filter_map(|(numerator, radius, slope, outward)| {
            let [x, y] = &self.across;
            // |q × w|² ≤ r² w², times the square of d·w.
            let q: Exact3 = std::array::from_fn(|i| &x[i] * along + &y[i] * &numerator);
            let within = dot(&q, &q) <= radius.squared() * &self.w2 * along.squared();
            let t = Root::ratio(numerator, along.clone())?;
            (within && visible(sides, slope) && self.line.span.contains(&t)).then_some((t, outward))
        });
        ends.min_by(|a, b| a.0.cmp_ratio(&b.0))
    }

    /// The normal is half the gradient, w² (w² q − (q·w) w) − (r₀ w² + (r₁ − r₀) q·w) (r₁ − r₀) w. At a tip, where that is
    /// 0, it is the axis, away from the body.
    fn on_side(&self, t: &Root) -> Crossing {
        let t = t.value();
        let q = along(&self.f, &t, &self.line.direction);
        let height = dot(&q, &self.w);
        let radius = &self.radii[0] * &self.w2 + self.growth() * &height;
        let radial = minus(&times(&self.w2, &q), &times(&height, &self.w));
        let slant = times(&(radius * self.growth()), &self.w);
        let gradient = minus(&times(&self.w2, &radial), &slant);
        let normal = match gradient.iter().all(Exact::is_zero) {
            false => gradient,
            true if self.growth().sign() == Ordering::Greater => times(&Exact::integer(-1), &self.w),
            true => self.w.clone(),
        };
        Crossing { t, normal }
    }
}
