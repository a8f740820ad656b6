//! The program `raypacket`: see `cli` for its commands, and the library for everything they do.
#![forbid(unsafe_code)]

mod cli;

use std::process::ExitCode;

fn main() -> ExitCode {
    // Before anything else, as anything else may already use an instruction that this CPU does not have.
    match cli::cpu::complaint() {
        Some(line) => cli::fail(1, &line),
        None => cli::run(),
    }
}
