//! Values that several commands take.

use super::failure::Failure;
use clap::builder::{PossibleValuesParser, TypedValueParser};
use raypacket::files::Target;
use raypacket::geometry::methods::Choice;
use raypacket::render::Kernel;
use std::ffi::OsStr;
use std::fmt;
use std::path::Path;
use std::str::FromStr;

/// The scene when none is given.
pub const DEFAULT_SCENE: &str = "classic";

/// A picture's width and height in pixels.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Size {
    pub width: usize,
    pub height: usize,
}

impl Size {
    /// The longest side.
    const MAX_SIDE: usize = raypacket::viewer::MAX_SIDE;
    /// The most pixels: their film takes 768 MiB.
    const MAX_PIXELS: usize = 1 << 26;

    pub fn aspect(self) -> f32 {
        self.width as f32 / self.height as f32
    }
}

impl FromStr for Size {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let side = |text: &str| {
            // A plain number: usize would take a sign, too.
            text.bytes().all(|b| b.is_ascii_digit()).then(|| text.parse::<usize>().ok()).flatten()
        };
        let sides = text.split_once(['x', 'X']).map(|(w, h)| (side(w), side(h)));
        let Some((Some(width), Some(height))) = sides else {
            return Err("expected WIDTHxHEIGHT in pixels, such as 1024x512".into());
        };
        for side in [width, height] {
            if !(1..=Self::MAX_SIDE).contains(&side) {
                return Err(format!("width and height must be 1 to {}", Self::MAX_SIDE));
            }
        }
        if width * height > Self::MAX_PIXELS {
            return Err(format!("{} pixels are more than {}", width * height, Self::MAX_PIXELS));
        }
        Ok(Self { width, height })
    }
}

impl fmt::Display for Size {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}x{}", self.width, self.height)
    }
}

/// Parses `x1`, `x4`, `x8`.
pub fn kernel() -> impl TypedValueParser<Value = Kernel> {
    PossibleValuesParser::new(Kernel::ALL.map(Kernel::name)).map(|name| {
        let found = Kernel::ALL.into_iter().find(|k| k.name() == name);
        found.expect("clap lets only the names of kernels through")
    })
}

/// `--threads`.
#[derive(clap::Args, Clone, Copy)]
pub struct Threads {
    /// Threads to trace with, 1 to 1024 [default: one for each processor]
    #[arg(long, allow_negative_numbers = true, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    threads: Option<u16>,
}

impl Threads {
    /// Makes rayon's pool as large as asked for, and says how many threads it has.
    ///
    /// It is the global pool, so that the calling thread stays the main one, where windows have to live. It has to come
    /// before anything that computes in parallel, such as compiling a scene: that would start the pool at its default
    /// size. Reading a scene does not, so that what is wrong with the input can be said before what is wrong here.
    pub fn start(self) -> Result<usize, Failure> {
        if let Some(threads) = self.threads {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(usize::from(threads));
            pool.build_global()
                .map_err(|e| Failure::runtime(format!("cannot start {}: {e}", count(threads.into()))))?;
        }
        Ok(rayon::current_num_threads())
    }
}

/// `--method`.
#[derive(clap::Args)]
pub struct Methods {
    /// Test or compute by another method than planned, such as sphere=quadratic; may be given again
    #[arg(id = "method", long = "method", value_name = "KIND=METHOD")]
    pub choices: Vec<Choice>,
}

/// So many threads, in words.
pub fn count(threads: usize) -> String {
    if threads == 1 { "1 thread".to_owned() } else { format!("{threads} threads") }
}

/// Where `--json FILE|-` and `--markdown FILE|-` go, checked before the work starts.
pub enum Destination {
    Stdout,
    File(Target),
}

impl Destination {
    pub fn new(path: &OsStr) -> Result<Self, Failure> {
        match path.to_str() {
            Some("-") => Ok(Self::Stdout),
            _ => Target::new(Path::new(path)).map(Self::File).map_err(Failure::input),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sizes() {
        assert_eq!("1024x512".parse(), Ok(Size { width: 1024, height: 512 }));
        assert_eq!("1X16384".parse(), Ok(Size { width: 1, height: 16384 }));
        assert_eq!("8192x8192".parse::<Size>().unwrap().to_string(), "8192x8192");
        let bad = ["", "x", "12", "12x", "x12", "12x12x12", "-1x5", "+1x5", "1.5x2", "1 x 2", "nanx1"];
        let range = ["0x5", "5x0", "0x0", "16385x1", "99999999999999999999x1", "16384x16384"];
        for text in bad.into_iter().chain(range) {
            assert!(text.parse::<Size>().is_err(), "{text}");
        }
        assert!("0x5".parse::<Size>().unwrap_err().contains("1 to 16384"));
    }
}
