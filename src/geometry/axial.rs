//! The geometry that bodies about an axis share: their axes, the slab between their ends, and the choice of the nearest
//! hit.

use glam::{DVec3, Vec3};

use super::{LaneHits, Sides, Variant};
use crate::math::{LaneMask, Lanes};

/// The ends and sides that a body about an axis has.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Hull {
    /// Whether the ends are closed.
    pub caps: bool,
    /// Which side is there.
    pub sides: Sides,
}

impl Variant for Hull {
    fn code(self) -> u8 {
        2 * self.sides.code() + u8::from(self.caps)
    }
    #[inline(always)]
    fn both_sides(self) -> Self {
        Self { sides: Sides::Both, ..self }
    }
}

/// The unit axes T, B and A of a body from `base` to `apex` ([`super::frame`], in f64), and its length.
pub(super) fn axes(base: Vec3, apex: Vec3) -> ([DVec3; 3], f64) {
    let along = apex.as_dvec3() - base.as_dvec3();
    let length = along.length();
    let axis = along / length;
    let [x, y, z] = axis.abs().to_array();
    let pole = if (y >= x && y >= z) || x < z { DVec3::X } else { DVec3::Z };
    let tangent = (pole - axis * axis.dot(pole)).normalize();
    ([tangent, tangent.cross(axis), axis], length)
}

/// A box around discs across the unit `axis`, by their middles and radii, with room for the rounding of tests of a body of
/// this size.
#[inline]
pub(super) fn bounds(axis: Vec3, discs: [(Vec3, f32); 2], size: f32) -> [Vec3; 2] {
    let axis = axis.as_dvec3();
    // √(1 − A²) a component, without cancelling.
    let across = DVec3::new(axis.y.hypot(axis.z), axis.z.hypot(axis.x), axis.x.hypot(axis.y));
    let ends = discs.map(|(middle, radius)| {
        let (middle, half) = (middle.as_dvec3(), across * f64::from(radius));
        [middle - half, middle + half]
    });
    let (low, high) = (ends[0][0].min(ends[1][0]), ends[0][1].max(ends[1][1]));
    // The axes are rounded, by ε of the size; the tests are off by less than 16 ε of it.
    let slack = 16.0 * f64::from(f32::EPSILON) * (low.abs().max(high.abs()).max_element() + f64::from(size));
    [(low - slack).as_vec3(), (high + slack).as_vec3()]
}

/// The most pieces that a body is cut into.
const MAX_PIECES: u32 = 16;

/// Into how many pieces a tree had best cut a body; `piece` is a box around piece k of n.
///
/// The surface area heuristic counts the rays that meet a box by its area: as long as twice as many pieces have together
/// boxes smaller by a sixth, they save more tests than they cost steps and memory (measured on rings, tree and lattice).
pub(super) fn pieces(piece: impl Fn(u32, u32) -> [Vec3; 2]) -> u32 {
    let area = |n: u32| {
        let [min, max] = piece(n / 2, n);
        let size = (max - min).as_dvec3();
        f64::from(n) * (size.x * size.y + size.y * size.z + size.z * size.x)
    };
    let (mut n, mut least) = (1, area(1));
    while n < MAX_PIECES {
        let area = area(2 * n);
        if area.is_nan() || area > least * (5.0 / 6.0) {
            break;
        }
        (n, least) = (2 * n, area);
    }
    n
}

/// The distances between which a ray is between two parallel planes, `low` and `high` away from its origin along the
/// planes' normal; `along` is the direction's part along that. Both planes belong to the slab.
#[inline(always)]
pub(super) fn slab<L: Lanes>(low: L, high: L, along: L) -> (L, L) {
    let (first, second) = (low / along, high / along);
    // Exactly across the axis the quotients would be infinite or NaN: the origin alone decides.
    let level = along.eq(L::zero());
    let within = low.le(L::zero()) & high.ge(L::zero());
    let far = L::splat(f32::INFINITY);
    ((-far).select(within, far).select(level, first.min(second)), far.select(level, first.max(second)))
}

/// Where a ray enters a body and leaves it, and the lanes in which these are on its surface.
#[derive(Clone, Copy, Debug)]
pub(super) struct Crossing<L: Lanes> {
    pub enter: L,
    pub exit: L,
    pub entered: L::Mask,
    pub left: L::Mask,
}

impl<L: Lanes> Crossing<L> {
    /// The nearest of the two inside (`t_min`, `t_max`), on the sides that are there.
    #[inline(always)]
    pub fn nearest(self, sides: Sides, t_min: L, t_max: L) -> LaneHits<L> {
        let entered = self.entered & self.enter.gt(t_min);
        let left = self.left & self.exit.gt(t_min);
        let (t, there) = match sides {
            Sides::Both => (self.enter.select(entered, self.exit), entered | left),
            Sides::Front => (self.enter, entered),
            Sides::Back => (self.exit, left),
        };
        let inside = there & t.lt(t_max);
        inside.any().then_some((t, inside))
    }
}
