//! Films and what lies behind them, as PNG and EXR files.
//!
//! | picture | PNG, 8 bits | EXR, `f32` |
//! |---|---|---|
//! | film | sRGB through [`tone_map`] | linear RGB |
//! | [`Aov::Depth`] | grey by log t: nearest white, farthest dark grey; black where nothing is | t in R, G and B; infinite where nothing is |
//! | [`Aov::Normal`] | 0.5 + 0.5 n | n; zero where nothing is |
//! | [`Aov::Primitive`] | a colour for each id; black where nothing is | the id in R, G and B; −1 where nothing is |
//!
//! Depth is shown on a logarithmic scale, as a floor that runs to the horizon would leave all else white
//! on a linear one. An `f32` holds ids exactly up to 2²⁴.

use super::{Film, PrimaryHits, tone_map};
use crate::files::{FileError, Target};
use crate::trace::NONE;
use image::codecs::{openexr::OpenExrEncoder, png::PngEncoder};
use image::{ExtendedColorType, ImageEncoder};
use std::io::{self, Seek, Write};
use std::path::Path;

/// The formats a picture can be written in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// 8 bits a channel.
    Png,
    /// OpenEXR, `f32` a channel.
    Exr,
}

impl Format {
    /// By the path's extension, in capitals or not; None for any but `png` and `exr`.
    pub fn of(path: &Path) -> Option<Self> {
        let extension = path.extension()?.to_str()?.to_ascii_lowercase();
        match extension.as_str() {
            "png" => Some(Self::Png),
            "exr" => Some(Self::Exr),
            _ => None,
        }
    }
}

/// A quantity that can be written instead of colours.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Aov {
    /// The distance from the eye.
    Depth,
    /// The shading normal.
    Normal,
    /// Which primitive is seen.
    Primitive,
}

impl Aov {
    /// All of them.
    pub const ALL: [Aov; 3] = [Aov::Depth, Aov::Normal, Aov::Primitive];
    /// `depth`, `normal`, `primitive`.
    pub fn name(self) -> &'static str {
        ["depth", "normal", "primitive"][self as usize]
    }
}

/// Writes a film; see the table above.
///
/// # Errors
/// When the file cannot be written.
pub fn write_film(film: &Film, format: Format, target: &Target) -> Result<(), FileError> {
    match format {
        Format::Png => {
            let pixels: Vec<u32> = film.pixels.iter().map(|&rgb| tone_map(rgb)).collect();
            write_display(&pixels, film.width, target)
        }
        Format::Exr => target.write(|to| exr(to, &film.pixels, film.width)),
    }
}

/// Writes 0RGB pixels, as a window shows them, as PNG. There are `width` pixels in a row.
///
/// # Errors
/// When the file cannot be written.
pub fn write_display(pixels: &[u32], width: usize, target: &Target) -> Result<(), FileError> {
    target.write(|to| encode_display(to, pixels, width))
}

/// Encodes 0RGB pixels, `width` of them in a row, as PNG.
///
/// # Errors
/// When there is no picture, or `to` fails.
pub fn encode_display(to: &mut (impl Write + Seek), pixels: &[u32], width: usize) -> io::Result<()> {
    let rgb: Vec<[u8; 3]> = pixels.iter().map(|&p| split(p)).collect();
    png(to, &rgb, width)
}

/// Writes what the eye's rays hit, `width` of them in a row; see the table above.
///
/// # Errors
/// When the file cannot be written.
pub fn write_aov(hits: &PrimaryHits, aov: Aov, width: usize, format: Format, target: &Target) -> Result<(), FileError> {
    match format {
        Format::Png => {
            let pixels = match aov {
                Aov::Depth => grey_depth(&hits.t),
                Aov::Normal => hits.normal.iter().map(|n| n.map(|x| unit_to_byte(0.5 + 0.5 * x))).collect(),
                Aov::Primitive => hits.primitive.iter().map(|&id| id_color(id)).collect(),
            };
            target.write(|to| png(to, &pixels, width))
        }
        Format::Exr => {
            let pixels = match aov {
                Aov::Depth => hits.t.iter().map(|&t| [t; 3]).collect(),
                Aov::Normal => hits.normal.clone(),
                Aov::Primitive => hits.primitive.iter().map(|&id| [id_number(id); 3]).collect(),
            };
            target.write(|to| exr(to, &pixels, width))
        }
    }
}

fn png(to: &mut (impl Write + Seek), pixels: &[[u8; 3]], width: usize) -> io::Result<()> {
    encode(PngEncoder::new(to), bytemuck::cast_slice(pixels), width, pixels.len(), ExtendedColorType::Rgb8)
}

fn exr(to: &mut (impl Write + Seek), pixels: &[[f32; 3]], width: usize) -> io::Result<()> {
    encode(OpenExrEncoder::new(to), bytemuck::cast_slice(pixels), width, pixels.len(), ExtendedColorType::Rgb32F)
}

fn encode(
    encoder: impl ImageEncoder,
    bytes: &[u8],
    width: usize,
    pixels: usize,
    color: ExtendedColorType,
) -> io::Result<()> {
    let height = pixels.checked_div(width).unwrap_or(0);
    if height == 0 || width * height != pixels {
        return Err(io::Error::other(format!("{pixels} pixels do not make rows of {width}")));
    }
    let side = |pixels: usize| u32::try_from(pixels).map_err(io::Error::other);
    encoder.write_image(bytes, side(width)?, side(height)?, color).map_err(io::Error::other)
}

/// 0RGB to its three bytes.
fn split(pixel: u32) -> [u8; 3] {
    let [_, r, g, b] = pixel.to_be_bytes();
    [r, g, b]
}

/// 0..1 to 0..255, rounded and clamped; NaN to 0.
fn unit_to_byte(x: f32) -> u8 {
    (x * 255.0).round() as u8
}

/// Nearest white, farthest a fifth of it, by log t; nothing (an infinite t) black.
fn grey_depth(t: &[f32]) -> Vec<[u8; 3]> {
    let log = |t: f32| t.max(f32::MIN_POSITIVE).ln();
    let (mut near, mut far) = (f32::INFINITY, f32::NEG_INFINITY);
    for &t in t.iter().filter(|t| t.is_finite()) {
        near = near.min(log(t));
        far = far.max(log(t));
    }
    let range = if far > near { far - near } else { 1.0 };
    let grey = |&t: &f32| if t.is_finite() { 1.0 - 0.8 * (log(t) - near) / range } else { 0.0 };
    t.iter().map(|t| [unit_to_byte(grey(t)); 3]).collect()
}

/// The id as a number, −1 for none.
fn id_number(id: u32) -> f32 {
    if id == NONE { -1.0 } else { id as f32 }
}

/// A colour for each id, black for none.
///
/// Every step permutes the 24-bit numbers and keeps 0 where it is, so the first 2²⁴ − 1 ids have colours of their
/// own, and only none is black.
fn id_color(id: u32) -> [u8; 3] {
    const MASK: u32 = (1 << 24) - 1;
    let mut v = id.wrapping_add(1) & MASK;
    for odd in [0x9e_3779, 0x85_ebcb, 0xc2_b2af] {
        v = v.wrapping_mul(odd) & MASK;
        v ^= v >> 12;
    }
    split(v)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::HashSet;

    #[test]
    fn format_by_extension() {
        assert_eq!(Format::of(Path::new("a/b.png")), Some(Format::Png));
        assert_eq!(Format::of(Path::new("b.EXR")), Some(Format::Exr));
        for bad in ["b.jpg", "png", ".png", "b.png.gz", "b"] {
            assert_eq!(Format::of(Path::new(bad)), None, "{bad}");
        }
    }

    #[test]
    fn ids_have_colors_of_their_own() {
        let colors: HashSet<_> = (0..100_000).map(id_color).collect();
        assert_eq!(colors.len(), 100_000);
        assert!(!colors.contains(&[0; 3]));
        assert_eq!(id_color(NONE), [0; 3]);
        assert_eq!((id_number(7), id_number(NONE)), (7.0, -1.0));
    }

    #[test]
    fn depth_runs_from_white_to_dark_grey() {
        let grey = |t: &[f32]| -> Vec<u8> { grey_depth(t).iter().map(|p| p[0]).collect() };
        assert_eq!(grey(&[1.0, 10.0, 100.0, f32::INFINITY]), [255, 153, 51, 0]);
        assert_eq!(grey(&[3.0, f32::INFINITY]), [255, 0]);
        assert_eq!(grey(&[f32::INFINITY; 2]), [0, 0]);
        assert_eq!(grey(&[0.0, f32::MAX]), [255, 51]);
    }

    #[test]
    fn exr_gives_back_the_very_bits() {
        let folder = tempfile::tempdir().unwrap();
        let target = Target::new(&folder.path().join("a.exr")).unwrap();
        let mut film = Film::new(3, 2);
        film.pixels[4] = [0.1, 1e9, -3.5];
        write_film(&film, Format::Exr, &target).unwrap();
        let back = image::open(target.path()).unwrap().into_rgb32f();
        assert_eq!(back.dimensions(), (3, 2));
        assert_eq!(back.as_raw()[..], film.pixels.as_flattened()[..]);
    }

    #[test]
    fn aovs_as_written() {
        let folder = tempfile::tempdir().unwrap();
        let hits = PrimaryHits {
            t: vec![2.0, f32::INFINITY],
            primitive: vec![5, NONE],
            normal: vec![[0.0, 1.0, -1.0], [0.0; 3]],
        };
        let open = |aov: Aov, name: &str| {
            let path = folder.path().join(name);
            write_aov(&hits, aov, 2, Format::of(&path).unwrap(), &Target::new(&path).unwrap()).unwrap();
            image::open(path).unwrap()
        };
        assert_eq!(open(Aov::Normal, "n.png").into_rgb8().as_raw()[..], [128, 255, 0, 128, 128, 128]);
        assert_eq!(open(Aov::Normal, "n.exr").into_rgb32f().as_raw()[..3], [0.0, 1.0, -1.0]);
        assert_eq!(open(Aov::Depth, "d.png").into_rgb8().as_raw()[..], [255, 255, 255, 0, 0, 0]);
        assert_eq!(open(Aov::Depth, "d.exr").into_rgb32f().as_raw()[2..4], [2.0, f32::INFINITY]);
        assert_eq!(open(Aov::Primitive, "p.exr").into_rgb32f().as_raw()[2..4], [5.0, -1.0]);
        assert_eq!(open(Aov::Primitive, "p.png").into_rgb8().as_raw()[3..], [0; 3]);
    }
}
