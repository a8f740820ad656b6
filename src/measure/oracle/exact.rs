//! Numbers m · 2^e with whole m of any length: sums, differences and products are exact, and so is every sign.

use std::cmp::Ordering;
use std::ops::{Add, Mul, Neg, Sub};

use dashu_int::ops::{Abs, BitTest, DivEuclid, SquareRoot};
use dashu_int::{IBig, Sign};
use glam::DVec3;

/// Bits of a quotient or square root. f64 has 53; the rest pays for what cancels afterwards.
pub const BITS: isize = 320;

/// A dyadic number.
#[derive(Clone, Debug)]
pub struct Exact {
    mantissa: IBig,
    exponent: isize,
}

/// A vector of them.
pub type Exact3 = [Exact; 3];

impl Exact {
    pub const ZERO: Self = Self { mantissa: IBig::ZERO, exponent: 0 };

    pub fn new(mantissa: IBig, exponent: isize) -> Self {
        Self { mantissa, exponent }
    }

    /// `None` for NaN and infinity.
    pub fn from_f64(x: f64) -> Option<Self> {
        let bits = x.to_bits();
        let (power, fraction) = ((bits >> 52 & 0x7ff) as isize, bits & ((1 << 52) - 1));
        // Subnormal numbers have the exponent of the least normal ones, and no leading 1.
        let mantissa = if power == 0 { fraction } else { fraction | 1 << 52 };
        let zeros = mantissa.trailing_zeros() % 64;
        let mantissa = IBig::from(mantissa >> zeros);
        let mantissa = if x.is_sign_negative() { -mantissa } else { mantissa };
        x.is_finite().then(|| Self::new(mantissa, power.max(1) - 1075 + zeros as isize))
    }

    /// `None` for NaN and infinity.
    pub fn from_f32(x: f32) -> Option<Self> {
        Self::from_f64(x.into())
    }

    pub fn integer(x: i64) -> Self {
        Self::new(x.into(), 0)
    }

    /// Its sign, as it compares to 0.
    pub fn sign(&self) -> Ordering {
        self.mantissa.cmp(&IBig::ZERO)
    }

    pub fn is_zero(&self) -> bool {
        self.mantissa == IBig::ZERO
    }

    /// The least k with |x| < 2^k; far below all others for 0.
    pub fn magnitude(&self) -> isize {
        if self.is_zero() { isize::MIN / 4 } else { self.exponent + self.mantissa.bit_len() as isize }
    }

    /// x · 2^k.
    pub fn scaled(&self, k: isize) -> Self {
        Self::new(self.mantissa.clone(), self.exponent + k)
    }

    pub fn squared(&self) -> Self {
        self * self
    }

    pub fn abs(&self) -> Self {
        Self::new(self.mantissa.clone().abs(), self.exponent)
    }

    /// x · 2^−`exponent`, rounded down to a whole number.
    pub fn floor_at(&self, exponent: isize) -> IBig {
        let shift = self.exponent - exponent;
        if shift >= 0 { &self.mantissa << shift as usize } else { &self.mantissa >> shift.unsigned_abs() }
    }

    /// The exponent of the last bit.
    pub fn exponent(&self) -> isize {
        self.exponent
    }

    /// x / `divisor`, cut off after [`BITS`] bits at least; the last bit is 1 when something was cut off, so that rounding
    /// to f64 is right. `divisor` must not be 0.
    pub fn quotient(&self, divisor: &Self) -> Self {
        let shift = BITS + divisor.mantissa.bit_len() as isize - self.mantissa.bit_len() as isize;
        let shift = shift.max(0);
        let numerator = &self.mantissa << shift as usize;
        let quotient = &numerator / &divisor.mantissa;
        let rest = numerator != &quotient * &divisor.mantissa;
        let (sign, magnitude) = (quotient << 1usize).into_parts();
        let magnitude = magnitude | u8::from(rest);
        // A quotient has at least BITS bits, unless it is 0: so its sign is not lost.
        Self::new(IBig::from_parts(sign, magnitude), self.exponent - divisor.exponent - shift - 1)
    }

    /// ⌊x / `divisor`⌋ for a divisor above 0, kept within 64 bits.
    pub fn floor_quotient(&self, divisor: &Self) -> i64 {
        let (a, b, _) = aligned(self, divisor);
        let quotient = a.div_euclid(b);
        i64::try_from(&quotient).unwrap_or(if quotient > IBig::ZERO { i64::MAX } else { i64::MIN })
    }

    /// √x, cut off like a quotient; 0 for x ≤ 0.
    pub fn sqrt(&self) -> Self {
        if self.sign() != Ordering::Greater {
            return Self::ZERO;
        }
        let shift = (2 * BITS - self.mantissa.bit_len() as isize).max(0);
        let shift = shift + (self.exponent - shift).rem_euclid(2);
        let (_, radicand) = (&self.mantissa << shift as usize).into_parts();
        let root = radicand.sqrt();
        let rest = radicand != &root * &root;
        let root = (root << 1usize) | u8::from(rest);
        Self::new(root.into(), (self.exponent - shift) / 2 - 1)
    }

    /// The nearest f64, the even one of two; below the least normal number, one of the two nearest.
    pub fn to_f64(&self) -> f64 {
        let (sign, magnitude) = self.mantissa.clone().into_parts();
        let cut = magnitude.bit_len().saturating_sub(64);
        let lost = magnitude.trailing_zeros().is_some_and(|zeros| zeros < cut);
        // What was cut off counts as a last bit, so that the conversion from 64 bits to 53 rounds to the right side.
        let top = u64::try_from(magnitude >> cut).unwrap_or(u64::MAX) | u64::from(lost);
        let power = (self.exponent + cut as isize).clamp(-4000, 4000) as i32;
        let half = power / 2;
        let scaled = top as f64 * 2f64.powi(half) * 2f64.powi(power - half);
        if sign == Sign::Negative { -scaled } else { scaled }
    }
}

impl PartialEq for Exact {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other).is_eq()
    }
}

impl Eq for Exact {}

impl PartialOrd for Exact {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Exact {
    fn cmp(&self, other: &Self) -> Ordering {
        (self - other).sign()
    }
}

impl Neg for &Exact {
    type Output = Exact;
    fn neg(self) -> Exact {
        Exact::new(-&self.mantissa, self.exponent)
    }
}

impl Neg for Exact {
    type Output = Exact;
    fn neg(self) -> Exact {
        -&self
    }
}

/// Two numbers' mantissas over their lesser exponent. Zero takes the other's, as its own may be far away.
fn aligned(a: &Exact, b: &Exact) -> (IBig, IBig, isize) {
    let exponent = match (a.is_zero(), b.is_zero()) {
        (true, _) => b.exponent,
        (_, true) => a.exponent,
        _ => a.exponent.min(b.exponent),
    };
    (a.floor_at(exponent), b.floor_at(exponent), exponent)
}

impl Add for &Exact {
    type Output = Exact;
    fn add(self, other: &Exact) -> Exact {
        let (a, b, exponent) = aligned(self, other);
        Exact::new(a + b, exponent)
    }
}

impl Sub for &Exact {
    type Output = Exact;
    fn sub(self, other: &Exact) -> Exact {
        let (a, b, exponent) = aligned(self, other);
        Exact::new(a - b, exponent)
    }
}

impl Mul for &Exact {
    type Output = Exact;
    fn mul(self, other: &Exact) -> Exact {
        Exact::new(&self.mantissa * &other.mantissa, self.exponent + other.exponent)
    }
}

/// The operators for values, so that formulae read like formulae.
macro_rules! by_value {
    ($($trait:ident $method:ident)*) => {$(
        impl $trait for Exact {
            type Output = Exact;
            fn $method(self, other: Exact) -> Exact {
                (&self).$method(&other)
            }
        }
        impl $trait<&Exact> for Exact {
            type Output = Exact;
            fn $method(self, other: &Exact) -> Exact {
                (&self).$method(other)
            }
        }
        impl $trait<Exact> for &Exact {
            type Output = Exact;
            fn $method(self, other: Exact) -> Exact {
                self.$method(&other)
            }
        }
    )*};
}
by_value!(Add add Sub sub Mul mul);

/// `None` where a component is not finite.
pub fn vector(v: DVec3) -> Option<Exact3> {
    Some([Exact::from_f64(v.x)?, Exact::from_f64(v.y)?, Exact::from_f64(v.z)?])
}

pub fn dot(a: &Exact3, b: &Exact3) -> Exact {
    &a[0] * &b[0] + &a[1] * &b[1] + &a[2] * &b[2]
}

pub fn cross(a: &Exact3, b: &Exact3) -> Exact3 {
    let minor = |i: usize, j: usize| &a[i] * &b[j] - &a[j] * &b[i];
    [minor(1, 2), minor(2, 0), minor(0, 1)]
}

pub fn minus(a: &Exact3, b: &Exact3) -> Exact3 {
    std::array::from_fn(|i| &a[i] - &b[i])
}

pub fn times(k: &Exact, a: &Exact3) -> Exact3 {
    std::array::from_fn(|i| k * &a[i])
}

/// a + t b.
pub fn along(a: &Exact3, t: &Exact, b: &Exact3) -> Exact3 {
    std::array::from_fn(|i| &a[i] + t * &b[i])
}

/// A vector of length 1 in the same direction, each component off by at most 2⁻⁵¹; NaN for a zero vector.
pub fn unit(v: &Exact3) -> DVec3 {
    // A common power of two keeps the squares from leaving f64's range.
    let greatest = v.iter().map(Exact::magnitude).max().unwrap_or(0);
    let v = DVec3::from_array([0, 1, 2].map(|i| v[i].scaled(-greatest).to_f64()));
    v / v.length()
}
