//! `frames`: the time of whole frames against their error.

use super::axis::{Axis, Panel};
use super::canvas::{Anchor, Canvas, Marker};
use super::job::{Chart, Context};
use super::style::{GREY, HEADING, INK, Key, MARGIN, caption, color, legend, title};
use super::table::Table;
use crate::measure::lab::{Frame, FramesOf, Machine, frames, frontier};
use crate::render::Kernel;

const WIDTH: f64 = 1440.0;
const HEIGHT: f64 = 904.0;

pub fn draw(name: &str, context: &Context) -> Result<Chart, String> {
    let scenes = frames(context.budget, context.progress)?;
    let sound = scenes.iter().all(|s| s.same);
    Ok(Chart { name: name.into(), svg: svg(&scenes, context), table: table(&scenes), sound })
}

fn table(scenes: &[FramesOf]) -> Table {
    let mut table = Table::new(&[
        "scene",
        "method",
        "width",
        "samples",
        "ms_per_frame",
        "ms_low",
        "ms_high",
        "turns",
        "pixels_off_percent",
        "rms_255",
        "pixels_apart_from_planned_percent",
        "rms_from_planned_255",
    ]);
    for FramesOf { scene, frames, .. } in scenes {
        for f in frames {
            table.push(&[
                scene,
                &f.method,
                &f.kernel.name(),
                &(f.samples * f.samples),
                &f.time.median,
                &f.time.low,
                &f.time.high,
                &f.time.turns,
                &(f.error.off * 100.0),
                &f.error.rms,
                &(f.apart.off * 100.0),
                &f.apart.rms,
            ]);
        }
    }
    table
}

fn marker(kernel: Kernel) -> Marker {
    match kernel {
        Kernel::X1 => Marker::Circle,
        Kernel::X4 => Marker::Square,
        Kernel::X8 => Marker::Diamond,
    }
}

/// All methods of all scenes, each once.
fn method_names(scenes: &[FramesOf]) -> Vec<&str> {
    let mut names: Vec<&str> = Vec::new();
    for frame in scenes.iter().flat_map(|s| &s.frames) {
        if !names.contains(&&*frame.method) {
            names.push(&frame.method);
        }
    }
    names
}

/// A row of panels: its name, and what it shows of a frame.
type Row = (&'static str, fn(&Frame) -> f64);

const ROWS: [Row; 2] = [
    ("pixels off by more than 1/255 (%)", |f| f.error.off * 100.0),
    ("root mean square error (1/255)", |f| f.error.rms),
];

fn svg(scenes: &[FramesOf], context: &Context) -> String {
    let machine: &Machine = context.machine;
    Canvas::draw(WIDTH, HEIGHT, |canvas| {
        title(
            canvas,
            "Whole frames: time against error",
            "1, 4 and 9 samples a pixel, from left to right along each line; the error is against the converged \
             picture of the planned methods.",
        );
        let names = method_names(scenes);
        let mut entries: Vec<_> =
            Kernel::ALL.iter().map(|&k| (Key::Point(marker(k), GREY), k.name().to_owned())).collect();
        entries.push((Key::Dashed(INK, 1.5), "Pareto frontier".into()));
        legend(canvas, [MARGIN, 88.0], &entries);
        let entries: Vec<_> = names.iter().enumerate().map(|(i, n)| (Key::Patch(color(i)), (*n).to_owned())).collect();
        for (row, entries) in entries.chunks(6).enumerate() {
            legend(canvas, [MARGIN, 112.0 + 22.0 * row as f64], entries);
        }
        let column = (WIDTH - 2.0 * MARGIN) / scenes.len().max(1) as f64;
        for (i, scene) in scenes.iter().enumerate() {
            let left = MARGIN + column * i as f64 + 66.0;
            canvas.text([left, 160.0], Anchor::Left, HEADING, scene.scene);
            let x = Axis::tight(scene.frames.iter().flat_map(|f| [f.time.low, f.time.high]));
            for (row, (name, error)) in ROWS.into_iter().enumerate() {
                let y = Axis::tight(scene.frames.iter().map(error));
                let at = [left, 174.0 + row as f64 * 345.0];
                let panel = Panel { at, size: [column - 96.0, 295.0], x, y };
                panel.draw(canvas, if row == 1 { "time (ms per frame)" } else { " " }, if i == 0 { name } else { "" });
                points(canvas, &panel, scene, &names, error);
            }
        }
        caption(canvas, HEIGHT, &notes(scenes, context), machine);
    })
}

fn points(canvas: &mut Canvas, panel: &Panel, scene: &FramesOf, names: &[&str], error: fn(&Frame) -> f64) {
    let color_of = |f: &Frame| color(names.iter().position(|n| *n == f.method).unwrap_or(0));
    let all: Vec<[f64; 2]> = scene.frames.iter().map(|f| [f.time.median, error(f)]).collect();
    let samples = scene.frames.iter().map(|f| f.samples).max().unwrap_or(1) as usize;
    // The plan comes last, over all others.
    for (frames, places) in scene.frames.chunks(samples).zip(all.chunks(samples)).rev() {
        panel.line(canvas, places, color_of(&frames[0]), 1.0);
    }
    let mut steps: Vec<[f64; 2]> = Vec::new();
    for &i in &frontier(&all) {
        if let Some(last) = steps.last().copied() {
            steps.push([all[i][0], last[1]]);
        }
        steps.push(all[i]);
    }
    panel.dashed(canvas, &steps, INK, 1.5);
    for (frame, place) in scene.frames.iter().zip(&all).rev() {
        canvas.marker(panel.place(place[0], place[1]), marker(frame.kernel), 4.5, color_of(frame));
    }
}

fn notes(scenes: &[FramesOf], context: &Context) -> Vec<String> {
    let [width, height] = context.budget.frame;
    let turns = scenes.first().and_then(|s| s.frames.first()).map_or(0, |f| f.time.turns);
    let n = context.budget.converged;
    let same = if scenes.iter().all(|s| s.same) { "gave the same bits" } else { "DISAGREED" };
    vec![format!(
        "{width} × {height} pixels, median of {turns} alternating turns; converged: {n} × {n} samples a pixel. Colours \
         are compared on the sRGB curve in 8 bits. All widths {same}.",
    )]
}
