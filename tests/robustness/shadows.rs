//! One-sided surfaces and light: a shadow is the same whichever way its ray runs, and so wherever its light is.

use glam::{Vec3, vec3};
use raypacket::measure::verify::{verify, verify_with};
use raypacket::reference::Tracer;
use raypacket::render::Kernel;
use raypacket::scene::{
    CompileOptions, Cone, Cylinder, Description, Mesh, ShadowStart, Sides, Sphere, Structure, compile_with, load,
};
use raypacket::shade::{SegmentKind, path};
use raypacket::trace::Probe;

use crate::common::{Pcg, empty, light, lit, mesh, picture, plane, sphere};

const ALL_SIDES: [Sides; 3] = [Sides::Both, Sides::Front, Sides::Back];

/// Where the near light is.
const LIGHT: Vec3 = Vec3::new(0.25, 4.0, 0.5);

/// A floor at y = −1 with one thing over it that has sides, and their names.
fn scenes() -> Vec<(String, Description)> {
    let mut scenes = Vec::new();
    for sides in ALL_SIDES {
        let mut add = |name: &str, thing: &dyn Fn(&mut Description)| {
            let mut scene = empty();
            scene.camera.eye = vec3(0.5, 3.0, 6.0);
            scene.settings.ambient = Vec3::splat(0.25);
            scene.planes.push(plane(Vec3::Y, 1.0));
            scene.lights.push(light(LIGHT));
            thing(&mut scene);
            scenes.push((format!("{name}, {sides:?}"), scene));
        };
        add("a sheet that faces up", &|scene| scene.meshes.push(sheet(sides, false)));
        add("a sheet that faces down", &|scene| scene.meshes.push(sheet(sides, true)));
        add("a sphere", &|scene| scene.spheres.push(Sphere { sides, ..sphere(Vec3::Y * 0.25, 0.75) }));
        for caps in [false, true] {
            let (base, apex, material) = (vec3(0.1, -0.5, 0.0), vec3(-0.2, 1.0, 0.3), 0);
            add(&format!("a cylinder, caps: {caps}"), &|scene| {
                scene.cylinders.push(Cylinder { base, apex, radius: 0.5, caps, sides, material });
            });
            add(&format!("a cone, caps: {caps}"), &|scene| {
                scene.cones.push(Cone { base, base_radius: 0.7, apex, apex_radius: 0.3, caps, sides, material });
            });
        }
    }
    scenes
}

/// A square at y = 1/2.
fn sheet(sides: Sides, down: bool) -> Mesh {
    let [a, b, c, d] = [(-1.0, -1.0), (-1.0, 1.0), (1.0, 1.0), (1.0, -1.0)].map(|(x, z)| vec3(x, 0.5, z));
    let corners = if down { [[a, c, b], [a, d, c]] } else { [[a, b, c], [a, c, d]] };
    Mesh { sides, ..mesh(&corners) }
}

/// Whether the light of a scene is hidden from a point of the floor, by the paths that are drawn.
fn hidden(scene: &Description, structure: Structure, start: ShadowStart, point: Vec3) -> bool {
    let compiled = compile_with(scene, &structure.into()).expect("a sound scene");
    assert_eq!(compiled.plan.shadows, [start]);
    let segments = path(&compiled, point + Vec3::Y * 0.01, Vec3::NEG_Y);
    let shadow = segments.iter().find_map(|s| match s.kind {
        SegmentKind::Shadow { blocked } => Some(blocked),
        _ => None,
    });
    shadow.expect("the floor faces the light")
}

/// A light that moves away on the line from a point hides from it as long as it is behind the thing: shadow rays from near
/// lights start there, those from far ones at the point. Single rays either way agree, and so does the reference, which
/// asks a scene that is seen from both sides.
#[test]
fn a_light_that_moves_away_changes_nothing() {
    for (name, scene) in scenes() {
        let whole = Tracer::new(&lit(&scene).unwrap_or_else(|| scene.clone()));
        let own = Tracer::new(&scene);
        let (mut rng, mut probe, mut dark) = (Pcg::new(3), Probe::default(), 0);
        for i in 0..150 {
            let point = vec3(rng.range(-1.6, 1.6), -1.0, rng.range(-1.6, 1.6));
            let (direction, distance) = (LIGHT - point).normalize_and_length();
            let mut far = scene.clone();
            far.lights[0].position = point + direction * 1e5;
            let (o, d) = (point.as_dvec3() + 1e-6 * glam::DVec3::Y, direction.as_dvec3());
            let truth = whole.intersect(o, d, f64::from(distance)).is_some();
            dark += usize::from(truth);
            assert_eq!(own.blocked(o, d, f64::from(distance)), truth, "{name}: the reference, {point}");
            let structure = [Structure::None, Structure::Tree][i % 2];
            assert_eq!(hidden(&scene, structure, ShadowStart::Light, point), truth, "{name}: near, {point}");
            assert_eq!(hidden(&far, structure, ShadowStart::Point, point), truth, "{name}: far, {point}");
            let compiled = compile_with(&scene, &structure.into()).expect("a sound scene");
            let above = point + Vec3::Y * 1e-4;
            let (direction, distance) = (LIGHT - above).normalize_and_length();
            assert_eq!(probe.occluded(&compiled, above, direction, distance), truth, "{name}: up, {point}");
            assert_eq!(probe.occluded(&compiled, LIGHT, -direction, distance), truth, "{name}: down, {point}");
        }
        assert!((20..140).contains(&dark), "{name}: {dark} are dark");
    }
}

/// Whole pictures by every kernel against the reference, with lists and a tree, the light near and far.
#[test]
fn pictures_are_those_of_the_reference() {
    for (name, scene) in scenes() {
        for distance in [1.0, 1e5] {
            let mut scene = scene.clone();
            scene.lights[0].position = LIGHT * distance;
            for structure in [Structure::None, Structure::Tree] {
                let options = CompileOptions::from(structure);
                let report = verify_with(&scene, &options, &Kernel::ALL, 64, 48);
                assert!(report.pass, "{name}, the light at {distance}, {structure:?}: {report}");
            }
        }
    }
}

fn nff(name: &str) -> Description {
    load(&format!("{}/tests/robustness/{name}.nff", env!("CARGO_MANIFEST_DIR"))).expect("a sound scene")
}

#[test]
fn files_of_open_surfaces() {
    for name in ["sheet", "tube"] {
        let report = verify(&nff(name), &Kernel::ALL, 64, 64);
        assert!(report.pass, "{report}");
    }
}

/// The shadow of a square at y = 1/2 on the floor at y = −1, by hand: the light at (0, 4, 1/2) throws a point of the sheet
/// 5 / 3.5 times as far from the point below it. Ambient light and light are 1/2.
#[test]
fn the_shadow_of_a_sheet() {
    let scene = nff("sheet");
    let film = picture(&scene, Kernel::X8, 64, 64);
    let camera = raypacket::render::Camera::new(&scene.camera, 1.0);
    let (mut dark, mut bright) = (0, 0);
    for (i, pixel) in film.pixels.iter().enumerate() {
        let direction = camera.direction(((i % 64) as f32 + 0.5) / 64.0, ((i / 64) as f32 + 0.5) / 64.0);
        let at = |y: f32| camera.eye + direction * ((y - camera.eye.y) / direction.y);
        let (on_sheet, on_floor) = (at(0.5), at(-1.0));
        let past_sheet = on_sheet.x.abs().max(on_sheet.z.abs()) > 1.02;
        if direction.y >= 0.0 || !past_sheet || on_floor.x.abs().max(on_floor.z.abs()) > 4.9 {
            continue;
        }
        // How far outside of the shadow.
        let [x, z] = [on_floor.x, on_floor.z - 0.5].map(|from_light| from_light * 3.5 / 5.0);
        let outside = x.abs().max((z + 0.5).abs()) - 1.0;
        let to_light = vec3(0.0, 4.0, 0.5) - on_floor;
        if outside < -0.02 {
            assert_eq!(*pixel, [0.5; 3], "{on_floor}");
            dark += 1;
        } else if outside > 0.02 {
            let value = 0.5 + 0.5 * to_light.y / to_light.length();
            assert!(pixel.iter().all(|c| (c - value).abs() < 1e-5), "{on_floor}: {pixel:?}, not {value}");
            bright += 1;
        }
    }
    assert!(dark > 200 && bright > 500, "{dark} {bright}");
}
