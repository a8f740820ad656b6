//! One ray at a time, for drawing and picking: a batch of one.

use super::{Blocked, Candidates, HitBatch, NONE, RayBatch, intersect, occluded};
use crate::scene::Scene;
use glam::Vec3;

/// One hit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    /// Distance along the unit direction.
    pub t: f32,
    /// The primitive's id.
    pub primitive: u32,
}

/// Nearest hit of one ray in (0, ∞); `direction` has unit length.
pub fn intersect_one(scene: &Scene, origin: Vec3, direction: Vec3) -> Option<Hit> {
    let mut rays = RayBatch::default();
    rays.push(origin, direction, 0.0, f32::INFINITY);
    let mut hits = HitBatch::default();
    intersect::<f32>(scene, &rays, &mut hits, &mut Candidates::default());
    (hits.primitive[0] != NONE).then_some(Hit { t: hits.t[0], primitive: hits.primitive[0] })
}

/// Whether anything lies in (0, t_max) along one ray; `direction` has unit length.
pub fn occluded_one(scene: &Scene, origin: Vec3, direction: Vec3, t_max: f32) -> bool {
    let mut rays = RayBatch::default();
    rays.push(origin, direction, 0.0, t_max);
    let mut blocked = Blocked::default();
    occluded::<f32>(scene, &rays, &mut blocked, &mut Candidates::default());
    blocked.get(0, 1) != 0
}
