//! Groups of rays behind beams, as the primitives of a block are tested against them.

use super::beam::Beam;
use super::beams::Beams;
use crate::math::{Lanes, Vec3};
use std::marker::PhantomData;
use wide::{f32x8, f32x16};

/// A group of rays behind a beam, or several of [`Beams`], whose rays are tested in packets.
pub trait Behind: Sized {
    /// How wide they are tested.
    type Lanes: Lanes;
    /// Around the rays.
    fn beam(&self) -> &Beam;
    /// The lanes whose boxes the beam meets.
    fn met(&self, extent: &[Vec3<f32x8>; 2]) -> u32;
    /// The groups that may meet the box in a lane, as bits.
    fn groups(&self, extent: &[Vec3<f32x8>; 2], lane: usize) -> u32;
}

/// One group.
pub struct Group<'a, L, const MIXED: bool> {
    beam: &'a Beam,
    lane: usize,
    limit: f32,
    lanes: PhantomData<L>,
}

impl<'a, L, const MIXED: bool> Group<'a, L, MIXED> {
    /// Group `lane`, whose rays look as far as `limit`.
    #[inline(always)]
    pub fn new(beam: &'a Beam, lane: usize, limit: f32) -> Self {
        Self { beam, lane, limit, lanes: PhantomData }
    }
}

impl<L: Lanes, const MIXED: bool> Behind for Group<'_, L, MIXED> {
    type Lanes = L;
    #[inline(always)]
    fn beam(&self) -> &Beam {
        self.beam
    }
    #[inline(always)]
    fn met(&self, extent: &[Vec3<f32x8>; 2]) -> u32 {
        beam_meets::<MIXED>(self.beam, extent, self.limit)
    }
    #[inline(always)]
    fn groups(&self, _: &[Vec3<f32x8>; 2], _: usize) -> u32 {
        1 << self.lane
    }
}

/// The groups of [`Beams`] whose bits are set.
pub struct Groups<'a, L, const MIXED: bool> {
    beams: &'a Beams,
    groups: u32,
    limits: f32x16,
    limit: f32,
    lanes: PhantomData<L>,
}

impl<'a, L, const MIXED: bool> Groups<'a, L, MIXED> {
    /// Groups that look as far as `limits`, of which `limit` is the furthest.
    #[inline(always)]
    pub fn new(beams: &'a Beams, groups: u32, limits: f32x16, limit: f32) -> Self {
        Self { beams, groups, limits, limit, lanes: PhantomData }
    }
}

impl<L: Lanes, const MIXED: bool> Behind for Groups<'_, L, MIXED> {
    type Lanes = L;
    #[inline(always)]
    fn beam(&self) -> &Beam {
        &self.beams.whole
    }
    #[inline(always)]
    fn met(&self, extent: &[Vec3<f32x8>; 2]) -> u32 {
        beam_meets::<MIXED>(&self.beams.whole, extent, self.limit)
    }
    #[inline(always)]
    fn groups(&self, [low, high]: &[Vec3<f32x8>; 2], lane: usize) -> u32 {
        let pick = |v: &f32x8| v.as_array()[lane & 7];
        let faces = |axis: usize| match axis {
            0 => [pick(&low.x), pick(&high.x)],
            1 => [pick(&low.y), pick(&high.y)],
            _ => [pick(&low.z), pick(&high.z)],
        };
        self.groups & self.beams.meets::<MIXED>(faces, self.limits)
    }
}

#[inline(always)]
fn beam_meets<const MIXED: bool>(beam: &Beam, [low, high]: &[Vec3<f32x8>; 2], limit: f32) -> u32 {
    let faces = |axis: usize, near: usize| {
        let (low, high) = match axis {
            0 => (low.x, high.x),
            1 => (low.y, high.y),
            _ => (low.z, high.z),
        };
        if near == 0 { [low, high] } else { [high, low] }
    };
    beam.meets::<MIXED>(faces, f32x8::splat(limit)).1
}
