//! Text files line by line, in little memory however long they are.

use std::{
    borrow::Cow,
    fs::File,
    io::{self, BufRead, BufReader, Read},
    path::Path,
};

use super::{
    error::ReadError,
    source::{Progress, open},
};

/// The longest line, with those that continue it: a face of as many corners as may be fits.
const MAX_LINE: u64 = 4 << 20;

/// Progress is told when so many bytes have been read.
const STEP: u64 = 1 << 20;

/// The lines of a file, without their ends; one that ends in a backslash goes on in the next.
pub(super) struct Lines<'a, R> {
    reader: BufReader<io::Take<R>>,
    path: &'a Path,
    line: Vec<u8>,
    /// The number of the last line that was read.
    number: usize,
    limit: u64,
    length: u64,
    done: u64,
    progress: Progress<'a>,
}

impl<'a> Lines<'a, File> {
    /// Opens a file that is no longer than `limit`.
    pub fn open(path: &'a Path, limit: u64, progress: Progress<'a>) -> Result<Self, ReadError> {
        let (file, length) = open(path, limit)?;
        Ok(Self::new(file, path, (limit, length), progress))
    }
}

impl<'a, R: Read> Lines<'a, R> {
    /// Reads what is called `path` in messages, up to a limit; of its length only progress is told.
    pub fn new(reader: R, path: &'a Path, (limit, length): (u64, u64), progress: Progress<'a>) -> Self {
        progress(0, length);
        // The file may grow.
        let reader = BufReader::with_capacity(1 << 16, reader.take(limit + 1));
        Self { reader, path, line: Vec::new(), number: 0, limit, length, done: 0, progress }
    }

    /// How many bytes have been read.
    pub fn done(&self) -> u64 {
        self.done
    }

    /// The next line and its number, from 1. What is not UTF-8 is replaced.
    pub fn next(&mut self) -> Result<Option<(usize, Cow<'_, str>)>, ReadError> {
        self.line.clear();
        let start = self.number + 1;
        let mut comment = false;
        loop {
            let known = self.line.len();
            let room = MAX_LINE - self.line.len() as u64;
            let mut part = (&mut self.reader).take(room + 1);
            let read = part
                .read_until(b'\n', &mut self.line)
                .map_err(|source| ReadError::Io { path: self.path.into(), source })? as u64;
            self.advance(read)?;
            if read > room {
                let problem = format!("longer than {MAX_LINE} bytes");
                return Err(ReadError::at(self.path, start, "line", problem));
            }
            if read == 0 && self.line.is_empty() {
                return Ok(None);
            }
            self.number += usize::from(read > 0);
            let end = self.line.iter().rposition(|b| !matches!(b, b'\n' | b'\r')).map_or(0, |i| i + 1);
            self.line.truncate(end);
            // Comments end in a backslash when they quote a path. Only what is new is searched: a line may go on a
            // million times.
            comment |= self.line[known.min(end)..].contains(&b'#');
            if comment || read == 0 || self.line.last() != Some(&b'\\') {
                break;
            }
            self.line.pop();
            self.line.push(b' ');
        }
        Ok(Some((start, String::from_utf8_lossy(&self.line))))
    }

    fn advance(&mut self, read: u64) -> Result<(), ReadError> {
        let before = self.done / STEP;
        self.done += read;
        if self.done > self.limit {
            return Err(ReadError::too_long(self.path, self.limit));
        }
        if self.done / STEP > before {
            (self.progress)(self.done.min(self.length), self.length);
        }
        Ok(())
    }
}
