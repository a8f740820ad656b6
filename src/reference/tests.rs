//! The reference against cases worked out by hand.
use super::*;
use crate::scene::{CameraDescription, Mesh, Pigment, Plane, Sides, Sky, Sphere};
use glam::{Vec3, dvec3, vec3};
use std::f64::consts::PI;

mod shading;
mod solids;

fn material() -> Material {
    let pigment = Pigment::Color(vec3(0.5, 0.25, 1.0));
    Material { name: "m".into(), pigment, shininess: 1.0, ..Material::default() }
}

fn sphere(center: Vec3, radius: f32) -> Sphere {
    Sphere { center, radius, sides: Sides::Both, material: 0 }
}

fn floor(height: f32) -> Plane {
    Plane { normal: Vec3::Y, distance: -height, material: 0 }
}

fn spheres(spheres: &[Sphere]) -> Description {
    Description { spheres: spheres.to_vec(), materials: vec![material()], ..Default::default() }
}

fn planes(planes: &[Plane]) -> Description {
    Description { planes: planes.to_vec(), materials: vec![material()], ..Default::default() }
}

fn triangle(corners: [Vec3; 3]) -> Description {
    let mesh = Mesh { positions: corners.to_vec(), triangles: vec![[0, 1, 2]], ..Mesh::default() };
    Description { meshes: vec![mesh], materials: vec![material()], ..Default::default() }
}

fn intersect(scene: &Description, origin: DVec3, direction: DVec3) -> Option<(f64, u32, DVec3)> {
    let hit = Tracer::new(scene).intersect(origin, direction.normalize(), f64::INFINITY);
    hit.map(|hit| (hit.t, hit.primitive, hit.normal))
}

#[track_caller]
fn assert_near(a: DVec3, b: DVec3) {
    assert!(a.abs_diff_eq(b, 1e-9 * (1.0 + b.length())), "{a} is not {b}");
}

#[test]
fn sphere_from_outside_inside_on_and_behind() {
    let scene = spheres(&[sphere(vec3(0.0, 0.0, -5.0), 2.0)]);
    let ahead = |z: f64| intersect(&scene, dvec3(0.0, 0.0, z), -DVec3::Z);
    assert_eq!(ahead(0.0), Some((3.0, 0, DVec3::Z)));
    assert_eq!(ahead(-4.0), Some((3.0, 0, DVec3::Z)), "from inside, the normal turns inward");
    assert_eq!(ahead(-3.0), Some((4.0, 0, DVec3::Z)), "on the surface, the far side is next");
    assert_eq!(ahead(-7.0), None, "on the surface, leaving");
    assert_eq!(ahead(-8.0), None, "behind");
}

#[test]
fn sphere_tangent_and_missed() {
    let scene = spheres(&[sphere(vec3(0.0, 0.0, -5.0), 2.0)]);
    let beside = |x: f64| intersect(&scene, dvec3(x, 0.0, 0.0), -DVec3::Z);
    let (t, _, normal) = beside(2.0).unwrap();
    assert!((t - 5.0).abs() < 1e-14);
    assert_near(normal, DVec3::X);
    assert_eq!(beside(2.000_000_1), None);
}

#[test]
fn small_sphere_far_away_and_huge_sphere_near() {
    let scene = spheres(&[sphere(vec3(0.0, 0.0, -1e6), 1e-3)]);
    let (t, ..) = intersect(&scene, DVec3::ZERO, -DVec3::Z).unwrap();
    assert!((t - (1e6 - f64::from(1e-3_f32))).abs() < 1e-9, "{t}");
    assert_eq!(intersect(&scene, dvec3(0.001_001, 0.0, 0.0), -DVec3::Z), None);
    let scene = spheres(&[sphere(vec3(0.0, -1e6, 0.0), 1e6)]);
    let (t, ..) = intersect(&scene, dvec3(0.0, 1e-3, 0.0), -DVec3::Y).unwrap();
    assert!((t - 1e-3).abs() < 1e-9, "{t}");
}

#[test]
fn plane_from_both_sides_parallel_and_scaled() {
    let scene = planes(&[floor(1.0)]);
    assert_eq!(intersect(&scene, dvec3(0.0, 3.0, 0.0), -DVec3::Y), Some((2.0, 0, DVec3::Y)));
    assert_eq!(intersect(&scene, dvec3(0.0, -3.0, 0.0), DVec3::Y), Some((4.0, 0, -DVec3::Y)));
    assert_eq!(intersect(&scene, dvec3(0.0, 3.0, 0.0), DVec3::Y), None, "behind");
    assert_eq!(intersect(&scene, dvec3(0.0, 3.0, 0.0), DVec3::X), None, "parallel");
    assert_eq!(intersect(&scene, dvec3(0.0, 1.0, 0.0), DVec3::X), None, "within the plane");
    let doubled = planes(&[Plane { normal: vec3(0.0, -4.0, 0.0), distance: 4.0, material: 0 }]);
    assert_eq!(intersect(&doubled, dvec3(0.0, 3.0, 0.0), -DVec3::Y), Some((2.0, 0, DVec3::Y)));
}

#[test]
fn triangle_from_both_sides_edges_and_outside() {
    let scene = triangle([vec3(0.0, 0.0, 0.0), vec3(1.0, 0.0, 0.0), vec3(0.0, 1.0, 0.0)]);
    let through = |x: f64, y: f64, z: f64| intersect(&scene, dvec3(x, y, z), dvec3(0.0, 0.0, -z));
    assert_eq!(through(0.25, 0.25, 2.0), Some((2.0, 0, DVec3::Z)));
    assert_eq!(through(0.25, 0.25, -3.0), Some((3.0, 0, -DVec3::Z)));
    assert_eq!(through(0.5, 0.0, 2.0), Some((2.0, 0, DVec3::Z)), "an edge belongs to it");
    assert_eq!(through(0.0, 0.0, 2.0), Some((2.0, 0, DVec3::Z)), "so does a corner");
    for (x, y) in [(-0.1, 0.5), (0.5, -0.1), (0.6, 0.6)] {
        assert_eq!(through(x, y, 2.0), None);
    }
    assert_eq!(intersect(&scene, dvec3(-1.0, 0.25, 0.0), DVec3::X), None, "edge-on");
    assert_eq!(intersect(&scene, dvec3(0.25, 0.25, -1.0), -DVec3::Z), None, "behind");
    let flat = triangle([Vec3::ZERO, Vec3::X, 2.0 * Vec3::X]);
    assert_eq!(intersect(&flat, dvec3(0.5, 0.0, 1.0), -DVec3::Z), None, "without area");
}

#[test]
fn no_ray_slips_between_triangles_that_share_an_edge() {
    let positions = vec![vec3(-1.3, -0.7, 0.1), vec3(1.1, -0.9, 0.3), vec3(0.9, 1.3, -0.2), vec3(-1.2, 0.8, 0.4)];
    let (a, c) = (positions[0].as_dvec3(), positions[2].as_dvec3());
    let mesh = Mesh { positions, triangles: vec![[0, 1, 2], [0, 2, 3]], ..Mesh::default() };
    let scene = Description { meshes: vec![mesh], materials: vec![material()], ..Default::default() };
    let eye = dvec3(0.3, 0.2, 3.0);
    for i in 1..1000 {
        let target = a.lerp(c, f64::from(i) / 1000.0);
        assert!(intersect(&scene, eye, target - eye).is_some(), "{i}");
    }
}

#[test]
fn ids_count_planes_then_spheres_then_triangles_and_ties_go_to_the_lowest() {
    let mut scene = triangle([vec3(-9.0, 0.0, -9.0), vec3(9.0, 0.0, -9.0), vec3(0.0, 0.0, 9.0)]);
    scene.spheres = vec![sphere(vec3(0.0, -1.0, 0.0), 1.0), sphere(vec3(0.0, -1.0, 0.0), 1.0)];
    scene.planes = vec![floor(-5.0), floor(0.0), floor(0.0)];
    let down = |scene: &Description| intersect(scene, dvec3(0.0, 2.0, 0.0), -DVec3::Y).map(|(t, id, _)| (t, id));
    assert_eq!(down(&scene), Some((2.0, 1)));
    scene.planes.truncate(1);
    assert_eq!(down(&scene), Some((2.0, 1)));
    scene.spheres.clear();
    assert_eq!(down(&scene), Some((2.0, 1)));
    scene.meshes.clear();
    assert_eq!(down(&scene), Some((7.0, 0)));
}

#[test]
fn t_max_is_left_out() {
    let tracer = Tracer::new(&planes(&[floor(0.0)]));
    let (eye, down) = (dvec3(0.0, 2.0, 0.0), -DVec3::Y);
    assert!(tracer.intersect(eye, down, 2.0).is_none() && !tracer.blocked(eye, down, 2.0));
    assert!(tracer.intersect(eye, down, 2.1).is_some() && tracer.blocked(eye, down, 2.1));
}

#[test]
fn camera_corners_and_centre() {
    let description =
        CameraDescription { eye: vec3(1.0, 2.0, 3.0), look_at: vec3(1.0, 2.0, -7.0), up: Vec3::Y, fov: 90.0 };
    let camera = Camera::new(&description, 2.0);
    assert_eq!(camera.ray(0.5, 0.5).0, dvec3(1.0, 2.0, 3.0));
    assert_near(camera.ray(0.5, 0.5).1, -DVec3::Z);
    assert_near(camera.ray(0.0, 0.0).1, dvec3(-2.0, 1.0, -1.0).normalize());
    assert_near(camera.ray(1.0, 0.0).1, dvec3(2.0, 1.0, -1.0).normalize());
    assert_near(camera.ray(0.0, 1.0).1, dvec3(-2.0, -1.0, -1.0).normalize());
}

#[test]
fn camera_with_up_parallel_to_the_view() {
    let with = |up: Vec3| {
        let description = CameraDescription { eye: Vec3::ZERO, look_at: -3.0 * Vec3::Y, up, fov: 90.0 };
        Camera::new(&description, 1.0).ray(0.5, 0.0).1
    };
    // |V| is smallest along x and z alike, and x comes first: the top of the picture lies towards +x.
    let expected = dvec3(1.0, -1.0, 0.0).normalize();
    for up in [Vec3::Y, -5.0 * Vec3::Y, Vec3::ZERO, vec3(0.0, 1.0, 1e-7)] {
        assert_near(with(up), expected);
    }
    assert_near(with(vec3(0.0, 1.0, 1e-5)), dvec3(0.0, -1.0, 1.0).normalize());
}

#[test]
fn camera_inside_a_sphere_sees_it_everywhere() {
    let mut scene = spheres(&[sphere(vec3(0.0, 1.0, 5.0), 3.0)]);
    scene.camera.fov = 120.0;
    for hit in hits(&scene, 8, 4) {
        let hit = hit.unwrap();
        assert!((hit.t - 3.0).abs() < 1e-12 && hit.primitive == 0);
    }
}

#[test]
fn a_picture_is_the_mean_of_its_samples() {
    let mut scene = planes(&[floor(0.0)]);
    scene.settings.ambient = Vec3::ONE;
    scene.sky = Sky::Color(vec3(0.25, 0.5, 0.75));
    let fine = render(&scene, 4, 4, 1);
    let coarse = render(&scene, 2, 2, 2);
    for (i, mean) in coarse.iter().enumerate() {
        let (x, y) = (i % 2 * 2, i / 2 * 2);
        let sum: DVec3 = [0, 1, 4, 5].iter().map(|k| fine[y * 4 + x + k]).sum();
        assert_near(*mean, sum / 4.0);
    }
}
