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
