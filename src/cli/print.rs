//! Standard output, which may be a pipe that nobody reads any more.

use super::args::Destination;
use super::failure::Failure;
use serde::Serialize;
use std::fmt::Display;
use std::io::{self, ErrorKind, Write};

/// Prints a line, or several. A closed pipe is no failure: `raypacket scenes | head -1` has all it asked for.
pub fn line(text: impl Display) -> Result<(), Failure> {
    let mut out = io::stdout().lock();
    match writeln!(out, "{text}").and_then(|()| out.flush()) {
        Err(e) if e.kind() != ErrorKind::BrokenPipe => {
            Err(Failure::runtime(format!("standard output: cannot be written: {e}")))
        }
        _ => Ok(()),
    }
}

/// Writes reports as JSON on one line: one as an object, several as an array.
pub fn json<T: Serialize>(reports: &[T], to: &Destination) -> Result<(), Failure> {
    let text = match reports {
        [one] => serde_json::to_string(one),
        many => serde_json::to_string(many),
    };
    let text = text.map_err(|e| Failure::runtime(format!("JSON: {e}")))?;
    whole(text, to)
}

/// Writes a text, and ends its last line.
pub fn whole(text: impl Display, to: &Destination) -> Result<(), Failure> {
    match to {
        Destination::Stdout => line(text),
        Destination::File(target) => target.write(|file| writeln!(file, "{text}")).map_err(Failure::runtime),
    }
}
