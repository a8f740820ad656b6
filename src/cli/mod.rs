//! The command line: parse, call, print; one file for each command.
//!
//! Exit status: 0 when all is well; 1 when it could not be done, such as without a display, without enough memory, on a
//! CPU that lacks what the program was compiled for, or when `verify`, `bench` or `contest` find a wrong answer; 2 for bad
//! input, which is found before any work starts and leaves no file behind; 128 and the signal when one ends the program.
//! Errors are one line on standard error.

mod args;
mod bench;
mod block;
mod chart;
mod contest;
mod earlier;
mod failure;
mod folder;
mod info;
mod input;
mod interrupt;
mod page;
mod plan;
mod print;
mod progress;
mod ray_files;
mod render;
mod scenes;
mod verify;
mod view;

use clap::{Parser, Subcommand};
use raypacket::math::{isa, slower_than_cpu};
use std::process::ExitCode;
use std::sync::LazyLock;

/// A CPU ray tracer that traces SIMD packets and checks its answers against a scalar reference
#[derive(Parser)]
#[command(name = "raypacket", version = version(), args_conflicts_with_subcommands = true)]
struct Cli {
    #[command(subcommand)]
    command: Option<Command>,
    /// Without a command: view.
    #[command(flatten)]
    view: view::Args,
}

#[derive(Subcommand)]
enum Command {
    /// Fly through a scene in a window (what happens without a command, too)
    View(view::Args),
    /// Write a picture of a scene as PNG or EXR
    Render(render::Args),
    /// Measure how many rays a second are traced
    Bench(bench::Args),
    /// Measure frames a second along a fixed path, as a result to paste
    Contest(contest::Args),
    /// Check every kernel against the scalar reference
    Verify(verify::Args),
    /// Measure how fast and how right every method is, as SVG charts with their data
    Chart(chart::Args),
    /// Tell what a scene holds and how it will be traced
    Info(info::Args),
    /// List the built-in scenes
    Scenes,
}

/// The version, what it was built from and for, and what a build for this CPU would be worth.
fn version() -> &'static str {
    static VERSION: LazyLock<String> = LazyLock::new(|| {
        let commit = option_env!("RAYPACKET_COMMIT").unwrap_or("unknown");
        let advice = slower_than_cpu().map_or(String::new(), |advice| format!("\n{advice}"));
        format!("{} (commit {commit}, {}){advice}", env!("CARGO_PKG_VERSION"), isa())
    });
    &VERSION
}

/// Parses the arguments and does what they say. Wrong usage ends the program here with status 2.
pub fn run() -> ExitCode {
    let cli = Cli::parse();
    if let Err(failure) = interrupt::watch() {
        return failure.report();
    }
    let done = match cli.command.unwrap_or(Command::View(cli.view)) {
        Command::View(args) => view::run(&args),
        Command::Render(args) => render::run(&args),
        Command::Bench(args) => bench::run(&args),
        Command::Contest(args) => contest::run(&args),
        Command::Verify(args) => verify::run(&args),
        Command::Chart(args) => chart::run(&args),
        Command::Info(args) => info::run(&args),
        Command::Scenes => scenes::run(),
    };
    match done {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => failure.report(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use clap::CommandFactory;

    fn parse(line: &str) -> Result<Cli, clap::Error> {
        Cli::try_parse_from(line.split_whitespace())
    }

    #[test]
    fn clap_finds_the_definition_sound() {
        Cli::command().debug_assert();
    }

    #[test]
    fn view_needs_no_word() {
        let cli = parse("raypacket").ok().unwrap();
        assert!(cli.command.is_none());
        assert_eq!(cli.view.scene, "classic");
        let cli = parse("raypacket flake --size 64x32 --kernel x4 --frames 3").ok().unwrap();
        assert!(cli.command.is_none());
        assert_eq!((cli.view.scene.as_str(), cli.view.frames), ("flake", Some(3)));
        let cli = parse("raypacket --size 64x32 my.toml").ok().unwrap();
        assert_eq!(cli.view.scene, "my.toml");
        let cli = parse("raypacket view flake --frames 2").ok().unwrap();
        assert!(matches!(cli.command, Some(Command::View(args)) if args.scene == "flake" && args.frames == Some(2)));
    }

    #[test]
    fn commands_are_not_scenes() {
        assert!(matches!(parse("raypacket scenes").ok().unwrap().command, Some(Command::Scenes)));
        assert!(parse("raypacket classic render").is_err());
        assert!(parse("raypacket render").is_err(), "-o is required");
        assert!(parse("raypacket view -o a.png").is_err());
    }
}
