//! From a compiled scene and a camera to an image.
pub mod output;

use crate::scene::{CameraDescription, Scene};
use glam::Vec3;

/// Which width the tracer runs at. Every width gives the same bits.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum Kernel {
    /// One ray at a time.
    X1,
    /// Four lanes.
    X4,
    /// Eight lanes.
    #[default]
    X8,
}

impl Kernel {
    /// All of them, narrowest first.
    pub const ALL: [Kernel; 3] = [Kernel::X1, Kernel::X4, Kernel::X8];
    /// `x1`, `x4`, `x8`.
    pub fn name(self) -> &'static str {
        ["x1", "x4", "x8"][self as usize]
    }
}

/// The lecture's camera: the eye and three corners of the screen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera {
    /// E.
    pub eye: Vec3,
    /// Top left corner of the screen.
    pub p0: Vec3,
    /// Top right corner.
    pub p1: Vec3,
    /// Bottom left corner.
    pub p2: Vec3,
}

impl Camera {
    /// From a description and the picture's width / height.
    pub fn new(_description: &CameraDescription, _aspect: f32) -> Self {
        Self { eye: Vec3::ZERO, p0: Vec3::ZERO, p1: Vec3::ZERO, p2: Vec3::ZERO }
    }

    /// Unit direction of the ray through p0 + u (p1 − p0) + v (p2 − p0).
    pub fn direction(&self, _u: f32, _v: f32) -> Vec3 {
        Vec3::Z
    }
}

/// Rays traced, by kind.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Counts {
    /// From the eye.
    pub primary: u64,
    /// Towards lights.
    pub shadow: u64,
    /// From mirrors.
    pub reflection: u64,
}

/// Linear radiance per pixel, row by row from the top.
#[derive(Clone, Debug, PartialEq)]
pub struct Film {
    /// Pixels across.
    pub width: usize,
    /// Pixels down.
    pub height: usize,
    /// Linear RGB.
    pub pixels: Vec<[f32; 3]>,
}

impl Film {
    /// A black film.
    pub fn new(width: usize, height: usize) -> Self {
        Self { width, height, pixels: vec![[0.0; 3]; width * height] }
    }
}

/// The nearest hits of the pixel-centre rays, row by row.
#[derive(Clone, Debug, PartialEq)]
pub struct PrimaryHits {
    /// Distance; infinite where nothing is hit.
    pub t: Vec<f32>,
    /// Primitive id; [`crate::trace::NONE`] where nothing is hit.
    pub primitive: Vec<u32>,
    /// Shading normal, facing the ray; zero where nothing is hit.
    pub normal: Vec<[f32; 3]>,
}

/// Renders with `samples` × `samples` rays a pixel on a regular grid, in the caller's rayon pool.
/// `progress` is called now and then with the share done, from any thread.
pub fn render(
    _scene: &Scene,
    _camera: &Camera,
    _kernel: Kernel,
    _samples: u32,
    _film: &mut Film,
    _progress: &(dyn Fn(f32) + Sync),
) -> Counts {
    for (i, p) in _film.pixels.iter_mut().enumerate() {
        *p = [i as f32 * 1e-3, 0.5, 0.0];
    }
    Counts::default()
}

/// Renders one sample a pixel straight to 0RGB with the sRGB curve, for a window; `pixels` holds width × height.
pub fn render_display(
    _scene: &Scene,
    _camera: &Camera,
    _kernel: Kernel,
    _width: usize,
    _height: usize,
    _pixels: &mut [u32],
) -> Counts {
    Counts::default()
}

/// Traces the pixel-centre rays only.
pub fn primary_hits(_scene: &Scene, _camera: &Camera, _kernel: Kernel, _width: usize, _height: usize) -> PrimaryHits {
    let n = _width * _height;
    PrimaryHits { t: vec![1.0; n], primitive: vec![0; n], normal: vec![[0.0, 0.0, 1.0]; n] }
}

/// Linear RGB to 0RGB with the sRGB curve, clamped to 0..1, NaN to 0.
pub fn tone_map(_rgb: [f32; 3]) -> u32 {
    u32::from_be_bytes([0, (_rgb[0] * 255.0) as u8, (_rgb[1] * 255.0) as u8, (_rgb[2] * 255.0) as u8])
}
