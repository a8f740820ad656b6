//! Colours from images, and the sky.
use crate::scene::{Dome, Sky, Texture};
use glam::{DVec2, DVec3};
use std::f64::consts::{PI, TAU};

/// The linear colour at (u, v).
pub(super) fn sample(texture: &Texture, uv: DVec2) -> DVec3 {
    let (width, height) = (texture.width as i64, texture.height as i64);
    // Whole repeats are taken off first, so that no number of them is too large for an index.
    let x = uv.x.rem_euclid(1.0) * width as f64;
    let y = (-uv.y).rem_euclid(1.0) * height as f64;
    interpolate(x, y, |column, row| {
        let index = row.rem_euclid(height) * width + column.rem_euclid(width);
        DVec3::from_array(texture.texels[index as usize].map(|byte| linear(f64::from(byte) / 255.0)))
    })
}

/// The radiance along a ray that hits nothing.
pub(super) fn sky(sky: &Sky, direction: DVec3) -> DVec3 {
    match sky {
        Sky::Color(color) => color.as_dvec3(),
        Sky::Gradient { below, above } => below.as_dvec3().lerp(above.as_dvec3(), (direction.y + 1.0) / 2.0),
        Sky::Dome(dome) => panorama(dome, direction),
    }
}

fn panorama(dome: &Dome, direction: DVec3) -> DVec3 {
    let (width, height) = (dome.width as i64, dome.height as i64);
    let turns = 0.5 + direction.x.atan2(-direction.z) / TAU + f64::from(dome.rotation) / 360.0;
    let x = turns.rem_euclid(1.0) * width as f64;
    let y = direction.normalize().y.clamp(-1.0, 1.0).acos() / PI * height as f64;
    interpolate(x, y, |column, row| {
        let index = row.clamp(0, height - 1) * width + column.rem_euclid(width);
        DVec3::from_array(dome.texels[index as usize].map(f64::from))
    })
}

/// The mean of the four texels whose centres, at whole numbers and a half, surround (x, y).
fn interpolate(x: f64, y: f64, texel: impl Fn(i64, i64) -> DVec3) -> DVec3 {
    let (x, y) = (x - 0.5, y - 0.5);
    let (column, row) = (x.floor(), y.floor());
    let (right, down) = (x - column, y - row);
    let weighed = |i: i64, j: i64| {
        let across = if i == 0 { 1.0 - right } else { right };
        let along = if j == 0 { 1.0 - down } else { down };
        across * along * texel(column as i64 + i, row as i64 + j)
    };
    weighed(0, 0) + weighed(1, 0) + weighed(0, 1) + weighed(1, 1)
}

/// From the sRGB curve to linear light.
fn linear(x: f64) -> f64 {
    if x <= 0.04045 { x / 12.92 } else { ((x + 0.055) / 1.055).powf(2.4) }
}

#[cfg(test)]
#[path = "tests/images.rs"]
mod tests;
