//! `epsilon`: how far off a surface rays should start.

use plotters::prelude::RGBColor;

use super::axis::{Axis, Panel, power_of_ten};
use super::canvas::{Anchor, Canvas, Font};
use super::job::{Chart, Context};
use super::style::{self, COLORS, GREY, HEADING, Key, MARGIN, TEXT, caption, legend, title};
use super::table::Table;
use crate::geometry::methods::OffsetMethod;
use crate::measure::lab::{Machine, Offset, OffsetCurve, Sweep, sweep};

const WIDTH: f64 = 1180.0;
const HEIGHT: f64 = 852.0;

/// From the least epsilon to the greatest.
const RAMP: [RGBColor; 6] = [
    RGBColor(253, 190, 110),
    RGBColor(248, 150, 75),
    RGBColor(232, 108, 50),
    RGBColor(200, 70, 30),
    RGBColor(150, 40, 20),
    RGBColor(95, 15, 10),
];

pub fn draw(name: &str, context: &Context) -> Result<Chart, String> {
    let sweep = sweep(context.budget, context.progress).map_err(|e| e.to_string())?;
    Ok(Chart { name: name.into(), svg: svg(&sweep, context.machine), table: table(&sweep), sound: true })
}

fn table(sweep: &Sweep) -> Table {
    let mut table =
        Table::new(&["offset", "epsilon", "scale", "acne_per_million", "leaks_per_million", "acne_rays", "leak_rays"]);
    for OffsetCurve { offset, acne, leaks } in &sweep.curves {
        let (name, epsilon) = match offset {
            Offset::Method(method) => (method.name(), String::new()),
            Offset::Fixed(epsilon) => ("fixed", epsilon.to_string()),
        };
        for ((scale, acne), leaks) in sweep.scales.iter().zip(acne).zip(leaks) {
            table.push(&[&name, &epsilon, scale, acne, leaks, &sweep.rays[0], &sweep.rays[1]]);
        }
    }
    table
}

/// The name of a curve, its colour and its width.
fn look(offset: Offset) -> (String, RGBColor, f64) {
    match offset {
        Offset::Method(OffsetMethod::Derived) => ("derived from the rounding (the default)".into(), COLORS[0], 3.5),
        Offset::Method(OffsetMethod::None) => ("none".into(), GREY, 1.5),
        Offset::Method(_) => ("10⁻⁴ of the largest coordinate".into(), COLORS[2], 2.0),
        Offset::Fixed(epsilon) => {
            let power = f64::from(epsilon).log10().round() as i32;
            (power_of_ten(power), RAMP[(power + 7).clamp(0, 5) as usize], 1.5)
        }
    }
}

/// A panel: its heading, and what it shows of an offset.
type Row = (&'static str, fn(&OffsetCurve) -> &[f64]);

fn svg(sweep: &Sweep, machine: &Machine) -> String {
    Canvas::draw(WIDTH, HEIGHT, |canvas| {
        title(
            canvas,
            "No fixed epsilon is right at every scale",
            "Rays that leave a surface start off it by an epsilon: too small, and they meet it again; too large, \
             and they start beyond what is close by.",
        );
        let entry = |c: &OffsetCurve| {
            let (name, color, width) = look(c.offset);
            (Key::Line(color, width), name)
        };
        let (methods, fixed): (Vec<_>, Vec<_>) =
            sweep.curves.iter().partition(|c| matches!(c.offset, Offset::Method(_)));
        legend(canvas, [MARGIN, 94.0], &methods.into_iter().map(entry).collect::<Vec<_>>());
        canvas.text([MARGIN, 120.0], Anchor::Left, Font { color: GREY, ..TEXT }, "fixed epsilon, world units:");
        legend(canvas, [MARGIN + 180.0, 120.0], &fixed.into_iter().map(entry).collect::<Vec<_>>());
        let least = 1e6 / sweep.rays[0].max(sweep.rays[1]).max(1) as f64;
        let y = Axis::decades([least, 1e6]).with_zero();
        let x = Axis::decades(sweep.scales.iter().copied());
        let rows: [Row; 2] = [
            ("Acne: rays that meet the surface they leave", |c| &c.acne),
            ("Leaks: rays that miss an occluder close by", |c| &c.leaks),
        ];
        for (row, (heading, rates)) in rows.into_iter().enumerate() {
            let top = 170.0 + 325.0 * row as f64;
            canvas.text([MARGIN + 66.0, top - 16.0], Anchor::Left, HEADING, heading);
            let panel = Panel { at: [MARGIN + 66.0, top], size: [WIDTH - 2.0 * MARGIN - 90.0, 255.0], x, y };
            panel.draw(canvas, if row == 0 { " " } else { "size of the scene (world units)" }, "rays (per million)");
            for (i, curve) in sweep.curves.iter().enumerate().rev() {
                let (_, color, width) = look(curve.offset);
                let points: Vec<_> = sweep.scales.iter().zip(rates(curve)).map(|(&x, &y)| [x, y]).collect();
                panel.beside(i, sweep.curves.len()).line(canvas, &points, color, width);
            }
        }
        let [acne, leaks] = sweep.rays.map(style::thousands);
        let notes = [
            format!(
                "Acne on {acne} rays for every offset and size, from a sphere, a plane, a triangle, a box and a \
                 cylinder, each alone. Leaks on {leaks} rays under an",
            ),
            "occluder between 10⁻⁵ and 10⁻¹ of the scene's size above a sphere or plane. Things lie within 4 sizes of \
             the world's origin. Curves with the same values are drawn side by side."
                .to_owned(),
        ];
        caption(canvas, HEIGHT, &notes, machine);
    })
}
