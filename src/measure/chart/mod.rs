//! Charts of what [`super::lab`] measures: an SVG for a person, and the data beside it as CSV.
//!
//! | chart | what it shows |
//! |---|---|
//! | `speed-error` | ns a ray against the error of t and wrong decisions, for every method and width |
//! | `failure-…` | wrong decisions and errors of t along every hard case's dial |
//! | `epsilon` | acne and leaks by offset, over the scene's scale |
//! | `frames` | ms a frame against the picture's error |
//! | `heat-…` | errors over the screen, where textbook methods fail |
//!
//! Besides, [`rates()`] and [`ratios()`] draw what [`super::bench`] and [`super::against`] found.

mod axis;
mod canvas;
mod epsilon;
mod failure;
mod frames;
mod heat;
mod job;
mod rates;
mod ratios;
mod scale;
mod speed_error;
mod style;
mod table;

pub use job::Chart;
pub use rates::rates;
pub use ratios::ratios;
pub use table::Table;

use crate::measure::lab::{Budget, HEATS, Machine};
use job::Context;

/// The names of all charts, in the order in which they are best made: timings first, while the machine is cool.
pub fn names() -> Vec<String> {
    let first =
        ["speed-error", "frames", "failure-sphere", "failure-triangle", "failure-torus", "failure-others", "epsilon"];
    first.iter().map(|&name| name.to_owned()).chain(HEATS.iter().map(|h| format!("heat-{}", h.name))).collect()
}

/// Measures and draws one of [`names`], in the caller's rayon pool; `progress` is called with the share done, 0 to 1.
///
/// # Errors
/// One line when there is no such chart, or a scene cannot be compiled.
pub fn draw(name: &str, budget: &Budget, machine: &Machine, progress: &(dyn Fn(f32) + Sync)) -> Result<Chart, String> {
    let context = Context { budget, machine, progress };
    match name {
        "speed-error" => speed_error::draw(name, &context),
        "frames" => frames::draw(name, &context),
        "epsilon" => epsilon::draw(name, &context),
        _ if !names().iter().any(|n| n == name) => Err(format!("no chart `{name}`; there are {}", names().join(", "))),
        _ if name.starts_with("heat-") => heat::draw(name, &context),
        _ => failure::draw(name, &context),
    }
}

#[cfg(test)]
mod tests;
