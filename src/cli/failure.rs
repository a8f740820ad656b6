//! How a command ends that could not do what it was asked to.

use std::io::Write;
use std::process::ExitCode;

/// Why a command ends early: the exit status and one line.
pub struct Failure {
    status: u8,
    message: String,
}

impl Failure {
    /// The user's input is at fault: status 2.
    pub fn input(message: impl ToString) -> Self {
        Self { status: 2, message: message.to_string() }
    }

    /// The input is fine, but it could not be done: status 1.
    pub fn runtime(message: impl ToString) -> Self {
        Self { status: 1, message: message.to_string() }
    }

    /// Prints `raypacket: message` on standard error, always as one line, and gives the status.
    pub fn report(&self) -> ExitCode {
        let line = self.message.lines().map(str::trim).filter(|l| !l.is_empty()).collect::<Vec<_>>().join("; ");
        // Should standard error be closed, then nobody wants to know.
        let _ = writeln!(std::io::stderr(), "raypacket: {line}");
        ExitCode::from(self.status)
    }
}
