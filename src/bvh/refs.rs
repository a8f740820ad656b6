//! The references that the builder moves around: a primitive's box, its index and class in 32 bytes.

use glam::{Vec3, Vec3A, Vec4};
use rayon::prelude::*;

use super::aabb::Aabb;
use super::aabb::Bounds;
use super::kind::Class;
use super::limits::MAX_PRIMITIVES;
use super::source::Source;

/// Set in every stored index, so that its bits, read as a number, are neither NaN nor subnormal and so cost no
/// arithmetic more than others do.
const NORMAL: u32 = 1 << 30;

/// A primitive: the fourth lanes hold its index and class.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Ref {
    min: Vec4,
    max: Vec4,
}

impl Ref {
    /// Coordinates are clamped to what is finite, and NaN to the widest: a primitive without a proper box is then
    /// looked at by every ray, and no arithmetic of the builder gives NaN. −0 becomes +0, so that a minimum does not
    /// depend on the order in which it is taken.
    pub fn new(index: usize, bounds: Aabb, class: Class) -> Self {
        let finite = |v: f32, nan: f32| if v.is_nan() { nan } else { v.clamp(f32::MIN, f32::MAX) + 0.0 };
        let min = bounds.min.to_array().map(|v| finite(v, f32::MIN));
        let max = bounds.max.to_array().map(|v| finite(v, f32::MAX));
        Self {
            min: Vec3::from(min).extend(f32::from_bits(index as u32 | NORMAL)),
            max: Vec3::from(max).extend(f32::from(class.0)),
        }
    }

    #[inline(always)]
    pub fn index(&self) -> u32 {
        self.min.w.to_bits() & !NORMAL
    }

    #[inline(always)]
    pub fn class(&self) -> Class {
        Class(self.max.w as u16)
    }

    #[inline(always)]
    pub fn bounds(&self) -> Bounds {
        Bounds { min: Vec3A::from_vec4(self.min), max: Vec3A::from_vec4(self.max) }
    }

    /// Whether box and class are the same.
    pub fn coincides(&self, other: &Self) -> bool {
        self.min.truncate() == other.min.truncate() && self.max == other.max
    }

    /// Half the box's middle: so that the distance of two is finite whatever the boxes.
    #[inline(always)]
    pub fn center(&self) -> Vec3A {
        Vec3A::from_vec4(self.min * 0.25 + self.max * 0.25)
    }
}

/// The boxes around the primitives of a range and around their [`Ref::center`]s.
#[derive(Clone, Copy, Debug)]
pub(super) struct Extent {
    pub bounds: Bounds,
    pub centers: Bounds,
}

impl Extent {
    pub fn of(refs: &[Ref]) -> Self {
        let empty = Self { bounds: Bounds::EMPTY, centers: Bounds::EMPTY };
        refs.iter().fold(empty, |mut extent, r| {
            extent.bounds.add(&r.bounds());
            extent.centers.add_point(r.center());
            extent
        })
    }

    pub fn union(self, other: Self) -> Self {
        Self { bounds: self.bounds.union(other.bounds), centers: self.centers.union(other.centers) }
    }
}

/// All primitives of a source, in its order, in pieces where that is wanted and room is left.
pub(super) fn collect(source: &impl Source) -> Vec<Ref> {
    let all = (0..source.len()).into_par_iter().with_min_len(1024);
    if source.cut() {
        let pieces = all.clone().flat_map_iter(|i| {
            let mut pieces = Vec::new();
            source.pieces(i, |bounds| pieces.push(Ref::new(i, bounds, source.class(i))));
            pieces
        });
        let pieces: Vec<_> = pieces.collect();
        if pieces.len() <= MAX_PRIMITIVES {
            return pieces;
        }
    }
    all.map(|i| Ref::new(i, source.bounds(i), source.class(i))).collect()
}
