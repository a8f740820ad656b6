use super::super::trial::{ROUNDOFF, Random, Ray, agree, all_widths, lift};
use super::*;
use crate::measure::oracle::{self, Shape, nearest, settled};
use crate::reference::Tracer;
use crate::scene::{self, Description};
use crate::trace::Probe;
use glam::{Vec3 as V, vec3};

fn described(it: scene::Disc) -> Description {
    Description { discs: vec![it], materials: vec![scene::Material::default()], ..Description::default() }
}

fn stored(it: scene::Disc) -> Discs {
    let mut discs = Discs::default();
    discs.push(it.center, it.normal, it.radius, it.inner_radius, 0);
    discs
}

fn disc(center: V, normal: V, radius: f32, inner_radius: f32) -> scene::Disc {
    scene::Disc { center, normal, radius, inner_radius, material: 0 }
}

fn hit(it: scene::Disc, origin: V, direction: V) -> Option<f32> {
    all_widths(&stored(it), &[Ray { origin, direction }], 0.0)[0]
}

/// Level, slanted, with holes, thin, tiny, huge, far from the world's origin, with long and short normals.
fn discs() -> [scene::Disc; 10] {
    let slant = vec3(0.3, -0.7, 0.5);
    [
        disc(V::ZERO, V::Y, 1.0, 0.0),
        disc(vec3(0.3, -0.2, 0.5), V::NEG_X * 3.0, 1.5, 0.75),
        disc(vec3(0.3, -0.2, 0.5), slant, 0.7, 0.0),
        disc(vec3(-1.0, 2.0, 0.1), slant * 1e-20, 1.3, 0.4),
        disc(vec3(-1.0, 2.0, 0.1), slant * 1e20, 1.3, 1.29),
        disc(vec3(0.1, 0.2, 0.3), vec3(1.0, 1.0, 1e-3), 2.0, 1e-3),
        disc(vec3(2e-6, -1e-6, 3e-6), slant, 1e-6, 4e-7),
        disc(vec3(1e6, -2e6, 5e5), slant, 3.0, 1.0),
        disc(vec3(1e6, -2e6, 5e5), slant, 1e6, 2e5),
        disc(vec3(4e11, 1e11, -2e11), slant, 3e11, 0.0),
    ]
}

/// The point at a part of the radius.
fn at(it: &scene::Disc, part: f64, angle: f64) -> DVec3 {
    let (a, b) = it.normal.as_dvec3().normalize().any_orthonormal_pair();
    let (sin, cos) = angle.sin_cos();
    it.center.as_dvec3() + (a * cos + b * sin) * (part * f64::from(it.radius))
}

/// Rays at a disc, at and next to its edges, its hole and its plane, from next to it and far away.
fn rays(it: &scene::Disc, count: usize, random: &mut Random) -> Vec<Ray> {
    let n = it.normal.as_dvec3().normalize();
    let hole = f64::from(it.inner_radius) / f64::from(it.radius);
    let ray = |i: usize| {
        let off = [0.0, 1e-7, -1e-7, 1e-5, -1e-5][random.below(5)];
        let part = [hole, 1.0, hole + off, 1.0 + off, random.unit(), 1.3 * random.unit()][random.below(6)];
        let to = at(it, part, std::f64::consts::TAU * random.unit());
        let any = random.direction().as_dvec3();
        let flat = any.cross(n).normalize();
        let direction = match i % 6 {
            0 => n * [1.0, -1.0][random.below(2)],
            1 => flat,
            2 => (flat + n * [1e-2, -1e-4, 1e-6, -1e-7][random.below(4)]).normalize(),
            3 => random.along_axis().as_dvec3(),
            _ => any,
        };
        let far = [0.0, 0.3, random.unit(), 10.0 * random.unit(), 1e4][random.below(5)] * f64::from(it.radius);
        Ray { origin: (to - direction * far).as_vec3(), direction: direction.as_vec3() }
    };
    (0..count).map(ray).collect()
}

/// |o − center| + radius.
fn size(it: &scene::Disc, ray: &Ray) -> f64 {
    ray.origin.as_dvec3().distance(it.center.as_dvec3()) + f64::from(it.radius)
}

#[test]
fn answers_are_the_reference_s() {
    for (it, seed) in discs().iter().zip(1..) {
        let rays = rays(it, 3000, &mut Random(seed));
        // The trial moves rays by 8 ε of this.
        let moved = |ray: &Ray| 1.25 * size(it, ray);
        let off = |ray: &Ray, _| 8.0 * ROUNDOFF * size(it, ray);
        let counts = agree(&stored(*it), &Tracer::new(&described(*it)), &rays, moved, off);
        assert!(counts[0] > 200, "{it:?}: {counts:?}");
    }
}

/// Where nothing is aimed at an edge or along the plane, no answer needs an explanation.
#[test]
fn plain_answers_are_within_the_bound() {
    for (it, seed) in discs().iter().zip(1..).filter(|(it, _)| it.inner_radius < 0.9 * it.radius) {
        let random = &mut Random(seed);
        let hole = f64::from(it.inner_radius / it.radius);
        // The numbers of one that is far from the world's origin are coarse.
        let coarse = it.center.abs().max_element() > 1e5 * it.radius;
        let n = it.normal.as_dvec3().normalize();
        let ray = |_| loop {
            let direction = random.direction();
            let part = 1.4 * random.unit();
            let edge = (part - hole).abs().min((part - 1.0).abs());
            let far = f64::from(it.radius) * (1.0 + 50.0 * random.unit());
            let flat = direction.as_dvec3().dot(n).abs() < if coarse { 0.5 } else { 0.05 };
            if !flat && (hole == 0.0 || part > 0.01) && edge > if coarse { 0.2 } else { 0.02 } {
                let to = at(it, part, std::f64::consts::TAU * random.unit());
                break Ray { origin: (to - direction.as_dvec3() * far).as_vec3(), direction };
            }
        };
        let rays: Vec<_> = (0..2000).map(ray).collect();
        let off = |ray: &Ray, _| 8.0 * ROUNDOFF * size(it, ray);
        let counts = agree(&stored(*it), &Tracer::new(&described(*it)), &rays, |ray| 1.25 * size(it, ray), off);
        assert!(counts[0] > 300 && counts[1] == 0, "{it:?}: {counts:?}");
    }
}

#[test]
fn answers_are_the_oracle_s() {
    let mut counts = [0; 2];
    for (it, seed) in discs().iter().zip(20..) {
        let shape = Shape::Disc(*it);
        let rays = rays(it, 300, &mut Random(seed));
        for (ray, t) in rays.iter().zip(all_widths(&stored(*it), &rays, 0.0)) {
            let width = 13.0 * ROUNDOFF * size(it, ray);
            let exact = oracle::Ray::new(ray.origin, ray.direction);
            let cosine = ray.direction.as_dvec3().dot(it.normal.as_dvec3().normalize()).abs();
            // What is seen so thin that it fits between samples is not theirs to settle.
            let thin = |x: f32| f64::from(x) * cosine < 4.0 * width;
            if thin(it.radius - it.inner_radius) || it.inner_radius > 0.0 && thin(it.inner_radius) {
                continue;
            }
            let bound = 8.0 * ROUNDOFF * size(it, ray);
            // Whether it starts there is a matter of rounding.
            let starts = |t: f64| t * cosine <= bound;
            let Some(truth) = nearest(&shape, &exact, 0.0, f64::INFINITY) else {
                if settled(&shape, &exact, 0.0, f64::INFINITY, width) && !t.is_some_and(|t| starts(t.into())) {
                    assert_eq!(t, None, "{it:?} {ray:?}");
                    counts[0] += 1;
                }
                continue;
            };
            if let Some(t) = t {
                let off = (f64::from(t) - truth.t).abs() * cosine;
                assert!(off <= bound, "{it:?} {ray:?}: {t} is {off:e} off {truth:?}");
                counts[1] += 1;
            } else {
                let sure = !starts(truth.t) && settled(&shape, &exact, 0.0, f64::INFINITY, width);
                assert!(!sure, "{it:?} {ray:?}: {truth:?}");
            }
        }
    }
    assert!(counts[0] > 50 && counts[1] > 200, "{counts:?}");
}

#[test]
fn inside_outside_hole_edges_and_both_sides() {
    let (whole, ring) =
        (disc(vec3(1.0, 2.0, 0.0), V::Z * 5.0, 2.5, 0.0), disc(vec3(1.0, 2.0, 0.0), V::NEG_Z, 2.5, 1.25));
    for (x, y, of_whole, of_ring) in [
        (0.0, 0.0, true, false),
        (1.24, 0.0, true, false),
        (1.25, 0.0, true, true),
        (0.75, -1.0, true, true),
        (-0.75, -0.99, true, false),
        (0.0, -2.0, true, true),
        (2.5, 0.0, true, true),
        (0.0, -2.5, true, true),
        (-1.5, 2.0, true, true),
        (-1.5, 2.01, false, false),
        (2.51, 0.0, false, false),
        (2.0, 2.0, false, false),
    ] {
        for (it, inside) in [(whole, of_whole), (ring, of_ring)] {
            let origin = |z: f32| vec3(1.0 + x, 2.0 + y, z);
            assert_eq!(hit(it, origin(2.0), V::NEG_Z), inside.then_some(2.0), "{x} {y}");
            assert_eq!(hit(it, origin(-2.0), V::Z), inside.then_some(2.0), "{x} {y}");
            assert_eq!(hit(it, origin(-2.0), V::NEG_Z), None, "behind");
            assert_eq!(hit(it, origin(0.0), V::Z), None, "on it");
            assert_eq!(hit(it, origin(0.0), V::NEG_Z), None, "on it");
        }
    }
}

#[test]
fn rays_in_the_plane_and_rays_with_nan_miss() {
    let it = disc(vec3(1.0, 2.0, 0.0), V::Z, 2.5, 0.5);
    for zero in [0.0, -0.0] {
        assert_eq!(hit(it, vec3(-9.0, 2.0, zero), vec3(1.0, 0.0, zero)), None, "towards it");
        assert_eq!(hit(it, vec3(2.0, 2.0, zero), vec3(0.0, 1.0, -zero)), None, "from it");
        assert_eq!(hit(it, vec3(-9.0, 2.0, 1.0), vec3(1.0, 0.0, zero)), None, "above it");
    }
    for axis in 0..3 {
        for bad in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
            let (mut origin, mut direction) = (vec3(2.0, 2.0, 3.0), V::NEG_Z);
            origin[axis] = bad;
            assert_eq!(hit(it, origin, direction), None, "{origin}");
            direction[axis] = f32::NAN;
            assert_eq!(hit(it, vec3(2.0, 2.0, 3.0), direction), None, "{direction}");
        }
    }
    assert_eq!(hit(it, vec3(2.0, 2.0, 3.0), V::ZERO), None);
}

#[test]
fn far_and_small_ones_are_met_exactly() {
    let far = vec3(1048576.0, -2097152.0, 524288.0);
    let it = disc(far, V::Z, 3.0, 1.0);
    for (x, t) in [(1.0, Some(4.0)), (2.0, Some(4.0)), (3.0, Some(4.0)), (0.5, None), (3.25, None)] {
        assert_eq!(hit(it, far + vec3(x, 0.0, 4.0), V::NEG_Z), t, "{x}");
    }
    for scale in [1.0, 1e-6, 1e6] {
        let it = disc(V::ZERO, V::Y, scale, scale * 0.5);
        // A million radii away.
        for (x, inside) in [(0.75, true), (0.51, true), (0.99, true), (0.49, false), (1.01, false)] {
            let origin = vec3(x, 1e6, 0.0) * scale;
            assert_eq!(hit(it, origin, V::NEG_Y), inside.then_some(origin.y), "{x} {scale:e}");
        }
    }
}

/// However flat a ray is, the public query has its hit next to the disc: nearer than 64 ε of how far away it is.
#[test]
fn grazing_hits_lie_next_to_it() {
    let mut hits = 0;
    for (it, seed) in discs().iter().zip(40..) {
        let random = &mut Random(seed);
        let compiled = crate::scene::compile(&described(*it)).expect("sound");
        let (n, c) = (it.normal.as_dvec3().normalize(), it.center.as_dvec3());
        let mut probe = Probe::default();
        for _ in 0..500 {
            let flat = random.direction().as_dvec3().cross(n).normalize();
            let direction = (flat + n * 1e-8f64.powf(random.unit())).normalize().as_vec3();
            let part = [0.5, 1.0, 1.1 * random.unit()][random.below(3)];
            let far = f64::from(it.radius) * [2.0, 30.0][random.below(2)];
            let to = at(it, part, std::f64::consts::TAU * random.unit());
            let origin = (to - direction.as_dvec3() * far).as_vec3();
            let Some(found) = probe.intersect(&compiled, origin, direction) else { continue };
            let place = origin.as_dvec3() + direction.as_dvec3() * f64::from(found.t);
            let near = 64.0 * ROUNDOFF * (size(it, &Ray { origin, direction }) + c.abs().max_element());
            let (height, out) = ((place - c).dot(n).abs(), place.distance(c) - f64::from(it.radius));
            assert!(height <= near && out <= near, "{it:?} {origin} {direction}: {height:e} {out:e}");
            hits += 1;
        }
    }
    assert!(hits > 1000, "{hits}");
}

#[test]
fn rays_leave_the_surface() {
    for scale in [1e-6, 1e-3, 1.0, 1e3, 1e6] {
        let random = &mut Random(60);
        for _ in 0..1000 {
            let it = disc(random.cube() * 3.0 * scale, random.direction(), scale, 0.3 * scale);
            let stored = stored(it);
            let point = at(&it, 0.35 + 0.6 * random.unit(), std::f64::consts::TAU * random.unit());
            let surface = stored.surface::<f32>(0, point.as_vec3().into());
            let (on, n) = (V::from(surface.point), V::from(surface.normal));
            let off = (on.as_dvec3() - it.center.as_dvec3()).dot(it.normal.as_dvec3().normalize()).abs();
            let most = 4.0 * ROUNDOFF * f64::from(on.abs().max_element() + surface.reach);
            assert!(off <= most, "{it:?}: {off:e} of {most:e}");
            for side in [n, -n] {
                let direction = random.direction();
                let direction = if direction.dot(side) < 0.0 { -direction } else { direction };
                if direction.dot(side) > 1e-3 {
                    assert_eq!(hit(it, on + side * lift(&surface), direction), None, "{it:?} {on} {direction}");
                }
            }
        }
    }
}

#[test]
fn coordinates_run_around_and_outward() {
    // About y, T = x and B = z.
    let it = disc(vec3(1.0, 2.0, 3.0), V::Y * 3.0, 2.0, 1.0);
    let of = |it: scene::Disc, p: V| {
        let stored = stored(it);
        let surface = stored.surface::<f32>(0, p.into());
        let c = stored.checker(0, &surface);
        (stored.uv(0, &surface), [c.x, c.y, c.z])
    };
    for (q, uv, checker) in [
        (vec3(0.0, 0.25, 1.5), [0.5, 0.5], [0.0, 1.5, 0.0]),
        (vec3(1.0, 0.0, 0.0), [0.75, 0.0], [1.0, 0.0, 0.0]),
        (vec3(-2.0, -0.5, 0.0), [0.25, 1.0], [-2.0, 0.0, 0.0]),
    ] {
        let found = of(it, it.center + q);
        let near = found.0.iter().zip(uv).all(|(a, b)| (a - b).abs() < 1e-6);
        assert!(near && found.1 == checker, "{q}: {found:?}");
    }
    // In any axes, by the definition.
    let random = &mut Random(70);
    for _ in 0..200 {
        let it = disc(random.cube(), random.direction(), 1.5, 0.5);
        let q = at(&it, 0.4 + 0.6 * random.unit(), std::f64::consts::TAU * random.unit()) - it.center.as_dvec3();
        let [x, y] = crate::geometry::frame(it.normal).map(|a| a.as_dvec3().dot(q));
        let expected = [0.5 + x.atan2(y) / std::f64::consts::TAU, q.length() - 0.5];
        let ([u, v], [a, b, c]) = of(it, (it.center.as_dvec3() + q).as_vec3());
        let turned = (f64::from(u) - expected[0]).abs();
        assert!(turned.min(1.0 - turned) < 1e-5 && (f64::from(v) - expected[1]).abs() < 1e-5, "{it:?} {q}");
        assert!((f64::from(a) - x).abs() < 1e-5 && (f64::from(b) - y).abs() < 1e-5 && c == 0.0, "{it:?} {q}");
    }
}

#[test]
fn bounds_hold_the_disc_and_touch_it() {
    for it in discs() {
        let stored = stored(it);
        let [min, max] = stored.bounds(0).map(|v| v.as_dvec3());
        let mut reached = [DVec3::INFINITY, DVec3::NEG_INFINITY];
        for i in 0..2000 {
            let p = at(&it, 1.0, std::f64::consts::TAU * f64::from(i) / 2000.0);
            assert!(p.cmpge(min).all() && p.cmple(max).all(), "{it:?}: {p} of {min} {max}");
            reached = [reached[0].min(p), reached[1].max(p)];
        }
        let coarse = 4.0 * f64::from(f32::EPSILON) * min.abs().max(max.abs()).max_element();
        let loose = (reached[0] - min).max(max - reached[1]).max_element();
        assert!(loose < 1e-4 * f64::from(it.radius) + coarse, "{it:?}: {loose}");
        assert!(stored.balls.radius[0] > it.radius && stored.balls.radius[0] <= it.radius * 1.000_001);
    }
}
