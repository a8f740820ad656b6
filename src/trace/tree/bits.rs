//! The bits of a mask, one after the other.

/// The places of the bits that are set, from the lowest on.
#[derive(Clone, Copy)]
pub struct Bits(pub u32);

impl Iterator for Bits {
    type Item = usize;
    #[inline(always)]
    fn next(&mut self) -> Option<usize> {
        let lowest = self.0.trailing_zeros();
        self.0 &= self.0.wrapping_sub(1);
        (lowest < u32::BITS).then_some(lowest as usize)
    }
}

/// The same of a wider mask.
#[derive(Clone, Copy)]
pub struct Bits128(pub u128);

impl Iterator for Bits128 {
    type Item = usize;
    #[inline(always)]
    fn next(&mut self) -> Option<usize> {
        let lowest = self.0.trailing_zeros();
        self.0 &= self.0.wrapping_sub(1);
        (lowest < u128::BITS).then_some(lowest as usize)
    }
}
