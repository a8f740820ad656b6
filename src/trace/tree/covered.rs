//! Triangles and the packets that they cover some rays of: all are found first, and looked at after.
//!
//! Whether a triangle covers any ray of a packet is so in about half of the tests: a processor that guesses each answer,
//! and waits for what follows where it was wrong, loses more time by that than by the tests.

use crate::math::{BATCH, LaneMask, Lanes, MAX_LANES};

/// The most packets that a group of rays has.
const PACKETS: usize = BATCH / 16;
/// As many as a block and all groups can have at the greatest width, and room for one group's at the least.
const ROOM: usize = 128 + PACKETS;

/// What was found and not yet looked at.
#[derive(Clone, Debug)]
pub struct Covered {
    /// The packet, the triangle's lane, the rays as bits.
    found: [[u32; 3]; ROOM],
    len: usize,
}

impl Default for Covered {
    fn default() -> Self {
        Self { found: [[0; 3]; ROOM], len: 0 }
    }
}

impl Covered {
    /// Notes that the triangle in `lane` covers these rays of packet `at`, unless there are none; there must be room.
    #[inline(always)]
    pub fn note<L: Lanes>(&mut self, at: usize, lane: usize, rays: L::Mask) {
        let rays = rays.bits();
        self.found[self.len] = [at as u32, lane as u32, rays];
        self.len += usize::from(rays != 0);
    }

    /// Whether there may be no room for another group's.
    #[inline(always)]
    pub fn is_full<L: Lanes>(&self) -> bool {
        // Of the widest there is always room.
        L::WIDTH < MAX_LANES && self.len > ROOM - PACKETS
    }

    /// How many there are; they are forgotten, and stay to be read until the next is noted.
    #[inline(always)]
    pub fn take(&mut self) -> usize {
        std::mem::take(&mut self.len)
    }

    /// Packet, lane and rays of one.
    #[inline(always)]
    pub fn get<L: Lanes>(&self, i: usize) -> (usize, usize, L::Mask) {
        let [at, lane, rays] = self.found[i];
        (at as usize, lane as usize & 7, L::Mask::from_bits(rays))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use wide::{f32x8, f32x16};

    fn rays<L: Lanes>(bits: u32) -> L::Mask {
        L::Mask::from_bits(bits)
    }

    #[test]
    fn what_covers_nothing_is_not_noted_and_the_rest_stays_in_order() {
        let mut covered = Covered::default();
        for (i, bits) in [0b100, 0, 0b1010_0001, 0, 0].into_iter().enumerate() {
            covered.note::<f32x8>(8 * i, i, rays::<f32x8>(bits));
        }
        assert_eq!(covered.take(), 2);
        let found = [0, 1].map(|i| covered.get::<f32x8>(i)).map(|(at, lane, rays)| (at, lane, rays.bits()));
        assert_eq!(found, [(0, 0, 0b100), (16, 2, 0b1010_0001)]);
        assert_eq!(covered.take(), 0);
    }

    /// Every pair of a triangle and a group has room at every width, when what is full is emptied.
    #[test]
    fn there_is_room_for_all() {
        fn fill<L: Lanes>() -> usize {
            let (mut covered, mut seen) = (Covered::default(), 0);
            for pair in 0..128 {
                for at in (0..PACKETS).step_by(L::WIDTH) {
                    covered.note::<L>(16 * (pair % 16) + at, pair / 16, rays::<L>(1));
                }
                if covered.is_full::<L>() {
                    seen += covered.take();
                }
            }
            seen + covered.take()
        }
        assert_eq!([fill::<f32>(), fill::<f32x8>(), fill::<f32x16>()], [128 * 16, 128 * 2, 128]);
    }
}
