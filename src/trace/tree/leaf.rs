//! The primitives of a block against the packets of a group.

use crate::bvh::{BLOCK, SphereBlock, TriangleBlock};
use crate::geometry::methods::{SphereMethod, TriangleMethod};
use crate::geometry::sphere::{self, SeenSphere};
use crate::geometry::triangle::{Aim, Flat, covers, covers_ordered, there};
use crate::geometry::{Nearest, Primitives, Sides, SphereRecord, Spheres};
use crate::math::{LaneMask, Lanes, NONE, Vec3, three};
use crate::scene::with_primitive;
use std::ops::Range;
use wide::f32x8;

use super::super::boxes::Boxes;
use super::super::packets::Packet;
use super::Walk;
use super::beam::Beam;

impl Walk<'_> {
    /// The triangles of a block whose boxes the beam meets, one by one; whether any hit was taken.
    #[inline(always)]
    pub fn triangles<L: Lanes, const ANY: bool, const RARE: bool, const MIXED: bool>(
        &mut self,
        block: &TriangleBlock,
        beam: &Beam,
        limit: f32,
        range: Range<usize>,
    ) -> bool {
        if RARE && self.scene.triangles.method != TriangleMethod::Watertight {
            return self.triangles_one_by_one::<L, ANY>(block, range);
        }
        let faces = |axis: usize, near: usize| {
            let [a, b, c] = three([0, 1, 2], |k| f32x8::from(block.corners[k][axis]));
            near_first(near, Lanes::min(a, Lanes::min(b, c)), Lanes::max(a, Lanes::max(b, c)))
        };
        let (_, mut met) = beam.meets::<MIXED>(faces, f32x8::splat(limit));
        let mut taken = false;
        while met != 0 {
            let lane = met.trailing_zeros() as usize & 7;
            met &= met - 1;
            let id = block.id[lane];
            if id == NONE {
                break;
            }
            let corners = block.triangle(lane);
            self.ahead.step(super::group::LINES);
            for at in range.clone().step_by(L::WIDTH) {
                let origin = self.rays.origins::<L>(at);
                let inside = match beam.major {
                    Some(major) => {
                        let origin = origin.ordered(major);
                        let axis =
                            |k: usize, i: usize| L::splat(block.corners[k][(major + 1 + i) % 3][lane]) - origin[i];
                        let seen = three([0, 1, 2], |k| three([0, 1, 2], |i| axis(k, i)));
                        covers_ordered(&seen, self.state.shear(at))
                    }
                    None => {
                        let aim = Aim::new(Vec3::load(&self.rays.direction, at));
                        covers(&three(corners, |c| Vec3::splat(c) - origin), &aim)
                    }
                };
                let Some(inside) = inside else { continue };
                let flat = Flat::of(three(corners, Vec3::from), origin);
                taken |= self.triangle::<L, ANY, RARE>(at, &flat, inside, id);
            }
        }
        taken
    }

    /// The triangles of a block by another method than the default.
    #[inline(never)]
    pub fn triangles_one_by_one<L: Lanes, const ANY: bool>(
        &mut self,
        block: &TriangleBlock,
        range: Range<usize>,
    ) -> bool {
        self.one_by_one::<_, L, ANY>(&self.scene.triangles, self.scene.first.triangles, &block.id, range)
    }

    /// The spheres of a block where they differ in their sides, or have another method than the default.
    #[inline(never)]
    pub fn spheres_one_by_one<L: Lanes, const ANY: bool>(&mut self, block: &SphereBlock, range: Range<usize>) -> bool {
        self.one_by_one::<_, L, ANY>(&self.scene.spheres, self.scene.first.spheres, &block.id, range)
    }

    #[inline(always)]
    fn one_by_one<K: Primitives, L: Lanes, const ANY: bool>(
        &mut self,
        kind: &K,
        first: u32,
        ids: &[u32; BLOCK],
        range: Range<usize>,
    ) -> bool {
        let mut taken = false;
        for &id in ids.iter().take_while(|&&id| id != NONE) {
            let record = kind.record((id - first) as usize);
            taken |= self.packets::<K, L, ANY>(&record, range.clone(), id, K::nearest::<L, true>);
        }
        taken
    }

    /// Takes the hits of a triangle that packet `at` passes through where `inside` is true.
    #[inline(always)]
    pub fn triangle<L: Lanes, const ANY: bool, const RARE: bool>(
        &mut self,
        at: usize,
        flat: &Flat<L>,
        inside: L::Mask,
        id: u32,
    ) -> bool {
        let direction = Vec3::load(&self.rays.direction, at);
        let (t, mut inside) = flat.distance(direction, inside);
        if RARE && self.scene.triangles.one_sided {
            inside = inside
                & there(self.scene.triangles.sides[(id - self.scene.first.triangles) as usize], flat.n.dot(direction));
        }
        let inside = inside & t.gt(L::load(&self.rays.t_min[at..]));
        inside.any() && self.state.take::<L, ANY>(at, t, inside, id)
    }

    /// The same for spheres.
    #[inline(always)]
    pub fn spheres<L: Lanes, const ANY: bool, const RARE: bool, const MIXED: bool>(
        &mut self,
        block: &SphereBlock,
        beam: &Beam,
        limit: f32,
        range: Range<usize>,
    ) -> bool {
        let Some(side) = self.sphere_side::<RARE>() else {
            return self.spheres_one_by_one::<L, ANY>(block, range);
        };
        let radius = f32x8::from(block.radius);
        let faces = |axis: usize, near: usize| {
            let center = f32x8::from(block.center[axis]);
            near_first(near, center - radius, center + radius)
        };
        let (_, mut met) = beam.meets::<MIXED>(faces, f32x8::splat(limit));
        let mut taken = false;
        while met != 0 {
            let lane = met.trailing_zeros() as usize & 7;
            met &= met - 1;
            let id = block.id[lane];
            if id == NONE {
                break;
            }
            taken |= self.sphere::<L, ANY, RARE>(&sphere_of(block, lane, side), range.clone(), id);
        }
        taken
    }

    /// The side of all spheres that is there; `None` where they differ, or have another method than the default.
    #[inline(always)]
    pub fn sphere_side<const RARE: bool>(&self) -> Option<Sides> {
        if RARE { self.scene.spheres.common_side() } else { Some(Sides::Both) }
    }

    /// A sphere against the packets of a range, by the default method.
    #[inline(always)]
    pub fn sphere<L: Lanes, const ANY: bool, const RARE: bool>(
        &mut self,
        record: &SphereRecord,
        range: Range<usize>,
        id: u32,
    ) -> bool {
        self.packets::<Spheres, L, ANY>(record, range, id, |seen, &d, t_min, t_max| {
            default_sphere::<L, RARE>(seen, d, t_min, t_max)
        })
    }

    /// Primitive `id` against the packets of a range.
    #[inline(always)]
    fn packets<K: Primitives, L: Lanes, const ANY: bool>(
        &mut self,
        record: &K::Record,
        range: Range<usize>,
        id: u32,
        test: impl Fn(&K::Seen<L>, &K::Aim<L>, L, L) -> Nearest<L>,
    ) -> bool {
        let mut taken = false;
        for at in range.step_by(L::WIDTH) {
            let seen = K::seen::<L>(record, self.rays.origins(at));
            let aim = K::aim(Vec3::load(&self.rays.direction, at));
            let t_min = L::load(&self.rays.t_min[at..]);
            // As far as the ray goes: what was found may be as near with a higher id.
            if let Some((t, inside)) = test(&seen, &aim, t_min, L::splat(f32::INFINITY)) {
                taken |= self.state.take::<L, ANY>(at, t, inside, id);
            }
        }
        taken
    }

    /// All other kinds.
    #[inline(never)]
    pub fn others<L: Lanes, const ANY: bool>(&mut self, block: usize, range: Range<usize>) -> bool {
        let mut taken = false;
        // No child counts as one without a block; a beam with infinite numbers may meet it.
        let Some(block) = self.bvh.others.get(block) else { return false };
        for id in block.id.into_iter().take_while(|&id| id != NONE) {
            taken |= with_primitive!(self.scene, id, |kind, i| self.other::<_, L, ANY>(kind, i, range.clone(), id));
        }
        taken
    }

    #[inline(always)]
    fn other<K: Primitives, L: Lanes, const ANY: bool>(
        &mut self,
        kind: &K,
        i: usize,
        range: Range<usize>,
        id: u32,
    ) -> bool {
        let record = kind.record(i);
        let mut taken = false;
        for at in range.step_by(L::WIDTH) {
            let packet = Packet {
                origin: self.rays.origins(at),
                direction: Vec3::load(&self.rays.direction, at),
                t_min: L::load(&self.rays.t_min[at..]),
                t_max: L::load(&self.rays.t_max[at..]),
            };
            let t_max = packet.t_max;
            let Some(within) = Boxes::new(self.scene, &packet).meet(id, packet.t_min, t_max) else { continue };
            let seen = K::seen::<L>(&record, packet.origin);
            let aim = K::aim(packet.direction);
            if let Some((t, inside)) = K::nearest::<L, true>(&seen, &aim, packet.t_min, t_max) {
                let (t, inside) = within.keep(t, inside);
                taken |= self.state.take::<L, ANY>(at, t, inside, id);
            }
        }
        taken
    }
}

/// A sphere of a block by the default's method.
#[inline(always)]
pub fn sphere_of(block: &SphereBlock, lane: usize, sides: Sides) -> SphereRecord {
    let center = Vec3 { x: block.center[0][lane], y: block.center[1][lane], z: block.center[2][lane] };
    SphereRecord { center, radius: block.radius[lane], sides, method: SphereMethod::Stable }
}

/// The default's test, of a sphere of any side where `RARE`.
#[inline(always)]
pub fn default_sphere<L: Lanes, const RARE: bool>(seen: &SeenSphere<L>, d: Vec3<L>, t_min: L, t_max: L) -> Nearest<L> {
    if RARE { sphere::one_sided(seen, d, t_min, t_max) } else { sphere::stable(seen, d, t_min, t_max) }
}

/// The near end first.
#[inline(always)]
fn near_first(near: usize, least: f32x8, most: f32x8) -> [f32x8; 2] {
    if near == 0 { [least, most] } else { [most, least] }
}
