//! A packet of rays, and the box that a hit has to lie in.
//!
//! Hits of kinds whose tests say little about their rounding count only within the primitive's box
//! ([`Bounded::BOXED`]). Next to a quad's or disc's edge a grazing ray may be off by any number of ε, and so may the
//! distance; a torus, cone or fractal errs by bounds of its own. A box around the primitive, wider by 32 ε of its
//! farthest corner's distance on all sides, holds all true hits; where a ray misses it there is none, and a distance is
//! kept within it. It also spares most of these tests, which cost more than it. A tree of such boxes then loses no hit.

use crate::geometry::face::{Aim, PAD, between};
use crate::geometry::{Bounded, LaneHits, Test};
use crate::math::{LaneMask, Lanes, RayBatch, Vec3};

/// A packet's rays, as the primitives' tests take them.
#[derive(Clone, Copy)]
pub struct Packet<L> {
    pub origin: Vec3<L>,
    pub direction: Vec3<L>,
    pub t_min: L,
    pub t_max: L,
}

impl<L: Lanes> Packet<L> {
    /// Rays `at` to `at + L::WIDTH`.
    #[inline(always)]
    pub fn of(rays: &RayBatch, at: usize) -> Self {
        Self {
            origin: rays.origins(at),
            direction: Vec3::load(&rays.direction, at),
            t_min: L::load(&rays.t_min[at..]),
            t_max: L::load(&rays.t_max[at..]),
        }
    }
}

impl Packet<f32> {
    /// Ray `i` in every lane.
    #[inline(always)]
    pub fn splat<L: Lanes>(rays: &RayBatch, i: usize) -> Packet<L> {
        let one = Packet::<f32>::of(rays, i);
        Packet {
            origin: Vec3::splat(one.origin.into()),
            direction: Vec3::splat(one.direction.into()),
            t_min: L::splat(one.t_min),
            t_max: L::splat(one.t_max),
        }
    }
}

/// Where a packet's rays are in a box.
pub struct Within<L: Lanes> {
    enter: L,
    exit: L,
    met: L::Mask,
}

impl<L: Lanes> Within<L> {
    /// In the box around a primitive from `t_min` to `t_max`; `None` when no ray is in it there.
    #[inline(always)]
    pub fn of([min, max]: [Vec3<L>; 2], origin: Vec3<L>, aim: &Aim<L>, t_min: L, t_max: L) -> Option<Self> {
        let (low, high) = (min - origin, max - origin);
        let pad = low.max_abs().max(high.max_abs()) * L::splat(PAD);
        let pad = Vec3::new(pad, pad, pad);
        let (enter, exit) = between(low - pad, high + pad, aim);
        let met = enter.le(exit) & exit.gt(t_min) & enter.lt(t_max);
        met.any().then_some(Self { enter, exit, met })
    }

    /// From where on a test has to look: what it puts before the box is met where the box is, so that `t_min` matters only
    /// in there.
    #[inline(always)]
    pub fn from(&self, t_min: L) -> L {
        t_min.min(L::zero()).select(self.enter.gt(t_min), t_min)
    }

    /// A test's hits that count.
    #[inline(always)]
    pub fn keep(&self, t: L, inside: L::Mask) -> (L, L::Mask) {
        (t.max(self.enter).min(self.exit), inside & self.met)
    }
}

/// The hits of a packet with a primitive, or with one in every lane, that count. `faces` are the packet's for boxes; of
/// account only for kinds whose hits those bound.
#[inline(always)]
pub fn hits<K: Bounded, T: Test<K>, L: Lanes>(
    test: T,
    shape: &K::Shape<L>,
    variant: K::Variant,
    packet: &Packet<L>,
    faces: &Aim<L>,
) -> LaneHits<L> {
    if !K::BOXED {
        let seen = test.seen(shape, variant, packet.origin);
        // As far as the ray goes: what was found may be as near with a higher id.
        return test.nearest(&seen, variant, &K::aim(packet.direction), packet.t_min, L::splat(f32::INFINITY));
    }
    let within = Within::of(K::extent(shape), packet.origin, faces, packet.t_min, packet.t_max)?;
    let seen = test.seen(shape, variant, packet.origin);
    // As far as the ray goes: the box may bring a hit before another that was found.
    let (t, inside) =
        test.nearest(&seen, variant, &K::aim(packet.direction), within.from(packet.t_min), packet.t_max)?;
    let (t, inside) = within.keep(t, inside);
    inside.any().then_some((t, inside))
}
