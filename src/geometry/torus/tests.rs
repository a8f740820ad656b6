use super::*;
use crate::reference::Tracer;
use crate::scene::{self, Description};
use glam::{DVec3, Vec3 as V, dvec3};
use std::f64::consts::TAU;
use wide::{f32x4, f32x8};

mod methods;
mod start;

const U: f64 = ROUNDOFF as f64;

/// r / R of the tori that are tested; 1 is a horn torus.
const KAPPAS: [f32; 8] = [1.0, 0.999, 0.7, 0.5, 0.25, 0.01, 1e-3, 1e-5];

/// Marsaglia's xorshift: the same numbers everywhere.
struct Rng(u64);

impl Rng {
    fn range(&mut self, low: f64, high: f64) -> f64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        low + (high - low) * ((self.0 >> 11) as f64 / (1u64 << 53) as f64)
    }

    fn below(&mut self, n: usize) -> usize {
        self.range(0.0, n as f64) as usize
    }

    fn unit(&mut self) -> DVec3 {
        let (z, angle) = (self.range(-1.0, 1.0), self.range(0.0, TAU));
        let across = (1.0 - z * z).sqrt();
        dvec3(across * angle.cos(), across * angle.sin(), z)
    }
}

/// One of the methods.
type Method<L> = fn(&SeenTorus<L>, Vec3<L>, L, L) -> LaneHits<L>;

/// One torus, as traced and as described.
struct Case {
    it: scene::Torus,
    tori: Tori,
    tracer: Tracer,
}

impl Case {
    fn new(center: V, axis: V, major: f32, minor: f32) -> Self {
        let it = scene::Torus { center, axis, major_radius: major, minor_radius: minor, material: 0 };
        let mut tori = Tori::default();
        tori.push(center, axis, major, minor, 0);
        Self { it, tori, tracer: Tracer::new(&Description { tori: vec![it], ..Description::default() }) }
    }

    /// Along the axis, with a unit major radius.
    fn unit(kappa: f32) -> Self {
        Self::new(V::ZERO, V::Z, 1.0, kappa)
    }

    fn by(&self, method: Method<f32>, ray: (V, V), t_min: f32, t_max: f32) -> Option<f32> {
        method(&Tori::seen(&self.tori.shape(0), (), ray.0.into()), ray.1.into(), t_min, t_max).map(|(t, _)| t)
    }

    fn between(&self, ray: (V, V), t_min: f32, t_max: f32) -> Option<f32> {
        self.by(monotone_newton, ray, t_min, t_max)
    }

    fn hit(&self, origin: V, direction: V) -> Option<f32> {
        self.between((origin, direction), 0.0, f32::INFINITY)
    }

    fn exact(&self, origin: DVec3, direction: DVec3) -> Option<f64> {
        self.tracer.intersect(origin, direction.normalize(), f64::INFINITY).map(|hit| hit.t)
    }

    /// World from axes, with the torus's own along z.
    fn world(&self, q: DVec3) -> DVec3 {
        let [t, b, a] = self.tori.axes[0].map(|v| v.as_dvec3());
        self.it.center.as_dvec3() + t * q.x + b * q.y + a * q.z
    }

    fn radii(&self) -> [f64; 2] {
        [self.it.major_radius, self.it.minor_radius].map(f64::from)
    }

    /// How far a point is from the surface, and the normal there.
    fn off(&self, point: DVec3) -> (f64, DVec3) {
        let [major, minor] = self.radii();
        let a = self.it.axis.as_dvec3().normalize();
        let q = point - self.it.center.as_dvec3();
        let across = q - a * a.dot(q);
        let outward = q - across.normalize_or(a.any_orthonormal_vector()) * major;
        (outward.length() - minor, outward.normalize())
    }

    /// The least radius of curvature at a point of the surface: across the tube, or around the axis.
    fn curvature_radius(&self, point: V) -> f64 {
        let q = point.as_dvec3() - self.it.center.as_dvec3();
        self.radii()[1].min(q.reject_from_normalized(self.it.axis.as_dvec3().normalize()).length())
    }

    /// A point of the surface and its normal, along the torus's own axes.
    fn random_point(&self, rng: &mut Rng) -> (DVec3, DVec3) {
        let [major, minor] = self.radii();
        let (sin_u, cos_u) = rng.range(0.0, TAU).sin_cos();
        let (sin_v, cos_v) = rng.range(0.0, TAU).sin_cos();
        let normal = dvec3(cos_v * cos_u, cos_v * sin_u, sin_v);
        (dvec3(cos_u, sin_u, 0.0) * major + normal * minor, normal)
    }
}

const FAMILIES: [&str; 9] = [
    "random",
    "tangent",
    "along the axis",
    "through the axis",
    "equator",
    "touching the equator",
    "from inside",
    "far",
    "from the centre",
];

/// A ray of one of the [`FAMILIES`].
fn ray(case: &Case, family: usize, rng: &mut Rng) -> (V, V) {
    let [major, minor] = case.radii();
    let size = major + minor;
    let (sin, cos) = rng.range(0.0, TAU).sin_cos();
    let around = dvec3(cos, sin, 0.0);
    let from = rng.unit() * (size * rng.range(1.0, 4.0));
    let edges = [major + minor, major - minor, major, 0.0, major + minor * rng.range(-1.0, 1.0)];
    let edge = edges[rng.below(5)];
    let (from, to) = match family {
        0 => (from, rng.unit() * (size * rng.range(0.0, 1.0))),
        1 => {
            let (p, n) = case.random_point(rng);
            (p + n.cross(rng.unit()).normalize() * (size * rng.range(0.01, 3.0)), p)
        }
        2 => {
            let p = around * edge;
            (p + DVec3::Z * (size * rng.range(-2.0, 2.0)), p)
        }
        3 => (from, DVec3::Z * (minor * rng.range(-2.0, 2.0))),
        4 => (around * (size * rng.range(0.0, 3.0)), dvec3(sin, -cos, 0.0) * edge),
        5 => (around * edge + dvec3(-sin, cos, 0.0) * (size * rng.range(0.0, 2.0)), around * edge),
        6 => (around * major + rng.unit() * (minor * rng.range(0.0, 0.99)), rng.unit() * size),
        7 => (from * 1e4, case.random_point(rng).0 * rng.range(0.9, 1.1)),
        _ => (DVec3::ZERO, rng.unit() * size),
    };
    let (o, to) = (case.world(from).as_vec3(), case.world(to));
    (o, (to - o.as_dvec3()).normalize_or(DVec3::X).as_vec3())
}

/// Tori of all kinds, sizes and places.
fn cases() -> Vec<Case> {
    let mut rng = Rng(1);
    let mut cases = Vec::new();
    for kappa in KAPPAS {
        for scale in [1.0, 1e-8, 1e8, 1e-12 / kappa, 1e12] {
            for (place, axis) in [(0.0, V::Z), (0.0, V::NEG_Y), (1.0, rng.unit().as_vec3() * 3.0)] {
                let center = (rng.unit() * place * f64::from(scale)).as_vec3();
                cases.push(Case::new(center, axis, scale, scale * kappa));
            }
        }
    }
    cases
}

/// How far a ray may be off for its answer to count: as `measure::verify` has it.
const K: f64 = 16.0;

/// Whether a ray within the bound has this answer.
fn explained(case: &Case, (o, d): (DVec3, DVec3), t: Option<f32>, rng: &mut Rng) -> bool {
    let size: f64 = case.radii().iter().sum();
    let scale = o.length().max((o - case.it.center.as_dvec3()).length()).max(size);
    let (mut low, mut high, mut missed) = (f64::INFINITY, f64::NEG_INFINITY, false);
    for i in 0..1000 {
        // Every other one near the middle, at all sizes.
        let much = if i % 2 == 0 { rng.range(0.0, 1.0) } else { 1e-6f64.powf(rng.range(0.0, 1.0)) };
        let shift = rng.unit() * (K * U * scale * much);
        let turn = rng.unit() * (K * U * rng.range(0.0, 1.0));
        match case.exact(o + shift, d + turn) {
            Some(t) => (low, high) = (low.min(t), high.max(t)),
            None => missed = true,
        }
        let within = |t: f32| (low * (1.0 - K * U)..=high * (1.0 + K * U)).contains(&f64::from(t));
        if t.map_or(missed, within) {
            return true;
        }
    }
    let most = K * U * scale;
    t.is_some_and(|t| touches(case, (o, d), f64::from(t), most) || at_the_horn(case, o + d * f64::from(t), most))
}

/// Whether a ray moved by up to `most` across the surface is hit at t: where it touches the surface few random rays
/// are hit as late as the touching one.
fn touches(case: &Case, (o, d): (DVec3, DVec3), t: f64, most: f64) -> bool {
    let normal = case.off(o + d * t).1;
    let (mut low, mut high, mut latest) = (-most, most, f64::NEG_INFINITY);
    for _ in 0..100 {
        let middle = 0.5 * (low + high);
        match case.exact(o + normal * middle, d) {
            Some(hit) if hit < t => (low, latest) = (middle, hit),
            _ => high = middle,
        }
    }
    // Moved along itself as well.
    (latest - t).abs() <= K * U * t + most
}

/// Whether a point is where a horn torus meets itself: a ray through there touches the surface, and hardly one beside.
/// On the axis a distance x from there the surface is x² / 2 R away.
fn at_the_horn(case: &Case, point: DVec3, most: f64) -> bool {
    let [major, minor] = case.radii();
    major == minor && point.distance_squared(case.it.center.as_dvec3()) <= 2.0 * major * most
}

#[test]
fn agrees_with_the_reference() {
    let mut rng = Rng(2);
    let mut looked_into = [0; FAMILIES.len()];
    let mut hits = 0;
    for case in cases() {
        let size: f64 = case.radii().iter().sum();
        for (family, name) in FAMILIES.iter().enumerate() {
            for _ in 0..20 {
                let (origin, direction) = ray(&case, family, &mut rng);
                let (o, d) = (origin.as_dvec3(), direction.as_dvec3());
                let (t, exact) = (case.hit(origin, direction), case.exact(o, d));
                let bound = 12.0 * size + 4.0 * (o - case.it.center.as_dvec3()).length();
                let mut near = t.is_none() && exact.is_none();
                if let Some(t) = t {
                    hits += 1;
                    let p = o + d * f64::from(t);
                    let off = case.off(p).0.abs() / U / bound;
                    assert!(off <= 1.0, "{name}: {:?} {origin} {direction}: {t} is {off} bounds off", case.it);
                    let cosine = case.off(p).1.dot(d).abs();
                    near = exact.is_some_and(|exact| {
                        (f64::from(t) - exact).abs() * cosine <= 2.0 * U * (bound + exact * cosine) && cosine > 0.01
                    });
                }
                if !near {
                    looked_into[family] += 1;
                    let ok = explained(&case, (o, d), t, &mut rng);
                    assert!(ok, "{name}: {:?} {origin} {direction}: {t:?} for {exact:?}", case.it);
                }
            }
        }
    }
    assert!(hits > 10_000, "{hits}");
    // Only what touches the surface is ever in doubt.
    assert!(looked_into[0] + looked_into[3] + looked_into[6] + looked_into[8] < 10, "{looked_into:?}");
}

/// Answers of a packet kernel, as bits; NaN rays among them.
fn bits<L: Lanes>(method: Method<L>, case: &Case, rays: &[(V, V)]) -> Vec<Option<u32>> {
    let mut out = Vec::new();
    for packet in rays.chunks_exact(L::WIDTH) {
        let column = |pick: &dyn Fn(&(V, V)) -> f32| L::load(&packet.iter().map(pick).collect::<Vec<_>>());
        let vector = |pick: &dyn Fn(&(V, V)) -> V| {
            Vec3::new(column(&|ray| pick(ray).x), column(&|ray| pick(ray).y), column(&|ray| pick(ray).z))
        };
        let seen = Tori::seen(&Tori::splat(&case.tori.shape(0)), (), vector(&|ray| ray.0));
        let mut lanes = vec![0.0; L::WIDTH];
        let hit = method(&seen, vector(&|ray| ray.1), L::zero(), L::splat(f32::INFINITY));
        let found = hit.map_or(0, |(t, found)| {
            t.store(&mut lanes);
            found.bits()
        });
        out.extend(lanes.iter().enumerate().map(|(i, t)| (found >> i & 1 == 1).then_some(t.to_bits())));
    }
    out
}

#[test]
fn all_widths_agree_to_the_bit() {
    let least = widths_agree(monotone_newton, monotone_newton, monotone_newton);
    assert!(least > 60, "{least}");
}

/// The least number of hits of 240 rays at a torus.
fn widths_agree(x1: Method<f32>, x4: Method<f32x4>, x8: Method<f32x8>) -> usize {
    let (mut rng, mut least) = (Rng(3), usize::MAX);
    for case in cases() {
        let mut rays: Vec<_> = (0..240).map(|_| ray(&case, rng.below(FAMILIES.len()), &mut rng)).collect();
        for i in (0..240).step_by(17) {
            rays[i].0.y = f32::NAN;
            rays[(i + 5) % 240].1.x = f32::NAN;
            rays[(i + 7) % 240].1 = V::ZERO;
        }
        let one = bits(x1, &case, &rays);
        assert_eq!(one, bits(x4, &case, &rays));
        assert_eq!(one, bits(x8, &case, &rays));
        least = least.min(one.iter().flatten().count());
        for (ray, t) in rays.iter().zip(&one) {
            assert!(t.is_none() || !(ray.0.is_nan() || ray.1.is_nan()), "{ray:?}: {t:?}");
        }
    }
    least
}

#[test]
fn from_outside_inside_and_the_hole() {
    let case = Case::unit(0.25);
    let close = |t: Option<f32>, exact: f32| assert!(t.is_some_and(|t| (t - exact).abs() < 1e-6), "{t:?} {exact}");
    close(case.hit(V::X * 3.0, V::NEG_X), 1.75);
    close(case.hit(V::ZERO, V::NEG_Y), 0.75);
    close(case.hit(V::Y, V::NEG_Y), 0.25);
    close(case.hit(V::Y, V::Z), 0.25);
    close(case.hit(V::Y, V::X), (1.25f32 * 1.25 - 1.0).sqrt());
    for zero in [0.0, -0.0] {
        assert_eq!(case.hit(V::Z * 3.0, V::new(zero, zero, -1.0)), None, "through the hole");
        assert_eq!(case.hit(V::X * 3.0, V::new(1.0, zero, zero)), None, "away");
        assert_eq!(case.hit(V::new(3.0, 0.0, 0.26), V::new(-1.0, zero, zero)), None, "above");
        close(case.hit(V::new(1.0, 0.0, 2.0), V::new(zero, zero, -1.0)), 1.75);
    }
    for bad in [f32::NAN, f32::INFINITY] {
        assert_eq!(case.hit(V::X * bad, V::NEG_X), None);
        assert_eq!(case.hit(V::X * 3.0, V::X * bad), None);
        assert_eq!(case.between((V::X * 3.0, V::NEG_X), f32::NAN, 9.0), None);
        assert_eq!(case.between((V::X * 3.0, V::NEG_X), 0.0, f32::NAN), None);
    }
}

/// All four roots, one after another, each by a start behind the last.
#[test]
fn the_first_root_after_t_min_and_before_t_max() {
    roots_in_turn(monotone_newton, 1e-6);
}

fn roots_in_turn(method: Method<f32>, error: f32) {
    let case = Case::unit(0.25);
    let between = |ray, t_min, t_max| case.by(method, ray, t_min, t_max);
    let ray = (V::X * 3.0, V::NEG_X);
    let roots = [1.75f32, 2.25, 3.75, 4.25];
    for (i, root) in roots.into_iter().enumerate() {
        let starts = [if i == 0 { 0.0 } else { roots[i - 1] + 0.01 }, root - 0.01];
        for t_min in starts {
            let t = between(ray, t_min, f32::INFINITY);
            assert!(t.is_some_and(|t| (t - root).abs() < error), "{i}: {t:?}");
            assert_eq!(between(ray, t_min, root - 0.001), None, "{i}");
            assert_eq!(between(ray, t_min, root + 0.001), t, "{i}");
        }
    }
    assert_eq!(between(ray, 4.26, f32::INFINITY), None);
    assert_eq!(between(ray, 0.0, f32::NEG_INFINITY), None);
}

#[test]
fn from_the_surface_only_the_far_side_is_hit() {
    let mut rng = Rng(4);
    for case in cases() {
        for _ in 0..100 {
            let local = case.random_point(&mut rng).0;
            let surface = case.tori.surface::<f32>(0, case.world(local).as_vec3().into());
            let (origin, normal) = (V::from(surface.point), V::from(surface.normal));
            let direction = (normal.as_dvec3() + rng.unit() * rng.range(0.0, 0.9)).normalize().as_vec3();
            let cosine = direction.dot(normal);
            // A ray that leaves may come back, across the hole or along the inner side, but not at once.
            let soon = 0.5 * case.curvature_radius(origin) * f64::from(cosine);
            let far = |t: Option<f32>| t.is_none_or(|t| f64::from(t) > soon);
            assert!(far(case.hit(origin, direction)), "{:?} {origin} {direction}", case.it);
            let inward = case.hit(origin, -direction);
            assert!(inward.is_some() && far(inward), "{:?} {origin} {direction}: {inward:?}", case.it);
        }
    }
}

/// Rays that the shading spawns never meet their own surface next to where they start.
#[test]
fn spawned_rays_do_not_come_back_at_once() {
    let mut rng = Rng(5);
    let mut tested = 0;
    for kappa in KAPPAS {
        for scale in [1e-8f32, 1e-3, 1.0, 1e3, 1e8] {
            for away in [0.0, 1.0, 30.0, 1e3] {
                let center = (rng.unit() * away * f64::from(scale)).as_vec3();
                let case = Case::new(center, rng.unit().as_vec3(), scale, scale * kappa);
                tested += (0..1000).filter(|_| spawn(&case, &mut rng)).count();
            }
        }
    }
    assert!(tested > 100_000, "{tested}");
}

/// One ray, from a rounded point of the surface, to either side; false where it tells nothing.
fn spawn(case: &Case, rng: &mut Rng) -> bool {
    let point = case.world(case.random_point(rng).0).as_vec3();
    let surface = case.tori.surface::<f32>(0, point.into());
    let side = if rng.range(0.0, 1.0) < 0.5 { -1.0 } else { 1.0 };
    let normal = V::from(surface.normal) * side;
    let [place, reach] = [V::from(surface.point).abs().max_element(), surface.reach];
    let off = case.off(V::from(surface.point).as_dvec3()).0.abs();
    assert!(off <= 4.0 * U * f64::from(place + reach), "{:?}: {off}", case.it);
    let lift = place.mul_add(9.0 * ROUNDOFF, reach * (8.0 * ROUNDOFF));
    let direction = (normal.as_dvec3() * rng.range(1e-3, 1.0) + rng.unit().cross(normal.as_dvec3())).normalize();
    let cosine = direction.dot(normal.as_dvec3());
    let t = case.hit(V::from(surface.point) + normal * lift, direction.as_vec3()).map(f64::from);
    // Along a circle of the radius of curvature it would come back after 2 radius cos θ; unless the lift is no longer
    // small beside that circle.
    let radius = case.curvature_radius(surface.point.into());
    let lost = f64::from(lift) > 0.1 * radius * cosine;
    let soon = t.is_some_and(|t| t < 0.5 * radius * cosine);
    assert!(lost || !soon, "{:?} {point} {direction}: {t:?}", case.it);
    !lost
}

#[test]
fn texture_coordinates() {
    let case = Case::new(V::new(1.0, 2.0, 3.0), V::Y * 2.0, 2.0, 0.5);
    // The outermost point along B = z, where u = ½, and the top along T = x.
    for (q, checker) in [(V::Z * 2.5, V::new(0.0, 2.5, 0.0)), (V::new(2.0, 0.5, 0.0), V::new(2.0, 0.0, 0.5))] {
        let surface = case.tori.surface::<f32>(0, (case.it.center + q * 1.001).into());
        let found = V::from(case.tori.checker(0, &surface));
        assert!((found - checker).length() < 0.01, "{found}");
        let [u, v] = case.tori.uv(0, &surface);
        let exact = [angle::turn(checker.x, checker.y), angle::turn(checker.z, checker.truncate().length() - 2.0)];
        assert!((u - exact[0]).abs() < 0.01 && (v - exact[1]).abs() < 0.01, "{u} {v}");
    }
    // In the middle of things any normal will do, as long as it is one.
    for q in [V::ZERO, V::X * 2.0, V::Y] {
        let surface = case.tori.surface::<f32>(0, (case.it.center + q).into());
        assert!((V::from(surface.normal).length() - 1.0).abs() < 1e-6, "{q}");
    }
}

#[test]
fn bounds_hold_the_surface_and_touch_it() {
    let mut rng = Rng(7);
    for case in cases() {
        let [min, max] = case.tori.bounds(0).map(|v| v.as_dvec3());
        let mut reached = [DVec3::INFINITY, DVec3::NEG_INFINITY];
        for _ in 0..2000 {
            let p = case.world(case.random_point(&mut rng).0);
            assert!(p.cmpge(min).all() && p.cmple(max).all(), "{:?}: {p} of {min} {max}", case.it);
            reached = [reached[0].min(p), reached[1].max(p)];
        }
        let loose = (reached[0] - min).max(max - reached[1]).max_element();
        assert!(loose < 0.1 * (max - min).max_element(), "{:?}: {loose}", case.it);
        let ball = &case.tori.balls;
        assert!(f64::from(ball.radius[0]) >= case.radii().iter().sum());
    }
}
