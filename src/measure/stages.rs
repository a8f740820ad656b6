//! Where the time of a picture goes, stage by stage.

use std::fmt;
use std::time::{Duration, Instant};

use serde::Serialize;

use crate::render::{Camera, Counts, Kernel, render_observed};
use crate::scene::{Description, Scene};
use crate::shade::{Observer, Stage};

/// Time to spend on pictures.
const BUDGET: Duration = Duration::from_secs(2);

/// The stages in the order of the table.
const STAGES: [(Stage, &str); 7] = [
    (Stage::Eye, "eye rays"),
    (Stage::Arrive, "trace, surfaces"),
    (Stage::Fire, "shadow rays"),
    (Stage::Light, "occlusion, light"),
    (Stage::Leave, "deposit, spawn"),
    (Stage::Curve, "display curve"),
    (Stage::Store, "store"),
];

/// The time of one stage.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Row {
    /// Its name.
    pub stage: &'static str,
    /// Nanoseconds a pixel, the median over the pictures.
    pub ns_per_pixel: f64,
    /// Nanoseconds for each ray that the stage is about.
    pub ns_per_ray: f64,
}

/// The time of a picture by stage, on one thread.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Stages {
    /// The scene's name.
    pub scene: String,
    /// Width and height of the picture.
    pub size: [usize; 2],
    /// Pictures that were drawn.
    pub runs: usize,
    /// Rays of all kinds in one picture.
    pub rays: u64,
    /// By stage, in the order of the work.
    pub rows: Vec<Row>,
}

/// A clock that is read at the end of every stage.
struct Stopwatch {
    last: Instant,
    spent: [Duration; STAGES.len()],
    /// How long one reading takes.
    reading: Duration,
}

impl Observer for Stopwatch {
    fn done(&mut self, stage: Stage) {
        let now = Instant::now();
        self.spent[stage as usize] += (now - self.last).saturating_sub(self.reading);
        self.last = now;
    }
}

/// The mean time between two readings of the clock.
fn reading() -> Duration {
    const MANY: u32 = 10_000;
    let start = Instant::now();
    for _ in 0..MANY {
        std::hint::black_box(Instant::now());
    }
    start.elapsed() / MANY
}

/// Draws a scene again and again on this thread, at x8, and tells where the time goes. The clock is read after every
/// stage of a wave of up to 256 rays, and the time of the readings is taken away.
pub fn stages(description: &Description, scene: &Scene, [width, height]: [usize; 2]) -> Stages {
    let camera = Camera::new(&description.camera, width as f32 / height as f32);
    let mut pixels = vec![0; width * height];
    let mut watch = Stopwatch { last: Instant::now(), spent: Default::default(), reading: reading() };
    let mut runs: Vec<[Duration; STAGES.len()]> = Vec::new();
    let mut counts = Counts::default();
    let start = Instant::now();
    // The first warms up.
    for run in 0.. {
        watch.spent = Default::default();
        watch.last = Instant::now();
        counts = render_observed(scene, &camera, Kernel::X8, [width, height], &mut pixels, &mut watch);
        if run > 0 {
            runs.push(watch.spent);
            if start.elapsed() > BUDGET {
                break;
            }
        }
    }
    let rows = STAGES.iter().map(|&(stage, name)| {
        let mut spent: Vec<Duration> = runs.iter().map(|run| run[stage as usize]).collect();
        spent.sort();
        let ns = spent[spent.len() / 2].as_nanos() as f64;
        let about = match stage {
            Stage::Eye | Stage::Curve | Stage::Store => counts.primary,
            Stage::Arrive | Stage::Leave => counts.total() - counts.shadow,
            Stage::Fire | Stage::Light => counts.shadow,
        };
        Row { stage: name, ns_per_pixel: ns / (width * height) as f64, ns_per_ray: ns / about.max(1) as f64 }
    });
    Stages {
        scene: description.name.clone(),
        size: [width, height],
        runs: runs.len(),
        rays: counts.total(),
        rows: rows.collect(),
    }
}

impl fmt::Display for Stages {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let [w, h] = self.size;
        let sum: f64 = self.rows.iter().map(|row| row.ns_per_pixel).sum();
        writeln!(f, "{}  {w}×{h}  1 thread  x8  {} runs", self.scene, self.runs)?;
        write!(f, "{:18} {:>10} {:>8} {:>10}", "stage", "ns/pixel", "share", "ns/ray")?;
        for row in &self.rows {
            let share = 100.0 * row.ns_per_pixel / sum;
            write!(f, "\n{:18} {:>10.2} {share:>6.1} % {:>10.2}", row.stage, row.ns_per_pixel, row.ns_per_ray)?;
        }
        let rays = self.rays as f64 / (w * h) as f64;
        write!(f, "\n{:18} {sum:>10.2} {:>8} {:>10.2}", "all", "", sum / rays)
    }
}
