//! The failures of reading a scene, and text that is safe to show.

use std::{
    fmt, io,
    path::{Path, PathBuf},
};

/// Longer keys and problems are cut: a message quotes what the file says, which may be anything.
const MAX_QUOTE: usize = 300;

/// Why a scene could not be read. `Display` is one line, whatever the file holds.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ReadError {
    /// The file cannot be opened or read.
    #[error("{}: {source}", one_line(path.display()))]
    Io {
        /// The file.
        path: PathBuf,
        /// The system's error.
        source: io::Error,
    },
    /// The file as a whole cannot be used.
    #[error("{}: {problem}", one_line(path.display()))]
    File {
        /// The file.
        path: PathBuf,
        /// Why not.
        problem: String,
    },
    /// There is not enough memory for what the file holds.
    #[error("{}: not enough memory to read it", one_line(path.display()))]
    Memory {
        /// The file.
        path: PathBuf,
    },
    /// A line of the file is wrong.
    #[error("{}:{line}: {key}: {problem}", one_line(file.display()))]
    At {
        /// The file.
        file: PathBuf,
        /// The line, from 1.
        line: usize,
        /// The key at fault: `sphere[2].radius`.
        key: String,
        /// The problem with it.
        problem: String,
    },
    /// Neither a file nor a built-in scene.
    #[error("{}: no such file, nor a built-in scene ({builtins})", one_line(name))]
    Unknown {
        /// The name that was asked for.
        name: String,
        /// The built-in names, with commas between.
        builtins: String,
    },
}

impl ReadError {
    pub(super) fn too_long(path: &Path, limit: u64) -> Self {
        Self::File { path: path.into(), problem: format!("longer than {limit} bytes") }
    }

    /// For what could not be reserved.
    pub(super) fn memory(path: &Path) -> Self {
        Self::Memory { path: path.into() }
    }

    pub(super) fn at(file: &Path, line: usize, key: impl fmt::Display, problem: impl fmt::Display) -> Self {
        Self::At { file: file.into(), line, key: one_line(key), problem: one_line(problem) }
    }
}

/// The text with control characters escaped, and cut when it is very long: safe to show on a terminal.
pub fn one_line(text: impl fmt::Display) -> String {
    let text = text.to_string();
    let mut line = String::new();
    for c in text.chars().take(MAX_QUOTE) {
        // U+2028 and U+2029 end a line for some readers too.
        if c.is_control() || matches!(c, '\u{2028}' | '\u{2029}') {
            line.extend(c.escape_default());
        } else {
            line.push(c);
        }
    }
    if text.chars().nth(MAX_QUOTE).is_some() {
        line.push('…');
    }
    line
}
