//! Inputs made of sound files: a few damages each, most of which leave something to read.

use crate::common::Pcg;
use crate::corpus::{Format, NUMBERS, ODD};
use crate::lines::{line_start, number, some_lines, word};

/// The longest input. Few are longer than some thousand bytes.
const MAX_INPUT: usize = 512 << 10;

pub struct Mutator {
    seeds: Vec<Vec<u8>>,
    tokens: Vec<&'static [u8]>,
    numbers: Vec<&'static [u8]>,
}

impl Mutator {
    pub fn new(format: &Format) -> Self {
        let split = |text: &'static str| text.split('|').map(str::as_bytes).collect();
        Self { seeds: (format.seeds)(), tokens: split(format.tokens), numbers: split(NUMBERS) }
    }

    pub fn seeds(&self) -> &[Vec<u8>] {
        &self.seeds
    }

    /// What the numbers say; nothing else counts.
    pub fn input(&self, rng: &mut Pcg) -> Vec<u8> {
        let mut bytes = self.seed(rng).to_vec();
        let damages = rng.pick(&[1, 1, 1, 2, 2, 3, 5, 9]);
        for _ in 0..damages {
            self.damage(&mut bytes, rng);
            bytes.truncate(MAX_INPUT);
        }
        bytes
    }

    fn seed(&self, rng: &mut Pcg) -> &[u8] {
        &self.seeds[rng.below(self.seeds.len())]
    }

    fn damage(&self, bytes: &mut Vec<u8>, rng: &mut Pcg) {
        let at = rng.below(bytes.len() + 1);
        match rng.below(100) {
            // What keeps the text's shape comes first and most often: the readers' depths are behind it.
            0..38 => replace(bytes, number(bytes, rng), &self.edge(rng)),
            38..44 => replace(bytes, word(bytes, rng), rng.pick(&self.tokens)),
            44..50 => {
                let at = line_start(bytes, rng);
                let lines = bytes[some_lines(bytes, rng)].to_vec();
                insert(bytes, at, &lines);
            }
            50..54 => drop(bytes.drain(some_lines(bytes, rng))),
            54..58 => self.borrow(bytes, rng),
            58..62 => turn(bytes, rng),
            62..66 => insert(bytes, at, rng.pick(&self.tokens)),
            66..72 => flip(bytes, at, rng),
            72..76 => {
                let end = (at + 1 + rng.below(16)).min(bytes.len());
                bytes.drain(at..end);
            }
            76..80 => insert(bytes, at, &[rng.bits() as u8]),
            80..83 => insert(bytes, at, rng.pick(ODD)),
            83..86 => self.splice(bytes, at, rng),
            86..89 => bytes.truncate(at),
            89..92 => *bytes = ends(bytes, rng.pick(&[b"\r\n", b"\r", b"\n\n", b" \\\n"])),
            92..95 => nest(bytes, at, rng),
            95..98 => repeat(bytes, at, rng),
            _ => many(bytes, rng),
        }
    }

    /// Lines of another file.
    fn borrow(&self, bytes: &mut Vec<u8>, rng: &mut Pcg) {
        let other = self.seed(rng);
        insert(bytes, line_start(bytes, rng), &other[some_lines(other, rng)]);
    }

    /// The rest of another file from anywhere on.
    fn splice(&self, bytes: &mut Vec<u8>, at: usize, rng: &mut Pcg) {
        let other = self.seed(rng);
        bytes.truncate(at);
        bytes.extend(&other[rng.below(other.len() + 1)..]);
    }

    /// A number that rules and arithmetic stumble over, any `f32`, or a small one.
    fn edge(&self, rng: &mut Pcg) -> Vec<u8> {
        match rng.below(4) {
            0 | 1 => rng.pick(&self.numbers).into(),
            2 => format!("{:e}", f32::from_bits(rng.bits())).into(),
            _ => format!("{}", rng.below(64) as f32 / 8.0 - 2.0).into(),
        }
    }
}

fn insert(bytes: &mut Vec<u8>, at: usize, new: &[u8]) {
    bytes.splice(at..at, new.iter().copied());
}

fn replace(bytes: &mut Vec<u8>, old: Option<std::ops::Range<usize>>, new: &[u8]) {
    if let Some(old) = old {
        bytes.splice(old, new.iter().copied());
    }
}

fn flip(bytes: &mut [u8], at: usize, rng: &mut Pcg) {
    if let Some(byte) = bytes.get_mut(at) {
        *byte ^= 1 << rng.below(8);
    }
}

/// Puts lines from the middle first.
fn turn(bytes: &mut [u8], rng: &mut Pcg) {
    let [a, b] = [line_start(bytes, rng), line_start(bytes, rng)];
    let middle = line_start(bytes, rng).clamp(a.min(b), a.max(b));
    bytes[a.min(b)..a.max(b)].rotate_left(middle - a.min(b));
}

/// Other ends of lines.
fn ends(bytes: &[u8], end: &[u8]) -> Vec<u8> {
    bytes.split(|b| *b == b'\n').collect::<Vec<_>>().join(end)
}

/// What opens, without end.
fn nest(bytes: &mut Vec<u8>, at: usize, rng: &mut Pcg) {
    let open: &[u8] = rng.pick(&[b"[", b"{a=", b"a.", b"[[", b"\"", b"'''", b"/", b"(", b"1/", b"-"]);
    insert(bytes, at, &open.repeat(rng.pick(&[2, 40, 300, 5000])));
}

/// A few bytes again and again: long words and lines.
fn repeat(bytes: &mut Vec<u8>, at: usize, rng: &mut Pcg) {
    let part = bytes[at..(at + 1 + rng.below(24)).min(bytes.len())].to_vec();
    insert(bytes, at, &part.repeat(rng.pick(&[2, 20, 100, 100, 4000])));
}

/// Lines again and again: many of everything.
fn many(bytes: &mut Vec<u8>, rng: &mut Pcg) {
    let (at, part) = (line_start(bytes, rng), some_lines(bytes, rng));
    let part = bytes[part].to_vec();
    let times = if rng.chance(0.05) { 4000 } else { rng.pick(&[3, 20, 100]) };
    insert(bytes, at, &part.repeat(times));
}
