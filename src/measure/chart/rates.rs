//! The rates of a run as bars, a panel for each scene.

use super::canvas::{Anchor, Canvas, Font};
use super::scale::Scale;
use super::style::{GREY, HEADING, INK, Key, MARGIN, SMALL, TEXT, caption, color, legend, short, title};
use crate::measure::bench::{Measured, Report};
use crate::measure::lab::Machine;
use crate::measure::plain::plain;
use crate::measure::turns::NOISY;
use crate::render::Kernel;

const WIDTH: f64 = 900.0;

/// From one bar to the next, and from one query to the next.
const BAR: f64 = 15.0;
const GAP: f64 = 12.0;

/// Above and below the bars of a scene.
const ABOVE: f64 = 34.0;
const BELOW: f64 = 34.0;

/// Where the first scene begins, and what is left for the caption.
const TOP: f64 = 124.0;
const CAPTION: f64 = 62.0;

/// Where the bars begin, and what is left for the figures behind them.
const LEFT: f64 = 160.0;
const RIGHT: f64 = 130.0;

/// Draws the rates as an SVG.
pub fn rates(reports: &[Report], machine: &Machine) -> String {
    let height = TOP + CAPTION + reports.iter().map(|report| ABOVE + BELOW + tall(report)).sum::<f64>();
    Canvas::draw(WIDTH, height, |canvas| {
        title(canvas, "Rays a second", "Bars are the medians of the runs in 10⁶ rays a second; longer is faster.");
        let widths = Kernel::ALL.map(|kernel| (Key::Patch(color(kernel as usize)), kernel.name().to_owned()));
        legend(canvas, [MARGIN, 94.0], &widths);
        let mut top = TOP;
        for report in reports {
            panel(canvas, report, top + ABOVE);
            top += ABOVE + BELOW + tall(report);
        }
        let notes = ["A whisker is as wide as the spread of the runs; a spread of more than 10 % is noisy.".to_owned()];
        caption(canvas, height, &notes, machine);
    })
}

/// The height of a scene's bars.
fn tall(report: &Report) -> f64 {
    let queries = report.results.chunk_by(|a, b| a.query == b.query).count();
    BAR * report.results.len() as f64 + GAP * (queries + 1) as f64
}

fn panel(canvas: &mut Canvas, report: &Report, top: f64) {
    let Report { scene, size: [width, height], threads, .. } = report;
    let plural = if *threads == 1 { "thread" } else { "threads" };
    let heading = format!("{}, {width} × {height}, {threads} {plural}", plain(scene));
    canvas.text([MARGIN, top - 14.0], Anchor::Left, HEADING, &heading);
    let end = |row: &Measured| row.mrays_median * (1.0 + row.spread / 2.0);
    let high = report.results.iter().map(end).filter(|end| end.is_finite()).fold(1e-3, f64::max);
    let scale = Scale { left: LEFT, width: WIDTH - LEFT - RIGHT, low: 0.0, high };
    scale.draw(canvas, top, top + tall(report));
    let mut y = top + GAP;
    for rows in report.results.chunk_by(|a, b| a.query == b.query) {
        let middle = y + BAR * rows.len() as f64 / 2.0;
        canvas.text([LEFT - 10.0, middle], Anchor::Right, TEXT, &plain(&rows[0].query));
        for row in rows {
            bar(canvas, &scale, row, y);
            y += BAR;
        }
        y += GAP;
    }
}

fn bar(canvas: &mut Canvas, scale: &Scale, row: &Measured, y: f64) {
    let index = Kernel::ALL.iter().position(|kernel| kernel.name() == row.kernel).unwrap_or(0);
    canvas.rect([LEFT, y + 1.5], [scale.x(row.mrays_median), y + BAR - 1.5], color(index));
    let off = row.mrays_median * row.spread / 2.0;
    let ends = [row.mrays_median - off, row.mrays_median + off];
    scale.whisker(canvas, y + BAR / 2.0, ends, INK);
    let noisy = if row.spread > NOISY { " noisy" } else { "" };
    let figure = format!("{}{noisy}", short(row.mrays_median));
    let font = if noisy.is_empty() { Font { color: GREY, ..SMALL } } else { Font { color: INK, ..SMALL }.bold() };
    canvas.text([scale.x(ends[1]) + 8.0, y + BAR / 2.0], Anchor::Left, font, &figure);
}
