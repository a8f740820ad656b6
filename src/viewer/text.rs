//! Text on pictures, in the bitmap font Noto Sans Mono.

use super::draw::Picture;
use noto_sans_mono_bitmap::{FontWeight, RasterHeight, get_raster, get_raster_width};

const HEIGHT: RasterHeight = RasterHeight::Size16;

/// Pixels from one line to the next.
pub const LINE_HEIGHT: usize = 17;
/// Pixels between a panel's edge and its text.
pub const PADDING: usize = 6;

/// Pixels from one character to the next.
pub fn char_width() -> usize {
    get_raster_width(FontWeight::Regular, HEIGHT)
}

/// Writes one line whose top left corner is at column `x` and row `y`, cut off at the picture's edges. A character
/// that the font lacks becomes a question mark.
pub fn write(picture: &mut Picture, x: usize, y: usize, text: &str, color: u32) {
    for (i, character) in text.chars().enumerate() {
        let left = x + i * char_width();
        if left >= picture.width {
            return;
        }
        let glyph = |character| get_raster(character, FontWeight::Regular, HEIGHT);
        let Some(glyph) = glyph(character).or_else(|| glyph('?')) else { continue };
        for (row, line) in glyph.rows().enumerate() {
            for (column, &coverage) in line.iter().enumerate() {
                if let Some(pixel) = picture.get_mut((left + column) as i64, (y + row) as i64) {
                    *pixel = mix(*pixel, color, coverage);
                }
            }
        }
    }
}

/// Lines of text on a darkened panel whose top left corner is at column `x` and row `y`.
pub fn panel(picture: &mut Picture, x: usize, y: usize, lines: &[String], color: u32) {
    let (width, height) = panel_size(lines);
    for row in y..(y + height).min(picture.height) {
        let right = (x + width).min(picture.width);
        for pixel in &mut picture.pixels[row * picture.width..][x.min(right)..right] {
            *pixel = mix(*pixel, 0x00_00_00, 160);
        }
    }
    for (i, line) in lines.iter().enumerate() {
        write(picture, x + PADDING, y + PADDING + i * LINE_HEIGHT, line, color);
    }
}

/// The width and height of a panel, pixels.
pub fn panel_size(lines: &[String]) -> (usize, usize) {
    let longest = lines.iter().map(|line| line.chars().count()).max().unwrap_or(0);
    (longest * char_width() + 2 * PADDING, lines.len() * LINE_HEIGHT + 2 * PADDING)
}

/// `from` and `to` mixed by channel; `share` of 255 is `to` alone.
fn mix(from: u32, to: u32, share: u8) -> u32 {
    let channel = |shift: u32| {
        let (from, to, share) = ((from >> shift) & 255, (to >> shift) & 255, u32::from(share));
        (((from * (255 - share) + to * share) + 127) / 255) << shift
    };
    channel(16) | channel(8) | channel(0)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn written(text: &str) -> Picture {
        let mut picture = Picture::new(200, 20);
        write(&mut picture, 0, 0, text, 0xFF_FF_FF);
        picture
    }

    #[test]
    fn characters_differ_and_spaces_are_empty() {
        assert!(written("   ").pixels.iter().all(|&pixel| pixel == 0));
        let all: Vec<char> = (' '..='~').collect();
        for (i, a) in all.iter().enumerate() {
            for b in &all[..i] {
                assert_ne!(written(&a.to_string()), written(&b.to_string()), "{a} {b}");
            }
        }
        assert_eq!(written("\u{1F980}"), written("?"));
    }

    #[test]
    fn mixing_ends_at_the_ends() {
        assert_eq!(mix(0x12_34_56, 0xFF_80_00, 0), 0x12_34_56);
        assert_eq!(mix(0x12_34_56, 0xFF_80_00, 255), 0xFF_80_00);
    }

    #[test]
    fn text_is_cut_at_the_edges() {
        for (width, height) in [(0, 0), (1, 1), (5, 30), (300, 3)] {
            let mut picture = Picture::new(width, height);
            let lines = ["some text".to_owned(), String::new(), "more".to_owned()];
            panel(&mut picture, 0, 0, &lines, 0xFF_FF_FF);
            panel(&mut picture, 4, 2, &lines, 0xFF_FF_FF);
            panel(&mut picture, 400, 400, &lines, 0xFF_FF_FF);
        }
    }

    #[test]
    fn a_panel_holds_its_text() {
        let lines = ["wide line of text".to_owned(), "gjpqy|".to_owned()];
        let (width, height) = panel_size(&lines);
        let mut picture = Picture::new(width + 20, height + 20);
        panel(&mut picture, 0, 0, &lines, 0xFF_FF_FF);
        for y in 0..height + 20 {
            for x in 0..width + 20 {
                assert!(picture.pixels[y * (width + 20) + x] == 0 || (x < width && y < height));
            }
        }
    }
}
