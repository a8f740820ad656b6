//! From a compiled scene and a camera to an image: tiles in parallel on the caller's rayon pool.

#[cfg(feature = "files")]
pub mod output;

mod adaptive;
mod buffer;
mod camera;
mod film;
mod kernel;
mod samples;
mod tile;

pub use crate::shade::Counts;
pub use adaptive::{ALIKE, render_adaptive};
pub use buffer::{Cancelled, render_into};
pub use camera::Camera;
pub(crate) use film::Tone;
pub use film::{Film, tone_map};
pub use kernel::Kernel;
#[cfg(feature = "lab")]
pub(crate) use kernel::with_lanes;
pub use samples::{Samples, render, render_samples};
pub use tile::{PrimaryHits, TILE, primary_hits, record, render_display, render_display_while, render_observed};
