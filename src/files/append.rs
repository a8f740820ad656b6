//! Adding lines to a file that keeps what it has.

use std::fs::File;
use std::io::{self, Read, Seek, SeekFrom, Write};
use std::path::Path;

use super::{FileError, Target, sync};

/// A file that lines can be added to, as far as one can tell beforehand.
#[derive(Debug)]
pub struct Appender {
    target: Target,
}

impl Appender {
    /// Checks a path as [`Target::new`] does.
    ///
    /// # Errors
    /// As [`Target::new`].
    pub fn new(path: &Path) -> Result<Self, FileError> {
        Target::new(path).map(|target| Self { target })
    }

    /// Adds a line by one call to the system, and makes the file when it is not there. A file whose last line was cut off
    /// gets that line ended first. When the line cannot be written as a whole, the file is left as it was.
    ///
    /// # Errors
    /// When the file cannot be opened or written.
    pub fn line(&self, text: &str) -> Result<(), FileError> {
        let path = &self.target.path;
        let error = |e: io::Error| self.target.error(&e);
        let mut line = text.as_bytes().to_owned();
        line.push(b'\n');
        // A device has no end to look at.
        if self.target.special {
            let mut file = File::options().write(true).open(path).map_err(error)?;
            return file.write_all(&line).map_err(error);
        }
        let mut file = File::options().read(true).append(true).create(true).open(path).map_err(error)?;
        let length = file.metadata().map_err(error)?.len();
        if length > 0 {
            let mut last = [0];
            file.seek(SeekFrom::Start(length - 1)).and_then(|_| file.read_exact(&mut last)).map_err(error)?;
            if last != *b"\n" {
                line.insert(0, b'\n');
            }
        }
        file.write_all(&line).and_then(|()| sync(&file)).map_err(|e| {
            // Should this fail as well, there is nothing left to do.
            let _ = file.set_len(length);
            error(e)
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::fs;

    #[test]
    fn lines_are_added_and_a_torn_one_is_ended() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.jsonl");
        let file = Appender::new(&path).unwrap();
        assert!(!path.exists(), "only checked");
        file.line("1").unwrap();
        file.line("2").unwrap();
        assert_eq!(fs::read_to_string(&path).unwrap(), "1\n2\n");
        fs::write(&path, "1\n2").unwrap();
        file.line("3").unwrap();
        assert_eq!(fs::read_to_string(&path).unwrap(), "1\n2\n3\n");
        assert_eq!(Appender::new(folder.path()).unwrap_err().problem, "is a folder, not a file");
    }

    #[cfg(target_os = "linux")]
    #[test]
    fn devices() {
        Appender::new(Path::new("/dev/null")).unwrap().line("gone").unwrap();
        let full = Appender::new(Path::new("/dev/full")).unwrap().line("no").unwrap_err();
        assert!(full.problem.starts_with("cannot be written: "), "{full}");
    }
}
