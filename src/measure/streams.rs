//! The rays of a picture, recorded as the renderer makes them, so that tracing can be timed alone.

use crate::math::RayBatch;
use crate::render::{Camera, Kernel, record};
use crate::scene::Scene;

/// Batches kept a kind at the most, 8 KiB each; a larger picture is sampled evenly, tile by tile.
const MOST: usize = 16_384;

/// A picture's rays by kind, every batch as the tracer gets it.
#[derive(Debug, Default)]
pub struct Streams {
    /// From the eye.
    pub primary: Vec<RayBatch>,
    /// From the lights.
    pub shadow: Vec<RayBatch>,
    /// From mirrors, of all waves.
    pub reflection: Vec<RayBatch>,
}

impl Streams {
    /// The rays of a picture of `width` × `height`.
    pub fn of(scene: &Scene, camera: &Camera, width: usize, height: usize) -> Self {
        let tiles = width.div_ceil(crate::render::TILE) * height.div_ceil(crate::render::TILE);
        let batches_a_tile = scene.plan.waves as usize * scene.lights.len().max(1);
        let stride = (tiles * batches_a_tile).div_ceil(MOST).max(1);
        let mut streams = Self::default();
        record(scene, camera, Kernel::X8, [width, height], stride, &mut streams);
        streams
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
}
