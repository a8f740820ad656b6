//! Pictures for surfaces and for the sky.
//!
//! Which format a file has is told by its first bytes, not by its name. Profiles of colour, gamma chunks and turns noted
//! by cameras (EXIF) are not looked at: PNG and JPEG count as sRGB, the first row is the top.

use std::{
    collections::HashMap,
    io::Cursor,
    path::{Path, PathBuf},
    sync::Arc,
};

use image::codecs::jpeg::JpegDecoder;
use image::{DynamicImage, ImageDecoder, ImageFormat, ImageResult, Limits, Luma};

use super::{
    assets::Assets,
    error::{ReadError, one_line},
    png, radiance,
    source::Source,
};
use crate::{files::Identity, math::linear_of_bytes, scene::Texture};

/// The most pixels of a side of an image.
pub const MAX_IMAGE_SIDE: u32 = 16_384;

/// The most pixels of all images of a scene together. Reading takes 3 bytes of memory for each pixel of a PNG texture, and up
/// to about 16 for one of a JPEG or of a panorama; and up to about four times the length of each file.
pub const MAX_IMAGE_PIXELS: u64 = 64 << 20;

/// The most that is read from all image files of a scene together.
pub const MAX_IMAGE_BYTES: u64 = 256 << 20;

const NOT_SRGB: &str = "neither PNG nor JPEG";
const NOT_PANORAMA: &str = "neither Radiance, PNG nor JPEG";

/// The images of a scene, each texture's file read once.
pub(super) struct Images<'a> {
    assets: &'a Assets,
    /// The textures by the paths that were asked for, as they were spelled.
    spelled: HashMap<PathBuf, usize>,
    /// And by their files.
    files: HashMap<Identity, usize>,
    /// By index.
    pub textures: Vec<Arc<Texture>>,
    bytes_left: u64,
    pixels_left: u64,
}

/// Width, height and linear RGB.
type Panorama = (usize, usize, Vec<[f32; 3]>);

impl<'a> Images<'a> {
    pub fn new(assets: &'a Assets) -> Self {
        Self {
            assets,
            spelled: HashMap::new(),
            files: HashMap::new(),
            textures: Vec::new(),
            bytes_left: MAX_IMAGE_BYTES,
            pixels_left: MAX_IMAGE_PIXELS,
        }
    }

    /// The index of a file's texture: PNG or JPEG.
    ///
    /// An alpha channel is dropped: the colours show as they are stored, and the surface stays opaque.
    pub fn texture(&mut self, file: &str) -> Result<usize, ReadError> {
        let path = self.assets.path(file);
        match self.assets {
            Assets::Folder(_) => self.texture_at(path),
            Assets::Builtin => match self.spelled.get(&path) {
                Some(&index) => Ok(index),
                None => {
                    let bytes = self.bytes(file)?;
                    let index = self.add(&path, &bytes)?;
                    self.spelled.insert(path, index);
                    Ok(index)
                }
            },
        }
    }

    /// The index of the texture of a file that a mesh names, by its whole path.
    pub fn texture_at(&mut self, path: PathBuf) -> Result<usize, ReadError> {
        if let Some(&index) = self.spelled.get(&path) {
            return Ok(index);
        }
        let source = Source::open(&path)?;
        // A file may be spelled in any number of ways, and is read once.
        let index = match self.files.get(&source.identity) {
            Some(&index) => index,
            None => {
                let identity = source.identity.clone();
                let bytes = source.bytes(self.bytes_left)?;
                self.bytes_left -= bytes.len() as u64;
                let index = self.add(&path, &bytes)?;
                self.files.insert(identity, index);
                index
            }
        };
        self.spelled.insert(path, index);
        Ok(index)
    }

    /// Adds the texture that a file holds.
    fn add(&mut self, path: &Path, bytes: &[u8]) -> Result<usize, ReadError> {
        let texture = self.rgb8(bytes).map_err(|problem| fault(path, problem))?;
        self.textures.push(texture.into());
        Ok(self.textures.len() - 1)
    }

    /// An equirectangular panorama: Radiance (`.hdr`), which is linear, or PNG or JPEG as for textures.
    ///
    /// Not OpenEXR: the decoder that there is (`exr`) takes gigabytes for as many chunks as a short file may claim.
    pub fn panorama(&mut self, file: &str) -> Result<Panorama, ReadError> {
        let path = self.assets.path(file);
        let bytes = self.bytes(file)?;
        self.linear(&bytes).map_err(|problem| fault(&path, problem))
    }

    fn bytes(&mut self, file: &str) -> Result<Vec<u8>, ReadError> {
        let bytes = self.assets.read(file, self.bytes_left)?;
        self.bytes_left -= bytes.len() as u64;
        Ok(bytes)
    }

    fn rgb8(&mut self, bytes: &[u8]) -> Result<Texture, String> {
        if png::is_png(bytes) {
            let (width, height, texels) = png::decode(bytes, |width, height| self.count(width, height))?;
            return Ok(Texture { width, height, texels });
        }
        if image::guess_format(bytes).ok() != Some(ImageFormat::Jpeg) {
            return Err(NOT_SRGB.into());
        }
        let image = self.jpeg(bytes).map_err(|error| error.to_string())??;
        let (width, height) = (image.width() as usize, image.height() as usize);
        Ok(Texture { width, height, texels: texels(image) })
    }

    fn linear(&mut self, bytes: &[u8]) -> Result<Panorama, String> {
        if radiance::is_radiance(bytes) {
            return radiance::decode(bytes, |width, height| self.count(width, height));
        }
        let texture = self.rgb8(bytes).map_err(|problem| problem.replace(NOT_SRGB, NOT_PANORAMA))?;
        let table = linear_of_bytes();
        let texels = texture.texels.iter().map(|texel| texel.map(|byte| table[usize::from(byte)]));
        Ok((texture.width, texture.height, texels.collect()))
    }

    /// The size is asked for, and judged, before there is any memory for the pixels.
    ///
    /// The decoder is named, as `ImageReader` would have all of them compiled, OpenEXR's too.
    fn jpeg(&mut self, bytes: &[u8]) -> ImageResult<Result<DynamicImage, String>> {
        let mut limits = Limits::default();
        limits.max_image_width = Some(MAX_IMAGE_SIDE);
        limits.max_image_height = Some(MAX_IMAGE_SIDE);
        // Three channels of 8 bits, and what the decoder needs besides.
        limits.max_alloc = Some(8 * MAX_IMAGE_PIXELS + (64 << 20));
        let mut decoder = JpegDecoder::new(Cursor::new(bytes))?;
        decoder.set_limits(limits)?;
        let (width, height) = decoder.dimensions();
        Ok(match self.count(width, height) {
            Ok(()) => Ok(DynamicImage::from_decoder(decoder)?),
            Err(problem) => Err(problem),
        })
    }

    /// Takes an image's pixels off what is left for the scene.
    fn count(&mut self, width: u32, height: u32) -> Result<(), String> {
        if width == 0 || height == 0 {
            return Err(format!("no pixels: {width} × {height}"));
        }
        if width > MAX_IMAGE_SIDE || height > MAX_IMAGE_SIDE {
            return Err(format!("{width} × {height}: at most {MAX_IMAGE_SIDE} pixels a side"));
        }
        let pixels = u64::from(width) * u64::from(height);
        let left = self.pixels_left.checked_sub(pixels);
        self.pixels_left = left.ok_or_else(|| {
            format!("{width} × {height}: at most {MAX_IMAGE_PIXELS} pixels in all images, {} left", self.pixels_left)
        })?;
        Ok(())
    }
}

/// The colours alone, eight bits a channel.
///
/// The common ones are converted here, as `image` is compiled without optimisation.
fn texels(image: DynamicImage) -> Vec<[u8; 3]> {
    match image {
        DynamicImage::ImageLuma8(image) => image.pixels().map(|&Luma([grey])| [grey; 3]).collect(),
        other => other.into_rgb8().as_raw().as_chunks().0.to_vec(),
    }
}

fn fault(path: &Path, problem: String) -> ReadError {
    ReadError::File { path: path.into(), problem: one_line(problem) }
}

#[cfg(test)]
#[path = "image_tests.rs"]
mod tests;
