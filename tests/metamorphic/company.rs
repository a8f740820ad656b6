//! The rays beside a ray, of whatever numbers they are, do not change its answer.

use glam::Vec3;
use proptest::prelude::*;
use raypacket::{
    math::Lanes,
    scene::{Scene, Structure, compile_as},
    trace::{Blocked, Candidates, HitBatch, NONE, RayBatch, intersect, occluded},
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
    let mut scratch = Candidates::default();
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

proptest! {
    #![proptest_config(config(1000, 0xa4))]

    #[test]
    fn broken_rays_change_nobody_elses_answer(items in items(), rays in rays()) {
        let description = scene(&items);
        for structure in [Structure::None, Structure::Tree] {
            let compiled = compile_as(&description, Some(structure)).expect("a sound scene");
            expect_alone::<f32>(&compiled, &rays)?;
            expect_alone::<f32x4>(&compiled, &rays)?;
            expect_alone::<f32x8>(&compiled, &rays)?;
        }
    }
}
