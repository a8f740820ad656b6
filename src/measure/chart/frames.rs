//! `frames`: the time of whole frames against their error.

use plotters::prelude::RGBColor;

use super::axis::{Axis, Panel};
use super::canvas::{Anchor, Canvas, Marker, Place};
use super::job::{Chart, Context};
use super::style::{HEADING, Key, MARGIN, SMALL, TEXT, caption, color, legend, short, title};
use super::table::Table;
use crate::measure::lab::{Frame, FramesOf, Machine, PLANNED, frames};
use crate::render::{Kernel, Samples};

const WIDTH: f64 = 1440.0;

/// Where the lines of methods start, how high one is, and the room for its name and for a value behind a bar.
const METHODS: f64 = 500.0;
const LINE: f64 = 22.0;
const NAME: f64 = 180.0;
const VALUE: f64 = 54.0;

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
        "rays",
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
                &samples_of(f.samples),
                &f.rays,
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

/// As `--samples` takes it.
fn samples_of(samples: Samples) -> String {
    match samples {
        Samples::Grid(n) => n.to_string(),
        Samples::Adaptive(codes) => format!("adaptive:{codes}"),
    }
}

/// Of adaptive samples.
const ADAPTIVE: (Marker, usize) = (Marker::Circle, 4);

fn color_of(kernel: Kernel) -> RGBColor {
    color(kernel as usize)
}

fn marker(kernel: Kernel) -> Marker {
    match kernel {
        Kernel::X1 => Marker::Circle,
        Kernel::X4 => Marker::Square,
        Kernel::X8 => Marker::Diamond,
    }
}

fn svg(scenes: &[FramesOf], context: &Context) -> String {
    let machine: &Machine = context.machine;
    let most = scenes.iter().map(|s| methods(s).count()).max().unwrap_or(0) as f64;
    let height = METHODS + LINE * most + 90.0;
    Canvas::draw(WIDTH, height, |canvas| {
        title(
            canvas,
            "Whole frames: time against error",
            "Above: 1, 4 and 9 samples a pixel by the planned methods, at the widest 16 too, and adaptive ones, against \
             the converged picture. Below: one method changed, and the share of pixels that it moves by more than 1/255.",
        );
        let mut widths: Vec<_> =
            Kernel::ALL.iter().map(|&k| (Key::Point(marker(k), color_of(k)), k.name().to_owned())).collect();
        widths
            .push((Key::Point(ADAPTIVE.0, color(ADAPTIVE.1)), "x8, adaptive: 20, 5 and 1 codes may differ".to_owned()));
        legend(canvas, [MARGIN, 92.0], &widths);
        let column = (WIDTH - 2.0 * MARGIN) / scenes.len().max(1) as f64;
        for (i, scene) in scenes.iter().enumerate() {
            let left = MARGIN + column * i as f64 + 66.0;
            canvas.text([left, 128.0], Anchor::Left, HEADING, scene.scene);
            samples(canvas, [left, 144.0], column - 96.0, scene, i == 0);
            compared(canvas, [left - 66.0, METHODS], column - 30.0, scene);
        }
        caption(canvas, height, &notes(scenes, context), machine);
    })
}

/// The planned methods: a line a width, from few samples to many.
fn samples(canvas: &mut Canvas, at: Place, width: f64, scene: &FramesOf, first: bool) {
    let planned = || scene.frames.iter().filter(|f| f.method == PLANNED);
    let x = Axis::tight(planned().flat_map(|f| [f.time.low, f.time.high]));
    let y = Axis::tight(planned().map(|f| f.error.rms));
    let panel = Panel { at, size: [width, 250.0], x, y };
    panel.draw(canvas, "time (ms per frame)", if first { "root mean square error (1/255)" } else { "" });
    let mut draw = |places: Vec<[f64; 2]>, marker: Marker, color: RGBColor| {
        panel.line(canvas, &places, color, 1.5);
        for place in places {
            canvas.marker(panel.place(place[0], place[1]), marker, 5.0, color);
        }
    };
    let place = |f: &Frame| [f.time.median, f.error.rms];
    let is_grid = |f: &&Frame| matches!(f.samples, Samples::Grid(_));
    for kernel in Kernel::ALL {
        let places = planned().filter(is_grid).filter(|f| f.kernel == kernel).map(place).collect();
        draw(places, marker(kernel), color_of(kernel));
    }
    draw(planned().filter(|f| !is_grid(f)).map(place).collect(), ADAPTIVE.0, color(ADAPTIVE.1));
}

/// The frames with one sample a pixel at the widest: the plan's, and those of other methods.
fn methods(scene: &FramesOf) -> impl Iterator<Item = &Frame> {
    scene.frames.iter().filter(|f| f.samples == Samples::Grid(1) && f.kernel == Kernel::default())
}

/// A line a method: its name, how long a frame takes, and how far its picture is from the plan's.
fn compared(canvas: &mut Canvas, [left, top]: Place, width: f64, scene: &FramesOf) {
    let bar = (width - NAME) / 2.0 - VALUE;
    let longest = methods(scene).map(|f| f.time.median).fold(0.0, f64::max);
    let pixels = Axis::decades([0.001, 100.0]).with_zero();
    let columns = [left + NAME, left + NAME + bar + VALUE];
    for (x, head) in columns.into_iter().zip(["ms per frame", "pixels moved (%)"]) {
        canvas.text([x, top - 20.0], Anchor::Left, SMALL, head);
    }
    for (i, frame) in methods(scene).enumerate() {
        let y = top + LINE * i as f64;
        canvas.text([left + NAME - 8.0, y], Anchor::Right, TEXT, &frame.method);
        let moved = frame.apart.off * 100.0;
        let shares = [frame.time.median / longest, if moved > 0.0 { pixels.position(moved) } else { 0.0 }];
        let values = [short(frame.time.median), if moved > 0.0 { percent(moved) } else { "0".into() }];
        let color = color(usize::from(frame.method != PLANNED));
        for ((x, share), value) in columns.into_iter().zip(shares).zip(values) {
            canvas.rect([x, y - 6.0], [x + (bar * share).max(1.0), y + 6.0], color);
            canvas.text([x + bar * share + 6.0, y], Anchor::Left, SMALL, &value);
        }
    }
}

fn percent(value: f64) -> String {
    if value < 0.1 { format!("{value:.3}") } else { format!("{value:.1}") }
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
