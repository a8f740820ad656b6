//! Powers by polynomials, without branches, the same bits at every width.

use super::Lanes;

/// The least power that is not taken for 0, as its logarithm: what comes of anything less would be subnormal soon, and
/// those cost a processor a hundred cycles each.
const LEAST: f32 = -60.0;

/// x to the power y, for y > 0; 0 where that is below 2⁻⁶⁰, for x below 1e-37 (all that is not above zero included)
/// and for NaN.
///
/// Relative error at most 2e-7 · (1 + |y log₂ x|), as the test measures; results stay below 2¹²⁷. The logarithm is
/// 2 atanh((m − 1) / (m + 1)) by its series, the exponential a Taylor polynomial on [−½, ½].
#[inline(always)]
pub fn powf<L: Lanes>(x: L, y: L) -> L {
    let large_enough = x.ge(L::splat(1e-37));
    let logarithm = y * log2(x.select(large_enough, L::splat(1.0)));
    exp2(logarithm).select(large_enough & logarithm.ge(L::splat(LEAST)), L::zero())
}

#[inline(always)]
fn log2<L: Lanes>(x: L) -> L {
    let one = L::splat(1.0);
    let (exponent, m) = x.exponent_and_mantissa();
    let s = (m - one) / (m + one);
    // 2 / (k ln 2) for k = 9, 7, 5, 3, 1.
    polynomial(s * s, [0.320_598_9, 0.412_198_6, 0.577_078, 0.961_796_7, 2.885_39]).mul_add(s, exponent)
}

/// 2 to the power x from 2⁻⁶⁰ on, with a relative error of at most 2e-7; for less it is that, for more than 127
/// that.
#[inline(always)]
pub fn exp2<L: Lanes>(x: L) -> L {
    // Adding and subtracting 1.5 · 2²³ rounds to a whole number, whose bits then stand at the low end.
    let round = L::splat(12_582_912.0);
    let x = x.max(L::splat(LEAST)).min(L::splat(127.0));
    let shifted = x + round;
    let f = x - (shifted - round);
    // (ln 2)^k / k! for k = 7 … 0.
    let ln2_powers = [
        1.525_273_4e-5,
        1.540_353e-4,
        1.333_355_8e-3,
        9.618_129e-3,
        5.550_411e-2,
        0.240_226_5,
        std::f32::consts::LN_2,
        1.0,
    ];
    polynomial(f, ln2_powers) * shifted.power_of_two()
}

/// By Horner's rule; the highest power's coefficient comes first.
#[inline(always)]
pub(super) fn polynomial<L: Lanes, const N: usize>(x: L, coefficients: [f32; N]) -> L {
    let mut sum = L::splat(coefficients[0]);
    for c in &coefficients[1..] {
        sum = sum.mul_add(x, L::splat(*c));
    }
    sum
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
                if exact > 1e-18 && exact < 1e36 {
                    let error = (f64::from(powf(x, y)) / exact - 1.0).abs();
                    worst = worst.max(error / (1.0 + (f64::from(y) * f64::from(x).log2()).abs()));
                }
            }
        }
        assert!(worst < 2e-7, "worst {worst:e}");
    }

    #[test]
    fn powf_at_the_ends() {
        assert_eq!(powf(0.0f32, 50.0), 0.0);
        assert_eq!(powf(-0.0f32, 2.0), 0.0);
        assert_eq!(powf(-3.0f32, 2.0), 0.0);
        assert_eq!(powf(f32::NAN, 2.0), 0.0);
        assert_eq!(powf(1.0f32, 1e9), 1.0);
        assert_eq!(powf(1e-3f32, 1000.0), 0.0);
        assert!(powf(0.5f32, 59.9) > 0.0 && powf(0.5f32, 60.1) == 0.0);
        assert!(powf(1e30f32, 1e30) >= 1e38);
    }
}
