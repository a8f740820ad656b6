//! The two queries over a compiled scene: [`intersect()`], the nearest hit, and [`occluded()`], any hit.
//!
//! Both work on a [`RayBatch`]: its bounds leave out what none of its rays can meet, what depends on a common origin
//! is computed once, then the packets go through the rest one by one.

mod bounds;
mod candidates;
mod packets;
mod query;
mod single;

pub use crate::math::{BATCH, Blocked, HitBatch, NONE, RayBatch};
pub use candidates::Candidates;
pub use single::{Hit, intersect_one, occluded_one};

use crate::math::Lanes;
use crate::scene::Scene;
use bounds::Bounds;

/// The nearest hit of every active ray, in packets of `L::WIDTH`.
///
/// Of hits at equal distance the lowest id wins. The answer for a ray depends neither on the width nor on the other
/// rays of the batch. `hits` of inactive rays are left as they were.
pub fn intersect<L: Lanes>(scene: &Scene, rays: &RayBatch, hits: &mut HitBatch, scratch: &mut Candidates) {
    let Some(bounds) = Bounds::of::<L>(rays) else { return };
    match scratch.gather::<L>(scene, &bounds) {
        candidates::View::Shared(view) => packets::nearest::<L, _>(&view, rays, hits),
        candidates::View::Apart(view) => packets::nearest::<L, _>(&view, rays, hits),
    }
}

/// Whether anything lies in the interval of each active ray, in packets of `L::WIDTH`; a packet is left as soon as
/// all its rays are blocked.
///
/// A ray is blocked exactly when [`intersect()`] finds a hit for it. Bits of inactive rays are left as they were.
pub fn occluded<L: Lanes>(scene: &Scene, rays: &RayBatch, blocked: &mut Blocked, scratch: &mut Candidates) {
    let Some(bounds) = Bounds::of::<L>(rays) else { return };
    match scratch.gather::<L>(scene, &bounds) {
        candidates::View::Shared(view) => packets::any::<L, _>(&view, rays, blocked),
        candidates::View::Apart(view) => packets::any::<L, _>(&view, rays, blocked),
    }
}
