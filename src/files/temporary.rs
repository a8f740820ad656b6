//! Files with names of their own that become others, or vanish.

use std::collections::BTreeSet;
use std::fs::File;
use std::io;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};

use tempfile::NamedTempFile;

/// Those that there are just now. Whoever makes, renames or removes one holds this.
static THERE: Mutex<BTreeSet<PathBuf>> = Mutex::new(BTreeSet::new());

fn there() -> MutexGuard<'static, BTreeSet<PathBuf>> {
    THERE.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Removes all files that are being written, for a program that is about to end. Whoever begins to write one, or would give
/// it its name, waits from now on for ever: what has its name before is whole, and nothing else comes to be.
pub fn abandon() {
    let there = there();
    for path in there.iter() {
        // What cannot be removed stays: there is nobody left to be told.
        let _ = std::fs::remove_file(path);
    }
    std::mem::forget(there);
}

/// A file that is removed when this is dropped, or by [`abandon`].
pub(super) struct Temporary {
    /// Taken when it gets another name.
    file: Option<NamedTempFile>,
    path: PathBuf,
}

impl Temporary {
    /// In a folder, with the permissions that a new file usually gets.
    pub fn new(folder: &Path) -> io::Result<Self> {
        let mut builder = tempfile::Builder::new();
        builder.prefix(".raypacket-").suffix(".tmp");
        // Temporary files are private by default, but this one becomes an ordinary file: the umask decides.
        #[cfg(unix)]
        builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
        let mut there = there();
        let file = builder.tempfile_in(folder)?;
        let path = file.path().to_owned();
        there.insert(path.clone());
        Ok(Self { file: Some(file), path })
    }

    /// The open file.
    pub fn file(&self) -> &File {
        self.file.as_ref().expect("it has no other name yet").as_file()
    }

    /// Gives it another name, in the place of a file that has it.
    pub fn persist(mut self, name: &Path) -> io::Result<()> {
        let mut there = there();
        let file = self.file.take().expect("it has no other name yet");
        let done = file.persist(name).map(drop).map_err(|failed| failed.error);
        there.remove(&self.path);
        done
    }

    /// Gives it a name that is free; itself again where it is not.
    pub fn persist_new(mut self, name: &Path) -> io::Result<Option<Self>> {
        let mut there = there();
        let file = self.file.take().expect("it has no other name yet");
        match file.persist_noclobber(name) {
            Err(taken) if taken.error.kind() == io::ErrorKind::AlreadyExists => {
                self.file = Some(taken.file);
                drop(there);
                Ok(Some(self))
            }
            done => {
                there.remove(&self.path);
                done.map(|_| None).map_err(|failed| failed.error)
            }
        }
    }
}

impl Drop for Temporary {
    fn drop(&mut self) {
        if let Some(file) = self.file.take() {
            let mut there = there();
            drop(file);
            there.remove(&self.path);
        }
    }
}
