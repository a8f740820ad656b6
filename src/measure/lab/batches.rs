//! Rays in batches, through the public queries.

use crate::math::{BATCH, Blocked, HitBatch, Lanes, NONE, RayBatch};
use crate::measure::cases::Ray;
use crate::render::{Kernel, with_lanes};
use crate::scene::Scene;
use crate::trace::{Hit, Scratch, intersect, occluded};

/// All rays, [`BATCH`] at a time.
pub fn of(rays: &[Ray]) -> Vec<RayBatch> {
    let fill = |rays: &[Ray]| {
        let mut batch = RayBatch::default();
        rays.iter().for_each(|r| batch.push(r.origin, r.direction, r.t_min, r.t_max));
        batch
    };
    rays.chunks(BATCH).map(fill).collect()
}

/// Answers all batches at a kernel's width, on this thread.
pub fn nearest(scene: &Scene, kernel: Kernel, batches: &[RayBatch], hits: &mut [HitBatch], scratch: &mut Scratch) {
    with_lanes!(kernel, nearest_of(scene, batches, hits, scratch));
}

fn nearest_of<L: Lanes>(scene: &Scene, batches: &[RayBatch], hits: &mut [HitBatch], scratch: &mut Scratch) {
    batches.iter().zip(hits).for_each(|(rays, hits)| intersect::<L>(scene, rays, hits, scratch));
}

/// The nearest hit of every ray.
pub fn trace(scene: &Scene, rays: &[Ray]) -> Vec<Option<Hit>> {
    let batches = of(rays);
    let mut hits = vec![HitBatch::default(); batches.len()];
    nearest(scene, Kernel::default(), &batches, &mut hits, &mut Scratch::default());
    (0..rays.len())
        .map(|i| {
            let (t, primitive) = (hits[i / BATCH].t[i % BATCH], hits[i / BATCH].primitive[i % BATCH]);
            (rays[i].t_max >= 0.0 && primitive != NONE).then_some(Hit { t, primitive })
        })
        .collect()
}

/// How many of the rays are blocked.
pub fn blocked(scene: &Scene, rays: &[Ray]) -> Vec<bool> {
    let mut scratch = Scratch::default();
    let answer = |rays: RayBatch| {
        let mut blocked = Blocked::default();
        with_lanes!(Kernel::default(), occluded(scene, &rays, &mut blocked, &mut scratch));
        (0..rays.len).map(move |i| blocked.get(i, 1) != 0)
    };
    of(rays).into_iter().flat_map(answer).collect()
}
