//! Eyes in awkward places: in a sphere, on a surface, level with planes.

use glam::{DVec3, Vec3, vec3};
use raypacket::render::{Camera, Kernel, primary_hits};
use raypacket::scene::{CameraDescription, Description};
use raypacket::trace::{NONE, intersect_one, occluded_one};

use crate::common::{Pcg, ROUNDOFF, compiled, empty, mesh, plane, sphere};

const SIZE: usize = 33;

/// Distance, id and direction of every eye ray in all six directions, the same from every kernel.
fn around(scene: &mut Description, eye: Vec3) -> Vec<(f32, u32, DVec3)> {
    let mut all = Vec::new();
    for look in Vec3::AXES.into_iter().flat_map(|axis| [axis, -axis]) {
        // Parallel to the view now and then, which the camera guards against. 100 degrees leave no gaps between.
        scene.camera = CameraDescription { eye, look_at: eye + look * eye.length().max(1.0), up: Vec3::Y, fov: 100.0 };
        let camera = Camera::new(&scene.camera, 1.0);
        let compiled = compiled(scene);
        let hits = primary_hits(&compiled, &camera, Kernel::X1, SIZE, SIZE);
        for kernel in Kernel::ALL {
            assert_eq!(primary_hits(&compiled, &camera, kernel, SIZE, SIZE), hits, "{}", kernel.name());
        }
        let middle = |i: usize| (i as f32 + 0.5) / SIZE as f32;
        all.extend((0..SIZE * SIZE).map(|i| {
            let direction = camera.direction(middle(i % SIZE), middle(i / SIZE));
            (hits.t[i], hits.primitive[i], direction.as_dvec3().normalize())
        }));
    }
    all
}

/// Where a ray from within a sphere leaves it.
fn way_out(f: DVec3, direction: DVec3, radius: f64) -> f64 {
    let b = f.dot(direction);
    let closest = f - direction * b;
    (radius * radius - closest.length_squared()).sqrt() - b
}

#[test]
fn inside_a_sphere_its_inside_is_everywhere() {
    for radius in [1e-3, 2.0, 1e6] {
        for center in [Vec3::ZERO, vec3(3.0, -1.0, 2.0) * radius] {
            let mut scene = empty();
            scene.spheres.push(sphere(center, radius));
            for (depth, towards) in [(0.0, Vec3::X), (0.5, Vec3::Y), (0.999, vec3(0.6, 0.0, -0.8))] {
                let eye = center + towards * (depth * radius);
                for (t, id, direction) in around(&mut scene, eye) {
                    assert_eq!(id, 0, "radius {radius}, eye {eye}, towards {direction}");
                    let (f, r) = ((eye - center).as_dvec3(), f64::from(radius));
                    let exact = way_out(f, direction, r);
                    let cosine = ((f + direction * exact) / r).dot(direction).abs();
                    // The bound of `stable`, and 16 ε for the kernel's own direction, which turns the ray by as much.
                    let bound = 8.0 * exact + (4.0 * f.length_squared() / r + 16.0 * exact) / cosine;
                    let error = (f64::from(t) - exact).abs();
                    assert!(error <= ROUNDOFF * bound, "{radius}, {eye}, {direction}: {t} for {exact}");
                }
            }
        }
    }
}

#[test]
fn on_a_plane_it_is_not_seen_and_all_else_is() {
    for normal in [Vec3::Y, vec3(0.0, 0.0, -2.0), vec3(1.0, 2.0, 2.0)] {
        // Whole numbers: the eye is exactly on the plane.
        let eye = vec3(4.0, -1.0, 3.0);
        let mut scene = empty();
        scene.planes.push(plane(normal, -normal.dot(eye)));
        assert!(around(&mut scene, eye).iter().all(|&(t, id, _)| id == NONE && t == f32::INFINITY), "{normal}");
        scene.spheres.push(sphere(eye, 5.0));
        assert!(around(&mut scene, eye).iter().all(|&(_, id, _)| id == 1), "{normal}");
    }
}

#[test]
fn on_a_sphere_half_the_world_is_its_inside() {
    for radius in [0.125, 1.0, 1024.0] {
        let mut scene = empty();
        let center = vec3(1.0, -2.0, 0.5) * radius;
        scene.spheres.push(sphere(center, radius));
        for normal in [Vec3::X, Vec3::Y, -Vec3::Z] {
            for (t, id, direction) in around(&mut scene, center + normal * radius) {
                // c is 0 here, so an inward ray leaves after −2 b, and b = r n·d.
                let cosine = normal.as_dvec3().dot(direction);
                let chord = -2.0 * f64::from(radius) * cosine;
                let error = (f64::from(t) - chord).abs();
                let near_tangent = cosine.abs() < 16.0 * ROUNDOFF;
                let right =
                    if cosine > 0.0 { id == NONE } else { id == 0 && error <= 64.0 * ROUNDOFF * f64::from(radius) };
                assert!(right || near_tangent, "{radius}, {normal}, {direction}: {t} for {chord}");
            }
        }
    }
}

/// Between two planes, level with them: nothing on the way; on them neither.
#[test]
fn rays_along_planes_miss_them() {
    let mut rng = Pcg::new(4);
    let mut scene = empty();
    scene.planes = vec![plane(Vec3::Y, 1.0), plane(Vec3::NEG_Y, 1.0), plane(Vec3::Y, 0.0)];
    let scene = compiled(&scene);
    for _ in 0..1000 {
        let level = vec3(1.0, 0.0, 1.0) * rng.unit();
        let direction = level.normalize() + Vec3::Y * rng.pick(&[0.0, -0.0]);
        for height in [1.0, -1.0, 0.0, -0.0, 0.5, 3.0] {
            let origin = vec3(rng.range(-9.0, 9.0), height, rng.range(-9.0, 9.0));
            assert_eq!(intersect_one(&scene, origin, direction), None, "{origin} {direction}");
            assert!(!occluded_one(&scene, origin, direction, f32::INFINITY), "{origin} {direction}");
        }
    }
}

/// Triangles seen edge-on are not there, and what is behind them is.
#[test]
fn in_the_plane_of_a_triangle() {
    let mut scene = empty();
    scene.meshes.push(mesh(&[[vec3(-1.0, 0.0, -1.0), vec3(1.0, 0.0, -1.0), vec3(0.0, 0.0, 1.0)]]));
    scene.spheres.push(sphere(Vec3::ZERO, 20.0));
    let scene = compiled(&scene);
    for eye in [vec3(5.0, 0.0, 0.0), vec3(0.0, 0.0, 0.25), vec3(0.0, 0.0, 1.0)] {
        for direction in [Vec3::X, -Vec3::X, Vec3::Z, -Vec3::Z, vec3(0.6, 0.0, 0.8)] {
            assert_eq!(intersect_one(&scene, eye, direction).map(|h| h.primitive), Some(0), "{eye} {direction}");
        }
    }
}
