//! A run against an earlier one, as ratios with their ranges.

use plotters::prelude::RGBColor;

use super::canvas::{Anchor, Canvas, Font, Marker};
use super::scale::Scale;
use super::style::{COLORS, GREY, INK, Key, MARGIN, TEXT, caption, legend, title};
use crate::measure::against::{Comparison, Pair, Verdict};
use crate::measure::lab::Machine;

const WIDTH: f64 = 900.0;

/// From one row to the next.
const ROW: f64 = 20.0;

/// Where the rows begin, and what is left for the axis and the caption.
const TOP: f64 = 118.0;
const BELOW: f64 = 80.0;

/// Where the axis begins, and what is left for the figures behind it.
const LEFT: f64 = 280.0;
const RIGHT: f64 = 160.0;

/// Draws the ratios as an SVG.
pub fn ratios(comparison: &Comparison, machine: &Machine) -> String {
    let Comparison { built: [commit, date], warnings, pairs, .. } = comparison;
    let bottom = TOP + ROW * (pairs.len() + 1) as f64;
    let height = bottom + BELOW + 17.0 * warnings.len() as f64;
    Canvas::draw(WIDTH, height, |canvas| {
        let about = format!("Rates by those of commit {commit} of {date}; to the right is faster than before.");
        title(canvas, "Against an earlier run", &about);
        let verdicts = [Verdict::Faster, Verdict::Slower, Verdict::WithinNoise];
        let keys = verdicts.map(|verdict| (Key::Point(Marker::Circle, look(verdict)), verdict.name().to_owned()));
        legend(canvas, [MARGIN, 94.0], &keys);
        let ends = || pairs.iter().flat_map(|pair| pair.range).filter(|end| end.is_finite());
        let (low, high) = (ends().fold(0.9, f64::min), ends().fold(1.1, f64::max));
        let scale = Scale { left: LEFT, width: WIDTH - LEFT - RIGHT, low, high };
        scale.draw(canvas, TOP, bottom);
        canvas.line(&[[scale.x(1.0), TOP], [scale.x(1.0), bottom]], INK, 1.0);
        for (i, pair) in pairs.iter().enumerate() {
            row(canvas, &scale, pair, TOP + ROW * (i + 1) as f64);
        }
        let whiskers = "A whisker is where the ratio lies as far as the spreads of both runs tell.".to_owned();
        let notes: Vec<String> = warnings.iter().cloned().chain([whiskers]).collect();
        caption(canvas, height, &notes, machine);
    })
}

/// Blue and orange are told apart by everybody.
fn look(verdict: Verdict) -> RGBColor {
    match verdict {
        Verdict::Faster => COLORS[0],
        Verdict::Slower => COLORS[1],
        Verdict::WithinNoise => GREY,
    }
}

fn row(canvas: &mut Canvas, scale: &Scale, pair: &Pair, y: f64) {
    let color = look(pair.verdict);
    canvas.text([LEFT - 12.0, y], Anchor::Right, TEXT, &pair.key.join("  "));
    scale.whisker(canvas, y, pair.range, color);
    canvas.marker([scale.x(pair.ratio), y], Marker::Circle, 4.0, color);
    let figure = format!("{:.3}  {}", pair.ratio, pair.verdict.name());
    canvas.text([WIDTH - RIGHT + 14.0, y], Anchor::Left, Font { color, ..TEXT }, &figure);
}
