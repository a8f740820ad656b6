//! Every named method: one answer on all widths and ways, right where it is known to be, and chosen only where it is.

#[path = "common/mod.rs"]
mod common;

use glam::{Vec3, vec3};
use raypacket::geometry::methods::{
    Choice, NormalizeMethod, OffsetMethod, SphereMethod, TerminatorMethod, TorusMethod, TriangleMethod,
};
use raypacket::math::Lanes;
use raypacket::render::{Camera, Film, Kernel, render};
use raypacket::scene::{
    CompileOptions, Description, Material, Mesh, Quad, Scene, Sides, Sphere, Structure, Torus, compile, compile_with,
    load,
};
use raypacket::trace::{BATCH, Blocked, HitBatch, NONE, RayBatch, Scratch, intersect, occluded};
use wide::{f32x4, f32x8};

use common::{Pcg, light};

/// Spheres, triangles and tori in a room of quads, all near.
fn room() -> Description {
    let mut random = Pcg::new(11);
    let mut place = || vec3(random.unit().x * 2.0, random.unit().y * 2.0, -6.0 + random.unit().z);
    let sphere = |center| Sphere { center, radius: 0.6, sides: Sides::Both, material: 0 };
    let torus = |center| Torus { center, axis: vec3(0.3, 1.0, 0.2), major_radius: 0.7, minor_radius: 0.2, material: 0 };
    let mut description = Description {
        materials: vec![Material::default()],
        spheres: (0..4).map(|_| sphere(place())).collect(),
        tori: (0..3).map(|_| torus(place())).collect(),
        meshes: vec![Mesh {
            positions: (0..12).map(|_| place()).collect(),
            triangles: (0..4).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect(),
            ..Mesh::default()
        }],
        quads: vec![Quad { corner: vec3(-4.0, -3.0, -9.0), u: Vec3::X * 8.0, v: Vec3::Y * 6.0, material: 0 }],
        lights: vec![light(vec3(1.0, 3.0, -1.0))],
        ..Description::default()
    };
    description.settings.attenuation = false;
    description.camera.eye = Vec3::ZERO;
    description.camera.look_at = Vec3::NEG_Z;
    description
}

/// A sphere and nothing else.
fn alone(center: Vec3, radius: f32) -> Description {
    let room = room();
    let spheres = vec![Sphere { center, radius, sides: Sides::Both, material: 0 }];
    Description { spheres, tori: vec![], meshes: vec![], quads: vec![], ..room }
}

fn choices() -> Vec<Choice> {
    let mut all: Vec<_> = SphereMethod::ALL.iter().map(|&m| Choice::Sphere(m)).collect();
    all.extend(TriangleMethod::ALL.iter().map(|&m| Choice::Triangle(m)));
    all.extend(TorusMethod::ALL.iter().map(|&m| Choice::Torus(m)));
    all.extend(NormalizeMethod::ALL.iter().map(|&m| Choice::Normalize(m)));
    all.extend(OffsetMethod::ALL.iter().map(|&m| Choice::Offset(m)));
    all.extend(TerminatorMethod::ALL.iter().map(|&m| Choice::Terminator(m)));
    all
}

fn rays() -> Vec<RayBatch> {
    let mut random = Pcg::new(5);
    let mut batches = vec![RayBatch::default(); 8];
    for batch in &mut batches {
        for _ in 0..BATCH {
            let target = vec3(random.unit().x * 3.0, random.unit().y * 3.0, -6.0);
            let origin = random.unit();
            batch.push(origin, (target - origin).normalize(), 0.0, f32::INFINITY);
        }
    }
    batches
}

/// The bits of the distances, and the primitives; a ray is blocked exactly where it hits.
fn answers<L: Lanes>(scene: &Scene, what: &str) -> Vec<(u32, u32)> {
    let mut scratch = Scratch::default();
    let mut all = Vec::new();
    for batch in rays() {
        let (mut hits, mut blocked) = (HitBatch::default(), Blocked::default());
        intersect::<L>(scene, &batch, &mut hits, &mut scratch);
        occluded::<L>(scene, &batch, &mut blocked, &mut scratch);
        for i in 0..batch.len {
            assert_eq!(blocked.get(i, 1) == 1, hits.primitive[i] != NONE, "{what}, ray {i}: {batch:?}");
            all.push((hits.t[i].to_bits(), hits.primitive[i]));
        }
    }
    all
}

#[test]
fn every_method_gives_one_answer_on_all_widths() {
    let description = room();
    for choice in choices() {
        for structure in [Structure::None, Structure::Tree] {
            let what = format!("{choice:?}, {structure:?}");
            let scene =
                compile_with(&description, &CompileOptions { structure: Some(structure), methods: vec![choice] })
                    .expect("a sound scene");
            let wanted = answers::<f32>(&scene, &what);
            assert_eq!(answers::<f32x4>(&scene, &what), wanted, "{what}, x4");
            assert_eq!(answers::<f32x8>(&scene, &what), wanted, "{what}, x8");
            let hits = wanted.iter().filter(|(_, id)| *id != NONE).count();
            assert!((wanted.len() / 4..wanted.len()).contains(&hits), "{what}: {hits} of {}", wanted.len());
        }
    }
}

#[test]
fn near_and_from_outside_all_methods_see_the_same() {
    let description = room();
    let trace = |choice| {
        let scene =
            compile_with(&description, &CompileOptions { structure: Some(Structure::None), methods: vec![choice] })
                .expect("a sound scene");
        answers::<f32x8>(&scene, "")
    };
    let wanted = trace(Choice::Offset(OffsetMethod::Derived));
    for choice in choices() {
        let found = trace(choice);
        let others = wanted.iter().zip(&found).filter(|((a, p), (b, q))| {
            let (a, b) = (f32::from_bits(*a), f32::from_bits(*b));
            // A silhouette may be off by 1e-6; where both hit, t by as much over the cosine of incidence.
            p != q || (a - b).abs() > 1e-3 * a
        });
        let others = others.count();
        // What loses double roots does so for some of the rays that graze a tube.
        let lossy = matches!(choice, Choice::Torus(TorusMethod::Ferrari | TorusMethod::SphereTrace));
        assert!(others <= if lossy { 20 } else { 2 }, "{choice:?}: {others} of {}", wanted.len());
    }
}

fn picture(description: &Description, choices: &[Choice], samples: u32) -> Film {
    let scene = compile_with(description, &choices.into()).expect("a sound scene");
    let mut film = Film::new(128, 64);
    render(&scene, &Camera::new(&description.camera, 2.0), Kernel::X8, samples, &mut film, &|_| ());
    film
}

/// The greatest difference of a channel as displayed, and the share of pixels that differ by more than 1/255.
fn difference(a: &Film, b: &Film) -> f64 {
    let shown = |c: f32| f64::from(c.clamp(0.0, 1.0)).powf(1.0 / 2.2);
    let off = a
        .pixels
        .iter()
        .zip(&b.pixels)
        .filter(|(p, q)| p.iter().zip(*q).any(|(&a, &b)| (shown(a) - shown(b)).abs() > 1.0 / 255.0));
    off.count() as f64 / a.pixels.len() as f64
}

#[test]
fn what_the_plan_chooses_for_speed_is_not_seen() {
    // Near enough for the cheap method, by its bound.
    let mut description = Description { lights: vec![light(vec3(1.0, 2.0, -1.0))], ..alone(vec3(0.0, 0.0, -5.0), 1.5) };
    let plan = compile(&description).expect("a sound scene").plan;
    assert_eq!(plan.methods.sphere, SphereMethod::Stable, "by default nothing may change: {}", plan.why);
    description.settings.tolerance = 1.0 / 255.0;
    let plan = compile(&description).expect("a sound scene").plan;
    assert_eq!(plan.methods.sphere, SphereMethod::Quadratic, "{}", plan.why);
    let stable = Choice::Sphere(SphereMethod::Stable);
    // One of 256 rays of a pixel does not show.
    assert_eq!(difference(&picture(&description, &[], 16), &picture(&description, &[stable], 16)), 0.0);
}

#[test]
fn what_is_not_chosen_is_seen_to_fail() {
    // Through a telescope at what is 5,000 of its sizes away.
    let mut far = alone(vec3(0.0, 0.0, -5000.0), 1.0);
    far.camera.fov = 0.03;
    let [planned, double, quadratic] = [None, Some(SphereMethod::Double), Some(SphereMethod::Quadratic)]
        .map(|m| picture(&far, m.map(Choice::Sphere).as_slice(), 1));
    let (ours, textbook) = (difference(&planned, &double), difference(&quadratic, &double));
    assert!(ours < 0.01 && textbook > 0.05, "{ours} {textbook}");
    let classic = load("classic").expect("built in");
    let derived = picture(&classic, &[], 1);
    let acne = difference(&picture(&classic, &[Choice::Offset(OffsetMethod::None)], 1), &derived);
    assert!(acne > 0.02, "{acne}");
}
