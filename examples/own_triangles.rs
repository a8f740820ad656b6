//! Triangles and rays in arrays of one's own: how much of the sky a hilly ground sees.
//!
//! `cargo run --release --example own_triangles` traces two million rays and prints what it found.

use std::f32::consts::TAU;
use std::time::Instant;

use raypacket::glam::Vec3;
use raypacket::{Description, Invalid, Material, Mesh, Ray, compile, par_intersect_rays, par_occluded_rays};

/// Cells along each edge of the ground, and rays along each edge of the view from above.
const CELLS: u32 = 400;
const RAYS: usize = 1000;

/// Hills within ±10.
fn height(x: f32, z: f32) -> f32 {
    (x * 1.3).sin() * (z * 0.9).cos() + 0.3 * (x * 4.1 + z * 3.7).sin()
}

/// The ground's vertices, row by row, and its triangles.
fn ground() -> (Vec<[f32; 3]>, Vec<[u32; 3]>) {
    let side = CELLS + 1;
    let place = |i: u32| i as f32 / CELLS as f32 * 20.0 - 10.0;
    let vertex = |i: u32| {
        let (x, z) = (place(i % side), place(i / side));
        [x, height(x, z), z]
    };
    let cell = |i: u32| {
        let a = i / CELLS * side + i % CELLS;
        [[a, a + side, a + 1], [a + 1, a + side, a + side + 1]]
    };
    ((0..side * side).map(vertex).collect(), (0..CELLS * CELLS).flat_map(cell).collect())
}

/// A direction about +y that is more likely the steeper it is, another for each `i`.
fn upward(i: usize) -> Vec3 {
    let [u, v] = [0.754_877_7, 0.569_840_3].map(|step: f64| (i as f64 * step).fract() as f32);
    let (sin, cos) = (TAU * u).sin_cos();
    Vec3::new(v.sqrt() * cos, (1.0 - v).sqrt(), v.sqrt() * sin)
}

fn main() -> Result<(), Invalid> {
    let (positions, triangles) = ground();
    let mesh = Mesh::new(&positions, &triangles);
    let scene =
        compile(&Description { meshes: vec![mesh], materials: vec![Material::default()], ..Description::default() })?;

    let place = |i: usize| i as f32 / (RAYS - 1) as f32 * 18.0 - 9.0;
    let down = |i: usize| Ray::new([place(i % RAYS), 5.0, place(i / RAYS)], Vec3::NEG_Y);
    let rays: Vec<Ray> = (0..RAYS * RAYS).map(down).collect();
    let started = Instant::now();
    let mut hits = vec![None; rays.len()];
    par_intersect_rays(&scene, &rays, &mut hits);
    let seen = started.elapsed();

    // From every hit to the sky, around the ground's normal: where +y is turned to it.
    let leave = |(i, (ray, hit)): (usize, (&Ray, &Option<_>))| {
        let surface = scene.surface(ray, hit.as_ref()?);
        let turn = raypacket::glam::Quat::from_rotation_arc(Vec3::Y, surface.normal);
        Some(surface.spawn_ray((turn * upward(i)).normalize()))
    };
    let leaving: Vec<Ray> = rays.iter().zip(&hits).enumerate().filter_map(leave).collect();
    let started = Instant::now();
    let mut blocked = vec![false; leaving.len()];
    par_occluded_rays(&scene, &leaving, &mut blocked);
    let open = blocked.iter().filter(|blocked| !**blocked).count();
    println!("{} of {} rays hit the ground's {} triangles, in {seen:.1?}", leaving.len(), rays.len(), triangles.len());
    println!(
        "{:.1} % of the sky is open, found in {:.1?}",
        100.0 * open as f64 / leaving.len() as f64,
        started.elapsed()
    );
    Ok(())
}
