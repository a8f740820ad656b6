//! A ray as a plain struct, for whoever keeps rays in arrays of their own.

use glam::{DVec3, Vec3};

/// A ray, and the open interval (`t_min`, `t_max`) of distances in which hits count.
///
/// Distances are in lengths of `direction`, which is 1 to within 4 ε, and so in world units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ray {
    /// Where it starts; each coordinate within ±2⁶⁸.
    pub origin: Vec3,
    /// Its unit direction.
    pub direction: Vec3,
    /// The start of the interval, excluded; 0 or more.
    pub t_min: f32,
    /// The end of the interval, excluded; a ray whose end is below 0 or NaN hits nothing.
    pub t_max: f32,
}

impl Ray {
    /// A ray without an end. `direction` has unit length, and is taken as it is.
    pub fn new(origin: impl Into<Vec3>, direction: impl Into<Vec3>) -> Self {
        Self { origin: origin.into(), direction: direction.into(), t_min: 0.0, t_max: f32::INFINITY }
    }

    /// A ray from one point to another, which ends there. Where both are the same it hits nothing.
    pub fn between(from: impl Into<Vec3>, to: impl Into<Vec3>) -> Self {
        let (origin, to) = (from.into(), to.into());
        let (direction, t_max) = (to - origin).normalize_and_length();
        Self { origin, direction, t_min: 0.0, t_max }
    }

    /// The point at the distance `t`.
    pub fn at(&self, t: f32) -> Vec3 {
        self.origin + self.direction * t
    }

    /// Origin and direction in `f64`, the latter brought to length 1: the exact ray that stands in the `f32`s.
    pub fn line(&self) -> (DVec3, DVec3) {
        (self.origin.as_dvec3(), self.direction.as_dvec3().normalize())
    }
}
