//! Rates as a page in Markdown, made anew as a whole, so that it never mixes two machines.

use raypacket::math::isa;
use raypacket::measure::bench::{Measured, Report};
use raypacket::measure::turns::NOISY;
use std::fmt::{self, Display};

/// What `bench` found, on this machine.
pub struct Page<'a> {
    reports: &'a [Report],
}

impl<'a> Page<'a> {
    pub fn new(reports: &'a [Report]) -> Self {
        Self { reports }
    }
}

impl Display for Page<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let threads = self.reports.first().map_or(0, |report| report.threads);
        let cpu = self.reports.first().map_or("", |report| &report.stamp.cpu);
        writeln!(f, "# Rates on {cpu}\n")?;
        writeln!(
            f,
            "`raypacket bench` wrote this page: version {}, compiled for `{}`, {threads} thread{}. A cell is the median in \
             10⁶ rays a second, and in brackets the spread of the runs in percent.",
            env!("CARGO_PKG_VERSION"),
            isa(),
            if threads == 1 { "" } else { "s" },
        )?;
        self.reports.iter().try_for_each(|report| write!(f, "\n{}", Table(report)))
    }
}

/// One scene's rates.
struct Table<'a>(&'a Report);

impl Display for Table<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Report { scene, size: [width, height], methods, valid, build, results, .. } = self.0;
        let agree = if *valid { "agree" } else { "**do not agree**" };
        // A name may come from a file.
        let name = scene.replace(|c: char| c.is_control() || c == '`', "?");
        writeln!(f, "## `{name}`, {width} × {height}\n")?;
        write!(f, "The answers {agree} with the reference. Methods: `{methods}`.")?;
        if let Some(build) = build {
            write!(f, " The tree was built in {:.1} ms and takes {:.2} MB.", build.ms, build.bytes as f64 * 1e-6)?;
        }
        let mut kernels: Vec<&str> = Vec::new();
        for measured in results {
            if !kernels.contains(&measured.kernel) {
                kernels.push(measured.kernel);
            }
        }
        writeln!(f, "\n\n| query | rays | {} |", kernels.join(" | "))?;
        writeln!(f, "|---|---|{}", "---|".repeat(kernels.len()))?;
        for row in results.chunk_by(|a, b| a.query == b.query) {
            let cells: Vec<String> = kernels.iter().map(|kernel| cell(row, kernel)).collect();
            writeln!(f, "| {} | {} | {} |", row[0].query, row[0].rays, cells.join(" | "))?;
        }
        Ok(())
    }
}

/// The rate of one kernel.
fn cell(row: &[Measured], kernel: &str) -> String {
    let Some(Measured { mrays_median, spread, .. }) = row.iter().find(|measured| measured.kernel == kernel) else {
        return "–".to_owned();
    };
    let noisy = if *spread > NOISY { ", noisy" } else { "" };
    format!("{mrays_median:.1} ({:.0}{noisy})", 100.0 * spread)
}
