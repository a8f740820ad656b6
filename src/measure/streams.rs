//! The rays of a picture, recorded as the renderer makes them, so that tracing can be timed alone.

use crate::math::RayBatch;
use crate::render::{Camera, Kernel, record};
use crate::scene::Scene;

/// Batches kept a kind at the most, of 8 KiB each and 2 KiB for its hits: few enough to stay in the second-level
/// cache, as the rays of a tile do when a picture is rendered. A larger picture is sampled evenly.
const MOST: usize = 96;

/// A picture's rays by kind, every batch as the tracer gets it.
#[derive(Debug, Default)]
pub struct Streams {
    /// From the eye.
    pub primary: Vec<RayBatch>,
    /// Between hit points and lights, of all waves.
    pub shadow: Vec<RayBatch>,
    /// From mirrors, of all waves.
    pub reflection: Vec<RayBatch>,
    /// Through transparent surfaces, of all waves.
    pub refraction: Vec<RayBatch>,
}

impl Streams {
    /// The names of the kinds, in the order of the fields.
    pub const KINDS: [&'static str; 4] = ["primary", "shadow", "reflection", "refraction"];

    /// The batches of all kinds, in the order of [`Self::KINDS`].
    pub fn kinds(&self) -> [&[RayBatch]; 4] {
        [&self.primary, &self.shadow, &self.reflection, &self.refraction]
    }

    /// The rays of a picture of `width` × `height`.
    pub fn of(scene: &Scene, camera: &Camera, width: usize, height: usize) -> Self {
        let tiles = width.div_ceil(crate::render::TILE) * height.div_ceil(crate::render::TILE);
        // Odd, so that the tiles do not all lie in a few columns.
        let stride = tiles.div_ceil(MOST) | 1;
        let mut streams = Self::default();
        record(scene, camera, Kernel::X8, [width, height], stride, &mut streams);
        for batches in [&mut streams.primary, &mut streams.shadow, &mut streams.reflection, &mut streams.refraction] {
            thin(batches);
        }
        streams
    }
}

/// Keeps [`MOST`] batches, evenly spaced.
fn thin(batches: &mut Vec<RayBatch>) {
    let step = batches.len() as f64 / MOST as f64;
    if step > 1.0 {
        *batches = (0..MOST).map(|i| batches[(i as f64 * step) as usize].clone()).collect();
    }
}

impl crate::shade::Observer for Streams {
    fn primary(&mut self, rays: &RayBatch) {
        self.primary.push(rays.clone());
    }
    fn shadow(&mut self, rays: &RayBatch) {
        self.shadow.push(rays.clone());
    }
    fn reflection(&mut self, rays: &RayBatch) {
        self.reflection.push(rays.clone());
    }
    fn refraction(&mut self, rays: &RayBatch) {
        self.refraction.push(rays.clone());
    }
}
