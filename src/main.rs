//! The program `raypacket`: see `cli` for its commands, and the library for everything they do.
//!
//! Before `main` runs `build/startup.rs`, which ends the program when the CPU lacks what it is compiled for.
#![forbid(unsafe_code)]

mod cli;

fn main() -> std::process::ExitCode {
    cli::run()
}
