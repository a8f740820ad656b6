//! Packets against candidates, one by one.

use super::ahead::Ahead;
use super::boxes::Boxes;
use super::candidates::{Form, Lists};
use super::query::{Any, Nearest, Query};
use crate::geometry::{Cones, Cuboids, Cylinders, Fractals, Planes, Primitives, Quads, Spheres, Tori, Triangles};
use crate::math::{LaneMask, Lanes, RayBatch, Vec3};
use crate::scene::Scene;

/// A packet's rays, as the primitives' tests take them.
#[derive(Clone, Copy)]
pub(super) struct Packet<L> {
    pub origin: Vec3<L>,
    pub direction: Vec3<L>,
    pub t_min: L,
    pub t_max: L,
}

/// The candidates; the common kinds as slices, so that where they lie is known outside the loop over the packets.
struct Found<'a, F: Form> {
    planes: &'a [(F::Of<Planes>, u32)],
    spheres: &'a [(F::Of<Spheres>, u32)],
    triangles: &'a [(F::Of<Triangles>, u32)],
    lists: &'a Lists<F>,
}

impl<'a, F: Form> Found<'a, F> {
    #[inline(always)]
    fn of(lists: &'a Lists<F>) -> Self {
        Self { planes: &lists.planes, spheres: &lists.spheres, triangles: &lists.triangles, lists }
    }

    /// Shows every candidate to the query, in rising order of ids, until it is done.
    ///
    /// `MESH` says that there are triangles, `RARE` that there is more than those, planes and spheres, or something seen
    /// from one side alone.
    #[inline(always)]
    fn visit<L: Lanes, Q: Query<L>, const RARE: bool, const MESH: bool>(
        &self,
        scene: &Scene,
        packet: Packet<L>,
        query: &mut Q,
    ) {
        each::<F, Planes, L, Q, RARE>(self.planes, &packet, query);
        if query.done() {
            return;
        }
        each::<F, Spheres, L, Q, RARE>(self.spheres, &packet, query);
        if query.done() {
            return;
        }
        if MESH {
            each::<F, Triangles, L, Q, RARE>(self.triangles, &packet, query);
        }
        if RARE && self.lists.more && !query.done() {
            self.lists.visit_rare(scene, &packet, query);
        }
    }
}

impl<F: Form> Lists<F> {
    #[inline(never)]
    fn visit_rare<L: Lanes, Q: Query<L>>(&self, scene: &Scene, packet: &Packet<L>, query: &mut Q) {
        let boxes = Boxes::new(scene, packet);
        each_boxed::<F, Quads, L, Q>(&self.quads, &boxes, packet, query);
        if query.done() {
            return;
        }
        each_boxed::<F, Cuboids, L, Q>(&self.cuboids, &boxes, packet, query);
        if query.done() {
            return;
        }
        each_boxed::<F, Cylinders, L, Q>(&self.cylinders, &boxes, packet, query);
        if query.done() {
            return;
        }
        each_boxed::<F, Cones, L, Q>(&self.cones, &boxes, packet, query);
        if query.done() {
            return;
        }
        each_boxed::<F, Tori, L, Q>(&self.tori, &boxes, packet, query);
        if query.done() {
            return;
        }
        each_boxed::<F, Fractals, L, Q>(&self.fractals, &boxes, packet, query);
    }
}

/// Shows every primitive of one kind to the query, which is not done yet, until it is.
#[inline(always)]
fn each<F: Form, K: Primitives, L: Lanes, Q: Query<L>, const SIDED: bool>(
    records: &[(F::Of<K>, u32)],
    packet: &Packet<L>,
    query: &mut Q,
) {
    if records.is_empty() {
        return;
    }
    let aim = K::aim(packet.direction);
    for (record, id) in records {
        let seen = F::seen::<K, L>(record, packet.origin);
        if let Some((t, inside)) = K::nearest::<L, SIDED>(&seen, &aim, packet.t_min, query.t_max()) {
            query.hit(t, inside, *id);
            if query.done() {
                return;
            }
        }
    }
}

/// The same for a kind whose hits count only within their boxes; see [`super::boxes`].
#[inline(always)]
fn each_boxed<F: Form, K: Primitives, L: Lanes, Q: Query<L>>(
    records: &[(F::Of<K>, u32)],
    boxes: &Boxes<L>,
    packet: &Packet<L>,
    query: &mut Q,
) {
    if records.is_empty() {
        return;
    }
    let aim = K::aim(packet.direction);
    for (record, id) in records {
        let Some(within) = boxes.meet(*id, packet.t_min, query.t_max()) else { continue };
        let seen = F::seen::<K, L>(record, packet.origin);
        // As far as the ray goes: the box may bring a hit before another that was found.
        if let Some((t, inside)) = K::nearest::<L, true>(&seen, &aim, packet.t_min, packet.t_max) {
            let (t, inside) = within.keep(t, inside);
            let inside = inside & t.lt(query.t_max());
            query.hit(t, inside, *id);
            if query.done() {
                return;
            }
        }
    }
}

/// Gives `take` the nearest hits of every packet with an active ray: its first ray, the active lanes and the answer.
#[inline(always)]
pub fn nearest<F: Form, L: Lanes, const RARE: bool, const MESH: bool>(
    scene: &Scene,
    candidates: &Lists<F>,
    rays: &RayBatch,
    mut ahead: Ahead,
    mut take: impl FnMut(usize, L::Mask, &Nearest<L>),
) {
    let candidates = Found::of(candidates);
    for at in (0..rays.len).step_by(L::WIDTH) {
        ahead.step(L::WIDTH / 2);
        let t_max = L::load(&rays.t_max[at..]);
        let active = t_max.ge(L::zero());
        if !active.any() {
            continue;
        }
        // Nothing lies before −∞, so inactive lanes take no hit.
        let mut query = Nearest::new(t_max.select(active, L::splat(f32::NEG_INFINITY)));
        candidates.visit::<L, _, RARE, MESH>(scene, packet::<L, RARE>(rays, at), &mut query);
        take(at, active, &query);
    }
}

/// Gives `take` the blocked lanes of every packet with an active ray: its first ray, the active lanes, the blocked
/// ones (inactive lanes may be either).
#[inline(always)]
pub fn any<F: Form, L: Lanes, const RARE: bool, const MESH: bool>(
    scene: &Scene,
    candidates: &Lists<F>,
    rays: &RayBatch,
    mut ahead: Ahead,
    mut take: impl FnMut(usize, L::Mask, L::Mask),
) {
    let candidates = Found::of(candidates);
    for at in (0..rays.len).step_by(L::WIDTH) {
        ahead.step(L::WIDTH / 2);
        let t_max = L::load(&rays.t_max[at..]);
        let active = t_max.ge(L::zero());
        if !active.any() {
            continue;
        }
        let mut query = Any { settled: !active, t_max };
        candidates.visit::<L, _, RARE, MESH>(scene, packet::<L, RARE>(rays, at), &mut query);
        take(at, active, query.settled);
    }
}

#[inline(always)]
fn packet<L: Lanes, const RARE: bool>(rays: &RayBatch, at: usize) -> Packet<L> {
    Packet {
        // Only boxes need it of rays that share it.
        origin: if RARE { rays.origins(at) } else { Vec3::load(&rays.origin, at) },
        direction: Vec3::load(&rays.direction, at),
        t_min: L::load(&rays.t_min[at..]),
        t_max: L::load(&rays.t_max[at..]),
    }
}
