//! Sixteen groups of sixteen rays: a beam around each, a beam a lane.

use super::beam::{Beam, PAD, TINY};
use super::edges::Shears;
use super::state::State;
use crate::bvh::{Bvh, Node};
use crate::math::{BATCH, LaneMask, Lanes, RayBatch, map2, map3};
use glam::Vec3;
use wide::{f32x8, f32x16};

/// Rays of a beam.
pub const RAYS: usize = BATCH / 16;
/// How far apart a beam's directions may be along any axis.
const WIDEST: f32 = 0.5;
/// How far apart they may be at the far side of the scene, in sizes of the tree's blocks.
const FAR: f32 = 20.0;
/// The same for a common origin, from where rays spread before they meet anything: among triangles, of which edges tell the
/// beams apart, and among others. (Shadow rays of 7,381 spheres lose 18 % by the former, eye rays of a sphere of a million
/// triangles 23 % by the latter.)
const FAR_FROM_ONE: [f32; 2] = [6.0, 3.0];
/// How far apart the origins may be.
const NEAR: f32 = 0.75;

/// How far apart the rays of a beam may be at the far side of a scene, of which most primitives are triangles or not.
pub fn far_apart(common_origin: bool, triangles: bool) -> f32 {
    if common_origin { FAR_FROM_ONE[usize::from(!triangles)] } else { FAR }
}

/// The least and the greatest of what each beam's rays have that are not done, by axis.
pub struct Ends {
    origins: [[f32x16; 3]; 2],
    pub directions: [[f32x16; 3]; 2],
    /// How far each beam's rays look.
    limits: f32x16,
    /// Beams with a ray that looks.
    active: u32,
}

impl Ends {
    /// Of a batch, of whose rays the state has how far they look.
    #[inline(never)]
    pub fn of(rays: &RayBatch, state: &State) -> Self {
        let looks = Looks::of(rays.len, state);
        let both = |columns: &[[f32; BATCH]; 3]| {
            let [x, y, z] = [looks.ends(&columns[0]), looks.ends(&columns[1]), looks.ends(&columns[2])];
            [[x[0], y[0], z[0]], [x[1], y[1], z[1]]]
        };
        let origins = match rays.common_origin {
            true => [map3(rays.first_origin().to_array(), f32x16::splat); 2],
            false => both(&rays.origin),
        };
        let limits = looks.greatest(&state.t);
        let active = LaneMask::bits(Lanes::ge(limits, f32x16::ZERO));
        Self { origins, directions: both(&rays.direction), limits, active }
    }

    /// The beams that are narrow enough for their rays to go on together, no further apart than `far` from [`far_apart`], and
    /// the others; only of those with rays.
    pub fn narrow(&self, bvh: &Bvh, far: f32) -> [u32; 2] {
        let greatest = |[x, y, z]: [f32x16; 3]| Lanes::max(x, Lanes::max(y, z));
        let apart = |[low, high]: &[[f32x16; 3]; 2]| greatest(map3([0, 1, 2], |axis| high[axis] - low[axis]));
        let (min, max) = (bvh.bounds.min.to_array(), bvh.bounds.max.to_array());
        let [from, to] = &self.origins;
        let away = greatest(map3([0, 1, 2], |axis| {
            Lanes::max(f32x16::splat(max[axis]) - from[axis], to[axis] - f32x16::splat(min[axis]))
        }));
        let size = f32x16::splat((bvh.bounds.max - bvh.bounds.min).max_element());
        let spread = apart(&self.directions);
        let spread_far = spread * Lanes::max(size, away);
        let near = apart(&self.origins);
        let grain = |times: f32| f32x16::splat(times * bvh.grain);
        // NaN fails these.
        let narrow =
            Lanes::lt(spread, f32x16::splat(WIDEST)) & Lanes::lt(spread_far, grain(far)) & Lanes::le(near, grain(NEAR));
        let narrow = LaneMask::bits(narrow);
        [self.active & narrow, self.active & !narrow]
    }
}

/// Which rays of each beam look.
struct Looks {
    rays: [f32x16; 16],
    /// Whether all do.
    full: bool,
}

impl Looks {
    /// Of a batch of `len` rays.
    #[inline(always)]
    fn of(len: usize, state: &State) -> Self {
        let mut looks = Self { rays: [LaneMask::from_bits(0); 16], full: true };
        for (p, rays) in looks.rays.iter_mut().enumerate() {
            if RAYS * p < len {
                *rays = Lanes::ge(f32x16::load(&state.t[RAYS * p..]), f32x16::ZERO);
            }
            looks.full &= LaneMask::all(*rays);
        }
        looks
    }

    /// The least and the greatest number of each beam's rays that look, a beam a lane; ∞ and −∞ where none does.
    #[inline(never)]
    fn ends(&self, column: &[f32; BATCH]) -> [f32x16; 2] {
        [across(self.rows(column, f32::INFINITY), Lanes::min), across(self.rows(column, f32::NEG_INFINITY), Lanes::max)]
    }

    /// The greatest alone.
    #[inline(never)]
    fn greatest(&self, column: &[f32; BATCH]) -> f32x16 {
        across(self.rows(column, f32::NEG_INFINITY), Lanes::max)
    }

    /// A beam's numbers a row, `none` for rays that do not look.
    #[inline(always)]
    fn rows(&self, column: &[f32; BATCH], none: f32) -> [f32x16; 16] {
        let mut rows = [f32x16::ZERO; 16];
        for (p, row) in rows.iter_mut().enumerate() {
            *row = f32x16::load(&column[RAYS * p..]);
        }
        if !self.full {
            for (row, looks) in rows.iter_mut().zip(self.rays) {
                *row = Lanes::select(*row, looks, f32x16::splat(none));
            }
        }
        rows
    }
}

/// Lane p is what `op` leaves of the sixteen numbers of row p. Every step halves the rows; it moves numbers within one row
/// only, which costs half of a transposition.
#[inline(always)]
fn across(rows: [f32x16; 16], op: impl Fn(f32x16, f32x16) -> f32x16 + Copy) -> f32x16 {
    let [a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p] = rows;
    let two = |a, b| fold::<1>(a, b, op);
    let four = |a, b, c, d| fold::<2>(two(a, b), two(c, d), op);
    let eight = |a, b| fold::<4>(a, b, op);
    fold::<8>(eight(four(a, b, c, d), four(e, f, g, h)), eight(four(i, j, k, l), four(m, n, o, p)), op)
}

/// Lane i is what `op` leaves of lanes i and i ^ D, of `b` where i has bit D and of `a` elsewhere.
#[inline(always)]
fn fold<const D: usize>(a: f32x16, b: f32x16, op: impl Fn(f32x16, f32x16) -> f32x16) -> f32x16 {
    let of_b: f32x16 = LaneMask::from_bits(match D {
        1 => 0xaaaa,
        2 => 0xcccc,
        4 => 0xf0f0,
        _ => 0xff00,
    });
    let (stays, v) = (Lanes::select(b, of_b, a), Lanes::select(a, of_b, b).to_array());
    // Written out, as only so the compiler sees a permutation.
    #[rustfmt::skip]
    let moved = match D {
        1 => [v[1], v[0], v[3], v[2], v[5], v[4], v[7], v[6], v[9], v[8], v[11], v[10], v[13], v[12], v[15], v[14]],
        2 => [v[2], v[3], v[0], v[1], v[6], v[7], v[4], v[5], v[10], v[11], v[8], v[9], v[14], v[15], v[12], v[13]],
        4 => [v[4], v[5], v[6], v[7], v[0], v[1], v[2], v[3], v[12], v[13], v[14], v[15], v[8], v[9], v[10], v[11]],
        _ => [v[8], v[9], v[10], v[11], v[12], v[13], v[14], v[15], v[0], v[1], v[2], v[3], v[4], v[5], v[6], v[7]],
    };
    op(stays, f32x16::new(moved))
}

/// The beams as boxes are tested with them; the numbers are those of [`Beam`], a beam a lane.
pub struct Beams {
    near: [(f32x16, f32x16); 3],
    far: [(f32x16, f32x16); 3],
    /// Beams that run along an axis' negative side, and beams of whose rays some do.
    behind: [f32x16; 3],
    both: [f32x16; 3],
    side: [usize; 3],
    /// Whether along some axis not all run to the same side.
    pub mixed: bool,
    /// Around all of them.
    pub whole: Beam,
    /// How far each looks, −∞ for beams that are not there.
    pub limits: f32x16,
    /// Their shears, where all start at one point and have the largest component along one axis.
    pub shears: Option<Shears>,
}

impl Beams {
    /// The beams whose bits are set.
    pub fn new(ends: &Ends, lanes: u32, bvh: &Bvh, common_origin: bool) -> Self {
        let Ends { origins: [o_min, o_max], directions: [d_min, d_max], .. } = ends;
        let there: f32x16 = LaneMask::from_bits(lanes);
        let least = |v: &[f32x16; 3]| {
            Vec3::from_array(map3(*v, |v| Lanes::select(v, there, f32x16::splat(f32::INFINITY)).least()))
        };
        let greatest = |v: &[f32x16; 3]| {
            Vec3::from_array(map3(*v, |v| Lanes::select(v, there, f32x16::splat(f32::NEG_INFINITY)).greatest()))
        };
        let origins = match common_origin {
            true => [Vec3::from_array(map3(*o_min, |v| v.as_array()[0])); 2],
            false => [least(o_min), greatest(o_max)],
        };
        let directions = [least(d_min), greatest(d_max)];
        let whole = Beam::new(origins, directions, bvh);
        let pad = f32x16::splat(PAD * Beam::reach(origins, bvh));
        let zero = f32x16::ZERO;
        let mut beams = Self {
            near: [(zero, zero); 3],
            far: [(zero, zero); 3],
            behind: [zero; 3],
            both: [zero; 3],
            side: [0; 3],
            mixed: false,
            whole,
            limits: Lanes::select(ends.limits, there, f32x16::splat(f32::NEG_INFINITY)),
            shears: None,
        };
        for axis in 0..3 {
            let (least, most) = (d_min[axis], d_max[axis]);
            let (above, below) = (Lanes::ge(least, f32x16::splat(TINY)), Lanes::le(most, f32x16::splat(-TINY)));
            let both = !(above | below);
            // Across zero, the inverses of the ends bound those of all.
            let r = f32x16::ONE / Lanes::select(Lanes::max(most, f32x16::splat(TINY)), both, most);
            let q = f32x16::ONE / Lanes::select(Lanes::min(least, f32x16::splat(-TINY)), both, least);
            let (low, high) = ((r, (o_max[axis] + pad) * r), (q, (o_min[axis] - pad) * q));
            let pick = |a: f32x16, b: f32x16| Lanes::select(a, below, b);
            beams.near[axis] = (pick(high.0, low.0), pick(high.1, low.1));
            beams.far[axis] = (pick(low.0, high.0), pick(low.1, high.1));
            (beams.behind[axis], beams.both[axis]) = (below, both);
            let below = LaneMask::bits(below) & lanes;
            beams.side[axis] = usize::from(below != 0);
            beams.mixed |= LaneMask::bits(both) & lanes != 0 || (below != 0 && below != lanes);
        }
        beams
    }

    /// One of them alone.
    #[inline(always)]
    pub fn one(&self, lane: usize) -> Beam {
        let pick = |v: &f32x16| f32x8::splat(v.as_array()[lane & 15]);
        let pair = |(a, b): &(f32x16, f32x16)| (pick(a), pick(b));
        let bit = |mask: &f32x16| LaneMask::bits(*mask) >> lane & 1 != 0;
        let both = [bit(&self.both[0]), bit(&self.both[1]), bit(&self.both[2])];
        Beam {
            near: [pair(&self.near[0]), pair(&self.near[1]), pair(&self.near[2])],
            far: [pair(&self.far[0]), pair(&self.far[1]), pair(&self.far[2])],
            side: map3([0, 1, 2], |axis| usize::from(bit(&self.behind[axis]))),
            both,
            mixed: both[0] | both[1] | both[2],
            major: self.whole.major,
        }
    }

    /// The beams that meet a box no later than at `limits`; `faces` are its two coordinates along an axis, and `MIXED` may be
    /// false where [`Beams::mixed`] is.
    #[inline(always)]
    pub fn meets<const MIXED: bool>(&self, faces: impl Fn(usize) -> [f32; 2], limits: f32x16) -> u32 {
        let mut enter = f32x16::ZERO;
        let mut exit = limits;
        for axis in 0..3 {
            let ((r, a), (q, b)) = (self.near[axis], self.far[axis]);
            let faces = faces(axis);
            if MIXED {
                let [low, high] = map2(faces, f32x16::splat);
                let (near, far) =
                    (Lanes::select(high, self.behind[axis], low), Lanes::select(low, self.behind[axis], high));
                let (near, far) = (near.mul_sub(r, a), far.mul_sub(q, b));
                let both = self.both[axis];
                enter = Lanes::max(near, enter);
                enter = Lanes::max(Lanes::select(far, both, enter), enter);
                exit = Lanes::min(Lanes::select(exit, both, far), exit);
            } else {
                let side = self.side[axis] & 1;
                // What is NaN (∞ − ∞) is passed over.
                enter = Lanes::max(f32x16::splat(faces[side]).mul_sub(r, a), enter);
                exit = Lanes::min(f32x16::splat(faces[side ^ 1]).mul_sub(q, b), exit);
            }
        }
        LaneMask::bits(Lanes::le(enter, exit))
    }

    /// [`Beams::meets`] for a node's child.
    #[inline(always)]
    pub fn meets_child<const MIXED: bool>(&self, node: &Node, child: usize, limits: f32x16) -> u32 {
        self.meets::<MIXED>(|axis| [node.end(axis, 0, child), node.end(axis, 1, child)], limits)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use wide::f32x8;

    /// Rays in sixteen different ways, some of them inactive.
    fn rays(common_origin: bool, len: usize) -> RayBatch {
        let mut rays = RayBatch::default();
        for i in 0..len {
            let p = (i / RAYS) as f32;
            let (x, y) = ((i % 4) as f32 * 0.01, (i / 4 % 4) as f32 * 0.01);
            let origin = if common_origin { Vec3::ONE } else { Vec3::new(x, p, y) };
            let direction = Vec3::new(x + 0.1 * p - 0.8, y - 0.02, if p < 9.0 { 1.0 } else { -1.0 }).normalize();
            rays.push(origin, direction, 0.0, if i % 7 == 3 { -1.0 } else { 10.0 + p });
        }
        rays
    }

    fn state(rays: &RayBatch) -> State {
        let mut state = State::default();
        state.start::<f32x8>(rays);
        state
    }

    #[test]
    fn ends_are_those_of_the_active_rays() {
        for (common_origin, len) in [(true, 256), (false, 256), (false, 100), (true, 1)] {
            let rays = rays(common_origin, len);
            let ends = Ends::of(&rays, &state(&rays));
            for p in 0..16 {
                let active = || (RAYS * p..(RAYS * (p + 1)).min(len)).filter(|&i| rays.t_max[i] >= 0.0);
                assert_eq!(ends.active >> p & 1 != 0, active().count() > 0);
                if active().count() == 0 {
                    continue;
                }
                for axis in 0..3 {
                    let column = |i: usize| rays.direction[axis][i];
                    let least = active().map(column).fold(f32::INFINITY, f32::min);
                    let greatest = active().map(column).fold(f32::NEG_INFINITY, f32::max);
                    assert_eq!(ends.directions[0][axis].to_array()[p], least, "{len} {p} {axis}");
                    assert_eq!(ends.directions[1][axis].to_array()[p], greatest, "{len} {p} {axis}");
                }
                assert_eq!(ends.limits.to_array()[p], 10.0 + p as f32);
            }
        }
    }

    /// A box that a ray passes through is met by the ray's beam, and a box that no ray comes near by none.
    #[test]
    fn a_beam_meets_what_its_rays_meet() {
        let bounds = crate::bvh::Aabb { min: Vec3::splat(-30.0), max: Vec3::splat(30.0) };
        for common_origin in [true, false] {
            let rays = rays(common_origin, 256);
            let bvh = Bvh {
                bounds,
                grain: 10.0,
                nodes: Vec::new(),
                blocks: Default::default(),
                root: crate::bvh::Child::EMPTY,
                depth: 0,
            };
            let ends = Ends::of(&rays, &state(&rays));
            let [narrow, wide] = ends.narrow(&bvh, far_apart(common_origin, false));
            assert_eq!((narrow, wide), (0xffff, 0));
            let beams = Beams::new(&ends, narrow, &bvh, common_origin);
            assert!(beams.mixed, "the case is there");
            let mut missed = 0;
            for i in (0..256).filter(|&i| rays.t_max[i] >= 0.0) {
                let origin =
                    if common_origin { Vec3::ONE } else { Vec3::from_array([0, 1, 2].map(|a| rays.origin[a][i])) };
                let direction = Vec3::from_array([0, 1, 2].map(|a| rays.direction[a][i]));
                for t in [0.5, 4.0, 9.0] {
                    let point = origin + direction * t;
                    let met = beams.meets::<true>(|axis| [point[axis] - 1e-3, point[axis] + 1e-3], beams.limits);
                    assert!(met >> (i / RAYS) & 1 != 0, "ray {i} at {t}");
                    missed += (!met & 0xffff).count_ones();
                }
            }
            assert!(missed > 1_000, "{missed}");
            let beyond = beams.meets::<true>(|axis| [if axis == 2 { 29.0 } else { -40.0 }, 40.0], beams.limits);
            assert_eq!(beyond, 0, "farther than the rays look");
        }
    }
}
