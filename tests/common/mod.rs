//! What several test programs share: random numbers that are the same everywhere, and small scenes.
#![allow(dead_code, unused_imports, reason = "every test program compiles this, and none uses all of it")]

use glam::Vec3;
pub use raypacket::measure::random::Pcg;
use raypacket::render::{Camera, Film, Kernel, render};
use raypacket::scene::{
    Description, Light, Material, Mesh, Pigment, Plane, Scene, Sides, Sphere, builtins, compile, load,
};

/// ε: half the distance from 1 to the next `f32`.
pub const ROUNDOFF: f64 = 1.0 / (1u64 << 24) as f64;

/// A matt or mirroring white material.
pub fn white(reflectance: f32) -> Material {
    Material {
        name: format!("white {reflectance}"),
        pigment: Pigment::Color(Vec3::ONE),
        reflectance,
        shininess: 1.0,
        ..Material::default()
    }
}

/// A scene without anything: a black sky, one matt white material, light that does not fall off.
pub fn empty() -> Description {
    let mut scene = Description { name: "test".into(), materials: vec![white(0.0)], ..Description::default() };
    scene.settings.attenuation = false;
    scene
}

pub fn sphere(center: Vec3, radius: f32) -> Sphere {
    Sphere { center, radius, sides: Sides::Both, material: 0 }
}

pub fn plane(normal: Vec3, distance: f32) -> Plane {
    Plane { normal, distance, material: 0 }
}

/// Triangles that share no vertex.
pub fn mesh(corners: &[[Vec3; 3]]) -> Mesh {
    let triangles = (0..corners.len() as u32).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect();
    Mesh { positions: corners.as_flattened().to_vec(), triangles, ..Mesh::default() }
}

/// The size of a test that is ignored by default: in full, or the part that `RAYPACKET_PART` says, so that `.ci/run` can run
/// it in little.
pub fn part_of(full: usize) -> usize {
    let part = std::env::var("RAYPACKET_PART").ok().map(|part| part.parse::<f64>().expect("RAYPACKET_PART: a number"));
    (full as f64 * part.unwrap_or(1.0)) as usize
}

/// A scene as light meets it: with all its surfaces there from both sides. `None` where they are anyway.
pub fn lit(description: &Description) -> Option<Description> {
    let mut scene = description.clone();
    scene.spheres.iter_mut().for_each(|it| it.sides = Sides::Both);
    scene.meshes.iter_mut().for_each(|it| it.sides = Sides::Both);
    scene.cylinders.iter_mut().for_each(|it| it.sides = Sides::Both);
    scene.cones.iter_mut().for_each(|it| it.sides = Sides::Both);
    (scene != *description).then_some(scene)
}

/// A light of power 1 in every channel.
pub fn light(position: Vec3) -> Light {
    Light { position, power: Vec3::ONE }
}

/// The descriptions of all built-in scenes.
pub fn all_builtins() -> Vec<Description> {
    builtins().iter().map(|b| load(b.name).expect("a built-in scene")).collect()
}

pub fn compiled(description: &Description) -> Scene {
    compile(description).expect("a sound scene")
}

/// One sample a pixel.
pub fn picture(description: &Description, kernel: Kernel, width: usize, height: usize) -> Film {
    let camera = Camera::new(&description.camera, width as f32 / height as f32);
    let mut film = Film::new(width, height);
    render(&compiled(description), &camera, kernel, 1, &mut film, &|_| ());
    film
}

/// A film to the bit, so that NaN equals itself and −0 is not 0.
pub fn film_bits(film: &Film) -> Vec<u32> {
    film.pixels.as_flattened().iter().map(|c| c.to_bits()).collect()
}
