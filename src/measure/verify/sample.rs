//! A sample of any rays' answers beside the reference's: of those that `bench` times, whatever they come from.

use super::bound::{K, Neighbourhood, Question, ROUNDS, U};
use crate::math::{BATCH, NONE, RayBatch};
use crate::reference::Tracer;
use glam::DVec3;
use rayon::prelude::*;

/// Tests of a primitive that a sample may take, within the limits of [`RAYS`].
const TESTS: usize = 400_000_000;

/// The least and the most rays of a sample, if there are as many.
const RAYS: [usize; 2] = [256, 2048];

/// The answer to one ray.
#[derive(Clone, Copy, Debug)]
pub enum Answer {
    /// The nearest hit: its distance and its primitive, or [`NONE`].
    Nearest(f32, u32),
    /// Whether there is any.
    Any(bool),
}

/// Whether the reference gives the same answers to a sample of the active rays, spread evenly over all of them, or explains
/// the differences by [the bound](super#the-error-bound). `answer` is that of a batch's ray.
pub fn agrees(tracer: &Tracer, batches: &[RayBatch], answer: impl Fn(usize, usize) -> Answer + Sync) -> bool {
    let rays = batches.iter().enumerate().flat_map(|(b, batch)| {
        let lanes = (0..batch.len).filter(|&i| batch.t_max[i] >= 0.0);
        lanes.map(move |i| (b, i))
    });
    let all: usize = batches.iter().map(RayBatch::active).sum();
    let count = (TESTS / tracer.primitives().max(1)).clamp(RAYS[0], RAYS[1]).min(all);
    // The last ray of each of `count` equal parts.
    let sample: Vec<_> = rays.enumerate().filter(|(n, _)| (n + 1) * count / all != n * count / all).collect();
    sample.par_iter().all(|&(_, (b, i))| Asked::new(tracer, &batches[b], i).explains(answer(b, i)))
}

/// A ray as the reference is asked.
struct Asked<'a> {
    tracer: &'a Tracer,
    /// Where its interval starts.
    origin: DVec3,
    direction: DVec3,
    /// The start of the interval, and its length.
    t_min: f64,
    length: f64,
    /// The k of the bound.
    k: f64,
}

impl<'a> Asked<'a> {
    fn new(tracer: &'a Tracer, batch: &RayBatch, i: usize) -> Self {
        let at = |columns: &[[f32; BATCH]; 3], i: usize| {
            DVec3::new(columns[0][i].into(), columns[1][i].into(), columns[2][i].into())
        };
        let (origin, direction) = (at(&batch.origin, if batch.common_origin { 0 } else { i }), at(&batch.direction, i));
        let [t_min, t_max] = [batch.t_min[i], batch.t_max[i]].map(f64::from);
        // Some tests count in lengths of the direction, others in units. 4 u are in the bound.
        let off = ((direction.length() - 1.0).abs() / U - 4.0).max(0.0);
        let direction = direction.normalize();
        Self { tracer, origin: origin + t_min * direction, direction, t_min, length: t_max - t_min, k: K + 2.0 * off }
    }

    /// The questions round by round, where what is met is `reach` away and of this size.
    fn rounds(&self, reach: f64, size: f64) -> impl Iterator<Item = impl Iterator<Item = Question>> {
        let end = if reach.is_finite() { (self.origin + reach * self.direction).length() } else { 0.0 };
        let scale = self.origin.length().max(end).max(size);
        let (origin, direction, k) = (self.origin, self.direction, self.k);
        ROUNDS.into_iter().scan(0, move |asked, until| {
            let around = Neighbourhood { origin, direction, scale, k };
            let round = (*asked..until).map(move |q| around.question(q));
            *asked = until;
            Some(round)
        })
    }

    fn explains(&self, answer: Answer) -> bool {
        match answer {
            Answer::Nearest(t, primitive) => self.explains_nearest(f64::from(t), primitive),
            Answer::Any(blocked) => self.explains_any(blocked),
        }
    }

    fn explains_nearest(&self, t: f64, primitive: u32) -> bool {
        let Self { tracer, t_min, length, .. } = *self;
        let ku = self.k * U;
        let within = |low: f64, high: f64| ((t_min + low) * (1.0 - ku)..=(t_min + high) * (1.0 + ku)).contains(&t);
        let truth = tracer.intersect(self.origin, self.direction, length);
        let (id, reach) = truth.map_or((NONE, t - t_min), |hit| (hit.primitive, hit.t));
        if id == primitive && (id == NONE || within(reach, reach)) {
            return true;
        }
        let size = tracer.extent(id).max(tracer.extent(primitive));
        let nearest = |[origin, direction]: [DVec3; 2]| {
            tracer.intersect(origin, direction, f64::INFINITY).map_or(f64::INFINITY, |hit| hit.t)
        };
        if primitive == NONE {
            // What lies at the interval's end may lie beyond it.
            let mut questions = self.rounds(reach, size).flatten();
            return questions.any(|q| nearest([q.origin, q.direction]) >= length * (1.0 - ku));
        }
        let own = |ray: [DVec3; 2]| {
            // Where two surfaces are closer together than t can tell, either may be the nearer.
            let own = tracer.distance(primitive, ray[0], ray[1]);
            own.filter(|own| *own <= nearest(ray) * (1.0 + ku))
        };
        let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
        let [mut farthest, mut miss] = [None; 2];
        self.rounds(reach, size).any(|round| {
            for q in round {
                let ray = [q.origin, q.direction];
                match own(ray) {
                    None => miss = Some(ray),
                    Some(t) => {
                        if t > high {
                            farthest = Some(ray);
                        }
                        (low, high) = (low.min(t), high.max(t));
                    }
                }
            }
            // Beside an outline t rises steeply up to the tangent, which lies between a hit and a miss.
            if let (Some(hit), Some(miss)) = (farthest, miss)
                && let Some(t) = tangent(own, hit, miss)
            {
                (low, high) = (low.min(t), high.max(t));
            }
            within(low, high)
        })
    }

    fn explains_any(&self, blocked: bool) -> bool {
        let Self { tracer, length, .. } = *self;
        let ku = self.k * U;
        let stops = |id: u32, origin: DVec3, direction: DVec3, length: f64| {
            tracer.stop(id, origin, direction).is_some_and(|t| t < length)
        };
        let mut ids = 0..tracer.primitives() as u32;
        if tracer.blocked(self.origin, self.direction, length) == blocked {
            return true;
        }
        if blocked {
            // Some primitive stops light that is off by what its own size allows.
            return ids.any(|id| {
                let mut questions = self.rounds(length, tracer.extent(id)).flatten();
                questions.any(|q| stops(id, q.origin, q.direction, length * (1.0 + ku)))
            });
        }
        let blockers = ids.filter(|&id| stops(id, self.origin, self.direction, length));
        let size = blockers.map(|id| tracer.extent(id)).fold(0.0, f64::max);
        let mut questions = self.rounds(length, size).flatten();
        questions.any(|q| !tracer.blocked(q.origin, q.direction, length * (1.0 - ku)))
    }
}

/// The distance of the last hit on the way from a ray that hits to one that misses, in halves.
fn tangent(own: impl Fn([DVec3; 2]) -> Option<f64>, mut hit: [DVec3; 2], mut miss: [DVec3; 2]) -> Option<f64> {
    let mut last = None;
    for _ in 0..50 {
        let middle = [0.5 * (hit[0] + miss[0]), (hit[1] + miss[1]).normalize()];
        match own(middle) {
            Some(t) => (last, hit) = (Some(t), middle),
            None => miss = middle,
        }
    }
    last
}
