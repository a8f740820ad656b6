//! Axes and the panels between them.

use plotters::prelude::RGBColor;

use super::canvas::{Anchor, Canvas, Place};
use super::style::{FAINT, GREY, GRID, INK, SMALL, TEXT};

/// The part of an axis that is left for 0 below its logarithmic rest.
const NONE: f64 = 0.1;

/// Where 0 is then, and half of how far its band reaches.
const ZERO: f64 = 0.03;

/// How far curves with the same values lie from each other.
const APART: f64 = 2.0;

/// More labelled decades than this, and every second or third is labelled.
const LABELS: i32 = 7;

/// A logarithmic axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Axis {
    /// The powers of ten at its ends.
    low: f64,
    high: f64,
    /// Whether 0, and all below `low`, has a place of its own at the start.
    none: bool,
}

impl Axis {
    /// Around all values above zero, to the next whole decade; of one decade at the least.
    pub fn decades(values: impl IntoIterator<Item = f64>) -> Self {
        let (low, high) = powers(values);
        let low = low.floor();
        Self { low, high: high.ceil().max(low + 1.0), none: false }
    }

    /// Around all values above zero, a little more than they need.
    pub fn tight(values: impl IntoIterator<Item = f64>) -> Self {
        let (low, high) = powers(values);
        let room = 0.06 * (high - low).max(0.5);
        Self { low: low - room, high: high + room, none: false }
    }

    /// The axis with a place for 0.
    pub fn with_zero(self) -> Self {
        Self { none: true, ..self }
    }

    /// Where a value is, from 0 to 1.
    pub fn position(&self, value: f64) -> f64 {
        let start = if self.none { NONE } else { 0.0 };
        if value <= 0.0 || value.is_nan() {
            return if self.none { ZERO } else { 0.0 };
        }
        let part = (value.log10() - self.low) / (self.high - self.low);
        if self.none && part < 0.0 { ZERO } else { start + (1.0 - start) * part.clamp(0.0, 1.0) }
    }

    /// Positions and labels; a tick without a label has an empty one.
    fn ticks(&self) -> Vec<(f64, String)> {
        let decades = (self.low - 1e-9).ceil() as i32..=(self.high + 1e-9).floor() as i32;
        let count = decades.end() - decades.start();
        let every = (count + LABELS - 1) / LABELS;
        let mut ticks = Vec::new();
        if self.none {
            ticks.push((ZERO, "0".to_owned()));
        }
        for power in decades.start() - 1..=*decades.end() {
            let labelled = every <= 1 || (power - decades.end()).rem_euclid(every) == 0;
            for step in [1, 2, 5] {
                let value = f64::from(step) * 10f64.powi(power);
                let inside = (self.low - 1e-9..=self.high + 1e-9).contains(&value.log10());
                let label = match step {
                    1 if labelled => power_of_ten(power),
                    // In between there is room on short axes alone.
                    2 | 5 if self.high - self.low < 2.2 => plain(value),
                    _ => String::new(),
                };
                if inside && (step == 1 || !label.is_empty()) {
                    ticks.push((self.position(value), label));
                }
            }
        }
        ticks
    }
}

/// The least and the greatest power of ten; 0 and 1 when there is no value above zero.
fn powers(values: impl IntoIterator<Item = f64>) -> (f64, f64) {
    let logs = values.into_iter().filter(|v| *v > 0.0 && v.is_finite()).map(f64::log10);
    let (low, high) = logs.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), v| (a.min(v), b.max(v)));
    if low <= high { (low, high) } else { (0.0, 1.0) }
}

/// 1, 10, 100, and 10ⁿ beyond.
pub fn power_of_ten(power: i32) -> String {
    if (0..=3).contains(&power) {
        return plain(10f64.powi(power));
    }
    let superscript = |c: char| match c {
        '-' => '⁻',
        '1' => '¹',
        '2' => '²',
        '3' => '³',
        digit => char::from_u32('⁰' as u32 + digit as u32 - '0' as u32).unwrap_or(digit),
    };
    format!("10{}", power.to_string().chars().map(superscript).collect::<String>())
}

fn plain(value: f64) -> String {
    if value >= 1000.0 { format!("{},{:03}", value as u64 / 1000, value as u64 % 1000) } else { format!("{value}") }
}

/// A rectangle with two axes.
#[derive(Clone, Copy, Debug)]
pub struct Panel {
    /// Its left top corner.
    pub at: Place,
    /// Its width and height.
    pub size: Place,
    /// To the right.
    pub x: Axis,
    /// Upward.
    pub y: Axis,
}

impl Panel {
    /// Where a point is.
    pub fn place(&self, x: f64, y: f64) -> Place {
        let [left, top] = self.at;
        let [width, height] = self.size;
        [left + self.x.position(x) * width, top + (1.0 - self.y.position(y)) * height]
    }

    /// Draws grid, ticks and names; an empty name leaves that axis without labels, as another panel has them.
    pub fn draw(&self, canvas: &mut Canvas, x_name: &str, y_name: &str) {
        let ([left, top], [width, height]) = (self.at, self.size);
        let (right, bottom) = (left + width, top + height);
        if self.y.none {
            canvas.rect([left, bottom - 2.0 * ZERO * height], [right, bottom], FAINT);
        }
        if self.x.none {
            canvas.rect([left, top], [left + 2.0 * ZERO * width, bottom], FAINT);
        }
        for (part, label) in self.x.ticks() {
            let x = left + part * width;
            let strong = !label.is_empty();
            canvas.line(&[[x, top], [x, bottom]], if strong { GRID } else { FAINT }, 0.5);
            canvas.line(&[[x, bottom], [x, bottom + 4.0]], GREY, 0.5);
            if strong && !x_name.is_empty() {
                canvas.text([x, bottom + 15.0], Anchor::Middle, SMALL, &label);
            }
        }
        for (part, label) in self.y.ticks() {
            let y = bottom - part * height;
            let strong = !label.is_empty();
            canvas.line(&[[left, y], [right, y]], if strong { GRID } else { FAINT }, 0.5);
            canvas.line(&[[left - 4.0, y], [left, y]], GREY, 0.5);
            if strong {
                canvas.text([left - 8.0, y], Anchor::Right, SMALL, &label);
            }
        }
        canvas.line(&[[left, top], [left, bottom], [right, bottom]], INK, 0.5);
        if !x_name.is_empty() {
            canvas.text([left + width / 2.0, bottom + 35.0], Anchor::Middle, TEXT, x_name);
        }
        if !y_name.is_empty() {
            canvas.upward([left - 56.0, top + height / 2.0], TEXT, y_name);
        }
    }

    /// A panel for the lines of curve `i` of `count`, a little higher or lower than others', so that curves with the same
    /// values are seen side by side.
    pub fn beside(&self, i: usize, count: usize) -> Self {
        let [left, top] = self.at;
        Self { at: [left, top + APART * (i as f64 - (count as f64 - 1.0) / 2.0)], ..*self }
    }

    /// Connects points.
    pub fn line(&self, canvas: &mut Canvas, points: &[[f64; 2]], color: RGBColor, width: f64) {
        canvas.line(&self.places(points), color, width);
    }

    /// Connects points with dashes.
    pub fn dashed(&self, canvas: &mut Canvas, points: &[[f64; 2]], color: RGBColor, width: f64) {
        canvas.dashed(&self.places(points), color, width);
    }

    fn places(&self, points: &[[f64; 2]]) -> Vec<Place> {
        points.iter().map(|p| self.place(p[0], p[1])).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn positions_on_an_axis() {
        let axis = Axis::decades([2.0, 0.0, 700.0, f64::INFINITY]);
        assert_eq!([1.0, 10.0, 1000.0].map(|v| (axis.position(v) * 3.0 + 0.5) as i32), [0, 1, 3]);
        let axis = axis.with_zero();
        assert_eq!([0.0, -1.0, f64::NAN, 1e-9].map(|v| axis.position(v)), [ZERO; 4]);
        assert!((axis.position(1.0) - NONE).abs() < 1e-9 && axis.position(1e9) == 1.0);
        assert_eq!(Axis::decades([0.0]), Axis { low: 0.0, high: 1.0, none: false });
        assert_eq!(Axis::decades([100.0]), Axis { low: 2.0, high: 3.0, none: false });
    }

    #[test]
    fn decades_are_labelled_as_there_is_room() {
        let labels = |axis: Axis| axis.ticks().into_iter().map(|(_, label)| label).collect::<Vec<_>>().join(" ");
        assert_eq!(labels(Axis::decades([1.0, 100.0])), "1 2 5 10 20 50 100");
        assert_eq!(labels(Axis::decades([0.01, 1e4]).with_zero()), "0 10⁻² 10⁻¹ 1 10 100 1,000 10⁴");
        assert_eq!(labels(Axis::decades([1e-6, 1e6])), "10⁻⁶  10⁻⁴  10⁻²  1  100  10⁴  10⁶");
        assert_eq!(labels(Axis::tight([3.0, 30.0])), "5 10 20");
    }
}
