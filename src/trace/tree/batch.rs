//! A batch's way through the tree: together, in parts, or one by one.

use super::beam::Beam;
use super::packet::PACKET;
use super::state::State;
use super::walk::Walk;
use crate::bvh::{Bvh, Places};
use crate::geometry::{Planes, Primitives};
use crate::math::{LaneMask, Lanes, RayBatch, Vec3};
use crate::scene::Scene;
use crate::trace::bounds::Bounds;
use crate::trace::prefetch::Prefetch;
use crate::trace::query::{Found, Query};
use std::ops::Range;

// These four were measured on balls, ico1k, bunny and terrain1m, and on frames of gears, rings and tree.

/// A part of no more rays is not cut further: it is traced as a group, or as a packet where it is too wide for that.
const GROUP: usize = PACKET;
/// How far apart a group's directions may be along any axis.
const WIDEST: f32 = 0.5;
/// How far apart they may be at the far side of the scene, in sizes of the tree's blocks, for a group to stay whole.
const FAR: f32 = 1.5;
/// How far apart they may be there for the smallest group not to become a packet; first for a common origin, from where
/// its rays spread before they meet anything.
const FAR_ALONE: [f32; 2] = [3.0, 20.0];
/// How far apart the origins may be, for both.
const NEAR: [f32; 2] = [1.0, 1.5];

/// Answers a query for a batch; see [`crate::trace::trace`].
#[inline(always)]
pub fn trace<Q: Query, L: Lanes>(
    scene: &Scene,
    bvh: &Bvh,
    rays: &RayBatch,
    prefetch: Prefetch,
    bounds: impl FnOnce() -> Option<Bounds>,
    state: &mut State,
    mut take: impl FnMut(usize, L::Mask, &Q::Found<L>),
) {
    answer::<Q, L>(scene, bvh, rays, prefetch, bounds, state);
    for at in (0..rays.len).step_by(L::WIDTH) {
        let active = L::load(&rays.t_max[at..]).ge(L::zero());
        if active.any() {
            take(at, active, &Q::Found::load(&state.t[at..], &state.id[at..]));
        }
    }
}

/// Leaves the answers in `state`.
#[inline(never)]
fn answer<Q: Query, L: Lanes>(
    scene: &Scene,
    bvh: &Bvh,
    rays: &RayBatch,
    prefetch: Prefetch,
    bounds: impl FnOnce() -> Option<Bounds>,
    state: &mut State,
) {
    state.start::<L::Wider>(rays, !scene.triangles.is_empty());
    let mut walk = Walk { scene, bvh, places: Places::of(bvh), rays, prefetch, state };
    if !scene.planes.is_empty() {
        let Some(bounds) = bounds() else { return };
        walk.planes::<Q, L>(&bounds);
    }
    walk.rays::<Q, L::Wider>(0..rays.len.next_multiple_of(L::Wider::WIDTH));
}

impl Walk<'_> {
    /// Traces the rays of a range: together, in parts, or one by one.
    fn rays<Q: Query, L: Lanes>(&mut self, range: Range<usize>) {
        let Some([origins, directions]) = Beam::ends(self.rays, &self.state.t, range.clone()) else { return };
        let bvh = self.bvh;
        let size = (bvh.bounds.max - bvh.bounds.min).max_element();
        let spread = (directions[1] - directions[0]).max_element();
        let away = (bvh.bounds.max - origins[0]).max(origins[1] - bvh.bounds.min).max_element();
        let far = spread * size.max(away) / bvh.grain;
        let near = (origins[1] - origins[0]).max_element() / bvh.grain;
        if range.len() <= GROUP {
            // NaN fails these.
            let alone = FAR_ALONE[usize::from(!self.rays.common_origin)];
            if spread < WIDEST && far < alone && near <= NEAR[1] {
                self.group::<Q, L>(&Beam::new(origins, directions, bvh), range);
            } else {
                self.state.lines.prepare(self.rays, bvh, range.clone());
                self.packet::<Q>(range.start);
            }
            return;
        }
        let excess = f32::max(far / FAR, near / NEAR[0]);
        if spread < WIDEST && excess <= 1.0 {
            return self.group::<Q, L>(&Beam::new(origins, directions, bvh), range);
        }
        // A part's rays lie closer together by the root of what it is smaller.
        let (mut part, mut excess) = ((range.len() / 2).next_power_of_two(), excess * excess);
        while part > GROUP && excess.is_nan() | (excess > 2.0) {
            (part, excess) = (part / 2, excess / 2.0);
        }
        for first in range.clone().step_by(part) {
            self.rays::<Q, L>(first..(first + part).min(range.end));
        }
    }

    /// Tests the planes, which no box holds.
    fn planes<Q: Query, L: Lanes>(&mut self, bounds: &Bounds) {
        let planes = &self.scene.planes;
        for i in (0..planes.len()).filter(|&i| !bounds.miss_plane(planes, i)) {
            let plane = Planes::splat(&planes.shape(i));
            for at in (0..self.rays.len).step_by(L::WIDTH) {
                let seen = Planes::seen::<L>(&plane, (), self.rays.origins(at));
                let aim = Planes::aim(Vec3::load(&self.rays.direction, at));
                let (t_min, t_max) = (L::load(&self.rays.t_min[at..]), L::load(&self.state.t[at..]));
                if let Some((t, inside)) = Planes::nearest::<L>(&seen, (), &aim, t_min, t_max) {
                    self.state.take::<Q, L>(at, t, inside, i as u32);
                }
            }
        }
    }
}
