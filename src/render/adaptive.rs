//! Antialiasing that traces more rays only where the picture needs them.

use std::sync::atomic::{AtomicUsize, Ordering};

use bytemuck::cast;
use wide::u8x16;

use super::tile::{Grid, PLACE, TILE, Work, over_tiles};
use super::{Camera, Counts, Film, Kernel, Tone};
use crate::math::{BATCH, Lanes, Vec3, map2, map3};
use crate::render::kernel::with_lanes;
use crate::scene::Scene;
use crate::shade::trace_waves;

/// Rays along a pixel's edge where the picture needs all.
const GRID: usize = 4;
/// A ray in every row and every column of the grid, which come first: so an edge that runs along one is seen early.
const FIRST: [[usize; 2]; GRID] = [[1, 0], [3, 1], [0, 2], [2, 3]];
/// The others.
const OTHERS: [[usize; 2]; GRID * (GRID - 1)] =
    [[0, 0], [2, 0], [3, 0], [0, 1], [1, 1], [2, 1], [1, 2], [2, 2], [3, 2], [0, 3], [1, 3], [3, 3]];
/// A pixel's neighbours, and the first rays of each that lie near, as masks. With all of them a picture takes a twentieth
/// more rays, and with only the nearest half of them some edges are missed.
const AROUND: [([isize; 2], [u32; GRID]); 8] = [
    ([-1, -1], [0, ALL, 0, ALL]),
    ([0, -1], [0, ALL, ALL, ALL]),
    ([1, -1], [0, 0, ALL, ALL]),
    ([-1, 0], [ALL, ALL, 0, ALL]),
    ([1, 0], [ALL, 0, ALL, ALL]),
    ([-1, 1], [ALL, ALL, 0, 0]),
    ([0, 1], [ALL, ALL, ALL, 0]),
    ([1, 1], [ALL, 0, ALL, 0]),
];
/// A ray that counts.
const ALL: u32 = u32::MAX;

/// The display codes that may differ where nobody asks for another number.
pub const ALIKE: u8 = 5;

/// What the first rays of a pixel have found.
#[derive(Clone, Copy, Default)]
struct Seen {
    /// The sum of their radiance.
    sum: [f32; 3],
    /// The display codes of each.
    codes: [u32; GRID],
}

/// Renders with 16 rays a pixel where the picture needs them, and 4 elsewhere, in the caller's rayon pool; the 16 are
/// those of [`render`](super::render()) with 4 samples.
///
/// A pixel gets all rays when its first four and 20 near ones of its neighbours differ by more than `codes` of 255 display
/// codes in any channel; with [`ALIKE`] most pixels are within 2 codes of the full grid's. A pixel is further off where none
/// of the 24 rays meets what a smaller or fainter thing adds to it, such as a spark in a mirror. While it works it holds 28
/// bytes a pixel beside the film. `progress` is called as by [`render`](super::render()).
pub fn render_adaptive(
    scene: &Scene,
    camera: &Camera,
    kernel: Kernel,
    codes: u8,
    film: &mut Film,
    progress: &(dyn Fn(f32) + Sync),
) -> Counts {
    let (width, height) = (film.width, film.height);
    let grid = Grid::new(camera, width, height);
    let done = AtomicUsize::new(0);
    let rows = 2 * height.div_ceil(TILE);
    let row_done = |first: [usize; 2]| {
        if first[0] + TILE >= width {
            progress((1 + done.fetch_add(1, Ordering::Relaxed)) as f32 / rows as f32);
        }
    };
    let mut seen = vec![Seen::default(); width * height];
    let first = over_tiles(&mut seen, width, |work, first, out| {
        let counts = with_lanes!(kernel, look(scene, &grid, first, work, out));
        row_done(first);
        counts
    });
    let others = over_tiles(&mut film.pixels, width, |work, first, out| {
        let near = Near { seen: &seen, width, height, codes };
        let counts = with_lanes!(kernel, look_closer(scene, &grid, first, work, &near, out));
        row_done(first);
        counts
    });
    first + others
}

/// A place on the grid as a part of the pixel.
fn within([x, y]: [usize; 2]) -> [f32; 2] {
    [x, y].map(|i| (i as f32 + 0.5) / GRID as f32)
}

/// The first rays of a tile.
fn look<L: Lanes>(scene: &Scene, grid: &Grid, first: [usize; 2], work: &mut Work, out: &mut [Seen; BATCH]) -> Counts {
    let mut counts = Counts::default();
    let mut codes = [0; BATCH];
    out.fill(Seen::default());
    for (k, place) in FIRST.into_iter().enumerate() {
        grid.fill::<L>(first, within(place), &mut work.shading.primary.rays);
        counts = counts + trace_waves::<L>(scene, &mut work.shading, &mut ());
        let radiance = &work.shading.radiance;
        Tone::get().map_columns(radiance, &mut codes);
        for (i, seen) in out.iter_mut().enumerate() {
            (0..3).for_each(|axis| seen.sum[axis] += radiance[axis][i]);
            seen.codes[k] = codes[i];
        }
    }
    counts
}

/// The first rays of all pixels.
struct Near<'a> {
    seen: &'a [Seen],
    width: usize,
    height: usize,
    /// By how much what is alike may differ.
    codes: u8,
}

impl Near<'_> {
    /// Whether a pixel and those around it look alike.
    fn alike(&self, [x, y]: [usize; 2]) -> bool {
        let codes = |x: usize, y: usize| cast::<[u32; GRID], u8x16>(self.seen[y * self.width + x].codes);
        let mut least = codes(x, y);
        let mut most = least;
        for ([right, down], near) in AROUND {
            let (x, y) = (x.wrapping_add_signed(right), y.wrapping_add_signed(down));
            if x < self.width && y < self.height {
                let near = cast::<[u32; GRID], u8x16>(near);
                least = least.min(codes(x, y) | !near);
                most = most.max(codes(x, y) & near);
            }
        }
        // Four rays are left, of four bytes each.
        let (least, most) = (least.to_array(), most.to_array());
        (0..4).all(|axis| {
            let four = [axis, axis + 4, axis + 8, axis + 12];
            let [least, most] = four.iter().fold([u8::MAX, 0], |[l, m], &i| [l.min(least[i]), m.max(most[i])]);
            most - least <= self.codes
        })
    }
}

/// The pixels of a tile, from their first rays and the others where those are needed, which are packed into batches.
fn look_closer<L: Lanes>(
    scene: &Scene,
    grid: &Grid,
    first: [usize; 2],
    work: &mut Work,
    near: &Near,
    out: &mut [[f32; 3]; BATCH],
) -> Counts {
    let mut counts = Counts::default();
    let mut closer = Vec::new();
    for (i, place) in PLACE.iter().enumerate() {
        let [x, y] = map2([0, 1], |axis| first[axis] + usize::from(place[axis]));
        if x >= near.width || y >= near.height {
            continue;
        }
        out[i] = near.seen[y * near.width + x].sum;
        match near.alike([x, y]) {
            true => out[i] = map3(out[i], |sum| sum * (1.0 / GRID as f32)),
            false => closer.push(i as u8),
        }
    }
    let rays: Vec<(u8, usize)> = closer.iter().flat_map(|&i| (0..OTHERS.len()).map(move |other| (i, other))).collect();
    let corners = OTHERS.map(|place| grid.corner(first, within(place)));
    for rays in rays.chunks(BATCH) {
        let mut places = [[0.0; BATCH]; 2];
        let mut starts = [[0.0; BATCH]; 3];
        for (slot, &(i, other)) in rays.iter().enumerate() {
            let place = PLACE[usize::from(i)];
            (0..2).for_each(|axis| places[axis][slot] = f32::from(place[axis]));
            (0..3).for_each(|axis| starts[axis][slot] = corners[other][axis]);
        }
        grid.fill_places::<L>(&places, |at| Vec3::load(&starts, at), rays.len(), &mut work.shading.primary.rays);
        counts = counts + trace_waves::<L>(scene, &mut work.shading, &mut ());
        for (slot, &(i, _)) in rays.iter().enumerate() {
            (0..3).for_each(|axis| out[usize::from(i)][axis] += work.shading.radiance[axis][slot]);
        }
    }
    for i in closer {
        let pixel = &mut out[usize::from(i)];
        *pixel = map3(*pixel, |sum| sum * (1.0 / (GRID * GRID) as f32));
    }
    counts
}
