//! A picture into memory of the caller's, which can be watched and stopped.

use std::ops::ControlFlow;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

use super::samples::averaged;
use super::tile::{Grid, over_tiles_while};
use super::{Camera, Counts, Kernel, TILE};
use crate::scene::Scene;

/// A picture was stopped before it was done.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, thiserror::Error)]
#[error("the picture was stopped before it was done")]
#[non_exhaustive]
pub struct Cancelled;

/// Renders into `pixels`, row by row from the top, in linear red, green and blue: the bits of
/// [`render`](super::render()) into a film of that size. It works in the caller's rayon pool, with `samples` ×
/// `samples` rays a pixel, at least 1.
///
/// `watch` is told the share that is done, from 0 to 1, before every tile of 16 × 16 pixels, from any thread and not
/// always in rising order, and with 1 at the end. Once it says [`ControlFlow::Break`] no further tile is begun, and the
/// pixels of all such tiles stay as they were. What it says at the end does not matter.
///
/// # Errors
/// [`Cancelled`] when `watch` said so before the last tile was begun.
///
/// # Panics
/// When `pixels` does not hold width × height.
pub fn render_into(
    scene: &Scene,
    camera: &Camera,
    kernel: Kernel,
    samples: u32,
    [width, height]: [usize; 2],
    pixels: &mut [[f32; 3]],
    watch: &(dyn Fn(f32) -> ControlFlow<()> + Sync),
) -> Result<Counts, Cancelled> {
    assert_eq!(Some(pixels.len()), width.checked_mul(height), "the buffer holds the picture");
    let grid = Grid::new(camera, width, height);
    let tiles = width.div_ceil(TILE) * height.div_ceil(TILE);
    let (done, cancelled) = (AtomicUsize::new(0), AtomicBool::new(false));
    let go_on = || {
        let share = done.load(Ordering::Relaxed) as f32 / tiles as f32;
        let stop = cancelled.load(Ordering::Relaxed) || watch(share).is_break();
        if stop {
            cancelled.store(true, Ordering::Relaxed);
        }
        !stop
    };
    let counts = over_tiles_while(pixels, width, &go_on, |work, first, out| {
        let counts = averaged(scene, &grid, first, kernel, samples, work, out);
        done.fetch_add(1, Ordering::Relaxed);
        counts
    });
    if cancelled.into_inner() {
        return Err(Cancelled);
    }
    let _ = watch(1.0);
    Ok(counts)
}
