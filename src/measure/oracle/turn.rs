//! The rotation of a box: sines and cosines of degrees to a few hundred bits.

use std::sync::OnceLock;

use dashu_int::IBig;
use dashu_int::ops::DivEuclid;
use glam::Vec3;

use super::exact::{Exact, Exact3};

/// Sines, cosines and the rotation are whole multiples of 2^−384, off by less than 2^−376.
const PLACES: usize = 384;

/// More while they are computed.
const GUARD: usize = PLACES + 32;

/// The box's own axes in the world: x, y and z turned about x first, then y, then z; `None` where a number is not
/// finite. Exact where all angles are quarter turns.
pub fn axes(degrees: Vec3) -> Option<[Exact3; 3]> {
    let [x, y, z] = degrees.to_array().map(sin_cos);
    let ((sx, cx), (sy, cy), (sz, cz)) = (x?, y?, z?);
    let (one, zero) = (Exact::integer(1), Exact::ZERO);
    let about_x = [[one, zero.clone(), zero.clone()], [zero.clone(), cx.clone(), sx.clone()], [zero, -&sx, cx]];
    // A vector's turn about y, and then about z.
    let about_y = |[x, y, z]: Exact3| [&cy * &x + &sy * &z, y, &cy * &z - &sy * &x];
    let about_z = |[x, y, z]: Exact3| [&cz * &x - &sz * &y, &sz * &x + &cz * &y, z];
    Some(about_x.map(|axis| about_z(about_y(axis)).map(|c| rounded(&c, PLACES))))
}

/// The sine and cosine of an angle.
pub fn sin_cos(degrees: f32) -> Option<(Exact, Exact)> {
    let quarter = Exact::integer(90);
    let angle = Exact::from_f32(degrees)?;
    let whole = floor_ratio(&angle, 90);
    let rest = &angle - &quarter * Exact::new(whole.clone(), 0);
    let (sin, cos) = if rest.is_zero() { (Exact::ZERO, Exact::integer(1)) } else { series(&rest) };
    let quadrant = i64::try_from(whole % IBig::from(4)).unwrap_or(0).rem_euclid(4);
    Some(match quadrant {
        0 => (sin, cos),
        1 => (cos, -&sin),
        2 => (-&sin, -&cos),
        _ => (-&cos, sin),
    })
}

/// ⌊x / n⌋.
fn floor_ratio(x: &Exact, n: i64) -> IBig {
    let exponent = x.exponent().min(0);
    x.floor_at(exponent).div_euclid(IBig::from(n) << exponent.unsigned_abs())
}

fn rounded(x: &Exact, places: usize) -> Exact {
    Exact::new(x.floor_at(-(places as isize)), -(places as isize))
}

/// Taylor's series at an angle between 0 and 90 degrees: every term is cut off, by less than 2^−GUARD.
fn series(degrees: &Exact) -> (Exact, Exact) {
    let exponent = -(GUARD as isize);
    let x = (degrees * Exact::new(pi().clone(), exponent)).quotient(&Exact::integer(180)).floor_at(exponent);
    let (mut sin, mut cos) = (IBig::ZERO, IBig::ZERO);
    let mut term = IBig::ONE << GUARD;
    for power in 0u32.. {
        let sum = if power % 2 == 0 { &mut cos } else { &mut sin };
        *sum += if power / 2 % 2 == 0 { term.clone() } else { -&term };
        term = ((term * &x) >> GUARD) / IBig::from(power + 1);
        if term == IBig::ZERO {
            break;
        }
    }
    let place = |x| rounded(&Exact::new(x, exponent), PLACES);
    (place(sin), place(cos))
}

/// π · 2^GUARD: 16 arctan(1/5) − 4 arctan(1/239) (Machin, 1706).
fn pi() -> &'static IBig {
    static PI: OnceLock<IBig> = OnceLock::new();
    PI.get_or_init(|| {
        let arctan = |n: u32| {
            let (mut sum, mut power) = (IBig::ZERO, (IBig::ONE << (GUARD + 32)) / IBig::from(n));
            for k in 0u32.. {
                let term = &power / IBig::from(2 * k + 1);
                if term == IBig::ZERO {
                    break;
                }
                sum += if k % 2 == 0 { term } else { -term };
                power /= IBig::from(n * n);
            }
            sum
        };
        ((arctan(5) << 4) - (arctan(239) << 2)) >> 32
    })
}
