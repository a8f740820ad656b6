//! The two queries over a compiled scene: [`intersect()`], the nearest hit, and [`occluded()`], any hit.
//!
//! Both work on a [`RayBatch`]. In a small scene its bounds leave out what none of its rays can meet, what depends on a
//! common origin is computed once, then the packets go through the rest one by one (`candidates`, `packets`). In a
//! larger one groups of its rays, or single ones, find their way through a tree of boxes (`tree`). [`intersect_rays`],
//! [`occluded_rays`] and their `par_` forms take slices of [`Ray`]s instead, and pack the batches themselves.

mod bounds;
mod candidates;
pub(crate) mod contents;
mod packet;
mod packets;
mod prefetch;
mod query;
mod ray;
mod rays;
mod scratch;
mod single;
mod tree;

pub use crate::math::{BATCH, Blocked, HitBatch, NONE, RayBatch};
pub use ray::Ray;
pub use rays::{intersect_rays, occluded_rays, par_intersect_rays, par_occluded_rays};
pub use scratch::Scratch;
pub use single::{Hit, Probe, intersect_one, occluded_one};

use crate::math::{LaneMask, Lanes};
use crate::scene::Scene;
pub(crate) use bounds::{Bounds, Extent, Span};
pub(crate) use contents::{Contents, Everything, with_contents};
pub(crate) use prefetch::Prefetch;
pub(crate) use query::{Intersect, Nearest, Occluded, Query};

/// The nearest hit of every active ray, in packets of `L::WIDTH`.
///
/// Of hits at equal distance the lowest id wins. The answer for a ray depends neither on the width nor on the other
/// rays of the batch, unless it has NaN or infinite components or starts beyond 2⁶⁸. `hits` of inactive rays are left as
/// they were.
pub fn intersect<L: Lanes>(scene: &Scene, rays: &RayBatch, hits: &mut HitBatch, scratch: &mut Scratch) {
    intersect_before::<L>(scene, rays, Prefetch::NOTHING, hits, scratch);
}

/// [`intersect()`] for many batches, one after the other: each is brought near while the one before it is traced, which
/// is worth a twentieth to a sixth of the time where they come from memory. Stops where either slice ends.
pub fn intersect_stream<L: Lanes>(scene: &Scene, rays: &[RayBatch], hits: &mut [HitBatch], scratch: &mut Scratch) {
    let mut rest = hits;
    for (i, batch) in rays.iter().enumerate() {
        let Some((hits, later)) = rest.split_first_mut() else { return };
        intersect_before::<L>(scene, batch, Prefetch::after(batch, rays.get(i + 1), later.first()), hits, scratch);
        rest = later;
    }
}

fn intersect_before<L: Lanes>(
    scene: &Scene,
    rays: &RayBatch,
    prefetch: Prefetch,
    hits: &mut HitBatch,
    scratch: &mut Scratch,
) {
    if scene.bvh.is_some() {
        // The answers lie side by side: written at the tree's own width.
        return nearest_of::<L, L::Wider, Everything>(scene, rays, prefetch, hits, scratch);
    }
    with_contents!(scene, scene.plan.rare, C => nearest_of::<L::Wider, L::Wider, C>(scene, rays, prefetch, hits, scratch))
}

fn nearest_of<L: Lanes, W: Lanes, C: Contents>(
    scene: &Scene,
    rays: &RayBatch,
    prefetch: Prefetch,
    hits: &mut HitBatch,
    scratch: &mut Scratch,
) {
    trace::<Intersect, W, C>(
        scene,
        rays,
        prefetch,
        || Bounds::of::<L>(rays),
        scratch,
        #[inline(always)]
        |at, active, hit| {
            let t = hit.t.select(hit.found, W::splat(f32::INFINITY));
            W::store_hits(t, hit.primitive, active, &mut hits.t[at..], &mut hits.primitive[at..]);
        },
    );
}

/// Whether anything lies in the interval of each active ray, in packets of `L::WIDTH`; a packet is left as soon as
/// all its rays are blocked.
///
/// A ray is blocked exactly when [`intersect()`] would find a hit for it if all surfaces were seen from both sides: light
/// is stopped by a surface from either ([`crate::geometry::Sides`]). Bits of inactive rays are left as they were.
pub fn occluded<L: Lanes>(scene: &Scene, rays: &RayBatch, blocked: &mut Blocked, scratch: &mut Scratch) {
    occluded_before::<L>(scene, rays, Prefetch::NOTHING, blocked, scratch);
}

/// [`occluded()`] for many batches, as [`intersect_stream`].
pub fn occluded_stream<L: Lanes>(scene: &Scene, rays: &[RayBatch], blocked: &mut [Blocked], scratch: &mut Scratch) {
    for (i, (batch, blocked)) in rays.iter().zip(blocked).enumerate() {
        occluded_before::<L>(scene, batch, Prefetch::after(batch, rays.get(i + 1), None), blocked, scratch);
    }
}

fn occluded_before<L: Lanes>(
    scene: &Scene,
    rays: &RayBatch,
    prefetch: Prefetch,
    blocked: &mut Blocked,
    scratch: &mut Scratch,
) {
    if scene.bvh.is_some() {
        return any_of::<L, Everything>(scene, rays, prefetch, blocked, scratch);
    }
    with_contents!(scene, scene.plan.rare, C => any_of::<L::Wider, C>(scene, rays, prefetch, blocked, scratch))
}

fn any_of<L: Lanes, C: Contents>(
    scene: &Scene,
    rays: &RayBatch,
    prefetch: Prefetch,
    blocked: &mut Blocked,
    scratch: &mut Scratch,
) {
    trace::<Occluded, L, C>(
        scene,
        rays,
        prefetch,
        || Bounds::of::<L>(rays),
        scratch,
        #[inline(always)]
        |at, active, found| blocked.set(at, active.bits(), found.settled.bits()),
    );
}

/// A query for rays whose bounds may be known; they are only asked for where they are needed. `take` gets every packet's
/// answer while it is in registers; `prefetch` is what comes after this batch.
#[inline(always)]
pub(crate) fn trace<Q: Query, L: Lanes, C: Contents>(
    scene: &Scene,
    rays: &RayBatch,
    prefetch: Prefetch,
    bounds: impl FnOnce() -> Option<Bounds>,
    scratch: &mut Scratch,
    take: impl FnMut(usize, L::Mask, &Q::Found<L>),
) {
    if let Some(bvh) = &scene.bvh {
        return tree::trace::<Q, L>(scene, bvh, rays, prefetch, bounds, scratch.tree(), take);
    }
    let Some(bounds) = bounds() else { return };
    if bounds.shared {
        scratch.common.fill::<Q, L>(scene, &bounds);
        packets::trace::<Q, _, L, C>(scene, &scratch.common, rays, prefetch, take);
    } else {
        scratch.any.fill::<Q, L>(scene, &bounds);
        packets::trace::<Q, _, L, C>(scene, &scratch.any, rays, prefetch, take);
    }
}
