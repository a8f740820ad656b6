//! Flat primitives seen nearly edge-on, and thin ones: hits lie on them.

use super::trial::{ROUNDOFF, Random, Ray, all_widths};
use super::{Quads, Sides, Triangles};
use crate::measure::oracle::{self, Answers, Shape, Triangle};
use glam::{DVec3, Vec3 as V};

/// The point of a triangle that is nearest to `p` (Ericson, *Real-Time Collision Detection*, 2004, §5.1.5).
fn nearest_of([a, b, c]: [DVec3; 3], p: DVec3) -> DVec3 {
    let on_edge = |a: DVec3, b: DVec3| {
        let e = b - a;
        let part = (p - a).dot(e) / e.length_squared();
        if part.is_finite() { a + e * part.clamp(0.0, 1.0) } else { a }
    };
    let n = (b - a).cross(c - a);
    let inside = n != DVec3::ZERO && [(a, b), (b, c), (c, a)].iter().all(|&(a, b)| (b - a).cross(p - a).dot(n) >= 0.0);
    let mut near = vec![on_edge(a, b), on_edge(b, c), on_edge(c, a)];
    if inside {
        near.push(p - n * ((p - a).dot(n) / n.length_squared()));
    }
    near.into_iter().min_by(|q, r| q.distance(p).total_cmp(&r.distance(p))).expect("three edges")
}

/// Corners about a place: of any shape, thin ones, and small ones far away.
fn corners(random: &mut Random) -> [V; 3] {
    let at = random.cube() * [0.0, 1.0, 30.0][random.below(3)];
    let size = [1.0, 0.1, 1e-3][random.below(3)];
    let [a, b, c] = [0, 1, 2].map(|_| random.cube() * size);
    let thin = [1.0, 1e-2, 1e-4, 1e-6][random.below(4)];
    [a, b, a + (b - a) * random.unit() as f32 + (c - a) * thin].map(|corner| at + corner)
}

/// A ray at a point near or in the triangle, along its plane but for a tilt.
fn ray([a, b, c]: [V; 3], random: &mut Random) -> Ray {
    let [a, b, c] = [a, b, c].map(|corner| corner.as_dvec3());
    let (u, v) = (1.4 * random.unit() - 0.2, 1.4 * random.unit() - 0.2);
    let to = a + (b - a) * u + (c - a) * v;
    let (along, n) = (random.cube().as_dvec3(), (b - a).cross(c - a).normalize_or(DVec3::X));
    let along = if random.below(4) == 0 { along } else { along.reject_from_normalized(n) };
    let tilt = [0.0, 1e-9, 1e-7, 1e-5, 1e-3, 1e-1][random.below(6)] * (2.0 * random.unit() - 1.0);
    let direction = (along.normalize_or(b - a) + n * tilt).normalize_or(DVec3::X);
    let far = [0.5, 3.0, 100.0][random.below(3)] * (b - a).length().max((c - a).length());
    let origin = (to - direction * far).as_vec3();
    Ray { origin, direction: (to - origin.as_dvec3()).normalize_or(DVec3::X).as_vec3() }
}

/// D: the largest coordinate of a corner from the origin.
fn largest(corners: &[V], origin: V) -> f64 {
    corners.iter().map(|&c| f64::from((c - origin).abs().max_element())).fold(0.0, f64::max)
}

/// The ray of the report: the triangle spans t from 0.2794 to 0.3303 along it.
#[test]
fn a_hit_that_the_plane_cannot_place_is_on_the_triangle() {
    let corners = [
        V::new(0.0010383562, 0.02610245, 0.053479012),
        V::new(-0.06895029, -0.05309985, 0.012519612),
        V::new(-0.02139572, -0.07211126, -0.024566269),
    ];
    let bits = |v: [u32; 3]| V::from_array(v.map(f32::from_bits));
    let origin = bits([0x3e8011be, 0xbb9adaec, 0xbda2cd8e]);
    let direction = bits([0xbf73971e, 0xbe1bf0e6, 0x3e88d1de]);
    let mut triangles = Triangles::default();
    triangles.push(corners, Sides::Both, 0);
    let t = all_widths(&triangles, &[Ray { origin, direction }], 0.0)[0];
    assert!(t.is_none_or(|t| (0.2794..=0.3303).contains(&t)), "{t:?}");
}

#[test]
fn hits_are_on_the_triangle() {
    let mut random = Random(1);
    let (mut hits, mut worst) = (0, 0.0f64);
    for _ in 0..200_000 {
        let corners = corners(&mut random);
        let ray = ray(corners, &mut random);
        let mut triangles = Triangles::default();
        triangles.push(corners, Sides::Both, 0);
        let Some(t) = all_widths(&triangles, &[ray], 0.0)[0] else { continue };
        hits += 1;
        let p = ray.origin.as_dvec3() + ray.direction.as_dvec3() * f64::from(t);
        let off = nearest_of(corners.map(|c| c.as_dvec3()), p).distance(p);
        // And what a point as far away as t cannot tell.
        let bound = ROUNDOFF * (32.0 * largest(&corners, ray.origin) + f64::from(t));
        worst = worst.max(off / bound);
        assert!(off <= bound, "{corners:?} {ray:?}: {t} is {} bounds off", off / bound);
    }
    assert!(hits > 30_000 && worst > 0.05, "{hits}, {worst}");
}

#[test]
fn hits_are_on_the_quad() {
    let mut random = Random(2);
    let (mut hits, mut worst) = (0, 0.0f64);
    for _ in 0..200_000 {
        let [a, b, c] = corners(&mut random);
        let (u, v) = (b - a, c - a);
        let ray = ray([a, b, c], &mut random);
        let [e, f] = [u, v].map(|e| e.as_dvec3());
        let sine = e.cross(f).length() / (e.length() * f.length());
        if sine < 1e-5 {
            continue;
        }
        let mut quads = Quads::default();
        quads.push(a, u, v, 0);
        let Some(t) = all_widths(&quads, &[ray], 0.0)[0] else { continue };
        hits += 1;
        let p = ray.origin.as_dvec3() + ray.direction.as_dvec3() * f64::from(t);
        let corner = a.as_dvec3();
        let halves = [[corner, corner + e, corner + e + f], [corner, corner + f, corner + e + f]];
        let off = halves.map(|half| nearest_of(half, p).distance(p));
        let off = off[0].min(off[1]);
        let bound = 8.0 * ROUNDOFF * (corner.distance(ray.origin.as_dvec3()) + e.length().max(f.length())) / sine;
        worst = worst.max(off / bound);
        assert!(off <= bound, "{a} {u} {v} {ray:?}: {t} is {} bounds off", off / bound);
    }
    assert!(hits > 20_000 && worst > 0.05, "{hits}, {worst}");
}

/// What all rays nearby hit is hit, and no farther and no nearer than they do.
#[test]
fn what_is_clear_of_rounding_is_hit_where_it_is() {
    let mut random = Random(3);
    let mut clear = 0;
    for _ in 0..6_000 {
        let corners = corners(&mut random);
        let ray = ray(corners, &mut random);
        let mut triangles = Triangles::default();
        triangles.push(corners, Sides::Both, 0);
        let shape = Shape::Triangle(Triangle { corners, sides: Sides::Both });
        let question = oracle::Ray::new(ray.origin, ray.direction);
        let width = 64.0 * ROUNDOFF * (largest(&corners, ray.origin) + f64::from(ray.origin.abs().max_element()));
        if let Answers::Hit { low, high } = oracle::around(&shape, &question, 0.0, f64::INFINITY, width) {
            clear += 1;
            let t = all_widths(&triangles, &[ray], 0.0)[0];
            let slack = width + ROUNDOFF * high;
            assert!(
                t.is_some_and(|t| (low - slack..=high + slack).contains(&f64::from(t))),
                "{ray:?} {t:?} {low} {high}"
            );
        }
    }
    assert!(clear > 150, "{clear}");
}
