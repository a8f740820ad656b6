//! `raypacket bench`: rays a second.

use super::args::{DEFAULT_SCENE, Destination, Methods, Size, Threads};
use super::failure::Failure;
use super::page::Page;
use super::ray_files::RayFiles;
use super::{earlier, input, print};
use raypacket::files::Target;
use raypacket::geometry::methods::{Choice, SphereMethod};
use raypacket::measure::against::{Comparison, Run};
use raypacket::measure::bench::{self, Report};
use raypacket::measure::chart;
use raypacket::measure::lab::Machine;
use raypacket::measure::stages::stages;
use raypacket::scene::Description;
use std::ffi::OsString;
use std::io::Write;
use std::path::PathBuf;
use std::time::Duration;

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
    /// Time for the runs of each query, 0 to 3600 seconds; there are 3 runs at the least and 31 at the most
    #[arg(long, value_name = "S", default_value = "4", value_parser = clap::value_parser!(u16).range(..=3600))]
    seconds: u16,
    /// Trace the rays in FILE (eight 32-bit floats a ray) instead; FILE.shadow asks for any hit, others for the nearest
    #[arg(long, value_name = "FILE")]
    rays: Option<PathBuf>,
    /// Tell where the time of a picture goes instead, stage by stage, on one thread
    #[arg(long, conflicts_with_all = ["rays", "json", "markdown", "against", "svg", "save_rays"])]
    stages: bool,
    /// Write the results as JSON, with - to standard output
    #[arg(long, value_name = "FILE|-")]
    json: Option<OsString>,
    /// Write the results as a page in Markdown that names this machine, with - to standard output
    #[arg(long, value_name = "FILE|-")]
    markdown: Option<OsString>,
    /// Compare with an earlier run, which --json wrote to FILE
    #[arg(long, value_name = "FILE")]
    against: Option<PathBuf>,
    /// Draw the rates, or with --against the ratios, as an SVG
    #[arg(long, value_name = "FILE")]
    svg: Option<PathBuf>,
    /// Write the rays that are traced to DIR, one file a scene and kind, as --rays reads them
    #[arg(long, value_name = "DIR", conflicts_with = "rays")]
    save_rays: Option<PathBuf>,
}

pub fn run(args: &Args) -> Result<(), Failure> {
    if args.rays.is_some() && args.scenes.len() > 1 {
        return Err(Failure::input("--rays goes with one scene, as its rays are made for one"));
    }
    let outputs = Outputs::new(args)?;
    let earlier = args.against.as_deref().map(earlier::read).transpose()?;
    let threads = args.threads.start();
    let scenes = input::load_all(&args.scenes)?;
    threads?;
    if args.stages {
        return tell_stages(args, &scenes);
    }
    let reports = measure(args, &scenes, outputs.quiet())?;
    outputs.write(&reports, earlier.as_deref())?;
    let wrong: Vec<&str> = (args.scenes.iter().zip(&reports)).filter(|(_, r)| !r.valid).map(|(n, _)| &**n).collect();
    if wrong.is_empty() {
        return Ok(());
    }
    Err(Failure::runtime(format!("the answers do not agree with the reference: {}", wrong.join(", "))))
}

/// Prints where the time of each scene's picture goes.
fn tell_stages(args: &Args, scenes: &[Description]) -> Result<(), Failure> {
    for (name, description) in args.scenes.iter().zip(scenes) {
        let scene = input::compile(name, description, &args.methods.choices)?;
        print::line(stages(description, &scene, [args.size.width, args.size.height]))?;
    }
    Ok(())
}

/// Measures the scenes, and prints what is found as it comes.
fn measure(args: &Args, scenes: &[Description], quiet: bool) -> Result<Vec<Report>, Failure> {
    let size = [args.size.width, args.size.height];
    let options = bench::Options { size, rays: args.rays.clone(), budget: Duration::from_secs(args.seconds.into()) };
    let files = args.save_rays.as_deref().map(|folder| RayFiles::new(folder, scenes)).transpose()?;
    let mut reports = Vec::new();
    for (i, (name, description)) in args.scenes.iter().zip(scenes).enumerate() {
        let mut choices = args.methods.choices.clone();
        if args.rays.is_some() {
            // What the plan vouches for starts in the scene; these rays may come from anywhere.
            choices.insert(0, Choice::Sphere(SphereMethod::Stable));
        }
        let scene = input::compile(name, description, &choices)?;
        let saved = files.as_ref().map(|files| files.save(i, description, &scene, size)).transpose()?;
        // The message names the ray file.
        let report = bench::run(description, &scene, &options).map_err(Failure::input)?;
        if !quiet {
            saved.into_iter().flatten().try_for_each(print::line)?;
            print::line(&report)?;
        }
        reports.push(report);
    }
    Ok(reports)
}

/// Where the results go besides the lines that are printed, checked before the work starts.
struct Outputs {
    json: Option<Destination>,
    markdown: Option<Destination>,
    svg: Option<Target>,
}

impl Outputs {
    fn new(args: &Args) -> Result<Self, Failure> {
        let to = |path: &Option<OsString>| path.as_deref().map(Destination::new).transpose();
        let svg = args.svg.as_deref().map(Target::new).transpose().map_err(Failure::input)?;
        let outputs = Self { json: to(&args.json)?, markdown: to(&args.markdown)?, svg };
        if outputs.to_stdout() == [true, true] {
            return Err(Failure::input("only one of --json and --markdown can go to standard output"));
        }
        if outputs.quiet() && args.against.is_some() {
            return Err(Failure::input("--against prints to standard output: --json and --markdown need a file"));
        }
        Ok(outputs)
    }

    fn to_stdout(&self) -> [bool; 2] {
        [&self.json, &self.markdown].map(|to| matches!(to, Some(Destination::Stdout)))
    }

    /// Whether a result has standard output for itself.
    fn quiet(&self) -> bool {
        self.to_stdout().contains(&true)
    }

    fn write(&self, reports: &[Report], earlier: Option<&[Run]>) -> Result<(), Failure> {
        if let Some(json) = &self.json {
            print::json(reports, json)?;
        }
        if let Some(markdown) = &self.markdown {
            print::whole(Page::new(reports).to_string().trim_end(), markdown)?;
        }
        let comparison = earlier.map(|old| Comparison::new(old, &reports.iter().map(Run::from).collect::<Vec<_>>()));
        if let Some(svg) = &self.svg {
            let machine = Machine::this();
            let text = match &comparison {
                Some(comparison) => chart::ratios(comparison, &machine),
                None => chart::rates(reports, &machine),
            };
            svg.write(|file| file.write_all(text.as_bytes())).map_err(Failure::runtime)?;
        }
        comparison.map_or(Ok(()), |comparison| print::line(format!("\n{comparison}")))
    }
}
