//! How right the default methods are: all hard cases through the public query, judged by the exact oracle; and rays that
//! leave surfaces of all sizes. `--nocapture` prints the tables.

#[path = "../common/mod.rs"]
mod common;

mod bounds;
mod judge;
mod leaving;
mod table;

use glam::Vec3;
use raypacket::geometry::methods::{Choice, SphereMethod};
use raypacket::geometry::{Primitives, Surface};
use raypacket::measure::cases::Ray;
use raypacket::measure::oracle::Shape;
use raypacket::scene::{CompileOptions, Description, Scene, compile_with};
use raypacket::trace::{BATCH, HitBatch, NONE, RayBatch, Scratch, intersect};
use wide::f32x8;

/// The nearest hit: t, and the primitive's id.
type Found = Option<(f32, usize)>;

/// By the default methods: what a scene is traced by otherwise depends on how far its camera and lights are, and here rays
/// start anywhere.
fn compiled(description: &Description) -> Scene {
    compile_with(
        description,
        &CompileOptions { methods: vec![Choice::Sphere(SphereMethod::Stable)], ..CompileOptions::default() },
    )
    .expect("a sound scene")
}

/// The public query's answers.
fn trace(scene: &Scene, rays: &[Ray]) -> Vec<Found> {
    let (mut batch, mut scratch) = (RayBatch::default(), Scratch::default());
    let mut hits = HitBatch { t: [f32::NAN; BATCH], primitive: [NONE; BATCH] };
    let mut answers = Vec::with_capacity(rays.len());
    for rays in rays.chunks(BATCH) {
        batch.clear();
        rays.iter().for_each(|r| batch.push(r.origin, r.direction, r.t_min, r.t_max));
        intersect::<f32x8>(scene, &batch, &mut hits, &mut scratch);
        let answer = |i: usize| (hits.primitive[i] != NONE).then(|| (hits.t[i], hits.primitive[i] as usize));
        answers.extend((0..rays.len()).map(answer));
    }
    answers
}

/// The surface that the shading finds for the primitive with that id, near `point`.
fn surface(scene: &Scene, shape: &Shape, id: usize, point: Vec3) -> Surface<f32> {
    let (first, point) = (&scene.first, point.into());
    let of = |first: u32| id - first as usize;
    match shape {
        Shape::Plane(_) => scene.planes.surface(id, point),
        Shape::Sphere(_) => scene.spheres.surface(of(first.spheres), point),
        Shape::Triangle(_) => scene.triangles.surface(of(first.triangles), point),
        Shape::Quad(_) => scene.quads.surface(of(first.quads), point),
        Shape::Cuboid(_) => scene.cuboids.surface(of(first.cuboids), point),
        Shape::Cylinder(_) => scene.cylinders.surface(of(first.cylinders), point),
        Shape::Cone(_) => scene.cones.surface(of(first.cones), point),
        Shape::Torus(_) => scene.tori.surface(of(first.tori), point),
        Shape::Fractal(_) => scene.fractals.surface(of(first.fractals), point),
        Shape::Disc(_) => scene.discs.surface(of(first.discs), point),
    }
}

/// Where a ray is at t, as the shading computes it.
fn at(ray: &Ray, t: f32) -> Vec3 {
    let along = |d: f32, o: f32| if cfg!(target_feature = "fma") { d.mul_add(t, o) } else { d * t + o };
    let (o, d) = (ray.origin, ray.direction);
    Vec3::new(along(d.x, o.x), along(d.y, o.y), along(d.z, o.z))
}
