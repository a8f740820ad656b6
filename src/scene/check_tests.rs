use glam::Vec3;

use super::*;
use crate::scene::{CameraDescription, Light, Mesh, Plane, Settings, Sides, Sky, Sphere};

fn sound() -> Description {
    let material = Material { name: "grey".into(), pigment: Pigment::Color(Vec3::ONE), ..Material::default() };
    Description {
        name: "test".into(),
        camera: CameraDescription::default(),
        settings: Settings::default(),
        sky: Sky::default(),
        lights: vec![Light { position: Vec3::ONE, power: Vec3::ONE }],
        materials: vec![material.clone(), Material { name: "two words".into(), ..material }],
        planes: vec![Plane { normal: Vec3::Y, distance: 0.0, material: 0 }],
        spheres: vec![Sphere { center: Vec3::ZERO, radius: 1.0, sides: Sides::Both, material: 1 }],
        meshes: vec![Mesh {
            positions: vec![Vec3::ZERO, Vec3::X, Vec3::Y],
            triangles: vec![[0, 1, 2]],
            ..Mesh::default()
        }],
        ..Description::default()
    }
}

fn verdict(spoil: impl FnOnce(&mut Description)) -> String {
    let mut description = sound();
    spoil(&mut description);
    check(&description).expect_err("the fault must be found").to_string()
}

#[test]
fn a_sound_description_passes() {
    assert_eq!(check(&sound()), Ok(()));
    assert_eq!(check(&Description::default()), Ok(()), "an empty scene is sound");
}

#[test]
fn the_camera_is_checked() {
    assert_eq!(verdict(|d| d.camera.eye.x = f32::NAN), "camera.eye: must be finite and within ±1e18, got [NaN, 1, 5]");
    assert_eq!(verdict(|d| d.camera.look_at = d.camera.eye), "camera.look_at: must differ from camera.eye");
    assert_eq!(verdict(|d| d.camera.up = Vec3::ZERO), "camera.up: must not be zero");
    for fov in [0.0, 180.0, -3.0, f32::NAN, f32::INFINITY] {
        let expected = format!("camera.fov: must be at least 0.01 and below 180, got {fov}");
        assert_eq!(verdict(|d| d.camera.fov = fov), expected);
    }
}

#[test]
fn settings_sky_and_lights_are_checked() {
    assert_eq!(verdict(|d| d.settings.max_depth = 0), "settings.max_depth: must be 1 to 64, got 0");
    assert_eq!(verdict(|d| d.settings.max_depth = 65), "settings.max_depth: must be 1 to 64, got 65");
    assert_eq!(
        verdict(|d| d.settings.ambient.z = -1.0),
        "settings.ambient: must be finite and 0 or more, got [0, 0, -1]"
    );
    assert_eq!(
        verdict(|d| d.sky = Sky::Color(Vec3::X * f32::INFINITY)),
        "sky.color: must be finite and 0 or more, got [inf, NaN, NaN]"
    );
    assert_eq!(verdict(|d| d.lights[0].power.y = -2.0), "light[0].power: must be finite and 0 or more, got [1, -2, 1]");
    assert_eq!(
        verdict(|d| d.lights[0].position.y = -2e18),
        "light[0].position: must be finite and within ±1e18, got [1, -2000000000000000000, 1]"
    );
}

/// Beyond them a product of them would be infinite.
#[test]
fn colours_have_a_greatest() {
    assert_eq!(
        verdict(|d| d.settings.ambient.x = 1e30),
        format!("settings.ambient: must be at most 1e9, got [{}, 0, 0]", 1e30f32)
    );
    assert_eq!(
        verdict(|d| d.sky = Sky::Color(Vec3::Y * 2e9)),
        "sky.color: must be at most 1e9, got [0, 2000000000, 0]"
    );
    assert_eq!(
        verdict(|d| d.materials[0].pigment = Pigment::Color(Vec3::Y * 2e9)),
        "materials.grey.color: must be at most 1e9, got [0, 2000000000, 0]"
    );
    assert_eq!(
        verdict(|d| d.materials[0].specular = 2e9),
        "materials.grey.specular: must be at most 1e9, got 2000000000"
    );
    let dome = |texel| Dome { width: 1, height: 1, texels: vec![[0.0, texel, 0.0]], rotation: 0.0 };
    assert_eq!(
        verdict(|d| d.sky = Sky::Dome(dome(1e10).into())),
        "sky.image: a texel is below 0, above 1e9 or not a number"
    );
    let mut greatest = sound();
    greatest.lights = vec![Light { position: Vec3::ONE, power: Vec3::splat(1e27) }; 100];
    greatest.settings.attenuation = false;
    greatest.settings.ambient = Vec3::splat(1e9);
    greatest.sky = Sky::Dome(dome(1e9).into());
    greatest.materials[0].pigment = Pigment::Color(Vec3::splat(1e9));
    greatest.materials[0].specular = 1e9;
    assert_eq!(check(&greatest), Ok(()));
    let light: f32 = greatest.lights.iter().map(|light| 2.0 * light.power.x * 1e9).sum();
    assert!(light.is_finite());
}

#[test]
fn materials_are_checked() {
    assert_eq!(verdict(|d| d.materials[0].reflectance = 1.5), "materials.grey.reflectance: must be 0 to 1, got 1.5");
    assert_eq!(
        verdict(|d| d.materials[1].specular = -0.5),
        "materials.\"two words\".specular: must be finite and 0 or more, got -0.5"
    );
    assert_eq!(
        verdict(|d| d.materials[0].shininess = 0.0),
        "materials.grey.shininess: must be above 0 and at most 1e6, got 0"
    );
    let checker = |colors, size| verdict(|d| d.materials[0].pigment = Pigment::Checker { colors, size });
    assert_eq!(checker([Vec3::ONE; 2], 0.0), "materials.grey.checker.size: must be above 0, got 0");
    assert_eq!(
        checker([Vec3::ONE, -Vec3::ONE], 1.0),
        "materials.grey.checker.colors[1]: must be finite and 0 or more, got [-1, -1, -1]"
    );
}

#[test]
fn primitives_are_checked() {
    assert_eq!(verdict(|d| d.planes[0].normal = Vec3::ZERO), "plane[0].normal: must not be zero");
    assert_eq!(
        verdict(|d| d.planes[0].distance = f32::NAN),
        "plane[0].distance: must be finite and within ±1e18 normal lengths, got NaN"
    );
    assert_eq!(verdict(|d| d.spheres[0].radius = -1.0), "sphere[0].radius: must be above 0, got -1");
    assert_eq!(verdict(|d| d.spheres[0].radius = f32::INFINITY), "sphere[0].radius: must be finite, got inf");
    assert_eq!(verdict(|d| d.spheres[0].radius = 1e30), "sphere[0].radius: must be 1e-12 to 1e18, got 1e30");
    assert_eq!(verdict(|d| d.spheres[0].material = 2), "sphere[0].material: material 2 of 2 does not exist");
    assert_eq!(verdict(|d| d.meshes[0].triangles[0][1] = 3), "mesh[0].triangles[0]: vertex 3 of 3 does not exist");
    assert_eq!(verdict(|d| d.meshes[0].material = 9), "mesh[0].material: material 9 of 2 does not exist");
    assert!(count(MAX_PRIMITIVES).is_ok());
    assert_eq!(count(MAX_PRIMITIVES + 1).unwrap_err(), "at most 4294967294 fit, got 4294967295");
}
