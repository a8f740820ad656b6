//! The radiance along rays that hit nothing.

use super::texture::{Span, bilinear};
use crate::math::{Lanes, Vec3, angle};
use crate::scene::{Dome, Sky};

/// The radiance in unit directions; see [`Sky`].
#[inline(always)]
pub fn radiance<L: Lanes>(sky: &Sky, direction: Vec3<L>) -> Vec3<L> {
    match sky {
        Sky::Color(color) => Vec3::splat(*color),
        Sky::Gradient { below, above } => {
            let s = direction.y.mul_add(L::splat(0.5), L::splat(0.5));
            let below = Vec3::splat(*below);
            (Vec3::splat(*above) - below).mul_add(s, below)
        }
        Sky::Dome(dome) => panorama(dome, direction),
    }
}

/// The dome in directions of any length but zero; see [`Dome`]. What is not finite gets some texel's colour.
///
/// v is counted by the direction's length across, not by acos(d.y): next to the poles the rounding of d.y alone would
/// move it by up to 10⁻⁴. So the place in the image is off by at most 3 · 10⁻⁷ of its width and height, which is
/// 5 · 10⁻³ of a pixel in the widest that is read.
#[inline(never)]
fn panorama<L: Lanes>(dome: &Dome, direction: Vec3<L>) -> Vec3<L> {
    let Vec3 { x, y, z } = direction;
    // Only the part of a turn counts, and as `f32` a great angle would lose it.
    let turns = f64::from(dome.rotation) / 360.0;
    let u = angle::turn(x, -z) + L::splat((turns - turns.floor()) as f32);
    let v = angle::elevation(-y, x.mul_add(x, z * z).sqrt());
    let columns = Span::repeating(u, dome.width);
    let rows = Span::clamped(v, dome.height);
    bilinear(columns, rows, dome.width, |texel| dome.texels[texel])
}

#[cfg(test)]
#[path = "sky_tests.rs"]
mod tests;
