//! Files of limited length, and reports of how far they have been read.

use std::{
    fs::File,
    io::{self, Read},
    path::Path,
};

use super::error::ReadError;
use crate::files::{self, Identity};

/// Told, while a mesh file is read, how many bytes of it are done, from 0, and how many there are.
pub type Progress<'a> = &'a mut dyn FnMut(u64, u64);

/// A regular file that is open, of whatever length.
pub(super) struct Source<'a> {
    file: File,
    path: &'a Path,
    length: u64,
    /// Which one it is.
    pub identity: Identity,
}

impl<'a> Source<'a> {
    pub fn open(path: &'a Path) -> Result<Self, ReadError> {
        let open = || -> io::Result<Self> {
            let (file, meta) = files::open(path)?;
            Ok(Self { file, path, length: meta.len(), identity: Identity::of(path, &meta)? })
        };
        open().map_err(|source| ReadError::Io { path: path.into(), source })
    }

    /// The file, which is no longer than `limit`, and its length.
    pub fn within(self, limit: u64) -> Result<(File, u64), ReadError> {
        if self.length <= limit { Ok((self.file, self.length)) } else { Err(ReadError::too_long(self.path, limit)) }
    }

    /// The whole of it, which is no longer than `limit`.
    pub fn bytes(self, limit: u64) -> Result<Vec<u8>, ReadError> {
        let path = self.path;
        let (file, length) = self.within(limit)?;
        let mut bytes = Vec::with_capacity(length as usize);
        // The file may grow.
        file.take(limit + 1).read_to_end(&mut bytes).map_err(|source| ReadError::Io { path: path.into(), source })?;
        if bytes.len() as u64 <= limit { Ok(bytes) } else { Err(ReadError::too_long(path, limit)) }
    }
}

/// The whole of a file that is no longer than `limit`.
pub(super) fn bytes_of(path: &Path, limit: u64) -> Result<Vec<u8>, ReadError> {
    Source::open(path)?.bytes(limit)
}

/// A regular file that is no longer than `limit`, and its length.
pub(super) fn open(path: &Path, limit: u64) -> Result<(File, u64), ReadError> {
    Source::open(path)?.within(limit)
}
