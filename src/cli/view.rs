//! `raypacket view`, and `raypacket` alone.

use super::args::{DEFAULT_SCENE, Size, Threads, kernel};
use super::failure::Failure;
use super::input;
use raypacket::files::Target;
use raypacket::render::Kernel;
use raypacket::render::output::Format;
use raypacket::viewer::{self, ViewerError};
use std::path::{Path, PathBuf};

#[derive(clap::Args)]
pub struct Args {
    /// A scene file (.toml, .nff, .obj) or a built-in scene
    #[arg(default_value = DEFAULT_SCENE)]
    pub scene: String,
    /// The window's width and height in pixels
    #[arg(long, allow_hyphen_values = true, value_name = "WxH", default_value = "1024x512")]
    pub size: Size,
    /// How many rays are traced at once
    #[arg(long, default_value = "x8", value_parser = kernel())]
    pub kernel: Kernel,
    #[command(flatten)]
    pub threads: Threads,
    /// Close the window after N frames
    #[arg(long, allow_negative_numbers = true, value_name = "N", value_parser = clap::value_parser!(u64).range(1..))]
    pub frames: Option<u64>,
    /// Save what the window shows last as PNG
    #[arg(long, value_name = "FILE.png")]
    pub screenshot: Option<PathBuf>,
}

pub fn run(args: &Args) -> Result<(), Failure> {
    if let Some(path) = &args.screenshot {
        check_screenshot(path)?;
    }
    let threads = args.threads.start();
    let description = input::load(&args.scene)?;
    threads?;
    let scene = input::compile(&args.scene, &description, &[])?;
    let options = viewer::Options {
        size: (args.size.width, args.size.height),
        kernel: args.kernel,
        frames: args.frames,
        screenshot: args.screenshot.clone(),
    };
    viewer::run(&description, &scene, &options).map_err(|e| match e {
        ViewerError::Size(..) => Failure::input(e),
        _ => Failure::runtime(e),
    })
}

/// Finds out now what would otherwise be known only when the window closes.
fn check_screenshot(path: &Path) -> Result<(), Failure> {
    if Format::of(path) != Some(Format::Png) {
        return Err(Failure::input(format!("{}: a screenshot is a .png file", path.display())));
    }
    Target::new(path).map(drop).map_err(Failure::input)
}
