//! Files of limited length, and reports of how far they have been read.

use std::{fs::File, io::Read, path::Path};

use super::error::ReadError;

/// Told, while a mesh file is read, how many bytes of it are done, from 0, and how many there are.
pub type Progress<'a> = &'a mut dyn FnMut(u64, u64);

/// The whole of a file that is no longer than `limit`.
pub(super) fn bytes_of(path: &Path, limit: u64) -> Result<Vec<u8>, ReadError> {
    let (file, _) = open(path, limit)?;
    let mut bytes = Vec::new();
    // The file may grow.
    file.take(limit + 1).read_to_end(&mut bytes).map_err(|source| ReadError::Io { path: path.into(), source })?;
    if bytes.len() as u64 <= limit { Ok(bytes) } else { Err(ReadError::too_long(path, limit)) }
}

/// A regular file that is no longer than `limit`, and its length.
pub(super) fn open(path: &Path, limit: u64) -> Result<(File, u64), ReadError> {
    let io = |source| ReadError::Io { path: path.into(), source };
    // Asked before it is opened, since opening a pipe waits for somebody to write to it.
    if !std::fs::metadata(path).map_err(io)?.is_file() {
        return Err(ReadError::File { path: path.into(), problem: "not a regular file".into() });
    }
    let file = File::open(path).map_err(io)?;
    let length = file.metadata().map_err(io)?.len();
    if length <= limit { Ok((file, length)) } else { Err(ReadError::too_long(path, limit)) }
}
