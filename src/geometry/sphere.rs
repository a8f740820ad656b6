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
use super::{Balls, Bounded, Nearest, Primitives, Sides, Surface};
use crate::math::{LaneMask, Lanes, MOST_LANES, Vec3, angle};

/// Spheres, column by column.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Spheres {
    /// The spheres' own surfaces; radii above zero.
    pub balls: Balls,
    /// Which side of each is there.
    pub sides: Vec<Sides>,
    /// The same for all, where it is.
    side: Option<Sides>,
    /// Indices into the scene's materials.
    pub material: Vec<u32>,
    /// How all are tested.
    pub method: SphereMethod,
    /// How their normals come to unit length ([`Vec3::normalize_by`]).
    pub steps: Option<u32>,
}

/// A sphere as stored.
#[derive(Clone, Copy, Debug)]
pub struct SphereRecord {
    /// Its centre.
    pub center: Vec3<f32>,
    /// Its radius.
    pub radius: f32,
    /// Which side is there.
    pub sides: Sides,
    /// How it is tested.
    pub method: SphereMethod,
}

/// What a sphere's test needs of it and of the rays' origin.
#[derive(Clone, Copy, Debug)]
pub struct SeenSphere<L> {
    /// f = o − center.
    pub f: Vec3<L>,
    /// c = |f|² − r²: below zero inside.
    pub c: L,
    /// r².
    pub r2: L,
    /// What f is short of o − center for its rounding, and r; for [`double`] alone.
    pub exact: (Vec3<L>, L),
    /// Which side is there.
    pub sides: Sides,
    /// How it is tested.
    pub method: SphereMethod,
}

impl Spheres {
    /// Adds a sphere.
    pub fn push(&mut self, center: glam::Vec3, radius: f32, sides: Sides, material: u32) {
        self.balls.push(center, radius);
        self.side = if self.sides.is_empty() { Some(sides) } else { self.side.filter(|&side| side == sides) };
        self.sides.push(sides);
        self.material.push(material);
    }

    /// Which side of all is there, where [`one_sided`] with that, or [`stable`], is the test of all.
    #[inline(always)]
    pub fn common_side(&self) -> Option<Sides> {
        self.side.filter(|_| self.method == SphereMethod::Stable)
    }

    /// Sphere `i`'s centre.
    pub fn center(&self, i: usize) -> glam::Vec3 {
        self.balls.center(i)
    }

    /// Sphere `i`'s radius.
    pub fn radius(&self, i: usize) -> f32 {
        self.balls.radius[i]
    }
}

impl Bounded for Spheres {
    fn balls(&self) -> &Balls {
        &self.balls
    }
}

impl Primitives for Spheres {
    type Record = SphereRecord;
    type Seen<L: Lanes> = SeenSphere<L>;
    type Aim<L: Lanes> = Vec3<L>;

    #[inline(always)]
    fn materials(&self) -> &[u32] {
        &self.material
    }
    #[inline(always)]
    fn record(&self, i: usize) -> SphereRecord {
        let (center, radius) = (self.center(i).into(), self.radius(i));
        SphereRecord { center, radius, sides: self.sides[i], method: self.method }
    }
    #[inline(always)]
    fn seen<L: Lanes>(r: &SphereRecord, origin: Vec3<L>) -> SeenSphere<L> {
        SeenSphere::new(Vec3::splat(r.center.into()), L::splat(r.radius), r.sides, r.method, origin)
    }
    #[inline(always)]
    fn splat<L: Lanes>(s: &SeenSphere<f32>) -> SeenSphere<L> {
        SeenSphere {
            f: Vec3::splat(s.f.into()),
            c: L::splat(s.c),
            r2: L::splat(s.r2),
            exact: (Vec3::splat(s.exact.0.into()), L::splat(s.exact.1)),
            sides: s.sides,
            method: s.method,
        }
    }
    #[inline(always)]
    fn nearest<L: Lanes, const SIDED: bool>(seen: &SeenSphere<L>, d: &Vec3<L>, t_min: L, t_max: L) -> Nearest<L> {
        match seen.method {
            SphereMethod::Quadratic => quadratic(seen, *d, t_min, t_max),
            // The others are rare, and the call of `double` alone would cost all registers.
            _ if !SIDED => stable(seen, *d, t_min, t_max),
            SphereMethod::Stable => one_sided(seen, *d, t_min, t_max),
            SphereMethod::Geometric => geometric(seen, *d, t_min, t_max),
            SphereMethod::Double => double(seen, *d, t_min, t_max),
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
    fn uv<L: Lanes>(&self, _i: usize, surface: &Surface<L>) -> [L; 2] {
        let n = surface.normal;
        [angle::turn(n.x, n.z), angle::elevation(n.y, n.x.mul_add(n.x, n.z * n.z).sqrt())]
    }
    #[inline(always)]
    fn checker<L: Lanes>(&self, i: usize, surface: &Surface<L>) -> Vec3<L> {
        surface.point - Vec3::splat(self.center(i))
    }
}

impl<L: Lanes> SeenSphere<L> {
    /// A sphere as seen from `origin`.
    #[inline(always)]
    pub fn new(center: Vec3<L>, radius: L, sides: Sides, method: SphereMethod, origin: Vec3<L>) -> Self {
        let f = origin - center;
        let r2 = radius * radius;
        let lost = match method {
            // What a subtraction rounds off, exactly (Knuth, TAOCP 2, §4.2.2, theorem B).
            SphereMethod::Double => {
                let part = f - origin;
                (origin - (f - part)) - (center + part)
            }
            _ => Vec3::splat(glam::Vec3::ZERO),
        };
        Self { f, c: f.dot(f) - r2, r2, exact: (lost, radius), sides, method }
    }
}

/// The default; see the module's text.
#[inline(always)]
pub fn stable<L: Lanes>(seen: &SeenSphere<L>, direction: Vec3<L>, t_min: L, t_max: L) -> Nearest<L> {
    let (near, far, possible) = roots(seen, direction)?;
    let t = near.select(near.gt(t_min), far);
    let inside = possible & t.gt(t_min) & t.lt(t_max);
    inside.any().then_some((t, inside))
}

/// [`stable`], for a sphere of which only one side is there.
#[inline(always)]
pub fn one_sided<L: Lanes>(seen: &SeenSphere<L>, direction: Vec3<L>, t_min: L, t_max: L) -> Nearest<L> {
    let (near, far, possible) = roots(seen, direction)?;
    let t = match seen.sides {
        Sides::Both => near.select(near.gt(t_min), far),
        Sides::Front => near,
        Sides::Back => far,
    };
    let inside = possible & t.gt(t_min) & t.lt(t_max);
    inside.any().then_some((t, inside))
}

/// Whether any lane's ray passes through its sphere.
#[inline(always)]
pub fn passes<L: Lanes>(seen: &SeenSphere<L>, direction: Vec3<L>) -> bool {
    roots(seen, direction).is_some()
}

/// Where the ray enters and leaves, and the lanes in which it may; `None` when it cannot in any.
#[inline(always)]
fn roots<L: Lanes>(seen: &SeenSphere<L>, direction: Vec3<L>) -> Option<(L, L, L::Mask)> {
    let SeenSphere { f, c, r2, .. } = *seen;
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
pub fn quadratic<L: Lanes>(seen: &SeenSphere<L>, direction: Vec3<L>, t_min: L, t_max: L) -> Nearest<L> {
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
pub fn geometric<L: Lanes>(seen: &SeenSphere<L>, direction: Vec3<L>, t_min: L, t_max: L) -> Nearest<L> {
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
pub fn double<L: Lanes>(seen: &SeenSphere<L>, direction: Vec3<L>, t_min: L, t_max: L) -> Nearest<L> {
    let lanes = |v: L| {
        let mut lanes = [0.0; MOST_LANES];
        v.store(&mut lanes);
        lanes.map(f64::from)
    };
    let (lost, radius) = seen.exact;
    let f = [(seen.f.x, lost.x), (seen.f.y, lost.y), (seen.f.z, lost.z)].map(|(f, lost)| (lanes(f), lanes(lost)));
    let d = [direction.x, direction.y, direction.z].map(lanes);
    let (radius, t_min) = (lanes(radius), lanes(t_min));
    let mut t = [f32::NAN; MOST_LANES];
    for i in 0..L::WIDTH {
        let f = [0, 1, 2].map(|axis| f[axis].0[i] + f[axis].1[i]);
        let d = [0, 1, 2].map(|axis| d[axis][i]);
        let dot = |a: [f64; 3], b: [f64; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
        let (a, b) = (dot(d, d), dot(f, d));
        // NaN where there is no root, and so no hit.
        let root = (b * b - a * (dot(f, f) - radius[i] * radius[i])).sqrt();
        let near = (-b - root) / a;
        t[i] = if near > t_min[i] { near as f32 } else { ((root - b) / a) as f32 };
    }
    let t = L::load(&t);
    let inside = t.gt(L::load(&t_min.map(|t| t as f32))) & t.lt(t_max);
    inside.any().then_some((t, inside))
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::{Vec3 as V, vec3};

    type Method = fn(&SeenSphere<f32>, Vec3<f32>, f32, f32) -> Nearest<f32>;
    const METHODS: [(&str, Method); 4] =
        [("quadratic", quadratic), ("geometric", geometric), ("stable", stable), ("double", double)];

    fn t(method: Method, center: V, radius: f32, origin: V, direction: V) -> Option<f32> {
        let mut spheres = Spheres::default();
        spheres.push(center, radius, Sides::Both, 0);
        // So that what it needs is there.
        spheres.method = SphereMethod::Double;
        method(&Spheres::seen(&spheres.record(0), origin.into()), direction.into(), 0.0, f32::INFINITY).map(|(t, _)| t)
    }

    #[test]
    fn from_outside_every_method_agrees() {
        for (name, method) in METHODS {
            assert_eq!(t(method, V::ZERO, 1.0, vec3(0.0, 0.0, 3.0), V::NEG_Z), Some(2.0), "{name}");
            assert_eq!(t(method, V::ZERO, 1.0, vec3(0.0, 0.0, 3.0), V::Z), None, "{name} behind");
            assert_eq!(t(method, V::ZERO, 1.0, vec3(0.0, 2.0, 3.0), V::NEG_Z), None, "{name} beside");
            assert_eq!(t(method, V::ZERO, 1.0, vec3(0.0, 1.0, 3.0), V::NEG_Z), Some(3.0), "{name} tangent");
        }
    }

    #[test]
    fn from_inside_geometric_fails_and_the_others_hold() {
        let origin = vec3(0.0, 0.0, 0.5);
        assert_eq!(t(geometric, V::ZERO, 1.0, origin, V::NEG_Z), None);
        assert_eq!(t(quadratic, V::ZERO, 1.0, origin, V::NEG_Z), Some(1.5));
        assert_eq!(t(stable, V::ZERO, 1.0, origin, V::NEG_Z), Some(1.5));
        assert_eq!(t(stable, V::ZERO, 1.0, origin, V::Z), Some(0.5));
        assert_eq!(t(stable, V::ZERO, 1.0, V::ZERO, V::X), Some(1.0), "from the centre");
    }

    #[test]
    fn from_the_surface_only_the_far_side_is_hit() {
        assert_eq!(t(stable, V::ZERO, 1.0, V::Z, V::Z), None);
        assert_eq!(t(stable, V::ZERO, 1.0, V::Z, V::NEG_Z), Some(2.0));
        assert_eq!(t(stable, V::ZERO, 1.0, V::Z, V::X), None, "tangent from the surface");
    }

    #[test]
    fn small_and_far_quadratic_fails_and_stable_holds() {
        // |f|² = 1e8 is a multiple of 8 in f32, r² = 1: the textbook's discriminant is noise, and it misses.
        let (center, direction) = (vec3(3000.0, 4000.0, 8660.254), vec3(0.3, 0.4, 0.8660254));
        let mut misses = 0;
        for step in 0..100 {
            let aside = direction.cross(V::Y).normalize() * (0.9 * step as f32 / 100.0);
            let ray = (center + aside).normalize();
            let held = t(stable, center, 1.0, V::ZERO, ray);
            assert!(held.is_some_and(|t| (t - 10_000.0).abs() < 1.1), "{step}: {held:?}");
            misses += t(quadratic, center, 1.0, V::ZERO, ray).is_none_or(|t| (t - 10_000.0).abs() > 1.1) as u32;
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
            assert!(off(t(stable, V::ZERO, radius, origin, direction)) < 1e-4, "{step}");
            wrong += (off(t(quadratic, V::ZERO, radius, origin, direction)) > 1e-4) as u32;
        }
        assert!(wrong >= 5, "{wrong}");
    }
}
