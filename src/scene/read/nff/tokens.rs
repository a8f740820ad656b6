//! The tokens of an NFF file, with white space between, and comments from `#` to the end of the line.

use std::{
    io::{self, BufRead},
    path::Path,
};

use super::super::error::ReadError;

/// The most bytes of a token: more than any number needs.
const MAX_TOKEN: usize = 256;

/// Every word of the format: entities, then the parts of a view.
const WORDS: [&str; 14] =
    ["v", "b", "l", "f", "s", "c", "p", "pp", "from", "at", "up", "angle", "hither", "resolution"];

/// The tokens of a file, read as they are asked for.
pub(super) struct Tokens<'a, R> {
    input: R,
    path: &'a Path,
    /// How many bytes the file may have.
    limit: u64,
    /// How many of them have been read.
    bytes: u64,
    /// The line that has been read up to.
    reached: usize,
    /// The next token, where `ahead` says that it has been read; empty at the end of the file.
    token: Vec<u8>,
    ahead: bool,
    /// The line of the token that was taken last.
    line: usize,
}

impl<'a, R: BufRead> Tokens<'a, R> {
    pub fn new(input: R, path: &'a Path, limit: u64) -> Self {
        Self { input, path, limit, bytes: 0, reached: 1, token: Vec::new(), ahead: false, line: 1 }
    }

    /// How many bytes of the file have been read.
    pub fn bytes(&self) -> u64 {
        self.bytes
    }

    /// The line of the token that was taken last.
    pub fn line(&self) -> usize {
        self.line
    }

    /// The next token as a word of the format. It stays the next one until it is taken.
    pub fn word(&mut self) -> Result<Option<&'static str>, ReadError> {
        let token = self.peek()?;
        Ok(WORDS.into_iter().find(|word| word.as_bytes() == token))
    }

    /// Takes the next token.
    pub fn take(&mut self) {
        self.line = self.reached;
        self.ahead = false;
    }

    /// Whether the file ends here.
    pub fn is_end(&mut self) -> Result<bool, ReadError> {
        Ok(self.peek()?.is_empty())
    }

    /// Whether the next token is a number.
    pub fn is_number(&mut self) -> Result<bool, ReadError> {
        Ok(parse::<f32>(self.peek()?).is_some())
    }

    /// Takes N numbers, or as many as there are: `key` is the entity they belong to.
    pub fn numbers<const N: usize>(&mut self, key: &str) -> Result<[f32; N], ReadError> {
        let mut numbers = [0.0; N];
        for (i, number) in numbers.iter_mut().enumerate() {
            let missing = || format!("expected {N} {}, got {i}", if N == 1 { "number" } else { "numbers" });
            *number = self.number(key, "a number", missing)?;
        }
        Ok(numbers)
    }

    /// Takes a number: of `kind`, or `missing` says what there is too little of.
    pub fn number<T: std::str::FromStr>(
        &mut self,
        key: &str,
        kind: &str,
        missing: impl FnOnce() -> String,
    ) -> Result<T, ReadError> {
        if let Some(number) = parse(self.peek()?) {
            self.take();
            return Ok(number);
        }
        // What is missing is missing where the entity stops, not where the next one starts.
        if self.is_end()? || self.word()?.is_some() {
            return Err(self.fault(self.line, key, missing()));
        }
        Err(self.fault(self.reached, key, format!("not {kind}: {}", String::from_utf8_lossy(&self.token))))
    }

    /// Puts the place to a rule's verdict about the number that was taken last.
    pub fn sound(&self, key: &str, verdict: Result<(), String>) -> Result<(), ReadError> {
        verdict.map_err(|problem| self.fault(self.line, key, problem))
    }

    /// A fault of an entity.
    pub fn fault(&self, line: usize, key: &str, problem: impl std::fmt::Display) -> ReadError {
        ReadError::at(self.path, line, key, problem)
    }

    /// There is not enough memory.
    pub fn memory(&self) -> ReadError {
        ReadError::memory(self.path)
    }

    /// A fault of the next token.
    pub fn strange(&self, problem: impl std::fmt::Display) -> ReadError {
        ReadError::at(self.path, self.reached, String::from_utf8_lossy(&self.token), problem)
    }

    fn peek(&mut self) -> Result<&[u8], ReadError> {
        if !self.ahead {
            self.token.clear();
            self.read()?;
            self.ahead = true;
        }
        Ok(&self.token)
    }

    /// Reads a token into the empty `token`, and nothing beyond it: `reached` is its line.
    fn read(&mut self) -> Result<(), ReadError> {
        let mut comment = false;
        loop {
            let buffer = match self.input.fill_buf() {
                Ok(buffer) => buffer,
                Err(error) if error.kind() == io::ErrorKind::Interrupted => continue,
                Err(source) => return Err(ReadError::Io { path: self.path.into(), source }),
            };
            let mut used = 0;
            let mut ended = buffer.is_empty();
            for &byte in buffer {
                let part = !(comment || byte == b'#' || byte.is_ascii_whitespace());
                ended = !part && !self.token.is_empty() || self.token.len() > MAX_TOKEN;
                if ended {
                    break;
                }
                used += 1;
                match byte {
                    _ if part => self.token.push(byte),
                    b'\n' => {
                        self.reached += 1;
                        comment = false;
                    }
                    b'#' => comment = true,
                    _ => {}
                }
            }
            self.input.consume(used);
            // Its length has been asked before it was opened, but the file may grow.
            self.bytes += used as u64;
            if self.bytes > self.limit {
                return Err(ReadError::too_long(self.path, self.limit));
            }
            if self.token.len() > MAX_TOKEN {
                return Err(self.strange(format_args!("longer than {MAX_TOKEN} bytes")));
            }
            if ended {
                return Ok(());
            }
        }
    }
}

fn parse<T: std::str::FromStr>(token: &[u8]) -> Option<T> {
    std::str::from_utf8(token).ok()?.parse().ok()
}
