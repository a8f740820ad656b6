use super::*;
use crate::geometry::Cuboids;
use crate::geometry::trial::{ROUNDOFF, Random, Ray, agree, all_widths, lift};
use crate::reference::Tracer;
use crate::scene::{self, Description};
use glam::{Vec3 as V, vec3};

fn one(center: V, radius: f32, iterations: u32) -> (Fractals, Tracer) {
    let mut fractals = Fractals::default();
    fractals.push(center, radius, iterations, 0);
    let described = scene::Fractal { center, radius, iterations, material: 0 };
    let description = Description { fractals: vec![described], ..Description::default() };
    (fractals, Tracer::new(&description))
}

fn hit(fractals: &Fractals, origin: V, direction: V) -> Option<f32> {
    all_widths(fractals, &[Ray { origin, direction }], 0.0)[0]
}

/// Rays at and in the sponge: random, axis-parallel, in planes of two axes; aimed at or from anything, or points whose
/// coordinates are planes of the grid or middles of its cells.
fn rays(center: V, radius: f32, iterations: u32, count: usize, seed: u64) -> Vec<Ray> {
    let random = &mut Random(seed);
    let ray = |_| {
        let mut q = random.cube() * 1.1;
        let halves = 2.0 * 3f32.powi(random.below(iterations as usize + 1) as i32);
        if random.below(2) == 0 {
            q = q
                .map(|c| if random.unit() < 0.5 { ((c + 1.0) / 2.0 * halves).round() / halves * 2.0 - 1.0 } else { c });
        }
        let to = center + q * radius;
        let direction = match random.below(4) {
            0 => random.along_axis(),
            1 => random.across_axis(),
            _ => random.direction(),
        };
        let far = [0.0, 0.0, 0.4, 2.0, 30.0, 1e4][random.below(6)] * radius;
        Ray { origin: to - direction * far, direction }
    };
    (0..count).map(ray).collect()
}

#[test]
fn answers_are_the_reference_s() {
    let mut total = [0; 2];
    for iterations in [0, 1, 2, 3, 4, 6, 8] {
        for (center, radius) in [(V::ZERO, 1.0), (vec3(1.0, -2.0, 3.3), 0.7), (vec3(-1e-5, 2e-6, 0.0), 1e-6)] {
            let (fractals, tracer) = one(center, radius, iterations);
            let most = f64::from(center.abs().max_element() + 1.74 * radius);
            let size = |ray: &Ray| f64::from(ray.origin.length()).max(most);
            let off =
                |ray: &Ray, _| ROUNDOFF * (4.0 * f64::from(ray.origin.distance(center)) + 5.0 * f64::from(radius));
            let rays = rays(center, radius, iterations, 1500, u64::from(iterations));
            let counts = agree(&fractals, &tracer, &rays, size, off);
            assert!(counts[0] > 300, "{iterations}: {counts:?}");
            total = [0, 1].map(|k| total[k] + counts[k]);
        }
    }
    assert!(total[1] * 4 < total[0], "{total:?} hits, to explain");
}

/// Where nothing is aimed at an edge, no answer needs an explanation.
#[test]
fn plain_answers_are_within_the_bound() {
    let mut random = Random(8);
    for iterations in 0..=8 {
        let (center, radius) = (vec3(0.1, 0.2, 0.3), 1.3);
        let (fractals, tracer) = one(center, radius, iterations);
        let off = |ray: &Ray, _| ROUNDOFF * (4.0 * f64::from(ray.origin.distance(center)) + 5.0 * f64::from(radius));
        let rays: Vec<Ray> =
            (0..2000).map(|_| Ray { origin: center + random.cube() * 3.0, direction: random.direction() }).collect();
        let counts = agree(&fractals, &tracer, &rays, |_| 5.0, off);
        assert!(counts[0] > 300 && counts[1] <= usize::from(iterations > 5), "{iterations}: {counts:?}");
    }
}

/// In an inner edge, by rounding inside the solid, the ray starts in the void all the same.
#[test]
fn points_beyond_an_inner_edge_come_out_of_it() {
    let (fractals, _) = one(V::ZERO, 1.5, 1);
    for (x, y) in [(1.0, 1.0), (1.0, -1.0), (-1.0, 1.0), (-1.0, -1.0)] {
        let beyond = vec3(x * 0.500_000_1, y * 0.500_000_2, 1.0);
        let surface = fractals.surface::<f32>(0, beyond.into());
        let (point, normal) = (V::from(surface.point), V::from(surface.normal));
        assert_eq!((point.x, normal), (x * 0.5, vec3(-x, 0.0, 0.0)), "{beyond}");
        assert!(point.y.abs() < 0.5 && point.y.abs() > 0.499_99, "{point}");
    }
}

#[test]
fn without_iterations_it_is_the_cube() {
    let (center, radius) = (vec3(1.0, -2.0, 0.5), 0.75);
    let (fractals, _) = one(center, radius, 0);
    let mut cuboids = Cuboids::default();
    cuboids.push(center - radius, center + radius, V::ZERO, 0);
    let rays = rays(center, radius, 0, 5000, 3);
    let (sponge, cube) = (all_widths(&fractals, &rays, 0.0), all_widths(&cuboids, &rays, 0.0));
    for ((sponge, cube), ray) in sponge.into_iter().zip(cube).zip(rays) {
        let near = ROUNDOFF as f32 * 8.0 * (ray.origin.length() + 1.0);
        match (sponge, cube) {
            (Some(a), Some(b)) => assert!((a - b).abs() < near * 1e3, "{ray:?} {a} {b}"),
            (None, None) => {}
            // Both subtract in another order, which tells where a ray grazes an edge.
            _ => {
                let moved = |by: f32| {
                    let rays = [1.0, -1.0]
                        .map(|s| Ray { origin: ray.origin + (center - ray.origin).signum() * by * s, ..ray });
                    all_widths(&cuboids, &rays, 0.0).iter().map(Option::is_some).collect::<Vec<_>>()
                };
                assert!(moved(near).contains(&sponge.is_some()), "{ray:?} {sponge:?} {cube:?}");
            }
        }
    }
}

#[test]
fn holes_walls_inside_and_the_surface() {
    let (fractals, _) = one(V::ZERO, 1.5, 1);
    // Cells have edge 1: the bores are within ±0.5.
    assert_eq!(hit(&fractals, vec3(0.2, 0.3, 4.0), V::NEG_Z), None, "through a bore");
    assert_eq!(hit(&fractals, vec3(1.2, 0.3, 4.0), V::NEG_Z), Some(2.5), "a wall beside it");
    assert_eq!(hit(&fractals, V::ZERO, V::X), None, "from the middle along a bore");
    // Into the bore along x at x = 0.5, and its wall is y = 0.5; into the one along y, and its wall is x = 0.5.
    let rounded = |direction: V| hit(&fractals, V::ZERO, direction).map(|t| (t * 1e4).round());
    assert_eq!(rounded(vec3(0.8, 0.6, 0.0)), Some(8333.0));
    assert_eq!(rounded(vec3(0.6, 0.64, 0.48)), Some(8333.0));
    assert_eq!(hit(&fractals, vec3(1.0, 1.0, 1.0), V::X), Some(0.5), "from inside, out of the cube");
    assert_eq!(hit(&fractals, vec3(1.0, 1.0, 1.0), V::NEG_Z), Some(2.5), "three solid cells in a row");
    assert_eq!(hit(&fractals, vec3(1.0, 1.0, 0.0), V::NEG_X), Some(0.5), "out into a bore");
    assert_eq!(hit(&fractals, vec3(1.0, 1.0, 1.0), V::NEG_ONE.normalize()).map(|t| (t * 1e3).round()), Some(866.0));
    assert_eq!(hit(&fractals, vec3(1.5, 1.0, 1.0), V::X), None, "on the surface, leaving");
    assert_eq!(hit(&fractals, vec3(1.5, 1.0, 1.0), V::NEG_X), Some(3.0), "on the surface, entering");
    let through = Ray { origin: vec3(1.2, 0.3, 4.0), direction: V::NEG_Z };
    assert_eq!(all_widths(&fractals, &[through], 2.75), [Some(3.5)], "t_min in the first wall: it is left");
    assert_eq!(all_widths(&fractals, &[through], 4.0), [Some(4.5)], "t_min behind it");
}

#[test]
fn rays_that_are_no_rays_hit_nothing_and_leave_others_alone() {
    let (fractals, _) = one(V::ZERO, 1.0, 3);
    let good = Ray { origin: vec3(0.99, 0.99, 3.0), direction: V::NEG_Z };
    let rays = [good, Ray { origin: V::NAN, ..good }, Ray { direction: V::NAN, ..good }, good];
    assert_eq!(all_widths(&fractals, &rays, 0.0), [Some(2.0), None, None, Some(2.0)]);
}

/// The cells that are void are those that the definition bores out.
#[test]
fn clearance_tells_void_from_solid_and_is_a_bound() {
    let grid = Grid::<f32>::new(1.0, 3);
    let cells: Vec<V> =
        (0..27 * 27 * 27).map(|i| vec3((i % 27) as f32, (i / 27 % 27) as f32, (i / 729) as f32)).collect();
    let void = |c: V| {
        (0..3).any(|level| {
            let middle = |x: f32| x as i32 / 3_i32.pow(level) % 3 == 1;
            [c.x, c.y, c.z].into_iter().filter(|&x| middle(x)).count() > 1
        })
    };
    let clearance: Vec<f32> = cells.iter().map(|&c| grid.clearance((c - 13.0).into())).collect();
    assert_eq!(clearance.iter().filter(|v| **v < 0.0).count(), 8000);
    let at = |c: V| (c.x + 27.0 * (c.y + 27.0 * c.z)) as usize;
    let mut random = Random(1);
    for (i, &c) in cells.iter().enumerate() {
        assert_eq!(clearance[i] > 0.0, void(c), "{c}");
        // Nothing changes within the cube about the middle.
        for _ in 0..20 {
            let reach = clearance[i].abs() - 0.5;
            let other = (c + (random.cube() * reach).round()).clamp(V::ZERO, V::splat(26.0));
            assert_eq!(clearance[at(other)] > 0.0, void(c), "{c} {other}");
        }
    }
}

#[test]
fn surfaces_are_the_reference_s() {
    let (mut compared, mut different) = (0, 0);
    for iterations in [0, 1, 2, 4, 6] {
        let (center, radius) = (vec3(0.3, -0.2, 0.1), 1.3);
        let (fractals, tracer) = one(center, radius, iterations);
        for ray in rays(center, radius, iterations, 1000, 4) {
            let Some(t) = hit(&fractals, ray.origin, ray.direction) else { continue };
            let truth = tracer.intersect(ray.origin.as_dvec3(), ray.direction.as_dvec3(), f64::INFINITY);
            let close = |hit: &crate::reference::Hit| (hit.t - f64::from(t)).abs() < 1e-6;
            let Some(truth) = truth.filter(close) else { continue };
            if ray.origin.length() > 100.0 {
                continue;
            }
            let surface = fractals.surface::<f32>(0, (ray.origin + ray.direction * t).into());
            let normal = V::from(surface.normal);
            let facing = if normal.dot(ray.direction) > 0.0 { -normal } else { normal };
            compared += 1;
            different += usize::from(facing.as_dvec3() != truth.normal);
        }
    }
    // Rays aimed at edges may see either face.
    assert!(compared > 1500 && different * 20 < compared, "{different} of {compared}");
}

#[test]
fn uv_and_checker_are_the_cube_s() {
    let (fractals, _) = one(V::ZERO, 1.5, 1);
    let surface = fractals.surface::<f32>(0, vec3(0.2, 0.500_000_1, 1.2).into());
    // The wall of a bore faces into it.
    assert_eq!((V::from(surface.point).y, V::from(surface.normal)), (0.5, V::NEG_Y));
    let [u, v] = fractals.uv(0, &surface);
    assert!((u - (0.5 + 0.2 / 3.0)).abs() < 1e-6 && (v - (0.5 + 1.2 / 3.0)).abs() < 1e-6, "{u} {v}");
    assert_eq!(V::from(fractals.checker(0, &surface)), vec3(0.2, 0.0, 1.2));
}

/// Rays that leave the surface do not meet it where they start.
#[test]
fn spawned_rays_do_not_meet_their_own_start() {
    let mut random = Random(2);
    let mut hits = 0;
    for exponent in -8..=8 {
        let scale = 10f32.powi(exponent);
        for (far, iterations) in [(0.0, 0), (0.0, 2), (0.0, 5), (0.0, 8), (1.0, 4), (30.0, 3), (1e3, 1)] {
            let center = random.direction() * (far * scale);
            let (fractals, _) = one(center, scale, iterations);
            let rays = rays(center, scale, iterations, 60, 11);
            for ray in rays.iter().filter(|r| (r.origin - center).length() < 100.0 * scale) {
                let direction = random.direction();
                let Some(t) = hit(&fractals, ray.origin, direction) else { continue };
                let surface = fractals.surface::<f32>(0, (ray.origin + direction * t).into());
                let normal = V::from(surface.normal);
                let normal = if normal.dot(direction) > 0.0 { -normal } else { normal };
                let origin = V::from(surface.point) + normal * lift(&surface);
                let leaving = random.direction();
                let leaving = if leaving.dot(normal) < 0.0 { -leaving } else { leaving };
                hits += 1;
                // A face that is met belongs to another place: the next cell's at the least, or one across an edge.
                if let Some(again) = hit(&fractals, origin, leaving) {
                    let met = fractals.surface::<f32>(0, (origin + leaving * again).into());
                    let same = V::from(met.normal).abs() == normal.abs();
                    let moved = (V::from(met.point) - V::from(surface.point)).dot(normal).abs();
                    let cell = 2.0 * scale / 3f32.powi(iterations as i32);
                    assert!(!same || moved > 0.9 * cell, "{iterations} {center} {origin} {leaving}: {again}");
                }
            }
        }
    }
    assert!(hits > 2000, "{hits}");
}

/// From one ulp before a hit on it is found again, to the bit; from the hit on the next one comes.
#[test]
fn t_min_next_to_a_hit_changes_nothing() {
    let mut later = 0;
    for (center, radius, iterations) in
        [(V::ZERO, 1.0, 2), (vec3(1.0, -2.0, 3.3), 0.7, 4), (vec3(0.1, 0.2, 0.3), 1.3, 0)]
    {
        let (fractals, _) = one(center, radius, iterations);
        for ray in rays(center, radius, iterations, 2000, 12) {
            let from = |t_min: f32| all_widths(&fractals, &[ray], t_min)[0];
            let mut t = from(0.0);
            for changes in 0.. {
                let Some(hit) = t.filter(|t| t.is_normal()) else { break };
                assert_eq!(from(hit.next_down()), t, "{ray:?}");
                t = from(hit);
                assert!(t.is_none_or(|t| t > hit) && changes < 250, "{ray:?}: {t:?} after {hit}");
                later += usize::from(t.is_some());
            }
        }
    }
    assert!(later > 3000, "{later}");
}
