//! `raypacket verify`: every kernel against the reference.

use super::args::{Destination, Methods, Size};
use super::failure::Failure;
use super::{input, print};
use raypacket::measure::verify;
use raypacket::render::Kernel;
use raypacket::scene;
use std::ffi::OsString;

/// It keeps all that every kernel and the reference answered, several hundred bytes a pixel.
const MAX_PIXELS: usize = 1 << 22;

#[derive(clap::Args)]
pub struct Args {
    /// Scene files (.toml, .nff, .obj) or built-in scenes [default: all built-in scenes]
    #[arg(value_name = "SCENE")]
    scenes: Vec<String>,
    /// The width and height in pixels of the image that is compared
    #[arg(long, allow_hyphen_values = true, value_name = "WxH", default_value = "256x128")]
    size: Size,
    #[command(flatten)]
    methods: Methods,
    /// Write the results as JSON, with - to standard output
    #[arg(long, value_name = "FILE|-")]
    json: Option<OsString>,
}

pub fn run(args: &Args) -> Result<(), Failure> {
    let json = args.json.as_deref().map(Destination::new).transpose()?;
    let names = if args.scenes.is_empty() {
        scene::builtins().iter().map(|b| b.name.to_string()).collect()
    } else {
        args.scenes.clone()
    };
    let (pixels, most) = (args.size.width * args.size.height, MAX_PIXELS);
    if pixels > most {
        return Err(Failure::input(format!("--size {}: verify compares at most {most} pixels", args.size)));
    }
    let scenes = input::load_all(&names)?;
    let options = args.methods.choices.as_slice().into();
    let mut reports = Vec::new();
    for (name, scene) in names.iter().zip(&scenes) {
        input::check(name, scene)?;
        let report = verify::verify_with(scene, &options, &Kernel::ALL, args.size.width, args.size.height);
        if !matches!(json, Some(Destination::Stdout)) {
            print::line(&report)?;
        }
        reports.push(report);
    }
    if let Some(json) = &json {
        print::json(&reports, json)?;
    }
    let wrong: Vec<&str> = names.iter().zip(&reports).filter(|(_, r)| !r.pass).map(|(n, _)| &**n).collect();
    if wrong.is_empty() {
        return Ok(());
    }
    Err(Failure::runtime(format!("verify failed: {}", wrong.join(", "))))
}
