//! `speed-error`: what speed costs in accuracy.

use super::axis::{Axis, Panel};
use super::canvas::{Anchor, Canvas, Font, Marker, Place};
use super::job::{Chart, Context};
use super::style::{self, GREY, HEADING, INK, Key, MARGIN, TEXT, caption, color, legend, title};
use super::table::{Table, optional};
use crate::measure::cases::Subject;
use crate::measure::lab::{Machine, Point, SpeedOf, frontier, speed};
use crate::render::Kernel;

const WIDTH: f64 = 1440.0;
const HEIGHT: f64 = 888.0;

/// Beyond this no chart needs an error: t is off by all of itself.
const CEILING: f64 = 1e8;

pub fn draw(name: &str, context: &Context) -> Result<Chart, String> {
    let subjects = speed(context.budget, context.progress).map_err(|e| e.to_string())?;
    let sound = subjects.iter().all(|s| s.same);
    Ok(Chart { name: name.into(), svg: svg(&subjects, context.machine), table: table(&subjects), sound })
}

fn table(subjects: &[SpeedOf]) -> Table {
    let mut table = Table::new(&[
        "subject",
        "method",
        "width",
        "ns_per_ray",
        "ns_low",
        "ns_high",
        "turns",
        "rays_timed",
        "rays_judged",
        "hits",
        "t_ulps_median",
        "t_ulps_p999",
        "t_ulps_worst",
        "normal_degrees_p999",
        "wrong_per_million",
        "wrong",
        "wrong_unexcused",
        "frontier_t",
        "frontier_wrong",
    ]);
    for subject in subjects {
        let [t, wrong] = [0, 1].map(|row| frontier(&coordinates(subject, row)));
        for (i, p) in subject.points.iter().enumerate() {
            let Point { time, errors, .. } = p;
            table.push(&[
                &subject_name(subject.subject),
                &p.method.name,
                &p.kernel.name(),
                &time.median,
                &time.low,
                &time.high,
                &time.turns,
                &subject.timed,
                &errors.rays,
                &errors.hits,
                &errors.t.median,
                &errors.t.p999,
                &errors.t.worst,
                &errors.normal.p999,
                &errors.wrong_per_million(),
                &errors.wrong,
                &optional(errors.unexcused),
                &t.contains(&i),
                &wrong.contains(&i),
            ]);
        }
    }
    table
}

/// Speed, and an error: of t, or of decisions.
fn coordinates(subject: &SpeedOf, row: usize) -> Vec<[f64; 2]> {
    let error = |p: &Point| if row == 0 { p.errors.t.p999 } else { p.errors.wrong_per_million() };
    subject.points.iter().map(|p| [p.time.median, error(p)]).collect()
}

fn subject_name(subject: Subject) -> &'static str {
    match subject {
        Subject::Sphere => "sphere",
        Subject::Triangle => "triangle",
        _ => "torus",
    }
}

fn marker(kernel: Kernel) -> Marker {
    match kernel {
        Kernel::X1 => Marker::Circle,
        Kernel::X4 => Marker::Square,
        Kernel::X8 => Marker::Diamond,
    }
}

fn svg(subjects: &[SpeedOf], machine: &Machine) -> String {
    Canvas::draw(WIDTH, HEIGHT, |canvas| {
        title(
            canvas,
            "What speed costs in accuracy",
            "One primitive, seen from 2 to 1000 radii away. Left is faster, down is more accurate; what no other \
             method or width beats in both lies on the frontier.",
        );
        let mut entries: Vec<(Key, String)> = Kernel::ALL
            .iter()
            .map(|&k| (Key::Point(marker(k), GREY), format!("{} ({})", k.name(), lanes(k))))
            .collect();
        entries.push((Key::Dashed(INK, 1.5), "Pareto frontier".into()));
        let end = legend(canvas, [MARGIN, 92.0], &entries);
        let whiskers = "whiskers: up from the median ray to the 99.9th percentile; across, nine turns in ten";
        canvas.text([end + 6.0, 92.0], Anchor::Left, Font { color: GREY, ..TEXT }, whiskers);
        let column = (WIDTH - 2.0 * MARGIN) / subjects.len().max(1) as f64;
        let errors = subjects.iter().flat_map(|s| &s.points);
        let ulps = errors.clone().flat_map(|p| [p.errors.t.median, p.errors.t.p999]).map(|e| e.min(CEILING));
        let rows = [
            (Axis::decades(ulps), "error of t (steps of f32, ulps)"),
            (
                Axis::decades(errors.map(|p| p.errors.wrong_per_million())).with_zero(),
                "wrong hit or miss (per million rays)",
            ),
        ];
        for (i, subject) in subjects.iter().enumerate() {
            let left = MARGIN + column * i as f64 + 66.0;
            heading(canvas, left, subject);
            let x = Axis::tight(subject.points.iter().flat_map(|p| [p.time.low, p.time.high]));
            for (row, &(y, name)) in rows.iter().enumerate() {
                let at = [left, 172.0 + row as f64 * 330.0];
                if row == 0 && alike(subject) {
                    same_error(canvas, at, subject);
                    continue;
                }
                let panel = Panel { at, size: [column - 96.0, 280.0], x, y };
                panel.draw(canvas, if row == 1 { "time (ns per ray)" } else { " " }, if i == 0 { name } else { "" });
                points(canvas, &panel, subject, row);
            }
        }
        caption(canvas, HEIGHT, &notes(subjects), machine);
    })
}

/// Whether the errors of t of all methods are the same within a factor of two.
fn alike(subject: &SpeedOf) -> bool {
    let within = |error: fn(&Point) -> f64| {
        let (low, high) =
            subject.points.iter().map(error).fold((f64::INFINITY, 0.0), |(a, b): (f64, f64), e| (a.min(e), b.max(e)));
        high <= 2.0 * low
    };
    within(|p| p.errors.t.median) && within(|p| p.errors.t.p999)
}

/// What is said where the error of t tells no method from another.
fn same_error(canvas: &mut Canvas, [left, top]: Place, subject: &SpeedOf) {
    let Some(point) = subject.points.first() else { return };
    let [median, p999] = [point.errors.t.median, point.errors.t.p999].map(style::short);
    let lines = [
        "The error of t tells these methods from each other by less".to_owned(),
        format!("than a factor of two: median {median} ulps, 99.9th percentile {p999}."),
        "What they differ in is which rays they hit.".to_owned(),
    ];
    for (i, line) in lines.iter().enumerate() {
        canvas.text([left, top + 100.0 + 20.0 * i as f64], Anchor::Left, Font { color: GREY, ..TEXT }, line);
    }
}

fn lanes(kernel: Kernel) -> &'static str {
    match kernel {
        Kernel::X1 => "one ray at a time",
        Kernel::X4 => "four",
        Kernel::X8 => "eight",
    }
}

fn heading(canvas: &mut Canvas, left: f64, subject: &SpeedOf) {
    let name = match subject.subject {
        Subject::Sphere => "Sphere",
        Subject::Triangle => "Triangle",
        _ => "Torus",
    };
    canvas.text([left, 128.0], Anchor::Left, HEADING, name);
    let methods: Vec<_> = subject.points.iter().step_by(Kernel::ALL.len()).map(|p| p.method.name).collect();
    let entries: Vec<_> =
        methods.iter().enumerate().map(|(i, name)| (Key::Patch(color(i)), (*name).to_owned())).collect();
    legend(canvas, [left, 152.0], &entries);
}

fn points(canvas: &mut Canvas, panel: &Panel, subject: &SpeedOf, row: usize) {
    let all = coordinates(subject, row);
    let mut steps: Vec<[f64; 2]> = Vec::new();
    for &i in &frontier(&all) {
        if let Some(last) = steps.last().copied() {
            steps.push([all[i][0], last[1]]);
        }
        steps.push(all[i]);
    }
    let methods = subject.points.len() / Kernel::ALL.len();
    let panels: Vec<Panel> = (0..methods).map(|method| panel.beside(method, methods)).collect();
    for (method, widths) in all.chunks(Kernel::ALL.len()).enumerate() {
        panels[method].line(canvas, widths, color(method), 1.0);
    }
    for (i, (p, &[x, y])) in subject.points.iter().zip(&all).enumerate() {
        let (panel, color) = (panels[i / Kernel::ALL.len()], color(i / Kernel::ALL.len()));
        panel.line(canvas, &[[p.time.low, y], [p.time.high, y]], color, 1.0);
        if row == 0 {
            panel.line(canvas, &[[x, p.errors.t.median], [x, y]], color, 1.0);
            let [px, py] = panel.place(x, p.errors.t.median);
            canvas.line(&[[px - 4.0, py], [px + 4.0, py]], color, 1.0);
        }
    }
    panel.dashed(canvas, &steps, INK, 1.5);
    for (i, (p, &[x, y])) in subject.points.iter().zip(&all).enumerate() {
        let method = i / Kernel::ALL.len();
        canvas.marker(panels[method].place(x, y), marker(p.kernel), 5.0, color(method));
    }
}

fn notes(subjects: &[SpeedOf]) -> Vec<String> {
    let Some(first) = subjects.first() else { return Vec::new() };
    let point = first.points.first();
    let (turns, judged) = point.map_or((0, 0), |p| (p.time.turns, p.errors.rays));
    let hits = |s: &SpeedOf| {
        format!("{} {}", subject_name(s.subject), style::thousands(s.points.first().map_or(0, |p| p.errors.hits)))
    };
    let hits: Vec<_> = subjects.iter().map(hits).collect();
    let same = if subjects.iter().all(|s| s.same) { "gave the same bits" } else { "DISAGREED" };
    vec![
        format!(
            "Timed: {} rays, one thread, from the batch's bounds to the stored answer; median of {turns} alternating \
             turns. All widths of a method {same}, so errors are the method's.",
            style::thousands(first.timed),
        ),
        format!(
            "Judged by exact arithmetic: {} rays each; percentiles of t over those that hit ({}).",
            style::thousands(judged),
            hits.join(", "),
        ),
    ]
}
