//! That a dial's setting is what the traced numbers have.

use std::f64::consts::FRAC_PI_2;

use glam::{DVec3, Vec3, dvec3};

use super::surfaces::torus;
use super::*;

/// Whether a dial is met as nearly as the makers allow, and a little for another formula.
fn agrees(found: f64, wanted: f64) -> bool {
    draw::off(found, wanted) <= 0.26
}

/// The square of how far a ray's line passes a point by, as the discriminant has it.
fn squared(ray: &Ray, center: Vec3) -> f64 {
    let (o, d) = ray.line();
    let f = o - center.as_dvec3();
    (f.length_squared() - f.dot(d).powi(2)).max(0.0)
}

/// Half of the rays on either side, at the distance that the dial says.
fn both_sides(name: &str, signed: impl Fn(&Case, &Ray) -> f64) {
    for (dial, case) in cases(name) {
        let mut inside = 0;
        for ray in &case.rays {
            let found = signed(&case, ray);
            inside += usize::from(found > 0.0);
            assert!(agrees(found.abs(), dial), "{name} at {dial:e}: {found:e} of {ray:?}");
        }
        assert_eq!(inside, RAYS / 2, "{name} at {dial:e}");
    }
}

#[test]
fn tangents_of_spheres() {
    both_sides("sphere-tangent", |case, ray| 1.0 - squared(ray, case.description.spheres[0].center).sqrt());
}

#[test]
fn insides_of_spheres() {
    for (dial, case) in cases("sphere-inside") {
        let center = case.description.spheres[0].center.as_dvec3();
        for ray in &case.rays {
            let depth = 1.0 - ray.origin.as_dvec3().distance(center);
            assert!(agrees(depth, dial), "at {dial:e}: {depth:e}");
        }
    }
}

#[test]
fn far_spheres_and_meshes() {
    for name in ["sphere-far", "mesh-far"] {
        for (dial, case) in cases(name) {
            let center = match &case.description.spheres[..] {
                [s] => s.center,
                _ => {
                    let all = &case.description.meshes[0].positions;
                    all.iter().sum::<Vec3>() / all.len() as f32
                }
            };
            let by: Vec<f64> = case.rays.iter().map(|r| squared(r, center).sqrt()).collect();
            // The middle of a mesh's vertices is not quite its centre.
            assert!(by.iter().all(|&b| b < 1.25), "{name} at {dial:e}: {by:?}");
            let hits = by.iter().filter(|&&b| b < 0.85).count();
            assert!(hits > RAYS / 4, "{name} at {dial:e}: {hits}");
            for ray in &case.rays {
                let away = ray.origin.as_dvec3().distance(center.as_dvec3()) - 1.0;
                assert!((away / dial - 1.0).abs() < 0.1, "{name} at {dial:e}: {away:e}");
            }
        }
    }
}

#[test]
fn close_spheres() {
    for (dial, case) in cases("sphere-close") {
        let sphere = &case.description.spheres[0];
        let radius = f64::from(sphere.radius);
        assert!((radius / dial - 1.0).abs() < 1e-6);
        let mut hits = 0;
        for ray in &case.rays {
            let (o, d) = ray.line();
            assert!(o.abs().max_element() < 3.0, "not by the world's origin: {o}");
            let height = o.distance(sphere.center.as_dvec3()) - radius;
            assert!((height - 1.0).abs() < 1e-5, "at {dial:e}: {height}");
            let below = d.dot(sphere.center.as_dvec3() - o) > 0.0;
            hits += usize::from(below && squared(ray, sphere.center) < radius * radius);
        }
        assert!((RAYS * 3 / 4).abs_diff(hits) <= 3, "at {dial:e}: {hits}");
    }
}

#[test]
fn angles_to_planes() {
    both_sides("plane-grazing", |case, ray| {
        let plane = &case.description.planes[0];
        let (o, d) = ray.line();
        let n = plane.normal.as_dvec3();
        let up = o.dot(n) + f64::from(plane.distance);
        // A ray towards the plane counts as above zero.
        let sine = -d.dot(n) / n.length() * up.signum();
        sine.asin().to_degrees()
    });
}

/// Where a ray's line meets a triangle, by Möller and Trumbore's formula.
fn meets(ray: &Ray, [a, b, c]: [DVec3; 3]) -> Option<DVec3> {
    let (o, d) = ray.line();
    let (u, v, f) = (b - a, c - a, o - a);
    let p = d.cross(v);
    let det = u.dot(p);
    let (x, q) = (f.dot(p) / det, f.cross(u));
    let (y, t) = (d.dot(q) / det, v.dot(q) / det);
    (x >= 0.0 && y >= 0.0 && x + y <= 1.0 && t > 0.0).then(|| o + d * t)
}

fn triangles(case: &Case) -> impl Iterator<Item = [DVec3; 3]> {
    let mesh = &case.description.meshes[0];
    mesh.triangles.iter().map(|t| t.map(|i| mesh.positions[i as usize].as_dvec3()))
}

#[test]
fn distances_from_edges() {
    for (dial, case) in cases("triangle-edge") {
        let all: Vec<_> = triangles(&case).collect();
        let [a, b, _] = all[0];
        let mut first = 0;
        for ray in &case.rays {
            let hits: Vec<_> = all.iter().map(|&t| meets(ray, t)).collect();
            assert_eq!(hits.iter().flatten().count(), 1, "at {dial:e}: {ray:?}");
            first += usize::from(hits[0].is_some());
            let at = hits.into_iter().flatten().next().expect("one");
            // In the triangle it is farther from the edge than across the ray.
            let away = (at - a).cross(b - a).length() / (b - a).length_squared();
            assert!((0.74..4.0).contains(&(away / dial)), "at {dial:e}: {away:e}");
        }
        assert_eq!(first, RAYS / 2, "at {dial:e}");
    }
}

#[test]
fn distances_from_vertices() {
    for (dial, case) in cases("triangle-vertex") {
        let all: Vec<_> = triangles(&case).collect();
        let mut met = vec![0; all.len()];
        for ray in &case.rays {
            let by = squared(ray, case.description.meshes[0].positions[0]).sqrt();
            // The difference of squares is good to 10⁻¹⁵.
            assert!(agrees(by, dial) || by < 1e-7 && dial < 1e-7, "at {dial:e}: {by:e}");
            let hits: Vec<_> = (0..all.len()).filter(|&i| meets(ray, all[i]).is_some()).collect();
            assert_eq!(hits.len(), 1, "at {dial:e}: {ray:?}");
            met[hits[0]] += 1;
        }
        assert!(met.iter().all(|&n| n > 0), "at {dial:e}: {met:?}");
    }
}

#[test]
fn slivers() {
    for (dial, case) in cases("triangle-sliver") {
        let corners @ [a, b, c] = triangles(&case).next().expect("one");
        let length = a.distance(b);
        let height = (c - a).cross(b - a).length() / length;
        assert!((length - 1.0).abs() < 1e-5 && agrees(height / length, dial), "{height:e} for {dial:e}");
        let hits = case.rays.iter().filter(|r| meets(r, corners).is_some()).count();
        assert_eq!(hits, RAYS / 2, "at {dial:e}");
        let n = (b - a).cross(c - a).normalize();
        for ray in &case.rays {
            let (o, d) = ray.line();
            let at = o + d * ((a - o).dot(n) / d.dot(n));
            let off = (at - a).cross(b - a).length() / length;
            // What misses may be off by the rounding of the ray as well.
            assert!(off < height + 2e-6, "at {dial:e}: {off:e}");
        }
    }
}

/// Closed: every edge is there in both directions.
#[test]
fn meshes_are_closed_and_where_they_should_be() {
    for (dial, case) in cases("mesh-moved") {
        let mesh = &case.description.meshes[0];
        let edges: std::collections::HashSet<_> =
            mesh.triangles.iter().flat_map(|&[a, b, c]| [(a, b), (b, c), (c, a)]).collect();
        assert_eq!(edges.len(), 3 * mesh.triangles.len());
        assert!(edges.iter().all(|&(a, b)| edges.contains(&(b, a))));
        let away = mesh.positions[0].length();
        assert!((f64::from(away) - dial).abs() < 1.5 + dial * 1e-6, "{away} for {dial:e}");
        let met = case.rays.iter().filter(|r| triangles(&case).any(|t| meets(r, t).is_some())).count();
        assert!(met > if dial < 1e6 { RAYS * 9 / 10 } else { RAYS / 4 }, "at {dial:e}: {met}");
    }
}

/// How far the nearest point of a torus's inner circle is, as the ray's point at `s` sees it, from the direction in which
/// it is from the circle that the ray should touch: 0 at a contact.
fn out_of_contact(body: &crate::scene::Torus, ray: &Ray, name: &str, s: f64) -> f64 {
    let (o, d) = ray.line();
    let axis = body.axis.as_dvec3().normalize();
    let q = o + d * s - body.center.as_dvec3();
    let out = (q - axis * q.dot(axis)).normalize();
    let n = (q - out * f64::from(body.major_radius)).normalize();
    match name {
        "torus-outer-equator" => (n - out).length(),
        "torus-inner-equator" => (n + out).length(),
        _ => n.dot(out).abs(),
    }
}

/// The torus's own distance has the dial's value where the ray passes a point of contact. A line touches two of the top
/// circle; it is one of those.
#[test]
fn tangents_of_tori() {
    const STEP: f64 = 0.0025;
    for name in ["torus-outer-equator", "torus-inner-equator", "torus-top-circle"] {
        for (dial, case) in cases(name) {
            let body = &case.description.tori[0];
            for (i, ray) in case.rays.iter().enumerate() {
                let out = |s: f64| out_of_contact(body, ray, name, s);
                let (o, d) = ray.line();
                let contacts = (1..5000).map(|k| f64::from(k) * STEP).filter(|&s| {
                    let here = out(s);
                    here <= out(s - STEP) && here <= out(s + STEP)
                });
                let clearance = |s| {
                    let at = least(s, STEP, out);
                    -torus(body, o + d * at) / f64::from(body.minor_radius) * draw::side(i)
                };
                let found: Vec<f64> = contacts.map(clearance).collect();
                assert!(found.iter().any(|&f| agrees(f, dial)), "{name} at {dial:e}: {found:?} of {ray:?}");
            }
        }
    }
}

/// Where `f` is least next to `at`, by halving.
fn least(mut at: f64, mut step: f64, f: impl Fn(f64) -> f64) -> f64 {
    while step > 1e-14 {
        let best = [at - step, at, at + step].into_iter().min_by(|&a, &b| f(a).total_cmp(&f(b)));
        at = best.expect("three");
        step *= 0.5;
    }
    at
}

#[test]
fn angles_to_axes() {
    for name in ["cylinder-axis", "cylinder-axis-tilted", "cone-axis", "cone-axis-tilted", "cone-side"] {
        let mut zeros = [0, 0];
        for (dial, case) in cases(name) {
            let d = &case.description;
            let ends = match (&d.cylinders[..], &d.cones[..]) {
                ([c], []) => [c.base, c.apex],
                ([], [c]) => [c.base, c.apex],
                _ => panic!("{name}: one body"),
            };
            let [base, apex] = ends.map(|v| v.as_dvec3());
            for ray in &case.rays {
                let (_, direction) = ray.line();
                // From the chord between unit vectors, which small angles lose no digits in.
                let axis = (apex - base).normalize();
                let angle = 2.0 * (0.5 * (direction - axis).length().min((direction + axis).length())).asin();
                let angle = if name == "cone-side" { angle - (1.0 / apex.distance(base)).atan() } else { angle };
                let angle = angle.abs().to_degrees();
                assert!(agrees(angle, dial), "{name} at {dial:e}: {angle:e} of {ray:?}");
                for x in ray.direction.to_array().into_iter().filter(|&x| x == 0.0) {
                    zeros[usize::from(x.is_sign_negative())] += 1;
                }
            }
        }
        let aligned = name == "cylinder-axis" || name == "cone-axis";
        assert!(zeros.iter().all(|&n| (n > 60) == aligned), "{name}: {zeros:?}");
    }
}

#[test]
fn faces_of_boxes() {
    for (dial, case) in cases("box-face") {
        let cuboid = &case.description.cuboids[0];
        let mut negative = 0;
        for (i, ray) in case.rays.iter().enumerate() {
            let wanted = [0, 1, -1][i % 3] * dial.round() as i64;
            // Steps away from zero, as both faces are on their own side of it.
            let off = |k: usize, face: f32| {
                let x = ray.origin[k];
                (x * face > 0.0).then(|| i64::from(x.abs().to_bits()) - i64::from(face.abs().to_bits()))
            };
            let level = |k: usize| [cuboid.min[k], cuboid.max[k]].into_iter().any(|face| off(k, face) == Some(wanted));
            let right = (0..3).any(|k| ray.direction[k] == 0.0 && level(k));
            assert!(right, "at {dial:e}: {ray:?} is not {wanted} steps off {cuboid:?}");
            negative += (0..3).filter(|&k| ray.direction[k].to_bits() == (-0.0_f32).to_bits()).count();
        }
        assert!(negative > RAYS / 4, "{negative}");
    }
}

/// By Snell's law: sin of the refracted ray is above or below 1.
#[test]
fn critical_angles() {
    both_sides("refraction-critical", |case, ray| {
        let plane = &case.description.planes[0];
        let (o, d) = ray.line();
        let n = plane.normal.as_dvec3();
        assert!(o.dot(n) + f64::from(plane.distance) < 0.0 && d.dot(n) > 0.0, "in glass, on the way out");
        let flat = FRAC_PI_2 - (d.dot(n) / n.length()).acos();
        let angle = FRAC_PI_2 - flat - (1.0_f64 / 1.5).asin();
        // Steeper is passed on.
        let sine = 1.5 * (d - n * (d.dot(n) / n.length_squared())).length();
        assert_eq!(sine < 1.0, angle < 0.0);
        -angle.to_degrees()
    });
}

#[test]
fn shells_and_gaps() {
    for (dial, case) in cases("refraction-shell") {
        let [outer, inner] = &case.description.spheres[..] else { panic!("two spheres") };
        assert!(agrees(f64::from(outer.radius) - f64::from(inner.radius), dial));
        let by = case.rays.iter().map(|r| squared(r, outer.center).sqrt());
        let rim = by.inspect(|&b| assert!(b < 1.0)).filter(|&b| b > f64::from(inner.radius)).count();
        assert_eq!(rim, RAYS / 2, "at {dial:e}");
    }
    for (dial, case) in cases("refraction-gap") {
        let [near, far] = &case.description.cuboids[..] else { panic!("two blocks") };
        assert_eq!((near.max.x, far.min.x), (0.0, dial as f32));
        for ray in &case.rays {
            // Refraction only makes it steeper, so that it meets the second block within its face.
            let at = ray.origin + ray.direction * (-1.0 - ray.origin.x) / ray.direction.x;
            assert!(at.y.abs() < 1.01 && at.z.abs() < 1.01, "{at}");
            let aside = ray.direction.with_x(0.0).length() / 1.5;
            assert!(aside / (1.0 - aside * aside).sqrt() < 1.0);
        }
    }
}

#[test]
fn lights_are_at_their_height_and_rays_end_on_the_surface() {
    for (name, center) in [("light-plane", None), ("light-sphere", Some(()))] {
        for (dial, case) in cases(name) {
            let height = |p: DVec3| match center {
                None => p.y,
                Some(()) => p.distance(case.description.spheres[0].center.as_dvec3()) - 1.0,
            };
            let light = case.description.lights[0].position;
            assert!(agrees(height(light.as_dvec3()), dial));
            for ray in &case.rays {
                assert_eq!(ray.origin, light);
                let (o, d) = ray.line();
                let end = o + d * f64::from(ray.t_max);
                let bound = 4.0 * ROUNDOFF * f64::from(ray.t_max);
                assert!(height(end).abs() < bound, "{name} at {dial:e}: {ray:?} ends {:e} off", height(end));
            }
        }
    }
}

#[test]
fn scenes_are_scaled_and_moved() {
    for (dial, case) in cases("scene-scaled") {
        let plain = find("scene-scaled").expect("a case").make(1.0, 0, 0).description;
        assert_eq!(case.description.primitives(), 10);
        let ratio = f64::from(case.description.tori[0].major_radius) / f64::from(plain.tori[0].major_radius);
        assert!((ratio / dial - 1.0).abs() < 1e-6);
        let eye = case.rays[0].origin.as_dvec3().length();
        assert!((eye / (12.0 * dial) - 1.0).abs() < 1e-6);
    }
    for (dial, case) in cases("scene-moved") {
        let [sphere, fractal] = [case.description.spheres[0].center, case.description.fractals[0].center];
        let moved = sphere.as_dvec3() - dvec3(0.0, 1.5, 2.0);
        assert!((moved.length() - dial).abs() < 1e-6 * dial.max(1.0), "{moved} for {dial:e}");
        let between = (fractal - sphere).as_dvec3() - dvec3(0.0, -2.0, -4.0);
        assert!(between.length() < 1e-6 * dial.max(1.0), "{between}");
    }
}
