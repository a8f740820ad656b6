//! Lights in awkward places, and pictures of lone things at all scales: lit where they face the light.

use glam::{Vec3, vec3};
use raypacket::reference;
use raypacket::render::{Camera, Film, Kernel, primary_hits};
use raypacket::scene::{CameraDescription, Description, Settings, Sky};
use raypacket::trace::NONE;

use crate::SCALES;
use crate::common::{ROUNDOFF, all_builtins, compiled, empty, light, picture, plane, sphere};

const SIZE: [usize; 2] = [64, 48];

/// A sphere beside the origin, looked at from 4 radii away.
fn lone_sphere(scale: f32) -> Description {
    let mut scene = empty();
    let center = vec3(1.0, 0.5, -2.0) * scale;
    scene.spheres.push(sphere(center, scale));
    scene.camera =
        CameraDescription { eye: center + vec3(1.0, 2.0, 3.0) * scale, look_at: center, up: Vec3::Y, fov: 40.0 };
    scene
}

/// A tilted plane, up to its horizon.
fn lone_plane(scale: f32) -> Description {
    let mut scene = empty();
    scene.planes.push(plane(vec3(0.3, 2.0, -0.2), 0.7 * scale));
    scene.camera = CameraDescription { eye: vec3(0.5, 1.5, 3.0) * scale, look_at: Vec3::ZERO, up: Vec3::Y, fov: 60.0 };
    scene
}

/// n·l by the reference for every pixel, and what the picture of a white scene without anything in the way shows.
fn compare(description: &Description, film: &Film, mut judge: impl FnMut(f64, f32)) {
    let [width, height] = SIZE;
    let camera = reference::Camera::new(&description.camera, width as f64 / height as f64);
    let light = description.lights[0].position.as_dvec3();
    for (i, hit) in reference::hits(description, width, height).iter().enumerate() {
        let Some(hit) = hit else { continue };
        let (x, y) = ((i % width) as f64 + 0.5, (i / width) as f64 + 0.5);
        let (eye, direction) = camera.ray(x / width as f64, y / height as f64);
        let to_light = light - (eye + direction * hit.t);
        judge(hit.normal.dot(to_light.normalize()), film.pixels[i][0]);
    }
}

/// That everything which faces the light is lit, and nothing else.
///
/// Next to an outline, a ray that is off by 16 ε of 10 radii meets a sphere up to √(2 · 160 ε) = 0.0044 radii away,
/// where n·l differs by as much: so n·l counts from 0.01, and then the picture shows at least half of it.
fn lit_where_faced(description: &Description, name: &str) {
    for kernel in Kernel::ALL {
        let film = picture(description, kernel, SIZE[0], SIZE[1]);
        let mut lit = 0;
        compare(description, &film, |cosine, shown| {
            let cosine = cosine as f32;
            let dark = cosine < -0.01 && shown == 0.0;
            let bright = cosine > 0.01 && (0.5 * cosine..1.5 * cosine).contains(&shown);
            lit += usize::from(bright);
            let between = cosine.abs() <= 0.01 && (0.0..0.02).contains(&shown);
            assert!(dark || bright || between, "{name} {}: {shown} for {cosine}", kernel.name());
        });
        assert!(lit > 300, "{name}: {lit} pixels are lit");
    }
}

#[test]
fn lone_things_are_lit_at_every_scale_from_near_and_far() {
    for scale in SCALES {
        for distance in [2.5, 30.0, 1000.0, 1e6] {
            for mut scene in [lone_sphere(scale), lone_plane(scale)] {
                let kind = if scene.planes.is_empty() { "sphere" } else { "plane" };
                scene.lights.push(light(vec3(0.2, 0.8, 0.55) * (distance * scale)));
                lit_where_faced(&scene, &format!("{kind} of {scale}, light at {distance}"));
            }
        }
    }
}

#[test]
fn a_light_at_the_eye_throws_no_shadow() {
    for scale in SCALES {
        for mut scene in [lone_sphere(scale), lone_plane(scale)] {
            scene.lights.push(light(scene.camera.eye));
            lit_where_faced(&scene, &format!("light at the eye, scale {scale}"));
        }
    }
    for scene in all_builtins() {
        seen_is_lit(scene);
    }
}

/// A light at the eye sees what the eye sees.
///
/// But its rays go to where the point is lifted to, by up to 9 ε (radius + coordinate) and 12 ε of the way. Beside a
/// planet's horizon that is more than a pixel, which may then be behind something else: there it proves nothing.
fn seen_is_lit(mut scene: Description) {
    scene.lights = vec![light(scene.camera.eye)];
    scene.settings = Settings { max_depth: 1, attenuation: false, ..Settings::default() };
    scene.sky = Sky::Color(Vec3::ZERO);
    // A normal that is interpolated may face away from an eye that sees the surface.
    scene.meshes.iter_mut().for_each(|mesh| mesh.normals.clear());
    scene.materials.iter_mut().for_each(|m| (m.reflectance, m.transmission) = (0.5 * m.reflectance, 0.0));
    let film = picture(&scene, Kernel::X8, SIZE[0], SIZE[1]);
    let camera = Camera::new(&scene.camera, SIZE[0] as f32 / SIZE[1] as f32);
    let hits = primary_hits(&compiled(&scene), &camera, Kernel::X8, SIZE[0], SIZE[1]);
    let pixel_size = f64::from((scene.camera.fov / 2.0).to_radians().tan()) * 2.0 / SIZE[1] as f64;
    let mut sure = 0;
    for (i, (pixel, &id)) in film.pixels.iter().zip(&hits.primitive).enumerate() {
        let t = f64::from(hits.t[i]);
        let radius = (id as usize).checked_sub(scene.planes.len()).and_then(|i| scene.spheres.get(i));
        let size = radius.map_or(0.0, |s| f64::from(s.radius)) + scene.camera.eye.as_dvec3().length() + t;
        if id != NONE && ROUNDOFF * (9.0 * size + 12.0 * t) < 0.01 * pixel_size * t {
            sure += 1;
            assert!(pixel[0] > 0.0, "{}: pixel {i} of primitive {id} is {pixel:?}", scene.name);
        }
    }
    assert!(sure > 500, "{}: {sure}", scene.name);
}

/// The plane through the light gets nothing of it; a sphere above gets it all, for the plane does not block it.
fn light_on_the_floor(distance: f32, kernel: Kernel) -> [usize; 2] {
    let mut scene = empty();
    scene.planes.push(plane(Vec3::Y, 0.0));
    scene.spheres.push(sphere(vec3(0.0, 1.5, 0.0), 1.0));
    scene.lights.push(light(vec3(0.6, 0.0, 0.8) * distance));
    scene.camera = CameraDescription { eye: vec3(2.0, 1.0, 5.0), look_at: Vec3::Y, up: Vec3::Y, fov: 50.0 };
    let film = picture(&scene, kernel, SIZE[0], SIZE[1]);
    let mut count = [0, 0];
    let floor_is_dark = film.pixels.chunks(SIZE[0]).last().expect("a row").iter().all(|p| *p == [0.0; 3]);
    assert!(floor_is_dark, "light on the floor {distance} away");
    scene.planes.clear();
    compare(&scene, &film, |cosine, shown| {
        count[0] += usize::from(cosine > 0.01);
        count[1] += usize::from(cosine > 0.01 && shown == 0.0);
    });
    count
}

#[test]
fn a_light_on_a_plane() {
    for kernel in Kernel::ALL {
        for distance in [3.0, 100.0, 900.0] {
            let [lit, dark] = light_on_the_floor(distance, kernel);
            assert!(lit > 200 && dark == 0, "{dark} of {lit} are dark, {distance} away");
        }
    }
}

/// So far that shadow rays end at the light.
#[test]
fn a_far_light_on_a_plane() {
    for kernel in Kernel::ALL {
        for distance in [3e3, 1e5] {
            let [lit, dark] = light_on_the_floor(distance, kernel);
            assert!(lit > 200 && dark == 0, "{dark} of {lit} are dark, {distance} away");
        }
    }
}

#[test]
fn a_light_in_a_sphere_stays_there() {
    for (distance, kernel) in [1.5, 50.0, 5000.0].into_iter().flat_map(|d| Kernel::ALL.map(|k| (d, k))) {
        let mut scene = lone_plane(1.0);
        let center = vec3(0.2, 1.0, 0.3) * distance;
        scene.spheres.push(sphere(center, 0.5));
        for offset in [Vec3::ZERO, vec3(0.3, 0.0, 0.39), vec3(0.0, -0.49, 0.0)] {
            scene.lights = vec![light(center + offset)];
            let film = picture(&scene, kernel, SIZE[0], SIZE[1]);
            assert!(film.pixels.iter().all(|p| *p == [0.0; 3]), "{distance} {offset}");
        }
        scene.spheres.clear();
        let film = picture(&scene, kernel, SIZE[0], SIZE[1]);
        assert!(film.pixels.iter().any(|p| p[0] > 0.1), "without the sphere it is bright");
    }
}

#[test]
fn without_lights_there_is_ambient_light_and_sky() {
    for mut scene in all_builtins() {
        scene.lights.clear();
        scene.settings.ambient = vec3(0.5, 0.25, 0.125);
        scene.sky = Sky::Color(vec3(1.0, 2.0, 4.0));
        scene.materials.iter_mut().for_each(|m| {
            (m.reflectance, m.transmission) = (0.0, 0.0);
            m.pigment = raypacket::scene::Pigment::Color(Vec3::ONE);
        });
        for kernel in Kernel::ALL {
            let film = picture(&scene, kernel, SIZE[0], SIZE[1]);
            let [ambient, sky] = [[0.5, 0.25, 0.125], [1.0, 2.0, 4.0]];
            assert!(film.pixels.iter().all(|p| *p == ambient || *p == sky), "{}", scene.name);
            assert!(film.pixels.contains(&ambient), "{}", scene.name);
        }
    }
}
