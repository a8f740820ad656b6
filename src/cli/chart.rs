//! `raypacket chart`: what the accuracy laboratory measures, as pictures with their data.

use super::args::Threads;
use super::failure::Failure;
use super::progress::Progress;
use super::{folder, print};
use raypacket::files::Target;
use raypacket::measure::chart;
use raypacket::measure::lab::{Budget, Machine};
use std::io::Write;
use std::path::{Path, PathBuf};

#[derive(clap::Args)]
pub struct Args {
    /// The folder to write to, made when it is not there
    #[arg(short, long, value_name = "DIR", default_value = "charts")]
    output: PathBuf,
    /// Measure less, in less than a minute
    #[arg(long)]
    quick: bool,
    #[command(flatten)]
    threads: Threads,
}

pub fn run(args: &Args) -> Result<(), Failure> {
    let targets = targets(&args.output)?;
    args.threads.start()?;
    let budget = if args.quick { Budget::QUICK } else { Budget::FULL };
    let machine = Machine::this();
    let progress = Progress::new();
    let mut wrong = Vec::new();
    for (i, (name, [svg, csv])) in targets.iter().enumerate() {
        let share = |part: f32| progress.set((i as f32 + part) / targets.len() as f32);
        let chart = chart::draw(name, &budget, &machine, &share).map_err(Failure::runtime)?;
        for (target, text) in [(svg, &chart.svg), (csv, &chart.table.to_csv(&machine))] {
            target.write(|file| file.write_all(text.as_bytes())).map_err(Failure::runtime)?;
        }
        print::line(svg.path().display())?;
        if !chart.sound {
            wrong.push(&**name);
        }
    }
    if wrong.is_empty() {
        return Ok(());
    }
    Err(Failure::runtime(format!("the widths do not agree: {}", wrong.join(", "))))
}

/// Every chart's name and its two files, all of which can be written.
fn targets(folder: &Path) -> Result<Vec<(String, [Target; 2])>, Failure> {
    folder::make(folder)?;
    let files = |name: String| {
        let [svg, csv] = ["svg", "csv"].map(|extension| Target::new(&folder.join(format!("{name}.{extension}"))));
        Ok((name, [svg.map_err(Failure::input)?, csv.map_err(Failure::input)?]))
    };
    chart::names().into_iter().map(files).collect()
}
