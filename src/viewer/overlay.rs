//! The window's text: speed, kernel, threads, keys, messages.

use super::{draw::Picture, input::HELP, text};
use crate::math::{cpu_isa, isa};
use crate::render::{Counts, Kernel};
use std::time::Duration;

/// The figures are averaged over this long, so that they can be read.
const PERIOD: Duration = Duration::from_millis(500);
const TEXT: u32 = 0xF0_F0_F0;
const MESSAGE: u32 = 0xFF_D0_60;

/// Speeds, averaged over the frames of the last half second.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Rates {
    /// Finished frames a second.
    pub frames: f64,
    /// Million rays a second while the 3D view is traced: primary, shadow, reflection, refraction.
    pub mrays: [f64; 4],
}

/// Adds frames up into [`Rates`].
#[derive(Clone, Debug, Default)]
pub struct Meter {
    frames: u32,
    rays: [u64; 4],
    tracing: Duration,
    elapsed: Duration,
    shown: Option<Rates>,
}

impl Meter {
    /// Counts a finished frame: its rays, how long tracing took, and how long ago the frame before it was finished.
    pub fn frame(&mut self, counts: &Counts, tracing: Duration, since_last: Duration) {
        self.frames += 1;
        for (sum, rays) in self.rays.iter_mut().zip(by_kind(counts)) {
            *sum += rays;
        }
        self.tracing += tracing;
        self.elapsed += since_last;
        if self.elapsed >= PERIOD || self.shown.is_none() {
            let per_second = |count: f64, time: Duration| count / time.as_secs_f64().max(1e-9);
            self.shown = Some(Rates {
                frames: per_second(f64::from(self.frames), self.elapsed),
                mrays: self.rays.map(|rays| per_second(rays as f64 * 1e-6, self.tracing)),
            });
            *self = Self { shown: self.shown, ..Self::default() };
        }
    }

    /// The latest figures, None before the first frame.
    pub fn rates(&self) -> Option<Rates> {
        self.shown
    }
}

fn by_kind(counts: &Counts) -> [u64; 4] {
    [counts.primary, counts.shadow, counts.reflection, counts.refraction]
}

/// The contents of the overlay.
#[derive(Clone, Debug, Default)]
pub struct Overlay<'a> {
    /// The scene's name.
    pub scene: &'a str,
    /// The width that the shown frame was traced at.
    pub kernel: Kernel,
    /// Threads that trace; 0 when not yet known.
    pub threads: usize,
    /// The shown frame's rays; None before the first frame.
    pub counts: Option<Counts>,
    /// Speeds; without them the rays of the frame are shown, which is the same each time.
    pub rates: Option<Rates>,
    /// Something to tell, at the bottom.
    pub message: Option<&'a str>,
    /// Whether to show the keys.
    pub help: bool,
}

impl Overlay<'_> {
    /// The lines at the top left.
    pub fn lines(&self) -> Vec<String> {
        let threads = match self.threads {
            0 => String::new(),
            1 => "  1 thread".to_owned(),
            n => format!("  {n} threads"),
        };
        let mut lines = vec![format!("{}  {}{threads}", self.scene, self.kernel.name())];
        // A scene without glass has no line for it.
        let kinds = &["primary", "shadow", "reflection", "refraction"];
        let kinds = &kinds[..if self.counts.is_some_and(|c| c.refraction > 0) { 4 } else { 3 }];
        match (self.counts, self.rates) {
            (None, _) => lines.push("tracing the first frame".to_owned()),
            (Some(counts), None) => {
                lines.extend(kinds.iter().zip(by_kind(&counts)).map(|(kind, n)| format!("{kind:<10} {n:>9} rays")));
            }
            (Some(_), Some(rates)) => {
                lines.push(format!("{} frames/s", figure(rates.frames)));
                let line = |(kind, mrays): (&&str, f64)| format!("{kind:<10} {:>6} Mrays/s", figure(mrays));
                lines.extend(kinds.iter().zip(rates.mrays).map(line));
            }
        }
        lines
    }

    /// Draws everything over a picture.
    pub fn draw(&self, picture: &mut Picture) {
        let mut lines = self.lines();
        if isa() != cpu_isa() {
            lines.push(format!("built for {}, CPU has {}", isa(), cpu_isa()));
        }
        text::panel(picture, 0, 0, &lines, TEXT);
        let height = text::panel_size(&lines).1;
        if self.help {
            text::panel(picture, 0, height, &HELP.map(str::to_owned), TEXT);
        }
        if let Some(message) = self.message {
            let message = [message.to_owned()];
            let top = picture.height.saturating_sub(text::panel_size(&message).1);
            text::panel(picture, 0, top, &message, MESSAGE);
        }
    }
}

/// Three digits or more.
fn figure(value: f64) -> String {
    let decimals = if value < 10.0 { 2 } else { usize::from(value < 100.0) };
    format!("{value:.decimals$}")
}

#[cfg(test)]
mod tests {
    use super::*;

    const COUNTS: Counts = Counts { primary: 2_000_000, shadow: 1_000_000, reflection: 0, refraction: 0 };

    #[test]
    fn the_meter_averages() {
        let mut meter = Meter::default();
        assert_eq!(meter.rates(), None);
        meter.frame(&COUNTS, Duration::from_millis(10), Duration::from_millis(20));
        assert!((meter.rates().unwrap().frames - 50.0).abs() < 1e-6);
        (0..5).for_each(|_| meter.frame(&COUNTS, Duration::from_millis(50), Duration::from_millis(100)));
        let rates = meter.rates().unwrap();
        assert!((rates.frames - 10.0).abs() < 1e-6);
        assert!((rates.mrays[0] - 40.0).abs() < 1e-6 && (rates.mrays[1] - 20.0).abs() < 1e-6);
        assert_eq!(rates.mrays[2], 0.0);
    }

    #[test]
    fn no_time_at_all_is_no_division_by_zero() {
        let mut meter = Meter::default();
        meter.frame(&COUNTS, Duration::ZERO, Duration::ZERO);
        assert!(meter.rates().unwrap().frames.is_finite());
    }

    #[test]
    fn the_lines_say_it_all() {
        let mut overlay = Overlay { scene: "classic", threads: 2, ..Overlay::default() };
        assert_eq!(overlay.lines(), ["classic  x8  2 threads", "tracing the first frame"]);
        assert_eq!(Overlay { threads: 1, ..overlay.clone() }.lines()[0], "classic  x8  1 thread");
        assert_eq!(Overlay { threads: 0, ..overlay.clone() }.lines()[0], "classic  x8");
        overlay.counts = Some(COUNTS);
        assert_eq!(overlay.lines()[1], "primary      2000000 rays");
        overlay.rates = Some(Rates { frames: 123.4, mrays: [45.67, 8.901, 0.0, 0.0] });
        let lines = overlay.lines();
        assert_eq!(
            lines[1..],
            ["123 frames/s", "primary      45.7 Mrays/s", "shadow       8.90 Mrays/s", "reflection   0.00 Mrays/s"]
        );
        overlay.counts = Some(Counts { refraction: 1, ..COUNTS });
        assert_eq!(overlay.lines()[5], "refraction   0.00 Mrays/s");
    }

    #[test]
    fn help_and_messages_show() {
        let drawn = |overlay: &Overlay| {
            let mut picture = Picture::new(400, 300);
            overlay.draw(&mut picture);
            picture
        };
        let plain = Overlay::default();
        let help = Overlay { help: true, ..Overlay::default() };
        let message = Overlay { message: Some("saved"), ..Overlay::default() };
        assert_ne!(drawn(&plain), drawn(&help));
        assert_ne!(drawn(&plain), drawn(&message));
        (0..30).for_each(|size| help.draw(&mut Picture::new(size, size / 2)));
    }
}
