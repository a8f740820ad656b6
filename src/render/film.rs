//! The finished picture, and the way from radiance to display values.

use crate::math::srgb8;

/// Linear radiance per pixel, row by row from the top.
#[derive(Clone, Debug, PartialEq)]
pub struct Film {
    /// Pixels across.
    pub width: usize,
    /// Pixels down.
    pub height: usize,
    /// Linear RGB.
    pub pixels: Vec<[f32; 3]>,
}

impl Film {
    /// A black film.
    pub fn new(width: usize, height: usize) -> Self {
        Self { width, height, pixels: vec![[0.0; 3]; width * height] }
    }
}

/// Linear RGB to 0RGB with the sRGB curve, clamped to 0..1, NaN as 0.
#[inline(always)]
pub fn tone_map(rgb: [f32; 3]) -> u32 {
    srgb8(rgb[0]) << 16 | srgb8(rgb[1]) << 8 | srgb8(rgb[2])
}
