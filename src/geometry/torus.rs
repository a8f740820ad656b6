//! The torus (ρ − R)² + z² = r², with ρ the distance from its axis and z the height along it; seen from outside and
//! inside.
//!
//! Three methods with one signature, all for unit directions, in units of R with κ = r / R:
//!
//! - [`monotone_newton`], the default: below.
//! - [`ferrari`]: the roots of the quartic in closed form, after Schwarze (Graphics Gems, 1990). The textbook's.
//! - [`sphere_trace`]: steps as long as the distance to the torus (Hart 1996).
//!
//! # The default
//!
//! - Multiplied out, a ray's places on the torus are the roots of the quartic (|p|² + 1 − κ²)² − 4 ρ². Its coefficients
//!   cancel, the more so the thinner or the farther the torus, and closed forms (Ferrari's) and Newton's method on it
//!   fail at double roots. So it is not multiplied out: its only factor that is ever below zero is
//!   g = (ρ − 1)² + z² − κ², and of that the first root is searched.
//! - Along p(s) = q + s d, from the closest approach q to the centre, g = s² + … − 2 ρ(s), with g″ = 2 − 2 j² / ρ³ and
//!   j = q.x d.y − q.y d.x, which is the same all along a ray. So g is concave where ρ < j^⅔, which is in one stretch
//!   about the ray's closest approach to the axis, and convex before and behind: the inflections are known, and
//!   Newton's method finds or excludes a root of each of the three stretches without ever overshooting
//!   ([`crate::math::roots`]; Fourier's condition).
//! - The search is kept to where the ray is in a ball of radius R + r and between two planes at ±r, each a little off
//!   the torus; what misses them is left out at once. s counts from the closest approach to the axis in there, where
//!   ρ² = a sum of squares, which does not cancel.
//!
//! Next to a root g is taken for a parabola, so that one rounded value decides about a tangent.
//!
//! The idea of isolating roots between places known beforehand is that of sequences of derivatives (Yuksel,
//! *High-Performance Polynomial Root Finding for Graphics*, HPG 2022); here the function is not the polynomial, and
//! the second derivative is enough.
//!
//! **Error.** A hit lies at most 12 ε (R + r) + 4 ε |o − center| off the torus, whatever κ, as the tests measure:
//! rounding moves p by a few ε and g by 2 κ times that. So t is off by the same over the cosine of incidence, at a
//! tangent √ of it, and a tangent ray hits when the computed g is not above zero at its least. From farther than 1/ε
//! sizes everything is a matter of rounding, and NaN hits nothing.
//!
//! **Inside, and on the surface.** From inside the far side is hit. An origin within 8 ε (R + r) of the surface counts
//! as on it, and its own root does not count: a ray that leaves it hits nothing there, one that enters the far side. One
//! that grazes it, and would come back before it is farther off than that, does not come back: outside of a bulge it
//! stays outside, along a hollow inside. So what it meets beyond is found, whichever way rounding turns it at the start.
//! (Where polynomials are solved, the root at the start is divided out.)
//!
//! **`t_min`** chooses among the roots from the origin on, and does not change them.

mod ferrari;
mod sphere_trace;

pub use ferrari::ferrari;
pub use sphere_trace::sphere_trace;

use super::methods::TorusMethod;
use super::numbers::numbers;
use super::{Balls, Bounded, Cull, LaneHits, Mapping, Number, Primitives, Surface, Test, columns, frame, frame::along};
use crate::math::roots::{Sample, Stretch, first_root};
use crate::math::{LaneMask, Lanes, Vec3, angle, map2, map3, powf};
use glam::DVec3;

/// ε, the unit roundoff.
const ROUNDOFF: f32 = 0.5 * f32::EPSILON;

/// How far from the surface an origin counts as on it, in R + r: what its rotation and scaling (5 ε) and g's rounding
/// (3 ε) may move it.
const ON: f32 = 8.0 * ROUNDOFF;

/// How far the ball and the planes around a torus are off it, in R + r: more than what rounds, so that there the ray
/// is outside.
const SLACK: f32 = 2.0 * ON;

/// Tori, column by column.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Tori {
    /// The centres.
    pub center: [Vec<f32>; 3],
    /// Unit axes T, B ([`frame`]) and A, the torus's own.
    pub axes: Vec<[glam::Vec3; 3]>,
    /// R, from the centre to the middle of the tube.
    pub major: Vec<f32>,
    /// r, of the tube.
    pub minor: Vec<f32>,
    /// How near to a root the search takes g for a parabola, in R, far from the axis.
    pub near: Vec<f32>,
    /// Indices into the scene's materials.
    pub material: Vec<u32>,
    /// How all are tested.
    pub method: TorusMethod,
    boxes: Vec<[glam::Vec3; 2]>,
    balls: Balls,
}

numbers! {
    /// A torus as stored.
    TorusShape {
        /// Its centre.
        center: Vec3,
        /// T, B and A.
        axes: [Vec3; 3],
        /// R.
        major: T,
        /// r / R.
        kappa: T,
        /// How near to a root the search takes g for a parabola, far from the axis.
        near: T,
        /// The box around it.
        bounds: [Vec3; 2],
    }
    /// A torus as seen from the rays' origin.
    SeenTorus {
        /// (o − center) / R, along T, B and A.
        f: Vec3,
        /// T, B and A.
        axes: [Vec3; 3],
        /// R.
        major: T,
        /// r / R.
        kappa: T,
        /// How near to a root the search takes g for a parabola, far from the axis.
        near: T,
    }
}

impl Tori {
    /// Adds a torus.
    pub fn push(&mut self, center: glam::Vec3, axis: glam::Vec3, major: f32, minor: f32, material: u32) {
        columns::push(&mut self.center, center);
        let a = axis.as_dvec3().normalize();
        // The frame is made exact before it is rounded, as ρ is taken along it.
        let across = frame(a.as_vec3())[0].as_dvec3();
        let t = (across - a * a.dot(across)).normalize();
        self.axes.push([t, t.cross(a), a].map(|v| v.as_vec3()));
        self.major.push(major);
        self.minor.push(minor);
        // (ε κ)^⅓ / 4, and ρ times that near the axis: so the parabola is off g by (2 near)³ |g‴| / 6 ≤ ε κ / 8, as
        // |g‴| = 6 j² |ρ′| / ρ⁴ is at most 6 / ρ².
        self.near.push(0.25 * (ROUNDOFF * minor / major).cbrt());
        self.material.push(material);
        self.boxes.push(self.enclose(self.material.len() - 1));
        // The ball about the centre is smaller than the one around the box.
        self.balls.push(center, (major + minor) * (1.0 + 2.0 * f32::EPSILON));
    }

    /// Torus `i`'s centre.
    #[inline(always)]
    pub fn center(&self, i: usize) -> glam::Vec3 {
        columns::at(&self.center, i)
    }

    /// A box around torus `i`.
    #[inline]
    pub fn bounds(&self, i: usize) -> [glam::Vec3; 2] {
        self.boxes[i]
    }

    fn enclose(&self, i: usize) -> [glam::Vec3; 2] {
        let [t, b, _] = self.axes[i].map(|v| v.as_dvec3());
        let center = self.center(i);
        // The middle of the tube spans √(T² + B²) along every coordinate.
        let half = DVec3::splat(self.minor[i].into()) + (t * t + b * b).map(f64::sqrt) * f64::from(self.major[i]);
        let slack = glam::Vec3::splat(2.0 * f32::EPSILON) * (center.abs() + half.as_vec3());
        let [min, max] = [center.as_dvec3() - half, center.as_dvec3() + half].map(|v| v.as_vec3());
        [min - slack, max + slack]
    }

    /// The point of the tube's middle nearest to `point`, from the centre, and the vector from there to `point`.
    #[inline(always)]
    fn spine<L: Lanes>(&self, i: usize, point: Vec3<L>) -> [Vec3<L>; 2] {
        let [t, _, a] = map3(self.axes[i], Vec3::<L>::splat);
        let q = point - Vec3::splat(self.center(i));
        let across = a.mul_add(-a.dot(q), q);
        let rho2 = across.dot(across);
        // On the axis all directions are alike.
        let some = rho2.gt(L::zero());
        let unit = (across * (L::splat(1.0) / rho2.sqrt())).select(some, t);
        let middle = unit * L::splat(self.major[i]);
        [middle, q - middle]
    }
}

impl Bounded for Tori {
    const BOXED: bool = true;
    const COST: [f64; 2] = [8.0, 3.0];
    #[inline(always)]
    fn extent<L: Lanes>(torus: &TorusShape<L>) -> [Vec3<L>; 2] {
        torus.bounds
    }
    #[inline(always)]
    fn around(&self, i: usize) -> [glam::Vec3; 2] {
        self.boxes[i]
    }
}

impl Primitives for Tori {
    type Shape<T: Number> = TorusShape<T>;
    type Variant = ();
    type Seen<T: Copy> = SeenTorus<T>;
    type Aim<L: Lanes> = Vec3<L>;
    type Named = TorusMethod;

    #[inline(always)]
    fn materials(&self) -> &[u32] {
        &self.material
    }
    #[inline]
    fn cull(&self) -> Cull<'_> {
        Cull::Balls(&self.balls)
    }
    #[inline(always)]
    fn shape(&self, i: usize) -> TorusShape<f32> {
        let (major, minor) = (self.major[i], self.minor[i]);
        TorusShape {
            center: self.center(i).into(),
            axes: map3(self.axes[i], Vec3::from),
            major,
            kappa: minor / major,
            near: self.near[i],
            bounds: map2(self.boxes[i], Vec3::from),
        }
    }
    #[inline]
    fn variant(&self, _: usize) {}
    #[inline(always)]
    fn zip<A: Number, B: Number, C: Number>(
        a: &TorusShape<A>,
        b: &TorusShape<B>,
        f: impl Fn(&A, &B) -> C,
    ) -> TorusShape<C> {
        a.zip(b, f)
    }
    #[inline(always)]
    fn seen<L: Lanes>(torus: &TorusShape<L>, (): (), origin: Vec3<L>) -> SeenTorus<L> {
        let TorusShape { center, axes, major, kappa, near, .. } = *torus;
        SeenTorus { f: along(&axes, origin - center) * (L::splat(1.0) / major), axes, major, kappa, near }
    }
    #[inline(always)]
    fn splat_seen<L: Lanes>(seen: &SeenTorus<f32>) -> SeenTorus<L> {
        seen.map(|number| L::splat(*number))
    }
    #[inline(always)]
    fn nearest<L: Lanes>(seen: &SeenTorus<L>, (): (), d: &Vec3<L>, t_min: L, t_max: L) -> LaneHits<L> {
        monotone_newton(seen, *d, t_min, t_max)
    }
    #[inline(always)]
    fn named(&self) -> Option<TorusMethod> {
        (self.method != TorusMethod::MonotoneNewton).then_some(self.method)
    }

    #[inline(always)]
    fn surface<L: Lanes>(&self, i: usize, point: Vec3<L>) -> Surface<L> {
        let [middle, outward] = self.spine(i, point);
        let length2 = outward.dot(outward);
        // In the middle of a tube thinner than ε R, a direction is as good as any other.
        let some = length2.gt(L::zero());
        let normal = (outward * (L::splat(1.0) / length2.sqrt())).select(some, Vec3::splat(self.axes[i][2]));
        let from_center = normal.mul_add(L::splat(self.minor[i]), middle);
        let reach = self.major[i] + self.minor[i];
        Surface { point: from_center + Vec3::splat(self.center(i)), normal, reach }
    }
    #[inline(always)]
    fn uv<L: Lanes>(&self, i: usize, surface: &Surface<L>) -> [L; 2] {
        let q = self.checker(i, surface);
        let rho = q.x.mul_add(q.x, q.y * q.y).sqrt();
        [angle::turn(q.x, q.y), angle::turn(q.z, rho - L::splat(self.major[i]))]
    }
    #[inline(always)]
    fn mapping<L: Lanes>(&self, _: usize, _: &Surface<L>) -> Mapping<L> {
        Mapping::endless()
    }
    #[inline(always)]
    fn checker<L: Lanes>(&self, i: usize, surface: &Surface<L>) -> Vec3<L> {
        along(&map3(self.axes[i], Vec3::splat), surface.point - Vec3::splat(self.center(i)))
    }
}

impl Test<Tori> for TorusMethod {
    type Seen<T: Copy> = SeenTorus<T>;
    #[inline(always)]
    fn seen<L: Lanes>(self, torus: &TorusShape<L>, (): (), origin: Vec3<L>) -> SeenTorus<L> {
        Tori::seen(torus, (), origin)
    }
    #[inline(always)]
    fn splat_seen<L: Lanes>(seen: &SeenTorus<f32>) -> SeenTorus<L> {
        seen.map(|number| L::splat(*number))
    }
    #[inline(always)]
    fn nearest<L: Lanes>(self, seen: &SeenTorus<L>, (): (), d: &Vec3<L>, t_min: L, t_max: L) -> LaneHits<L> {
        match self {
            Self::MonotoneNewton => monotone_newton(seen, *d, t_min, t_max),
            Self::Ferrari => ferrari(seen, *d, t_min, t_max),
            Self::SphereTrace => sphere_trace(seen, *d, t_min, t_max),
        }
    }
}

/// The default; see the module's text.
#[inline(always)]
pub fn monotone_newton<L: Lanes>(seen: &SeenTorus<L>, direction: Vec3<L>, t_min: L, t_max: L) -> LaneHits<L> {
    let (mut t, mut found) = first::<L, false>(seen, direction, t_min, t_max)?;
    if (found & t.le(t_min)).any() {
        // A copy is handed over, so that the numbers themselves stay in registers.
        let seen = *seen;
        (t, found) = later(&seen, direction, t_min, t_max)?;
    }
    let inside = found & t.gt(t_min) & t.lt(t_max);
    inside.any().then_some((t, inside))
}

/// The first roots that lie after `t_min`, where those that come before are many.
#[inline(never)]
fn later<L: Lanes>(seen: &SeenTorus<L>, direction: Vec3<L>, t_min: L, t_max: L) -> LaneHits<L> {
    first::<L, true>(seen, direction, t_min, t_max)
}

/// The first root from the ray's origin on; `LATER` passes over those that do not lie after `t_min`. Which roots there
/// are does not depend on `t_min`, unless that is below zero: then all along the line count.
#[inline(always)]
fn first<L: Lanes, const LATER: bool>(seen: &SeenTorus<L>, direction: Vec3<L>, t_min: L, t_max: L) -> LaneHits<L> {
    let per_major = L::splat(1.0) / seen.major;
    let d = along(&seen.axes, direction);
    let b = seen.f.dot(d);
    let q = d.mul_add(-b, seen.f);
    let start = L::splat(f32::NEG_INFINITY).select(t_min.lt(L::zero()), b);
    let span = Span::around(seen.kappa, q, d, [start, t_max.mul_add(per_major, b)])?;
    let path = Path::new(q, d, &span, seen.kappa, seen.near);
    let [low, high] = path.ends;
    let [bend, unbend] = path.inflections;
    let at_first = path.sample(low);
    // 2 κ times the distance from the surface.
    let on_level = (seen.kappa + seen.kappa) * (L::splat(1.0) + seen.kappa) * L::splat(ON);
    let on = !span.entered & at_first.value.abs().le(on_level);
    let mut inside = !span.entered & at_first.value.lt(L::zero());
    if on.any() {
        // What runs no farther off than `on_level` before it comes back, by the parabola, is off on the side of the bend.
        let slope = at_first.rise / at_first.run;
        let bent = path.curvature(low);
        let shallow = (slope * slope).le((bent + bent).abs() * on_level);
        // A kink on the axis bends so, too.
        let bends = bend.le(low) & unbend.gt(low);
        let turned_in = (shallow & bends) | (!shallow & slope.lt(L::zero()));
        inside = (on & turned_in) | (!on & inside);
    }
    let nowhere = low.lt(low);
    let place = |u: L| ((path.middle + u) - b) * seen.major;
    let (mut u, mut found, mut passed) = (low, nowhere, nowhere);
    for (mut left, right, bends) in [(low, bend, false), (bend, unbend, true), (unbend, high, false)] {
        let mut open = span.live & !found & left.lt(right);
        for _ in 0..if LATER { 2 } else { 1 } {
            let sign = L::splat(-1.0).select(inside, L::splat(1.0));
            let f = |u: L| {
                let Sample { value, rise, run, near } = path.sample(u);
                Sample { value: value * sign, rise: rise * sign, run, near }
            };
            let convex = if bends { inside } else { !inside };
            // A ray that starts on the surface leaves it, by the choice of the sign, and hits nothing while f is convex.
            let mut leaves = on & convex & left.le(low);
            if LATER {
                leaves = leaves | (passed & convex & f(left).value.le(L::zero()));
            }
            let live = open & !leaves;
            if !live.any() {
                break;
            }
            let curvature = |u: L| path.curvature(u) * sign;
            let (root, hit) = first_root(f, curvature, &Stretch { left, right, convex }, live);
            let counts = if LATER { hit & place(root).gt(t_min) } else { hit };
            u = root.select(counts, u);
            found = found | counts;
            if LATER {
                // On the other side of the surface, unless it is the root that the ray starts on.
                let past = hit & !counts & !(on & place(root).le(L::zero()));
                inside = (inside & !past) | (past & !inside);
                passed = passed | past;
                left = root.select(past, left);
                // A concave stretch has no other root.
                open = past & convex;
            }
        }
    }
    found.any().then_some((place(u), found))
}

/// The part of a ray that may meet the torus, by s.
struct Span<L: Lanes> {
    ends: [L; 2],
    /// Where it begins at the ball or a plane, and not at the ray's start.
    entered: L::Mask,
    /// Where there is one.
    live: L::Mask,
}

impl<L: Lanes> Span<L> {
    /// `None` when there is none in any lane; `ray` is where the ray starts and ends. Its end leaves spans out, but cuts
    /// none short: where a search ends must not change where it finds the root.
    #[inline(always)]
    fn around(kappa: L, q: Vec3<L>, d: Vec3<L>, ray: [L; 2]) -> Option<Self> {
        let reach = L::splat(1.0) + kappa;
        let radius = reach * L::splat(1.0 + SLACK);
        let half2 = q.dot(q).neg_mul_add(L::splat(1.0), radius * radius);
        let live = half2.ge(L::zero());
        if !live.any() {
            return None;
        }
        let half = half2.sqrt();
        let height = kappa + reach * L::splat(SLACK);
        // Not zero, for 0 / 0; over the ball's diameter so little is nothing.
        let steepness = d.z.select(d.z.abs().gt(L::splat(1e-18)), L::splat(1e-18));
        let inverse = L::splat(1.0) / steepness;
        let [one, other] = [(-height - q.z) * inverse, (height - q.z) * inverse];
        let entry = (-half).max(one.min(other));
        let low = entry.max(ray[0]);
        let high = half.min(one.max(other));
        let live = live & low.lt(high) & low.lt(ray[1]);
        live.any().then_some(Self { ends: [low, high], entered: entry.gt(ray[0]), live })
    }
}

/// A ray by u = s − `middle`, where it is closest to the axis within its span: ρ² = ρ₀² + 2 slope u + across2 u² is a
/// sum of what is not below zero.
struct Path<L> {
    middle: L,
    ends: [L; 2],
    /// Between these g is concave, and convex before and behind.
    inflections: [L; 2],
    rho2: L,
    slope: L,
    across2: L,
    /// j².
    j2: L,
    z: L,
    dz: L,
    kappa2: L,
    near: L,
}

impl<L: Lanes> Path<L> {
    #[inline(always)]
    fn new(q: Vec3<L>, d: Vec3<L>, span: &Span<L>, kappa: L, near: L) -> Self {
        let zero = L::zero();
        let [low, high] = span.ends;
        let across2 = d.x.mul_add(d.x, d.y * d.y);
        // 0 / 0 of a ray along the axis becomes the span's start.
        let middle = (-d.x.mul_add(q.x, d.y * q.y) / across2).max(low).min(high);
        let p = d.mul_add(middle, q);
        let rho2 = p.x.mul_add(p.x, p.y * p.y);
        // Zero where the closest approach is within the span; rounding would give it either sign.
        let outward = p.x.mul_add(d.x, p.y * d.y);
        let slope = outward.max(zero).select(middle.le(low), outward.min(zero).select(middle.ge(high), zero));
        // ρ³ = j² at the inflections. Of a ray across the axis ρ₀ and j are nothing but rounding, and must agree: what has
        // a bend by the one and none by the other is no convex function, and Newton's steps overshoot.
        let j = p.y.neg_mul_add(d.x, p.x * d.y);
        let j2 = (rho2 * across2).select(slope.eq(zero), j * j);
        let gap = powf(j2, L::splat(2.0 / 3.0)) - rho2;
        let reach = gap / (slope.abs() + slope.mul_add(slope, across2 * gap).sqrt());
        // Where there are none, and where the ray meets the axis, which makes a kink, next to nothing is left out.
        let reach = reach.max(L::splat(1e-12));
        let ends = [low - middle, high - middle];
        let inflections = [ends[0].max(-reach), ends[1].min(reach)];
        let kappa2 = kappa * kappa;
        Self { middle, ends, inflections, rho2, slope, across2, j2, z: p.z, dz: d.z, kappa2, near }
    }

    /// ρ; not zero, as it is divided by. So close to the axis there is no surface but a horn torus's centre.
    #[inline(always)]
    fn rho(&self, u: L) -> L {
        u.mul_add(self.across2.mul_add(u, self.slope + self.slope), self.rho2).max(L::splat(1e-36)).sqrt()
    }

    /// g″ = 2 − 2 j² / ρ³.
    #[inline(always)]
    fn curvature(&self, u: L) -> L {
        let rho = self.rho(u);
        let ratio = self.j2 / (rho * rho * rho).max(L::splat(1e-36));
        L::splat(2.0) - (ratio + ratio)
    }

    /// g and g′ = 2 ((ρ − 1) ρ ρ′ + ρ z z′) / ρ.
    #[inline(always)]
    fn sample(&self, u: L) -> Sample<L> {
        let climb = self.across2.mul_add(u, self.slope);
        let rho = self.rho(u);
        let aside = rho - L::splat(1.0);
        let z = self.dz.mul_add(u, self.z);
        Sample {
            value: aside.mul_add(aside, z.mul_add(z, -self.kappa2)),
            rise: aside.mul_add(climb, rho * (z * self.dz)),
            run: rho * L::splat(0.5),
            near: self.near * rho.min(L::splat(1.0)),
        }
    }
}

#[cfg(test)]
mod tests;
