//! Synthetic answers, made by the reference itself: right ones, rounded ones, and wrong ones of many kinds.
use super::bound::U;
use super::*;
use crate::reference::{Camera, Tracer};
use crate::scene::{CameraDescription, Cylinder, Light, Material, Mesh, Pigment, Plane, Sides, Sphere};
use crate::trace::NONE;
use glam::{Vec3, vec3};

/// Odd, so that the middle column looks straight ahead, along an edge of the checkerboard and of the triangle.
const SIZE: [usize; 2] = [63, 41];

struct Owned {
    t: Vec<f32>,
    primitive: Vec<u32>,
    pixels: Vec<[f32; 3]>,
}

impl Owned {
    fn view(&self) -> Answers<'_> {
        Answers { t: &self.t, primitive: &self.primitive, pixels: &self.pixels }
    }
}

/// A checkered floor, a mirror, a dull sphere, a triangle with an edge straight ahead, and a light.
fn scene() -> Description {
    let material =
        |pigment, reflectance| Material { pigment, reflectance, specular: 0.2, shininess: 20.0, ..Material::default() };
    let checker = Pigment::Checker { colors: [Vec3::splat(0.9), Vec3::splat(0.1)], size: 1.0 };
    let positions = vec![vec3(0.0, 2.0, -2.0), vec3(0.0, 4.0, -2.0), vec3(1.5, 3.0, -2.0)];
    Description {
        name: "test".into(),
        camera: CameraDescription { eye: vec3(0.0, 1.53, 5.0), look_at: vec3(0.0, 1.53, 0.0), ..Default::default() },
        lights: vec![Light { position: vec3(3.0, 6.0, 3.0), power: Vec3::splat(400.0) }],
        materials: vec![
            material(checker, 0.0),
            material(Pigment::Color(vec3(0.5, 0.5, 0.5)), 0.8),
            material(Pigment::Color(vec3(0.9, 0.3, 0.2)), 0.0),
        ],
        planes: vec![Plane { normal: Vec3::Y, distance: 0.0, material: 0 }],
        spheres: vec![
            Sphere { center: vec3(0.0, 1.0, 0.0), radius: 0.75, sides: Sides::Both, material: 1 },
            Sphere { center: vec3(-2.0, 1.0, 0.0), radius: 1.0, sides: Sides::Both, material: 2 },
        ],
        meshes: vec![Mesh { positions, triangles: vec![[0, 1, 2]], material: 2, ..Mesh::default() }],
        ..Default::default()
    }
}

/// The reference's answers as f32, each ray off by `roundoffs` in a direction of its own.
fn answers(scene: &Description, roundoffs: f64) -> Owned {
    let [width, height] = SIZE;
    let (tracer, camera) = (Tracer::new(scene), Camera::new(&scene.camera, width as f64 / height as f64));
    let mut owned = Owned { t: vec![], primitive: vec![], pixels: vec![] };
    for i in 0..width * height {
        let (x, y) = ((i % width) as f64 + 0.5, (i / width) as f64 + 0.5);
        let (eye, direction) = camera.ray(x / width as f64, y / height as f64);
        let angle = i as f64;
        let off = roundoffs * U * DVec3::new(angle.cos(), angle.sin(), (2.0 * angle).cos());
        let (origin, direction) = (eye + off * eye.length(), (direction + off).normalize());
        let hit = tracer.intersect(origin, direction, f64::INFINITY);
        owned.t.push(hit.map_or(f32::INFINITY, |hit| hit.t as f32));
        owned.primitive.push(hit.map_or(NONE, |hit| hit.primitive));
        owned.pixels.push(tracer.radiance(origin, direction).as_vec3().to_array());
    }
    owned
}

fn truth() -> Truth {
    Truth::new(&scene(), SIZE[0], SIZE[1])
}

fn compare(wrong: &Owned) -> Comparison {
    truth().compare(&wrong.view())
}

fn at(x: usize, y: usize) -> usize {
    y * SIZE[0] + x
}

#[test]
fn the_reference_agrees_with_itself() {
    let comparison = compare(&answers(&scene(), 0.0));
    assert!(comparison.explained());
    assert_eq!((comparison.hits_different, comparison.pixels_different), (0, 0));
    assert!(comparison.t_error_max <= U, "{}", comparison.t_error_max);
}

#[test]
fn rounding_at_edges_is_explained() {
    let comparison = compare(&answers(&scene(), 6.0));
    assert!(comparison.hits_different > 2 && comparison.pixels_different > 5, "{comparison:?}");
    assert!(comparison.explained(), "{comparison:?}");
}

#[test]
fn errors_beyond_the_bound_are_not() {
    let comparison = compare(&answers(&scene(), 2000.0));
    assert!(comparison.t_unexplained > 1000, "{comparison:?}");
}

#[test]
fn a_wrong_pixel_in_the_interior_is_not_explained() {
    // Sky, sphere, mirror, triangle, floor.
    for (x, y) in [(5, 3), (17, 24), (29, 26), (35, 5), (50, 39)] {
        for wrong in [[0.3; 3], [f32::NAN; 3], [f32::INFINITY; 3]] {
            let mut answers = answers(&scene(), 0.0);
            answers.pixels[at(x, y)] = wrong;
            let comparison = compare(&answers);
            assert_eq!((comparison.pixels_different, comparison.pixels_unexplained), (1, 1), "{x} {y} {wrong:?}");
        }
        // A step and a half off, in one channel.
        let mut answers = answers(&scene(), 0.0);
        let blue = &mut answers.pixels[at(x, y)][2];
        let shown = |c: f32| displayed(DVec3::splat(f64::from(c))).x * 255.0;
        let right = shown(*blue);
        *blue = (0..=8000).map(|i| i as f32 / 8000.0).find(|&c| shown(c) > right + 1.2).unwrap();
        assert!(shown(*blue) < right + 2.0);
        assert_eq!(compare(&answers).pixels_unexplained, 1, "{x} {y}");
    }
}

#[test]
fn a_pixel_on_an_edge_shows_one_of_its_sides_or_is_not_explained() {
    let mut wrong = answers(&scene(), 0.0);
    let edge = at(SIZE[0] / 2, 38);
    wrong.pixels[edge] = [0.9, 0.0, 0.0];
    assert_eq!(compare(&wrong).pixels_unexplained, 1, "red between a light and a dark cell");
    let cells = [-1.0, 1.0].map(|side| {
        let (eye, direction) = Camera::new(&scene().camera, 63.0 / 41.0).ray(0.5, 38.5 / 41.0);
        Tracer::new(&scene()).radiance(eye, (direction + side * 1e-6 * DVec3::X).normalize())
    });
    for cell in cells {
        wrong.pixels[edge] = cell.as_vec3().to_array();
        assert_eq!(compare(&wrong).pixels_unexplained, 0, "{cell}");
    }
}

#[test]
fn a_wrong_radius_is_not_explained() {
    let mut other = scene();
    other.spheres[1].radius = 1.0001;
    let slightly = compare(&answers(&other, 0.0));
    assert!(slightly.t_unexplained > 50, "{slightly:?}");
    other.spheres[1].radius = 1.05;
    let clearly = compare(&answers(&other, 0.0));
    assert!(clearly.hits_unexplained > 5 && clearly.pixels_unexplained > 5, "{clearly:?}");
}

#[test]
fn a_wrong_hit_in_the_interior_is_not_explained() {
    let (x, y) = (17, 24);
    for (primitive, t) in [(NONE, f32::INFINITY), (0, 5.0), (1, 5.0), (99, 5.0), (2, f32::NAN), (2, 1.0)] {
        let mut wrong = answers(&scene(), 0.0);
        assert_eq!(wrong.primitive[at(x, y)], 2);
        (wrong.primitive[at(x, y)], wrong.t[at(x, y)]) = (primitive, t);
        let comparison = compare(&wrong);
        assert_eq!(comparison.hits_unexplained + comparison.t_unexplained, 1, "{primitive} {t}");
    }
    // A t that is off by 40 roundoffs, and a miss that carries a distance.
    let mut wrong = answers(&scene(), 0.0);
    wrong.t[at(x, y)] *= 1.0 + 80.0 * U as f32;
    wrong.t[at(5, 3)] = 7.0;
    assert_eq!(wrong.primitive[at(5, 3)], NONE);
    assert_eq!(compare(&wrong).t_unexplained, 2);
}

/// Of a cylinder and the sphere that it ends in, of the same radius ½: the middle pixel looks straight at them, `before`
/// the end, where the cylinder is the nearer by ½ − √(¼ − before²).
fn touching(before: f32) -> Description {
    let mut scene = scene();
    let end = Vec3::Y;
    scene.camera.eye = vec3(-before, 1.0, 5.0);
    scene.camera.look_at = vec3(-before, 1.0, 0.0);
    scene.planes.clear();
    scene.meshes.clear();
    scene.spheres = vec![Sphere { center: end, radius: 0.5, sides: Sides::Both, material: 2 }];
    let base = end - 2.0 * Vec3::X;
    let cylinder = Cylinder { base, apex: end, radius: 0.5, caps: false, sides: Sides::Both, material: 2 };
    scene.cylinders.push(cylinder);
    scene
}

const SPHERE: u32 = 0;
const CYLINDER: u32 = 1;

/// Judges an answer that says `primitive` in the middle of [`touching`], at the primitive's own distance or
/// where there is none the cylinder's, times `1 + off`: how many hits differ, and how many are unexplained.
fn judged(before: f32, primitive: u32, off: f64) -> [usize; 2] {
    let scene = touching(before);
    let tracer = Tracer::new(&scene);
    let (eye, ahead) = (scene.camera.eye.as_dvec3(), DVec3::NEG_Z);
    let distance = |id: u32| tracer.distance(id, eye, ahead);
    let middle = at(SIZE[0] / 2, SIZE[1] / 2);
    let mut answers = answers(&scene, 0.0);
    assert_eq!(answers.primitive[middle], CYLINDER, "the truth");
    answers.primitive[middle] = primitive;
    answers.t[middle] = (distance(primitive).or(distance(CYLINDER)).unwrap() * (1.0 + off)) as f32;
    let comparison = Truth::new(&scene, SIZE[0], SIZE[1]).compare(&answers.view());
    [comparison.hits_different, comparison.hits_unexplained]
}

#[test]
fn touching_surfaces_explain_each_other() {
    let before = 3e-4;
    // No ray within the bound, k u s = 5e-6 aside and as much by its turn, sees the sphere as the nearest.
    let (scene, reach) = (touching(before), 16.0 * U * 5.2 * 2.0);
    for i in -10..=10 {
        let aside = DVec3::X * (f64::from(i) / 10.0 * reach);
        let hit = Tracer::new(&scene).intersect(scene.camera.eye.as_dvec3() + aside, DVec3::NEG_Z, f64::INFINITY);
        assert_eq!(hit.unwrap().primitive, CYLINDER);
    }
    assert_eq!(judged(before, SPHERE, 0.0), [1, 0]);
    assert_eq!(judged(before, SPHERE, 8.0 * U), [1, 0], "rounded");
    assert_eq!(judged(before, SPHERE, 80.0 * U), [1, 1], "at a distance of its own");
    assert_eq!(judged(before, SPHERE, -80.0 * U), [1, 1], "nearer than either");
}

#[test]
fn what_lies_behind_or_aside_is_not_explained() {
    // The sphere lies behind the cylinder by 5, 20 and 2e4 times a relative k u.
    for before in [0.005, 0.01, 0.3] {
        let behind = 0.5 - (0.25 - f64::from(before).powi(2)).sqrt();
        assert!(behind > 4.0 * K * U * 4.5, "{behind}");
        assert_eq!(judged(before, SPHERE, 0.0), [1, 1], "{before} before the end");
    }
    // Past the sphere, and nothing at all, at the distance of what is there.
    assert_eq!(judged(1.0, SPHERE, 0.0), [1, 1], "a sphere that the ray misses");
    assert_eq!(judged(1.0, 7, 0.0), [1, 1], "no primitive of the scene");
    // Where nothing is: a hit of either.
    for primitive in [SPHERE, CYLINDER] {
        let scene = touching(1.0);
        let mut answers = answers(&scene, 0.0);
        assert_eq!(answers.primitive[at(3, 3)], NONE);
        (answers.primitive[at(3, 3)], answers.t[at(3, 3)]) = (primitive, 4.5);
        assert_eq!(Truth::new(&scene, SIZE[0], SIZE[1]).compare(&answers.view()).hits_unexplained, 1, "{primitive}");
    }
}

#[test]
fn missing_shadows_mirrors_and_a_shifted_checker_are_not_explained() {
    let right = answers(&scene(), 0.0);
    let mut shadowless = scene();
    shadowless.spheres[1].center.y = 1e4;
    shadowless.spheres[1].radius = 1e-3;
    let mut mirrorless = scene();
    mirrorless.settings.max_depth = 1;
    let mut swapped = scene();
    swapped.materials[0].pigment = Pigment::Checker { colors: [Vec3::splat(0.1), Vec3::splat(0.9)], size: 1.0 };
    for (other, least) in [(shadowless, 10), (mirrorless, 40), (swapped, 300)] {
        let other = answers(&other, 0.0);
        let same = |i: usize| other.primitive[i] == right.primitive[i];
        let pixels = (0..right.pixels.len()).map(|i| if same(i) { other.pixels[i] } else { right.pixels[i] });
        let wrong = Owned { t: right.t.clone(), primitive: right.primitive.clone(), pixels: pixels.collect() };
        let comparison = compare(&wrong);
        // All of them, but for those that happen to lie on an edge.
        let allowed = SIZE[1] / 2;
        assert!(comparison.pixels_unexplained >= least, "{comparison:?}");
        assert!(comparison.pixels_unexplained + allowed >= comparison.pixels_different, "{comparison:?}");
    }
}

#[test]
fn kernels_have_to_agree_to_the_bit() {
    let (right, mut other) = (answers(&scene(), 0.0), answers(&scene(), 0.0));
    let truth = truth();
    let report = |other: &Owned| judge(&truth, &[(Kernel::X1, right.view()), (Kernel::X8, other.view())]);
    assert!(report(&other).identical && report(&other).pass);
    other.t[at(17, 24)] = f32::from_bits(other.t[at(17, 24)].to_bits() + 1);
    let different = report(&other);
    assert!(!different.identical && !different.pass);
    assert!(different.kernels.iter().all(|k| k.comparison.explained()));
}

/// Of a black wall that fills the view only distances tell where it is; and they alone make a scene fail.
#[test]
fn wrong_distances_alone_fail() {
    let wall = |distance: f32| Description {
        camera: CameraDescription { eye: vec3(0.0, 0.0, 5.0), look_at: Vec3::ZERO, ..Default::default() },
        materials: vec![Material { pigment: Pigment::Color(Vec3::ZERO), ..Material::default() }],
        planes: vec![Plane { normal: Vec3::Z, distance, material: 0 }],
        ..Default::default()
    };
    let [width, height] = SIZE;
    for (distance, off) in [(1.0, false), (1.0001, true), (0.9999, true)] {
        let scene = scene::compile(&wall(distance)).expect("a sound scene");
        let report = verify_compiled(&wall(1.0), &scene, &Kernel::ALL, width, height);
        assert_eq!((report.pass, report.identical), (!off, true), "{report}");
        for KernelReport { comparison, .. } in report.kernels {
            assert_eq!((comparison.hits_different, comparison.pixels_different), (0, 0));
            assert_eq!(comparison.t_unexplained, usize::from(off) * width * height);
        }
    }
}

#[test]
fn table_and_json() {
    let right = answers(&scene(), 0.0);
    let report = judge(&truth(), &[(Kernel::X1, right.view()), (Kernel::X4, right.view())]);
    let text = report.to_string();
    let lines: Vec<&str> = text.lines().collect();
    assert_eq!(lines.len(), 4, "{text}");
    assert!(lines[0].starts_with("scene") && lines[1].contains("x1") && lines[2].contains("x4"), "{text}");
    assert!(lines.iter().take(3).all(|line| line.len() == lines[0].len()), "{text}");
    assert_eq!(lines[3], "PASS test");
    assert_eq!(table(&[report.clone(), report.clone()]).lines().count(), 7);
    let json = serde_json::to_value(&report).unwrap();
    assert_eq!(json["scene"], "test");
    assert_eq!(json["size"], serde_json::json!([63, 41]));
    assert_eq!(json["kernels"][1]["kernel"], "x4");
    assert_eq!(json["kernels"][1]["pixels_unexplained"], 0);
    assert_eq!(json["pass"], true);
}

#[test]
fn display_curve() {
    let shown = |c: f64| displayed(DVec3::splat(c)).x;
    assert_eq!((shown(-1.0), shown(0.0), shown(1e9)), (0.0, 0.0, 1.0 * shown(1.0)));
    assert!((shown(1.0) - 1.0).abs() < 1e-12 && (shown(0.214_041_14) - 0.5).abs() < 1e-6);
    assert!((shown(0.003_130_8) - shown(0.003_130_9)).abs() < 1e-5, "no jump between the pieces");
    assert!(shown(f64::NAN).is_nan() && shown(f64::NEG_INFINITY).is_nan());
    // Infinite light against light that no f32 holds, and against what is only bright.
    let same = |a: f64, b: f64| !truth::differing(DVec3::splat(shown(a)), DVec3::splat(shown(b))).any();
    assert!(same(f64::INFINITY, 4e38) && same(f64::INFINITY, 1e33) && same(1e30, 1.000_001e30) && same(1.0, 1e27));
    assert!(!same(f64::INFINITY, 1e27) && !same(f64::INFINITY, 1.0) && !same(f64::NAN, 4e38));
}

/// A ray down the hole of a horn torus is thrown across its axis, onto the wall opposite: this was lost where the ray meets the
/// axis itself, as on the diagonals of the picture. And light that no `f32` holds.
#[test]
fn along_the_axis_of_a_horn_and_beyond_f32() {
    let horn = "camera = { eye = [0, 0, 4], look_at = [0, 0, 0], fov = 40 }
        settings.ambient = [0.3, 0.3, 0.3]
        sky.color = [0.1, 0.1, 0.5]
        light = [{ position = [3, 5, 4], power = [900, 900, 900] }]
        materials.m = { color = [0.8, 0.6, 0.4], reflectance = 0.2 }
        torus = [{ center = [0, 0, 0], axis = [0, 0, 1], major_radius = 1, minor_radius = 1, material = \"m\" }]";
    let bright = "camera = { eye = [0, 1, 4], look_at = [0, 0.5, 0], fov = 40 }
        settings = { max_depth = 6, attenuation = false }
        sky.color = [0.1, 0.1, 0.1]
        light = [{ position = [1, 3, 2], power = [3e38, 3e38, 3e38] }]
        materials.m = { color = [0, 0.5, 2], specular = 0.5, reflectance = 0.5 }
        sphere = [{ center = [0, 0.5, 0], radius = 0.5, material = \"m\" }]
        plane = [{ normal = [0, 1, 0], distance = 0, material = \"m\" }]";
    for (name, text) in [("horn.toml", horn), ("bright.toml", bright)] {
        let report = verify(&scene::parse(text, name.as_ref()).expect("a sound scene"), &Kernel::ALL, 128, 64);
        assert!(report.pass, "{report}");
    }
}
