//! `raypacket contest`: a fixed path through a scene, and a result to paste.

use super::args::{self, DEFAULT_SCENE, Size, Threads};
use super::block::Block;
use super::failure::Failure;
use super::{input, print};
use raypacket::files::Appender;
use raypacket::math::slower_than_cpu;
use raypacket::measure::contest;
use raypacket::render::Kernel;
use std::path::PathBuf;
use std::time::Duration;

#[derive(clap::Args)]
pub struct Args {
    /// Scene files (.toml, .nff, .obj) or built-in scenes
    #[arg(value_name = "SCENE", default_value = DEFAULT_SCENE)]
    scenes: Vec<String>,
    /// Add a line of JSON for each scene to FILE
    #[arg(long, value_name = "FILE")]
    append: Option<PathBuf>,
    /// The width and height of a frame in pixels; another than the default is not the contest
    #[arg(long, allow_hyphen_values = true, value_name = "WxH", default_value = "512x512")]
    size: Size,
    /// How many frames the path has, 1 to 1000; another number than the default is not the contest
    #[arg(long, allow_negative_numbers = true, value_name = "N", default_value = "24", value_parser = clap::value_parser!(u16).range(1..=1000))]
    frames: u16,
    /// How many rays are traced at once; another than the default is not the contest
    #[arg(long, value_name = "KERNEL", default_value = "x8", value_parser = args::kernel())]
    kernel: Kernel,
    /// Time for the rounds of each scene, 0 to 3600 seconds; there are 3 rounds at the least and 31 at the most
    #[arg(long, value_name = "S", default_value = "10", value_parser = clap::value_parser!(u16).range(..=3600))]
    seconds: u16,
    #[command(flatten)]
    threads: Threads,
}

pub fn run(args: &Args) -> Result<(), Failure> {
    let append = args.append.as_deref().map(Appender::new).transpose().map_err(Failure::input)?;
    let threads = args.threads.start();
    let scenes = input::load_all(&args.scenes)?;
    threads?;
    let size = [args.size.width, args.size.height];
    let options = contest::Options {
        size,
        frames: args.frames.into(),
        kernel: args.kernel,
        budget: Duration::from_secs(args.seconds.into()),
    };
    let mut entries = Vec::new();
    for (name, description) in args.scenes.iter().zip(&scenes) {
        let scene = input::compile(name, description, &[])?;
        let entry = contest::run(description, &scene, &options);
        entries.push(entry.map_err(|e| Failure::runtime(format!("cannot start a thread: {e}")))?);
    }
    print::line(Block(&entries))?;
    if let Some(advice) = slower_than_cpu() {
        print::line(advice)?;
    }
    if let Some(file) = &append {
        for entry in &entries {
            let line = serde_json::to_string(entry).map_err(|e| Failure::runtime(format!("JSON: {e}")))?;
            file.line(&line).map_err(Failure::runtime)?;
        }
    }
    let wrong: Vec<&str> = (args.scenes.iter().zip(&entries)).filter(|(_, e)| !e.valid).map(|(n, _)| &**n).collect();
    if wrong.is_empty() {
        return Ok(());
    }
    Err(Failure::runtime(format!("the answers do not agree: {}", wrong.join(", "))))
}
