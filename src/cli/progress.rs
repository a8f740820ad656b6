//! A bar for work that takes its time, and a spinner for work that cannot say how far it is.

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use std::io::IsTerminal;
use std::sync::Once;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::{Duration, Instant};

/// Work shorter than this shows no bar.
const PATIENCE: Duration = Duration::from_secs(1);
/// Steps of the bar.
const STEPS: u64 = 1000;
/// Between two pictures of a spinner.
const TURN: Duration = Duration::from_millis(100);

/// A progress bar on standard error, if that is a terminal; it appears when the work has taken a second, and
/// is gone when this is dropped.
pub struct Progress {
    bar: ProgressBar,
    started: Instant,
    done: AtomicU64,
    shown: Once,
    terminal: bool,
}

impl Progress {
    pub fn new() -> Self {
        let bar = ProgressBar::with_draw_target(Some(STEPS), ProgressDrawTarget::hidden());
        if let Ok(style) = ProgressStyle::with_template("{wide_bar} {percent:>3}% {eta} left") {
            bar.set_style(style);
        }
        let terminal = std::io::stderr().is_terminal();
        Self { bar, started: Instant::now(), done: AtomicU64::new(0), shown: Once::new(), terminal }
    }

    /// The share done, 0 to 1, from any thread and in any order.
    pub fn set(&self, share: f32) {
        let step = (f64::from(share.clamp(0.0, 1.0)) * STEPS as f64) as u64;
        let before = self.done.fetch_max(step, Ordering::Relaxed);
        if !self.terminal || before >= step || self.started.elapsed() < PATIENCE {
            return;
        }
        self.shown.call_once(|| self.bar.set_draw_target(ProgressDrawTarget::stderr()));
        self.bar.set_position(step);
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        self.bar.finish_and_clear();
    }
}

/// A message with something that turns beside it on standard error, if that is a terminal; gone when this is dropped.
pub struct Spinner(ProgressBar);

impl Spinner {
    pub fn new(message: String) -> Self {
        // Indicatif itself draws on nothing but terminals.
        let spinner = ProgressBar::with_draw_target(None, ProgressDrawTarget::stderr()).with_message(message);
        spinner.set_style(ProgressStyle::default_spinner());
        spinner.enable_steady_tick(TURN);
        Self(spinner)
    }
}

impl Drop for Spinner {
    fn drop(&mut self) {
        self.0.finish_and_clear();
    }
}
