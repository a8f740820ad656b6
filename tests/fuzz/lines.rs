//! A text as lines and words, for mutations that leave its shape.

use std::ops::Range;

use crate::common::Pcg;

/// The lines, with what ends them.
pub fn lines(bytes: &[u8]) -> Vec<Range<usize>> {
    let mut start = 0;
    bytes
        .split_inclusive(|b| *b == b'\n')
        .map(|line| {
            start += line.len();
            start - line.len()..start
        })
        .collect()
}

/// A few lines in a row.
pub fn some_lines(bytes: &[u8], rng: &mut Pcg) -> Range<usize> {
    let lines = lines(bytes);
    if lines.is_empty() {
        return 0..0;
    }
    let first = rng.below(lines.len());
    let last = (first + rng.pick(&[0, 0, 1, 3, 8])).min(lines.len() - 1);
    lines[first].start..lines[last].end
}

/// Where a line starts, or the end.
pub fn line_start(bytes: &[u8], rng: &mut Pcg) -> usize {
    let lines = lines(bytes);
    lines.get(rng.below(lines.len() + 1)).map_or(bytes.len(), |line| line.start)
}

/// A run of bytes that `part` holds for, from anywhere on.
fn run(bytes: &[u8], part: fn(&u8) -> bool, rng: &mut Pcg) -> Option<Range<usize>> {
    let from = rng.below(bytes.len() + 1);
    let start = from + bytes[from..].iter().position(part)?;
    let end = bytes[start..].iter().position(|b| !part(b)).map_or(bytes.len(), |n| start + n);
    Some(start..end)
}

/// A number, or what is made of the same bytes.
pub fn number(bytes: &[u8], rng: &mut Pcg) -> Option<Range<usize>> {
    run(bytes, |b| b.is_ascii_digit() || b"-+.".contains(b), rng)
}

/// A word: a key, a command, a name.
pub fn word(bytes: &[u8], rng: &mut Pcg) -> Option<Range<usize>> {
    run(bytes, |b| b.is_ascii_alphabetic() || *b == b'_', rng)
}
