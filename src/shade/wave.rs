//! A wave: the rays of a tile that are one reflection deeper than the last, packed together.

use crate::math::{BATCH, LaneMask, Lanes, RayBatch, Vec3};

/// Rays on their way, and what they are worth.
#[derive(Clone, Debug)]
#[repr(align(64))]
pub struct Wave {
    /// The rays.
    pub rays: RayBatch,
    /// What a ray's radiance counts for in its pixel.
    pub weight: [f32; BATCH],
    /// The pixel of the tile.
    pub pixel: [u8; BATCH],
}

impl Default for Wave {
    /// No rays, but weight 1 and pixel i for ray i, as eye rays have them.
    fn default() -> Self {
        Self { rays: RayBatch::default(), weight: [1.0; BATCH], pixel: std::array::from_fn(|i| i as u8) }
    }
}

impl Wave {
    /// Adds the lanes of a packet where `mask` is true, in order; their rays have no end.
    #[inline(always)]
    pub fn append<L: Lanes>(&mut self, origin: Vec3<L>, direction: Vec3<L>, weight: L, pixel: &[u8], mask: L::Mask) {
        let to = self.rays.len;
        if mask.all() {
            origin.store(&mut self.rays.origin, to);
            direction.store(&mut self.rays.direction, to);
            L::splat(f32::INFINITY).store(&mut self.rays.t_max[to..]);
            weight.store(&mut self.weight[to..]);
            self.pixel[to..to + L::WIDTH].copy_from_slice(pixel);
            self.rays.len = to + L::WIDTH;
        } else {
            let (mut o, mut d, mut w) = ([[0.0; 8]; 3], [[0.0; 8]; 3], [0.0; 8]);
            origin.store(&mut o, 0);
            direction.store(&mut d, 0);
            weight.store(&mut w);
            let mut left = mask.bits();
            while left != 0 {
                let lane = left.trailing_zeros() as usize;
                let to = self.rays.len;
                for axis in 0..3 {
                    self.rays.origin[axis][to] = o[axis][lane];
                    self.rays.direction[axis][to] = d[axis][lane];
                }
                self.rays.t_max[to] = f32::INFINITY;
                self.weight[to] = w[lane];
                self.pixel[to] = pixel[lane];
                self.rays.len = to + 1;
                left &= left - 1;
            }
        }
        self.rays.common_origin = false;
    }
}

/// Watches the rays of a tile go by; `()` does not, at no cost.
pub trait Observer {
    /// The eye rays.
    fn primary(&mut self, _rays: &RayBatch) {}
    /// One light's shadow rays.
    fn shadow(&mut self, _rays: &RayBatch) {}
    /// A wave of mirrored rays.
    fn reflection(&mut self, _rays: &RayBatch) {}
}

impl Observer for () {}
