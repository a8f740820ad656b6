//! A wave: rays of a tile that are equally many reflections and refractions from the eye, packed together.

use super::medium::MediumStack;
use crate::math::{BATCH, LaneMask, Lanes, MAX_LANES, RayBatch, Vec3};
use crate::scene::Plan;
use crate::trace::Contents;

/// Rays on their way, and what they are worth.
#[derive(Clone, Debug)]
#[repr(align(64))]
pub struct Wave {
    /// The rays.
    pub rays: RayBatch,
    /// The weight of a ray's radiance in its pixel.
    pub weight: [f32; BATCH],
    /// The share of it that absorption has left, by channel; of account only where the plan says that something
    /// absorbs.
    pub tint: [[f32; BATCH]; 3],
    /// The media that a ray is in; of account only where the plan says that something refracts.
    pub inside: [MediumStack; BATCH],
    /// The pixel of the tile.
    pub pixel: [u8; BATCH],
}

impl Default for Wave {
    /// No rays, but weight 1 and pixel i for ray i, as eye rays have them.
    fn default() -> Self {
        Self {
            rays: RayBatch::default(),
            weight: [1.0; BATCH],
            tint: [[1.0; BATCH]; 3],
            inside: [MediumStack::default(); BATCH],
            pixel: std::array::from_fn(|i| i as u8),
        }
    }
}

/// A packet of rays that leave a surface.
#[derive(Clone, Copy)]
pub struct Leaving<'a, L> {
    /// Where they start.
    pub origin: Vec3<L>,
    /// Unit directions.
    pub direction: Vec3<L>,
    /// The weights of their radiance in their pixels.
    pub weight: L,
    /// See [`Wave::tint`].
    pub tint: Vec3<L>,
    /// See [`Wave::inside`]; one a lane.
    pub inside: &'a [MediumStack],
    /// Their pixels, one a lane.
    pub pixel: &'a [u8],
}

impl Wave {
    /// Adds the lanes of a packet where `mask` is true, in order, as many as fit; their rays have no end. What is left
    /// of the mask.
    #[inline(always)]
    pub fn append<L: Lanes, C: Contents>(&mut self, plan: &Plan, leaving: &Leaving<L>, mask: L::Mask) -> u32 {
        self.rays.common_origin = false;
        let to = self.rays.len;
        if mask.all() && to + L::WIDTH <= BATCH {
            leaving.origin.store(&mut self.rays.origin, to);
            leaving.direction.store(&mut self.rays.direction, to);
            L::splat(f32::INFINITY).store(&mut self.rays.t_max[to..]);
            leaving.weight.store(&mut self.weight[to..]);
            if C::ALL && plan.absorbs {
                leaving.tint.store(&mut self.tint, to);
            }
            let (inside, pixel) = (&leaving.inside[..L::WIDTH], &leaving.pixel[..L::WIDTH]);
            let to_pixel = &mut self.pixel[to..to + L::WIDTH];
            for lane in 0..L::WIDTH {
                if C::ALL && plan.refracts {
                    self.inside[to + lane] = inside[lane];
                }
                to_pixel[lane] = pixel[lane];
            }
            self.rays.len = to + L::WIDTH;
            return 0;
        }
        let (mut o, mut d, mut w, mut tint) =
            ([[0.0; MAX_LANES]; 3], [[0.0; MAX_LANES]; 3], [0.0; MAX_LANES], [[0.0; MAX_LANES]; 3]);
        leaving.origin.store(&mut o, 0);
        leaving.direction.store(&mut d, 0);
        leaving.weight.store(&mut w);
        if C::ALL && plan.absorbs {
            leaving.tint.store(&mut tint, 0);
        }
        let mut left = mask.bits();
        while left != 0 && self.rays.len < BATCH {
            let lane = left.trailing_zeros() as usize;
            let to = self.rays.len;
            for axis in 0..3 {
                self.rays.origin[axis][to] = o[axis][lane];
                self.rays.direction[axis][to] = d[axis][lane];
                if C::ALL && plan.absorbs {
                    self.tint[axis][to] = tint[axis][lane];
                }
            }
            self.rays.t_max[to] = f32::INFINITY;
            self.weight[to] = w[lane];
            if C::ALL && plan.refracts {
                self.inside[to] = leaving.inside[lane];
            }
            self.pixel[to] = leaving.pixel[lane];
            self.rays.len = to + 1;
            left &= left - 1;
        }
        left
    }
}

/// A part of the work on a tile.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stage {
    /// Making the eye rays.
    Eye,
    /// Tracing a wave, finding the surfaces that it hits, and the sky where it hits none.
    Arrive,
    /// Making a light's shadow rays.
    Fire,
    /// Tracing them, and adding light and highlights where nothing blocks them.
    Light,
    /// Giving the light to the pixels; making and queueing the rays that go on.
    Leave,
    /// The display's curve.
    Curve,
    /// Putting the pixels into the picture.
    Store,
}

/// Watches a tile being made: its rays go by, a call for each wave, and its stages; `()` does not.
pub trait Observer {
    /// What was done since the last call was this.
    #[inline(always)]
    fn done(&mut self, _stage: Stage) {}
    /// The eye rays.
    fn primary(&mut self, _rays: &RayBatch) {}
    /// One light's shadow rays.
    fn shadow(&mut self, _rays: &RayBatch) {}
    /// A wave of mirrored rays.
    fn reflection(&mut self, _rays: &RayBatch) {}
    /// A wave of refracted rays.
    fn refraction(&mut self, _rays: &RayBatch) {}
}

impl Observer for () {}
