//! The colours of textures at points where all of u comes together: the poles of a sphere, the middle of a disc.

use glam::Vec3;

use super::{Material, Pigment, Texture, Wrap};
use crate::math::linear_of_bytes;

/// How many of `count` texels a repeat a mapping from 0 to 1 has that covers so many repeats: those that lie within by
/// half or more, and at least one.
pub(crate) fn texels(count: usize, repeats: f32) -> f32 {
    (count as f32 * repeats).round().max(1.0)
}

/// The linear colours where v is 0 and 1 ([`Wrap::Ends`]), by material; black for one that needs none.
pub(super) fn poles(materials: &[Material], textures: &[std::sync::Arc<Texture>]) -> Vec<[Vec3; 2]> {
    let of = |material: &Material| match material.pigment {
        Pigment::Texture { texture, size, wrap: Wrap::Ends } => ends(&textures[texture], 1.0 / size),
        _ => [Vec3::ZERO; 2],
    };
    materials.iter().map(of).collect()
}

fn ends(texture: &Texture, repeats: f32) -> [Vec3; 2] {
    let Texture { width, height, ref texels } = *texture;
    let around = self::texels(width, repeats).min(width as f32) as usize;
    let linear = linear_of_bytes();
    let mean = |row: usize| {
        let channel = |c: usize| {
            let row = &texels[row * width..][..around];
            row.iter().map(|texel| f64::from(linear[usize::from(texel[c])])).sum::<f64>() / around as f64
        };
        Vec3::new(channel(0) as f32, channel(1) as f32, channel(2) as f32)
    };
    let last = (self::texels(height, repeats) as usize - 1) % height;
    [mean(height - 1), mean(height - 1 - last)]
}
