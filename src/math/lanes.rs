//! One kernel text for all widths: a kernel is generic over [`Lanes`].

use std::fmt::Debug;
use std::ops::{Add, BitAnd, BitOr, Div, Mul, Neg, Not, Sub};

use bytemuck::cast;
use wide::{f32x4, f32x8, f32x16, i32x4, i32x8, i32x16, u32x4, u32x8, u32x16};

/// The bits of √½.
const SQRT_HALF: i32 = 0x3f35_04f3;
/// The bits of 1.
const ONE: i32 = 127 << 23;

/// One truth value a lane.
pub trait LaneMask: Copy + Debug + BitAnd<Output = Self> + BitOr<Output = Self> + Not<Output = Self> {
    /// Whether any lane is true.
    fn any(self) -> bool;
    /// Whether every lane is true.
    fn all(self) -> bool;
    /// Lane i as bit i.
    fn bits(self) -> u32;
    /// Bit i as lane i; higher bits are ignored.
    fn from_bits(bits: u32) -> Self;
}

/// `WIDTH` numbers that are worked on at once: `f32` (x1), [`f32x4`] (x4), [`f32x8`] (x8), and [`f32x16`] (x16), which is
/// what x8 works in where there are registers of that width, and no kernel of its own.
///
/// Every operation is one IEEE 754 operation per lane, so that within one build all widths give the same bits.
/// [`Lanes::mul_add`] is fused in a build with FMA and rounds twice in a build without, on every width.
pub trait Lanes:
    Copy
    + Debug
    + Send
    + Sync
    + 'static
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
{
    /// The number of lanes.
    const WIDTH: usize;
    /// `x1`, `x4`, `x8`, `x16`.
    const NAME: &'static str;
    /// The result of comparisons.
    type Mask: LaneMask;
    /// This type, or one twice as wide where that pays: for loops over packets that no one outside sees.
    type Wider: Lanes;

    /// One number in every lane.
    fn splat(value: f32) -> Self;
    /// The first `WIDTH` numbers of a slice. Panics when it is shorter.
    fn load(from: &[f32]) -> Self;
    /// Writes the lanes to the start of a slice. Panics when it is shorter.
    fn store(self, to: &mut [f32]);
    /// self · a + b.
    fn mul_add(self, a: Self, b: Self) -> Self;
    /// b − self · a.
    #[inline(always)]
    fn neg_mul_add(self, a: Self, b: Self) -> Self {
        (-self).mul_add(a, b)
    }
    /// Square root, correctly rounded; NaN below zero.
    fn sqrt(self) -> Self;
    /// 1 / √ as the processor estimates it, within 1.5 · 2⁻¹²; the bits are the processor's. Elsewhere than on x86-64 a
    /// root and a division.
    fn estimate_inverse_root(self) -> Self;
    /// Magnitude.
    fn abs(self) -> Self;
    /// The largest whole number not above.
    fn floor(self) -> Self;
    /// The lesser; `other` where either is NaN, so an accumulator passed as `other` outlives a NaN.
    fn min(self, other: Self) -> Self;
    /// The greater; `other` where either is NaN.
    fn max(self, other: Self) -> Self;
    /// self < other; false where either is NaN, as all comparisons here.
    fn lt(self, other: Self) -> Self::Mask;
    /// self ≤ other.
    fn le(self, other: Self) -> Self::Mask;
    /// self = other.
    fn eq(self, other: Self) -> Self::Mask;
    /// self > other.
    #[inline(always)]
    fn gt(self, other: Self) -> Self::Mask {
        other.lt(self)
    }
    /// self ≥ other.
    #[inline(always)]
    fn ge(self, other: Self) -> Self::Mask {
        other.le(self)
    }
    /// `self` where the mask is true, `other` elsewhere; moves bits, whatever they mean.
    fn select(self, mask: Self::Mask, other: Self) -> Self;

    /// Zero in every lane.
    #[inline(always)]
    fn zero() -> Self {
        Self::splat(0.0)
    }
    /// An id in every lane, as the bits of a number; only ever selected and stored.
    #[inline(always)]
    fn splat_id(id: u32) -> Self {
        Self::splat(f32::from_bits(id))
    }
    /// Lanes whose id is `id`; reads the first `WIDTH` ids. Panics when there are fewer.
    fn id_mask(ids: &[u32], id: u32) -> Self::Mask;
    /// Lanes whose bits are those of `id`.
    fn is_id(self, id: u32) -> Self::Mask;
    /// The first `WIDTH` ids, as bits. Panics when there are fewer.
    fn load_ids(from: &[u32]) -> Self;
    /// Writes the lanes' bits, as ids, to the start of a slice. Panics when it is shorter.
    fn store_ids(self, to: &mut [u32]);
    /// Writes the first `WIDTH` distances and ids where the mask is true. Panics when there are fewer.
    fn store_hits(t: Self, id: Self, mask: Self::Mask, to_t: &mut [f32], to_id: &mut [u32]);
    /// Exponent e and mantissa m with self = m · 2^e and m in [√½, √2), for normal numbers above zero.
    fn exponent_and_mantissa(self) -> (Self, Self);
    /// 2^n for self = n + 1.5 · 2²³ with a whole n from −126 to 127.
    fn power_of_two(self) -> Self;
    /// The least lane; unspecified where one is NaN.
    fn least(self) -> f32;
    /// The greatest lane; unspecified where one is NaN.
    #[inline(always)]
    fn greatest(self) -> f32 {
        -(-self).least()
    }
}

/// a · b + c as [`Lanes::mul_add`] does it in this build; `f32::mul_add` would call a slow library function
/// where there is no FMA instruction.
#[inline(always)]
fn fused_mul_add(a: f32, b: f32, c: f32) -> f32 {
    if cfg!(any(target_feature = "fma", target_arch = "aarch64")) { a.mul_add(b, c) } else { a * b + c }
}

/// The first `N` numbers of a slice, to be written; the library's copy of slices is a call where a crate is compiled in
/// several units.
#[inline(always)]
fn room<T, const N: usize>(to: &mut [T]) -> &mut [T; N] {
    (&mut to[..N]).try_into().expect("the slice has this length")
}

/// The widest of the types: columns that are loaded from any place are padded to a multiple of it.
pub const MAX_LANES: usize = 16;

impl LaneMask for bool {
    #[inline(always)]
    fn any(self) -> bool {
        self
    }
    #[inline(always)]
    fn all(self) -> bool {
        self
    }
    #[inline(always)]
    fn bits(self) -> u32 {
        self as u32
    }
    #[inline(always)]
    fn from_bits(bits: u32) -> Self {
        bits & 1 != 0
    }
}

impl Lanes for f32 {
    const WIDTH: usize = 1;
    const NAME: &'static str = "x1";
    type Mask = bool;
    type Wider = f32;

    #[inline(always)]
    fn splat(value: f32) -> Self {
        value
    }
    #[inline(always)]
    fn load(from: &[f32]) -> Self {
        from[0]
    }
    #[inline(always)]
    fn store(self, to: &mut [f32]) {
        to[0] = self;
    }
    #[inline(always)]
    fn mul_add(self, a: Self, b: Self) -> Self {
        fused_mul_add(self, a, b)
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        f32::sqrt(self)
    }
    #[inline(always)]
    fn estimate_inverse_root(self) -> Self {
        f32x4::splat(self).estimate_inverse_root().to_array()[0]
    }
    #[inline(always)]
    fn abs(self) -> Self {
        f32::abs(self)
    }
    #[inline(always)]
    fn floor(self) -> Self {
        f32::floor(self)
    }
    #[inline(always)]
    fn min(self, other: Self) -> Self {
        if self < other { self } else { other }
    }
    #[inline(always)]
    fn max(self, other: Self) -> Self {
        if self > other { self } else { other }
    }
    #[inline(always)]
    fn lt(self, other: Self) -> bool {
        self < other
    }
    #[inline(always)]
    fn le(self, other: Self) -> bool {
        self <= other
    }
    #[inline(always)]
    fn eq(self, other: Self) -> bool {
        self == other
    }
    #[inline(always)]
    fn select(self, mask: bool, other: Self) -> Self {
        if mask { self } else { other }
    }
    #[inline(always)]
    fn id_mask(ids: &[u32], id: u32) -> bool {
        ids[0] == id
    }
    #[inline(always)]
    fn is_id(self, id: u32) -> bool {
        self.to_bits() == id
    }
    #[inline(always)]
    fn load_ids(from: &[u32]) -> Self {
        f32::from_bits(from[0])
    }
    #[inline(always)]
    fn store_ids(self, to: &mut [u32]) {
        to[0] = self.to_bits();
    }
    #[inline(always)]
    fn store_hits(t: Self, id: Self, mask: bool, to_t: &mut [f32], to_id: &mut [u32]) {
        if mask {
            to_id[0] = id.to_bits();
            to_t[0] = t;
        }
    }
    #[inline(always)]
    fn exponent_and_mantissa(self) -> (Self, Self) {
        let exponent = (self.to_bits() as i32).wrapping_sub(SQRT_HALF) >> 23;
        (exponent as f32, f32::from_bits((self.to_bits() as i32).wrapping_sub(exponent << 23) as u32))
    }
    #[inline(always)]
    fn power_of_two(self) -> Self {
        f32::from_bits((self.to_bits() << 23).wrapping_add(ONE as u32))
    }
    #[inline(always)]
    fn least(self) -> f32 {
        self
    }
}

/// A wide type as lanes; `$int` and `$signed` have as many integers, `$powers` is lane i ↦ 2^i.
macro_rules! wide_lanes {
    ($float:ident, $wider:ident, $int:ident, $signed:ident, $from_signed:ident, $width:literal, $name:literal, $powers:expr) => {
        impl LaneMask for $float {
            #[inline(always)]
            fn any(self) -> bool {
                $float::any(self)
            }
            #[inline(always)]
            fn all(self) -> bool {
                $float::all(self)
            }
            #[inline(always)]
            fn bits(self) -> u32 {
                self.to_bitmask() as u32
            }
            #[inline(always)]
            fn from_bits(bits: u32) -> Self {
                let powers = $int::new($powers);
                cast::<$int, $float>(($int::splat(bits) & powers).simd_eq(powers))
            }
        }

        impl Lanes for $float {
            const WIDTH: usize = $width;
            const NAME: &'static str = $name;
            type Mask = $float;
            type Wider = $wider;

            #[inline(always)]
            fn splat(value: f32) -> Self {
                $float::splat(value)
            }
            #[inline(always)]
            fn load(from: &[f32]) -> Self {
                let lanes: [f32; $width] = from[..$width].try_into().expect("the slice has this length");
                $float::new(lanes)
            }
            #[inline(always)]
            fn store(self, to: &mut [f32]) {
                *room(to) = self.to_array();
            }
            #[inline(always)]
            fn mul_add(self, a: Self, b: Self) -> Self {
                $float::mul_add(self, a, b)
            }
            #[inline(always)]
            fn neg_mul_add(self, a: Self, b: Self) -> Self {
                self.mul_neg_add(a, b)
            }
            #[inline(always)]
            fn sqrt(self) -> Self {
                $float::sqrt(self)
            }
            #[inline(always)]
            fn estimate_inverse_root(self) -> Self {
                if cfg!(not(target_arch = "x86_64")) {
                    return Self::ONE / $float::sqrt(self);
                }
                // Sixteen lanes have an estimate of other bits.
                let mut quarters: [f32x4; $width / 4] = cast(self);
                for quarter in &mut quarters {
                    *quarter = quarter.recip_sqrt();
                }
                cast(quarters)
            }
            #[inline(always)]
            fn abs(self) -> Self {
                $float::abs(self)
            }
            #[inline(always)]
            fn floor(self) -> Self {
                $float::floor(self)
            }
            #[inline(always)]
            fn min(self, other: Self) -> Self {
                // On x86 the instruction has the NaN rule that we state; elsewhere we spell it out.
                if cfg!(target_arch = "x86_64") {
                    self.fast_min(other)
                } else {
                    self.select(self.simd_lt(other), other)
                }
            }
            #[inline(always)]
            fn max(self, other: Self) -> Self {
                if cfg!(target_arch = "x86_64") {
                    self.fast_max(other)
                } else {
                    self.select(self.simd_gt(other), other)
                }
            }
            #[inline(always)]
            fn lt(self, other: Self) -> Self {
                self.simd_lt(other)
            }
            #[inline(always)]
            fn le(self, other: Self) -> Self {
                self.simd_le(other)
            }
            #[inline(always)]
            fn eq(self, other: Self) -> Self {
                self.simd_eq(other)
            }
            #[inline(always)]
            fn select(self, mask: Self, other: Self) -> Self {
                wide::Select::select(mask, self, other)
            }
            #[inline(always)]
            fn id_mask(ids: &[u32], id: u32) -> Self {
                let ids: [u32; $width] = ids[..$width].try_into().expect("the slice has this length");
                cast::<$int, $float>($int::new(ids).simd_eq($int::splat(id)))
            }
            #[inline(always)]
            fn is_id(self, id: u32) -> Self {
                cast::<$int, $float>(cast::<$float, $int>(self).simd_eq($int::splat(id)))
            }
            #[inline(always)]
            fn load_ids(from: &[u32]) -> Self {
                let ids: [u32; $width] = from[..$width].try_into().expect("the slice has this length");
                cast::<$int, $float>($int::new(ids))
            }
            #[inline(always)]
            fn store_ids(self, to: &mut [u32]) {
                *room(to) = cast::<$float, $int>(self).to_array();
            }
            #[inline(always)]
            fn store_hits(t: Self, id: Self, mask: Self, to_t: &mut [f32], to_id: &mut [u32]) {
                if LaneMask::all(mask) {
                    t.store(to_t);
                    id.store_ids(to_id);
                } else {
                    // The types have methods of their own of this name: ours is called by the trait's.
                    let old: [u32; $width] = to_id[..$width].try_into().expect("the slice has this length");
                    Lanes::select(id, mask, cast::<$int, $float>($int::new(old))).store_ids(to_id);
                    Lanes::select(t, mask, $float::load(to_t)).store(to_t);
                }
            }
            #[inline(always)]
            fn exponent_and_mantissa(self) -> (Self, Self) {
                let bits = cast::<$float, $signed>(self);
                let exponent = (bits - $signed::splat(SQRT_HALF)) >> 23;
                ($float::$from_signed(exponent), cast::<$signed, $float>(bits - (exponent << 23)))
            }
            #[inline(always)]
            fn power_of_two(self) -> Self {
                cast::<$signed, $float>((cast::<$float, $signed>(self) << 23) + $signed::splat(ONE))
            }
            #[inline(always)]
            fn least(self) -> f32 {
                // Halves first: the shortest chain of operations that wait for each other.
                let mut lanes = self.to_array();
                let mut left = $width / 2;
                while left > 0 {
                    for i in 0..left {
                        lanes[i] = Lanes::min(lanes[i + left], lanes[i]);
                    }
                    left /= 2;
                }
                lanes[0]
            }
        }
    };
}

/// Sixteen lanes pay where there are registers of that width.
#[cfg(target_feature = "avx512f")]
type WiderThan8 = f32x16;
#[cfg(not(target_feature = "avx512f"))]
type WiderThan8 = f32x8;

/// 2⁰ … 2¹⁵.
const POWERS: [u32; 16] = [1, 2, 4, 8, 16, 32, 64, 128, 256, 512, 1024, 2048, 4096, 8192, 16384, 32768];

wide_lanes!(f32x4, f32x4, u32x4, i32x4, from_i32x4, 4, "x4", [1, 2, 4, 8]);
wide_lanes!(f32x8, WiderThan8, u32x8, i32x8, from_i32x8, 8, "x8", [1, 2, 4, 8, 16, 32, 64, 128]);
wide_lanes!(f32x16, f32x16, u32x16, i32x16, from_i32x16, 16, "x16", POWERS);

#[cfg(test)]
mod tests {
    use super::*;

    /// Numbers that tell operations apart: signed zeros, NaN, infinities, subnormals, halves.
    const PROBES: [f32; 16] = [
        0.0,
        -0.0,
        1.0,
        -1.5,
        0.1,
        3.0e38,
        -3.0e38,
        1.0e-40,
        f32::INFINITY,
        f32::NEG_INFINITY,
        f32::NAN,
        2.5,
        -2.5,
        1.0e7,
        0.333_333_34,
        -7.25,
    ];

    fn bits_of<L: Lanes>(op: impl Fn(L, L, L) -> L) -> Vec<u32> {
        let mut out = Vec::new();
        for shift in 0..PROBES.len() {
            for at in (0..PROBES.len()).step_by(L::WIDTH) {
                let turned = |k: usize| -> Vec<f32> {
                    (0..L::WIDTH).map(|i| PROBES[(at + i + k * shift) % PROBES.len()]).collect()
                };
                let mut lanes = vec![0.0; L::WIDTH];
                op(L::load(&turned(0)), L::load(&turned(1)), L::load(&turned(3))).store(&mut lanes);
                out.extend(lanes.iter().map(|v| if v.is_nan() { u32::MAX } else { v.to_bits() }));
            }
        }
        out
    }

    macro_rules! same_on_all_widths {
        ($($name:ident: |$a:ident, $b:ident, $c:ident| $op:expr;)*) => {$(
            #[test]
            fn $name() {
                // Generic, so that the trait's methods are meant and not the types' own of the same name.
                fn op<L: Lanes>($a: L, $b: L, $c: L) -> L {
                    $op
                }
                let one = bits_of::<f32>(op);
                assert_eq!(one, bits_of::<f32x4>(op), "x4");
                assert_eq!(one, bits_of::<f32x8>(op), "x8");
                assert_eq!(one, bits_of::<f32x16>(op), "x16");
            }
        )*};
    }

    same_on_all_widths! {
        add: |a, b, _c| a + b;
        sub: |a, b, _c| a - b;
        mul: |a, b, _c| a * b;
        div: |a, b, _c| a / b;
        neg: |a, _b, _c| -a;
        mul_add: |a, b, c| a.mul_add(b, c);
        neg_mul_add: |a, b, c| a.neg_mul_add(b, c);
        sqrt: |a, _b, _c| a.sqrt();
        abs: |a, _b, _c| a.abs();
        floor: |a, _b, _c| a.floor();
        min: |a, b, _c| a.min(b);
        max: |a, b, _c| a.max(b);
        lt: |a, b, c| a.select(a.lt(b), c);
        le: |a, b, c| a.select(a.le(b), c);
        eq: |a, b, c| a.select(a.eq(b), c);
        exponent: |a, _b, _c| a.max(L::splat(1e-37)).exponent_and_mantissa().0;
        mantissa: |a, _b, _c| a.max(L::splat(1e-37)).exponent_and_mantissa().1;
        power_of_two: |a, _b, _c| (a.max(L::splat(-99.0)).min(L::splat(99.0)) + L::splat(12_582_912.0)).power_of_two();
        gt_and_not: |a, b, c| a.select(!a.gt(b) & c.ge(b), c);
    }

    #[test]
    fn min_and_max_give_the_other_for_nan() {
        fn check<L: Lanes>() {
            let nan = L::splat(f32::NAN);
            let two = L::splat(2.0);
            assert!(nan.min(two).eq(two).all() && nan.max(two).eq(two).all(), "{}", L::NAME);
        }
        check::<f32>();
        check::<f32x4>();
        check::<f32x8>();
        check::<f32x16>();
    }

    #[test]
    fn masks_turn_into_bits_and_back() {
        for bits in 0..256 {
            assert_eq!(<f32x16 as LaneMask>::from_bits(bits * 257).bits(), bits * 257);
            assert_eq!(<f32x8 as LaneMask>::from_bits(bits).bits(), bits);
            assert_eq!(<f32x4 as LaneMask>::from_bits(bits).bits(), bits & 15);
            assert_eq!(<bool as LaneMask>::from_bits(bits).bits(), bits & 1);
        }
    }
}
