//! The rays beside a ray, of whatever numbers they are, do not change its answer, nor do the batches beside a batch.

use glam::Vec3;
use proptest::prelude::*;
use raypacket::{
    math::Lanes,
    scene::{Scene, Structure, compile_with},
    trace::{Blocked, HitBatch, NONE, RayBatch, Scratch, intersect, intersect_stream, occluded, occluded_stream},
};
use wide::{f32x4, f32x8};

use crate::{
    config,
    scenes::{Steps, items, place, scene, vector},
};

/// Not finite, or so that squares, products or differences of them are not, or vanish.
const EXTREMES: [f32; 16] = [
    f32::NAN,
    f32::INFINITY,
    f32::NEG_INFINITY,
    f32::MAX,
    f32::MIN,
    1e30,
    -1e30,
    1e19,
    -1e19,
    1e-20,
    -1e-20,
    1e-45,
    -1e-45,
    0.0,
    -0.0,
    1.0,
];

/// A ray: an ordinary one, of which some numbers (x y z of the origin, of the direction, t_min, t_max) are replaced.
#[derive(Clone, Debug)]
struct Ray {
    from: Steps,
    to: Steps,
    replaced: Vec<(usize, f32)>,
}

fn rays() -> impl Strategy<Value = Vec<Ray>> {
    let replaced = prop_oneof![
        1 => Just(Vec::new()),
        1 => prop::collection::vec((0..8_usize, prop::sample::select(&EXTREMES[..])), 1..6),
    ];
    let ray = (vector(), vector(), replaced).prop_map(|(from, to, replaced)| Ray { from, to, replaced });
    prop::collection::vec(ray, 1..40)
}

impl Ray {
    fn push(&self, rays: &mut RayBatch) {
        let (from, to) = (place(self.from) * 2.0, place(self.to));
        let direction = (to - from).try_normalize().unwrap_or(Vec3::X);
        let mut numbers = [0.0; 8];
        numbers[..3].copy_from_slice(&from.to_array());
        numbers[3..6].copy_from_slice(&direction.to_array());
        numbers[7] = f32::INFINITY;
        self.replaced.iter().for_each(|&(at, number)| numbers[at] = number);
        let [x, y, z, dx, dy, dz, t_min, t_max] = numbers;
        rays.push(Vec3::new(x, y, z), Vec3::new(dx, dy, dz), t_min, t_max);
    }
}

/// Distance to the bit and id of every ray; a ray is blocked exactly when it has a hit, whatever its numbers are.
fn answers<L: Lanes>(scene: &Scene, rays: &[&Ray]) -> Vec<(u32, u32)> {
    let mut batch = RayBatch::default();
    rays.iter().for_each(|ray| ray.push(&mut batch));
    let (mut hits, mut blocked) = (HitBatch::default(), Blocked::default());
    let mut scratch = Scratch::default();
    intersect::<L>(scene, &batch, &mut hits, &mut scratch);
    occluded::<L>(scene, &batch, &mut blocked, &mut scratch);
    let answer = |i: usize| {
        let active = batch.t_max[i] >= 0.0;
        assert!(!active || (blocked.get(i, 1) != 0) == (hits.primitive[i] != NONE), "ray {i} of {rays:?}");
        (hits.t[i].to_bits(), hits.primitive[i])
    };
    (0..rays.len()).map(answer).collect()
}

fn expect_alone<L: Lanes>(scene: &Scene, rays: &[Ray]) -> Result<(), TestCaseError> {
    let together = answers::<L>(scene, &rays.iter().collect::<Vec<_>>());
    for (i, (ray, found)) in rays.iter().zip(together).enumerate().filter(|(_, (ray, _))| ray.replaced.is_empty()) {
        let alone = answers::<f32>(scene, &[ray])[0];
        prop_assert!(found == alone, "{}, ray {i}: {found:?}, alone {alone:?}", L::NAME);
    }
    Ok(())
}

/// Batch by batch and as a stream; what is left out at the end of the answers stays as it was.
fn expect_same_in_a_stream<L: Lanes>(
    scene: &Scene,
    batches: &[RayBatch],
    answered: usize,
) -> Result<(), TestCaseError> {
    let mut scratch = Scratch::default();
    let (mut hits, mut blocked) = (vec![HitBatch::default(); batches.len()], vec![Blocked::default(); batches.len()]);
    let (mut streamed, mut stopped) = (hits.clone(), blocked.clone());
    for (i, batch) in batches.iter().enumerate().take(answered) {
        intersect::<L>(scene, batch, &mut hits[i], &mut scratch);
        occluded::<L>(scene, batch, &mut blocked[i], &mut scratch);
    }
    intersect_stream::<L>(scene, batches, &mut streamed[..answered], &mut scratch);
    occluded_stream::<L>(scene, batches, &mut stopped[..answered], &mut scratch);
    let bits = |hits: &[HitBatch]| {
        let bits = |hits: &HitBatch| (hits.t.map(f32::to_bits), hits.primitive);
        hits.iter().map(bits).collect::<Vec<_>>()
    };
    prop_assert!(bits(&hits) == bits(&streamed), "{}", L::NAME);
    prop_assert!(blocked == stopped, "{}", L::NAME);
    Ok(())
}

proptest! {
    #![proptest_config(config(200, 0xa5))]

    #[test]
    fn a_stream_answers_as_its_batches_do(
        items in items(),
        parts in prop::collection::vec(rays(), 0..5),
        answered in 0..5_usize,
    ) {
        let description = scene(&items);
        let batches: Vec<RayBatch> = parts
            .iter()
            .map(|rays| {
                let mut batch = RayBatch::default();
                rays.iter().for_each(|ray| ray.push(&mut batch));
                batch
            })
            .collect();
        for structure in [Structure::None, Structure::Tree] {
            let compiled = compile_with(&description, &structure.into()).expect("a sound scene");
            expect_same_in_a_stream::<f32>(&compiled, &batches, answered.min(batches.len()))?;
            expect_same_in_a_stream::<f32x8>(&compiled, &batches, answered.min(batches.len()))?;
        }
    }
}

proptest! {
    #![proptest_config(config(1000, 0xa4))]

    #[test]
    fn broken_rays_change_nobody_elses_answer(items in items(), rays in rays()) {
        let description = scene(&items);
        for structure in [Structure::None, Structure::Tree] {
            let compiled = compile_with(&description, &structure.into()).expect("a sound scene");
            expect_alone::<f32>(&compiled, &rays)?;
            expect_alone::<f32x4>(&compiled, &rays)?;
            expect_alone::<f32x8>(&compiled, &rays)?;
        }
    }
}
