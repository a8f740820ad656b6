//! Bodies about an axis against the reference, at all widths: the checks and the rays that cylinders and cones share.

use glam::{DVec3, Vec3 as V};
use wide::{f32x4, f32x8};

use super::{Primitives, Sides};
use crate::math::{Lanes, Vec3};
use crate::reference::Tracer;
use crate::scene::{Cone, Cylinder, Description, Material};

/// How many unit roundoffs a ray may be off, as [`crate::measure::verify`] has it.
const K: f64 = 16.0;
/// ε.
const ROUNDOFF: f64 = 0.5 * f32::EPSILON as f64;

pub(super) struct Rng(std::cell::Cell<u64>);

impl Rng {
    pub fn new(seed: u64) -> Self {
        Self(seed.into())
    }
    /// From 0 to 1.
    pub fn unit(&self) -> f64 {
        let state = self.0.get().wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        self.0.set(state);
        let mixed = (state ^ (state >> 29)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        (mixed >> 11) as f64 / (1u64 << 53) as f64
    }
    pub fn range(&self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.unit()
    }
    pub fn pick<T: Copy>(&self, from: &[T]) -> T {
        from[(self.unit() * from.len() as f64) as usize % from.len()]
    }
    /// Evenly on the unit sphere.
    pub fn direction(&self) -> DVec3 {
        let z = self.range(-1.0, 1.0);
        let (sin, cos) = self.range(0.0, std::f64::consts::TAU).sin_cos();
        DVec3::new(cos, sin, 0.0) * (1.0 - z * z).sqrt() + DVec3::Z * z
    }
}

/// A cylinder where the radii are equal, else a cone.
#[derive(Clone, Copy, Debug)]
pub(super) struct Body {
    pub ends: [V; 2],
    pub radii: [f32; 2],
    pub caps: bool,
    pub sides: Sides,
}

impl Body {
    pub fn new(ends: [V; 2], radii: [f32; 2]) -> Self {
        Self { ends, radii, caps: true, sides: Sides::Both }
    }

    /// The four bodies of these ends and radii that differ in more than their sides, and two that do in those.
    pub fn variants(self) -> [Self; 4] {
        let open = Self { caps: false, ..self };
        [self, open, Self { sides: Sides::Front, ..self }, Self { sides: Sides::Back, ..open }]
    }

    pub fn description(self) -> Description {
        let Self { ends: [base, apex], radii: [base_radius, apex_radius], caps, sides } = self;
        let material = Material { shininess: 1.0, ..Material::default() };
        let mut description = Description { materials: vec![material], ..Description::default() };
        if base_radius == apex_radius {
            description.cylinders.push(Cylinder { base, apex, radius: base_radius, caps, sides, material: 0 });
        } else {
            description.cones.push(Cone { base, base_radius, apex, apex_radius, caps, sides, material: 0 });
        }
        description
    }

    fn axis(self) -> DVec3 {
        (self.ends[1].as_dvec3() - self.ends[0].as_dvec3()).normalize()
    }

    pub fn size(self) -> f64 {
        let length = (self.ends[1].as_dvec3() - self.ends[0].as_dvec3()).length();
        length.hypot(f64::from(self.radii[0].max(self.radii[1])))
    }

    /// The height of an end that is no tip.
    fn end(self, rng: &Rng) -> f64 {
        if self.radii.contains(&0.0) { f64::from(u8::from(self.radii[0] == 0.0)) } else { rng.pick(&[0.0, 1.0]) }
    }

    /// A point at a part of the way up, and of the radius there.
    pub fn at(self, height: f64, part: f64, angle: f64) -> DVec3 {
        let [base, apex] = self.ends.map(|e| e.as_dvec3());
        let [r0, r1] = self.radii.map(f64::from);
        let (a, b) = (apex - base).normalize().any_orthonormal_pair();
        let (sin, cos) = angle.sin_cos();
        base.lerp(apex, height) + (a * cos + b * sin) * (part * (r0 + (r1 - r0) * height))
    }
}

/// Rays of all kinds at a body, up to `far` sizes away.
pub(super) fn rays(body: Body, far: f64, count: usize, rng: &Rng) -> Vec<(V, V)> {
    let axis = body.axis();
    (0..count)
        .map(|i| {
            let angle = rng.range(0.0, std::f64::consts::TAU);
            // Inside, near the rims, the tip and the side.
            let height = rng.pick(&[0.0, 1.0, 1e-6, 1.0 - 1e-6, rng.unit(), rng.range(-0.1, 1.1)]);
            let part = rng.pick(&[0.0, 1.0, 1.0 + 1e-6, 1.0 - 1e-6, rng.unit(), 1.2]);
            let to = body.at(height, part, angle);
            let slant = body.at(1.0, 1.0, angle) - body.at(0.0, 1.0, angle);
            let jitter = rng.direction() * rng.pick(&[0.0, 0.0, 1e-8, 1e-7, 1e-5, 1e-2]);
            let direction = match i % 7 {
                0 => axis * rng.pick(&[1.0, -1.0]) + jitter,
                1 => slant.normalize() * rng.pick(&[1.0, -1.0]) + jitter,
                2 => axis.cross(rng.direction()).normalize() + jitter,
                // Along the side, across a generator.
                3 => axis.cross(to - body.ends[0].as_dvec3()).try_normalize().unwrap_or(DVec3::X) + jitter,
                4 => rng.pick(&[DVec3::X, DVec3::NEG_X, DVec3::Y, DVec3::NEG_Y, DVec3::Z, DVec3::NEG_Z]),
                _ => rng.direction(),
            };
            let away = rng.pick(&[0.0, 0.0, rng.unit(), rng.range(1.0, 10.0), rng.unit() * far]);
            let origin = (to - direction.normalize() * (away * body.size())).as_vec3();
            let mut direction = direction.normalize().as_vec3();
            if i % 14 == 4 {
                direction = V::from_array(direction.to_array().map(|c| if c == 0.0 { -0.0 } else { c }));
            }
            (origin, direction)
        })
        .collect()
}

/// The kernel's hits at one width, `None` for a miss.
fn found<P: Primitives, L: Lanes>(kind: &P, rays: &[(V, V)]) -> Vec<Option<f32>> {
    let mut out = Vec::new();
    for chunk in rays.chunks(L::WIDTH) {
        let lane = |k: usize, pick: fn(&(V, V)) -> V| -> L {
            let values: Vec<f32> = (0..L::WIDTH).map(|i| pick(&chunk[i.min(chunk.len() - 1)])[k]).collect();
            L::load(&values)
        };
        let [o, d] = [(|r| r.0) as fn(&(V, V)) -> V, |r| r.1].map(|f| Vec3::new(lane(0, f), lane(1, f), lane(2, f)));
        let nearest = kind.test(0, o, d, L::zero(), L::splat(f32::INFINITY));
        let mut t = vec![0.0; L::WIDTH];
        let mut bits = 0;
        if let Some((distance, inside)) = nearest {
            distance.store(&mut t);
            bits = crate::math::LaneMask::bits(inside);
        }
        out.extend((0..chunk.len()).map(|i| (bits >> i & 1 == 1).then_some(t[i])));
    }
    out
}

/// The kernel's answers, after checking that all widths give the same bits, seen by each lane or from a shared origin.
pub(super) fn answers<P: Primitives>(kind: &P, rays: &[(V, V)]) -> Vec<Option<f32>> {
    let one = found::<P, f32>(kind, rays);
    let bits = |all: Vec<Option<f32>>| -> Vec<_> { all.into_iter().map(|t| t.map(f32::to_bits)).collect() };
    assert_eq!(bits(one.clone()), bits(found::<P, f32x4>(kind, rays)), "x4");
    assert_eq!(bits(one.clone()), bits(found::<P, f32x8>(kind, rays)), "x8");
    for ((o, d), t) in rays.iter().zip(&one) {
        let variant = kind.variant(0);
        let seen = P::splat_seen::<f32x8>(&P::seen(&kind.shape(0), variant, (*o).into()));
        let far = f32x8::splat(f32::INFINITY);
        let nearest = P::nearest(&seen, variant, &P::aim(Vec3::splat(*d)), f32x8::ZERO, far);
        let shared = nearest.filter(|(_, m)| crate::math::LaneMask::all(*m)).map(|(t, _)| t.to_array()[5].to_bits());
        assert_eq!(shared, t.map(f32::to_bits), "{o} {d}");
    }
    one
}

/// Whether the reference gives `t` (`None` for a miss) for a ray that is turned by no more than K ε and moved by no
/// more than K ε of the scale, give or take as much in t.
pub(super) fn explained(tracer: &Tracer, axis: DVec3, (o, d): (V, V), t: Option<f32>) -> bool {
    let (o, d) = (o.as_dvec3(), d.as_dvec3().normalize());
    let distance = |o: DVec3, d: DVec3| tracer.intersect(o, d, f64::INFINITY).map_or(f64::INFINITY, |hit| hit.t);
    let truth = distance(o, d);
    let t = t.map_or(f64::INFINITY, f64::from);
    let hit = if truth.is_finite() { (o + truth * d).length() } else { 0.0 };
    let scale = o.length().max(hit).max(tracer.extent(0));
    let (mut low, mut high) = (truth, truth);
    if t == truth || (t - truth).abs() <= K * ROUNDOFF * (truth + scale) {
        return true;
    }
    let rng = Rng::new(1);
    // From an origin that may as well lie on the surface, the distances start at 0.
    if (0..64).any(|_| distance(o, rng.direction()) <= K * ROUNDOFF * scale) {
        low = 0.0;
    }
    let mut covers = |t2: f64| {
        (low, high) = (low.min(t2), high.max(t2));
        (low - K * ROUNDOFF * (low + scale)..=high + K * ROUNDOFF * (high + scale)).contains(&t)
    };
    let off = |around: DVec3| {
        let size = || 10f64.powf(rng.pick(&[0.0, 0.0, -rng.unit() * 7.0]));
        let step = rng.direction() * size();
        // A flat body is as thin along its axis as rounding, and not across.
        let step = step - step.project_onto_normalized(axis) * (1.0 - size());
        (around + step).clamp_length_max(1.0)
    };
    // Every other question is close to the one with the best answer so far.
    let mut best = (f64::INFINITY, DVec3::ZERO, DVec3::ZERO);
    (0..20_000).any(|i| {
        let around = if i % 2 == 0 { (DVec3::ZERO, DVec3::ZERO) } else { (best.1, best.2) };
        let turn = if i % 3 == 1 { around.0 } else { off(around.0) };
        let shift = if i % 3 == 0 { around.1 } else { off(around.1) };
        // On the way there, towards where the answer changes most: what is at an outline shows in no other sample.
        let [by, way] = [turn, shift * scale].map(|v| v * (K * ROUNDOFF));
        let at = |part: f64| distance(o + way * part, (d + by * part).normalize());
        let gap = |a: f64, b: f64| if a == b { 0.0 } else { (a - b).abs() };
        let mut ends = [(0.0, truth), (1.0, at(1.0))];
        if gap(ends[1].1, t) < best.0 {
            best = (gap(ends[1].1, t), turn, shift);
        }
        covers(ends[1].1)
            || (0..30).any(|_| {
                let part = 0.5 * (ends[0].0 + ends[1].0);
                let middle = (part, at(part));
                let first = gap(ends[0].1, middle.1) >= gap(middle.1, ends[1].1);
                ends = if first { [ends[0], middle] } else { [middle, ends[1]] };
                covers(middle.1)
            })
    })
}

/// That kernel and reference agree on rays of all kinds; the number of hits.
pub(super) fn agree<P: Primitives>(kind: &P, body: Body, far: f64, count: usize, rng: &Rng) -> usize {
    let rays = rays(body, far, count, rng);
    let tracer = Tracer::new(&body.description());
    let answers = answers(kind, &rays);
    for (ray, t) in rays.iter().zip(&answers) {
        let truth = tracer.intersect(ray.0.as_dvec3(), ray.1.as_dvec3().normalize(), f64::INFINITY);
        assert!(explained(&tracer, body.axis(), *ray, *t), "{body:?}\n{ray:?}\n{t:?}, not {truth:?}");
    }
    answers.iter().flatten().count()
}

/// [`agree`] for these bodies, open and closed, seen from either side or both, from near and far.
pub(super) fn all_agree<P: Primitives>(bodies: Vec<Body>, compiled: fn(Body) -> P) {
    let rng = Rng::new(1);
    for body in bodies.into_iter().flat_map(Body::variants) {
        for far in [10.0, 1e4] {
            let hits = agree(&compiled(body), body, far, 1000, &rng);
            assert!(hits > 50, "{body:?}: {hits}");
        }
    }
}

/// That rays through a closed body that is smaller by their rounding hit the whole one, aimed at its rims from
/// everywhere.
pub(super) fn no_crack<P: Primitives>(kind: &P, body: Body, far: f64, count: usize, rng: &Rng) {
    let rays: Vec<_> = (0..count)
        .map(|_| {
            let height = rng.pick(&[0.0, 1.0]) + rng.pick(&[0.0, 1e-7, -1e-7]);
            let to = body.at(height, 1.0 - rng.pick(&[0.0, 1e-7, 1e-6]), rng.range(0.0, 6.3));
            let direction = rng.direction();
            let origin = (to - direction * (body.size() * rng.pick(&[1.0, 10.0, far]))).as_vec3();
            (origin, (to - origin.as_dvec3()).normalize().as_vec3())
        })
        .collect();
    let mut sure = 0;
    for (ray, t) in rays.iter().zip(answers(kind, &rays)) {
        let tracer = Tracer::new(&body.description());
        let (o, d) = (ray.0.as_dvec3(), ray.1.as_dvec3().normalize());
        // A ray that is hit wherever it is moved across itself by its rounding.
        let (a, b) = d.any_orthonormal_pair();
        let off = K * ROUNDOFF * o.length().max(body.size());
        let certain = (0..8).all(|i| {
            let (sin, cos) = (f64::from(i) * std::f64::consts::FRAC_PI_4).sin_cos();
            tracer.blocked(o + (a * cos + b * sin) * off, d, f64::INFINITY)
        });
        sure += usize::from(certain);
        assert!(!certain || t.is_some(), "{body:?} {ray:?}");
    }
    assert!(sure > count / 10, "{body:?}: {sure} of {count}");
}

/// That rays that leave the surface of a closed body do not meet it where they start.
pub(super) fn no_acne<P: Primitives>(kind: &P, body: Body, count: usize, rng: &Rng) {
    for inward in [false, true] {
        let mut rays = Vec::new();
        while rays.len() < count {
            let part = if rng.unit() < 0.5 { 1.0 } else { rng.range(0.05, 0.95) };
            let height = if part == 1.0 { rng.range(0.05, 0.95) } else { body.end(rng) };
            let on = kind.surface::<f32>(0, body.at(height, part, rng.range(0.0, 6.3)).as_vec3().into());
            let (point, outward) = (V::from(on.point), V::from(on.normal));
            let facing = if inward { -outward } else { outward };
            let direction = rng.direction().as_vec3();
            let direction = if direction.dot(facing) < 0.0 { -direction } else { direction };
            // From inside a flat ray rightly meets the curved side again soon.
            if !inward || direction.dot(facing) > 0.05 {
                // As `shade` lifts spawned rays.
                let lift = (9.0 * point.abs().max_element() + 8.0 * on.reach) * (0.5 * f32::EPSILON);
                rays.push((point + facing * lift, direction, height, part));
            }
        }
        let pairs: Vec<_> = rays.iter().map(|r| (r.0, r.1)).collect();
        let mut hits = 0;
        for (ray, t) in rays.iter().zip(answers(kind, &pairs)) {
            hits += usize::from(t.is_some());
            match t {
                None => assert!(!inward || body.radii.contains(&0.0), "escaped: {body:?} {ray:?}"),
                Some(t) => assert!(inward && f64::from(t) > 1e-4 * body.size(), "{t}: {body:?} {ray:?}"),
            }
        }
        assert!(!inward || hits > count * 9 / 10, "{body:?}: {hits}");
    }
}

/// [`no_acne`] for bodies with these radii, tiny to huge, at the world's origin and away from it.
pub(super) fn no_acne_at_any_scale<P: Primitives>(radii: &[[f32; 2]], compiled: fn(Body) -> P) {
    let rng = Rng::new(3);
    for scale in [1e-8f32, 1e-4, 1.0, 1e4, 1e8] {
        for place in [0.0, 1.0, 1e3] {
            let ends = [V::new(0.2, -0.1, 0.3), V::new(0.9, 0.8, -0.5)];
            let at = |p: V| (p + V::new(0.6, -0.7, 0.4) * place) * scale;
            for radii in radii {
                let body = Body::new(ends.map(at), radii.map(|r| r * scale));
                no_acne(&compiled(body), body, 1000, &rng);
            }
        }
    }
}

/// That rays with NaN hit nothing.
pub(super) fn nan_misses<P: Primitives>(kind: &P) {
    for k in 0..6 {
        let mut ray = [0.1, 0.2, -5.0, 0.0, 0.0, 1.0];
        ray[k] = f32::NAN;
        let ray = (V::from_slice(&ray[..3]), V::from_slice(&ray[3..]));
        assert_eq!(answers(kind, &[ray]), [None], "{k}");
    }
}

/// That surface, normal, coordinates and bounds are the reference's, or hold it.
pub(super) fn surfaces(body: Body, kind: &impl Primitives, [low, high]: [V; 2], rng: &Rng) {
    let tracer = Tracer::new(&body.description());
    for _ in 0..200 {
        let part = rng.pick(&[1.0, 0.5]);
        let height = if part == 1.0 { rng.range(0.1, 0.9) } else { body.end(rng) };
        let exact = body.at(height, part, rng.range(0.0, 6.3));
        let off = rng.direction() * (1e-5 * body.size());
        let on = kind.surface::<f32>(0, (exact + off).as_vec3().into());
        let point = V::from(on.point);
        let (o, d) = (point.as_dvec3() + V::from(on.normal).as_dvec3() * body.size(), -V::from(on.normal).as_dvec3());
        let hit = tracer.intersect(o, d, f64::INFINITY).expect("the normal leads away from the surface");
        let bound = 8.0 * ROUNDOFF * (f64::from(point.abs().max_element()) + f64::from(on.reach));
        assert!((hit.t - body.size()).abs() < bound, "{body:?} {point} is {} off", hit.t - body.size());
        // A radius is turned by what its end is off, in radii.
        let radius = body.at(height, 0.0, 0.0).distance(exact);
        assert!((hit.normal + d).length() < 4.0 * bound / radius, "{body:?} {point}: {} {d}", hit.normal);
        assert!(point.cmpge(low).all() && point.cmple(high).all(), "{point} is outside {low} {high}");
    }
}
