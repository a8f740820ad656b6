//! Transparent bodies: energy, absorption, bodies in bodies, bodies that touch, and eyes inside them.

use glam::{Vec3, vec3};
use raypacket::measure::verify::verify;
use raypacket::render::Kernel;
use raypacket::scene::{Description, Material, Pigment, Sky};
use raypacket::shade::{Segment, SegmentKind, path};

use crate::common::{compiled, empty, film_bits, light, picture, plane, sphere};

fn glass(ior: f32, absorption: Vec3) -> Material {
    Material { name: format!("glass {ior}"), transmission: 1.0, ior, absorption, ..Material::default() }
}

/// A scene under a uniform sky of 1, seen from (0, 0, 5).
fn furnace(materials: Vec<Material>) -> Description {
    let mut scene = empty();
    scene.camera.eye = vec3(0.0, 0.0, 5.0);
    scene.camera.look_at = Vec3::ZERO;
    scene.camera.fov = 30.0;
    scene.materials = materials;
    scene.sky = Sky::Color(Vec3::ONE);
    scene.settings.max_depth = 40;
    scene
}

/// Whatever way light takes through clear glass, none is lost and none is won.
#[test]
fn clear_glass_in_a_furnace_is_invisible() {
    let range = |scene: &Description| {
        let channels = picture(scene, Kernel::X8, 64, 64).pixels.concat();
        let mean = channels.iter().sum::<f32>() / channels.len() as f32;
        let (low, high) = channels.iter().fold((2.0f32, 0.0f32), |(l, h), &c| (l.min(c), h.max(c)));
        (low, mean, high)
    };
    for ior in [1.0, 1.05, 1.5, 2.4, 0.7] {
        let mut scene = furnace(vec![glass(ior, Vec3::ZERO), glass(1.33, Vec3::ZERO)]);
        scene.spheres = vec![sphere(Vec3::ZERO, 1.0)];
        let (low, _, high) = range(&scene);
        // What is lost is what ends below the least weight, at most some ten branches of 2⁻¹⁴.
        assert!(low > 0.999 && high < 1.00001, "ior {ior}: from {low} to {high}");
        scene.spheres.extend([sphere(vec3(0.4, 0.2, 0.3), 0.4), sphere(vec3(0.9, 0.0, 0.5), 0.5)]);
        scene.spheres[1].material = 1;
        // Here some rays are caught by total reflection until they end at the depth: two in a hundred at 2.4.
        let (_, mean, high) = range(&scene);
        assert!(mean > 0.95 && high < 1.00001, "ior {ior}: mean {mean}, up to {high}");
    }
}

/// Straight through the middle of a ball: (1 − F)² of e^(−σ 2 r), and what was reflected inside F^2k more of it.
#[test]
fn absorption_is_beer_and_lamberts() {
    let absorption = vec3(0.0, 0.5, 3.0);
    let mut scene = furnace(vec![glass(1.5, absorption)]);
    scene.spheres = vec![sphere(Vec3::ZERO, 1.0)];
    // Behind it a light wall, before it black.
    scene.sky = Sky::Color(Vec3::ZERO);
    scene.settings.ambient = Vec3::ONE;
    scene.materials.push(Material { pigment: Pigment::Color(Vec3::ONE), ..Material::default() });
    scene.planes = vec![plane(Vec3::Z, 10.0)];
    scene.planes[0].material = 1;
    let film = picture(&scene, Kernel::X8, 65, 65);
    let f = 0.04f64;
    for (axis, &seen) in film.pixels[65 * 32 + 32].iter().enumerate() {
        let through = (-2.0 * f64::from(absorption[axis])).exp();
        let expected = (1.0 - f).powi(2) * through / (1.0 - (f * through).powi(2));
        assert!((f64::from(seen) - expected).abs() < 1e-5, "{axis}: {seen} for {expected}");
    }
}

/// A ball that is left is left for what is around it: water in glass in air.
#[test]
fn bodies_in_bodies() {
    let mut scene = furnace(vec![glass(1.5, Vec3::ZERO), glass(1.33, Vec3::ZERO)]);
    scene.spheres = vec![sphere(Vec3::ZERO, 1.0), sphere(Vec3::ZERO, 0.8)];
    scene.spheres[1].material = 1;
    // Head-on all boundaries reflect by their own step: air to glass, glass to water.
    let segments = path(&compiled(&scene), scene.camera.eye, Vec3::NEG_Z);
    let straight = segments.iter().filter(|s| s.kind == SegmentKind::Refraction && s.direction.z < -0.99);
    assert!(straight.count() >= 4);
    // Aside, the angle in the water is that of a ray from air straight into water: Snell's sines only know the ends.
    let direction = vec3(0.15, 0.0, -1.0).normalize();
    let segments = path(&compiled(&scene), scene.camera.eye, direction);
    let from = |at: Vec3| {
        let starts = |s: &&Segment| s.kind == SegmentKind::Refraction && s.from.distance(at) < 1e-4;
        segments.iter().find(starts).expect("the ray goes in")
    };
    let first = from(segments[0].to.expect("a hit"));
    let second = from(first.to.expect("a hit"));
    let sine = |at: Vec3, d: Vec3| at.normalize().cross(d).length();
    let n = [first.from.normalize(), second.from.normalize()];
    assert!((sine(n[0], direction) - 1.5 * sine(n[0], first.direction)).abs() < 1e-5);
    let (before, after) = (1.5 * sine(n[1], first.direction), 1.33 * sine(n[1], second.direction));
    assert!((before - after).abs() < 1e-5, "{before} {after}");
}

/// Two balls of the same glass that share some space are one body: no surface shows where they overlap.
#[test]
fn overlapping_bodies_of_one_glass_are_one() {
    let mut scene = furnace(vec![glass(1.5, vec3(0.3, 0.3, 0.3))]);
    scene.spheres = vec![sphere(vec3(0.0, 0.0, 0.5), 1.0), sphere(vec3(0.0, 0.0, -0.5), 1.0)];
    let segments = path(&compiled(&scene), scene.camera.eye, vec3(0.02, 0.01, -1.0).normalize());
    let mirrored = segments.iter().filter(|s| s.kind == SegmentKind::Reflection && s.from.z.abs() < 0.9);
    assert_eq!(mirrored.count(), 0, "nothing is reflected within");
    assert!(verify(&scene, &Kernel::ALL, 64, 64).pass);
}

/// Without one, the walls of a bubble in water would refract the wrong way.
#[test]
fn the_eye_may_be_in_a_body() {
    for depth in 1..=3 {
        let mut scene = furnace(vec![glass(1.33, vec3(0.1, 0.2, 0.05)), glass(1.0, Vec3::ZERO), Material::default()]);
        scene.lights = vec![light(vec3(3.0, 5.0, 4.0))];
        // The eye is in the water; then also in a bubble in it; then in a drop in that.
        scene.spheres =
            vec![sphere(vec3(0.0, 0.0, 3.0), 20.0), sphere(vec3(0.0, 0.0, 4.0), 3.0), sphere(vec3(0.0, 0.0, 5.0), 1.0)];
        scene.spheres.truncate(depth);
        if depth > 1 {
            scene.spheres[1].material = 1;
        }
        scene.spheres.push(sphere(vec3(0.5, 0.2, -1.0), 0.7));
        scene.spheres.last_mut().unwrap().material = 2;
        let report = verify(&scene, &Kernel::ALL, 64, 64);
        assert!(report.pass, "{depth}: {report:?}");
        let film = picture(&scene, Kernel::X8, 32, 32);
        // In water of 1.33 that ends far away, everything is dimmed.
        let [r, g, _] = film.pixels[16 * 32 + 2];
        assert!(depth > 1 || g < r && r < 0.5, "{r} {g}");
    }
}

/// At the critical angle, at shells as thin as a hair, and where balls touch.
#[test]
fn hard_glass_agrees_with_the_reference() {
    let mut scene = furnace(vec![glass(1.5, vec3(0.2, 0.1, 0.0)), glass(1.0, Vec3::ZERO), Material::default()]);
    scene.sky = Sky::Gradient { below: vec3(0.6, 0.5, 0.4), above: vec3(0.2, 0.4, 0.9) };
    scene.lights = vec![light(vec3(3.0, 5.0, 4.0))];
    scene.settings.max_depth = 7;
    scene.planes = vec![plane(Vec3::Y, 1.2)];
    scene.planes[0].material = 2;
    scene.spheres = vec![
        sphere(vec3(-0.9, 0.0, 0.0), 0.6),
        sphere(vec3(-0.9, 0.0, 0.0), 0.599),
        sphere(vec3(0.5, 0.0, 0.0), 0.5),
        sphere(vec3(0.5, 0.7, 0.0), 0.2),
    ];
    scene.spheres[1].material = 1;
    let report = verify(&scene, &Kernel::ALL, 96, 96);
    assert!(report.pass, "{report:?}");
}

/// More rays than a wave holds at every depth, and still the same bits at every width.
#[test]
fn many_waves_give_the_same_bits() {
    let mut scene = furnace(vec![glass(2.4, Vec3::ZERO), Material { reflectance: 0.3, ..glass(1.3, Vec3::ZERO) }]);
    scene.materials[1].transmission = 0.7;
    scene.settings.max_depth = 12;
    scene.sky = Sky::Gradient { below: Vec3::ZERO, above: Vec3::ONE };
    for i in 0..12 {
        let angle = i as f32 * 2.4;
        scene.spheres.push(sphere(vec3(angle.cos(), angle.sin(), 0.0) * (0.1 * i as f32), 0.45));
        scene.spheres.last_mut().unwrap().material = i % 2;
    }
    let [first, others @ ..] = Kernel::ALL.map(|kernel| film_bits(&picture(&scene, kernel, 48, 48)));
    assert!(others.iter().all(|bits| *bits == first));
}
