//! `intersect` and `occluded` on the same rays, in a scene of 16 primitives of one kind: nanoseconds a ray, with the
//! batch's bounds and culling.

use std::hint::black_box;

use criterion::{BenchmarkId, Criterion};
use raypacket::math::{BATCH, Blocked, HitBatch, Lanes, NONE, RayBatch};
use raypacket::scene::Scene;
use raypacket::trace::{Scratch, intersect, occluded};
use wide::{f32x4, f32x8};

use crate::beams::Beams;
use crate::common;
use crate::kinds::{self, Kind, sixteen};
use crate::scenes::{Pcg, compiled};

/// What `intersect` finds, after a look whether `occluded` says the same.
fn answers<L: Lanes>(name: &str, scene: &Scene, rays: &RayBatch) -> HitBatch {
    let (mut hits, mut blocked, mut scratch) = (HitBatch::default(), Blocked::default(), Scratch::default());
    intersect::<L>(scene, rays, &mut hits, &mut scratch);
    occluded::<L>(scene, rays, &mut blocked, &mut scratch);
    for i in 0..BATCH {
        let hit = hits.primitive[i] != NONE;
        assert_eq!(blocked.get(i, 1) == 1, hit, "{name} {}: ray {i} is blocked when it hits", L::NAME);
    }
    hits
}

fn agree<L: Lanes>(name: &str, scene: &Scene, rays: &RayBatch, expected: &HitBatch) {
    let hits = answers::<L>(name, scene, rays);
    assert_eq!(hits.t.map(f32::to_bits), expected.t.map(f32::to_bits), "{name} {}: distances", L::NAME);
    assert_eq!(hits.primitive, expected.primitive, "{name} {}: primitives", L::NAME);
}

fn nearest<L: Lanes>(criterion: &mut Criterion, name: &str, scene: &Scene, rays: &RayBatch) {
    let (mut hits, mut scratch) = (HitBatch::default(), Scratch::default());
    let id = BenchmarkId::new(format!("{name}/intersect"), L::NAME);
    common::per_ray(&mut criterion.benchmark_group("kinds"), id, BATCH as u64, || {
        intersect::<L>(black_box(scene), black_box(rays), &mut hits, &mut scratch);
        black_box(&mut hits);
    });
}

fn any<L: Lanes>(criterion: &mut Criterion, name: &str, scene: &Scene, rays: &RayBatch) {
    let (mut blocked, mut scratch) = (Blocked::default(), Scratch::default());
    let id = BenchmarkId::new(format!("{name}/occluded"), L::NAME);
    common::per_ray(&mut criterion.benchmark_group("kinds"), id, BATCH as u64, || {
        occluded::<L>(black_box(scene), black_box(rays), &mut blocked, &mut scratch);
        black_box(&mut blocked);
    });
}

fn kind<K: Kind>(criterion: &mut Criterion) {
    let mut rng = Pcg::new(5);
    let description = sixteen::<K>(&mut rng);
    let beams = Beams::new(&description, &mut rng);
    let (name, scene, rays) = (K::NAME, compiled(&description), &beams.rays);
    let expected = answers::<f32>(name, &scene, rays);
    beams.confirm(name, K::OFF, &expected.t);
    agree::<f32x4>(name, &scene, rays, &expected);
    agree::<f32x8>(name, &scene, rays, &expected);
    nearest::<f32>(criterion, name, &scene, rays);
    nearest::<f32x4>(criterion, name, &scene, rays);
    nearest::<f32x8>(criterion, name, &scene, rays);
    any::<f32>(criterion, name, &scene, rays);
    any::<f32x4>(criterion, name, &scene, rays);
    any::<f32x8>(criterion, name, &scene, rays);
}

pub fn all(criterion: &mut Criterion) {
    kind::<kinds::Plane>(criterion);
    kind::<kinds::Sphere>(criterion);
    kind::<kinds::Triangle>(criterion);
    kind::<kinds::Quad>(criterion);
    kind::<kinds::AlignedBox>(criterion);
    kind::<kinds::TurnedBox>(criterion);
    kind::<kinds::OpenCylinder>(criterion);
    kind::<kinds::CappedCylinder>(criterion);
    kind::<kinds::OpenCone>(criterion);
    kind::<kinds::CappedCone>(criterion);
    kind::<kinds::Torus>(criterion);
    kind::<kinds::Fractal>(criterion);
    kind::<kinds::Disc>(criterion);
}
