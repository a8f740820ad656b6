//! Which groups of rays from one point pass by a triangle, and which pass through it, told by its edges.
//!
//! With p and q the shears of a ray's direction ([`crate::geometry::triangle::Aim`]) and a corner (x, y, r) in the order of
//! the axes, the test of a triangle takes x − p r and y − q r. An edge function of two corners is then
//! A + B p + C q, as p q r r′ cancels. So over all rays of a beam, whose p and q lie in intervals, it lies in an interval
//! too. Where one edge function is below zero and another above for all of them, no ray passes through; where all three
//! have one sign for all of them, every ray does, and the test itself can be left out.
//!
//! **The test decides.** It rounds, and so does this. With M the greatest |x − p r| and |y − q r| of the corners over all rays,
//! and u = ε / 2, the test's edge functions are off by at most 8 u M² when its operations are fused. Here p and q count from
//! the middle of all rays, so that B and C are multiplied by little; what is computed is off by at most 35 u M²: 4 for the
//! corners, 9 for A, B and C, 22 for the sums. Where nothing is fused, both together are off by 9 u M² and, with Z the
//! greatest |r|, by 8 u M Z more, as no shear is above 1. A beam counts as apart from zero from 80 u M² (and 16 u M Z)
//! on: so what is said of its rays is what the test would say.

use crate::math::{LaneMask, Lanes, map2, map3};
use wide::{f32x8, f32x16};

/// 80 u.
const SLACK: f32 = 40.0 * f32::EPSILON;
/// 16 u, where a product is rounded before it is added.
const UNFUSED: f32 = if cfg!(target_feature = "fma") { 0.0 } else { 8.0 * f32::EPSILON };
/// 8 u: what intervals are wider by, for their own rounding.
const WIDER: f32 = 4.0 * f32::EPSILON;
/// M and Z up to here: no product overflows.
const LARGE: f32 = 1e18;
/// More than what is lost where products are denormal.
const SMALL: f32 = 1e-36;

/// The shears of sixteen beams of rays from one point, a beam a lane, counted from the middle of all.
#[derive(Clone, Copy)]
pub struct Shears {
    /// The middles and halves of the beams' intervals.
    middle: [f32x16; 2],
    half: [f32x16; 2],
    /// The middle of all, and how far any is from it.
    center: [f32; 2],
    reach: [f32; 2],
}

impl Shears {
    /// Of the beams whose bits are set, from the ends of their directions, which have their largest component along
    /// `major`; a shear is the quotient of two components.
    #[inline(never)]
    pub fn of([least, greatest]: &[[f32x16; 3]; 2], lanes: u32, major: usize) -> Self {
        let there: f32x16 = LaneMask::from_bits(lanes);
        let select = |v: f32x16, or: f32| Lanes::select(v, there, f32x16::splat(or));
        let [r, q] = [f32x16::ONE / least[major], f32x16::ONE / greatest[major]];
        let mut shears = Self { middle: [f32x16::ZERO; 2], half: [f32x16::ZERO; 2], center: [0.0; 2], reach: [0.0; 2] };
        for i in 0..2 {
            let axis = (major + 1 + i) % 3;
            let [a, b, c, d] = [least[axis] * r, least[axis] * q, greatest[axis] * r, greatest[axis] * q];
            let low = Lanes::min(Lanes::min(a, b), Lanes::min(c, d));
            let high = Lanes::max(Lanes::max(a, b), Lanes::max(c, d));
            let rounding = (Lanes::abs(low) + Lanes::abs(high)) * f32x16::splat(WIDER);
            let (low, high) = (low - rounding, high + rounding);
            let (first, last) = (select(low, f32::INFINITY).least(), select(high, f32::NEG_INFINITY).greatest());
            let center = 0.5 * (first + last);
            let (low, high) = (low - f32x16::splat(center), high - f32x16::splat(center));
            let half = f32x16::splat(0.5);
            shears.center[i] = center;
            shears.reach[i] = (last - center).max(center - first) * (1.0 + WIDER);
            shears.middle[i] = (low + high) * half;
            shears.half[i] = (high - low) * half + (Lanes::abs(low) + Lanes::abs(high)) * f32x16::splat(WIDER);
        }
        shears
    }
}

/// The edge functions of a block's triangles.
pub struct Edges {
    /// A, B and C of each edge.
    terms: [[f32x8; 3]; 3],
    /// How far from zero they must be.
    slack: f32x8,
}

impl Edges {
    /// Of triangles with these corners, as seen from the rays' origin and in the order of the axes; and the triangles that
    /// all rays pass by, as bits.
    #[inline(always)]
    pub fn of(corners: &[[f32x8; 3]; 3], shears: &Shears) -> (Self, u32) {
        let [px, py] = map2(shears.center, f32x8::splat);
        let [hx, hy] = map2(shears.reach, f32x8::splat);
        let corners = map3(*corners, |[x, y, r]| [r.neg_mul_add(px, x), r.neg_mul_add(py, y), r]);
        let (mut most, mut deep) = (f32x8::ZERO, f32x8::ZERO);
        for [x, y, r] in corners {
            let z = Lanes::abs(r);
            let aside = Lanes::max(z.mul_add(hx, Lanes::abs(x)), z.mul_add(hy, Lanes::abs(y)));
            (most, deep) = (Lanes::max(aside, most), Lanes::max(z, deep));
        }
        let slack = most * (most * f32x8::splat(SLACK) + deep * f32x8::splat(UNFUSED)) + f32x8::splat(SMALL);
        // NaN fails this.
        let small = Lanes::lt(Lanes::max(most, deep), f32x8::splat(LARGE));
        let slack = Lanes::select(slack, small, f32x8::splat(f32::INFINITY));
        let edge = |[cx, cy, cr]: [f32x8; 3], [bx, by, br]: [f32x8; 3]| {
            [cy.neg_mul_add(bx, cx * by), cr.neg_mul_add(by, cy * br), cx.neg_mul_add(br, cr * bx)]
        };
        let [a, b, c] = corners;
        let edges = Self { terms: [edge(c, b), edge(a, c), edge(b, a)], slack };
        let (mut below, mut above) = (f32x8::splat(f32::INFINITY), f32x8::splat(f32::NEG_INFINITY));
        for [a, b, c] in edges.terms {
            let wide = Lanes::abs(c).mul_add(hy, Lanes::abs(b) * hx);
            (below, above) = (Lanes::min(a + wide, below), Lanes::max(a - wide, above));
        }
        let by = Lanes::lt(below, -slack) & Lanes::gt(above, slack);
        (edges, LaneMask::bits(by))
    }

    /// The beams of which all rays pass by triangle `lane`, and those of which all pass through it.
    #[inline(always)]
    pub fn beams(&self, lane: usize, shears: &Shears) -> [u32; 2] {
        let pick = |v: &f32x8| f32x16::splat(v.as_array()[lane & 7]);
        let [mx, my] = shears.middle;
        let [hx, hy] = shears.half;
        let ends = |k: usize| {
            let [a, b, c] = [pick(&self.terms[k][0]), pick(&self.terms[k][1]), pick(&self.terms[k][2])];
            let middle = c.mul_add(my, b.mul_add(mx, a));
            let half = Lanes::abs(c).mul_add(hy, Lanes::abs(b) * hx);
            (middle - half, middle + half)
        };
        let ((l0, h0), (l1, h1), (l2, h2)) = (ends(0), ends(1), ends(2));
        let slack = pick(&self.slack);
        let least = |a, b, c| Lanes::min(Lanes::min(a, b), c);
        let greatest = |a, b, c| Lanes::max(Lanes::max(a, b), c);
        let by = Lanes::lt(least(h0, h1, h2), -slack) & Lanes::gt(greatest(l0, l1, l2), slack);
        let through = Lanes::gt(least(l0, l1, l2), slack) | Lanes::lt(greatest(h0, h1, h2), -slack);
        [LaneMask::bits(by), LaneMask::bits(through)]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::triangle::{Aim, covers_ordered};
    use crate::math::Vec3;

    /// Numbers in −1..1, from a seed.
    fn numbers(seed: u64) -> impl FnMut() -> f32 {
        let mut state = seed;
        move || {
            state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            ((state >> 40) as f32 / (1 << 23) as f32) - 1.0
        }
    }

    /// Sixteen beams of sixteen directions about `middle`, each as wide as `beam`, in `all`.
    fn directions(next: &mut impl FnMut() -> f32, middle: glam::Vec3, all: f32, beam: f32) -> Vec<glam::Vec3> {
        let mut directions = Vec::new();
        for _ in 0..16 {
            let at = middle + all * glam::Vec3::new(next(), next(), next());
            directions.extend((0..16).map(|_| (at + beam * glam::Vec3::new(next(), next(), next())).normalize()));
        }
        directions
    }

    /// What is said of a beam holds for each of its rays by the test itself: for triangles of all sizes and depths, edge-on
    /// ones, and ones whose edges lie on rays.
    #[test]
    fn beams_are_told_what_the_test_says() {
        let mut next = numbers(7);
        let (mut said, mut rays) = ([0, 0], 0);
        for round in 0..4_000 {
            let major = round % 3;
            let mut middle = glam::Vec3::new(0.3 * next(), 0.3 * next(), 0.3 * next());
            middle[major] = if round % 2 == 0 { 1.0 } else { -1.0 };
            let exponent = -1.0 - 2.5 * (1.0 + next());
            let all = 10f32.powf(exponent);
            let directions = directions(&mut next, middle, all, all * 0.2);
            let ends = [f32::min as fn(f32, f32) -> f32, f32::max].map(|op| {
                [0, 1, 2].map(|axis| {
                    let beam = |p: usize| directions[16 * p..16 * p + 16].iter().map(|d| d[axis]).reduce(op).unwrap();
                    f32x16::new(std::array::from_fn(beam))
                })
            });
            let shears = Shears::of(&ends, 0xffff, major);
            // Eight triangles about the rays at some depth.
            let depth = 10f32.powf(6.0 * next());
            let size = depth * all * 10f32.powf(1.0 + 2.0 * next());
            let mut corners = [[[0f32; 8]; 3]; 3];
            for lane in 0..8 {
                let at = directions[(lane * 37) % 256] * depth * (1.0 + 0.1 * next());
                for (k, corner) in corners.iter_mut().enumerate() {
                    let to = match lane {
                        // On a ray, so that its edge functions are next to zero.
                        0 => directions[(k * 91 + round) % 256] * depth,
                        // Edge-on: in a plane with the eye.
                        1 => at * (1.0 + k as f32),
                        _ => at + size * glam::Vec3::new(next(), next(), next()),
                    };
                    let ordered = Vec3::<f32>::from(to).ordered(major);
                    (0..3).for_each(|i| corner[i][lane] = ordered[i]);
                }
            }
            let seen = corners.map(|corner| corner.map(f32x8::new));
            let (edges, all_by) = Edges::of(&seen, &shears);
            for lane in 0..8 {
                let [by, through] = edges.beams(lane, &shears);
                let one = corners.map(|corner| corner.map(|axis| axis[lane]));
                for (i, &direction) in directions.iter().enumerate() {
                    let inside = covers_ordered::<f32>(&one, Aim::new(direction.into()).shear);
                    let beam = i / 16;
                    assert!(!(inside && by >> beam & 1 != 0), "round {round}, triangle {lane}, ray {i} passes through");
                    assert!(!(inside && all_by >> lane & 1 != 0), "round {round}, triangle {lane}, ray {i}, of all");
                    assert!(inside || through >> beam & 1 == 0, "round {round}, triangle {lane}, ray {i} passes by");
                    rays += 1;
                    said[0] += by >> beam & 1;
                    said[1] += through >> beam & 1;
                }
            }
        }
        assert!(said[0] > rays / 4 && said[1] > rays / 20, "{said:?} of {rays}");
    }
}
