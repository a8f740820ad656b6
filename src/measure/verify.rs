//! Proves the packet tracer's answers against the scalar `f64` [`reference`](crate::reference).
//!
//! [`verify`] traces a scene with every kernel and compares: the hits of the pixel-centre rays, and the picture at
//! one sample a pixel, as displayed (after the sRGB curve, clamped to 0..1).
//!
//! # What passes
//!
//! All kernels agree to the last bit, and every answer that differs from the reference's is *explained* by the
//! stated error bound. An answer differs when
//! - the hit is of another primitive,
//! - the hit is of the same primitive, but t is off by more than a relative k·2^-24,
//! - the pixel is off by more than 1/255 in a channel, is not a number, or is infinite where the reference's is below 10³².
//!
//! # The error bound
//!
//! It is a bound on the *backward* error: an `f32` answer has to be the exact answer to a slightly different
//! question. With the unit roundoff u = 2^-24 of `f32` and k = [`K`], the question may differ by
//! - k·u in the ray's unit direction,
//! - k·u·s in its origin, where s is the largest of |E|, |p| and the size of the primitives that were hit (a sphere's
//!   radius, a triangle's longest edge); E is the eye and p the point the reference hit,
//! - k·u·s' in where a secondary ray hits, and up to k·u·s' in how far one starts off its surface and ends before a
//!   light, where s' is s for that surface and without the eye. In how far one starts off a transparent surface, s' is
//!   Σ |nᵢ pᵢ| and the primitive's size, with n the normal: so a body that is thin beside its coordinates is no excuse.
//!
//! The reference answers [`ROUNDS`] such questions, spread evenly over those differences, and
//! - a differing hit is explained when one of them hits that primitive, or would but for another that is not nearer by
//!   more than a relative k·u (as where a cylinder ends in a sphere of the same radius), at a t that lies within
//!   the range of their ts for it, give or take a relative k·u;
//! - a differing pixel is explained when every channel lies within the range of their values, give or take 1/255,
//!   and they disagree among themselves by more than 1/255 in each channel that differs: the pixel sits within the
//!   bound of an edge of an object, of a shadow, of a checker cell or of a mirror image.
//!
//! So a wrong answer in the interior of anything is never explained.
use crate::render::{self, Film, Kernel};
use crate::scene::{self, CompileOptions, Description};
use glam::DVec3;
use serde::Serialize;

mod bound;
mod compare;
pub(super) mod sample;
mod table;
mod truth;

pub use bound::{K, ROUNDS};
pub use compare::{Answers, Comparison};
pub use table::table;
pub use truth::Truth;

/// The findings of [`verify`] about one scene.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Report {
    /// The scene's name.
    pub scene: String,
    /// Width and height in pixels.
    pub size: [usize; 2],
    /// One for each kernel.
    pub kernels: Vec<KernelReport>,
    /// Whether all kernels agree to the last bit, in hits and picture.
    pub identical: bool,
    /// Whether they agree and everything that differs from the reference is explained.
    pub pass: bool,
}

/// One kernel's answers beside the reference's.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct KernelReport {
    /// `x1`, `x4` or `x8`.
    pub kernel: &'static str,
    /// The counts of the comparison.
    #[serde(flatten)]
    pub comparison: Comparison,
}

/// One kernel's answers, as the renderer returns them.
struct Traced {
    hits: render::PrimaryHits,
    film: Film,
}

impl Traced {
    fn new(scene: &scene::Scene, camera: &render::Camera, kernel: Kernel, width: usize, height: usize) -> Self {
        let mut film = Film::new(width, height);
        render::render(scene, camera, kernel, 1, &mut film, &|_| ());
        Self { hits: render::primary_hits(scene, camera, kernel, width, height), film }
    }

    fn answers(&self) -> Answers<'_> {
        Answers { t: &self.hits.t, primitive: &self.hits.primitive, pixels: &self.film.pixels }
    }
}

/// Compares the packet tracer with the reference on a scene, in the caller's rayon pool.
///
/// # Panics
/// When `scene` is not sound; [`crate::scene::check`] says so beforehand.
pub fn verify(scene: &Description, kernels: &[Kernel], width: usize, height: usize) -> Report {
    verify_with(scene, &CompileOptions::default(), kernels, width, height)
}

/// Compares the packet tracer with the reference as [`verify`] does, on a scene compiled with options.
///
/// # Panics
/// As [`verify`].
pub fn verify_with(
    scene: &Description,
    options: &CompileOptions,
    kernels: &[Kernel],
    width: usize,
    height: usize,
) -> Report {
    let compiled = scene::compile_with(scene, options).expect("a sound scene");
    verify_compiled(scene, &compiled, kernels, width, height)
}

/// Compares the packet tracer with the reference as [`verify`] does, by what [`scene::compile`] made of the description.
pub fn verify_compiled(
    description: &Description,
    scene: &scene::Scene,
    kernels: &[Kernel],
    width: usize,
    height: usize,
) -> Report {
    let camera = render::Camera::new(&description.camera, width as f32 / height as f32);
    let traced: Vec<_> =
        kernels.iter().map(|&kernel| (kernel, Traced::new(scene, &camera, kernel, width, height))).collect();
    let answers: Vec<_> = traced.iter().map(|(kernel, traced)| (*kernel, traced.answers())).collect();
    judge(&Truth::new(description, width, height), &answers)
}

/// The report on answers that are there already; what [`verify`] does after tracing.
pub fn judge(truth: &Truth, answers: &[(Kernel, Answers<'_>)]) -> Report {
    let mut kernels: Vec<KernelReport> = Vec::new();
    let mut identical = true;
    for (i, (kernel, answer)) in answers.iter().enumerate() {
        // Answers that agree to the bit get the same verdict; judging edges is the slow part.
        let same = answers[..i].iter().position(|(_, earlier)| earlier.same_bits(answer));
        identical &= i == 0 || same == Some(0);
        let comparison = same.map_or_else(|| truth.compare(answer), |k| kernels[k].comparison.clone());
        kernels.push(KernelReport { kernel: kernel.name(), comparison });
    }
    let pass = identical && kernels.iter().all(|k| k.comparison.explained());
    Report { scene: truth.name.clone(), size: truth.size, kernels, identical, pass }
}

/// A linear colour as a display shows it: the sRGB curve, clamped to 0..1. NaN stays, and −∞ becomes NaN. From 10²⁸ on it
/// goes on to 2, which stands for 10³² and all beyond: there an `f32` may have overflowed on the way, and ∞ is right.
fn displayed(linear: DVec3) -> DVec3 {
    linear.map(|channel| match channel {
        c if c.is_nan() || c == f64::NEG_INFINITY => f64::NAN,
        c if c > 1e28 => 1.0 + ((c.log10() - 28.0) / 4.0).min(1.0),
        c if c <= 0.003_130_8 => 12.92 * c.max(0.0),
        c => 1.055 * c.min(1.0).powf(1.0 / 2.4) - 0.055,
    })
}

#[cfg(test)]
mod tests;
