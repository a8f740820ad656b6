//! The sphere |p − center| = radius, seen from outside and inside.
//!
//! Four methods with one signature, all for unit directions, with f = o − center and c = |f|² − r²:
//!
//! - [`quadratic`]: t = −b ± √(b² − c), b = f·d. The textbook's. b² − c cancels for a small sphere far away
//!   (error ε |f|² against r²) and −b ± √ for a large one close by.
//! - [`geometric`]: the lecture's efficient one: distance of the centre from the ray first, then half the chord.
//!   **Only from outside**: it gives the entry point alone, so from inside it finds nothing. Cancels like `quadratic`.
//! - [`stable`]: the default. Haines, Günther, Akenine-Möller, *Precision Improvements for Ray/Sphere Intersection*,
//!   Ray Tracing Gems (2019), ch. 7: discriminant r² − |f − b d|², and the root that cancels from the other by c / q.
//!   The silhouette is off by at most 5 ε |f|, t by 8 ε t + 4 ε |f|² / (r cos θ) at incidence θ (ε = 2⁻²⁴). Right
//!   from outside, inside and on the sphere: a ray that leaves the surface hits nothing, one that enters the far side.
//! - [`double`]: `quadratic` in `f64`, with f exact and for directions of any length; t is rounded once, but for what
//!   cancels: the silhouette is off by at most 2⁻⁴⁹ |f|² / r.
//!
//! A ray that touches the sphere hits it when the computed discriminant is not negative.

use super::methods::SphereMethod;
use super::numbers::numbers;
use super::{Balls, Bounded, Cull, Footing, LaneHits, Mapping, Number, Primitives, Sides, Surface, Test, Variant};
use crate::math::{LaneMask, Lanes, MAX_LANES, Vec3, angle};

/// Spheres, column by column.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Spheres {
    /// The spheres' own surfaces; radii above zero.
    pub balls: Balls,
    /// Which side of each is there.
    pub sides: Vec<Sides>,
    /// Indices into the scene's materials.
    pub material: Vec<u32>,
    /// How all are tested.
    pub method: SphereMethod,
    /// How their normals come to unit length ([`Vec3::normalize_by`]).
    pub steps: Option<u32>,
}

numbers! {
    /// A sphere as stored.
    SphereShape {
        /// Its centre.
        center: Vec3,
        /// Its radius.
        radius: T,
    }
    /// A sphere as seen from the rays' origin.
    SeenSphere {
        /// f = o − center.
        f: Vec3,
        /// c = |f|² − r²: below zero inside.
        c: T,
        /// r².
        r2: T,
    }
    /// A sphere as seen from the rays' origin by the [`Slow`] methods.
    NamedSphere {
        /// f = o − center, rounded.
        f: Vec3,
        /// c = |f|² − r².
        c: T,
        /// r².
        r2: T,
        /// For [`double`]: the rounding that f lacks, o − center − f.
        lost: Vec3,
        /// For [`double`]: r.
        radius: T,
    }
}

impl Spheres {
    /// Adds a sphere.
    pub fn push(&mut self, center: glam::Vec3, radius: f32, sides: Sides, material: u32) {
        self.balls.push(center, radius);
        self.sides.push(sides);
        self.material.push(material);
    }

    /// Sphere `i`'s centre.
    #[inline]
    pub fn center(&self, i: usize) -> glam::Vec3 {
        self.balls.center(i)
    }

    /// Sphere `i`'s radius.
    pub fn radius(&self, i: usize) -> f32 {
        self.balls.radius[i]
    }
}

impl Bounded for Spheres {
    const BOXED: bool = false;
    const COST: [f64; 2] = [1.5, 0.05];
    /// Rounded to nearest: the traversal's margin covers it.
    #[inline(always)]
    fn extent<L: Lanes>(sphere: &SphereShape<L>) -> [Vec3<L>; 2] {
        let SphereShape { center, radius } = *sphere;
        let reach = Vec3::new(radius, radius, radius);
        [center - reach, center + reach]
    }
}

impl Primitives for Spheres {
    type Shape<T: Number> = SphereShape<T>;
    type Variant = Roots;
    type Seen<T: Copy> = SeenSphere<T>;
    type Aim<L: Lanes> = Vec3<L>;
    type Named = Slow;

    #[inline(always)]
    fn materials(&self) -> &[u32] {
        &self.material
    }
    #[inline]
    fn cull(&self) -> Cull<'_> {
        Cull::Balls(&self.balls)
    }
    #[inline(always)]
    fn shape(&self, i: usize) -> SphereShape<f32> {
        SphereShape { center: self.center(i).into(), radius: self.radius(i) }
    }
    #[inline(always)]
    fn variant(&self, i: usize) -> Roots {
        if self.method == SphereMethod::Quadratic { Roots::Quadratic } else { Roots::Stable(self.sides[i]) }
    }
    #[inline(always)]
    fn zip<A: Number, B: Number, C: Number>(
        a: &SphereShape<A>,
        b: &SphereShape<B>,
        f: impl Fn(&A, &B) -> C,
    ) -> SphereShape<C> {
        a.zip(b, f)
    }
    #[inline(always)]
    fn seen<L: Lanes>(sphere: &SphereShape<L>, _: Roots, origin: Vec3<L>) -> SeenSphere<L> {
        SeenSphere::new(sphere, origin)
    }
    #[inline(always)]
    fn splat_seen<L: Lanes>(seen: &SeenSphere<f32>) -> SeenSphere<L> {
        seen.map(|number| L::splat(*number))
    }
    #[inline(always)]
    fn nearest<L: Lanes>(seen: &SeenSphere<L>, roots: Roots, d: &Vec3<L>, t_min: L, t_max: L) -> LaneHits<L> {
        match roots {
            Roots::Stable(sides) => stable(seen, sides, *d, t_min, t_max),
            Roots::Quadratic => quadratic(seen, *d, t_min, t_max),
        }
    }
    #[inline(always)]
    fn named(&self) -> Option<Slow> {
        match self.method {
            SphereMethod::Stable | SphereMethod::Quadratic => None,
            SphereMethod::Geometric => Some(Slow::Geometric),
            SphereMethod::Double => Some(Slow::Double),
        }
    }

    #[inline(always)]
    fn surface<L: Lanes>(&self, i: usize, point: Vec3<L>) -> Surface<L> {
        let center = Vec3::splat(self.center(i));
        let radius = self.radius(i);
        let normal = (point - center).normalize_by(self.steps);
        Surface { point: normal.mul_add(L::splat(radius), center), normal, reach: radius }
    }
    #[inline(always)]
    fn footing<L: Lanes>(&self, i: usize, surface: &Surface<L>) -> Option<Footing<L>> {
        Some(Footing { point: surface.point, curvature: 1.0 / self.radius(i) })
    }
    #[inline(always)]
    fn uv<L: Lanes>(&self, _i: usize, surface: &Surface<L>) -> [L; 2] {
        let n = surface.normal;
        [angle::turn(n.x, n.z), angle::elevation(n.y, n.x.mul_add(n.x, n.z * n.z).sqrt())]
    }
    #[inline(always)]
    fn mapping<L: Lanes>(&self, _: usize, _: &Surface<L>) -> Mapping<L> {
        Mapping::around([true; 2])
    }
    #[inline(always)]
    fn checker<L: Lanes>(&self, i: usize, surface: &Surface<L>) -> Vec3<L> {
        surface.point - Vec3::splat(self.center(i))
    }
}

/// How the two roots of a sphere are found that the plan may choose: the variant of its test.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Roots {
    /// By [`stable`], which alone knows sides apart.
    Stable(Sides),
    /// By [`quadratic`].
    Quadratic,
}

impl Default for Roots {
    fn default() -> Self {
        Self::Stable(Sides::Both)
    }
}

impl Variant for Roots {
    fn code(self) -> u8 {
        match self {
            Self::Stable(sides) => sides.code(),
            Self::Quadratic => 3,
        }
    }
    #[inline(always)]
    fn both_sides(self) -> Self {
        match self {
            Self::Stable(_) => Self::Stable(Sides::Both),
            Self::Quadratic => self,
        }
    }
}

/// The methods that no plan chooses.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Slow {
    /// [`geometric`].
    Geometric,
    /// [`double`].
    Double,
}

impl Test<Spheres> for Slow {
    type Seen<T: Copy> = NamedSphere<T>;
    #[inline(always)]
    fn seen<L: Lanes>(self, sphere: &SphereShape<L>, _: Roots, origin: Vec3<L>) -> NamedSphere<L> {
        let seen = SeenSphere::new(sphere, origin);
        // What a subtraction rounds off, exactly (Knuth, TAOCP 2, §4.2.2, theorem B).
        let part = seen.f - origin;
        let lost = (origin - (seen.f - part)) - (sphere.center + part);
        NamedSphere { f: seen.f, c: seen.c, r2: seen.r2, lost, radius: sphere.radius }
    }
    #[inline(always)]
    fn splat_seen<L: Lanes>(seen: &NamedSphere<f32>) -> NamedSphere<L> {
        seen.map(|number| L::splat(*number))
    }
    #[inline(always)]
    fn nearest<L: Lanes>(self, sphere: &NamedSphere<L>, _: Roots, d: &Vec3<L>, t_min: L, t_max: L) -> LaneHits<L> {
        let NamedSphere { f, c, r2, lost, radius } = *sphere;
        match self {
            Self::Geometric => geometric(&SeenSphere { f, c, r2 }, *d, t_min, t_max),
            // Number by number, so that the other has its own in registers.
            Self::Double => double([f, lost], radius, [d.x, d.y, d.z], t_min, t_max),
        }
    }
}

impl<L: Lanes> SeenSphere<L> {
    /// A sphere as seen from `origin`.
    #[inline(always)]
    pub fn new(sphere: &SphereShape<L>, origin: Vec3<L>) -> Self {
        let f = origin - sphere.center;
        let r2 = sphere.radius * sphere.radius;
        Self { f, c: f.dot(f) - r2, r2 }
    }
}

/// The default; see the module's text.
#[inline(always)]
pub fn stable<L: Lanes>(seen: &SeenSphere<L>, sides: Sides, direction: Vec3<L>, t_min: L, t_max: L) -> LaneHits<L> {
    let (near, far, possible) = roots(seen, direction)?;
    let t = match sides {
        Sides::Both => near.select(near.gt(t_min), far),
        Sides::Front => near,
        Sides::Back => far,
    };
    let inside = possible & t.gt(t_min) & t.lt(t_max);
    inside.any().then_some((t, inside))
}

/// Where the ray enters and leaves, and the lanes in which it may; `None` when it cannot in any.
#[inline(always)]
fn roots<L: Lanes>(seen: &SeenSphere<L>, direction: Vec3<L>) -> Option<(L, L, L::Mask)> {
    let SeenSphere { f, c, r2 } = *seen;
    let b = f.dot(direction);
    // The vector from the centre to the ray's closest point: its length does not cancel as b² − c does.
    let closest = direction.mul_add(-b, f);
    let discriminant = r2 - closest.dot(closest);
    // From outside (c ≥ 0) and moving away (b ≥ 0), both distances are at most zero.
    let possible = L::zero().le(discriminant) & b.min(c).lt(L::zero());
    if !possible.any() {
        return None;
    }
    let root = discriminant.sqrt();
    let ahead = b.lt(L::zero());
    let q = (root - b).select(ahead, -(b + root));
    let other = c / q;
    Some((other.select(ahead, q), q.select(ahead, other), possible))
}

/// The textbook's; see the module's text.
#[inline(always)]
pub fn quadratic<L: Lanes>(seen: &SeenSphere<L>, direction: Vec3<L>, t_min: L, t_max: L) -> LaneHits<L> {
    let b = seen.f.dot(direction);
    let discriminant = b * b - seen.c;
    let possible = L::zero().le(discriminant);
    if !possible.any() {
        return None;
    }
    let root = discriminant.sqrt();
    let near = -b - root;
    let t = near.select(near.gt(t_min), root - b);
    let inside = possible & t.gt(t_min) & t.lt(t_max);
    inside.any().then_some((t, inside))
}

/// The lecture's, from outside only; see the module's text.
#[inline(always)]
pub fn geometric<L: Lanes>(seen: &SeenSphere<L>, direction: Vec3<L>, t_min: L, t_max: L) -> LaneHits<L> {
    let along = -seen.f.dot(direction);
    let q = direction.mul_add(along, seen.f);
    let p2 = q.dot(q);
    let possible = p2.le(seen.r2);
    if !possible.any() {
        return None;
    }
    let t = along - (seen.r2 - p2).sqrt();
    let inside = possible & t.gt(t_min) & t.lt(t_max);
    inside.any().then_some((t, inside))
}

/// [`quadratic`] in `f64`; see the module's text.
#[inline(never)]
pub fn double<L: Lanes>([f, lost]: [Vec3<L>; 2], radius: L, d: [L; 3], t_min: L, t_max: L) -> LaneHits<L> {
    let [f, lost] = [[f.x, f.y, f.z], [lost.x, lost.y, lost.z]];
    let lanes = |v: L| {
        let mut lanes = [0.0; MAX_LANES];
        v.store(&mut lanes);
        lanes
    };
    let (radius, least) = (lanes(radius), lanes(t_min));
    // The dot products f f, f d and d d, lane by lane.
    let mut dots = [[0.0; MAX_LANES]; 3];
    for axis in 0..3 {
        let (f, lost, d) = (lanes(f[axis]), lanes(lost[axis]), lanes(d[axis]));
        for i in 0..L::WIDTH {
            let (f, d) = (f64::from(f[i]) + f64::from(lost[i]), f64::from(d[i]));
            dots[0][i] += f * f;
            dots[1][i] += f * d;
            dots[2][i] += d * d;
        }
    }
    let mut t = [f32::NAN; MAX_LANES];
    for i in 0..L::WIDTH {
        let (c, b, a) = (dots[0][i] - f64::from(radius[i]) * f64::from(radius[i]), dots[1][i], dots[2][i]);
        // NaN where there is no root, and so no hit.
        let root = (b * b - a * c).sqrt();
        let near = (-b - root) / a;
        t[i] = if near > f64::from(least[i]) { near as f32 } else { ((root - b) / a) as f32 };
    }
    let t = L::load(&t);
    let inside = t.gt(t_min) & t.lt(t_max);
    inside.any().then_some((t, inside))
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::{Vec3 as V, vec3};

    fn t(method: SphereMethod, center: V, radius: f32, origin: V, direction: V) -> Option<f32> {
        let mut spheres = Spheres::default();
        spheres.push(center, radius, Sides::Both, 0);
        spheres.method = method;
        spheres.test::<f32>(0, origin.into(), direction.into(), 0.0, f32::INFINITY).map(|(t, _)| t)
    }

    #[test]
    fn from_outside_every_method_agrees() {
        for &method in SphereMethod::ALL {
            let name = method.name();
            assert_eq!(t(method, V::ZERO, 1.0, vec3(0.0, 0.0, 3.0), V::NEG_Z), Some(2.0), "{name}");
            assert_eq!(t(method, V::ZERO, 1.0, vec3(0.0, 0.0, 3.0), V::Z), None, "{name} behind");
            assert_eq!(t(method, V::ZERO, 1.0, vec3(0.0, 2.0, 3.0), V::NEG_Z), None, "{name} beside");
            assert_eq!(t(method, V::ZERO, 1.0, vec3(0.0, 1.0, 3.0), V::NEG_Z), Some(3.0), "{name} tangent");
        }
    }

    #[test]
    fn from_inside_geometric_fails_and_the_others_hold() {
        let origin = vec3(0.0, 0.0, 0.5);
        assert_eq!(t(SphereMethod::Geometric, V::ZERO, 1.0, origin, V::NEG_Z), None);
        assert_eq!(t(SphereMethod::Quadratic, V::ZERO, 1.0, origin, V::NEG_Z), Some(1.5));
        assert_eq!(t(SphereMethod::Stable, V::ZERO, 1.0, origin, V::NEG_Z), Some(1.5));
        assert_eq!(t(SphereMethod::Stable, V::ZERO, 1.0, origin, V::Z), Some(0.5));
        assert_eq!(t(SphereMethod::Stable, V::ZERO, 1.0, V::ZERO, V::X), Some(1.0), "from the centre");
    }

    #[test]
    fn from_the_surface_only_the_far_side_is_hit() {
        assert_eq!(t(SphereMethod::Stable, V::ZERO, 1.0, V::Z, V::Z), None);
        assert_eq!(t(SphereMethod::Stable, V::ZERO, 1.0, V::Z, V::NEG_Z), Some(2.0));
        assert_eq!(t(SphereMethod::Stable, V::ZERO, 1.0, V::Z, V::X), None, "tangent from the surface");
    }

    #[test]
    fn small_and_far_quadratic_fails_and_stable_holds() {
        // |f|² = 1e8 is a multiple of 8 in f32, r² = 1: the textbook's discriminant is noise, and it misses.
        let (center, direction) = (vec3(3000.0, 4000.0, 8660.254), vec3(0.3, 0.4, 0.8660254));
        let mut misses = 0;
        for step in 0..100 {
            let aside = direction.cross(V::Y).normalize() * (0.9 * step as f32 / 100.0);
            let ray = (center + aside).normalize();
            let held = t(SphereMethod::Stable, center, 1.0, V::ZERO, ray);
            assert!(held.is_some_and(|t| (t - 10_000.0).abs() < 1.1), "{step}: {held:?}");
            misses +=
                t(SphereMethod::Quadratic, center, 1.0, V::ZERO, ray).is_none_or(|t| (t - 10_000.0).abs() > 1.1) as u32;
        }
        assert!(misses > 10, "{misses}");
    }

    #[test]
    fn huge_and_close_quadratic_fails_and_stable_holds() {
        // 4 above a planet of radius 1e4, −b − √(b² − c) has an ulp of 0.001; c / q has the 5e-5 of c alone.
        let (height, radius) = (4.0, 10_000.0f32);
        let origin = vec3(0.0, radius + height, 0.0);
        let mut wrong = 0;
        for step in 1..100 {
            let direction = vec3(1.0 - step as f32 / 100.0, -0.02 * step as f32 - 0.02, 0.0).normalize();
            let (o, d) = (origin.as_dvec3(), direction.as_dvec3());
            let (b, c) = (o.dot(d), o.length_squared() - f64::from(radius).powi(2));
            let exact = (c / ((b * b - c).sqrt() - b)) as f32;
            let off = |t: Option<f32>| t.map_or(1.0, |t| (t / exact - 1.0).abs());
            assert!(off(t(SphereMethod::Stable, V::ZERO, radius, origin, direction)) < 1e-4, "{step}");
            wrong += (off(t(SphereMethod::Quadratic, V::ZERO, radius, origin, direction)) > 1e-4) as u32;
        }
        assert!(wrong >= 5, "{wrong}");
    }
}
