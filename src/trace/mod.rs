//! Nearest hit and any hit.
use crate::scene::Scene;
use glam::Vec3;

/// No primitive: what a ray that hits nothing carries as its id.
pub const NONE: u32 = u32::MAX;

/// One hit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    /// Distance along the unit direction.
    pub t: f32,
    /// The primitive's id.
    pub primitive: u32,
}

/// Nearest hit of one ray in (0, ∞); `direction` has unit length.
pub fn intersect_one(_scene: &Scene, _origin: Vec3, _direction: Vec3) -> Option<Hit> {
    todo!()
}

/// Whether anything lies in (0, t_max) along one ray; `direction` has unit length.
pub fn occluded_one(_scene: &Scene, _origin: Vec3, _direction: Vec3, _t_max: f32) -> bool {
    todo!()
}
