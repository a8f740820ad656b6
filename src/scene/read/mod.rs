//! From a file to a [`Description`]; every fault is one line that names the file, the line and the key.

mod assets;
mod image;
mod lines;
mod nff;
mod obj;
mod place;
mod polygon;
mod radiance;
mod strict;
mod toml;

use std::{
    fmt,
    fs::File,
    io::{self, Read},
    path::{Path, PathBuf},
};

use super::Description;
pub(super) use assets::Assets;
pub use image::{MAX_IMAGE_BYTES, MAX_IMAGE_PIXELS, MAX_IMAGE_SIDE};
pub(super) use obj::alone as read_obj;
pub(super) use strict::Exactly;
pub(super) use toml::{Array, Element, Elements, Fault, Reader, Triple};

/// The largest scene file that is read.
///
/// Parsing takes up to about 250 times the file's size in memory, and 1500 bytes more for each table in braces and each
/// part of a key before a dot, of which a file may have 2²⁰.
pub const MAX_TOML_BYTES: u64 = 16 << 20;

/// The most that is read from all mesh and material files of a scene together.
///
/// Reading a mesh as programs write them takes 0.5 to 0.6 bytes of memory a byte of the file (measured with height
/// fields of 100 MB, with and without normals). The most is taken by faces whose corners are all vertices of their own,
/// or that need a normal beside faces that bring theirs: about 150 bytes a triangle, of which all mesh files have at
/// most 2²⁵ together.
pub const MAX_OBJ_BYTES: u64 = 1 << 30;

/// Told, while a mesh file is read, how many bytes of it are done, from 0, and how many there are.
pub type Progress<'a> = &'a mut dyn FnMut(u64, u64);

/// The largest NFF file that is read. Reading takes up to about ten times its size in memory.
pub const MAX_NFF_BYTES: u64 = 256 << 20;

/// Longer keys and problems are cut: a message quotes what the file says, which may be anything.
const MAX_QUOTE: usize = 300;

/// Why a scene could not be read. `Display` is one line, whatever the file holds.
#[derive(Debug, thiserror::Error)]
pub enum ReadError {
    /// The file cannot be opened or read.
    #[error("{}: {source}", one_line(path.display()))]
    Io {
        /// The file.
        path: PathBuf,
        /// What the system says.
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
    /// A line of the file is wrong.
    #[error("{}:{line}: {key}: {problem}", one_line(file.display()))]
    At {
        /// The file.
        file: PathBuf,
        /// The line, from 1.
        line: usize,
        /// The key at fault: `sphere[2].radius`.
        key: String,
        /// What is wrong with it.
        problem: String,
    },
    /// Neither a file nor a built-in scene.
    #[error("{}: no such file, nor a built-in scene ({builtins})", one_line(name))]
    Unknown {
        /// What was asked for.
        name: String,
        /// The built-in names, with commas between.
        builtins: String,
    },
}

impl ReadError {
    fn too_long(path: &Path, limit: u64) -> Self {
        Self::File { path: path.into(), problem: format!("longer than {limit} bytes") }
    }

    fn at(file: &Path, line: usize, key: impl fmt::Display, problem: impl fmt::Display) -> Self {
        Self::At { file: file.into(), line, key: one_line(key), problem: one_line(problem) }
    }
}

/// Reads a scene file in TOML. Meshes and images are looked for beside it.
///
/// # Errors
/// [`ReadError`] for a file that cannot be read or does not describe a sound scene.
pub fn read(path: &Path) -> Result<Description, ReadError> {
    read_with_progress(path, &mut |_, _| ())
}

/// As [`read`], telling how far each mesh file is.
///
/// # Errors
/// As [`read`].
pub fn read_with_progress(path: &Path, progress: Progress<'_>) -> Result<Description, ReadError> {
    let bytes = bytes_of(path, MAX_TOML_BYTES)?;
    match std::str::from_utf8(&bytes) {
        Ok(text) => parse_with(text, path, &Assets::beside(path), progress),
        Err(error) => {
            let (line, quote) = place::quote(&bytes, error.valid_up_to());
            Err(ReadError::at(path, line, quote, "not UTF-8 text"))
        }
    }
}

/// Reads a scene from TOML text; `file` is named in messages, and meshes and images are looked for
/// beside it.
///
/// # Errors
/// [`ReadError`] when the text does not describe a sound scene.
pub fn parse(text: &str, file: &Path) -> Result<Description, ReadError> {
    parse_with(text, file, &Assets::beside(file), &mut |_, _| ())
}

/// The same, with the files that the scene names from elsewhere, telling how far each mesh file is.
pub(super) fn parse_with(
    text: &str,
    file: &Path,
    assets: &Assets,
    progress: Progress<'_>,
) -> Result<Description, ReadError> {
    toml::parse(text, file, assets, progress)
}

/// Reads a scene in Eric Haines' Neutral File Format, telling how far it is.
///
/// # Errors
/// [`ReadError`] for a file that cannot be read or does not describe a sound scene.
pub fn read_nff(path: &Path, progress: Progress<'_>) -> Result<Description, ReadError> {
    nff::read(path, progress)
}

/// The whole of a file that is no longer than `limit`.
fn bytes_of(path: &Path, limit: u64) -> Result<Vec<u8>, ReadError> {
    let (file, _) = open(path, limit)?;
    let mut bytes = Vec::new();
    // The file may grow.
    file.take(limit + 1).read_to_end(&mut bytes).map_err(|source| ReadError::Io { path: path.into(), source })?;
    if bytes.len() as u64 <= limit { Ok(bytes) } else { Err(ReadError::too_long(path, limit)) }
}

/// A regular file that is no longer than `limit`, and its length.
fn open(path: &Path, limit: u64) -> Result<(File, u64), ReadError> {
    let io = |source| ReadError::Io { path: path.into(), source };
    // Asked before it is opened, since opening a pipe waits for somebody to write to it.
    if !std::fs::metadata(path).map_err(io)?.is_file() {
        return Err(ReadError::File { path: path.into(), problem: "not a regular file".into() });
    }
    let file = File::open(path).map_err(io)?;
    let length = file.metadata().map_err(io)?.len();
    if length <= limit { Ok((file, length)) } else { Err(ReadError::too_long(path, limit)) }
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
