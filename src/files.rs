//! Writing files so that nobody ever sees half of one, and opening those that are read ([`open`]).
//!
//! A [`Target`] is checked before the work starts and written when it is done: into a temporary file beside
//! it, which takes its name once it is on the disk. So a bad path costs no rendering time, and a failure, an interruption
//! or a crash leaves the old file, or none, but never a torn one; and a program that calls [`abandon`] when it is told to
//! end leaves no other. An [`Appender`] adds lines to a file that keeps what it has.

use std::ffi::OsStr;
use std::fs::{self, File};
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};

mod append;
mod input;
mod temporary;

pub use append::Appender;
pub use input::{Identity, open};
use temporary::Temporary;
pub use temporary::abandon;

/// Why a file cannot be written: its path and the reason, in one line.
#[derive(Debug, thiserror::Error)]
#[error("{}: {problem}", path.display())]
pub struct FileError {
    /// The path, as the user gave it.
    pub path: PathBuf,
    /// The problem.
    pub problem: String,
}

/// A file that can be written, as far as one can tell beforehand.
#[derive(Debug)]
pub struct Target {
    /// As the user gave it.
    path: PathBuf,
    /// With symbolic links followed: the link stays and what it points to is replaced.
    real: PathBuf,
    /// A device or pipe: written to directly, as renaming would replace the device itself.
    special: bool,
}

impl Target {
    /// Checks a path by making a temporary file in its folder, which is gone again when this returns.
    ///
    /// # Errors
    /// When the path is a folder or a read-only file, or its folder does not exist or cannot be written to.
    pub fn new(path: &Path) -> Result<Self, FileError> {
        let error = |problem: String| FileError { path: path.to_owned(), problem };
        if path.file_name().is_none() || path.as_os_str().to_string_lossy().ends_with('/') {
            return Err(error("not a file name".into()));
        }
        let target = match fs::metadata(path) {
            Ok(meta) if meta.is_dir() => return Err(error("is a folder, not a file".into())),
            Ok(meta) if !meta.is_file() => Self { path: path.into(), real: path.into(), special: true },
            Ok(meta) if meta.permissions().readonly() => return Err(error("is read-only".into())),
            Ok(_) => {
                let real = fs::canonicalize(path).map_err(|e| error(reason(&e)))?;
                Self { path: path.into(), real, special: false }
            }
            // A link to what is not there yet is followed, too.
            Err(_) => {
                let aim = fs::read_link(path).ok().and_then(|aim| Some(path.parent()?.join(aim)));
                Self { path: path.into(), real: aim.unwrap_or(path.into()), special: false }
            }
        };
        if target.special {
            return Ok(target);
        }
        let folder = target.folder();
        if !folder.is_dir() {
            return Err(error(format!("cannot be written: there is no folder {}", folder.display())));
        }
        target.temporary()?;
        Ok(target)
    }

    /// The path, as the user gave it.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Calls `write` with a buffered file and gives that file the target's name, with the permissions that a new
    /// file usually gets, once all of it is on the disk. When `write` fails, an existing file is left as it was.
    ///
    /// # Errors
    /// When `write` fails, or the file cannot be made, flushed, brought to the disk or renamed.
    pub fn write(&self, write: impl FnOnce(&mut BufWriter<&File>) -> io::Result<()>) -> Result<(), FileError> {
        if self.special {
            let file = File::options().write(true).open(&self.real).map_err(|e| self.error(&e))?;
            return fill(&file, write).map_err(|e| self.error(&e));
        }
        let temporary = self.temporary()?;
        let written = fill(temporary.file(), write).and_then(|()| sync(temporary.file()));
        written.and_then(|()| temporary.persist(&self.real)).map_err(|e| self.error(&e))?;
        sync_folder(self.folder()).map_err(|e| self.error(&e))
    }

    /// The folder the file is in: what it shares a file system with, so that renaming is atomic.
    fn folder(&self) -> &Path {
        match self.real.parent() {
            Some(parent) if parent != OsStr::new("") => parent,
            _ => Path::new("."),
        }
    }

    fn temporary(&self) -> Result<Temporary, FileError> {
        Temporary::new(self.folder()).map_err(|e| self.error(&e))
    }

    fn error(&self, error: &io::Error) -> FileError {
        FileError { path: self.path.clone(), problem: format!("cannot be written: {}", reason(error)) }
    }
}

fn fill(file: &File, write: impl FnOnce(&mut BufWriter<&File>) -> io::Result<()>) -> io::Result<()> {
    let mut buffer = BufWriter::new(file);
    write(&mut buffer)?;
    buffer.flush()
}

/// Waits until a file is on the disk, so that no crash can leave its name with less. Some systems cannot tell.
fn sync(file: &File) -> io::Result<()> {
    match file.sync_all() {
        Err(error) if matches!(error.kind(), io::ErrorKind::InvalidInput | io::ErrorKind::Unsupported) => Ok(()),
        done => done,
    }
}

/// The same for the names in a folder, where that can be asked for: not of one that may be written but not read.
fn sync_folder(folder: &Path) -> io::Result<()> {
    match File::open(folder) {
        Ok(folder) if cfg!(unix) => sync(&folder),
        _ => Ok(()),
    }
}

/// Writes a new file in a folder (`""` is the current one) under the first of the names `name(1)`, `name(2)` … that
/// is free, and gives its path; nothing is ever overwritten.
///
/// # Errors
/// When `write` fails or the file cannot be made.
pub fn write_numbered(
    folder: &Path,
    name: impl Fn(u32) -> String,
    write: impl FnOnce(&mut BufWriter<&File>) -> io::Result<()>,
) -> Result<PathBuf, FileError> {
    let error =
        |e: &io::Error| FileError { path: folder.join(name(1)), problem: format!("cannot be written: {}", reason(e)) };
    let here = if folder == Path::new("") { Path::new(".") } else { folder };
    let mut file = Temporary::new(here).map_err(|e| error(&e))?;
    fill(file.file(), write).and_then(|()| sync(file.file())).map_err(|e| error(&e))?;
    for number in 1..=u32::MAX {
        let path = folder.join(name(number));
        match file.persist_new(&path).map_err(|e| error(&e))? {
            Some(same) => file = same,
            None => {
                sync_folder(here).map_err(|e| error(&e))?;
                return Ok(path);
            }
        }
    }
    Err(error(&io::ErrorKind::AlreadyExists.into()))
}

/// An error's text without the temporary file's name, which `tempfile` adds and would only confuse.
fn reason(error: &io::Error) -> String {
    match error.raw_os_error() {
        None if error.kind() != io::ErrorKind::Other => io::Error::from(error.kind()).to_string(),
        _ => error.to_string(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn write_atomically(
        path: &Path,
        write: impl FnOnce(&mut BufWriter<&File>) -> io::Result<()>,
    ) -> Result<(), FileError> {
        Target::new(path)?.write(write)
    }

    fn names(folder: &Path) -> Vec<String> {
        fs::read_dir(folder).unwrap().map(|e| e.unwrap().file_name().into_string().unwrap()).collect()
    }

    #[test]
    fn replaces_a_file_and_leaves_nothing_else() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.txt");
        for text in ["first", "second"] {
            write_atomically(&path, |file| file.write_all(text.as_bytes())).unwrap();
            assert_eq!(fs::read_to_string(&path).unwrap(), text);
        }
        assert_eq!(names(folder.path()), ["a.txt"]);
    }

    #[test]
    fn a_failure_half_way_keeps_the_old_file() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.txt");
        fs::write(&path, "old").unwrap();
        let error = write_atomically(&path, |file| {
            file.write_all(b"half")?;
            Err(io::Error::other("disk on fire"))
        });
        assert_eq!(error.unwrap_err().problem, "cannot be written: disk on fire");
        assert_eq!(fs::read_to_string(&path).unwrap(), "old");
        assert_eq!(names(folder.path()), ["a.txt"]);
    }

    #[test]
    fn says_what_is_wrong_with_a_path() {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("file");
        fs::write(&file, "").unwrap();
        let problem = |path: &Path| Target::new(path).unwrap_err().problem;
        assert_eq!(problem(folder.path()), "is a folder, not a file");
        assert_eq!(problem(Path::new("")), "not a file name");
        assert_eq!(problem(&folder.path().join("new/")), "not a file name");
        assert!(problem(&folder.path().join("no/a.png")).contains("there is no folder"));
        assert!(problem(&file.join("a.png")).contains("there is no folder"));
        assert!(names(folder.path()) == ["file"]);
        let mut permissions = fs::metadata(&file).unwrap().permissions();
        permissions.set_readonly(true);
        fs::set_permissions(&file, permissions).unwrap();
        assert_eq!(problem(&file), "is read-only");
    }

    #[cfg(unix)]
    #[test]
    fn links_and_devices_stay_what_they_are() {
        use std::os::unix::fs::{FileTypeExt, PermissionsExt};
        let folder = tempfile::tempdir().unwrap();
        let (real, link, plain) = (folder.path().join("real"), folder.path().join("link"), folder.path().join("plain"));
        fs::write(&real, "old").unwrap();
        std::os::unix::fs::symlink(&real, &link).unwrap();
        write_atomically(&link, |file| file.write_all(b"new")).unwrap();
        assert!(fs::symlink_metadata(&link).unwrap().is_symlink());
        assert_eq!(fs::read_to_string(&real).unwrap(), "new");

        File::create(&plain).unwrap();
        let mode = |path: &Path| fs::metadata(path).unwrap().permissions().mode();
        assert_eq!(mode(&real), mode(&plain), "the umask decides, as for any new file");

        write_atomically(Path::new("/dev/null"), |file| file.write_all(b"gone")).unwrap();
        assert!(fs::metadata("/dev/null").unwrap().file_type().is_char_device());
    }
}
