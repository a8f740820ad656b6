//! `raypacket bench`: rays a second.

use super::args::{DEFAULT_SCENE, Destination, Methods, Size, Threads};
use super::failure::Failure;
use super::page::Page;
use super::{input, print};
use raypacket::geometry::methods::{Choice, SphereMethod};
use raypacket::measure::{bench, stages};
use std::ffi::OsString;
use std::path::PathBuf;

#[derive(clap::Args)]
pub struct Args {
    /// Scene files (.toml, .nff, .obj) or built-in scenes
    #[arg(value_name = "SCENE", default_value = DEFAULT_SCENE)]
    scenes: Vec<String>,
    /// The width and height in pixels of the image whose rays are traced
    #[arg(long, allow_hyphen_values = true, value_name = "WxH", default_value = "1024x512")]
    size: Size,
    #[command(flatten)]
    methods: Methods,
    #[command(flatten)]
    threads: Threads,
    /// Trace the rays in FILE (eight 32-bit floats a ray) instead; FILE.shadow asks for any hit, others for the nearest
    #[arg(long, value_name = "FILE")]
    rays: Option<PathBuf>,
    /// Tell where the time of a picture goes instead, stage by stage, on one thread
    #[arg(long, conflicts_with_all = ["rays", "json", "markdown"])]
    stages: bool,
    /// Write the results as JSON, with - to standard output
    #[arg(long, value_name = "FILE|-")]
    json: Option<OsString>,
    /// Write the results as a page in Markdown that names this machine, with - to standard output
    #[arg(long, value_name = "FILE|-")]
    markdown: Option<OsString>,
}

pub fn run(args: &Args) -> Result<(), Failure> {
    if args.rays.is_some() && args.scenes.len() > 1 {
        return Err(Failure::input("--rays goes with one scene, as its rays are made for one"));
    }
    let [json, markdown] = [&args.json, &args.markdown].map(|path| path.as_deref().map(Destination::new).transpose());
    let (json, markdown) = (json?, markdown?);
    let to_stdout = [&json, &markdown].map(|to| matches!(to, Some(Destination::Stdout)));
    if to_stdout == [true, true] {
        return Err(Failure::input("only one of --json and --markdown can go to standard output"));
    }
    let quiet = to_stdout.contains(&true);
    let threads = args.threads.start();
    let scenes = input::load_all(&args.scenes)?;
    threads?;
    let options = bench::Options { size: [args.size.width, args.size.height], rays: args.rays.clone() };
    let mut reports = Vec::new();
    for (name, description) in args.scenes.iter().zip(&scenes) {
        let mut choices = args.methods.choices.clone();
        if args.rays.is_some() {
            // What the plan vouches for starts in the scene; these rays may come from anywhere.
            choices.insert(0, Choice::Sphere(SphereMethod::Stable));
        }
        let scene = input::compile(name, description, &choices)?;
        if args.stages {
            print::line(stages::stages(description, &scene, options.size))?;
            continue;
        }
        // The message names the ray file.
        let report = bench::run(description, &scene, &options).map_err(Failure::input)?;
        if !quiet {
            print::line(&report)?;
        }
        reports.push(report);
    }
    if let Some(json) = &json {
        print::json(&reports, json)?;
    }
    if let Some(markdown) = &markdown {
        print::whole(Page::new(&reports).to_string().trim_end(), markdown)?;
    }
    let wrong: Vec<&str> = (args.scenes.iter().zip(&reports)).filter(|(_, r)| !r.valid).map(|(n, _)| &**n).collect();
    if wrong.is_empty() {
        return Ok(());
    }
    Err(Failure::runtime(format!("the answers do not agree with the reference: {}", wrong.join(", "))))
}
