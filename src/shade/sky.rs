//! What rays see that hit nothing.

use crate::math::{Lanes, Vec3};
use crate::scene::Sky;

/// The radiance in unit directions; see [`Sky`].
#[inline(always)]
pub fn radiance<L: Lanes>(sky: &Sky, direction: Vec3<L>) -> Vec3<L> {
    match sky {
        Sky::Color(color) => Vec3::splat(*color),
        Sky::Gradient { below, above } => {
            let s = direction.y.mul_add(L::splat(0.5), L::splat(0.5));
            let below = Vec3::splat(*below);
            (Vec3::splat(*above) - below).mul_add(s, below)
        }
        Sky::Dome(_) => Vec3::splat(glam::Vec3::ZERO),
    }
}
