//! A tracer's answers beside the truth.
use super::bound::{K, U};
use super::truth::{Truth, differing};
use super::{displayed, truth};
use glam::Vec3;
use rayon::prelude::*;
use serde::Serialize;

/// Once so many answers are unexplained the verdict is clear, and the rest is no longer looked into.
const ENOUGH: usize = 200;

/// How many answers are looked into between two glances at [`ENOUGH`].
const BATCH: usize = 64;

/// A tracer's answers to the pixel-centre rays, row by row from the top; all of the same length.
#[derive(Clone, Copy, Debug)]
pub struct Answers<'a> {
    /// Distance; infinite where nothing is hit.
    pub t: &'a [f32],
    /// Primitive id; [`crate::trace::NONE`] where nothing is hit.
    pub primitive: &'a [u32],
    /// Linear RGB at one sample a pixel.
    pub pixels: &'a [[f32; 3]],
}

impl Answers<'_> {
    /// Whether two tracers gave the same bits, signs of zeros and payloads of NaNs included.
    pub fn same_bits(&self, other: &Self) -> bool {
        let same_t = self.t.iter().map(|t| t.to_bits()).eq(other.t.iter().map(|t| t.to_bits()));
        let channels = |a: &Self| a.pixels.as_flattened().iter().map(|c| c.to_bits()).collect::<Vec<_>>();
        same_t && self.primitive == other.primitive && channels(self) == channels(other)
    }
}

/// The differences between a tracer and the reference, and how much of them the error bound leaves unexplained.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Comparison {
    /// Pixel-centre rays.
    pub rays: usize,
    /// Rays that hit another primitive than the reference's.
    pub hits_different: usize,
    /// Those of them that the bound does not explain.
    pub hits_unexplained: usize,
    /// The largest relative error of t over the rays that hit the same primitive; [`f64::MAX`] if a t is no number.
    pub t_error_max: f64,
    /// The 99.9th percentile of the same.
    pub t_error_p999: f64,
    /// Agreeing rays whose t the bound does not explain.
    pub t_unexplained: usize,
    /// Pixels that differ by more than 1/255 in a channel, as displayed.
    pub pixels_different: usize,
    /// Those of them that the bound does not explain. Here and above: once there are 200, the rest is not looked
    /// into, and counts as unexplained.
    pub pixels_unexplained: usize,
}

impl Comparison {
    /// Whether the bound explains everything that differs.
    pub fn explained(&self) -> bool {
        self.hits_unexplained == 0 && self.t_unexplained == 0 && self.pixels_unexplained == 0
    }
}

impl Truth {
    /// Compares a tracer's answers with the reference's, in the caller's rayon pool.
    ///
    /// # Panics
    /// When there are not as many answers as pixels.
    pub fn compare(&self, answers: &Answers<'_>) -> Comparison {
        let rays = self.rays();
        assert_eq!([answers.t.len(), answers.primitive.len(), answers.pixels.len()], [rays; 3], "answers");
        let (same, other): (Vec<_>, Vec<_>) = (0..rays).partition(|&i| self.primitive(i) == answers.primitive[i]);
        let errors: Vec<f64> = same.iter().map(|&i| truth::relative(answers.t[i], self.t(i))).collect();
        let inexact: Vec<_> = same.iter().zip(&errors).filter(|(_, error)| **error > K * U).map(|(&i, _)| i).collect();
        let shown = |i: usize| displayed(Vec3::from(answers.pixels[i]).as_dvec3());
        let off: Vec<_> = (0..rays).filter(|&i| differing(shown(i), self.pixel(i)).any()).collect();
        let explains_hit = |i: usize| self.explains_hit(i, answers.primitive[i], answers.t[i]);
        let explains_pixel = |i: usize| self.explains_pixel(i, answers.primitive[i], shown(i));
        let (t_error_max, t_error_p999) = highest(errors);
        Comparison {
            rays,
            hits_different: other.len(),
            hits_unexplained: unexplained(&other, explains_hit),
            t_error_max,
            t_error_p999,
            t_unexplained: unexplained(&inexact, explains_hit),
            pixels_different: off.len(),
            pixels_unexplained: unexplained(&off, explains_pixel),
        }
    }
}

/// How many of the candidates are not explained, up to [`ENOUGH`]; from there on all that are left.
fn unexplained(candidates: &[usize], explains: impl Fn(usize) -> bool + Sync) -> usize {
    let mut count = 0;
    for (done, batch) in candidates.chunks(BATCH).enumerate() {
        if count >= ENOUGH {
            return count + candidates.len() - done * BATCH;
        }
        count += batch.par_iter().filter(|&&i| !explains(i)).count();
    }
    count
}

/// The maximum and the 99.9th percentile; zeros when there is nothing.
fn highest(mut errors: Vec<f64>) -> (f64, f64) {
    errors.sort_by(f64::total_cmp);
    let rank = (errors.len() as f64 * 0.999).ceil() as usize;
    let at = |rank: usize| errors.get(rank.wrapping_sub(1)).copied().unwrap_or(0.0);
    (at(errors.len()), at(rank))
}
