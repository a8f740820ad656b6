//! The two queries by way of the [`Bvh`]: rays that run together descend as a group behind a beam that holds them all,
//! others as packets whose rays have each its own interval, and one at a time where few of a packet are left.
//!
//! A batch stays whole while its rays lie no farther apart, where they start and at the far side of the scene, than the
//! tree's blocks are large; else it is cut into as many parts as bring it there, and what is down to [`GROUP`] rays and still
//! much wider becomes a packet. So a group meets few boxes that some of its rays miss. (Large packets by one bound for
//! all: Boulos, Wald, Benthin 2006; single rays against eight boxes: Wald, Benthin, Boulos, *Getting Rid of Packets*, 2008;
//! both: Benthin, Wald, Woop, Ernst, Mark, *Combining Single and Packet-Ray Tracing*, 2012.)
//!
//! Every box and beam on the way down is wider than anything the primitives' tests can find ([`beam`]), and of equal
//! distances the lowest id is kept: so the answers for rays of finite numbers are those of testing everything, to the bit,
//! whatever the tree, the groups and the order.

mod beam;
mod group;
mod leaf;
mod line;
mod packet;
mod single;
mod stack;
mod state;

pub use state::State;

use super::ahead::Ahead;
use super::bounds::Bounds;
use super::query::Nearest;
use crate::bvh::Bvh;
use crate::geometry::{Planes, Primitives};
use crate::math::{LaneMask, Lanes, NONE, RayBatch, Vec3};
use crate::scene::Scene;
use beam::Beam;
use std::ops::Range;

// These four were measured on balls, ico1k, bunny and terrain1m.

/// A part of no more rays is not cut further: it is traced as a group, or as a packet where it is too wide for that.
const GROUP: usize = packet::RAYS;
/// How far apart a group's directions may be along any axis.
const WIDEST: f32 = 0.5;
/// How far apart they may be at the far side of the scene, in sizes of the tree's blocks, for a group to stay whole.
const FAR: f32 = 1.5;
/// The same for the smallest group not to become a packet; first for a common origin, from where its rays spread before
/// they meet anything.
const FAR_ALONE: [f32; 2] = [3.0, 20.0];
/// How far apart the origins may be, for both.
const NEAR: [f32; 2] = [1.0, 1.5];

/// What a traversal works on. `ANY`: any hit will do; `RARE`: sides matter; `MIXED`: the beam has an axis with both
/// directions.
struct Walk<'a> {
    scene: &'a Scene,
    bvh: &'a Bvh,
    rays: &'a RayBatch,
    ahead: Ahead<'a>,
    state: &'a mut State,
}

/// The nearest hits of a batch; see [`super::nearest_hits`].
#[inline(always)]
pub fn nearest<L: Lanes, const RARE: bool>(
    scene: &Scene,
    bvh: &Bvh,
    rays: &RayBatch,
    ahead: Ahead,
    bounds: impl FnOnce() -> Option<Bounds>,
    state: &mut State,
    mut take: impl FnMut(usize, L::Mask, &Nearest<L>),
) {
    answer::<L, false, RARE>(scene, bvh, rays, ahead, bounds, state);
    for at in (0..rays.len).step_by(L::WIDTH) {
        let active = L::load(&rays.t_max[at..]).ge(L::zero());
        if active.any() {
            let found = !L::id_mask(&state.id[at..], NONE);
            take(at, active, &Nearest { t: L::load(&state.t[at..]), primitive: L::load_ids(&state.id[at..]), found });
        }
    }
}

/// Which rays of a batch are blocked; see [`super::any_hits`].
#[inline(always)]
pub fn any<L: Lanes, const RARE: bool>(
    scene: &Scene,
    bvh: &Bvh,
    rays: &RayBatch,
    ahead: Ahead,
    bounds: impl FnOnce() -> Option<Bounds>,
    state: &mut State,
    mut take: impl FnMut(usize, L::Mask, L::Mask),
) {
    answer::<L, true, RARE>(scene, bvh, rays, ahead, bounds, state);
    for at in (0..rays.len).step_by(L::WIDTH) {
        let active = L::load(&rays.t_max[at..]).ge(L::zero());
        if active.any() {
            take(at, active, L::load(&state.t[at..]).lt(L::zero()));
        }
    }
}

/// Leaves the answers in `state`.
#[inline(never)]
fn answer<L: Lanes, const ANY: bool, const RARE: bool>(
    scene: &Scene,
    bvh: &Bvh,
    rays: &RayBatch,
    ahead: Ahead,
    bounds: impl FnOnce() -> Option<Bounds>,
    state: &mut State,
) {
    state.start::<L::Wider>(rays, !bvh.triangles.is_empty());
    let mut walk = Walk { scene, bvh, rays, ahead, state };
    if !scene.planes.is_empty() {
        let Some(bounds) = bounds() else { return };
        walk.planes::<L, ANY>(&bounds);
    }
    walk.rays::<L::Wider, ANY, RARE>(0..rays.len.next_multiple_of(L::Wider::WIDTH));
}

impl Walk<'_> {
    /// Traces the rays of a range: together, in parts, or one by one.
    fn rays<L: Lanes, const ANY: bool, const RARE: bool>(&mut self, range: Range<usize>) {
        let Some([origins, directions]) = Beam::ends(self.rays, self.state, range.clone()) else { return };
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
                self.group::<L, ANY, RARE>(&Beam::new(origins, directions, bvh), range);
            } else {
                self.state.lines.prepare(self.rays, bvh, range.clone());
                self.packet::<ANY, RARE>(range.start);
            }
            return;
        }
        let excess = f32::max(far / FAR, near / NEAR[0]);
        if spread < WIDEST && excess <= 1.0 {
            return self.group::<L, ANY, RARE>(&Beam::new(origins, directions, bvh), range);
        }
        // A part's rays lie closer together by the root of what it is smaller.
        let (mut part, mut excess) = ((range.len() / 2).next_power_of_two(), excess * excess);
        while part > GROUP && excess.is_nan() | (excess > 2.0) {
            (part, excess) = (part / 2, excess / 2.0);
        }
        for first in range.clone().step_by(part) {
            self.rays::<L, ANY, RARE>(first..(first + part).min(range.end));
        }
    }

    /// What no box holds: the planes.
    fn planes<L: Lanes, const ANY: bool>(&mut self, bounds: &Bounds) {
        let planes = &self.scene.planes;
        for i in (0..planes.len()).filter(|&i| !bounds.miss_plane(planes, i)) {
            let record = planes.record(i);
            for at in (0..self.rays.len).step_by(L::WIDTH) {
                let seen = Planes::seen::<L>(&record, self.rays.origins(at));
                let aim = Planes::aim(Vec3::load(&self.rays.direction, at));
                let (t_min, t_max) = (L::load(&self.rays.t_min[at..]), L::load(&self.state.t[at..]));
                if let Some((t, inside)) = Planes::nearest::<L, false>(&seen, &aim, t_min, t_max) {
                    self.state.take::<L, ANY>(at, t, inside, i as u32);
                }
            }
        }
    }
}
