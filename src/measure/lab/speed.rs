//! Speed and error of the methods on the same rays.

use std::f64::consts::TAU;
use std::time::{Duration, Instant};

use glam::DVec3;

use super::batches;
use super::errors::{Errors, percentile};
use super::method::{Method, methods};
use super::{Budget, truth};
use crate::math::{BATCH, HitBatch, RayBatch};
use crate::measure::cases::{self, Ray, Subject};
use crate::measure::oracle::{Shape, shapes};
use crate::measure::random::Pcg;
use crate::render::Kernel;
use crate::scene::{CompileOptions, Description, Invalid, Scene, Structure, compile_with};
use crate::trace::Scratch;

/// Batches that are timed, at the most: they stay in the second-level cache, as the rays of a tile do.
const TIMED: usize = 96;

/// The least time between two looks at the clock.
const LEAST: Duration = Duration::from_millis(2);

/// Time that all turns of one subject may take together, beyond three each.
const PATIENCE: Duration = Duration::from_secs(20);

/// Turns there are at the least.
const MIN_TURNS: usize = 3;

/// How far the eyes are, in radii of the primitive.
const AWAY: [f64; 2] = [2.0, 1000.0];

/// Cases with a plain primitive, at their easiest.
const PLAIN: [(&str, f64, Subject); 3] = [
    ("sphere-far", 1.0, Subject::Sphere),
    ("triangle-sliver", 1.0, Subject::Triangle),
    ("torus-top-circle", 0.5, Subject::Torus),
];

/// A time, with its spread over the turns.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Timing {
    /// The median turn.
    pub median: f64,
    /// One turn in ten is at most this.
    pub low: f64,
    /// Nine in ten are at most this.
    pub high: f64,
    /// How many there were.
    pub turns: usize,
}

impl Timing {
    /// Of turns in any order.
    pub fn of(mut turns: Vec<f64>) -> Self {
        turns.sort_by(f64::total_cmp);
        let [low, median, high] = [0.1, 0.5, 0.9].map(|share| percentile(&turns, share));
        Self { median, low, high, turns: turns.len() }
    }
}

/// One method at one width.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Point {
    /// The method.
    pub method: Method,
    /// The width.
    pub kernel: Kernel,
    /// Nanoseconds a ray.
    pub time: Timing,
    /// On more rays of the same kind than were timed, the same at every width.
    pub errors: Errors,
}

/// The methods of one subject.
#[derive(Clone, Debug, PartialEq)]
pub struct SpeedOf {
    /// The subject that is tested.
    pub subject: Subject,
    /// By method, then by width.
    pub points: Vec<Point>,
    /// Rays that were timed in every turn.
    pub timed: usize,
    /// Whether every width of a method gave the same bits, in the run that was timed.
    pub same: bool,
}

/// Measures spheres, triangles and tori, one primitive each, with rays from eyes 2 to 1000 of its radii away that pass its
/// centre by up to 1.1 radii; 256 rays share an eye, as those of a tile do.
///
/// The time is that of the query from the batch's bounds to the stored answer, on one thread. All methods and widths
/// take turns, so that a drift of the machine hits all alike; the first turn warms up and is not counted.
///
/// # Errors
/// [`Invalid`] when a scene does not compile; these do.
pub fn speed(budget: &Budget, progress: &dyn Fn(f32)) -> Result<Vec<SpeedOf>, Invalid> {
    let measure = |(i, (case, dial, subject)): (usize, (&str, f64, Subject))| {
        // Of the case its primitive alone; the rays are others.
        let description = cases::find(case).map(|g| g.make(dial, 0, 1).description).unwrap_or_default();
        let measured = speed_of(&description, subject, budget);
        progress((i + 1) as f32 / PLAIN.len() as f32);
        measured
    };
    PLAIN.into_iter().enumerate().map(measure).collect()
}

fn speed_of(description: &Description, subject: Subject, budget: &Budget) -> Result<SpeedOf, Invalid> {
    let rays = rays_at(description, budget.batches);
    let truths = truth::of(description, &rays);
    let shapes = shapes(description);
    let methods = methods(subject);
    let compiled = |method: &Method| {
        compile_with(
            description,
            &CompileOptions { structure: Some(Structure::None), methods: method.choices().to_vec() },
        )
    };
    let scenes: Vec<Scene> = methods.iter().map(compiled).collect::<Result<_, _>>()?;
    let judge = |scene: &Scene| Errors::of(scene, &shapes, &rays, &truths, &batches::trace(scene, &rays));
    let errors: Vec<Errors> = scenes.iter().map(judge).collect();
    let batches = batches::of(&rays[..rays.len().min(TIMED * BATCH)]);
    let (times, same) = take_turns(&scenes, &batches, budget.turns);
    let point = |(i, time)| {
        let (method, kernel) = (i / Kernel::ALL.len(), i % Kernel::ALL.len());
        Point { method: methods[method], kernel: Kernel::ALL[kernel], time: Timing::of(time), errors: errors[method] }
    };
    let points = times.into_iter().enumerate().map(point).collect();
    Ok(SpeedOf { subject, points, timed: batches.iter().map(|b| b.len).sum(), same })
}

/// Batches of rays of the primitive, each from an eye of its own.
fn rays_at(description: &Description, batches: usize) -> Vec<Ray> {
    let Some((center, radius)) = shapes(description).first().map(ball) else { return Vec::new() };
    let mut rng = Pcg::new(11);
    let mut rays = Vec::with_capacity(batches * BATCH);
    for _ in 0..batches {
        let away = AWAY[0] * (AWAY[1] / AWAY[0]).powf(rng.between(0.0, 1.0));
        let back = rng.direction();
        let eye = (center + back * (radius * away)).as_vec3();
        let (a, b) = back.any_orthonormal_pair();
        for _ in 0..BATCH {
            let (sin, cos) = rng.between(0.0, TAU).sin_cos();
            let by = (a * cos + b * sin) * (1.1 * radius * rng.between(0.0, 1.0).sqrt());
            let direction = (center + by - eye.as_dvec3()).normalize().as_vec3();
            rays.push(Ray { origin: eye, direction, t_min: 0.0, t_max: f32::INFINITY });
        }
    }
    rays
}

/// A ball that a sphere or torus fills, or a triangle does when it is not seen edge-on; the unit one for anything else.
fn ball(shape: &Shape) -> (DVec3, f64) {
    match shape {
        Shape::Sphere(it) => (it.center.as_dvec3(), it.radius.into()),
        Shape::Torus(it) => (it.center.as_dvec3(), f64::from(it.major_radius) + f64::from(it.minor_radius)),
        Shape::Triangle(it) => {
            let corners = it.corners.map(|c| c.as_dvec3());
            let center = corners.into_iter().sum::<DVec3>() / 3.0;
            // Half of it: the whole ball is mostly empty.
            (center, corners.map(|c| c.distance(center)).into_iter().fold(0.0, f64::max) / 2.0)
        }
        _ => (DVec3::ZERO, 1.0),
    }
}

/// Times all scenes at all widths in turn: nanoseconds a ray of every turn, by scene, then by width. Also whether all
/// widths gave the same bits.
fn take_turns(scenes: &[Scene], batches: &[RayBatch], turns: usize) -> (Vec<Vec<f64>>, bool) {
    let rays: usize = batches.iter().map(|b| b.len).sum::<usize>().max(1);
    let contestants: Vec<(&Scene, Kernel)> =
        scenes.iter().flat_map(|s| Kernel::ALL.map(|kernel| (s, kernel))).collect();
    let mut scratch = Scratch::default();
    let mut run = |&(scene, kernel): &(&Scene, Kernel), hits: &mut [HitBatch], passes: usize| {
        let started = Instant::now();
        for _ in 0..passes {
            batches::nearest(scene, kernel, batches, hits, &mut scratch);
        }
        started.elapsed()
    };
    // The warm-up tells how often a turn has to go through all rays.
    let mut answers = vec![vec![HitBatch::default(); batches.len()]; contestants.len()];
    let passes: Vec<usize> = contestants
        .iter()
        .zip(&mut answers)
        .map(|(contestant, hits)| {
            let once = run(contestant, hits, 1).max(run(contestant, hits, 1)).as_secs_f64();
            (LEAST.as_secs_f64() / once.max(1e-7)).ceil() as usize
        })
        .collect();
    let mut times = vec![Vec::new(); contestants.len()];
    let started = Instant::now();
    for turn in 0..turns.max(MIN_TURNS) {
        if turn >= MIN_TURNS && started.elapsed() > PATIENCE {
            break;
        }
        for (i, contestant) in contestants.iter().enumerate() {
            let time = run(contestant, &mut answers[i], passes[i]).as_secs_f64();
            times[i].push(time * 1e9 / (passes[i] * rays) as f64);
        }
    }
    let same = answers.chunks(Kernel::ALL.len()).all(|widths| widths.iter().all(|answer| *answer == widths[0]));
    (times, same)
}
