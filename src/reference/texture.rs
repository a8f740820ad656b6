//! Colours from images, and the sky.
use crate::scene::{Sky, Texture};
use glam::{DVec2, DVec3};

/// The linear colour at (u, v).
pub(super) fn sample(texture: &Texture, uv: DVec2) -> DVec3 {
    let _ = (texture, uv);
    DVec3::ONE
}

/// What a ray sees that hits nothing.
pub(super) fn sky(sky: &Sky, direction: DVec3) -> DVec3 {
    match sky {
        Sky::Color(color) => color.as_dvec3(),
        Sky::Gradient { below, above } => below.as_dvec3().lerp(above.as_dvec3(), (direction.y + 1.0) / 2.0),
        Sky::Dome(_) => DVec3::ZERO,
    }
}
