//! Colours from images: bilinear between the four nearest texel centres.

use crate::math::{Lanes, MAX_LANES, Vec3, linear_of_bytes, map3};
use crate::scene::Texture;

/// The linear colour at (u, v); see [`Texture`].
///
/// The place in the image is off by at most 2⁻²³ of its width and height. Far out, u and v are whole numbers; what is
/// not finite counts as column or row 0.
#[inline(never)]
pub fn sample<L: Lanes>(texture: &Texture, u: L, v: L) -> Vec3<L> {
    let columns = Span::repeating(u, texture.width);
    let rows = Span::repeating(-v, texture.height);
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
