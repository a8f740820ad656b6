//! The finished picture, and the way from radiance to display values.

use std::sync::LazyLock;

use crate::math::BATCH;

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

/// Linear RGB to 0RGB with the sRGB curve (IEC 61966-2-1), clamped to 0..1, NaN as 0; off by at most 0.56 of a code.
pub fn tone_map(rgb: [f32; 3]) -> u32 {
    Tone::get().map(rgb)
}

/// The sRGB curve as a table over the high bits of a number: 2¹⁰ entries an octave from 2⁻¹³, below which all is
/// black, to 1.
#[derive(Debug)]
pub(crate) struct Tone {
    /// The entries, and room up to a power of two, so that a mask keeps any place inside.
    codes: [u8; Self::ROOM],
}

impl Tone {
    const OCTAVES: usize = 13;
    const BITS: usize = 10;
    const ROOM: usize = (Self::OCTAVES << Self::BITS).next_power_of_two();
    /// 2⁻¹³.
    const LEAST: f32 = 1.220_703_1e-4;
    /// The number before 1.
    const MOST: f32 = 1.0 - 0.5 * f32::EPSILON;

    pub(crate) fn get() -> &'static Self {
        static TONE: LazyLock<Tone> = LazyLock::new(Tone::new);
        &TONE
    }

    fn new() -> Self {
        let code = |i: usize| {
            // The middle of the entry's numbers.
            let bits = Self::LEAST.to_bits() + ((2 * i as u32 + 1) << (22 - Self::BITS));
            let x = f64::from(f32::from_bits(bits));
            let curved = if x <= 0.003_130_8 { 12.92 * x } else { 1.055 * x.powf(1.0 / 2.4) - 0.055 };
            (curved * 255.0).round() as u8
        };
        let last = (Self::OCTAVES << Self::BITS) - 1;
        Self { codes: std::array::from_fn(|i| code(i.min(last))) }
    }

    /// The entry of a number.
    #[inline(always)]
    fn place(linear: f32) -> u32 {
        let x = if linear > Self::LEAST { linear } else { Self::LEAST };
        let x = if x < Self::MOST { x } else { Self::MOST };
        (x.to_bits() - Self::LEAST.to_bits()) >> (23 - Self::BITS)
    }

    #[inline(always)]
    fn pixel(&self, [r, g, b]: [u32; 3]) -> u32 {
        let code = |place: u32| u32::from(self.codes[place as usize & (Self::ROOM - 1)]);
        code(r) << 16 | code(g) << 8 | code(b)
    }

    /// See [`tone_map`].
    #[inline(always)]
    pub(crate) fn map(&self, [r, g, b]: [f32; 3]) -> u32 {
        self.pixel([Self::place(r), Self::place(g), Self::place(b)])
    }

    /// [`tone_map`] of a tile's pixels, whose red, green and blue are columns.
    pub(crate) fn map_columns(&self, [r, g, b]: &[[f32; BATCH]; 3], out: &mut [u32; BATCH]) {
        for at in (0..BATCH).step_by(16) {
            // All places first, which the compiler does at once.
            let mut places = [[0; 16]; 3];
            for i in 0..16 {
                places[0][i] = Self::place(r[at + i]);
                places[1][i] = Self::place(g[at + i]);
                places[2][i] = Self::place(b[at + i]);
            }
            for i in 0..16 {
                out[at + i] = self.pixel([places[0][i], places[1][i], places[2][i]]);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn exact(x: f64) -> f64 {
        255.0 * if x <= 0.0031308 { 12.92 * x } else { 1.055 * x.powf(1.0 / 2.4) - 0.055 }
    }

    #[test]
    fn codes_are_as_exact_as_stated() {
        for i in 0..=100_000 {
            let x = i as f32 / 100_000.0;
            let code = tone_map([x; 3]) & 0xff;
            assert!((f64::from(code) - exact(f64::from(x))).abs() <= 0.56, "{x}: {code}");
        }
    }

    #[test]
    fn every_code_comes_back_and_the_rest_is_clamped() {
        for code in 0..=255u32 {
            let v = f64::from(code) / 255.0;
            let linear = if v <= 0.04045 { v / 12.92 } else { ((v + 0.055) / 1.055).powf(2.4) };
            assert_eq!(tone_map([linear as f32; 3]), code * 0x10101);
        }
        assert_eq!(tone_map([-1.0, f32::NAN, f32::NEG_INFINITY]), 0);
        assert_eq!(tone_map([1.0, 9.0, f32::INFINITY]), 0xff_ffff);
        assert_eq!(tone_map([1.0, 0.0, 1e-40]), 0xff_0000);
    }
}
