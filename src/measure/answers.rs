//! A query's answers to a set of batches: found, counted, and handed out one by one.

use rayon::prelude::*;

use super::verify::sample::Answer;
use crate::math::{Blocked, HitBatch, Lanes, NONE, RayBatch};
use crate::render::{Kernel, with_lanes};
use crate::scene::Scene;
use crate::trace::{Scratch, intersect_stream, occluded_stream};

/// The answers to a set of batches.
#[derive(Debug, PartialEq)]
pub(super) enum Answers {
    /// The nearest hits.
    Nearest(Vec<HitBatch>),
    /// Whether there is any.
    Any(Vec<Blocked>),
}

impl Answers {
    /// Room for them.
    pub fn new(shadow: bool, batches: usize) -> Self {
        match shadow {
            true => Self::Any(vec![Blocked::default(); batches]),
            false => Self::Nearest(vec![HitBatch::default(); batches]),
        }
    }

    /// Answers all batches `passes` times over.
    pub fn fill(&mut self, scene: &Scene, kernel: Kernel, batches: &[RayBatch], passes: u64) {
        with_lanes!(kernel, fill(self, scene, batches, passes));
    }

    /// The answer to one ray of a batch.
    pub fn of(&self, batch: usize, ray: usize) -> Answer {
        match self {
            Self::Any(blocked) => Answer::Any(blocked[batch].get(ray, 1) != 0),
            Self::Nearest(hits) => Answer::Nearest(hits[batch].t[ray], hits[batch].primitive[ray]),
        }
    }

    /// The number of hits and the sum of their distances.
    pub fn sum(&self, batches: &[RayBatch]) -> (u64, f64) {
        match self {
            Self::Any(blocked) => (blocked.iter().map(|b| b.count() as u64).sum(), 0.0),
            Self::Nearest(hits) => hits.iter().zip(batches).fold((0, 0.0), |sum, (hits, rays)| {
                (0..rays.len)
                    .filter(|&i| rays.t_max[i] >= 0.0 && hits.primitive[i] != NONE)
                    .fold(sum, |(n, t), i| (n + 1, t + f64::from(hits.t[i])))
            }),
        }
    }
}

fn fill<L: Lanes>(answers: &mut Answers, scene: &Scene, batches: &[RayBatch], passes: u64) {
    match answers {
        Answers::Nearest(hits) => each(batches, hits, passes, |rays, hits, scratch| {
            intersect_stream::<L>(scene, rays, hits, scratch);
        }),
        Answers::Any(blocked) => each(batches, blocked, passes, |rays, blocked, scratch| {
            occluded_stream::<L>(scene, rays, blocked, scratch);
        }),
    }
}

/// Puts all batches through the query `passes` times, in parallel where the pool has more than one thread. All come by
/// before any comes again: a thread that met the same few over and over would foretell every branch.
fn each<A: Send>(
    batches: &[RayBatch],
    answers: &mut [A],
    passes: u64,
    query: impl Fn(&[RayBatch], &mut [A], &mut Scratch) + Sync,
) {
    match rayon::current_num_threads() {
        1 => {
            let mut scratch = Scratch::default();
            (0..passes).for_each(|_| query(batches, answers, &mut scratch));
        }
        threads => {
            let size = batches.len().div_ceil(8 * threads).max(1);
            for _ in 0..passes {
                let shares = batches.par_chunks(size).zip(answers.par_chunks_mut(size));
                shares.for_each_init(Scratch::default, |scratch, (batches, answers)| query(batches, answers, scratch));
            }
        }
    }
}
