//! Packets against candidates, one by one.

use super::candidates::{Lists, Record};
use super::query::{Any, Nearest, Query};
use super::seen::Seen;
use crate::geometry::plane::{self, SeenPlane};
use crate::geometry::sphere::{self, SeenSphere};
use crate::geometry::triangle::{self, SeenTriangle};
use crate::math::{LaneMask, Lanes, RayBatch, Vec3};

/// Everything a packet may meet.
pub trait Candidates<L: Lanes> {
    /// Shows every candidate to the query, in rising order of ids, until it is done.
    fn visit<Q: Query<L>>(&self, origin: Vec3<L>, direction: Vec3<L>, t_min: L, query: &mut Q);
}

impl<L, P, S, T> Candidates<L> for Lists<P, S, T>
where
    L: Lanes,
    P: Seen<L, As = SeenPlane<L>>,
    S: Seen<L, As = SeenSphere<L>>,
    T: Seen<L, As = SeenTriangle<L>>,
{
    #[inline(always)]
    fn visit<Q: Query<L>>(&self, o: Vec3<L>, d: Vec3<L>, t_min: L, query: &mut Q) {
        each(&self.planes, query, |seen, t_max| plane::nearest(&seen.from(o), d, t_min, t_max));
        if query.done() {
            return;
        }
        each(&self.spheres, query, |seen, t_max| sphere::stable(&seen.from(o), d, t_min, t_max));
        if query.done() {
            return;
        }
        each(&self.triangles, query, |seen, t_max| triangle::moller_trumbore(&seen.from(o), d, t_min, t_max));
    }
}

/// Shows every primitive of one kind to the query.
#[inline(always)]
fn each<L: Lanes, T, Q: Query<L>>(
    records: &[Record<T>],
    query: &mut Q,
    test: impl Fn(&T, L) -> crate::geometry::Nearest<L>,
) {
    for (record, id) in records {
        if let Some((t, inside)) = test(record, query.t_max()) {
            query.hit(t, inside, *id);
            if query.done() {
                return;
            }
        }
    }
}

/// Gives `take` the nearest hits of every packet with an active ray: its first ray, the active lanes and the answer.
#[inline(always)]
pub fn nearest<L: Lanes>(
    candidates: &impl Candidates<L>,
    rays: &RayBatch,
    mut take: impl FnMut(usize, L::Mask, &Nearest<L>),
) {
    for at in (0..rays.len).step_by(L::WIDTH) {
        let t_max = L::load(&rays.t_max[at..]);
        let active = t_max.ge(L::zero());
        if !active.any() {
            continue;
        }
        // Nothing lies before −∞, so inactive lanes take no hit.
        let mut query = Nearest::new(t_max.select(active, L::splat(f32::NEG_INFINITY)));
        let (o, d) = (Vec3::load(&rays.origin, at), Vec3::load(&rays.direction, at));
        candidates.visit(o, d, L::load(&rays.t_min[at..]), &mut query);
        take(at, active, &query);
    }
}

/// Gives `take` the blocked lanes of every packet with an active ray: its first ray, the active lanes, the blocked
/// ones (inactive lanes may be either).
#[inline(always)]
pub fn any<L: Lanes>(candidates: &impl Candidates<L>, rays: &RayBatch, mut take: impl FnMut(usize, L::Mask, L::Mask)) {
    for at in (0..rays.len).step_by(L::WIDTH) {
        let t_max = L::load(&rays.t_max[at..]);
        let active = t_max.ge(L::zero());
        if !active.any() {
            continue;
        }
        let mut query = Any { settled: !active, t_max };
        let (o, d) = (Vec3::load(&rays.origin, at), Vec3::load(&rays.direction, at));
        candidates.visit(o, d, L::load(&rays.t_min[at..]), &mut query);
        take(at, active, query.settled);
    }
}
