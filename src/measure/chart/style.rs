//! The style that all charts share: colours, fonts, headings, legends.

use plotters::prelude::RGBColor;

use super::canvas::{Anchor, Canvas, Font, Marker, Place};
use crate::measure::lab::Machine;

pub const INK: RGBColor = RGBColor(34, 34, 34);
pub const GREY: RGBColor = RGBColor(105, 105, 105);
pub const GRID: RGBColor = RGBColor(222, 222, 222);
pub const FAINT: RGBColor = RGBColor(240, 240, 240);

/// Colours that are told apart by the colour-blind (Okabe and Ito, *Color Universal Design*, 2008), the default's first;
/// three more for charts with many methods.
pub const COLORS: [RGBColor; 10] = [
    RGBColor(0, 114, 178),
    RGBColor(213, 94, 0),
    RGBColor(0, 158, 115),
    RGBColor(204, 121, 167),
    RGBColor(230, 159, 0),
    RGBColor(86, 180, 233),
    RGBColor(0, 0, 0),
    RGBColor(150, 150, 150),
    RGBColor(120, 70, 30),
    RGBColor(90, 60, 160),
];

pub const TITLE: Font = Font::new(24.0, INK).bold();
pub const HEADING: Font = Font::new(16.0, INK).bold();
pub const TEXT: Font = Font::new(13.0, INK);
pub const SMALL: Font = Font::new(12.0, GREY);

/// Left edge of titles and captions.
pub const MARGIN: f64 = 36.0;

/// Height of a caption's line.
const LINE: f64 = 17.0;

/// A color of [`COLORS`], over and over.
pub fn color(i: usize) -> RGBColor {
    COLORS[i % COLORS.len()]
}

/// The title, and a line that says what is seen.
pub fn title(canvas: &mut Canvas, title: &str, about: &str) {
    canvas.text([MARGIN, 34.0], Anchor::Left, TITLE, title);
    canvas.text([MARGIN, 62.0], Anchor::Left, Font { color: GREY, ..TEXT }, about);
}

/// Lines at the bottom: how it was measured, and on what.
pub fn caption(canvas: &mut Canvas, height: f64, lines: &[String], machine: &Machine) {
    let machine = machine.to_string();
    let lines: Vec<&str> = lines.iter().map(String::as_str).chain([&*machine]).collect();
    for (i, line) in lines.iter().enumerate() {
        let y = height - 14.0 - LINE * (lines.len() - 1 - i) as f64;
        canvas.text([MARGIN, y], Anchor::Left, SMALL, line);
    }
}

/// The look of a legend's entry in the chart.
#[derive(Clone, Copy, Debug)]
pub enum Key {
    Line(RGBColor, f64),
    Dashed(RGBColor, f64),
    Point(Marker, RGBColor),
    Patch(RGBColor),
}

/// Entries in a row from `at` on; gives where it ends.
pub fn legend(canvas: &mut Canvas, at: Place, entries: &[(Key, String)]) -> f64 {
    let [mut x, y] = at;
    for (key, text) in entries {
        let wide = match *key {
            Key::Line(color, width) => {
                canvas.line(&[[x, y], [x + 24.0, y]], color, width);
                24.0
            }
            Key::Dashed(color, width) => {
                canvas.dashed(&[[x, y], [x + 26.0, y]], color, width);
                26.0
            }
            Key::Point(marker, color) => {
                canvas.marker([x + 6.0, y], marker, 5.0, color);
                12.0
            }
            Key::Patch(color) => {
                canvas.rect([x, y - 6.0], [x + 12.0, y + 6.0], color);
                canvas.frame([x, y - 6.0], [x + 12.0, y + 6.0], GREY, 0.5);
                12.0
            }
        };
        canvas.text([x + wide + 6.0, y], Anchor::Left, TEXT, text);
        x += wide + 6.0 + TEXT.width(text) + 20.0;
    }
    x
}

/// A number with commas.
pub fn thousands(n: usize) -> String {
    let digits = n.to_string();
    let groups: Vec<&str> = digits.as_bytes().rchunks(3).rev().map(|g| std::str::from_utf8(g).unwrap_or("")).collect();
    groups.join(",")
}

/// A number of about three digits.
pub fn short(value: f64) -> String {
    match value {
        v if v < 10.0 => format!("{v:.2}"),
        v if v < 1e7 => thousands(v.round() as usize),
        v => format!("{v:.1e}"),
    }
}

/// Words in lines of at most so many letters.
pub fn wrapped(text: &str, letters: usize) -> Vec<String> {
    let mut lines: Vec<String> = vec![String::new()];
    for word in text.split_whitespace() {
        let last = lines.last().map_or(0, |line| line.chars().count());
        if last > 0 && last + 1 + word.chars().count() > letters {
            lines.push(String::new());
        }
        if let Some(line) = lines.last_mut() {
            if !line.is_empty() {
                line.push(' ');
            }
            line.push_str(word);
        }
    }
    lines
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_have_commas() {
        assert_eq!([0, 999, 1000, 1234567].map(thousands), ["0", "999", "1,000", "1,234,567"]);
        assert_eq!([0.5, 12.4, 1363.7, 2e9].map(short), ["0.50", "12", "1,364", "2.0e9"]);
    }

    #[test]
    fn words_are_wrapped() {
        assert_eq!(wrapped("one two  three", 7), ["one two", "three"]);
        assert_eq!(wrapped("extraordinary x", 5), ["extraordinary", "x"]);
        assert_eq!(wrapped("", 5), [""]);
    }
}
