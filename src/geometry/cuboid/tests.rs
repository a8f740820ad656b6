use super::*;
use crate::geometry::trial::{ROUNDOFF, Random, Ray, agree, all_widths, lift};
use crate::reference::Tracer;
use crate::scene::{self, Description};
use glam::{Vec3 as V, vec3};

fn one(min: V, max: V, rotation: V) -> (Cuboids, Tracer) {
    let mut cuboids = Cuboids::default();
    cuboids.push(min, max, rotation, 0);
    let described = scene::Cuboid { min, max, rotation, material: 0 };
    let description = Description { cuboids: vec![described], ..Description::default() };
    (cuboids, Tracer::new(&description))
}

fn hit(cuboids: &Cuboids, origin: V, direction: V) -> Option<f32> {
    all_widths(cuboids, &[Ray { origin, direction }], 0.0)[0]
}

/// Half the diagonal and the greatest coordinate.
fn sizes(cuboids: &Cuboids) -> [f64; 2] {
    let [center, half] = cuboids.center_and_half(0);
    [f64::from(half.length()), f64::from(center.abs().max_element() + half.length())]
}

/// The places that rays are aimed at or start from, in half sizes: anywhere in and around the box, and its edges,
/// corners and faces.
fn place(random: &mut Random) -> V {
    let mut p = random.cube() * 1.2;
    match random.below(4) {
        0 => p[random.below(3)] = 1.0,
        1 => p = p.map(|c| if random.unit() < 0.7 { c.signum() } else { c }),
        2 => p = p.signum(),
        _ => {}
    }
    p
}

fn rays(cuboids: &Cuboids, count: usize, seed: u64) -> Vec<Ray> {
    let [center, half] = cuboids.center_and_half(0);
    let random = &mut Random(seed);
    let axes = cuboids.axes[0].unwrap_or(V::AXES);
    let world = |q: V| axes[0] * q.x + axes[1] * q.y + axes[2] * q.z;
    let ray = |_| {
        let to = center + world(place(random) * half);
        let far = [0.0, 0.3, 2.0, 30.0, 1e4][random.below(5)] * half.length();
        let direction = match random.below(4) {
            0 => random.along_axis(),
            1 => random.across_axis(),
            2 => world(random.along_axis()),
            _ => random.direction(),
        };
        let origin = to - direction * far;
        Ray { origin, direction: if random.below(8) == 0 { -direction } else { direction } }
    };
    (0..count).map(ray).collect()
}

const ROTATIONS: [V; 6] = [
    V::ZERO,
    V::new(30.0, 0.0, 0.0),
    V::new(10.0, 200.0, -75.5),
    V::new(90.0, 0.0, 180.0),
    V::new(0.0, 1e-3, 0.0),
    V::new(-45.0, 45.0, 1234.5),
];

#[test]
fn answers_are_the_reference_s() {
    let mut total = [0; 2];
    for (i, rotation) in ROTATIONS.into_iter().enumerate() {
        for (min, max) in [
            (vec3(-1.0, -2.0, -0.5), vec3(1.0, 1.0, 0.75)),
            (vec3(100.0, -200.0, 30.0), vec3(100.5, -199.0, 31.5)),
            (vec3(-1e-6, 0.0, 0.0), vec3(1e-6, 3e-6, 2e-6)),
            (vec3(-1e3, -0.01, 50.0), vec3(1e3, 0.01, 60.0)),
        ] {
            let (cuboids, tracer) = one(min, max, rotation);
            let [_, most] = sizes(&cuboids);
            let center = (min + max).as_dvec3() / 2.0;
            let size = |ray: &Ray| f64::from(ray.origin.length()).max(most);
            let turned = cuboids.axes[0].is_some();
            let off = |ray: &Ray, t: f64| match turned {
                true => ROUNDOFF * (5.0 * ray.origin.as_dvec3().distance(center) + 7.0 * t + 2.0 * most),
                false => ROUNDOFF * 3.01 * t,
            };
            let counts = agree(&cuboids, &tracer, &rays(&cuboids, 4000, i as u64), size, off);
            assert!(counts[0] > 800, "{rotation} {min}: {counts:?}");
            total = [0, 1].map(|k| total[k] + counts[k]);
        }
    }
    assert!(total[1] * 5 < total[0], "{total:?} hits, to explain");
}

/// Where nothing is aimed at an edge, no answer needs an explanation.
#[test]
fn plain_answers_are_within_the_bound() {
    let mut random = Random(8);
    for rotation in ROTATIONS {
        let (min, max) = (vec3(-1.0, 2.0, 3.0), vec3(1.5, 4.0, 4.0));
        let (cuboids, tracer) = one(min, max, rotation);
        let center = (min + max) / 2.0;
        let turned = cuboids.axes[0].is_some();
        let off = |ray: &Ray, t: f64| match turned {
            true => ROUNDOFF * (5.0 * f64::from(ray.origin.distance(center)) + 7.0 * t + 2.0 * f64::from(max.length())),
            false => ROUNDOFF * 3.01 * t,
        };
        let rays: Vec<Ray> =
            (0..10_000).map(|_| Ray { origin: center + random.cube() * 5.0, direction: random.direction() }).collect();
        let counts = agree(&cuboids, &tracer, &rays, |_| 10.0, off);
        assert!(counts[0] > 250 && counts[1] == 0, "{rotation}: {counts:?}");
    }
}

#[test]
fn from_outside_inside_and_the_surface() {
    let (cuboids, _) = one(vec3(-1.0, -2.0, -3.0), vec3(1.0, 2.0, 3.0), V::ZERO);
    assert_eq!(hit(&cuboids, vec3(0.5, 0.5, 5.0), V::NEG_Z), Some(2.0));
    assert_eq!(hit(&cuboids, vec3(0.5, 0.5, 5.0), V::Z), None);
    assert_eq!(hit(&cuboids, vec3(1.5, 0.5, 5.0), V::NEG_Z), None);
    assert_eq!(hit(&cuboids, vec3(0.5, 0.5, 1.0), V::NEG_Z), Some(4.0), "inside");
    assert_eq!(hit(&cuboids, V::ZERO, V::X), Some(1.0), "the centre");
    assert_eq!(hit(&cuboids, vec3(1.0, 0.0, 0.0), V::X), None, "a face, leaving");
    assert_eq!(hit(&cuboids, vec3(1.0, 0.0, 0.0), V::NEG_X), Some(2.0), "a face, entering");
    assert_eq!(hit(&cuboids, vec3(1.0, 2.0, 3.0), V::ONE.normalize()), None, "a corner, leaving");
    let through = hit(&cuboids, vec3(1.0, 2.0, 3.0), -V::ONE.normalize()).unwrap();
    assert!((through - 2.0 * 3f32.sqrt()).abs() < 1e-6, "a corner, entering: {through}");
    let beyond = all_widths(&cuboids, &[Ray { origin: vec3(0.0, 0.0, 5.0), direction: V::NEG_Z }], 2.0);
    assert_eq!(beyond, [Some(8.0)], "the far side, where t_min leaves out the near one");
}

#[test]
fn rays_in_a_face_s_plane_and_along_edges_meet_the_border() {
    for rotation in [V::ZERO, vec3(90.0, 0.0, 0.0), vec3(0.0, 180.0, 270.0)] {
        let (cuboids, tracer) = one(V::NEG_ONE, V::ONE, rotation);
        for zero in [0.0, -0.0] {
            let along = vec3(-1.0, zero, zero);
            for (origin, t) in [
                (vec3(3.0, 1.0, 0.5), Some(2.0)),
                (vec3(3.0, -1.0, 0.5), Some(2.0)),
                (vec3(3.0, 1.0, 1.0), Some(2.0)),
                (vec3(3.0, -1.0, 1.0), Some(2.0)),
                (vec3(0.5, 1.0, -1.0), Some(1.5)),
                (vec3(3.0, 1.0, 1.000_001), None),
                (vec3(3.0, 1.000_001, 0.0), None),
                (vec3(-1.0, 1.0, 0.0), None),
            ] {
                assert_eq!(hit(&cuboids, origin, along), t, "{rotation} {origin}");
                let truth = tracer.intersect(origin.as_dvec3(), along.as_dvec3(), f64::INFINITY);
                assert_eq!(truth.map(|hit| hit.t as f32), t, "{rotation} {origin}");
            }
        }
    }
}

#[test]
fn nothing_slips_between_boxes_that_share_a_face() {
    let (left, _) = one(vec3(-2.0, -1.0, -1.0), vec3(0.3, 1.0, 1.0), V::ZERO);
    let (right, _) = one(vec3(0.3, -1.0, -1.0), vec3(2.0, 1.0, 1.0), V::ZERO);
    let mut random = Random(5);
    for _ in 0..5000 {
        let to = vec3(0.3, random.cube().x * 0.9, 1.0);
        let origin = to + vec3(random.cube().x, random.cube().y, 1.0) * 3.0;
        let direction = (to - origin).normalize();
        assert!(hit(&left, origin, direction).is_some() || hit(&right, origin, direction).is_some(), "{origin}");
    }
}

#[test]
fn rays_that_are_no_rays_hit_nothing_and_leave_others_alone() {
    let (cuboids, _) = one(V::NEG_ONE, V::ONE, vec3(0.0, 0.0, 30.0));
    let good = Ray { origin: V::Z * 3.0, direction: V::NEG_Z };
    let rays = [good, Ray { origin: V::NAN, ..good }, Ray { direction: V::NAN, ..good }, good];
    let hits = all_widths(&cuboids, &rays, 0.0);
    assert_eq!([hits[0], hits[1], hits[2], hits[3]], [Some(2.0), None, None, Some(2.0)]);
}

#[test]
fn rotation_is_about_x_then_y_then_z() {
    let (cuboids, _) = one(vec3(-3.0, -2.0, -1.0), vec3(3.0, 2.0, 1.0), vec3(90.0, 0.0, 90.0));
    // y goes to z by the first turn, x to y by the last.
    assert_eq!(cuboids.axes[0], Some([V::Y, V::Z, V::X]));
    assert_eq!(cuboids.bounds(0).map(V::round), [vec3(-1.0, -3.0, -2.0), vec3(1.0, 3.0, 2.0)]);
    assert_eq!(one(V::NEG_ONE, V::ONE, V::splat(360.0)).0.axes, [None]);
    for rotation in ROTATIONS {
        let (cuboids, _) = one(vec3(5.0, 5.0, 5.0), vec3(6.0, 7.0, 8.0), rotation);
        let by_glam = glam::DMat3::from_rotation_z(f64::from(rotation.z).to_radians())
            * glam::DMat3::from_rotation_y(f64::from(rotation.y).to_radians())
            * glam::DMat3::from_rotation_x(f64::from(rotation.x).to_radians());
        let axes = cuboids.axes[0].unwrap_or(V::AXES).map(|a| a.as_dvec3());
        assert!(glam::DMat3::from_cols(axes[0], axes[1], axes[2]).abs_diff_eq(by_glam, 1e-7), "{rotation}");
        let [low, high] = cuboids.bounds(0).map(|c| c.as_dvec3());
        for corner in 0..8 {
            let sign = glam::DVec3::from_array([0, 1, 2].map(|a| if corner >> a & 1 == 1 { 1.0 } else { -1.0 }));
            let at = glam::dvec3(5.5, 6.0, 6.5) + by_glam * (sign * glam::dvec3(0.5, 1.0, 1.5));
            assert!(at.cmpge(low).all() && at.cmple(high).all(), "{rotation}: {at}");
        }
    }
}

#[test]
fn uv_and_checker_follow_the_description() {
    let (cuboids, _) = one(vec3(0.0, 0.0, 0.0), vec3(2.0, 4.0, 8.0), V::ZERO);
    // A point of each face a quarter along x, y and z.
    for (point, uv, checker) in [
        (vec3(2.0, 1.0, 2.0), [0.75, 0.25], vec3(0.0, -1.0, -2.0)),
        (vec3(0.0, 1.0, 2.0), [0.25, 0.25], vec3(0.0, -1.0, -2.0)),
        (vec3(0.5, 4.0, 2.0), [0.25, 0.75], vec3(-0.5, 0.0, -2.0)),
        (vec3(0.5, 0.0, 2.0), [0.25, 0.25], vec3(-0.5, 0.0, -2.0)),
        (vec3(0.5, 1.0, 8.0), [0.25, 0.25], vec3(-0.5, -1.0, 0.0)),
        (vec3(0.5, 1.0, 0.0), [0.75, 0.25], vec3(-0.5, -1.0, 0.0)),
    ] {
        let surface = cuboids.surface::<f32>(0, point.into());
        assert_eq!(V::from(surface.point), point);
        assert_eq!(cuboids.uv(0, &surface), uv, "{point}");
        assert_eq!(V::from(cuboids.checker(0, &surface)), checker, "{point}");
    }
}

/// Surface, texture and checker of turned boxes, beside the reference's.
#[test]
fn surfaces_are_the_reference_s() {
    let mut random = Random(9);
    for rotation in ROTATIONS {
        let (min, max) = (vec3(-1.0, 2.0, 3.0), vec3(1.5, 4.0, 9.0));
        let (cuboids, tracer) = one(min, max, rotation);
        for ray in rays(&cuboids, 500, 77) {
            let direction = random.direction();
            let Some(t) = hit(&cuboids, ray.origin, direction) else { continue };
            let point = ray.origin + direction * t;
            let surface = cuboids.surface::<f32>(0, point.into());
            let size = 20.0 + ray.origin.length();
            let truth = tracer.intersect(ray.origin.as_dvec3(), direction.as_dvec3(), f64::INFINITY);
            let Some(truth) = truth.filter(|hit| (hit.t - f64::from(t)).abs() < 1e-5 * f64::from(size)) else {
                continue;
            };
            let normal = V::from(surface.normal);
            let facing = if normal.dot(direction) > 0.0 { -normal } else { normal };
            // At an edge rounding decides which face it is.
            let share = cuboids.own::<f32>(0, point.into());
            let out = (V::from(share[0]) / V::from(share[1])).abs().to_array();
            let near_edge = out.iter().filter(|o| **o > 1.0 - 1e-5 * size).count() > 1;
            assert!(near_edge || facing.as_dvec3().distance(truth.normal) < 1e-6, "{rotation} {point} {normal}");
        }
    }
}

/// Rays that leave the surface, on either side, do not meet it where they start.
#[test]
fn spawned_rays_do_not_meet_their_own_start() {
    let mut random = Random(2);
    for exponent in -8..=8 {
        let scale = 10f32.powi(exponent);
        for far in [0.0, 1.0, 1e3] {
            for rotation in ROTATIONS {
                let place = random.direction() * (far * scale);
                let half = vec3(0.3, 1.0, 0.6) * scale;
                let (cuboids, _) = one(place - half, place + half, rotation);
                spawn_from(&cuboids, &mut random, 1000 / 54 + 4);
            }
        }
    }
}

fn spawn_from(cuboids: &Cuboids, random: &mut Random, count: usize) {
    let [center, half] = cuboids.center_and_half(0);
    let axes = cuboids.axes[0].unwrap_or(V::AXES);
    for _ in 0..count {
        let mut q = random.cube();
        q[random.below(3)] = if random.unit() < 0.5 { 1.0 } else { -1.0 };
        if random.unit() < 0.2 {
            q[random.below(3)] = 1.0;
        }
        let q = q * half;
        let eye = center + random.direction() * (half.length() * (4.0 * random.unit() as f32));
        let to = center + axes[0] * q.x + axes[1] * q.y + axes[2] * q.z;
        let Some(direction) = (to - eye).try_normalize() else { continue };
        let Some(t) = hit(cuboids, eye, direction) else { continue };
        let surface = cuboids.surface::<f32>(0, (eye + direction * t).into());
        let lift = lift(&surface);
        for side in [1.0, -1.0] {
            let normal = V::from(surface.normal) * side;
            let origin = V::from(surface.point) + normal * lift;
            let leaving = random.direction();
            let leaving = if leaving.dot(normal) < 0.0 { -leaving } else { leaving };
            let again = hit(cuboids, origin, leaving);
            if side > 0.0 {
                assert_eq!(again, None, "{origin} {leaving} of {center} {half}");
            } else {
                // From inside it meets another face.
                let again = again.expect("a box is closed");
                let other = cuboids.surface::<f32>(0, (origin + leaving * again).into());
                let opposite = V::from(other.normal).dot(V::from(surface.normal)) < 0.5;
                assert!(opposite, "{origin} {leaving} {again} of {center} {half}");
            }
        }
    }
}
