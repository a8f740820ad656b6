//! `intersect` and `occluded` on the same rays, in scenes of 16 and of 10,000 primitives of one kind: nanoseconds a ray,
//! with the batch's bounds and culling, or by the tree.

use std::hint::black_box;

use criterion::{BenchmarkId, Criterion};
use raypacket::math::{BATCH, Blocked, HitBatch, Lanes, NONE, RayBatch};
use raypacket::scene::{Scene, Structure, compile_with};
use raypacket::trace::{Scratch, intersect, occluded};
use wide::{f32x4, f32x8};

use crate::beams::Beams;
use crate::common;
use crate::kinds::{self, Kind, many, sixteen};
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

/// Both queries at all widths, after a look whether they agree.
fn widths(criterion: &mut Criterion, name: &str, scene: &Scene, rays: &RayBatch, expected: &HitBatch) {
    agree::<f32x4>(name, scene, rays, expected);
    agree::<f32x8>(name, scene, rays, expected);
    nearest::<f32>(criterion, name, scene, rays);
    nearest::<f32x4>(criterion, name, scene, rays);
    nearest::<f32x8>(criterion, name, scene, rays);
    any::<f32>(criterion, name, scene, rays);
    any::<f32x4>(criterion, name, scene, rays);
    any::<f32x8>(criterion, name, scene, rays);
}

fn kind<K: Kind>(criterion: &mut Criterion) {
    let mut rng = Pcg::new(5);
    let description = sixteen::<K>(&mut rng);
    let beams = Beams::new(&description, &mut rng);
    let scene = compiled(&description);
    let expected = answers::<f32>(K::NAME, &scene, &beams.rays);
    beams.confirm(K::NAME, K::OFF, &expected.t);
    widths(criterion, K::NAME, &scene, &beams.rays, &expected);
}

/// Ten thousand of a kind, in a tree; what testing all of them gives is expected.
fn kind_in_tree<K: Kind>(criterion: &mut Criterion) {
    let mut rng = Pcg::new(5);
    let description = many::<K>(&mut rng);
    let name = format!("{}/10000", K::NAME);
    let [list, tree] = [Structure::None, Structure::Tree]
        .map(|structure| compile_with(&description, &structure.into()).expect("a sound scene"));
    let beams = Beams::anywhere(&mut rng);
    let expected = answers::<f32>(&name, &list, &beams.rays);
    agree::<f32>(&name, &tree, &beams.rays, &expected);
    widths(criterion, &name, &tree, &beams.rays, &expected);
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
    kind_in_tree::<kinds::Sphere>(criterion);
    kind_in_tree::<kinds::Triangle>(criterion);
    kind_in_tree::<kinds::Quad>(criterion);
    kind_in_tree::<kinds::AlignedBox>(criterion);
    kind_in_tree::<kinds::TurnedBox>(criterion);
    kind_in_tree::<kinds::OpenCylinder>(criterion);
    kind_in_tree::<kinds::CappedCylinder>(criterion);
    kind_in_tree::<kinds::OpenCone>(criterion);
    kind_in_tree::<kinds::CappedCone>(criterion);
    kind_in_tree::<kinds::Torus>(criterion);
    kind_in_tree::<kinds::Fractal>(criterion);
    kind_in_tree::<kinds::Disc>(criterion);
}
