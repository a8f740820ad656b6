//! The two queries over a compiled scene: [`intersect()`], the nearest hit, and [`occluded()`], any hit.
//!
//! Both work on a [`RayBatch`]. In a small scene its bounds leave out what none of its rays can meet, what depends on a
//! common origin is computed once, then the packets go through the rest one by one (`candidates`, `packets`). In a
//! larger one groups of its rays, or single ones, find their way through a tree of boxes (`tree`).

mod ahead;
mod bounds;
mod boxes;
mod candidates;
mod packets;
mod query;
mod single;
mod tree;

pub use crate::math::{BATCH, Blocked, HitBatch, NONE, RayBatch};
pub use candidates::Candidates;
pub use single::{Hit, Probe, intersect_one, occluded_one};

use crate::geometry::Primitives;
use crate::math::{LaneMask, Lanes};
use crate::scene::Scene;
pub(crate) use ahead::Ahead;
pub(crate) use bounds::{Bounds, Extent, Span};
use candidates::View;
pub(crate) use query::Nearest;

/// The nearest hit of every active ray, in packets of `L::WIDTH`.
///
/// Of hits at equal distance the lowest id wins. The answer for a ray depends neither on the width nor on the other
/// rays of the batch, unless it has NaN or infinite components. `hits` of inactive rays are left as they were.
pub fn intersect<L: Lanes>(scene: &Scene, rays: &RayBatch, hits: &mut HitBatch, scratch: &mut Candidates) {
    intersect_before::<L>(scene, rays, Ahead::NOTHING, hits, scratch);
}

/// [`intersect()`] for many batches, one after the other: each is brought near while the one before it is traced, which
/// is worth a twentieth to a sixth of the time where they come from memory. Stops where either slice ends.
pub fn intersect_stream<L: Lanes>(scene: &Scene, rays: &[RayBatch], hits: &mut [HitBatch], scratch: &mut Candidates) {
    let mut rest = hits;
    for (i, batch) in rays.iter().enumerate() {
        let Some((hits, later)) = rest.split_first_mut() else { return };
        intersect_before::<L>(scene, batch, Ahead::of(rays.get(i + 1), later.first()), hits, scratch);
        rest = later;
    }
}

fn intersect_before<L: Lanes>(
    scene: &Scene,
    rays: &RayBatch,
    ahead: Ahead,
    hits: &mut HitBatch,
    scratch: &mut Candidates,
) {
    match (scene.plan.rare, scene.triangles.is_empty()) {
        (false, true) => nearest_of::<L, false, false>(scene, rays, ahead, hits, scratch),
        (false, false) => nearest_of::<L, false, true>(scene, rays, ahead, hits, scratch),
        (true, _) => nearest_of::<L, true, true>(scene, rays, ahead, hits, scratch),
    }
}

fn nearest_of<L: Lanes, const RARE: bool, const MESH: bool>(
    scene: &Scene,
    rays: &RayBatch,
    ahead: Ahead,
    hits: &mut HitBatch,
    scratch: &mut Candidates,
) {
    match &scene.bvh {
        // The answers lie side by side: written at the tree's own width.
        Some(bvh) => tree::nearest::<L::Wider, RARE>(
            scene,
            bvh,
            rays,
            ahead,
            || Bounds::of::<L>(rays),
            scratch.tree(),
            #[inline(always)]
            |at, active, hit| keep(hits, at, active, hit),
        ),
        None => nearest_hits::<L, RARE, MESH>(
            scene,
            rays,
            ahead,
            || Bounds::of::<L>(rays),
            scratch,
            #[inline(always)]
            |at, active, hit| keep(hits, at, active, hit),
        ),
    }
}

#[inline(always)]
fn keep<L: Lanes>(hits: &mut HitBatch, at: usize, active: L::Mask, hit: &Nearest<L>) {
    let t = hit.t.select(hit.found, L::splat(f32::INFINITY));
    L::store_hits(t, hit.primitive, active, &mut hits.t[at..], &mut hits.primitive[at..]);
}

/// Whether anything lies in the interval of each active ray, in packets of `L::WIDTH`; a packet is left as soon as
/// all its rays are blocked.
///
/// A ray is blocked exactly when [`intersect()`] finds a hit for it. Bits of inactive rays are left as they were.
pub fn occluded<L: Lanes>(scene: &Scene, rays: &RayBatch, blocked: &mut Blocked, scratch: &mut Candidates) {
    occluded_before::<L>(scene, rays, Ahead::NOTHING, blocked, scratch);
}

/// [`occluded()`] for many batches, as [`intersect_stream`].
pub fn occluded_stream<L: Lanes>(scene: &Scene, rays: &[RayBatch], blocked: &mut [Blocked], scratch: &mut Candidates) {
    for (i, (batch, blocked)) in rays.iter().zip(blocked).enumerate() {
        occluded_before::<L>(scene, batch, Ahead::of(rays.get(i + 1), None), blocked, scratch);
    }
}

fn occluded_before<L: Lanes>(
    scene: &Scene,
    rays: &RayBatch,
    ahead: Ahead,
    blocked: &mut Blocked,
    scratch: &mut Candidates,
) {
    match (scene.plan.rare, scene.triangles.is_empty()) {
        (false, true) => any_of::<L, false, false>(scene, rays, ahead, blocked, scratch),
        (false, false) => any_of::<L, false, true>(scene, rays, ahead, blocked, scratch),
        (true, _) => any_of::<L, true, true>(scene, rays, ahead, blocked, scratch),
    }
}

fn any_of<L: Lanes, const RARE: bool, const MESH: bool>(
    scene: &Scene,
    rays: &RayBatch,
    ahead: Ahead,
    blocked: &mut Blocked,
    scratch: &mut Candidates,
) {
    any_hits::<L, RARE, MESH>(
        scene,
        rays,
        ahead,
        || Bounds::of::<L>(rays),
        scratch,
        #[inline(always)]
        |at, active, settled| blocked.set(at, active.bits(), settled.bits()),
    );
}

/// [`intersect()`] for rays whose bounds may be known; they are only asked for where they are needed. `RARE` must be
/// true where the plan is rare, `MESH` where that is or there are triangles; both may be true without need. `take`
/// gets every packet's answer while it is in registers; `ahead` is what comes after this batch.
#[inline(always)]
pub(crate) fn nearest_hits<L: Lanes, const RARE: bool, const MESH: bool>(
    scene: &Scene,
    rays: &RayBatch,
    ahead: Ahead,
    bounds: impl FnOnce() -> Option<Bounds>,
    scratch: &mut Candidates,
    take: impl FnMut(usize, L::Mask, &Nearest<L>),
) {
    if let Some(bvh) = &scene.bvh {
        return tree::nearest::<L, RARE>(scene, bvh, rays, ahead, bounds, scratch.tree(), take);
    }
    let Some(bounds) = bounds() else { return };
    match scratch.gather::<L>(scene, &bounds) {
        View::Shared(candidates) => packets::nearest::<_, L, RARE, MESH>(scene, candidates, rays, ahead, take),
        View::Apart(candidates) => packets::nearest::<_, L, RARE, MESH>(scene, candidates, rays, ahead, take),
    }
}

/// [`occluded()`] in the same way.
#[inline(always)]
pub(crate) fn any_hits<L: Lanes, const RARE: bool, const MESH: bool>(
    scene: &Scene,
    rays: &RayBatch,
    ahead: Ahead,
    bounds: impl FnOnce() -> Option<Bounds>,
    scratch: &mut Candidates,
    take: impl FnMut(usize, L::Mask, L::Mask),
) {
    if let Some(bvh) = &scene.bvh {
        return tree::any::<L, RARE>(scene, bvh, rays, ahead, bounds, scratch.tree(), take);
    }
    let Some(bounds) = bounds() else { return };
    match scratch.gather::<L>(scene, &bounds) {
        View::Shared(candidates) => packets::any::<_, L, RARE, MESH>(scene, candidates, rays, ahead, take),
        View::Apart(candidates) => packets::any::<_, L, RARE, MESH>(scene, candidates, rays, ahead, take),
    }
}
