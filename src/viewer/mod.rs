//! The window: a scene flown through live, beside the lecture's 2D slice of it.
//!
//! Two threads share the work, so that the window answers at once however long a frame takes:
//!
//! ```text
//! window: wait ≤ 12 ms for a frame ─▶ ask for the next ─▶ show it ─▶ keys and mouse ─▶ wait …
//!                          ▲                 │ Request: camera, kernel, size, map
//!                    Frame │                 ▼
//! painter: both views of one camera, traced in the caller's rayon pool
//! ```
//!
//! The next frame is traced while the last one is shown, so several hundred a second are possible. Everything but
//! `window` is plain functions on state and pictures, and tested as such.

mod controls;
mod cut;
mod draw;
mod frame;
mod input;
mod map;
mod outline;
mod overlay;
mod screenshot;
mod section;
mod session;
mod slice;
mod text;
mod window;

use crate::files::FileError;
use crate::{
    render::Kernel,
    scene::{Description, Scene},
};
use frame::{Frame, Request};
use std::{
    path::PathBuf,
    sync::atomic::{AtomicBool, Ordering},
    sync::mpsc::{self, Receiver, Sender},
    thread,
};
use window::Link;

/// The longest side of a window; what window systems count sizes with ends not far above.
pub const MAX_SIDE: usize = 16_384;

/// How to open the window.
#[derive(Clone, Debug, PartialEq)]
pub struct Options {
    /// Width and height at the start; the left half is the 3D view, the right half the slice. 1 to [`MAX_SIDE`].
    pub size: (usize, usize),
    /// The width to trace at first.
    pub kernel: Kernel,
    /// Show so many frames of the scene's camera, each of them finished, and quit; input is ignored.
    pub frames: Option<u64>,
    /// Save the whole window's picture, both halves, as PNG after the last of `frames` (1 if not given). The same
    /// options give the same picture each time: in place of speeds it shows the rays of a frame.
    pub screenshot: Option<PathBuf>,
}

impl Default for Options {
    fn default() -> Self {
        Self { size: (1024, 512), kernel: Kernel::default(), frames: None, screenshot: None }
    }
}

impl Options {
    fn check(&self) -> Result<(), ViewerError> {
        let (width, height) = self.size;
        let possible = 1..=MAX_SIDE;
        if possible.contains(&width) && possible.contains(&height) {
            Ok(())
        } else {
            Err(ViewerError::Size(width, height))
        }
    }

    /// The number of frames to show before quitting; None to go on until the user quits.
    fn script(&self) -> Option<u64> {
        self.frames.or(self.screenshot.as_ref().map(|_| 1)).map(|frames| frames.max(1))
    }
}

/// Why the window could not be opened, or not go on.
#[derive(Debug, thiserror::Error)]
pub enum ViewerError {
    /// There is no display to open a window on; the reason.
    #[error("there is no display to open a window on ({0}); `raypacket render` writes a picture without one")]
    NoDisplay(String),
    /// A side of 0 or beyond [`MAX_SIDE`].
    #[error("a window of {0} x {1} pixels is not possible: each side may be 1 to {MAX_SIDE}")]
    Size(usize, usize),
    /// The window stopped working.
    #[error("the window failed: {0}")]
    Window(String),
    /// The window was closed before all of [`Options::frames`] were shown.
    #[error("the window was closed before the last frame")]
    Closed,
    /// The screenshot could not be written.
    #[error(transparent)]
    Screenshot(#[from] FileError),
}

/// Opens a window on a scene and stays until the user quits, or [`Options::frames`] have been shown. `scene` is
/// what [`crate::scene::compile`] made of `description`.
///
/// Traces in the rayon pool that it is called in, or else in the global one. On macOS a window has to be on the main
/// thread, and so this call too: give the global pool its threads instead of calling from inside another.
///
/// # Errors
/// [`ViewerError`], before anything is traced when there is no display.
pub fn run(description: &Description, scene: &Scene, options: &Options) -> Result<(), ViewerError> {
    options.check()?;
    let over = AtomicBool::new(false);
    let window = |link: Link| {
        let shown = window::show(description, options, &link);
        // The frame under way is for nobody.
        over.store(true, Ordering::Relaxed);
        shown
    };
    let go_on = || !over.load(Ordering::Relaxed);
    join(window, |request, frame| frame.paint(scene, description, request, &go_on))
}

/// Runs a window and a painter beside each other until the window ends.
fn join<T: Send>(window: impl FnOnce(Link) -> T + Send, paint: impl FnMut(&Request, &mut Frame) + Send) -> T {
    let (requests, asked) = mpsc::channel();
    let (painted, frames) = mpsc::channel();
    // Each side owns its ends of the channels and drops them when it returns or panics, by which the other side knows.
    let window = move || window(Link { requests, frames });
    let paint = move || serve(asked, painted, paint);
    thread::scope(|scope| {
        if rayon::current_thread_index().is_some() {
            // Called in a pool: painting has to stay on its thread, which may be the pool's only one.
            let window = scope.spawn(window);
            paint();
            window.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic))
        } else {
            let painter = scope.spawn(paint);
            let result = window();
            painter.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic));
            result
        }
    })
}

/// Paints what is asked for until nobody asks any more.
fn serve(asked: Receiver<(Request, Frame)>, painted: Sender<Frame>, mut paint: impl FnMut(&Request, &mut Frame)) {
    for (request, mut frame) in asked {
        paint(&request, &mut frame);
        if painted.send(frame).is_err() {
            return;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use session::Session;
    use std::panic::{AssertUnwindSafe, catch_unwind};

    fn request() -> Request {
        Session::new(&Description::default(), Kernel::X8).request((8, 4))
    }

    /// Asks for ten frames, and gives back how many came.
    fn ten_frames(link: Link) -> usize {
        let came = |_: &i32| link.requests.send((request(), Frame::default())).is_ok() && link.frames.recv().is_ok();
        (0..10).take_while(came).count()
    }

    fn paint(request: &Request, frame: &mut Frame) {
        frame.view.resize(request.size.0, request.size.1);
    }

    #[test]
    fn frames_come_outside_a_pool_and_inside_the_smallest() {
        assert_eq!(join(ten_frames, paint), 10);
        let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build().unwrap();
        assert_eq!(pool.install(|| join(ten_frames, paint)), 10);
    }

    #[test]
    fn a_panic_on_either_side_ends_both() {
        let broken = |_: &Request, _: &mut Frame| panic!("painter");
        assert!(catch_unwind(AssertUnwindSafe(|| join(ten_frames, broken))).is_err());
        assert!(catch_unwind(AssertUnwindSafe(|| join(|_| -> usize { panic!("window") }, paint))).is_err());
        let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build().unwrap();
        assert!(catch_unwind(AssertUnwindSafe(|| pool.install(|| join(ten_frames, broken)))).is_err());
    }

    #[test]
    fn impossible_sizes_are_errors() {
        for size in [(0, 512), (512, 0), (MAX_SIDE + 1, 1), (1, usize::MAX)] {
            let options = Options { size, ..Options::default() };
            assert!(matches!(options.check(), Err(ViewerError::Size(..))), "{size:?}");
        }
        assert!(Options::default().check().is_ok());
    }

    #[test]
    fn the_message_names_render() {
        assert!(ViewerError::NoDisplay("reason".to_owned()).to_string().contains("`raypacket render`"));
    }

    #[test]
    fn a_screenshot_alone_is_of_one_frame() {
        let options = Options { screenshot: Some("a.png".into()), ..Options::default() };
        assert_eq!(options.script(), Some(1));
        assert_eq!(Options { frames: Some(3), ..options }.script(), Some(3));
        assert_eq!(Options::default().script(), None);
    }
}
