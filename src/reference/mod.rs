//! TODO.
use crate::scene::Description;
use glam::DVec3;

/// STUB.
#[derive(Clone, Copy)]
pub struct Hit {
    /// STUB.
    pub t: f64,
    /// STUB.
    pub primitive: u32,
    /// STUB.
    pub normal: DVec3,
}
/// STUB.
pub fn render(_d: &Description, w: usize, h: usize, _samples: u32) -> Vec<DVec3> {
    vec![DVec3::splat(0.25); w * h]
}
/// STUB.
pub fn hits(_d: &Description, w: usize, h: usize) -> Vec<Option<Hit>> {
    vec![None; w * h]
}
