//! From a file to a [`Description`]; every fault is one line that names the file, the line and the key.

mod assets;
mod error;
mod image;
mod lines;
mod nff;
mod obj;
mod place;
mod png;
mod polygon;
mod radiance;
mod source;
pub(super) mod toml;

use std::path::Path;

use super::Description;
pub(super) use assets::Assets;
pub use error::{ReadError, one_line};
pub use image::{MAX_IMAGE_BYTES, MAX_IMAGE_PIXELS, MAX_IMAGE_SIDE};
pub use nff::MAX_NFF_BYTES;
pub use obj::MAX_OBJ_BYTES;
pub(super) use obj::alone as read_obj;
pub use source::Progress;
use source::bytes_of;

/// The largest scene file that is read.
///
/// Parsing takes up to about 250 times the file's size in memory, and 1500 bytes more for each table in braces and each
/// part of a key before a dot, of which a file may have 2²⁰. Where a long file is no TOML, has an unknown key or a value of the
/// wrong type, no more is parsed than 64 KiB, or eight times what stands before that, if it is in the first thirty-second.
pub const MAX_TOML_BYTES: u64 = 16 << 20;

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

/// As [`parse`], with the files that the scene names from elsewhere, telling how far each mesh file is.
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
