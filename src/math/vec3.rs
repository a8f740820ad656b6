//! Three-vectors over lanes.

use std::ops::{Add, Mul, Neg, Sub};

use super::Lanes;

/// 1 / √x from the hardware's estimate and `steps` of Newton's steps y (3 − x y²) / 2, for comparison with a root and a
/// division.
#[inline(never)]
pub fn inverse_root<L: Lanes>(x: L, steps: u32) -> L {
    let half = x * L::splat(-0.5);
    let mut y = x.estimate_inverse_root();
    for _ in 0..steps {
        y = y * (half * y).mul_add(y, L::splat(1.5));
    }
    y
}

/// A vector in every lane; `Vec3<f32>` is a single one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Vec3<L> {
    /// First component.
    pub x: L,
    /// Second component.
    pub y: L,
    /// Third component.
    pub z: L,
}

impl<L: Lanes> Vec3<L> {
    /// From components.
    #[inline(always)]
    pub fn new(x: L, y: L, z: L) -> Self {
        Self { x, y, z }
    }

    /// One vector in every lane.
    #[inline(always)]
    pub fn splat(v: glam::Vec3) -> Self {
        Self::new(L::splat(v.x), L::splat(v.y), L::splat(v.z))
    }

    /// Lanes `at..at + WIDTH` of three columns.
    #[inline(always)]
    pub fn load<const N: usize>(columns: &[[f32; N]; 3], at: usize) -> Self {
        Self::new(L::load(&columns[0][at..]), L::load(&columns[1][at..]), L::load(&columns[2][at..]))
    }

    /// Writes lanes `at..at + WIDTH` of three columns.
    #[inline(always)]
    pub fn store<const N: usize>(self, columns: &mut [[f32; N]; 3], at: usize) {
        self.x.store(&mut columns[0][at..]);
        self.y.store(&mut columns[1][at..]);
        self.z.store(&mut columns[2][at..]);
    }

    /// Scalar product: x·x' + (y·y' + z·z'), innermost first. Error at most 3 ε Σ|xᵢ x'ᵢ|.
    #[inline(always)]
    pub fn dot(self, o: Self) -> L {
        self.x.mul_add(o.x, self.y.mul_add(o.y, self.z * o.z))
    }

    /// Vector product.
    #[inline(always)]
    pub fn cross(self, o: Self) -> Self {
        Self::new(
            self.z.neg_mul_add(o.y, self.y * o.z),
            self.x.neg_mul_add(o.z, self.z * o.x),
            self.y.neg_mul_add(o.x, self.x * o.y),
        )
    }

    /// Component by component.
    #[inline(always)]
    pub fn times(self, o: Self) -> Self {
        Self::new(self.x * o.x, self.y * o.y, self.z * o.z)
    }

    /// self · s + o.
    #[inline(always)]
    pub fn mul_add(self, s: L, o: Self) -> Self {
        Self::new(self.x.mul_add(s, o.x), self.y.mul_add(s, o.y), self.z.mul_add(s, o.z))
    }

    /// Unit length: one square root, one division. Error at most 4 ε a component.
    #[inline(always)]
    pub fn normalize(self) -> Self {
        self * (L::splat(1.0) / self.dot(self).sqrt())
    }

    /// Unit length from the hardware's estimate of 1/√ and `steps` of Newton's: an error of the length of at most 2⁻¹¹,
    /// 2⁻²⁰ with one step and 8 ε with two. `None` for [`Vec3::normalize`]. The bits depend on the processor.
    #[inline(always)]
    pub fn normalize_by(self, steps: Option<u32>) -> Self {
        match steps {
            None => self.normalize(),
            Some(steps) => self * inverse_root(self.dot(self), steps),
        }
    }

    /// The two components after component `major`, and that.
    #[inline(always)]
    pub fn ordered(self, major: usize) -> [L; 3] {
        match major {
            0 => [self.y, self.z, self.x],
            1 => [self.z, self.x, self.y],
            _ => [self.x, self.y, self.z],
        }
    }

    /// The largest magnitude among the components.
    #[inline(always)]
    pub fn max_abs(self) -> L {
        self.x.abs().max(self.y.abs()).max(self.z.abs())
    }

    /// `self` where the mask is true, `other` elsewhere.
    #[inline(always)]
    pub fn select(self, mask: L::Mask, other: Self) -> Self {
        Self::new(self.x.select(mask, other.x), self.y.select(mask, other.y), self.z.select(mask, other.z))
    }

    /// Lane-wise minimum; `other` where either is NaN.
    #[inline(always)]
    pub fn min(self, other: Self) -> Self {
        Self::new(self.x.min(other.x), self.y.min(other.y), self.z.min(other.z))
    }

    /// Lane-wise maximum; `other` where either is NaN.
    #[inline(always)]
    pub fn max(self, other: Self) -> Self {
        Self::new(self.x.max(other.x), self.y.max(other.y), self.z.max(other.z))
    }
}

impl From<glam::Vec3> for Vec3<f32> {
    #[inline(always)]
    fn from(v: glam::Vec3) -> Self {
        Self { x: v.x, y: v.y, z: v.z }
    }
}

impl From<Vec3<f32>> for glam::Vec3 {
    #[inline(always)]
    fn from(v: Vec3<f32>) -> Self {
        glam::Vec3::new(v.x, v.y, v.z)
    }
}

impl<L: Lanes> Add for Vec3<L> {
    type Output = Self;
    #[inline(always)]
    fn add(self, o: Self) -> Self {
        Self::new(self.x + o.x, self.y + o.y, self.z + o.z)
    }
}

impl<L: Lanes> Sub for Vec3<L> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, o: Self) -> Self {
        Self::new(self.x - o.x, self.y - o.y, self.z - o.z)
    }
}

impl<L: Lanes> Mul<L> for Vec3<L> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, s: L) -> Self {
        Self::new(self.x * s, self.y * s, self.z * s)
    }
}

impl<L: Lanes> Neg for Vec3<L> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self::new(-self.x, -self.y, -self.z)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use wide::f32x8;

    #[test]
    fn estimates_of_unit_length_are_as_good_as_stated() {
        const ROUNDOFF: f64 = 0.5 * f32::EPSILON as f64;
        let mut worst = [0.0; 4];
        for i in 1..20_000 {
            let scale = 10f32.powi(i % 31 - 15);
            let v = glam::Vec3::new((i as f32).sin(), (1.7 * i as f32).cos(), (0.3 * i as f32).sin()) * scale;
            for (worst, steps) in worst.iter_mut().zip([None, Some(0), Some(1), Some(2)]) {
                let Vec3 { x, y, z } = Vec3::<f32x8>::splat(v).normalize_by(steps);
                let [x, y, z] = [x, y, z].map(|lanes| f64::from(lanes.to_array()[5]));
                *worst = f64::max(*worst, (glam::DVec3::new(x, y, z).length() - 1.0).abs());
            }
        }
        let [division, estimate, once, twice] = worst;
        assert!(division <= 4.0 * ROUNDOFF && twice <= 8.0 * ROUNDOFF, "{worst:?}");
        assert!(once <= 2f64.powi(-20) && estimate <= 2f64.powi(-11), "{worst:?}");
    }
}
