//! The result of a contest as a block of text to paste.

use raypacket::measure::contest::{Entry, Timed};
use raypacket::measure::turns::NOISY;
use std::fmt::{self, Display};

/// What `contest` found, on this machine.
pub struct Block<'a>(pub &'a [Entry]);

impl Display for Block<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Some(Entry { size: [width, height], frames, kernel, standard, isa, stamp, .. }) = self.0.first() else {
            return Ok(());
        };
        let debug = if cfg!(debug_assertions) { ", development build, not for its speed" } else { "" };
        let size = if *standard { "" } else { ": not the contest's size" };
        writeln!(f, "raypacket contest")?;
        writeln!(f, "cpu     {}", stamp.cpu)?;
        writeln!(f, "build   {}, commit {}, {isa}{debug}", stamp.version, stamp.commit)?;
        writeln!(f, "date    {}", stamp.date)?;
        writeln!(f, "path    {frames} frames of {width}x{height}, once around, {kernel}{size}")?;
        let names: Vec<String> = self.0.iter().map(|entry| shown(&entry.scene)).collect();
        let wide = names.iter().map(|name| name.chars().count()).max().unwrap_or(0).max(5);
        write!(
            f,
            "{:wide$}  {:>7} {:>9} {:>9} {:>9} {:>9} {:>6} {:>7}",
            "scene", "threads", "frames/s", "best", "Mrays/s", "ns/pixel", "rounds", "spread"
        )?;
        for (entry, name) in self.0.iter().zip(&names) {
            for row in &entry.results {
                let Timed { threads, fps_median, fps_best, mrays_median, ns_per_pixel, runs, spread } = row;
                let noisy = if *spread > NOISY { "  noisy" } else { "" };
                write!(
                    f,
                    "\n{name:wide$}  {threads:>7} {fps_median:>9.2} {fps_best:>9.2} {mrays_median:>9.2} \
                     {ns_per_pixel:>9.2} {runs:>6} {:>5.1} %{noisy}",
                    100.0 * spread
                )?;
            }
            let agree = if entry.valid { "answers agree" } else { "ANSWERS DISAGREE" };
            write!(f, "\n{name:wide$}  {agree}, pixels {}", entry.digest)?;
        }
        Ok(())
    }
}

/// A name may come from a file.
fn shown(name: &str) -> String {
    name.replace(char::is_control, "?")
}
