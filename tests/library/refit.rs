//! A scene that was made to fit moved things gives what one compiled anew gives.

use glam::Vec3;
use raypacket::{
    Aabb, Description, Hit, Mesh, Ray, RefitError, Scene, Sides, Sphere, Structure, compile, intersect_rays,
};
use raypacket::{occluded_rays, scene};

use crate::common::{Pcg, all_builtins, empty};

/// Moves every vertex and every body a little.
fn shake(description: &mut Description, rng: &mut Pcg) {
    let mut shift = || 0.3 * rng.cube();
    for mesh in &mut description.meshes {
        mesh.positions.iter_mut().for_each(|p| *p += shift());
    }
    description.spheres.iter_mut().for_each(|s| s.center += shift());
    description.quads.iter_mut().for_each(|q| q.corner += shift());
    for cylinder in &mut description.cylinders {
        let shift = shift();
        (cylinder.base, cylinder.apex) = (cylinder.base + shift, cylinder.apex + shift);
    }
    description.tori.iter_mut().for_each(|t| t.center += shift());
}

fn answers(scene: &Scene, description: &Description, seed: u64) -> (Vec<Option<Hit>>, Vec<bool>) {
    let mut rng = Pcg::new(seed);
    let around = Aabb { min: Vec3::splat(-3.0), max: Vec3::splat(3.0) };
    let bounds = scene.bvh.as_ref().map_or(around, |bvh| bvh.bounds);
    let size = (bounds.max - bounds.min).max_element();
    let mut place = |i: usize| {
        let from = if i.is_multiple_of(2) { description.camera.eye } else { bounds.center() + size * rng.cube() };
        Ray::new(from, (bounds.center() + 0.5 * size * rng.cube() - from).normalize())
    };
    let rays: Vec<Ray> = (0..2000).map(&mut place).collect();
    let (mut hits, mut blocked) = (vec![None; rays.len()], vec![false; rays.len()]);
    intersect_rays(scene, &rays, &mut hits);
    occluded_rays(scene, &rays, &mut blocked);
    (hits, blocked)
}

#[test]
fn hits_equal_those_of_a_fresh_compile() {
    for mut description in all_builtins() {
        let mut scene = compile(&description).expect("a sound scene");
        let mut rng = Pcg::new(2);
        for round in 0..2 {
            shake(&mut description, &mut rng);
            scene.refit(&description).expect("the same primitives");
            let fresh = compile(&description).expect("a sound scene");
            let wanted = answers(&fresh, &description, round);
            assert!(answers(&scene, &description, round) == wanted, "{}", description.name);
            assert_eq!(scene.plan, fresh.plan);
            assert!(wanted.0.iter().flatten().count() > 20, "{}", description.name);
        }
    }
}

/// A sheet of triangles over x and z.
fn sheet(cells: u32, height: impl Fn(f32, f32) -> f32) -> Mesh {
    let side = cells + 1;
    let at = |i: u32| {
        let [x, z] = [i % side, i / side].map(|i| i as f32 / cells as f32 * 10.0 - 5.0);
        Vec3::new(x, height(x, z), z)
    };
    let positions: Vec<Vec3> = (0..side * side).map(at).collect();
    let corner = (0..side * side).filter(|i| i % side < cells && i / side < cells);
    let triangles: Vec<_> = corner.flat_map(|i| [[i, i + side, i + 1], [i + 1, i + side, i + side + 1]]).collect();
    Mesh::new(&positions, &triangles)
}

#[test]
fn a_sheet_that_waves() {
    let mut description = empty();
    description.camera.eye = Vec3::new(0.0, 5.0, 0.0);
    description.meshes = vec![sheet(60, |x, z| x.sin() * z.cos())];
    let mut scene = compile(&description).expect("a sound scene");
    assert_eq!(scene.plan.structure, Structure::Tree);
    let still = answers(&scene, &description, 1);
    for frame in 1..4 {
        let phase = frame as f32 * 0.7;
        description.meshes[0].positions = sheet(60, |x, z| (x + phase).sin() * (z - phase).cos()).positions;
        scene.refit(&description).expect("the same triangles");
        let fresh = compile(&description).expect("a sound scene");
        let now = answers(&scene, &description, 1);
        assert!(now == answers(&fresh, &description, 1), "frame {frame}");
        assert!(now != still && now.0.iter().flatten().count() > 500);
        let [refitted, fresh] = [&scene, &fresh].map(|s| s.bvh.as_ref().expect("a tree"));
        assert_eq!(refitted.bounds, fresh.bounds);
        assert!(refitted.stats().sah < 2.0 * fresh.stats().sah, "{} {}", refitted.stats(), fresh.stats());
    }
}

#[test]
fn other_primitives_are_refused_and_nothing_changes() {
    let description = scene::load("flake").expect("built in");
    let mut scene = compile(&description).expect("a sound scene");
    let before = answers(&scene, &description, 4);
    let mut more = description.clone();
    more.spheres.push(Sphere::new([0.0; 3], 1.0));
    let [found, compiled] = [more.spheres.len(), description.spheres.len()];
    assert_eq!(scene.refit(&more), Err(RefitError::Count { kind: "spheres", found, compiled }));
    let mut other = description.clone();
    other.spheres[5].sides = Sides::Front;
    assert_eq!(scene.refit(&other), Err(RefitError::Variant { kind: "spheres" }));
    let mut faulty = description.clone();
    faulty.spheres[5].radius = -1.0;
    let Err(RefitError::Invalid(invalid)) = scene.refit(&faulty) else { panic!("a radius below 0") };
    assert_eq!(invalid.key, "sphere[5].radius");
    assert!(answers(&scene, &description, 4) == before);
}
