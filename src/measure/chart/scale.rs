//! A linear axis along the canvas, for bars and ratios.

use super::canvas::{Anchor, Canvas};
use super::style::{GREY, GRID, SMALL};

/// About so many ticks.
const TICKS: f64 = 8.0;

/// Values from `low` to `high`, drawn from `left` over `width` pixels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Scale {
    /// Where `low` is.
    pub left: f64,
    /// How far it is to `high`.
    pub width: f64,
    /// The least value.
    pub low: f64,
    /// The greatest; more than `low`.
    pub high: f64,
}

impl Scale {
    /// Where a value is.
    pub fn x(&self, value: f64) -> f64 {
        self.left + self.width * ((value - self.low) / (self.high - self.low)).clamp(0.0, 1.0)
    }

    /// Round values, and how many digits they have behind the point.
    fn ticks(&self) -> (Vec<f64>, usize) {
        let rough = (self.high - self.low) / TICKS;
        let power = rough.log10().floor();
        let step = [1.0, 2.0, 5.0, 10.0].map(|n| n * 10f64.powf(power)).into_iter().find(|step| *step >= rough);
        let step = step.unwrap_or(rough);
        let digits = (-step.log10().floor()).clamp(0.0, 9.0) as usize;
        let first = (self.low / step - 1e-9).ceil();
        let count = ((self.high / step + 1e-9).floor() - first).clamp(0.0, 4.0 * TICKS) as usize;
        ((0..=count).map(|i| (first + i as f64) * step).collect(), digits)
    }

    /// Draws the grid from `top` to `bottom`, with labels below.
    pub fn draw(&self, canvas: &mut Canvas, top: f64, bottom: f64) {
        let (ticks, digits) = self.ticks();
        for value in ticks {
            let x = self.x(value);
            canvas.line(&[[x, top], [x, bottom]], GRID, 0.5);
            canvas.text([x, bottom + 12.0], Anchor::Middle, SMALL, &format!("{value:.digits$}"));
        }
        canvas.line(&[[self.left, bottom], [self.left + self.width, bottom]], GREY, 0.5);
    }

    /// A line from one value to another with an end at each.
    pub fn whisker(&self, canvas: &mut Canvas, y: f64, [from, to]: [f64; 2], color: plotters::prelude::RGBColor) {
        let ends = [from, to].map(|value| self.x(value));
        canvas.line(&ends.map(|x| [x, y]), color, 1.0);
        for x in ends {
            canvas.line(&[[x, y - 3.0], [x, y + 3.0]], color, 1.0);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_and_ticks() {
        let scale = Scale { left: 100.0, width: 50.0, low: 0.0, high: 400.0 };
        assert_eq!([-1.0, 0.0, 200.0, 500.0].map(|v| scale.x(v)), [100.0, 100.0, 125.0, 150.0]);
        assert_eq!(scale.ticks(), ((0..=8).map(|i| 50.0 * f64::from(i)).collect(), 0));
        let (ticks, digits) = Scale { low: 0.88, high: 1.13, ..scale }.ticks();
        let labels: Vec<String> = ticks.iter().map(|tick| format!("{tick:.digits$}")).collect();
        assert_eq!(labels, ["0.90", "0.95", "1.00", "1.05", "1.10"]);
    }
}
