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
mod options;
mod outline;
mod overlay;
mod screenshot;
mod section;
mod session;
mod slice;
mod text;
mod window;

pub use options::{MAX_SIDE, Options, ViewerError};

use crate::scene::{Description, Scene};
use frame::{Frame, Request};
use std::{
    sync::atomic::{AtomicBool, Ordering},
    sync::mpsc::{self, Receiver, Sender},
    thread,
};
use window::Link;

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
    use crate::render::Kernel;
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
}
