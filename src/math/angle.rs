//! Angles by polynomials, without branches, the same bits at every width.
//!
//! Everything is counted in turns: what asks for an angle here looks something up by it.

use super::Lanes;
use super::power::polynomial;

/// atan(√z) / (2π √z) on [0, 1]; the highest power's coefficient comes first.
///
/// Fitted with the least greatest error of √z times the polynomial: 1.4e-8 turns, the coefficients' rounding included.
const ARC_TANGENT: [f32; 8] = [
    -6.453_036e-4,
    3.479_594_8e-3,
    -8.898_719e-3,
    1.534_603_1e-2,
    -2.213_627_1e-2,
    3.174_594_4e-2,
    -5.304_612_2e-2,
    0.159_154_83,
];

/// ½ + atan2(y, x) / 2π: a direction as a part of a full turn, from 0 to 1; ½ for two zeros.
///
/// Absolute error at most 8e-8 for numbers of any size, as the test measures. The sign of a zero does not count:
/// (±0, x) gives 1 for every x below 0. An infinity is far beyond any other number; two, and NaN, give NaN.
#[inline(always)]
pub fn turn<L: Lanes>(y: L, x: L) -> L {
    arc_tangent(y, x) + L::splat(0.5)
}

/// ½ + atan2(y, across) / π for across ≥ 0: how far up a direction points, from 0 to 1, by its height and its length
/// across; it need not have unit length.
///
/// Absolute error at most 1e-7, as the test measures.
#[inline(always)]
pub fn elevation<L: Lanes>(y: L, across: L) -> L {
    arc_tangent(y, across).mul_add(L::splat(2.0), L::splat(0.5))
}

/// atan2(y, x) / 2π, from −½ to ½.
#[inline(always)]
fn arc_tangent<L: Lanes>(y: L, x: L) -> L {
    let (zero, one) = (L::zero(), L::splat(1.0));
    let (across, up) = (x.abs(), y.abs());
    // With this order of the arguments a NaN makes the ratio NaN.
    let (less, greater) = (across.min(up), up.max(across));
    let ratio = less / one.select(greater.eq(zero), greater);
    let square = ratio * ratio;
    // Within the first eighth of a turn; then its mirror image in the quarter, the half, the whole.
    let eighth = ratio * polynomial(square, ARC_TANGENT);
    let quarter = (L::splat(0.25) - eighth).select(up.gt(across), eighth);
    let half = (L::splat(0.5) - quarter).select(x.lt(zero), quarter);
    (-half).select(y.lt(zero), half)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::{PI, TAU};
    use wide::{f32x4, f32x8};

    const INFINITY: f32 = f32::INFINITY;

    fn exact_turn(y: f32, x: f32) -> f64 {
        0.5 + f64::from(y).atan2(f64::from(x)) / TAU
    }

    /// Magnitudes of every exponent, a few of each, and zero.
    fn magnitudes() -> impl Iterator<Item = f32> {
        let bits = (0u32..255).flat_map(|exponent| [0, 1, 0x2a_aaaa, 0x7f_ffff].map(|m| exponent << 23 | m));
        bits.map(f32::from_bits)
    }

    #[test]
    fn turn_is_as_exact_as_stated() {
        let mut worst = 0.0f64;
        let mut check = |y: f32, x: f32| {
            let error = (f64::from(turn(y, x)) - exact_turn(y, x)).abs();
            // A zero has no sign, so the end of the turn may stand for its start.
            worst = worst.max(if y == 0.0 { error.min((error - 1.0).abs()) } else { error });
        };
        for i in 0..1_000_000 {
            let angle = f64::from(i) * (TAU / 1e6);
            check(angle.sin() as f32, angle.cos() as f32);
        }
        for y in magnitudes().step_by(3) {
            for x in magnitudes().filter(|&x| x != 0.0 || y != 0.0) {
                [(y, x), (-y, x), (y, -x), (-y, -x)].into_iter().for_each(|(y, x)| check(y, x));
            }
        }
        assert!(worst < 8e-8, "worst {worst:e}");
        assert!(worst > 2e-8, "a better bound can be stated: {worst:e}");
    }

    #[test]
    fn turn_on_the_axes_and_without_a_direction() {
        for (y, x, expected) in [
            (0.0, 3.0, 0.5),
            (-0.0, 3.0, 0.5),
            (2.0, 0.0, 0.75),
            (2.0, -0.0, 0.75),
            (-2.0, 0.0, 0.25),
            (-1e-45, 1e-45, 0.375),
            (0.0, -1.0, 1.0),
            (-0.0, -1.0, 1.0),
            (-1e-20, -1.0, 0.0),
            (1e38, 1e38, 0.625),
            (INFINITY, -7.0, 0.75),
            (-7.0, INFINITY, 0.5),
            (7.0, -INFINITY, 1.0),
        ] {
            assert!((turn(y, x) - expected).abs() < 8e-8, "({y}, {x}): {}", turn(y, x));
        }
        for (y, x) in [(0.0, 0.0), (-0.0, 0.0), (0.0, -0.0), (-0.0, -0.0)] {
            assert_eq!(turn(y, x), 0.5);
        }
        for (y, x) in [(INFINITY, INFINITY), (-INFINITY, INFINITY), (f32::NAN, 1.0), (1.0, f32::NAN), (f32::NAN, 0.0)] {
            assert!(turn(y, x).is_nan(), "({y}, {x})");
        }
    }

    #[test]
    fn elevation_is_as_exact_as_stated() {
        let mut worst = 0.0f64;
        for y in magnitudes() {
            for across in magnitudes().step_by(3).filter(|&across| y != 0.0 || across != 0.0) {
                let exact = 0.5 + f64::from(y).atan2(f64::from(across)) / PI;
                worst = worst.max((f64::from(elevation(y, across)) - exact).abs());
            }
        }
        assert!((3e-8..1e-7).contains(&worst), "worst {worst:e}");
    }

    #[test]
    fn all_widths_give_the_same_bits() {
        let probes: Vec<f32> = magnitudes().step_by(7).flat_map(|x| [x, -x]).chain([0.3, -0.9, INFINITY]).collect();
        fn all<L: Lanes>(probes: &[f32]) -> Vec<u32> {
            let mut bits = Vec::new();
            let padded: Vec<f32> = probes.iter().copied().chain([f32::NAN; 8]).collect();
            for shift in [0, 1, 5, 100] {
                for at in (0..probes.len()).step_by(L::WIDTH) {
                    let y = L::load(&padded[at..]);
                    let turned: Vec<f32> = (0..L::WIDTH).map(|i| padded[(at + i + shift) % padded.len()]).collect();
                    let mut out = [[0.0; 8]; 2];
                    turn(y, L::load(&turned)).store(&mut out[0]);
                    elevation(y, L::load(&turned).abs()).store(&mut out[1]);
                    let used = (0..L::WIDTH).filter(|i| at + i < probes.len());
                    bits.extend(used.flat_map(|i| out.map(|o| if o[i].is_nan() { u32::MAX } else { o[i].to_bits() })));
                }
            }
            bits
        }
        let one = all::<f32>(&probes);
        assert_eq!(one, all::<f32x4>(&probes));
        assert_eq!(one, all::<f32x8>(&probes));
    }
}
