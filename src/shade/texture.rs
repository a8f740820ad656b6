//! Colours from images: bilinear between the four nearest texel centres.

use crate::geometry::Mapping;
use crate::math::{LaneMask, Lanes, MAX_LANES, Vec3, linear_of_bytes, map3};
use crate::scene::{Texture, texels};

/// The linear colour at (u, v), in repeats; see [`Texture`]. Where the mapping ends, it does at 0 and at `repeats`.
///
/// The place in the image is off by at most 2⁻²³ of its width and height. Far out, u and v are whole numbers; what is
/// not finite counts as column or row 0.
#[inline(never)]
pub fn sample<L: Lanes>(texture: &Texture, [u, v]: [L; 2], mapping: &Mapping<L>, repeats: f32) -> Vec3<L> {
    let [u_ends, v_ends] = mapping.ends;
    let columns = Span::ending(u, texture.width, u_ends, [0.0, repeats]);
    let rows = Span::ending(-v, texture.height, v_ends, [-repeats, 0.0]);
    let linear = linear_of_bytes();
    bilinear(columns, rows, texture.width, |texel| map3(texture.texels[texel], |byte| linear[usize::from(byte)]))
}

/// Two neighbouring columns or rows in every lane, and how far from the first to the second.
pub(super) struct Span {
    from: [usize; MAX_LANES],
    to: [usize; MAX_LANES],
    part: [f32; MAX_LANES],
}

impl Span {
    /// Texel centres are at (i + ½) / `count`; after the last comes the first.
    #[inline(always)]
    pub fn repeating<L: Lanes>(s: L, count: usize) -> Self {
        let (zero, n) = (L::zero(), L::splat(count as f32));
        // 1 for what rounds up to it, so the place is from −½ to `count` − ½, and NaN for what is not finite.
        let place = (s - s.floor()).mul_add(n, L::splat(-0.5));
        let below = place.floor();
        let above = below + L::splat(1.0);
        let from = (below + n).select(below.lt(zero), below);
        Self::new(from, zero.select(above.ge(n), above), place - below, count)
    }

    /// Texel centres as in [`Span::repeating`], but where the mask is true there is nothing beyond `low` and `high`, one of
    /// which is 0: the texels there go on.
    #[inline(always)]
    pub fn ending<L: Lanes>(s: L, count: usize, ends: L::Mask, [low, high]: [f32; 2]) -> Self {
        if !ends.any() {
            return Self::repeating(s, count);
        }
        let n = L::splat(count as f32);
        let (below_all, above_all) = (L::splat(f32::NEG_INFINITY), L::splat(f32::INFINITY));
        // In this order, NaN passes.
        let s = L::splat(low).select(ends, below_all).max(L::splat(high).select(ends, above_all).min(s));
        let (first, last) = if low < 0.0 { (-texels(count, -low), -1.0) } else { (0.0, texels(count, high) - 1.0) };
        let repeat = s.floor();
        let place = (s - repeat).mul_add(n, L::splat(-0.5));
        let below = place.floor();
        // Counted from the repeat's first texel, so that it is exact.
        let first = (L::splat(first) - repeat * n).select(ends, below_all);
        let last = (L::splat(last) - repeat * n).select(ends, above_all);
        let texel = |i: L| {
            let i = first.max(last.min(i));
            (i + n).select(i.lt(L::zero()), (i - n).select(i.ge(n), i))
        };
        Self::new(texel(below), texel(below + L::splat(1.0)), place - below, count)
    }

    /// Texel centres as in [`Span::repeating`], for s from 0 to 1; the first and last texel go on beyond the border.
    #[inline(always)]
    pub fn clamped<L: Lanes>(s: L, count: usize) -> Self {
        let last = L::splat(count as f32) - L::splat(1.0);
        let place = s.mul_add(L::splat(count as f32), L::splat(-0.5));
        // In this order, NaN passes.
        let place = L::zero().max(last.min(place));
        let below = place.floor();
        Self::new(below, last.min(below + L::splat(1.0)), place - below, count)
    }

    /// Whole numbers that are below `count`, or where `count` has more than 24 bits about as much, or NaN.
    #[inline(always)]
    fn new<L: Lanes>(from: L, to: L, part: L, count: usize) -> Self {
        let index = |whole: L| {
            let mut lanes = [0.0; MAX_LANES];
            whole.store(&mut lanes);
            let mut index = [0; MAX_LANES];
            for (index, whole) in index.iter_mut().zip(lanes) {
                // NaN becomes 0.
                *index = (whole as usize).min(count - 1);
            }
            index
        };
        let finite = part.ge(L::zero());
        let mut lanes = [0.0; MAX_LANES];
        part.select(finite, L::zero()).store(&mut lanes);
        Self { from: index(from), to: index(to.select(finite, L::zero())), part: lanes }
    }
}

/// A colour at v, in repeats, or within half a texel of an end that is a point between that and the point's own.
#[inline(always)]
pub fn at_poles<L: Lanes>(
    color: Vec3<L>,
    poles: &[glam::Vec3; 2],
    v: L,
    mapping: &Mapping<L>,
    repeats: f32,
    height: usize,
) -> Vec3<L> {
    let [u_ends, v_ends] = mapping.ends;
    let twice = L::splat(-2.0 * height as f32);
    let mut color = color;
    for (k, to_end) in [v, L::splat(repeats) - v].into_iter().enumerate() {
        let part = to_end.mul_add(twice, L::splat(1.0));
        let near = part.gt(L::zero()) & v_ends & !u_ends;
        if mapping.points[k] && near.any() {
            let part = part.min(L::splat(1.0)).select(near, L::zero());
            color = (Vec3::splat(poles[k]) - color).mul_add(part, color);
        }
    }
    color
}

/// The mean of the four texels, with `texel` by its index in rows of `width`.
#[inline(always)]
pub(super) fn bilinear<L: Lanes>(
    columns: Span,
    rows: Span,
    width: usize,
    texel: impl Fn(usize) -> [f32; 3],
) -> Vec3<L> {
    // Corner, channel, lane.
    let mut corners = [[[0.0; MAX_LANES]; 3]; 4];
    for lane in 0..L::WIDTH {
        let [upper, lower] = [rows.from[lane] * width, rows.to[lane] * width];
        let [left, right] = [columns.from[lane], columns.to[lane]];
        let colors = [texel(upper + left), texel(upper + right), texel(lower + left), texel(lower + right)];
        for (corner, color) in corners.iter_mut().zip(colors) {
            for channel in 0..3 {
                corner[channel][lane] = color[channel];
            }
        }
    }
    let color = |corner: usize| Vec3::<L>::load(&corners[corner], 0);
    let [a, b, c, d] = [color(0), color(1), color(2), color(3)];
    let (across, down) = (L::load(&columns.part), L::load(&rows.part));
    let (upper, lower) = ((b - a).mul_add(across, a), (d - c).mul_add(across, c));
    (lower - upper).mul_add(down, upper)
}

#[cfg(test)]
#[path = "texture_tests.rs"]
mod tests;
#[cfg(test)]
#[path = "wrap_tests.rs"]
mod wrap_tests;
