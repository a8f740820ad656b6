//! Opening files to read: regular ones, and without waiting for anybody.

use std::fs::{self, File, Metadata};
use std::io;
use std::path::Path;

/// Opens a regular file, and says what it is like.
///
/// A pipe, a device, a folder or a socket is refused, and never waited for, not even when it takes the place of a regular
/// file just now. What is regular by name and yet has nothing to read for the time being, as files of the kernel may have,
/// gives an error when it is read.
///
/// # Errors
/// When it cannot be opened, or is no regular file.
pub fn open(path: &Path) -> io::Result<(File, Metadata)> {
    let regular = |meta: &Metadata| match meta.is_file() {
        true => Ok(()),
        false => Err(io::Error::other("not a regular file")),
    };
    // Asked by name first, since opening alone does something to some devices: it winds a tape back.
    regular(&fs::metadata(path)?)?;
    let file = at_once(path)?;
    let meta = file.metadata()?;
    regular(&meta)?;
    Ok((file, meta))
}

/// Opens whatever it is, without waiting until somebody writes to a pipe or a line is free.
fn at_once(path: &Path) -> io::Result<File> {
    let mut options = File::options();
    options.read(true);
    #[cfg(unix)]
    {
        use rustix::fs::OFlags;
        let flags = OFlags::NONBLOCK | OFlags::NOCTTY;
        std::os::unix::fs::OpenOptionsExt::custom_flags(&mut options, flags.bits() as i32);
    }
    options.open(path)
}

/// What tells a file from all others, however its path is spelled, while nobody changes it.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct Identity(#[cfg(unix)] [u64; 4], #[cfg(not(unix))] std::path::PathBuf);

impl Identity {
    /// Of a file that [`open`] gave.
    ///
    /// # Errors
    /// When the system does not know where it is.
    pub fn of(path: &Path, meta: &Metadata) -> io::Result<Self> {
        #[cfg(unix)]
        {
            use std::os::unix::fs::MetadataExt;
            let _ = path;
            // The number of a file that is gone may be given again, but not with the same time of the last change.
            Ok(Self([meta.dev(), meta.ino(), meta.ctime() as u64, meta.ctime_nsec() as u64]))
        }
        #[cfg(not(unix))]
        {
            let _ = meta;
            fs::canonicalize(path).map(Self)
        }
    }
}

#[cfg(all(test, unix))]
mod tests {
    use super::*;
    use std::process::Command;

    #[test]
    fn only_regular_files_are_opened() {
        let folder = tempfile::tempdir().unwrap();
        let [file, pipe, link] = ["file", "pipe", "link"].map(|name| folder.path().join(name));
        fs::write(&file, "12345").unwrap();
        assert!(Command::new("mkfifo").arg(&pipe).status().unwrap().success());
        std::os::unix::fs::symlink(&pipe, &link).unwrap();
        assert_eq!(open(&file).unwrap().1.len(), 5);
        for other in [&pipe, &link, folder.path(), Path::new("/dev/null")] {
            assert_eq!(open(other).unwrap_err().to_string(), "not a regular file", "{}", other.display());
        }
        assert_eq!(open(&folder.path().join("none")).unwrap_err().kind(), io::ErrorKind::NotFound);
    }

    /// As when a pipe takes the place of a file between the two questions.
    #[test]
    fn a_pipe_that_nobody_writes_to_is_not_waited_for() {
        let folder = tempfile::tempdir().unwrap();
        let pipe = folder.path().join("pipe");
        assert!(Command::new("mkfifo").arg(&pipe).status().unwrap().success());
        assert!(!at_once(&pipe).unwrap().metadata().unwrap().is_file());
    }

    #[test]
    fn a_file_is_one_however_it_is_spelled() {
        let folder = tempfile::tempdir().unwrap();
        let at = |name: &str| folder.path().join(name);
        fs::create_dir(at("a")).unwrap();
        for name in ["one", "other"] {
            fs::write(at(name), "same").unwrap();
        }
        fs::hard_link(at("one"), at("a/hard")).unwrap();
        std::os::unix::fs::symlink("../one", at("a/soft")).unwrap();
        let identity = |name: &str| Identity::of(&at(name), &open(&at(name)).unwrap().1).unwrap();
        for name in ["a/../one", ".//a/./../one", "a/hard", "a/soft"] {
            assert_eq!(identity(name), identity("one"), "{name}");
        }
        assert_ne!(identity("other"), identity("one"));
    }
}
