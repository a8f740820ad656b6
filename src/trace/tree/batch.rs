//! A batch's way through the tree: together, in parts, or one by one.

use super::beams::{Beams, Ends, RAYS, far_apart};
use super::bits::Bits;
use super::edges::Shears;
use super::state::State;
use super::walk::Walk;
use crate::bvh::{Bvh, Places};
use crate::geometry::{Planes, Primitives};
use crate::math::{LaneMask, Lanes, RayBatch, Vec3};
use crate::scene::Scene;
use crate::trace::bounds::Bounds;
use crate::trace::prefetch::Prefetch;
use crate::trace::query::{Found, Query};

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
pub(super) fn answer<Q: Query, L: Lanes>(
    scene: &Scene,
    bvh: &Bvh,
    rays: &RayBatch,
    prefetch: Prefetch,
    bounds: impl FnOnce() -> Option<Bounds>,
    state: &mut State,
) {
    state.start::<L::Wider>(rays);
    let mut walk = Walk { scene, bvh, places: Places::of(bvh), rays, prefetch, state };
    if !scene.planes.is_empty() {
        let Some(bounds) = bounds() else { return };
        walk.planes::<Q, L>(&bounds);
    }
    walk.rays::<Q, L::Wider>();
}

impl Walk<'_> {
    /// Traces all rays: the beams that are narrow together, the rays of the others each with its own interval.
    fn rays<Q: Query, L: Lanes>(&mut self) {
        let ends = Ends::of(self.rays, self.state);
        let scene = self.scene;
        let triangles = scene.triangles.len() > scene.spheres.len() + scene.boxes.len();
        let [narrow, wide] = ends.narrow(self.bvh, far_apart(self.rays.common_origin, triangles));
        if narrow != 0 {
            let mut beams = Beams::new(&ends, narrow, self.bvh, self.rays.common_origin);
            if let (true, false, Some(major)) =
                (self.rays.common_origin, self.scene.triangles.is_empty(), beams.whole.major)
            {
                beams.shears = Some(Shears::of(&ends.directions, narrow, major));
            }
            self.beams::<Q, L>(&beams, narrow);
        }
        for p in Bits(wide) {
            self.state.lines.prepare(self.rays, self.bvh, RAYS * p..RAYS * (p + 1));
            self.packet::<Q>(RAYS * p);
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
