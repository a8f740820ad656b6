//! Drawing on an SVG: shapes and words, in pixels.

use plotters::prelude::{
    DrawingBackend, FontStyle, FontTransform, IntoFont, RGBColor, SVGBackend, ShapeStyle, TextStyle,
};
use plotters::style::Color;
use plotters::style::text_anchor::{HPos, Pos, VPos};

/// Steps a pixel, as the backend counts in whole numbers.
const FINE: f64 = 2.0;

/// The number that the backend divides font sizes by.
const FONT_SCALE: f64 = 1.24;

/// The mean width of a letter, in font sizes.
const LETTER: f64 = 0.6;

/// A place on the canvas, from its left top corner.
pub type Place = [f64; 2];

/// The side of a text that its place is on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Anchor {
    Left,
    Middle,
    Right,
}

/// How words look.
#[derive(Clone, Copy, Debug)]
pub struct Font {
    pub size: f64,
    pub color: RGBColor,
    pub bold: bool,
}

impl Font {
    pub const fn new(size: f64, color: RGBColor) -> Self {
        Self { size, color, bold: false }
    }

    pub const fn bold(self) -> Self {
        Self { bold: true, ..self }
    }

    /// About how wide a text is.
    pub fn width(&self, text: &str) -> f64 {
        text.chars().count() as f64 * self.size * LETTER
    }
}

/// A mark that stands for a point.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Marker {
    Circle,
    Square,
    Diamond,
}

/// A drawing.
pub struct Canvas<'a> {
    backend: SVGBackend<'a>,
}

impl Canvas<'_> {
    /// Draws an SVG of so many pixels, on white.
    pub fn draw(width: f64, height: f64, draw: impl FnOnce(&mut Canvas)) -> String {
        let mut text = String::new();
        let fine = [width, height].map(|n| (n * FINE) as u32);
        {
            let mut canvas = Canvas { backend: SVGBackend::with_string(&mut text, fine.into()) };
            canvas.rect([0.0, 0.0], [width, height], RGBColor(255, 255, 255));
            draw(&mut canvas);
            // Nothing is lost when a string is written to; so it is below.
            let _ = canvas.backend.present();
        }
        // Steps are the drawing's affair: it is as large as was asked for.
        let [w, h] = fine;
        text.replacen(&format!("width=\"{w}\" height=\"{h}\""), &format!("width=\"{width}\" height=\"{height}\""), 1)
    }

    /// Writes a line of text whose middle height is at `at`.
    pub fn text(&mut self, at: Place, anchor: Anchor, font: Font, text: &str) {
        let _ = self.backend.draw_text(text, &style(font, anchor, FontTransform::None), fine(at));
    }

    /// Writes a line of text from below to above, its middle at `at`.
    pub fn upward(&mut self, at: Place, font: Font, text: &str) {
        let _ = self.backend.draw_text(text, &style(font, Anchor::Middle, FontTransform::Rotate270), fine(at));
    }

    /// Connects points.
    pub fn line(&mut self, points: &[Place], color: RGBColor, width: f64) {
        if points.len() > 1 {
            let _ = self.backend.draw_path(points.iter().map(|&p| fine(p)), &stroke(color, width));
        }
    }

    /// Connects points with dashes of 6 pixels.
    pub fn dashed(&mut self, points: &[Place], color: RGBColor, width: f64) {
        const DASH: f64 = 6.0;
        const GAP: f64 = 4.0;
        let mut phase = 0.0;
        for pair in points.windows(2) {
            let [a, b] = [pair[0], pair[1]];
            let length = (b[0] - a[0]).hypot(b[1] - a[1]);
            let along = |s: f64| [0, 1].map(|i| a[i] + (b[i] - a[i]) * (s / length.max(1e-9)));
            let mut at = -phase;
            while at < length {
                let dash = [at.max(0.0), (at + DASH).min(length)];
                if dash[1] > dash[0] {
                    self.line(&dash.map(along), color, width);
                }
                at += DASH + GAP;
            }
            phase = length - (at - DASH - GAP);
        }
    }

    /// Fills a rectangle.
    pub fn rect(&mut self, from: Place, to: Place, color: RGBColor) {
        let _ = self.backend.draw_rect(fine(from), fine(to), &color.filled(), true);
    }

    /// The outline of a rectangle.
    pub fn frame(&mut self, from: Place, to: Place, color: RGBColor, width: f64) {
        let _ = self.backend.draw_rect(fine(from), fine(to), &stroke(color, width), false);
    }

    /// A point, on a white rim that sets it apart from what is behind.
    pub fn marker(&mut self, at: Place, marker: Marker, radius: f64, color: RGBColor) {
        for (radius, color) in [(radius + 1.0, RGBColor(255, 255, 255)), (radius, color)] {
            match marker {
                Marker::Circle => {
                    let _ = self.backend.draw_circle(fine(at), (radius * FINE) as u32, &color.filled(), true);
                }
                Marker::Square => {
                    let r = radius * 0.9;
                    self.rect([at[0] - r, at[1] - r], [at[0] + r, at[1] + r], color);
                }
                Marker::Diamond => {
                    let r = radius * 1.3;
                    let corners = [[0.0, -r], [r, 0.0], [0.0, r], [-r, 0.0]].map(|d| [at[0] + d[0], at[1] + d[1]]);
                    let _ = self.backend.fill_polygon(corners.map(fine), &color.filled());
                }
            }
        }
    }
}

fn fine(at: Place) -> (i32, i32) {
    // A cast saturates, and NaN is 0: nothing to fear from odd data.
    let [x, y] = at.map(|v| (v * FINE).round() as i32);
    (x, y)
}

fn stroke(color: RGBColor, width: f64) -> ShapeStyle {
    color.stroke_width((width * FINE).round() as u32)
}

fn style(font: Font, anchor: Anchor, transform: FontTransform) -> TextStyle<'static> {
    let across = match anchor {
        Anchor::Left => HPos::Left,
        Anchor::Middle => HPos::Center,
        Anchor::Right => HPos::Right,
    };
    let weight = if font.bold { FontStyle::Bold } else { FontStyle::Normal };
    let written = ("sans-serif", font.size * FINE * FONT_SCALE, weight).into_font().transform(transform);
    TextStyle { font: written, color: font.color.to_backend_color(), pos: Pos::new(across, VPos::Center) }
}
