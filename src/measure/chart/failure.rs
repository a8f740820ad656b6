//! `failure-…`: how methods fail along a case's dial.

use super::axis::{Axis, Panel};
use super::canvas::{Anchor, Canvas};
use super::job::{Chart, Context};
use super::style::{self, HEADING, Key, MARGIN, SMALL, caption, color, legend, title, wrapped};
use super::table::{Table, optional};
use crate::measure::cases::Subject;
use crate::measure::lab::{CaseFailure, Curve, Machine, failures};

const CELL: [f64; 2] = [470.0, 470.0];
const TOP: f64 = 120.0;
const BOTTOM: f64 = 92.0;

/// Why nobody can be right in the cases of rays that leave.
const LEAVING: &str = "…-leaving: no f32 lies on the surface, so the exact start is a rounding off it, on either side, \
                       and the exact answer is a hit at once or none. Renderers start such rays off the surface: see the \
                       chart `epsilon`.";

/// Of a curve.
const WIDTH: f64 = 1.5;

/// Beyond this no chart needs an error: t is off by all of itself.
const CEILING: f64 = 1e8;

pub fn draw(name: &str, context: &Context) -> Result<Chart, String> {
    let (heading, wanted): (_, fn(Subject) -> bool) = match name {
        "failure-sphere" => ("How the tests of a sphere fail", |s| s == Subject::Sphere),
        "failure-triangle" => ("How the tests of a triangle fail", |s| s == Subject::Triangle),
        "failure-torus" => ("How the tests of a torus fail", |s| s == Subject::Torus),
        _ => ("How the tests of the other primitives hold", |s| {
            !matches!(s, Subject::Sphere | Subject::Triangle | Subject::Torus)
        }),
    };
    let cases = failures(wanted, context.budget, context.progress).map_err(|e| e.to_string())?;
    let svg = svg(heading, &cases, context.machine);
    Ok(Chart { name: name.into(), svg, table: table(&cases), sound: true })
}

fn table(cases: &[CaseFailure]) -> Table {
    let mut table = Table::new(&[
        "case",
        "dial",
        "unit",
        "setting",
        "method",
        "rays",
        "hits",
        "wrong",
        "wrong_unexcused",
        "wrong_per_million",
        "t_ulps_median",
        "t_ulps_p999",
        "t_ulps_worst",
        "normal_degrees_median",
        "normal_degrees_p999",
    ]);
    for CaseFailure { case, curves } in cases {
        for Curve { method, points } in curves {
            for (setting, e) in points {
                table.push(&[
                    &case.name,
                    &case.dial.meaning,
                    &case.dial.unit,
                    setting,
                    &method.name,
                    &e.rays,
                    &e.hits,
                    &e.wrong,
                    &optional(e.unexcused),
                    &e.wrong_per_million(),
                    &e.t.median,
                    &e.t.p999,
                    &e.t.worst,
                    &e.normal.median,
                    &e.normal.p999,
                ]);
            }
        }
    }
    table
}

fn svg(heading: &str, cases: &[CaseFailure], machine: &Machine) -> String {
    let columns = if cases.len() > 6 { 4 } else { 3 };
    let rows = cases.len().div_ceil(columns);
    let width = CELL[0] * columns as f64 + MARGIN;
    let height = TOP + CELL[1] * rows as f64 + BOTTOM;
    Canvas::draw(width, height, |canvas| {
        title(
            canvas,
            heading,
            "Every case has one dial that makes it harder; each curve is a method, judged by exact arithmetic.",
        );
        let curves = cases.first().map(|c| &*c.curves).unwrap_or_default();
        let mut entries: Vec<_> =
            curves.iter().enumerate().map(|(i, c)| (Key::Line(color(i), WIDTH), c.method.name.to_owned())).collect();
        if entries.len() > 1 {
            entries[0].1 += " (the default)";
        }
        entries.push((Key::Dashed(style::GREY, 1.0), "median of t's error".into()));
        entries.push((Key::Line(style::GREY, WIDTH), "99.9th percentile".into()));
        legend(canvas, [MARGIN, 92.0], &entries);
        let ulps = all(cases).flat_map(|e| [e.t.median, e.t.p999].map(|e| e.clamp(0.1, CEILING)));
        let y = [Axis::decades(ulps), Axis::decades(all(cases).map(|e| e.wrong_per_million())).with_zero()];
        for (i, case) in cases.iter().enumerate() {
            let at = [MARGIN + CELL[0] * (i % columns) as f64, TOP + CELL[1] * (i / columns) as f64];
            cell(canvas, at, case, y);
        }
        let rays = all(cases).next().map_or(0, |e| e.rays);
        let mut notes = vec![
            format!(
                "{} rays at every setting, from four poses of the primitive. A wrong decision is a hit where exact \
                 arithmetic says miss, or a miss where it says hit; one is {:.0} in a million, and 0 means none was seen.",
                style::thousands(rays),
                1e6 / rays.max(1) as f64,
            ),
            "Errors of t are of rays that hit, by the method and in truth. Curves with the same values are drawn side by \
             side."
                .to_owned(),
        ];
        if cases.iter().any(|c| c.case.name.ends_with("-leaving")) {
            notes.push(LEAVING.to_owned());
        }
        caption(canvas, height, &notes, machine);
    })
}

/// All errors of all curves.
fn all(cases: &[CaseFailure]) -> impl Iterator<Item = &crate::measure::lab::Errors> + Clone {
    cases.iter().flat_map(|c| &c.curves).flat_map(|c| &c.points).map(|(_, errors)| errors)
}

/// Above, wrong decisions; below, errors of t.
fn cell(
    canvas: &mut Canvas,
    [left, top]: [f64; 2],
    CaseFailure { case, curves }: &CaseFailure,
    [ulps, wrong]: [Axis; 2],
) {
    let (left, width) = (left + 66.0, CELL[0] - 100.0);
    canvas.text([left, top + 14.0], Anchor::Left, HEADING, case.name);
    for (i, line) in wrapped(case.about, 68).iter().take(3).enumerate() {
        canvas.text([left, top + 36.0 + 15.0 * i as f64], Anchor::Left, SMALL, line);
    }
    let x = Axis::decades(curves.iter().flat_map(|c| &c.points).map(|p| p.0));
    let upper = Panel { at: [left, top + 88.0], size: [width, 150.0], x, y: wrong };
    let lower = Panel { at: [left, top + 262.0], size: [width, 150.0], x, y: ulps };
    upper.draw(canvas, "", "wrong decisions / million");
    lower.draw(canvas, &format!("{} ({})", case.dial.meaning, case.dial.unit), "error of t (ulps)");
    for (i, Curve { points, .. }) in curves.iter().enumerate() {
        let of = |error: fn(&crate::measure::lab::Errors) -> f64| -> Vec<[f64; 2]> {
            points.iter().map(|(setting, errors)| [*setting, error(errors)]).collect()
        };
        let judged: Vec<_> = points.iter().filter(|(_, e)| e.hits > 0).collect();
        let quantile = |q: fn(&crate::measure::lab::Errors) -> f64| -> Vec<[f64; 2]> {
            judged.iter().map(|(setting, e)| [*setting, q(e).max(0.1)]).collect()
        };
        let [upper, lower] = [upper, lower].map(|panel| panel.beside(i, curves.len()));
        upper.line(canvas, &of(|e| e.wrong_per_million()), color(i), WIDTH);
        lower.dashed(canvas, &quantile(|e| e.t.median), color(i), 1.0);
        lower.line(canvas, &quantile(|e| e.t.p999), color(i), WIDTH);
    }
}
