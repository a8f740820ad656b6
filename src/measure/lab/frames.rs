//! Whole frames: the time they take and how far they are from the converged picture.

use std::time::Instant;

use super::image::{Difference, difference};
use super::{Budget, Timing};
use crate::geometry::methods::{Choice, Methods, NormalizeMethod, OffsetMethod, TerminatorMethod};
use crate::geometry::methods::{SphereMethod, TorusMethod, TriangleMethod};
use crate::render::{ALIKE, Camera, Film, Kernel, Samples, render_samples};
use crate::scene::{self, Description, Scene, compile_with};

/// The built-in scenes that are rendered.
pub const SCENES: [&str; 3] = ["classic", "cosmos", "primitives"];

/// How many rays a pixel gets by every method.
const SAMPLES: [Samples; 3] = [Samples::Grid(1), Samples::Grid(2), Samples::Grid(3)];
/// And by the plan at the widest.
const MORE: [Samples; 4] =
    [Samples::Grid(4), Samples::Adaptive(4 * ALIKE), Samples::Adaptive(ALIKE), Samples::Adaptive(1)];

/// One way to render a scene.
#[derive(Clone, Debug, PartialEq)]
pub struct Frame {
    /// `planned`, or the one choice that differs from the plan.
    pub method: String,
    /// The width.
    pub kernel: Kernel,
    /// How many rays a pixel gets.
    pub samples: Samples,
    /// Rays from the eye a pixel.
    pub rays: f64,
    /// Milliseconds.
    pub time: Timing,
    /// From the converged picture.
    pub error: Difference,
    /// From the picture of the planned methods with as many samples, which shows the method alone.
    pub apart: Difference,
}

/// The frames of one scene.
#[derive(Clone, Debug, PartialEq)]
pub struct FramesOf {
    /// The scene.
    pub scene: &'static str,
    /// By method and width, then by samples.
    pub frames: Vec<Frame>,
    /// Whether every width gave the same bits.
    pub same: bool,
}

/// Renders the built-in scenes by their plan at every width, and with one method changed at the widest, in the caller's
/// rayon pool. All take turns; the first turn warms up and is not counted.
///
/// # Errors
/// One line when a built-in scene cannot be read; they can.
pub fn frames(budget: &Budget, progress: &dyn Fn(f32)) -> Result<Vec<FramesOf>, String> {
    let measure = |(i, name): (usize, &'static str)| {
        let share = |part: f32| progress((i as f32 + part) / SCENES.len() as f32);
        frames_of(name, budget, &share)
    };
    SCENES.into_iter().enumerate().map(measure).collect()
}

/// A way to render, with the picture it makes.
struct Way {
    method: String,
    scene: Scene,
    kernel: Kernel,
    samples: Samples,
    film: Film,
    rays: f64,
    times: Vec<f64>,
}

fn frames_of(name: &'static str, budget: &Budget, progress: &dyn Fn(f32)) -> Result<FramesOf, String> {
    let description = scene::load(name).map_err(|e| e.to_string())?;
    let [width, height] = budget.frame;
    let camera = Camera::new(&description.camera, width as f32 / height as f32);
    let run = |scene: &Scene, kernel: Kernel, samples: Samples, film: &mut Film| {
        let started = Instant::now();
        let counts = render_samples(scene, &camera, kernel, samples, film, &|_| ());
        (started.elapsed().as_secs_f64() * 1e3, counts.primary as f64 / (width * height) as f64)
    };
    let compiled = |choices: &[Choice]| compile_with(&description, &choices.into()).map_err(|e| e.to_string());
    let mut converged = Film::new(width, height);
    let planned = compiled(&[])?;
    run(&planned, Kernel::default(), Samples::Grid(budget.converged), &mut converged);
    let mut ways = Vec::new();
    for (method, choice, kernels) in contestants(&description, &planned.plan.methods) {
        for &kernel in kernels {
            let scene = compiled(choice.as_slice())?;
            let more = if choice.is_none() && kernel == Kernel::default() { &MORE[..] } else { &[] };
            ways.extend(SAMPLES.iter().chain(more).map(|&samples| {
                let (method, scene, film) = (method.clone(), scene.clone(), Film::new(width, height));
                Way { method, scene, kernel, samples, film, rays: 0.0, times: Vec::new() }
            }));
        }
    }
    for turn in 0..=budget.frame_turns {
        for way in &mut ways {
            let (time, rays) = run(&way.scene, way.kernel, way.samples, &mut way.film);
            way.rays = rays;
            if turn > 0 {
                way.times.push(time);
            }
        }
        progress((turn + 1) as f32 / (budget.frame_turns + 1) as f32);
    }
    let is_planned = |way: &&Way| way.method == PLANNED;
    let by_plan = |samples| ways.iter().rfind(|way| is_planned(way) && way.samples == samples).unwrap_or(&ways[0]);
    let paired = || ways.iter().map(|way| (way, &by_plan(way.samples).film));
    let same = paired().filter(|(way, _)| is_planned(way)).all(|(way, planned)| way.film == *planned);
    let frame = |(way, planned): (&Way, &Film)| Frame {
        method: way.method.clone(),
        kernel: way.kernel,
        samples: way.samples,
        rays: way.rays,
        time: Timing::of(way.times.clone()),
        error: difference(&way.film, &converged),
        apart: difference(&way.film, planned),
    };
    Ok(FramesOf { scene: name, frames: paired().map(frame).collect(), same })
}

/// The name of the plan's methods.
pub const PLANNED: &str = "planned";

/// The plan at every width, and every other method of what the scene has at the widest.
fn contestants(description: &Description, plan: &Methods) -> Vec<(String, Option<Choice>, &'static [Kernel])> {
    let mut choices: Vec<(&str, &str, Choice)> = Vec::new();
    if !description.spheres.is_empty() {
        choices.extend(SphereMethod::ALL.iter().map(|&m| ("sphere", m.name(), Choice::Sphere(m))));
    }
    if !description.meshes.is_empty() {
        choices.extend(TriangleMethod::ALL.iter().map(|&m| ("triangle", m.name(), Choice::Triangle(m))));
    }
    if description.meshes.iter().any(|mesh| !mesh.normals.is_empty()) {
        let none = TerminatorMethod::None;
        choices.push(("terminator", none.name(), Choice::Terminator(none)));
    }
    if !description.tori.is_empty() {
        choices.extend(TorusMethod::ALL.iter().map(|&m| ("torus", m.name(), Choice::Torus(m))));
    }
    let estimate = NormalizeMethod::Estimate;
    choices.push(("normalize", estimate.name(), Choice::Normalize(estimate)));
    choices.push(("offset", OffsetMethod::Fixed.name(), Choice::Offset(OffsetMethod::Fixed)));
    let others = choices.into_iter().filter(|(_, _, choice)| plan.with(*choice) != *plan);
    let others = others.map(|(kind, name, choice)| (format!("{kind}={name}"), Some(choice), &Kernel::ALL[2..]));
    std::iter::once((PLANNED.to_owned(), None, &Kernel::ALL[..])).chain(others).collect()
}
