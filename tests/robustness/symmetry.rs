//! What must not change a picture: a mirror, a power of two, another place.

mod kinds;

use glam::{Vec3, vec3};
use raypacket::measure::verify::verify;
use raypacket::render::{Camera, Film, Kernel, primary_hits, render};
use raypacket::scene::{Description, Pigment, load};

use crate::common::{Pcg, all_builtins, compiled, empty, film_bits, mesh, picture, sphere};

const SIZE: [usize; 2] = [70, 45];

/// A scene with all its points mapped by `point` and its lengths multiplied by `scale`.
fn mapped(description: &Description, point: impl Fn(Vec3) -> Vec3, scale: f32) -> Description {
    let mut scene = description.clone();
    scene.camera.eye = point(scene.camera.eye);
    scene.camera.look_at = point(scene.camera.look_at);
    scene.lights.iter_mut().for_each(|l| l.position = point(l.position));
    scene.spheres.iter_mut().for_each(|s| (s.center, s.radius) = (point(s.center), s.radius * scale));
    scene.meshes.iter_mut().flat_map(|m| &mut m.positions).for_each(|p| *p = point(*p));
    scene
}

/// The built-in scenes of planes and spheres, and one with triangles.
fn scenes() -> Vec<Description> {
    let mut scenes = all_builtins();
    scenes.retain(|s| s.primitives() == s.planes.len() + s.spheres.len());
    let mut rng = Pcg::new(21);
    let mut soup = load("classic").expect("a built-in scene");
    soup.spheres.clear();
    let corners: Vec<_> = (0..40)
        .map(|_| {
            let a = rng.cube() * 2.0 + Vec3::Y;
            [a, a + rng.cube(), a + rng.cube()]
        })
        .collect();
    soup.meshes.push(mesh(&corners));
    soup.name = "triangles".into();
    scenes.push(soup);
    scenes
}

/// A camera's mirror image; `flip` is −1 for the axes whose sign changes.
fn image(camera: &Camera, flip: Vec3) -> Camera {
    let wide = flip.as_dvec3();
    let Camera { eye, corner, across, down } = *camera;
    Camera { eye: eye * flip, corner: corner * wide, across: across * wide, down: down * wide }
}

/// Every operation is the same for −x as for x, so the mirrored picture is the same to the bit.
#[test]
fn mirrored_from_x_to_minus_x() {
    let mirror = |v: Vec3| vec3(-v.x, v.y, v.z);
    for mut scene in scenes() {
        // ⌊−x⌋ is not −⌊x⌋: a checkerboard has no such symmetry.
        scene.materials.iter_mut().for_each(|m| m.pigment = Pigment::Color(vec3(0.8, 0.6, 0.4)));
        let mut mirrored = mapped(&scene, mirror, 1.0);
        mirrored.planes.iter_mut().for_each(|p| p.normal = mirror(p.normal));
        let camera = Camera::new(&scene.camera, SIZE[0] as f32 / SIZE[1] as f32);
        let image = image(&camera, mirror(Vec3::ONE));
        let [original, mirrored] = [compiled(&scene), compiled(&mirrored)];
        for kernel in Kernel::ALL {
            let a = primary_hits(&original, &camera, kernel, SIZE[0], SIZE[1]);
            let b = primary_hits(&mirrored, &image, kernel, SIZE[0], SIZE[1]);
            assert!(a.primitive == b.primitive && a.t == b.t, "{} {}", scene.name, kernel.name());
            let mut films = [Film::new(SIZE[0], SIZE[1]), Film::new(SIZE[0], SIZE[1])];
            render(&original, &camera, kernel, 1, &mut films[0], &|_| ());
            render(&mirrored, &image, kernel, 1, &mut films[1], &|_| ());
            assert!(film_bits(&films[0]) == film_bits(&films[1]), "{} {}", scene.name, kernel.name());
        }
    }
}

/// Nothing knows how long a unit is: a scene a power of two as large gives the same picture to the bit.
/// A constant that is compared with a length would show.
#[test]
fn a_power_of_two_as_large() {
    for scene in scenes() {
        let film = picture(&scene, Kernel::X8, SIZE[0], SIZE[1]);
        let camera = Camera::new(&scene.camera, SIZE[0] as f32 / SIZE[1] as f32);
        let hits = primary_hits(&compiled(&scene), &camera, Kernel::X8, SIZE[0], SIZE[1]);
        for scale in [2.0_f32.powi(-10), 2.0_f32.powi(7), 2.0_f32.powi(20)] {
            let mut large = mapped(&scene, |p| p * scale, scale);
            large.planes.iter_mut().for_each(|p| p.distance *= scale);
            for material in &mut large.materials {
                if let Pigment::Checker { size, .. } = &mut material.pigment {
                    *size *= scale;
                }
            }
            if large.settings.attenuation {
                large.lights.iter_mut().for_each(|l| l.power *= scale * scale);
            }
            let camera = Camera::new(&large.camera, SIZE[0] as f32 / SIZE[1] as f32);
            let found = primary_hits(&compiled(&large), &camera, Kernel::X8, SIZE[0], SIZE[1]);
            let same = hits.t.iter().map(|t| t * scale).eq(found.t.iter().copied());
            assert!(same && hits.primitive == found.primitive, "{} times {scale}", scene.name);
            let found = picture(&large, Kernel::X8, SIZE[0], SIZE[1]);
            assert!(film_bits(&film) == film_bits(&found), "{} times {scale}", scene.name);
        }
    }
}

/// Far from the origin the numbers are coarser, and the picture is right within the bound that takes that into account.
#[test]
fn moved_away() {
    for name in ["classic", "hall"] {
        let scene = load(name).expect("a built-in scene");
        for by in [vec3(100.0, -30.0, 70.0), vec3(-2000.0, 5000.0, 3000.0)] {
            let mut moved = mapped(&scene, |p| p + by, 1.0);
            moved.planes.iter_mut().for_each(|p| p.distance -= p.normal.dot(by));
            let report = verify(&moved, &Kernel::ALL, 70, 45);
            assert!(report.pass, "{name} by {by}: {report:?}");
        }
    }
}

/// The order of a scene's spheres does not matter but for their ids.
#[test]
fn in_another_order() {
    let mut scene = empty();
    let mut rng = Pcg::new(8);
    scene.spheres = (0..31).map(|_| sphere(rng.cube() * 2.0, rng.range(0.1, 0.6))).collect();
    let mut reversed = scene.clone();
    reversed.spheres.reverse();
    let hits = [&scene, &reversed].map(|scene| {
        let camera = Camera::new(&scene.camera, SIZE[0] as f32 / SIZE[1] as f32);
        primary_hits(&compiled(scene), &camera, Kernel::X8, SIZE[0], SIZE[1])
    });
    assert!(hits[0].t == hits[1].t && hits[0].normal == hits[1].normal);
    assert!(hits[0].t.iter().any(|t| t.is_finite()));
}
