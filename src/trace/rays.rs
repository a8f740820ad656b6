//! The two queries for rays in arrays of the caller's own, packed into batches on the way.

use std::cell::RefCell;

use rayon::prelude::*;
use wide::f32x8;

use super::{BATCH, Blocked, Hit, HitBatch, NONE, Ray, RayBatch, Scratch, intersect, occluded};
use crate::scene::Scene;

/// Rays that a thread traces in one go.
const PIECE: usize = 16 * BATCH;

/// A batch, its answers, and memory to find them in.
#[derive(Default)]
struct Room {
    rays: RayBatch,
    hits: HitBatch,
    blocked: Blocked,
    scratch: Scratch,
}

thread_local! {
    /// Kept by every thread from call to call: some 100 kB. No code of the caller's runs while it is borrowed.
    static ROOM: RefCell<Box<Room>> = RefCell::default();
}

impl Room {
    /// Takes at most [`BATCH`] rays, column by column: several times as fast as one [`RayBatch::push`] after the other.
    fn pack(&mut self, rays: &[Ray]) {
        let rays = &rays[..rays.len().min(BATCH)];
        self.rays.set_len(rays.len());
        let RayBatch { origin: [ox, oy, oz], direction: [dx, dy, dz], t_min, t_max, .. } = &mut self.rays;
        for (i, ray) in rays.iter().enumerate() {
            (ox[i], oy[i], oz[i]) = ray.origin.into();
            (dx[i], dy[i], dz[i]) = ray.direction.into();
            (t_min[i], t_max[i]) = (ray.t_min, ray.t_max);
        }
        // Inactive rays count here as well, which costs them nothing but speed.
        self.rays.common_origin = rays.iter().all(|ray| ray.origin == rays[0].origin);
    }
}

/// The nearest hits of many rays, on the calling thread: `hits[i]` is that of `rays[i]`, or `None`.
///
/// The rays are traced 256 at a time, in their order; those that lie together in space had best lie together there. All
/// answers are those of [`intersect()`], to the bit. The order and the number of the rays change none, unless a ray has
/// NaN or infinite components.
///
/// # Panics
/// When the slices differ in length.
pub fn intersect_rays(scene: &Scene, rays: &[Ray], hits: &mut [Option<Hit>]) {
    assert_eq!(rays.len(), hits.len(), "a place for every hit");
    ROOM.with_borrow_mut(|room| {
        for (rays, hits) in rays.chunks(BATCH).zip(hits.chunks_mut(BATCH)) {
            room.pack(rays);
            intersect::<f32x8>(scene, &room.rays, &mut room.hits, &mut room.scratch);
            let found = room.hits.t.iter().zip(&room.hits.primitive);
            for ((hit, ray), (&t, &primitive)) in hits.iter_mut().zip(rays).zip(found) {
                // The place of an inactive ray holds what was there before.
                *hit = (ray.t_max >= 0.0 && primitive != NONE).then_some(Hit { t, primitive });
            }
        }
    });
}

/// Whether anything lies in the interval of each of many rays, on the calling thread; else as [`intersect_rays`], and
/// faster. As for [`occluded()`], surfaces stop light from both sides.
///
/// # Panics
/// When the slices differ in length.
pub fn occluded_rays(scene: &Scene, rays: &[Ray], blocked: &mut [bool]) {
    assert_eq!(rays.len(), blocked.len(), "a place for every answer");
    ROOM.with_borrow_mut(|room| {
        for (rays, blocked) in rays.chunks(BATCH).zip(blocked.chunks_mut(BATCH)) {
            room.pack(rays);
            room.blocked = Blocked::default();
            occluded::<f32x8>(scene, &room.rays, &mut room.blocked, &mut room.scratch);
            blocked.iter_mut().enumerate().for_each(|(i, blocked)| *blocked = room.blocked.get(i, 1) != 0);
        }
    });
}

/// [`intersect_rays`] in the caller's rayon pool: worth it from some ten thousand rays on.
///
/// # Panics
/// When the slices differ in length.
pub fn par_intersect_rays(scene: &Scene, rays: &[Ray], hits: &mut [Option<Hit>]) {
    assert_eq!(rays.len(), hits.len(), "a place for every hit");
    let pieces = rays.par_chunks(PIECE).zip(hits.par_chunks_mut(PIECE));
    pieces.for_each(|(rays, hits)| intersect_rays(scene, rays, hits));
}

/// [`occluded_rays`] in the caller's rayon pool: worth it from some ten thousand rays on.
///
/// # Panics
/// When the slices differ in length.
pub fn par_occluded_rays(scene: &Scene, rays: &[Ray], blocked: &mut [bool]) {
    assert_eq!(rays.len(), blocked.len(), "a place for every answer");
    let pieces = rays.par_chunks(PIECE).zip(blocked.par_chunks_mut(PIECE));
    pieces.for_each(|(rays, blocked)| occluded_rays(scene, rays, blocked));
}
