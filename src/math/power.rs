//! Powers by polynomials, without branches, so that a loop over them becomes vector code and every build of one
//! instruction set gives the same bits.

use super::fused_mul_add as fma;

/// x to the power y, for x ≥ 0 and y > 0; 0 for x below 1e-37 and for NaN.
///
/// Relative error at most 2e-7 · (1 + |y log₂ x|), as the test measures; results below 2⁻¹²⁶ become 2⁻¹²⁶ or less,
/// above 2¹²⁷ they stay there. The logarithm is 2 atanh((m − 1) / (m + 1)) by its series, the exponential a
/// Taylor polynomial on [−½, ½].
#[inline(always)]
pub fn powf(x: f32, y: f32) -> f32 {
    let safe = if x >= 1e-37 { x } else { 1.0 };
    let power = exp2(y * log2(safe));
    if x >= 1e-37 { power } else { 0.0 }
}

#[inline(always)]
fn log2(x: f32) -> f32 {
    const SQRT_HALF: u32 = 0x3f35_04f3;
    // x = m · 2^e with m in [√½, √2).
    let shifted = x.to_bits().wrapping_sub(SQRT_HALF) as i32;
    let exponent = (shifted >> 23) as f32;
    let m = f32::from_bits(x.to_bits().wrapping_sub((shifted & !0x7f_ffff) as u32));
    let s = (m - 1.0) / (m + 1.0);
    let z = s * s;
    // 2 / (k ln 2) for k = 9, 7, 5, 3, 1.
    let series = fma(0.320_598_9, z, 0.412_198_6);
    let series = fma(series, z, 0.577_078);
    let series = fma(series, z, 0.961_796_7);
    let series = fma(series, z, 2.885_39);
    fma(series, s, exponent)
}

#[inline(always)]
fn exp2(x: f32) -> f32 {
    // Adding and subtracting 1.5 · 2²³ rounds to a whole number, whose bits then stand at the low end.
    const ROUND: f32 = 12_582_912.0;
    let x = if x > -126.0 { x } else { -126.0 };
    let x = if x < 127.0 { x } else { 127.0 };
    let shifted = x + ROUND;
    let whole = shifted - ROUND;
    let f = x - whole;
    // (ln 2)^k / k! for k = 7 … 0.
    let p = fma(1.525_273_4e-5, f, 1.540_353e-4);
    let p = fma(p, f, 1.333_355_8e-3);
    let p = fma(p, f, 9.618_129e-3);
    let p = fma(p, f, 5.550_411e-2);
    let p = fma(p, f, 0.240_226_5);
    let p = fma(p, f, std::f32::consts::LN_2);
    let p = fma(p, f, 1.0);
    let exponent = (shifted.to_bits() << 23).wrapping_add(127 << 23);
    p * f32::from_bits(exponent)
}

/// Linear value to its 8-bit sRGB code: clamped to 0..1, NaN as 0, rounded to the nearest code.
///
/// The curve of IEC 61966-2-1, to within 1e-6.
#[inline(always)]
pub fn srgb8(linear: f32) -> u32 {
    const ROUND: f32 = 8_388_608.0;
    let x = if linear > 0.0 { linear } else { 0.0 };
    let x = if x < 1.0 { x } else { 1.0 };
    let curved = fma(1.055, powf(x, 1.0 / 2.4), -0.055);
    let value = if x <= 0.003_130_8 { 12.92 * x } else { curved };
    fma(value, 255.0, ROUND).to_bits() & 0xff
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn powf_is_as_exact_as_stated() {
        let mut worst = 0.0f64;
        for i in 1..20_000 {
            let x = i as f32 / 10_000.0;
            for y in [0.25f32, 1.0 / 2.4, 1.0, 2.0, 7.5, 50.0, 128.0] {
                let exact = f64::from(x).powf(f64::from(y));
                if exact > 1e-36 && exact < 1e36 {
                    let error = (f64::from(powf(x, y)) / exact - 1.0).abs();
                    worst = worst.max(error / (1.0 + (f64::from(y) * f64::from(x).log2()).abs()));
                }
            }
        }
        assert!(worst < 2e-7, "worst {worst:e}");
    }

    #[test]
    fn powf_at_the_ends() {
        assert_eq!(powf(0.0, 50.0), 0.0);
        assert_eq!(powf(-0.0, 2.0), 0.0);
        assert_eq!(powf(f32::NAN, 2.0), 0.0);
        assert_eq!(powf(1.0, 1e9), 1.0);
        assert!(powf(1e-3, 1000.0) <= 1.2e-38);
        assert!(powf(1e30, 1e30) >= 1e38);
    }

    #[test]
    fn srgb8_rounds_to_the_nearest_code() {
        let exact = |x: f64| if x <= 0.0031308 { 12.92 * x } else { 1.055 * x.powf(1.0 / 2.4) - 0.055 };
        for i in 0..=100_000 {
            let x = i as f32 / 100_000.0;
            let wanted = exact(f64::from(x)) * 255.0;
            assert!((f64::from(srgb8(x)) - wanted).abs() <= 0.5 + 3e-4, "{x}: {} for {wanted}", srgb8(x));
        }
        assert_eq!([-1.0, f32::NAN, 0.0, 1.0, 9.0, f32::INFINITY].map(srgb8), [0, 0, 0, 255, 255, 255]);
        // Every code has a value that maps to it.
        for code in 0..=255u32 {
            let v = f64::from(code) / 255.0;
            let linear = if v <= 0.04045 { v / 12.92 } else { ((v + 0.055) / 1.055).powf(2.4) };
            assert_eq!(srgb8(linear as f32), code);
        }
    }
}
