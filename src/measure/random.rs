//! Random numbers that are the same on every machine.

use glam::{DVec3, Vec3, dvec3, vec3};

/// PCG-XSH-RR (O'Neill, *PCG: A Family of Simple Fast Space-Efficient Statistically Good Algorithms for Random Number
/// Generation*, 2014), with 64 bits of state.
#[derive(Clone, Debug)]
pub struct Pcg(u64);

impl Pcg {
    /// The sequence of a seed.
    pub fn new(seed: u64) -> Self {
        let mut rng = Self(seed.wrapping_add(0x9e37_79b9_7f4a_7c15));
        rng.bits();
        rng
    }

    /// 32 random bits.
    pub fn bits(&mut self) -> u32 {
        let old = self.0;
        self.0 = old.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        ((((old >> 18) ^ old) >> 27) as u32).rotate_right((old >> 59) as u32)
    }

    /// From 0 up to but not including `n`.
    pub fn below(&mut self, n: usize) -> usize {
        ((u64::from(self.bits()) * n as u64) >> 32) as usize
    }

    /// True with probability `p`.
    pub fn chance(&mut self, p: f32) -> bool {
        self.range(0.0, 1.0) < p
    }

    /// One of `from`, which must not be empty.
    pub fn pick<T: Copy>(&mut self, from: &[T]) -> T {
        from[self.below(from.len())]
    }

    /// From `low` to `high`, on a grid of 2⁻²⁴ of the way.
    pub fn range(&mut self, low: f32, high: f32) -> f32 {
        low + (high - low) * ((self.bits() >> 8) as f32 / (1 << 24) as f32)
    }

    /// From `low` up to but not including `high`, on a grid of 2⁻³² of the way.
    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * (f64::from(self.bits()) / (1u64 << 32) as f64)
    }

    /// 1 or −1.
    pub fn sign(&mut self) -> f64 {
        if self.bits() >> 31 == 0 { 1.0 } else { -1.0 }
    }

    /// Within the cube from −1 to 1.
    pub fn cube(&mut self) -> Vec3 {
        vec3(self.range(-1.0, 1.0), self.range(-1.0, 1.0), self.range(-1.0, 1.0))
    }

    /// Evenly on the unit sphere.
    pub fn unit(&mut self) -> Vec3 {
        loop {
            let v = self.cube();
            if (0.01..=1.0).contains(&v.length_squared()) {
                return v.normalize();
            }
        }
    }

    /// Evenly on the unit sphere, in `f64`.
    pub fn direction(&mut self) -> DVec3 {
        loop {
            let v = dvec3(self.between(-1.0, 1.0), self.between(-1.0, 1.0), self.between(-1.0, 1.0));
            if (0.01..=1.0).contains(&v.length_squared()) {
                return v.normalize();
            }
        }
    }

    /// A unit vector across the unit vector `axis`, in `f64`.
    pub fn across(&mut self, axis: DVec3) -> DVec3 {
        loop {
            let v = axis.cross(self.direction());
            if v.length_squared() > 0.01 {
                return v.normalize();
            }
        }
    }
}
