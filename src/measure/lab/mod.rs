//! The accuracy laboratory: methods measured on the code that renders, judged by the exact truth ([`super::oracle`]).
//!
//! A method is measured by compiling a scene with it and sending rays through the public queries. What is measured is
//! plain data here; [`super::chart`] draws it.

mod batches;
mod errors;
mod failure;
mod frames;
mod frontier;
mod heat;
mod image;
mod machine;
mod method;
mod speed;
mod sweep;
mod truth;

pub use errors::{Errors, Quantiles, percentile, ulps};
pub use failure::{CaseFailure, Curve, failures};
pub use frames::{Frame, FramesOf, PLANNED, SCENES, frames};
pub use frontier::frontier;
pub use heat::{Cell, HEATS, Heat, HeatMap, HeatName, heat};
pub use image::{Difference, difference};
pub use machine::Machine;
pub use method::{Method, methods};
pub use speed::{Point, SpeedOf, Timing, speed};
pub use sweep::{Offset, OffsetCurve, Sweep, sweep};

/// How much to measure.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Budget {
    /// Rays for every setting of a case's dial.
    pub rays: usize,
    /// Settings of every dial.
    pub settings: usize,
    /// Batches of 256 rays whose errors stand beside speed.
    pub batches: usize,
    /// Timed turns of each method and width.
    pub turns: usize,
    /// Rays spawned for every offset and scale.
    pub spawned: usize,
    /// Width and height of the frames.
    pub frame: [usize; 2],
    /// Timed turns of each frame.
    pub frame_turns: usize,
    /// The converged frame has n × n samples a pixel.
    pub converged: u32,
    /// Width and height of a heat map.
    pub heat: [usize; 2],
}

impl Budget {
    /// Some minutes.
    pub const FULL: Self = Self {
        rays: 4000,
        settings: 22,
        batches: 400,
        turns: 31,
        spawned: 20_000,
        frame: [512, 256],
        frame_turns: 7,
        converged: 16,
        heat: [144, 96],
    };

    /// Less than a minute on two cores.
    pub const QUICK: Self = Self {
        rays: 400,
        settings: 12,
        batches: 60,
        turns: 11,
        spawned: 2000,
        frame: [256, 128],
        frame_turns: 3,
        converged: 8,
        heat: [96, 64],
    };
}
