//! Menger sponges: a grid of 3ⁿ × 3ⁿ cells, with a line wherever a full one meets an empty one.

use super::{Extent, Outline};
use crate::scene::Fractal;
use crate::viewer::section::{Cut, Section, flat};
use glam::{DVec2, Vec2Swizzles, Vec3Swizzles};

/// Cells narrower than this many pixels are drawn as one with those around them.
const CELL_PIXELS: f64 = 3.0;

impl Outline for Fractal {
    fn cuts(&self, section: &Section, emit: &mut dyn FnMut(Cut)) {
        let (center, radius) = (self.center.as_dvec3(), f64::from(self.radius));
        if !section.meets(center, radius * 3f64.sqrt()) {
            return;
        }
        let (low, edge) = (center - radius, 2.0 * radius);
        let fits = |&level: &u32| edge / 3f64.powi(level as i32) >= CELL_PIXELS * section.pixel;
        // The description allows 8; what does not is nothing to hang on.
        let level = (1..=self.iterations.min(8)).take_while(fits).last().unwrap_or(0);
        let n = 3usize.pow(level);
        let cell = edge / n as f64;
        // As with corners, a face on the slice counts as above it.
        let layer = ((section.y - low.y) / cell).ceil() - 1.0;
        if !(layer >= 0.0 && layer < n as f64) {
            return;
        }
        let layer = middles(layer as usize, level);
        // The cells that are seen; conversion to an integer saturates.
        let seen = |low: f64, center: f64| {
            let index = |x: f64| (((x - low) / cell).floor() as usize).min(n);
            index(center - section.radius)..(index(center + section.radius) + 1).min(n)
        };
        let seen = [seen(low.x, section.center.x), seen(low.z, section.center.y)];
        let columns: Vec<usize> = (0..n).map(|i| middles(i, level)).collect();
        let full = |i: usize, k: usize| match (columns.get(i), columns.get(k)) {
            (Some(i), Some(k)) => (i & k) | (i & layer) | (k & layer) == 0,
            _ => false,
        };
        for axis in 0..2 {
            let place = |i: usize, k: usize| {
                let offset = DVec2::new(i as f64, k as f64) * cell;
                low.xz() + if axis == 0 { offset } else { offset.yx() }
            };
            for i in seen[axis].start..=seen[axis].end {
                // A section is the same when x and z are exchanged. Before the first cell comes index −1, outside.
                let edge = |k: &usize| full(i, *k) != full(i.wrapping_sub(1), *k);
                let mut k = seen[1 - axis].start;
                while let Some(start) = (k..seen[1 - axis].end).find(edge) {
                    k = (start..seen[1 - axis].end).find(|k| !edge(k)).unwrap_or(seen[1 - axis].end);
                    emit(Cut::Segment(place(i, start), place(i, k)));
                }
            }
        }
    }

    fn extent(&self) -> Option<Extent> {
        Some(Extent::around(flat(self.center), DVec2::splat(self.radius.into())))
    }
}

/// The iterations in which a cell's row (column, layer) is the middle one of three, as bits. Those cells are empty
/// in which an iteration finds two of the three so.
fn middles(index: usize, level: u32) -> usize {
    (0..level).filter(|&digit| index / 3usize.pow(digit) % 3 == 1).map(|digit| 1 << digit).sum()
}
