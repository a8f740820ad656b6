//! Hits of kinds whose tests say little about their rounding count only within the primitive's box.
//!
//! Next to a quad's edge a grazing ray may be off by any number of ε, and so may the distance; a torus, cone or
//! fractal errs by bounds of its own. A box around the primitive, wider by 32 ε of its farthest corner's distance on all sides,
//! holds all true hits; where a ray misses it there is none, and a distance is kept within it. It also spares most of
//! these tests, which cost more than it. A tree of such boxes then loses no hit.

use crate::bvh::Aabb;
use crate::geometry::face::{Aim, PAD, between};
use crate::math::{LaneMask, Lanes, Vec3};
use crate::scene::Scene;

use super::packets::Packet;

/// A packet before the boxes of a scene.
pub struct Boxes<'a, L> {
    boxes: &'a [Aabb],
    first: u32,
    origin: Vec3<L>,
    aim: Aim<L>,
}

/// Where a packet's rays are in a box.
pub struct Within<L: Lanes> {
    enter: L,
    exit: L,
    met: L::Mask,
}

impl<'a, L: Lanes> Boxes<'a, L> {
    #[inline(always)]
    pub fn new(scene: &'a Scene, packet: &Packet<L>) -> Self {
        let aim = Aim::new(packet.direction);
        Self { boxes: &scene.boxes, first: scene.first.quads, origin: packet.origin, aim }
    }

    /// The box of primitive `id` from `t_min` to `t_max`; `None` when no ray is in it there.
    #[inline(always)]
    pub fn meet(&self, id: u32, t_min: L, t_max: L) -> Option<Within<L>> {
        let Aabb { min, max } = self.boxes[(id - self.first) as usize];
        let (low, high) = (Vec3::splat(min) - self.origin, Vec3::splat(max) - self.origin);
        let pad = low.max_abs().max(high.max_abs()) * L::splat(PAD);
        let pad = Vec3::new(pad, pad, pad);
        let (enter, exit) = between(low - pad, high + pad, &self.aim);
        let met = enter.le(exit) & exit.gt(t_min) & enter.lt(t_max);
        met.any().then_some(Within { enter, exit, met })
    }
}

impl<L: Lanes> Within<L> {
    /// A test's hits that count.
    #[inline(always)]
    pub fn keep(&self, t: L, inside: L::Mask) -> (L, L::Mask) {
        (t.max(self.enter).min(self.exit), inside & self.met)
    }
}
