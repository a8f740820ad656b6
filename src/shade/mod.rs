//! Whitted shading.
use crate::scene::Scene;
use glam::Vec3;

/// What a segment of a path is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SegmentKind {
    /// From the eye.
    Primary,
    /// Between a hit point and a light.
    Shadow {
        /// Whether something lies between them.
        blocked: bool,
    },
    /// From a mirror.
    Reflection,
}

/// One straight piece of the light paths that one eye ray sets off.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Segment {
    /// What it is.
    pub kind: SegmentKind,
    /// Where it starts.
    pub from: Vec3,
    /// Where it ends; None when it leaves the scene.
    pub to: Option<Vec3>,
    /// Its unit direction.
    pub direction: Vec3,
}

/// All segments an eye ray sets off, in the order they are traced; for drawing.
pub fn path(_scene: &Scene, _origin: Vec3, _direction: Vec3) -> Vec<Segment> {
    todo!()
}
