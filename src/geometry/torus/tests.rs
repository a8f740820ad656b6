use super::*;
use crate::reference::Tracer;
use crate::scene::{self, Description};
use glam::{DVec3, Vec3 as V, dvec3};
use std::f64::consts::TAU;
use wide::{f32x4, f32x8};

const U: f64 = ROUNDOFF as f64;

/// r / R of the tori that are tested; 1 is a horn torus.
const KAPPAS: [f32; 7] = [1.0, 0.999, 0.7, 0.5, 0.25, 0.01, 1e-3];

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

    fn between(&self, ray: (V, V), t_min: f32, t_max: f32) -> Option<f32> {
        let seen = Tori::seen(&self.tori.record(0), ray.0.into());
        monotone_newton(&seen, ray.1.into(), t_min, t_max).map(|(t, _)| t)
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
    "random", "tangent", "along the axis", "through the axis", "equator", "touching the equator", "from inside", "far",
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
    let mut worst = 0.0f64;
    let mut hits = 0;
    for case in cases() {
        let size: f64 = case.radii().iter().sum();
        for (family, name) in FAMILIES.iter().enumerate() {
            for _ in 0..40 {
                let (origin, direction) = ray(&case, family, &mut rng);
                let (o, d) = (origin.as_dvec3(), direction.as_dvec3());
                let (t, exact) = (case.hit(origin, direction), case.exact(o, d));
                let bound = 12.0 * size + 4.0 * (o - case.it.center.as_dvec3()).length();
                let mut near = t.is_none() && exact.is_none();
                if let Some(t) = t {
                    hits += 1;
                    let p = o + d * f64::from(t);
                    let off = case.off(p).0.abs() / U / bound;
                    worst = worst.max(off);
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
    eprintln!("worst {worst} bounds, {hits} hits, looked into {looked_into:?}");
    assert!(hits > 15_000, "{hits}");
    assert!(looked_into[0] < 400, "{looked_into:?}");
}
