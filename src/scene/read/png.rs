//! PNG pictures, a row at a time: reading takes three bytes of memory a pixel, a few rows, and some lengths of the file.
//!
//! Not by the `image` crate, which unpacks colour profiles as large as it may allocate, and holds a picture of 16 bits a
//! channel whole before it becomes one of 8.

use std::io::Cursor;

use png::{BitDepth, Decoder, DecodingError, InterlaceInfo, Limits, Transformations};

/// What a file starts with.
const SIGNATURE: &[u8] = b"\x89PNG\r\n\x1a\n";

/// A compressed byte stands for no more of them.
const DEFLATED: usize = 1032;

/// Whether these are the first bytes of such a file.
pub(super) fn is_png(bytes: &[u8]) -> bool {
    bytes.starts_with(SIGNATURE)
}

/// Width, height and sRGB of 8 bits a channel; `fits` says whether the size is allowed.
///
/// Of 16 bits the upper 8 are kept, rounded; grey becomes red, green and blue; alpha is dropped. Of an animation it is the
/// picture that programs show which know none.
pub(super) fn decode(
    bytes: &[u8],
    fits: impl FnOnce(u32, u32) -> Result<(), String>,
) -> Result<(usize, usize, Vec<[u8; 3]>), String> {
    let text = |error: DecodingError| error.to_string();
    // Chunks that mean nothing here are held one by one.
    let limits = Limits { bytes: 4 * bytes.len() + (1 << 20) };
    let mut decoder = Decoder::new_with_limits(Cursor::new(bytes), limits);
    decoder.set_ignore_text_chunk(true);
    decoder.set_ignore_iccp_chunk(true);
    decoder.set_transformations(Transformations::EXPAND);
    let header = decoder.read_header_info().map_err(text)?;
    let (width, height) = header.size();
    let packed = header.raw_row_length();
    fits(width, height)?;
    let (width, height) = (width as usize, height as usize);
    // So a short file does not get the memory of a large picture.
    if packed.saturating_mul(height) / 2 > bytes.len().saturating_mul(DEFLATED) {
        return Err("ends too early".into());
    }
    let mut reader = decoder.read_info().map_err(text)?;
    let (color, depth) = reader.output_color_type();
    let (samples, wide) = (color.samples(), depth == BitDepth::Sixteen);
    let mut texels: Vec<[u8; 3]> = Vec::new();
    texels.try_reserve_exact(width * height).map_err(|_| "not enough memory")?;
    let mut line = Vec::with_capacity(width);
    while let Some(row) = reader.next_interlaced_row().map_err(text)? {
        rgb(row.data(), samples, wide, &mut line);
        match row.interlace() {
            InterlaceInfo::Null(_) => texels.extend_from_slice(&line),
            InterlaceInfo::Adam7(info) => {
                texels.resize(width * height, [0; 3]);
                png::expand_interlaced_row(texels.as_flattened_mut(), 3 * width, line.as_flattened(), info, 24);
            }
        }
    }
    if texels.len() != width * height {
        return Err("the first frame is not as large as the picture".into());
    }
    Ok((width, height, texels))
}

/// The pixels of a row: one to four samples each, of one byte or two, of which the first or the first three are colours.
fn rgb(row: &[u8], samples: usize, wide: bool, to: &mut Vec<[u8; 3]>) {
    to.clear();
    match (samples, wide) {
        (3, false) => to.extend_from_slice(row.as_chunks().0),
        (4, false) => to.extend(row.as_chunks().0.iter().map(|&[r, g, b, _]| [r, g, b])),
        (_, false) => to.extend(row.chunks_exact(samples).map(|pixel| [pixel[0]; 3])),
        (3.., true) => {
            to.extend(
                row.chunks_exact(2 * samples).map(|p| [narrow(p[0], p[1]), narrow(p[2], p[3]), narrow(p[4], p[5])]),
            );
        }
        (_, true) => to.extend(row.chunks_exact(2 * samples).map(|p| [narrow(p[0], p[1]); 3])),
    }
}

/// 257 of the 65535 steps are one of the 255.
fn narrow(high: u8, low: u8) -> u8 {
    ((u32::from(u16::from_be_bytes([high, low])) + 128) / 257) as u8
}
