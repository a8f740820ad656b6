//! Rays that start on the surface and graze it, and intervals that start next to a hit.

use super::*;
use crate::measure::oracle::{self, Answers, Shape};

/// A root beyond this many r is told from the start, however the ray starts.
const CLEAR: f64 = 0.1;

/// Whether `t` is where the exact ray is hit clear of the start, or one within 16 ε of the size.
fn is_right(case: &Case, (o, d): (V, V), t: Option<f32>) -> bool {
    let [major, minor] = case.radii();
    let (shape, ray, from) = (Shape::Torus(case.it), oracle::Ray::new(o, d), CLEAR * minor);
    let within = |low: f64, high: f64| {
        let slack = 1e-5 * high;
        t.is_some_and(|t| (low - slack..=high + slack).contains(&f64::from(t)))
    };
    match oracle::nearest(&shape, &ray, from, f64::INFINITY) {
        Some(truth) if within(truth.t, truth.t) => return true,
        None if t.is_none() => return true,
        _ => (),
    }
    let width = K * U * (major + minor + f64::from(o.length()));
    match oracle::around(&shape, &ray, from, f64::INFINITY, width) {
        Answers::Hit { low, high } => within(low, high),
        Answers::Miss => t.is_none(),
        Answers::Mixed => true,
    }
}

#[test]
fn a_ray_that_leaves_slightly_inward_finds_the_far_side() {
    let case = Case::new(V::ZERO, V::new(-0.5103071, -0.29796952, -0.5273842), 1.0, 0.6);
    let ray = (V::new(-0.88468534, 0.28478366, -0.13104375), V::new(0.902457, -0.429661, -0.0310285));
    for (t_min, root) in [(0.0, 1.2669), (1.0, 1.2669), (1.5, 2.3998)] {
        let t = case.between(ray, t_min, f32::INFINITY);
        assert!(t.is_some_and(|t| (t - root).abs() < 1e-4), "{t:?}, not {root}");
    }
}

/// What is clear of the start is never lost, and nothing is found where there is no surface. Two thirds and more are judged:
/// of the others the chord at the start is found.
#[test]
fn grazing_starts_lose_no_root() {
    let mut rng = Rng(11);
    for kappa in [1.0, 0.9, 0.6, 0.25, 0.05, 0.01] {
        let (mut hits, mut near) = (0, 0);
        for round in 0..1500 {
            let case = Case::new((rng.unit() * rng.range(0.0, 1.0)).as_vec3(), rng.unit().as_vec3(), 1.0, kappa);
            let surface = case.tori.surface::<f32>(0, case.world(case.random_point(&mut rng).0).as_vec3().into());
            let (origin, normal) = (V::from(surface.point), V::from(surface.normal).as_dvec3());
            let most = [1e-7, 1e-5, 1e-3][round % 3];
            let slope = rng.range(-most, most);
            let direction = (normal.cross(rng.unit()).normalize() + normal * slope).normalize().as_vec3();
            let t = case.hit(origin, direction);
            let [major, minor] = case.radii();
            if let Some(t) = t.map(f64::from) {
                let off = case.off(origin.as_dvec3() + direction.as_dvec3() * t).0.abs();
                let bound = 12.0 * (major + minor) + 4.0 * f64::from((origin - case.it.center).length());
                assert!(off <= U * (bound + 3.0 * t), "{kappa} {origin} {direction}: {t} is {off} off");
            }
            // By what a chord of the start is long, it is no other root.
            if t.is_some_and(|t| f64::from(t) < CLEAR * minor) {
                near += 1;
                continue;
            }
            hits += usize::from(t.is_some());
            assert!(is_right(&case, (origin, direction), t), "{:?} {origin} {direction} {slope}: {t:?}", case.it);
        }
        assert!(hits > if kappa > 0.1 { 150 } else { 5 } && near < 1500 / 3, "{kappa}: {hits}, {near}");
    }
}

/// From one ulp before a hit on it is found again, to the bit; from the hit on it is not.
#[test]
fn t_min_next_to_a_hit_changes_nothing() {
    let (mut rng, mut later) = (Rng(12), 0);
    for case in cases() {
        for _ in 0..40 {
            let ray = ray(&case, rng.below(FAMILIES.len()), &mut rng);
            let mut t = case.hit(ray.0, ray.1);
            for roots in 0.. {
                let Some(hit) = t.filter(|t| t.is_normal()) else { break };
                assert_eq!(case.between(ray, hit.next_down(), f32::INFINITY), t, "{:?} {ray:?}", case.it);
                assert_eq!(case.between(ray, hit.next_down(), hit.next_up()), t, "{:?} {ray:?}", case.it);
                t = case.between(ray, hit, f32::INFINITY);
                assert!(t.is_none_or(|t| t > hit) && roots < 6, "{:?} {ray:?}: {t:?} after {hit}", case.it);
                later += usize::from(t.is_some());
            }
        }
    }
    assert!(later > 1000, "{later}");
}

/// All that a line meets comes in turn, as from a start between.
#[test]
fn roots_come_in_turn() {
    let (mut rng, mut compared) = (Rng(13), 0);
    for kappa in [0.9, 0.5, 0.1] {
        let case = Case::unit(kappa);
        for _ in 0..2000 {
            let ray = ray(&case, [0, 3, 6, 8][rng.below(4)], &mut rng);
            let mut t_min = 0.0;
            while let Some(t) = case.between(ray, t_min, f32::INFINITY) {
                let moved = (ray.0 + ray.1 * (t + 0.05), ray.1);
                let (here, there) = (case.between(ray, t + 0.05, f32::INFINITY), case.hit(moved.0, moved.1));
                if let (Some(here), Some(there)) = (here, there) {
                    compared += 1;
                    assert!(
                        (here - t - 0.05 - there).abs() < 2e-3,
                        "{kappa} {ray:?}: {here}, not {}",
                        t + 0.05 + there
                    );
                }
                t_min = t;
            }
        }
    }
    assert!(compared > 2000, "{compared}");
}

/// The box holds where the torus reaches along each axis, by its own description and without rounding.
#[test]
fn the_box_holds_the_outermost_points() {
    let mut rng = Rng(14);
    for i in 0..2000 {
        let minor = 10f64.powf(rng.range(-3.0, 0.0)) as f32;
        let center = (rng.unit() * rng.range(0.0, 4.0)).as_vec3();
        let case = Case::new(center, rng.unit().as_vec3(), 1.0, minor);
        let a = case.it.axis.as_dvec3().normalize();
        let reach = (DVec3::ONE - a * a).map(f64::sqrt) * case.radii()[0] + case.radii()[1];
        let [min, max] = case.tori.bounds(0).map(|v| v.as_dvec3());
        let (low, high) = (center.as_dvec3() - reach, center.as_dvec3() + reach);
        assert!(low.cmpge(min).all() && high.cmple(max).all(), "{i} {:?}: {low} {high} of {min} {max}", case.it);
    }
}
