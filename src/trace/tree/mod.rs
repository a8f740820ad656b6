//! The two queries by way of the [`Bvh`]: rays that run together descend as a group behind a beam that holds them all,
//! others one at a time.
//!
//! A batch is cut into groups of [`GROUP`] rays. Every box, beam and interval on the way down is wider than anything
//! the primitives' tests can find ([`beam`]), and of equal distances the lowest id is kept: so the answers are those of
//! testing everything, to the bit, whatever the tree, the groups and the order.

mod beam;
mod group;
mod leaf;
mod line;
mod single;
mod stack;
mod state;

pub use state::State;

use super::bounds::Bounds;
use super::query::Nearest;
use crate::bvh::Bvh;
use crate::geometry::{Planes, Primitives};
use crate::math::{LaneMask, Lanes, NONE, RayBatch, Vec3};
use crate::scene::Scene;
use beam::Beam;
use std::ops::Range;

/// Rays a group.
pub const GROUP: usize = 16;
/// Rays that are tried together first.
pub const LARGE: usize = 64;
/// How far apart the directions of a group may be along any axis for its rays to run together.
const SPREAD: f32 = 0.5;
const LFAR: f32 = 1.5;
const LNEAR: f32 = 1.0;
const SFAR: f32 = 30.0;
const SNEAR: f32 = 1.5;
/// How far apart its origins may be, in sizes of the tree's blocks.
const APART: f32 = 4.0;

/// What a traversal works on; `RARE` and `ANY` as everywhere.
struct Walk<'a> {
    scene: &'a Scene,
    bvh: &'a Bvh,
    rays: &'a RayBatch,
    state: &'a mut State,
}

/// The nearest hits of a batch; see [`super::nearest_hits`].
#[inline(always)]
pub fn nearest<L: Lanes, const RARE: bool>(
    scene: &Scene,
    bvh: &Bvh,
    rays: &RayBatch,
    bounds: impl FnOnce() -> Option<Bounds>,
    state: &mut State,
    mut take: impl FnMut(usize, L::Mask, &Nearest<L>),
) {
    answer::<L, false, RARE>(scene, bvh, rays, bounds, state);
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
    bounds: impl FnOnce() -> Option<Bounds>,
    state: &mut State,
    mut take: impl FnMut(usize, L::Mask, L::Mask),
) {
    answer::<L, true, RARE>(scene, bvh, rays, bounds, state);
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
    bounds: impl FnOnce() -> Option<Bounds>,
    state: &mut State,
) {
    state.start::<L>(rays, !bvh.triangles.is_empty());
    let mut walk = Walk { scene, bvh, rays, state };
    if !scene.planes.is_empty() {
        let Some(bounds) = bounds() else { return };
        walk.planes::<L, ANY>(&bounds);
    }
    let end = rays.len.next_multiple_of(L::WIDTH);
    for first in (0..end).step_by(LARGE) {
        let large = first..(first + LARGE).min(end);
        if walk.together::<L, ANY, RARE>(large.clone()) {
            continue;
        }
        for first in large.clone().step_by(GROUP) {
            let range = first..(first + GROUP).min(end);
            if !walk.together::<L, ANY, RARE>(range.clone()) {
                walk.state.lines.prepare(rays, bvh, range.clone());
                for i in range {
                    walk.single::<ANY, RARE>(i);
                }
            }
        }
    }
}

impl Walk<'_> {
    /// Traces the rays of a range as a group if that is faster than one by one.
    #[inline(always)]
    fn together<L: Lanes, const ANY: bool, const RARE: bool>(&mut self, range: Range<usize>) -> bool {
        let Some([origins, directions]) = Beam::ends(self.rays, self.state, range.clone()) else { return true };
        let spread = (directions[1] - directions[0]).max_element();
        let apart = (origins[1] - origins[0]).max_element();
        let size = (self.bvh.bounds.max - self.bvh.bounds.min).max_element();
        let (far, near) = if range.len() > GROUP { (LFAR, LNEAR) } else { (SFAR, SNEAR) };
        // NaN fails these.
        let together = spread < 0.5 && spread * size < far * self.bvh.grain && apart <= near * self.bvh.grain;
        if together {
            self.group::<L, ANY, RARE>(&Beam::new(origins, directions, self.bvh), range);
        }
        together
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
