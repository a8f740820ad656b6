//! `raypacket bench`: rays a second, by query and kernel, with a check of the answers in the same run.

use std::fmt;
use std::path::PathBuf;
use std::time::Duration;

use rayon::prelude::*;
use serde::Serialize;

use super::rays::{self, RayFileError};
use super::stamp::Stamp;
use super::streams::Streams;
use super::turns::{Times, noise, take_turns};
use crate::math::{Blocked, HitBatch, Lanes, NONE, RayBatch, isa, slower_than_cpu};
use crate::render::{Camera, Kernel, render_display, with_lanes};
use crate::scene::{Description, Scene};
use crate::trace::{Scratch, intersect_stream, occluded_stream};

/// Rays traced between two looks at the clock, at the least.
const MIN_RAYS: u64 = 500_000;

/// Options of a measurement.
#[derive(Clone, Debug, PartialEq)]
pub struct Options {
    /// Width and height of the picture whose rays are traced.
    pub size: [usize; 2],
    /// A file of rays to trace instead; see [`super::rays`].
    pub rays: Option<PathBuf>,
    /// Time for the runs of one query, all kernels together; there are 3 at the least.
    pub budget: Duration,
}

impl Default for Options {
    fn default() -> Self {
        Self { size: [1024, 512], rays: None, budget: Duration::from_secs(4) }
    }
}

/// One query at one kernel.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Measured {
    /// `primary`, `shadow`, `reflection`, `refraction`, `frame`, or `rays:` and the ray file's extension.
    pub query: String,
    /// `x1`, `x4`, `x8`.
    pub kernel: &'static str,
    /// Active rays; for `frame`, all rays of all kinds.
    pub rays: u64,
    /// Rays that hit, or are blocked; 0 for `frame`.
    pub hits: u64,
    /// The sum of the distances of all hits; 0 for shadow rays and `frame`.
    pub sum_t: f64,
    /// 10⁶ rays a second, median of the runs.
    pub mrays_median: f64,
    /// The best run.
    pub mrays_best: f64,
    /// How many runs were timed.
    pub runs: usize,
    /// How far the runs lie apart, as a share of the median: see [`Times::spread`].
    pub spread: f64,
}

/// The tree of a scene.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Build {
    /// How long it took to build, in milliseconds, once.
    pub ms: f64,
    /// The memory of its nodes and blocks.
    pub bytes: usize,
}

impl Build {
    fn of(scene: &Scene) -> Option<Self> {
        let bvh = scene.bvh.as_ref()?;
        Some(Self { ms: scene.build_time.as_secs_f64() * 1e3, bytes: bvh.bytes() })
    }
}

/// The findings of [`run`].
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Report {
    /// The scene's name.
    pub scene: String,
    /// Width and height of the picture.
    pub size: [usize; 2],
    /// Threads of the pool it ran in.
    pub threads: usize,
    /// The instruction set this build uses.
    pub isa: &'static str,
    /// On what, from what and when.
    #[serde(flatten)]
    pub stamp: Stamp,
    /// The methods by which primitives are tested and rays moved off surfaces ([`crate::geometry::methods`]).
    pub methods: String,
    /// Whether the answers agreed: all kernels with each other to the bit, and a smaller picture with the reference.
    pub valid: bool,
    /// The tree; it is not part of the times below.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub build: Option<Build>,
    /// By query, then by kernel.
    pub results: Vec<Measured>,
}

/// Measures a scene in the caller's rayon pool; `scene` is what [`crate::scene::compile`] made of `description`.
///
/// Timed are the calls of the query for a whole set of rays, batch by batch, from the batch's bounds to the stored
/// answer. The rays of a picture are a sample that stays in the cache, as a tile's do when it is rendered; those of a
/// file all lie in memory; for `frame`, everything from the eye ray to the display pixel. The kernels take
/// turns, so that a drift of the machine hits all alike; the first turn warms up and is not counted.
///
/// # Errors
/// [`RayFileError`] when the ray file is not sound.
pub fn run(description: &Description, scene: &Scene, options: &Options) -> Result<Report, RayFileError> {
    let mut results = Vec::new();
    let mut same = true;
    let mut measure = |query: String, shadow: bool, batches: &[RayBatch]| {
        let (measured, agree) = time_query(scene, &query, shadow, batches, options.budget);
        results.extend(measured);
        same &= agree;
    };
    if let Some(path) = &options.rays {
        let extension = path.extension().map(|e| e.to_string_lossy().into_owned()).unwrap_or_default();
        let batches = rays::read(path)?;
        measure(format!("rays:{extension}"), extension == "shadow", &batches);
    } else {
        let [width, height] = options.size;
        let camera = Camera::new(&description.camera, width as f32 / height as f32);
        let streams = Streams::of(scene, &camera, width, height);
        measure("primary".into(), false, &streams.primary);
        measure("shadow".into(), true, &streams.shadow);
        measure("reflection".into(), false, &streams.reflection);
        measure("refraction".into(), false, &streams.refraction);
        results.extend(time_frames(scene, &camera, options));
    }
    Ok(Report {
        scene: description.name.clone(),
        size: options.size,
        threads: rayon::current_num_threads(),
        isa: isa(),
        stamp: Stamp::now(),
        methods: scene.plan.methods.to_string(),
        valid: same && agrees_with_reference(description, scene),
        build: Build::of(scene),
        results,
    })
}

/// Whether a picture small enough for brute force agrees with the reference.
pub(super) fn agrees_with_reference(description: &Description, scene: &Scene) -> bool {
    let affordable = 200_000_000 / (description.primitives() + 20);
    let height = ((affordable / 2) as f64).sqrt().clamp(8.0, 128.0) as usize;
    let options = scene.plan.methods.choices().as_slice().into();
    super::verify::verify_with(description, &options, &Kernel::ALL, 2 * height, height).pass
}

/// Times one query at every kernel; also whether all kernels gave the same bits.
fn time_query(
    scene: &Scene,
    query: &str,
    shadow: bool,
    batches: &[RayBatch],
    budget: Duration,
) -> (Vec<Measured>, bool) {
    let active: u64 = batches.iter().map(|b| b.active() as u64).sum();
    if active == 0 && query != "primary" && !query.starts_with("rays:") {
        return (Vec::new(), true);
    }
    let mut answers: Vec<Answers> = Kernel::ALL.iter().map(|_| Answers::new(shadow, batches.len())).collect();
    // A short set is traced over and over, so that the clock is not what is measured.
    let all: u64 = batches.iter().map(|b| b.len as u64).sum();
    let passes = (MIN_RAYS / all.max(1)).max(1);
    let times = by_kernel(budget, |kernel| answers[kernel as usize].fill(scene, kernel, batches, passes));
    let same = answers.windows(2).all(|pair| pair[0] == pair[1]);
    let measured = Kernel::ALL.iter().zip(times).zip(&answers).map(|((kernel, times), answers)| {
        let (hits, sum_t) = answers.sum(batches);
        measured(query, *kernel, active, hits, sum_t, times.iter().map(|t| t / passes as f64).collect())
    });
    (measured.collect(), same)
}

/// Times whole frames at every kernel.
fn time_frames(scene: &Scene, camera: &Camera, options: &Options) -> Vec<Measured> {
    let [width, height] = options.size;
    let mut pixels = vec![0; width * height];
    let mut rays = 0;
    let times = by_kernel(options.budget, |kernel| {
        rays = render_display(scene, camera, kernel, width, height, &mut pixels).total();
    });
    let of = |(kernel, times): (&Kernel, _)| measured("frame", *kernel, rays, 0, 0.0, times);
    Kernel::ALL.iter().zip(times).map(of).collect()
}

/// Runs every kernel in turn until the budget is spent; the times of each, in seconds.
fn by_kernel(budget: Duration, mut run: impl FnMut(Kernel)) -> Vec<Vec<f64>> {
    take_turns(Kernel::ALL.len(), budget, |i| run(Kernel::ALL[i]))
}

fn measured(query: &str, kernel: Kernel, rays: u64, hits: u64, sum_t: f64, times: Vec<f64>) -> Measured {
    let Times { median, best, spread, runs } = Times::of(times);
    let [mrays_median, mrays_best] = [median, best].map(|seconds| rays as f64 / seconds * 1e-6);
    Measured { query: query.into(), kernel: kernel.name(), rays, hits, sum_t, mrays_median, mrays_best, runs, spread }
}

/// The answers to a set of batches.
#[derive(Debug, PartialEq)]
enum Answers {
    Nearest(Vec<HitBatch>),
    Any(Vec<Blocked>),
}

impl Answers {
    fn new(shadow: bool, batches: usize) -> Self {
        match shadow {
            true => Self::Any(vec![Blocked::default(); batches]),
            false => Self::Nearest(vec![HitBatch::default(); batches]),
        }
    }

    /// Answers all batches `passes` times over.
    fn fill(&mut self, scene: &Scene, kernel: Kernel, batches: &[RayBatch], passes: u64) {
        with_lanes!(kernel, fill(self, scene, batches, passes));
    }

    /// The number of hits and the sum of their distances.
    fn sum(&self, batches: &[RayBatch]) -> (u64, f64) {
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

impl fmt::Display for Report {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let [w, h] = self.size;
        let valid = if self.valid { "answers agree" } else { "ANSWERS DISAGREE" };
        let threads = if self.threads == 1 { "1 thread".to_owned() } else { format!("{} threads", self.threads) };
        writeln!(f, "{}  {w}×{h}  {threads}  {}  {valid}", self.scene, self.isa)?;
        if let Some(advice) = slower_than_cpu() {
            writeln!(f, "{advice}")?;
        }
        if let Some(Build { ms, bytes }) = self.build {
            writeln!(f, "tree: built in {ms:.2} ms, {bytes} bytes")?;
        }
        write!(f, "{:12} {:6} {:>10} {:>10} {:>12} {:>12}", "query", "kernel", "rays", "hits", "Mrays/s", "best")?;
        for r in &self.results {
            write!(
                f,
                "\n{:12} {:6} {:>10} {:>10} {:>12.2} {:>12.2}{}",
                r.query,
                r.kernel,
                r.rays,
                r.hits,
                r.mrays_median,
                r.mrays_best,
                noise(r.spread)
            )?;
        }
        Ok(())
    }
}
