//! The surface at a hit, against figures worked out by hand, and rays that leave it.

use glam::{Vec2, Vec3, vec3};
use raypacket::{Mesh, Ray, Scene, Sphere, SurfaceInteraction, compile, intersect_one, occluded_one, scene};

use crate::common::{Pcg, empty, white};

fn hit(scene: &Scene, origin: Vec3, direction: Vec3) -> SurfaceInteraction {
    let ray = Ray::new(origin, direction);
    scene.surface(&ray, &intersect_one(scene, origin, direction).expect("a hit"))
}

#[test]
fn a_sphere_from_outside_and_inside() {
    let mut description = empty();
    description.materials.push(white(0.5));
    description.spheres = vec![Sphere::new([0.0, 0.0, -5.0], 2.0).with_material(1)];
    let scene = compile(&description).expect("a sound scene");
    let outside = hit(&scene, Vec3::ZERO, Vec3::NEG_Z);
    assert_eq!((outside.point, outside.normal, outside.front), (vec3(0.0, 0.0, -3.0), Vec3::Z, true));
    assert_eq!((outside.shading_normal, outside.material), (Vec3::Z, 1));
    assert!((outside.uv - Vec2::new(0.5, 0.5)).length() < 1e-6, "{}", outside.uv);
    let inside = hit(&scene, vec3(0.0, 0.0, -5.0), Vec3::Z);
    assert_eq!((inside.point, inside.normal, inside.front), (vec3(0.0, 0.0, -3.0), Vec3::Z, false));
    assert!(outside.lift > 0.0 && outside.lift < 1e-5);
}

#[test]
fn a_triangle_with_vertex_normals_and_uvs() {
    let mesh = Mesh::new(&[Vec3::ZERO, Vec3::X, Vec3::Y], &[[0, 1, 2]])
        .with_normals(&[Vec3::Z, vec3(1.0, 0.0, 1.0), Vec3::Z])
        .with_uvs(&[[0.0, 0.0], [2.0, 0.0], [0.0, 4.0]]);
    let mut description = empty();
    description.meshes = vec![mesh];
    let scene = compile(&description).expect("a sound scene");
    let surface = hit(&scene, vec3(0.5, 0.25, 1.0), Vec3::NEG_Z);
    assert_eq!((surface.point, surface.normal), (vec3(0.5, 0.25, 0.0), Vec3::Z));
    assert!((surface.uv - Vec2::new(1.0, 1.0)).length() < 1e-6, "{}", surface.uv);
    // Half of (1, 0, 1), a quarter each of two more, as unit vectors.
    let wanted = (vec3(1.0, 0.0, 1.0).normalize() + Vec3::Z).normalize();
    assert!((surface.shading_normal - wanted).length() < 1e-6, "{}", surface.shading_normal);
}

#[test]
fn rays_that_leave_a_surface_do_not_meet_it() {
    let mut description = empty();
    description.spheres = vec![Sphere::new([100.0, 20.0, 3.0], 1.0)];
    let scene = compile(&description).expect("a sound scene");
    let mut rng = Pcg::new(1);
    for _ in 0..1000 {
        let direction = rng.cube().normalize();
        let surface = hit(&scene, vec3(100.0, 20.0, 3.0) - 3.0 * direction, direction);
        let away = rng.cube().normalize();
        let away = if away.dot(surface.normal) < 0.0 { -away } else { away };
        let ray = surface.spawn_ray(away);
        assert_eq!(intersect_one(&scene, ray.origin, ray.direction), None);
        let shadow = surface.spawn_ray_to(surface.point + 5.0 * away);
        assert!(shadow.t_max > 4.9 && shadow.t_max < 5.0);
        assert!(!occluded_one(&scene, shadow.origin, shadow.direction, shadow.t_max));
        // Into the body: the other side is 2 away at most, and is met.
        let ray = surface.spawn_ray(-surface.normal);
        let across = intersect_one(&scene, ray.origin, ray.direction).expect("the other side");
        assert!((across.t - 2.0).abs() < 1e-4, "{}", across.t);
    }
}

#[test]
fn every_kind_has_a_surface() {
    let description = scene::load("primitives").expect("built in");
    let scene = compile(&description).expect("a sound scene");
    let mut rng = Pcg::new(5);
    let mut kinds = std::collections::HashSet::new();
    for _ in 0..5000 {
        let ray = Ray::between(description.camera.eye, description.camera.look_at + 4.0 * rng.cube());
        let Some(found) = intersect_one(&scene, ray.origin, ray.direction) else { continue };
        let (surface, primitive) = (scene.surface(&ray, &found), scene.primitive(found.primitive).expect("known"));
        assert_eq!(surface.material, primitive.material);
        assert!((surface.point - ray.at(found.t)).length() < 1e-3, "{primitive:?}");
        assert!((surface.normal.length() - 1.0).abs() < 1e-5 && surface.uv.is_finite(), "{primitive:?}");
        kinds.insert(primitive.kind);
    }
    assert!(kinds.len() >= 6, "{kinds:?}");
}
