//! `raypacket bench`: rays a second, by query and kernel, with a check of the answers in the same run.

use std::cell::LazyCell;
use std::fmt;
use std::path::PathBuf;
use std::time::Duration;

use serde::Serialize;

use super::answers::Answers;
use super::rays::{self, RayFileError};
use super::stamp::Stamp;
use super::streams::Streams;
use super::turns::{Times, noise, take_turns};
use super::verify::{sample, verify_compiled};
use crate::math::{RayBatch, isa, slower_than_cpu};
use crate::reference::Tracer;
use crate::render::{Camera, Kernel, render_display};
use crate::scene::{Description, Scene};

/// Rays traced between two looks at the clock, at the least; the tests look at the answers only.
const MIN_RAYS: u64 = if cfg!(test) { 1 } else { 500_000 };

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
    /// Whether the answers agreed: all kernels with each other to the bit, and a sample of the rays and a smaller picture
    /// with the reference.
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
    run_spoiled(description, scene, options, &|_, _| ())
}

/// [`run`], but that `spoil` sees every kernel's answers before they are judged: so a test can plant a fault.
fn run_spoiled(
    description: &Description,
    scene: &Scene,
    options: &Options,
    spoil: &dyn Fn(Kernel, &mut Answers),
) -> Result<Report, RayFileError> {
    let mut results = Vec::new();
    let mut agree = true;
    // Made when it is needed, as it takes memory.
    let tracer = LazyCell::new(|| Tracer::new(description));
    let mut measure = |query: String, shadow: bool, batches: &[RayBatch]| {
        let (measured, mut answers) = time_query(scene, &query, shadow, batches, options.budget);
        results.extend(measured);
        Kernel::ALL.iter().zip(&mut answers).for_each(|(&kernel, answers)| spoil(kernel, answers));
        agree &= answers.windows(2).all(|pair| pair[0] == pair[1]);
        if let Some(answers) = answers.first() {
            agree &= sample::agrees(&tracer, batches, |batch, ray| answers.of(batch, ray));
        }
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
        valid: agree && agrees_with_reference(description, scene),
        build: Build::of(scene),
        results,
    })
}

/// Whether a picture small enough for brute force agrees with the reference.
pub(super) fn agrees_with_reference(description: &Description, scene: &Scene) -> bool {
    let affordable = 200_000_000 / (description.primitives() + 20);
    let height = ((affordable / 2) as f64).sqrt().clamp(8.0, 128.0) as usize;
    verify_compiled(description, scene, &Kernel::ALL, 2 * height, height).pass
}

/// Times one query at every kernel; also the answers, by kernel. Both are empty where there is no ray.
fn time_query(
    scene: &Scene,
    query: &str,
    shadow: bool,
    batches: &[RayBatch],
    budget: Duration,
) -> (Vec<Measured>, Vec<Answers>) {
    let active: u64 = batches.iter().map(|b| b.active() as u64).sum();
    if active == 0 && query != "primary" && !query.starts_with("rays:") {
        return (Vec::new(), Vec::new());
    }
    let mut answers: Vec<Answers> = Kernel::ALL.iter().map(|_| Answers::new(shadow, batches.len())).collect();
    // A short set is traced over and over, so that the clock is not what is measured.
    let all: u64 = batches.iter().map(|b| b.len as u64).sum();
    let passes = (MIN_RAYS / all.max(1)).max(1);
    let times = by_kernel(budget, |kernel| answers[kernel as usize].fill(scene, kernel, batches, passes));
    let measured = Kernel::ALL.iter().zip(times).zip(&answers).map(|((kernel, times), answers)| {
        let (hits, sum_t) = answers.sum(batches);
        measured(query, *kernel, active, hits, sum_t, times.iter().map(|t| t / passes as f64).collect())
    });
    let measured = measured.collect();
    (measured, answers)
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

#[cfg(test)]
#[path = "bench_tests.rs"]
mod tests;
