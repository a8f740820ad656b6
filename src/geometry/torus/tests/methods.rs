//! The methods that the default is compared with: that they work where they should, and where they fail and it holds.

use super::*;
use crate::measure::oracle::{self, Shape, Truth};

const METHODS: [(&str, Method<f32>); 3] =
    [("newton", monotone_newton), ("ferrari", ferrari), ("sphere trace", sphere_trace)];

/// How many answers of each of the [`METHODS`] are wrong: a miss for a hit or a hit for a miss, or off by more than
/// r / 100.
type Wrong = [usize; METHODS.len()];

fn truth(case: &Case, (o, d): (V, V)) -> Option<Truth> {
    oracle::nearest(&Shape::Torus(case.it), &oracle::Ray::new(o, d), 0.0, f64::INFINITY)
}

/// By the exact truth, of 1000 rays.
fn wrong(case: &Case, mut ray: impl FnMut() -> (V, V)) -> Wrong {
    let mut wrong = [0; METHODS.len()];
    for ray in std::iter::repeat_with(&mut ray).take(1000) {
        let exact = truth(case, ray).map(|truth| truth.t);
        for (wrong, (_, method)) in wrong.iter_mut().zip(METHODS) {
            let right = match (case.by(method, ray, 0.0, f32::INFINITY), exact) {
                (Some(t), Some(exact)) => (f64::from(t) - exact).abs() <= 0.01 * case.radii()[1],
                (t, exact) => t.is_none() && exact.is_none(),
            };
            *wrong += usize::from(!right);
        }
    }
    wrong
}

/// Into the tube, from so many R away.
fn aimed(kappa: f32, distance: f64) -> Wrong {
    let (case, mut rng) = (Case::unit(kappa), Rng(6));
    wrong(&case, || {
        let (p, n) = case.random_point(&mut rng);
        let to = p - n * (rng.range(0.2, 1.8) * f64::from(kappa));
        let o = (rng.unit() * distance).as_vec3();
        (o, (to - o.as_dvec3()).normalize().as_vec3())
    })
}

/// Along tangents, within the surface by `depth` r, from 2 to 4 R away.
fn grazing(depth: f64) -> Wrong {
    let (case, mut rng) = (Case::unit(0.25), Rng(7));
    wrong(&case, || {
        let (p, n) = case.random_point(&mut rng);
        let d = n.cross(rng.unit()).normalize();
        let o = p - n * (0.25 * depth) - d * rng.range(2.0, 4.0);
        (o.as_vec3(), d.as_vec3())
    })
}

/// From the surface, lifted as the shading does it, to one side and not next to grazing.
fn spawned(side: f32) -> Wrong {
    let (case, mut rng) = (Case::unit(0.25), Rng(8));
    wrong(&case, || {
        let surface = case.tori.surface::<f32>(0, case.random_point(&mut rng).0.as_vec3().into());
        let (point, normal) = (V::from(surface.point), V::from(surface.normal) * side);
        let lift = ROUNDOFF * (8.0 * surface.reach + 9.0 * point.abs().max_element());
        let n = normal.as_dvec3();
        let d = (n * rng.range(0.05, 1.0) + rng.unit().cross(n)).normalize();
        (point + normal * lift, d.as_vec3())
    })
}

/// The next root after `t_min`, all widths the same bits, and nothing for NaN.
#[test]
fn they_answer_what_is_asked() {
    roots_in_turn(ferrari, 1e-3);
    roots_in_turn(sphere_trace, 2e-6);
    let least = [widths_agree(ferrari, ferrari, ferrari), widths_agree(sphere_trace, sphere_trace, sphere_trace)];
    assert!(least[0] > 10 && least[1] > 40, "{least:?}");
    let case = Case::unit(0.25);
    for (name, method) in METHODS {
        for bad in [f32::NAN, f32::INFINITY] {
            assert_eq!(case.by(method, (V::X * bad, V::NEG_X), 0.0, f32::INFINITY), None, "{name}");
            assert_eq!(case.by(method, (V::X * 3.0, V::X * bad), 0.0, f32::INFINITY), None, "{name}");
        }
        for interval in [[f32::NAN, 9.0], [0.0, f32::NAN], [0.0, -1.0], [0.0, 1.7], [4.3, 9.0]] {
            assert_eq!(case.by(method, (V::X * 3.0, V::NEG_X), interval[0], interval[1]), None, "{name} {interval:?}");
        }
    }
}

#[test]
fn next_to_a_thick_torus_all_hold_but_for_grazing_rays() {
    for kappa in [1.0, 0.7, 0.25] {
        let wrong = aimed(kappa, 2.5);
        assert!(wrong[0] == 0 && wrong[1] < 10 && wrong[2] < 10, "{kappa}: {wrong:?}");
    }
}

#[test]
fn far_or_thin_ferrari_fails_and_ours_holds() {
    for (kappa, distance, least) in [(0.5, 20.0, 500), (0.05, 100.0, 900), (0.25, 1000.0, 900), (0.01, 2.5, 300)] {
        let wrong = aimed(kappa, distance);
        assert!(wrong[0] == 0 && wrong[1] > least, "{kappa} from {distance}: {wrong:?}");
    }
}

/// There Ferrari's rounding decides whether the pair is a hit.
#[test]
fn next_to_double_roots_ferrari_fails_and_ours_holds() {
    for depth in [1e-4, -1e-4] {
        let wrong = grazing(depth);
        assert!(wrong[0] == 0 && wrong[1] > 30, "{depth}: {wrong:?}");
    }
}

/// Where the ray starts there is a root, which Ferrari's rounding may put ahead of it.
#[test]
fn from_the_surface_ferrari_fails_and_ours_holds() {
    for side in [1.0, -1.0] {
        let wrong = spawned(side);
        assert!(wrong[0] == 0 && wrong[1] > 20, "{side}: {wrong:?}");
    }
}

/// The steps run out.
#[test]
fn grazing_sphere_tracing_fails_and_ours_holds() {
    for (depth, least) in [(1e-3, 50), (1e-4, 500)] {
        let wrong = grazing(depth);
        assert!(wrong[0] == 0 && wrong[2] > least, "{depth}: {wrong:?}");
    }
}

/// How far the hits are off the surface, in ε (R + r): the median and the worst of 1000 rays next to a torus.
#[test]
fn how_far_hits_are_off() {
    let (case, mut rng) = (Case::unit(0.25), Rng(9));
    let mut off = METHODS.map(|_| Vec::new());
    for _ in 0..1000 {
        let ray = ray(&case, 0, &mut rng);
        for (off, (_, method)) in off.iter_mut().zip(METHODS) {
            let (Some(t), Some(exact)) = (case.by(method, ray, 0.0, f32::INFINITY), truth(&case, ray)) else {
                continue;
            };
            off.push((f64::from(t) - exact.t).abs() * exact.normal.dot(ray.1.as_dvec3()).abs() / (1.25 * U));
        }
    }
    let [newton, ferrari, traced] = off.map(|mut off| {
        off.sort_by(f64::total_cmp);
        [off[off.len() / 2], off[off.len() - 1]]
    });
    assert!(newton[0] < 2.0 && newton[1] < 12.0, "{newton:?}");
    assert!(traced[0] < 4.0 && traced[1] < 20.0, "{traced:?}");
    assert!(ferrari[0] > 20.0 * newton[0] && ferrari[1] > 100.0 * newton[1], "{ferrari:?}");
}
