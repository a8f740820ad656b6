//! Mirrors: none followed, many followed, and colours that stay colours.

use glam::{Vec3, vec3};
use raypacket::render::{Camera, Film, Kernel, render};
use raypacket::scene::{CameraDescription, Description, Material, Sky};

use crate::common::{all_builtins, compiled, empty, film_bits, light, picture, plane, sphere, white};

#[test]
fn every_colour_is_finite_and_not_negative() {
    for scene in all_builtins() {
        for kernel in Kernel::ALL {
            let film = picture(&scene, kernel, 101, 67);
            let sound = |c: &f32| c.is_finite() && *c >= 0.0;
            assert!(film.pixels.as_flattened().iter().all(sound), "{} {}", scene.name, kernel.name());
        }
    }
}

/// At depth 1 a half mirror shows half of its own shading, to the bit, and fires no ray.
#[test]
fn depth_one_does_not_look_into_mirrors() {
    for scene in all_builtins() {
        let with = |reflectance: f32| {
            let mut scene = scene.clone();
            scene.settings.max_depth = 1;
            scene.sky = Sky::Color(Vec3::ZERO);
            scene.materials.iter_mut().for_each(|m| (m.reflectance, m.transmission) = (reflectance, 0.0));
            scene
        };
        for kernel in Kernel::ALL {
            let matt = picture(&with(0.0), kernel, 50, 40);
            let mut half = picture(&with(0.5), kernel, 50, 40);
            half.pixels.as_flattened_mut().iter_mut().for_each(|c| *c *= 2.0);
            assert_eq!(film_bits(&half), film_bits(&matt), "{} {}", scene.name, kernel.name());
            let black = picture(&with(1.0), kernel, 50, 40);
            assert!(black.pixels.as_flattened().iter().all(|c| *c == 0.0), "{}", scene.name);
        }
        let camera = Camera::new(&scene.camera, 1.0);
        let counts = render(&compiled(&with(0.5)), &camera, Kernel::X8, 1, &mut Film::new(20, 20), &|_| ());
        assert_eq!((counts.primary, counts.reflection), (400, 0));
    }
}

/// A ball between two perfect mirrors.
fn between_mirrors(material: Material, depth: u32) -> Description {
    let mut scene = empty();
    scene.materials = vec![material, white(0.0)];
    scene.settings.max_depth = depth;
    scene.settings.ambient = vec3(0.5, 0.25, 1.0);
    scene.sky = Sky::Color(vec3(0.25, 1.0, 0.5));
    scene.planes = vec![plane(Vec3::Z, 3.0), plane(Vec3::NEG_Z, 3.0)];
    scene.spheres.push(sphere(vec3(0.7, 0.2, -1.0), 0.5));
    scene.spheres[0].material = 1;
    scene.lights.push(light(vec3(1.0, 2.0, 2.0)));
    scene.camera =
        CameraDescription { eye: vec3(0.3, 0.1, 2.0), look_at: vec3(0.2, 0.1, -3.0), up: Vec3::Y, fov: 50.0 };
    scene
}

#[test]
fn facing_mirrors_to_the_greatest_depth() {
    for depth in [2, 7, 64] {
        let scene = between_mirrors(white(1.0), depth);
        let camera = Camera::new(&scene.camera, 40.0 / 30.0);
        let mut films = Vec::new();
        for kernel in Kernel::ALL {
            let mut film = Film::new(40, 30);
            let counts = render(&compiled(&scene), &camera, kernel, 1, &mut film, &|_| ());
            let all = u64::from(depth - 1) * counts.primary;
            // Only the ball ends a path early, and it is seen in less than half of the picture at any depth.
            assert!(counts.reflection <= all && counts.reflection > all / 4, "{counts:?}");
            films.push(film);
        }
        assert!(films.iter().all(|f| film_bits(f) == film_bits(&films[0])));
        // A perfect mirror shows the ball, lit with at most ambient and light, or nothing, as no path leaves.
        let most = Vec3::ONE + scene.settings.ambient;
        for pixel in films[0].pixels.iter().map(|p| Vec3::from_array(*p)) {
            assert!(pixel.is_finite() && pixel.cmpge(Vec3::ZERO).all() && pixel.cmple(most).all(), "{pixel}");
        }
        assert!(films[0].pixels.contains(&[0.0; 3]), "a path that ends in a mirror brings nothing");
    }
}

/// Nothing but ambient light: a half mirror sums (1 − ρ) Σ ρ^k a, to the deepest mirror.
#[test]
fn mirrored_light_sums_up() {
    for depth in [1, 2, 5, 64] {
        let mut scene = between_mirrors(white(0.5), depth);
        scene.lights.clear();
        scene.spheres.clear();
        let film = picture(&scene, Kernel::X4, 40, 30);
        let share = 1.0 - 0.5_f32.powi(depth as i32);
        let expected = scene.settings.ambient * share;
        for pixel in film.pixels {
            // Every term is a power of two times another, and every sum of at most 24 of them exact.
            assert!((Vec3::from_array(pixel) - expected).abs().max_element() <= f32::EPSILON, "{pixel:?} {depth}");
        }
    }
}
