//! Boxes: the public one, and the builder's in SIMD registers.

use glam::{Vec3, Vec3A};

/// Axis-aligned box.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Aabb {
    /// The least coordinates.
    pub min: Vec3,
    /// The greatest coordinates.
    pub max: Vec3,
}

impl Aabb {
    /// Holds nothing; the neutral element of [`Aabb::union`].
    pub const EMPTY: Self = Self { min: Vec3::INFINITY, max: Vec3::NEG_INFINITY };

    /// The smallest box around both.
    #[must_use]
    pub fn union(self, other: Self) -> Self {
        Self { min: self.min.min(other.min), max: self.max.max(other.max) }
    }

    /// The smallest box around this one and a point.
    #[must_use]
    pub fn extend(self, point: Vec3) -> Self {
        Self { min: self.min.min(point), max: self.max.max(point) }
    }

    /// Whether nothing is inside.
    pub fn is_empty(self) -> bool {
        !self.min.cmple(self.max).all()
    }

    /// Whether all of `other` is inside, the surface counted in.
    pub fn contains(self, other: Self) -> bool {
        self.min.cmple(other.min).all() && self.max.cmpge(other.max).all()
    }

    /// Half the surface's area: 0 for an empty box, +∞ for one with sides beyond about 10¹⁹, never NaN.
    pub fn area(self) -> f32 {
        self.area_f64() as f32
    }

    /// The middle; never infinite where the box is finite.
    pub fn center(self) -> Vec3 {
        self.min * 0.5 + self.max * 0.5
    }

    /// Half the surface's area in f64, where no product of two f32 lengths overflows or vanishes.
    pub(super) fn area_f64(self) -> f64 {
        if self.is_empty() {
            return 0.0;
        }
        let d = self.max.as_dvec3() - self.min.as_dvec3();
        // A flat box of infinite length would give 0 · ∞; such a box is as good as none.
        let area = d.x * d.y + d.y * d.z + d.z * d.x;
        if area.is_nan() { 0.0 } else { area }
    }
}

/// A box while building.
#[derive(Clone, Copy, Debug)]
pub(super) struct Bounds {
    pub min: Vec3A,
    pub max: Vec3A,
}

impl Bounds {
    pub const EMPTY: Self = Self { min: Vec3A::INFINITY, max: Vec3A::NEG_INFINITY };

    #[inline(always)]
    pub fn add(&mut self, other: &Self) {
        self.min = self.min.min(other.min);
        self.max = self.max.max(other.max);
    }

    #[inline(always)]
    pub fn add_point(&mut self, point: Vec3A) {
        self.min = self.min.min(point);
        self.max = self.max.max(point);
    }

    pub fn union(mut self, other: Self) -> Self {
        self.add(&other);
        self
    }

    pub fn aabb(self) -> Aabb {
        Aabb { min: self.min.into(), max: self.max.into() }
    }

    /// Half the area of the box times `scale` each way; 0 when empty.
    ///
    /// With 1/4 · `scale` ≤ 1 / longest side nothing overflows, as each corner is scaled before they are subtracted.
    #[inline(always)]
    pub fn scaled_area(&self, scale: f32) -> f32 {
        let d = (self.max * scale - self.min * scale).max(Vec3A::ZERO);
        d.x * (d.y + d.z) + d.y * d.z
    }
}
