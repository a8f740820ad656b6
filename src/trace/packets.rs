//! Packets against candidates, one by one.

use super::candidates::{Candidate, Form, List, Lists};
use super::contents::{Contents, Everything};
use super::packet::{Packet, Within};
use super::prefetch::Prefetch;
use super::query::{Found, Query};
use crate::geometry::face::Aim;
use crate::geometry::methods::SphereMethod;
use crate::geometry::sphere::Roots;
use crate::geometry::{Bounded, Primitives, Sides, Standard, Test};
use crate::kinds::for_each_kind;
use crate::math::{LaneMask, Lanes, RayBatch, Vec3, map2};
use crate::scene::Scene;

/// Gives `take` what every packet with an active ray has found: its first ray, the active lanes and the answer.
#[inline(always)]
pub fn trace<Q: Query, F: Form, L: Lanes, C: Contents>(
    scene: &Scene,
    candidates: &Lists<F>,
    rays: &RayBatch,
    mut prefetch: Prefetch,
    mut take: impl FnMut(usize, L::Mask, &Q::Found<L>),
) {
    debug_assert!(C::hold(scene));
    // The common kinds as slices, so that where they lie is known outside the loop over the packets.
    let common =
        (&candidates.planes.standard[..], &candidates.spheres.standard[..], &candidates.triangles.standard[..]);
    for at in (0..rays.len).step_by(L::WIDTH) {
        prefetch.step(L::WIDTH / 2);
        let t_max = L::load(&rays.t_max[at..]);
        let active = t_max.ge(L::zero());
        if !active.any() {
            continue;
        }
        let mut found = Q::Found::nothing(t_max, active);
        let packet = Packet {
            // Only boxes need it of rays that share it.
            origin: if C::ALL { rays.origins(at) } else { Vec3::load(&rays.origin, at) },
            direction: Vec3::load(&rays.direction, at),
            t_min: L::load(&rays.t_min[at..]),
            t_max,
        };
        visit::<F, L, Q::Found<L>, C>(scene, candidates, common, &packet, (rays, at), &mut found);
        take(at, active, &found);
    }
}

/// The default lists of the kinds that most scenes have.
type Common<'a, F> = (
    &'a [Candidate<F, crate::geometry::Planes, Standard>],
    &'a [Candidate<F, crate::geometry::Spheres, Standard>],
    &'a [Candidate<F, crate::geometry::Triangles, Standard>],
);

/// Shows every candidate to the query, in rising order of ids, until it is done.
#[inline(always)]
fn visit<F: Form, L: Lanes, A: Found<L>, C: Contents>(
    scene: &Scene,
    lists: &Lists<F>,
    (planes, spheres, triangles): Common<F>,
    packet: &Packet<L>,
    batch: (&RayBatch, usize),
    found: &mut A,
) {
    each::<F, _, _, L, A, C>(Standard, (), planes, packet, found);
    if found.done() {
        return;
    }
    // A loop for each, so that neither pays for the other.
    match scene.spheres.method {
        SphereMethod::Quadratic => each::<F, _, _, L, A, C>(Standard, Roots::Quadratic, spheres, packet, found),
        _ => each::<F, _, _, L, A, C>(Standard, Roots::default(), spheres, packet, found),
    }
    if C::ALL && !lists.spheres.named.is_empty() {
        each_named::<F, _, L, A>(&scene.spheres, &lists.spheres, batch, found);
    }
    if found.done() {
        return;
    }
    if C::TRIANGLES {
        each::<F, _, _, L, A, C>(Standard, Sides::default(), triangles, packet, found);
        if C::ALL && !lists.triangles.named.is_empty() {
            each_named::<F, _, L, A>(&scene.triangles, &lists.triangles, batch, found);
        }
    }
    if C::ALL && lists.more && !found.done() {
        visit_more::<F, L, A>(scene, lists, batch, found);
    }
}

macro_rules! more {
    (
        unbounded { $_p:tt }
        bounded { $_s:tt $_t:tt $(($field:ident: $Storage:ident, $($_f:tt)*))* }
    ) => {
        /// The kinds after the triangles, by rays `at` and on.
        ///
        /// The packet is loaded again, as one that was just written to be passed on is slow to read.
        #[inline(never)]
        fn visit_more<F: Form, L: Lanes, A: Found<L>>(
            scene: &Scene,
            lists: &Lists<F>,
            (rays, at): (&RayBatch, usize),
            found: &mut A,
        ) {
            let packet = &Packet::of(rays, at);
            let faces = Aim::new(packet.direction);
            $(
                each_boxed::<F, _, L, A>(&scene.$field, scene.first.$field, &lists.$field, &faces, packet, found);
                if found.done() {
                    return;
                }
            )*
        }
    };
}
for_each_kind!(more);

/// Shows every primitive of one kind to the query, which is not done yet, until it is.
#[inline(always)]
fn each<F: Form, K: Primitives, T: Test<K>, L: Lanes, A: Found<L>, C: Contents>(
    test: T,
    usual: K::Variant,
    candidates: &[Candidate<F, K, T>],
    packet: &Packet<L>,
    found: &mut A,
) {
    if candidates.is_empty() {
        return;
    }
    let aim = K::aim(packet.direction);
    for (record, variant, id) in candidates {
        // Where nothing is rare, all have the same.
        let variant = if C::ALL { *variant } else { usual };
        let seen = F::seen::<K, T, L>(test, record, variant, packet.origin);
        if let Some((t, inside)) = test.nearest(&seen, variant, &aim, packet.t_min, found.t_max()) {
            found.hit(t, inside, *id);
            if found.done() {
                return;
            }
        }
    }
}

/// [`each`] by the method that was asked for.
#[inline(never)]
fn each_named<F: Form, K: Primitives, L: Lanes, A: Found<L>>(
    kind: &K,
    list: &List<F, K>,
    (rays, at): (&RayBatch, usize),
    found: &mut A,
) {
    if let Some(test) = kind.named() {
        each::<F, K, K::Named, L, A, Everything>(
            test,
            K::Variant::default(),
            &list.named,
            &Packet::of(rays, at),
            found,
        );
    }
}

/// Tests a kind whose hits count only within their boxes, by all methods; see [`super::packet`].
#[inline(always)]
fn each_boxed<F: Form, K: Bounded, L: Lanes, A: Found<L>>(
    kind: &K,
    first: u32,
    list: &List<F, K>,
    faces: &Aim<L>,
    packet: &Packet<L>,
    found: &mut A,
) {
    boxed::<F, K, _, L, A>(Standard, kind, first, &list.standard, faces, packet, found);
    if let Some(test) = kind.named() {
        boxed::<F, K, _, L, A>(test, kind, first, &list.named, faces, packet, found);
    }
}

#[inline(always)]
fn boxed<F: Form, K: Bounded, T: Test<K>, L: Lanes, A: Found<L>>(
    test: T,
    kind: &K,
    first: u32,
    candidates: &[Candidate<F, K, T>],
    faces: &Aim<L>,
    packet: &Packet<L>,
    found: &mut A,
) {
    if candidates.is_empty() {
        return;
    }
    let aim = K::aim(packet.direction);
    for (record, variant, id) in candidates {
        if !K::BOXED {
            let seen = F::seen::<K, T, L>(test, record, *variant, packet.origin);
            if let Some((t, inside)) = test.nearest(&seen, *variant, &aim, packet.t_min, found.t_max()) {
                found.hit(t, inside, *id);
                if found.done() {
                    return;
                }
            }
            continue;
        }
        let bounds = map2(kind.around((id - first) as usize), Vec3::splat);
        let Some(within) = Within::of(bounds, packet.origin, faces, packet.t_min, found.t_max()) else { continue };
        let seen = F::seen::<K, T, L>(test, record, *variant, packet.origin);
        // As far as the ray goes: the box may bring a hit before another that was found.
        if let Some((t, inside)) = test.nearest(&seen, *variant, &aim, within.from(packet.t_min), packet.t_max) {
            let (t, inside) = within.keep(t, inside);
            let inside = inside & t.lt(found.t_max());
            found.hit(t, inside, *id);
            if found.done() {
                return;
            }
        }
    }
}
