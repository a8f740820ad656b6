//! Both queries on the same rays, the eye rays of every built-in scene, by width: nanoseconds a ray.

mod common;

use std::hint::black_box;

use criterion::{BenchmarkId, Criterion, criterion_group, criterion_main};
use raypacket::math::{BATCH, Blocked, HitBatch, Lanes, NONE, RayBatch};
use raypacket::render::{Camera, TILE};
use raypacket::scene::{Description, Scene, builtins, compile, load};
use raypacket::trace::{Scratch, intersect, occluded};
use wide::{f32x4, f32x8};

const SIZE: [usize; 2] = [256, 128];

/// Every third tile of the picture, in blocks of 4 × 4 pixels, as the renderer has them.
fn eye_rays(description: &Description) -> Vec<RayBatch> {
    let [width, height] = SIZE;
    let camera = Camera::new(&description.camera, width as f32 / height as f32);
    let tiles = (width / TILE) * (height / TILE);
    let tile = |tile: usize| {
        let [x0, y0] = [tile % (width / TILE) * TILE, tile / (width / TILE) * TILE];
        let mut rays = RayBatch::default();
        for i in 0..BATCH {
            let (block, pixel) = (i / 16, i % 16);
            let (x, y) = (x0 + block % 4 * 4 + pixel % 4, y0 + block / 4 * 4 + pixel / 4);
            let [u, v] = [(x as f32 + 0.5) / width as f32, (y as f32 + 0.5) / height as f32];
            rays.push(camera.eye, camera.direction(u, v), 0.0, f32::INFINITY);
        }
        rays
    };
    (0..tiles).step_by(3).map(tile).collect()
}

/// What both queries say about all rays, to the bit.
fn answers<L: Lanes>(scene: &Scene, batches: &[RayBatch]) -> Vec<(Vec<u32>, Vec<u32>)> {
    let mut scratch = Scratch::default();
    let answer = |rays: &RayBatch| {
        let (mut hits, mut blocked) = (HitBatch::default(), Blocked::default());
        intersect::<L>(scene, rays, &mut hits, &mut scratch);
        occluded::<L>(scene, rays, &mut blocked, &mut scratch);
        for i in 0..BATCH {
            assert_eq!(blocked.get(i, 1) == 1, hits.primitive[i] != NONE, "{}: the queries agree", L::NAME);
        }
        (hits.t.map(f32::to_bits).to_vec(), hits.primitive.to_vec())
    };
    batches.iter().map(answer).collect()
}

fn width<L: Lanes>(criterion: &mut Criterion, name: &str, scene: &Scene, batches: &[RayBatch]) {
    assert!(answers::<L>(scene, batches) == answers::<f32>(scene, batches), "{name}: {} answers as x1", L::NAME);
    let rays = (batches.len() * BATCH) as u64;
    let mut scratch = Scratch::default();
    let (mut hits, mut blocked) = (HitBatch::default(), Blocked::default());
    let mut group = criterion.benchmark_group(format!("queries/{name}"));
    common::per_ray(&mut group, BenchmarkId::new("intersect", L::NAME), rays, || {
        for rays in black_box(batches) {
            intersect::<L>(scene, rays, &mut hits, &mut scratch);
            black_box(&mut hits);
        }
    });
    common::per_ray(&mut group, BenchmarkId::new("occluded", L::NAME), rays, || {
        for rays in black_box(batches) {
            occluded::<L>(scene, rays, &mut blocked, &mut scratch);
            black_box(&mut blocked);
        }
    });
}

fn queries(criterion: &mut Criterion) {
    for builtin in builtins() {
        let description = load(builtin.name).expect("a built-in scene");
        let scene = compile(&description).expect("a sound scene");
        let batches = eye_rays(&description);
        width::<f32>(criterion, builtin.name, &scene, &batches);
        width::<f32x4>(criterion, builtin.name, &scene, &batches);
        width::<f32x8>(criterion, builtin.name, &scene, &batches);
    }
}

criterion_group! { name = benches; config = common::short(); targets = queries }
criterion_main!(benches);
