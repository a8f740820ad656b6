//! Rays in arrays of one's own get the answers of batches.

use raypacket::trace::{BATCH, Blocked, HitBatch, NONE, RayBatch, Scratch, intersect, occluded};
use raypacket::{
    Hit, Ray, Scene, compile, intersect_one, intersect_rays, occluded_rays, par_intersect_rays, par_occluded_rays,
    scene,
};

use crate::common::{Pcg, all_builtins};

/// Rays around a place, some with ends, some that are inactive, some with a start they share with the one before.
fn rays(count: usize, seed: u64) -> Vec<Ray> {
    let mut rng = Pcg::new(seed);
    let mut origin = rng.cube() * 4.0;
    let ray = |_| {
        if rng.chance(0.3) {
            origin = rng.cube() * 4.0;
        }
        let t_min = if rng.chance(0.2) { rng.range(0.0, 2.0) } else { 0.0 };
        let t_max = rng.pick(&[f32::INFINITY, 5.0, 1.0, 0.0, -1.0, f32::NAN]);
        Ray { t_min, t_max, ..Ray::new(origin, rng.cube().normalize()) }
    };
    (0..count).map(ray).collect()
}

/// The answers of the batches, one width after the other the same.
fn by_batches<L: raypacket::math::Lanes>(scene: &Scene, rays: &[Ray]) -> (Vec<Option<Hit>>, Vec<bool>) {
    let (mut found, mut blocked) = (Vec::new(), Vec::new());
    let mut scratch = Scratch::default();
    for rays in rays.chunks(BATCH) {
        let mut batch = RayBatch::default();
        rays.iter().for_each(|ray| batch.push(ray.origin, ray.direction, ray.t_min, ray.t_max));
        let (mut hits, mut bits) = (HitBatch::default(), Blocked::default());
        intersect::<L>(scene, &batch, &mut hits, &mut scratch);
        occluded::<L>(scene, &batch, &mut bits, &mut scratch);
        for i in 0..rays.len() {
            let (t, primitive) = (hits.t[i], hits.primitive[i]);
            found.push((primitive != NONE).then_some(Hit { t, primitive }));
            blocked.push(bits.get(i, 1) != 0);
        }
    }
    (found, blocked)
}

/// To the bit.
fn bits(hits: &[Option<Hit>]) -> Vec<Option<(u32, u32)>> {
    hits.iter().map(|hit| hit.map(|hit| (hit.t.to_bits(), hit.primitive))).collect()
}

#[test]
fn they_get_the_answers_of_batches_to_the_bit() {
    for description in all_builtins() {
        let scene = compile(&description).expect("a sound scene");
        // What is there before does not matter.
        let stale = Some(Hit { t: 7.0, primitive: 1 });
        for count in [0, 1, 255, 256, 257, 1000] {
            let rays = rays(count, count as u64);
            let (mut hits, mut blocked) = (vec![stale; count], vec![true; count]);
            intersect_rays(&scene, &rays, &mut hits);
            occluded_rays(&scene, &rays, &mut blocked);
            let (by_8, blocked_by_8) = by_batches::<wide::f32x8>(&scene, &rays);
            let (by_1, _) = by_batches::<f32>(&scene, &rays);
            assert_eq!(bits(&hits), bits(&by_8), "{}, {count} rays", description.name);
            assert_eq!(bits(&hits), bits(&by_1), "{}, {count} rays", description.name);
            assert_eq!(blocked, blocked_by_8, "{}, {count} rays", description.name);
            assert!(hits.iter().zip(&blocked).all(|(hit, blocked)| hit.is_some() == *blocked));
        }
    }
}

#[test]
fn a_pool_changes_nothing_and_some_rays_hit() {
    let scene = compile(&scene::load("classic").expect("built in")).expect("a sound scene");
    let rays = rays(20_000, 3);
    let (mut hits, mut blocked) = (vec![None; rays.len()], vec![false; rays.len()]);
    intersect_rays(&scene, &rays, &mut hits);
    occluded_rays(&scene, &rays, &mut blocked);
    let found = hits.iter().flatten().count();
    assert!((1000..19_000).contains(&found), "{found}");
    for threads in [1, 3] {
        let pool = raypacket::rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("a pool");
        let (mut others, mut shadows) = (vec![None; rays.len()], vec![false; rays.len()]);
        pool.install(|| {
            par_intersect_rays(&scene, &rays, &mut others);
            par_occluded_rays(&scene, &rays, &mut shadows);
        });
        assert_eq!(bits(&hits), bits(&others));
        assert_eq!(blocked, shadows);
    }
}

#[test]
fn single_rays_agree() {
    let scene = compile(&scene::load("primitives").expect("built in")).expect("a sound scene");
    for ray in rays(200, 9) {
        let ray = Ray::new(ray.origin, ray.direction);
        let mut hit = [None];
        intersect_rays(&scene, &[ray], &mut hit);
        assert_eq!(hit[0], intersect_one(&scene, ray.origin, ray.direction));
    }
}

#[test]
fn a_ray_between_two_points_ends_there() {
    let ray = Ray::between([1.0, 2.0, 3.0], [1.0, 2.0, -1.0]);
    assert_eq!((ray.t_max, ray.at(ray.t_max).to_array()), (4.0, [1.0, 2.0, -1.0]));
    assert_eq!(Ray::between([1.0; 3], [1.0; 3]).t_max, 0.0);
}

#[test]
#[should_panic(expected = "a place for every hit")]
fn a_slice_too_short_is_refused() {
    let scene = compile(&crate::common::empty()).expect("a sound scene");
    intersect_rays(&scene, &rays(2, 0), &mut [None]);
}
