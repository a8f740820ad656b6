//! Colours from images, and the sky.
use super::{Edge, Edges};
use crate::scene::{Dome, Sky, Texture, Wrap};
use glam::DVec3;
use std::f64::consts::{PI, TAU};

/// The linear colour at a surface's (u, v), whose ends have such edges.
pub(super) fn sample(texture: &Texture, uv: [f64; 2], edges: Edges, size: f64, wrap: Wrap) -> DVec3 {
    let sides = [texture.width, texture.height].map(|side| side as f64);
    // The texels from one edge to the other, where there are edges: from 0 to so many.
    let texels = [0, 1].map(|k| match (wrap, edges[k]) {
        (Wrap::Clamp, _) => Some(sides[k]),
        (Wrap::Repeat, _) | (Wrap::Ends, [Edge::None, Edge::None]) => None,
        (Wrap::Ends, _) => Some((sides[k] / size).round().max(1.0)),
    });
    // Without edges whole repeats are taken off first, so that no number of them is too large.
    let [x, y] = [0, 1].map(|k| match texels[k] {
        None => (uv[k] / size).rem_euclid(1.0) * sides[k],
        Some(count) => (uv[k] / size * sides[k]).clamp(0.0, count),
    });
    let texel = |column: f64, row: f64| {
        let [column, row] = [(column, 0), (row, 1)].map(|(i, k)| {
            let i = texels[k].map_or(i, |count| i.clamp(0.0, count - 1.0));
            i.rem_euclid(sides[k]) as usize
        });
        // Rows are stored from the top, and counted from the bottom.
        texture.texels[(texture.height - 1 - row) * texture.width + column]
    };
    let texel =
        |column: f64, row: f64| DVec3::from_array(texel(column, row).map(|byte| linear(f64::from(byte) / 255.0)));
    let mut color = interpolate(x, y, texel);
    let round = (sides[0] / size).round().clamp(1.0, sides[0]);
    for (k, edge) in edges[1].into_iter().enumerate() {
        let away = if k == 0 { uv[1] } else { 1.0 - uv[1] } / size * sides[1];
        if wrap == Wrap::Ends && edge == Edge::Point && away < 0.5 {
            let row = if k == 0 { 0.0 } else { f64::INFINITY };
            let all: DVec3 = (0..round as usize).map(|column| texel(column as f64, row)).sum();
            color = (all / round).lerp(color, 2.0 * away.max(0.0));
        }
    }
    color
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
    let [width, height] = [dome.width, dome.height].map(|side| side as f64);
    let turns = 0.5 + direction.x.atan2(-direction.z) / TAU + f64::from(dome.rotation) / 360.0;
    let x = turns.rem_euclid(1.0) * width;
    let y = direction.normalize().y.clamp(-1.0, 1.0).acos() / PI * height;
    interpolate(x, y, |column, row| {
        let index = row.clamp(0.0, height - 1.0) * width + column.rem_euclid(width);
        DVec3::from_array(dome.texels[index as usize].map(f64::from))
    })
}

/// The mean of the four texels whose centres, at whole numbers and a half, surround (x, y).
fn interpolate(x: f64, y: f64, texel: impl Fn(f64, f64) -> DVec3) -> DVec3 {
    let (x, y) = (x - 0.5, y - 0.5);
    let (column, row) = (x.floor(), y.floor());
    let (right, down) = (x - column, y - row);
    let weighed = |i: f64, j: f64| {
        let across = if i == 0.0 { 1.0 - right } else { right };
        let along = if j == 0.0 { 1.0 - down } else { down };
        across * along * texel(column + i, row + j)
    };
    weighed(0.0, 0.0) + weighed(1.0, 0.0) + weighed(0.0, 1.0) + weighed(1.0, 1.0)
}

/// From the sRGB curve to linear light.
fn linear(x: f64) -> f64 {
    if x <= 0.04045 { x / 12.92 } else { ((x + 0.055) / 1.055).powf(2.4) }
}

#[cfg(test)]
#[path = "tests/images.rs"]
mod tests;
