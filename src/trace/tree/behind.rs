//! Which groups of rays a block's primitives are tested with: those whose beams meet the primitive's box.

use super::beam::Beam;
use super::beams::Beams;
use super::bits::Bits;
use super::edges::Shears;
use crate::bvh::BLOCK;
use crate::math::Vec3;
use wide::{f32x8, f32x16};

/// A block's primitives that any group meets.
pub struct Met<'a> {
    /// The primitives, as bits.
    pub primitives: u32,
    /// Each one's groups, as bits.
    pub groups: [u32; BLOCK],
    /// The axis of the largest component of all directions, where it is known.
    pub major: Option<usize>,
    /// The groups' shears, where the primitives' edges tell more than their boxes.
    pub shears: Option<&'a Shears>,
}

/// Groups of rays behind beams that meet a block.
pub trait Behind {
    /// Those of the `used` primitives whose boxes are met, and by which groups; by all, where shears are known and wanted,
    /// to tell by `edges`.
    fn met(&self, extent: &[Vec3<f32x8>; 2], used: u32, edges: bool) -> Met<'_>;
}

/// One group.
pub struct Group<'a, const MIXED: bool> {
    beam: &'a Beam,
    lane: usize,
    limit: f32,
}

impl<'a, const MIXED: bool> Group<'a, MIXED> {
    /// Group `lane`, whose rays look as far as `limit`.
    #[inline(always)]
    pub fn new(beam: &'a Beam, lane: usize, limit: f32) -> Self {
        Self { beam, lane, limit }
    }
}

impl<const MIXED: bool> Behind for Group<'_, MIXED> {
    fn met(&self, extent: &[Vec3<f32x8>; 2], used: u32, _: bool) -> Met<'_> {
        let primitives = beam_meets::<MIXED>(self.beam, extent, self.limit) & used;
        Met { primitives, groups: [1 << self.lane; BLOCK], major: self.beam.major, shears: None }
    }
}

/// The groups of [`Beams`] whose bits are set.
pub struct Groups<'a, const MIXED: bool> {
    beams: &'a Beams,
    groups: u32,
    limits: f32x16,
    limit: f32,
}

impl<'a, const MIXED: bool> Groups<'a, MIXED> {
    /// Groups that look as far as `limits`, of which `limit` is the furthest.
    #[inline(always)]
    pub fn new(beams: &'a Beams, groups: u32, limits: f32x16, limit: f32) -> Self {
        Self { beams, groups, limits, limit }
    }
}

impl<const MIXED: bool> Behind for Groups<'_, MIXED> {
    fn met(&self, extent: &[Vec3<f32x8>; 2], used: u32, edges: bool) -> Met<'_> {
        let beam = &self.beams.whole;
        let mut met = Met { primitives: 0, groups: [0; BLOCK], major: beam.major, shears: None };
        if let (true, Some(shears)) = (edges, &self.beams.shears) {
            let primitives = beam_meets::<MIXED>(beam, extent, self.limit) & used;
            return Met { primitives, groups: [self.groups; BLOCK], shears: Some(shears), ..met };
        }
        let [low, high] = extent;
        for lane in Bits(beam_meets::<MIXED>(beam, extent, self.limit) & used) {
            let pick = |v: &f32x8| v.as_array()[lane & (BLOCK - 1)];
            let faces = |axis: usize| match axis {
                0 => [pick(&low.x), pick(&high.x)],
                1 => [pick(&low.y), pick(&high.y)],
                _ => [pick(&low.z), pick(&high.z)],
            };
            let groups = self.groups & self.beams.meets::<MIXED>(faces, self.limits);
            met.groups[lane & (BLOCK - 1)] = groups;
            met.primitives |= u32::from(groups != 0) << lane;
        }
        met
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
