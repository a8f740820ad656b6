//! Films and what lies behind them, as PNG and EXR files.
//!
//! | picture | PNG, 8 bits | EXR, `f32` |
//! |---|---|---|
//! | film | sRGB through [`tone_map`] | linear RGB |
//! | [`Aov::Depth`], [`Aov::DepthZ`] | grey by its logarithm: nearest white, farthest dark grey; black where nothing is | `Z`; infinite where nothing is |
//! | [`Aov::Normal`], [`Aov::GeometricNormal`] | 0.5 + 0.5 n | n in `N.X`, `N.Y` and `N.Z`; zero where nothing is |
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
    /// The distance from the eye, along the ray.
    Depth,
    /// The distance from the eye along the view: that of the plane across it.
    DepthZ,
    /// The normal for shading, interpolated where a mesh has vertex normals.
    Normal,
    /// The surface's own.
    GeometricNormal,
    /// Which primitive is seen.
    Primitive,
}

impl Aov {
    /// All of them.
    pub const ALL: [Aov; 5] = [Aov::Depth, Aov::DepthZ, Aov::Normal, Aov::GeometricNormal, Aov::Primitive];
    /// `depth`, `depth_z`, `normal`, `geometric_normal`, `primitive`.
    pub fn name(self) -> &'static str {
        ["depth", "depth_z", "normal", "geometric_normal", "primitive"][self as usize]
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
        Format::Exr => target.write(|to| exr_colors(to, &film.pixels, film.width)),
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
                Aov::DepthZ => grey_depth(&hits.z),
                Aov::Normal => unit_vectors(&hits.shading_normal),
                Aov::GeometricNormal => unit_vectors(&hits.normal),
                Aov::Primitive => hits.primitive.iter().map(|&id| id_color(id)).collect(),
            };
            target.write(|to| png(to, &pixels, width))
        }
        Format::Exr => target.write(|to| match aov {
            Aov::Depth => exr_numbers(to, [("Z", hits.t.clone())], width),
            Aov::DepthZ => exr_numbers(to, [("Z", hits.z.clone())], width),
            Aov::Normal => exr_numbers(to, normals(&hits.shading_normal), width),
            Aov::GeometricNormal => exr_numbers(to, normals(&hits.normal), width),
            Aov::Primitive => {
                let ids: Vec<_> = hits.primitive.iter().map(|&id| [id_number(id); 3]).collect();
                exr_colors(to, &ids, width)
            }
        }),
    }
}

fn png(to: &mut (impl Write + Seek), pixels: &[[u8; 3]], width: usize) -> io::Result<()> {
    encode(PngEncoder::new(to), bytemuck::cast_slice(pixels), width, pixels.len(), ExtendedColorType::Rgb8)
}

fn exr_colors(to: &mut (impl Write + Seek), pixels: &[[f32; 3]], width: usize) -> io::Result<()> {
    encode(OpenExrEncoder::new(to), bytemuck::cast_slice(pixels), width, pixels.len(), ExtendedColorType::Rgb32F)
}

/// Named channels.
fn exr_numbers<const N: usize>(
    to: &mut (impl Write + Seek),
    channels: [(&str, Vec<f32>); N],
    width: usize,
) -> io::Result<()> {
    use exr::prelude::*;
    let height = height(channels.first().map_or(0, |(_, numbers)| numbers.len()), width)?;
    let channels = channels.into_iter().map(|(name, numbers)| AnyChannel::new(name, FlatSamples::F32(numbers)));
    let picture = Image::from_channels((width, height), AnyChannels::sort(channels.collect()));
    picture.write().to_buffered(to).map_err(io::Error::other)
}

/// The channels of unit vectors.
fn normals(vectors: &[[f32; 3]]) -> [(&'static str, Vec<f32>); 3] {
    let column = |axis: usize| vectors.iter().map(|v| v[axis]).collect();
    [("N.X", column(0)), ("N.Y", column(1)), ("N.Z", column(2))]
}

/// The number of rows that so many pixels make.
fn height(pixels: usize, width: usize) -> io::Result<usize> {
    let height = pixels.checked_div(width).unwrap_or(0);
    if height == 0 || width * height != pixels {
        return Err(io::Error::other(format!("{pixels} pixels do not make rows of {width}")));
    }
    Ok(height)
}

fn encode(
    encoder: impl ImageEncoder,
    bytes: &[u8],
    width: usize,
    pixels: usize,
    color: ExtendedColorType,
) -> io::Result<()> {
    let height = height(pixels, width)?;
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

/// Unit vectors as colours, zero as grey.
fn unit_vectors(vectors: &[[f32; 3]]) -> Vec<[u8; 3]> {
    vectors.iter().map(|n| n.map(|x| unit_to_byte(0.5 + 0.5 * x))).collect()
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
            z: vec![1.5, f32::INFINITY],
            primitive: vec![5, NONE],
            normal: vec![[0.0, 1.0, -1.0], [0.0; 3]],
            shading_normal: vec![[1.0, 0.0, -0.2], [0.0; 3]],
        };
        let write = |aov: Aov, name: &str| {
            let path = folder.path().join(name);
            write_aov(&hits, aov, 2, Format::of(&path).unwrap(), &Target::new(&path).unwrap()).unwrap();
            path
        };
        let open = |aov: Aov, name: &str| image::open(write(aov, name)).unwrap();
        assert_eq!(open(Aov::GeometricNormal, "g.png").into_rgb8().as_raw()[..], [128, 255, 0, 128, 128, 128]);
        assert_eq!(open(Aov::Normal, "n.png").into_rgb8().as_raw()[..], [255, 128, 102, 128, 128, 128]);
        for aov in [Aov::Depth, Aov::DepthZ] {
            assert_eq!(open(aov, "d.png").into_rgb8().as_raw()[..], [255, 255, 255, 0, 0, 0]);
        }
        // As compositors read them: by name, and every number.
        let named = |aov: Aov| {
            let layer = exr::prelude::read_first_flat_layer_from_file(write(aov, "a.exr")).unwrap().layer_data;
            assert_eq!(layer.size, exr::math::Vec2(2, 1));
            let channels = layer.channel_data.list.into_iter();
            channels.map(|c| (c.name.to_string(), c.sample_data.values_as_f32().collect())).collect::<Vec<_>>()
        };
        let axes = |x: [f32; 2], y, z| [("N.X", x), ("N.Y", y), ("N.Z", z)].map(|(n, c)| (n.to_owned(), c.to_vec()));
        assert_eq!(named(Aov::Depth), [("Z".to_owned(), vec![2.0, f32::INFINITY])]);
        assert_eq!(named(Aov::DepthZ), [("Z".to_owned(), vec![1.5, f32::INFINITY])]);
        assert_eq!(named(Aov::Normal), axes([1.0, 0.0], [0.0, 0.0], [-0.2, 0.0]));
        assert_eq!(named(Aov::GeometricNormal), axes([0.0, 0.0], [1.0, 0.0], [-1.0, 0.0]));
        assert_eq!(open(Aov::Primitive, "p.exr").into_rgb32f().as_raw()[2..4], [5.0, -1.0]);
        assert_eq!(open(Aov::Primitive, "p.png").into_rgb8().as_raw()[3..], [0; 3]);
    }
}
