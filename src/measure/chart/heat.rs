//! `heat-…`: errors over the screen.

use plotters::prelude::RGBColor;

use super::axis::power_of_ten;
use super::canvas::{Anchor, Canvas};
use super::job::{Chart, Context};
use super::style::{self, GREY, HEADING, INK, Key, MARGIN, SMALL, TEXT, caption, legend, title};
use super::table::Table;
use crate::measure::lab::{Cell, Heat, HeatMap, Machine, heat};

/// A pixel's edge.
const PIXEL: f64 = 4.0;

/// Room above a map.
const HEAD: f64 = 66.0;

/// How far a rectangle reaches below its neighbours, so that no seam shows between them.
const SEAM: f64 = 0.5;

/// Steps of the scale.
const STEPS: usize = 20;

/// Powers of ten at the ends of the scale for [`crate::measure::lab::ulps`].
const ULPS: [f64; 2] = [-1.0, 5.0];

const SKY: RGBColor = RGBColor(226, 226, 226);
const LOST: RGBColor = RGBColor(230, 0, 110);
const INVENTED: RGBColor = RGBColor(60, 200, 255);

/// From no error to the greatest: dark to light, even for the colour-blind and in grey (the ends and middles of cividis,
/// Nuñez, Anderton, Renslow, *Optimizing colormaps with consideration for color vision deficiency*, 2018).
const SCALE: [[f64; 3]; 5] =
    [[0.0, 32.0, 76.0], [66.0, 77.0, 107.0], [124.0, 123.0, 120.0], [188.0, 174.0, 108.0], [255.0, 234.0, 70.0]];

pub fn draw(name: &str, context: &Context) -> Result<Chart, String> {
    let which = name.trim_start_matches("heat-");
    let heat = heat(which, context.budget).map_err(|e| e.to_string())?.ok_or(format!("no heat map {which}"))?;
    (context.progress)(1.0);
    Ok(Chart { name: name.into(), svg: svg(&heat, context.machine), table: table(&heat), sound: true })
}

/// A pixel a row, a method a column: the error of a hit, or what else became of the ray.
fn table(heat: &Heat) -> Table {
    let unit = if heat.shares { "share_that_meets_own_surface" } else { "t_ulps" };
    let columns: Vec<String> = heat.maps.iter().map(|map| format!("{}_{unit}", map.method)).collect();
    let head: Vec<&str> = ["x", "y"].into_iter().chain(columns.iter().map(|c| &**c)).collect();
    let mut table = Table::new(&head);
    for i in 0..heat.size[0] * heat.size[1] {
        let cells = heat.maps.iter().map(|map| match map.cells[i] {
            Cell::Miss => "miss".to_owned(),
            Cell::Error(error) if heat.shares => error.to_string(),
            Cell::Error(error) => format!("{error:.3}"),
            Cell::Lost => "lost".to_owned(),
            Cell::Invented => "invented".to_owned(),
        });
        let place = [i % heat.size[0], i / heat.size[0]].map(|n| n.to_string());
        table.push_cells(place.into_iter().chain(cells).collect());
    }
    table
}

/// A colour of the scale, from 0 to 1, in steps, so that neighbours are drawn as one.
fn scale(part: f64) -> RGBColor {
    let part = (part.clamp(0.0, 1.0) * STEPS as f64).round() / STEPS as f64 * (SCALE.len() - 1) as f64;
    let i = (part as usize).min(SCALE.len() - 2);
    let [r, g, b] = [0, 1, 2].map(|c| (SCALE[i][c] + (SCALE[i + 1][c] - SCALE[i][c]) * (part - i as f64)) as u8);
    RGBColor(r, g, b)
}

fn color(cell: Cell, shares: bool) -> RGBColor {
    match cell {
        Cell::Miss => SKY,
        Cell::Lost => LOST,
        Cell::Invented => INVENTED,
        Cell::Error(share) if shares => scale(share),
        Cell::Error(ulps) => scale((ulps.max(1e-9).log10() - ULPS[0]) / (ULPS[1] - ULPS[0])),
    }
}

fn svg(heat: &Heat, machine: &Machine) -> String {
    let [map_width, map_height] = heat.size.map(|n| n as f64 * PIXEL);
    let columns = if heat.maps.len() == 4 { 2 } else { heat.maps.len().clamp(1, 3) };
    let width = (MARGIN + (map_width + MARGIN) * columns as f64).max(960.0);
    let bottom = 84.0 + (map_height + HEAD) * heat.maps.len().div_ceil(columns) as f64;
    let height = bottom + 116.0;
    Canvas::draw(width, height, |canvas| {
        title(canvas, heat.what.title, heat.what.about);
        for (i, map) in heat.maps.iter().enumerate() {
            let [column, row] = [i % columns, i / columns].map(|n| n as f64);
            let at = [MARGIN + (map_width + MARGIN) * column, 84.0 + (map_height + HEAD) * row + HEAD - 10.0];
            let default = if i + 1 == heat.maps.len() { " (the default)" } else { "" };
            canvas.text([at[0], at[1] - 38.0], Anchor::Left, HEADING, &format!("{}{default}", map.method));
            canvas.text([at[0], at[1] - 16.0], Anchor::Left, SMALL, &summary(map));
            cells(canvas, at, heat, map);
            canvas.frame(at, [at[0] + map_width, at[1] + map_height], GREY, 0.5);
        }
        key(canvas, bottom + 34.0, heat);
        let [w, h] = heat.size;
        let note = match heat.shares {
            true => format!("{w} × {h} pixels, 32 rays in all directions above the surface of each."),
            false => format!("{w} × {h} pixels, a ray through the middle of each, judged by exact arithmetic."),
        };
        caption(canvas, height, &[note], machine);
    })
}

/// Pixels of one colour in a row are one rectangle.
fn cells(canvas: &mut Canvas, [left, top]: [f64; 2], heat: &Heat, map: &HeatMap) {
    let [width, height] = heat.size.map(|n| n as f64 * PIXEL);
    canvas.rect([left, top], [left + width, top + height], SKY);
    for (y, row) in map.cells.chunks(heat.size[0]).enumerate() {
        let colors: Vec<RGBColor> = row.iter().map(|&cell| color(cell, heat.shares)).collect();
        let mut x = 0;
        for run in colors.chunk_by(|a, b| a == b) {
            let from = [x as f64 * PIXEL, y as f64 * PIXEL];
            x += run.len();
            if run[0] != SKY {
                let to = [(x as f64 * PIXEL + SEAM).min(width), (from[1] + PIXEL + SEAM).min(height)];
                canvas.rect([left + from[0], top + from[1]], [left + to[0], top + to[1]], run[0]);
            }
        }
    }
}

fn summary(map: &HeatMap) -> String {
    match &map.errors {
        Some(e) => format!(
            "median {} ulps, 99.9 % within {}; wrong: {}",
            style::short(e.t.median),
            style::short(e.t.p999),
            style::thousands(e.wrong)
        ),
        None => {
            let errors = map.cells.iter().filter_map(|c| if let Cell::Error(e) = c { Some(*e) } else { None });
            let (sum, count) = errors.fold((0.0, 0), |(sum, n), e| (sum + e, n + 1));
            format!("{:.2} % of all rays meet what they leave", 100.0 * sum / f64::from(count.max(1)))
        }
    }
}

/// The scale, and what is none of it.
fn key(canvas: &mut Canvas, y: f64, heat: &Heat) {
    const STEP: f64 = 15.0;
    let name = if heat.shares { "rays that meet their own surface (%)" } else { "error of t (steps of f32, ulps)" };
    canvas.text([MARGIN, y - 18.0], Anchor::Left, TEXT, name);
    for i in 0..=STEPS {
        let x = MARGIN + STEP * i as f64;
        canvas.rect([x, y - 6.0], [x + STEP, y + 8.0], scale(i as f64 / STEPS as f64));
    }
    let ticks: Vec<(f64, String)> = match heat.shares {
        true => [0, 25, 50, 75, 100].map(|n| (f64::from(n) / 100.0, n.to_string())).to_vec(),
        false => {
            let powers = ULPS[0] as i32..=ULPS[1] as i32;
            powers.map(|p| ((f64::from(p) - ULPS[0]) / (ULPS[1] - ULPS[0]), power_of_ten(p))).collect()
        }
    };
    for (part, label) in ticks {
        let x = MARGIN + STEP * (part * STEPS as f64 + 0.5);
        canvas.line(&[[x, y + 8.0], [x, y + 12.0]], INK, 0.5);
        canvas.text([x, y + 22.0], Anchor::Middle, SMALL, &label);
    }
    let mut entries = vec![(Key::Patch(SKY), "a miss, as it should be".to_owned())];
    if !heat.shares {
        entries.push((Key::Patch(LOST), "missed, should hit".to_owned()));
        entries.push((Key::Patch(INVENTED), "hit, should miss".to_owned()));
    }
    legend(canvas, [MARGIN + STEP * (STEPS as f64 + 4.0), y], &entries);
}
