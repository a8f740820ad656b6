//! Several rays a pixel on a regular grid: a tile's pixels, each the mean of its rays.

use std::sync::atomic::{AtomicUsize, Ordering};

use super::adaptive::render_adaptive;
use super::tile::{Grid, PLACE, TILE, Work, over_tiles};
use crate::math::{BATCH, Lanes, Vec3};
use crate::render::kernel::with_lanes;
use crate::render::{Camera, Counts, Film, Kernel};
use crate::scene::Scene;
use crate::shade::trace_waves;

/// How many rays a pixel gets.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Samples {
    /// So many along each edge, at least 1.
    Grid(u32),
    /// See [`render_adaptive`]: so many display codes may differ where four rays are enough.
    Adaptive(u8),
}

/// Renders with `samples` × `samples` rays a pixel on a regular grid, in the caller's rayon pool.
///
/// `progress` is called now and then with the share done, 0 to 1, from any thread.
pub fn render(
    scene: &Scene,
    camera: &Camera,
    kernel: Kernel,
    samples: u32,
    film: &mut Film,
    progress: &(dyn Fn(f32) + Sync),
) -> Counts {
    let grid = Grid::new(camera, film.width, film.height);
    let done = AtomicUsize::new(0);
    let rows = film.height.div_ceil(TILE);
    over_tiles(&mut film.pixels, film.width, |work, first, out| {
        let counts = averaged(scene, &grid, first, kernel, samples, work, out);
        if first[0] + TILE >= grid.width {
            let rows_done = 1 + done.fetch_add(1, Ordering::Relaxed);
            progress(rows_done as f32 / rows as f32);
        }
        counts
    })
}

/// [`render`] or [`render_adaptive`].
pub fn render_samples(
    scene: &Scene,
    camera: &Camera,
    kernel: Kernel,
    samples: Samples,
    film: &mut Film,
    progress: &(dyn Fn(f32) + Sync),
) -> Counts {
    match samples {
        Samples::Grid(n) => render(scene, camera, kernel, n, film, progress),
        Samples::Adaptive(codes) => render_adaptive(scene, camera, kernel, codes, film, progress),
    }
}

/// A tile's pixels with `samples` × `samples` rays each, at least 1.
pub(super) fn averaged(
    scene: &Scene,
    grid: &Grid,
    first: [usize; 2],
    kernel: Kernel,
    samples: u32,
    work: &mut Work,
    out: &mut [[f32; 3]; BATCH],
) -> Counts {
    let samples = samples.max(1) as usize;
    // Where few things are tested and nothing branches, coherence gains less than it costs.
    let counts = match samples > 1 && TILE.is_multiple_of(samples) && (scene.bvh.is_some() || scene.plan.refracts) {
        true => with_lanes!(kernel, by_blocks(scene, grid, first, samples, work)),
        false => with_lanes!(kernel, by_samples(scene, grid, first, samples, work)),
    };
    let scale = 1.0 / (samples * samples) as f32;
    let [r, g, b] = &work.sum;
    for (i, out) in out.iter_mut().enumerate() {
        *out = [r[i] * scale, g[i] * scale, b[i] * scale];
    }
    counts
}

/// The place of a sample in its pixel.
fn within(sample: [usize; 2], samples: usize) -> [f32; 2] {
    sample.map(|s| (s as f32 + 0.5) / samples as f32)
}

/// The sums of a tile's pixels, a batch for each sample.
fn by_samples<L: Lanes>(scene: &Scene, grid: &Grid, first: [usize; 2], samples: usize, work: &mut Work) -> Counts {
    let mut counts = Counts::default();
    work.sum = [[0.0; BATCH]; 3];
    for sy in 0..samples {
        for sx in 0..samples {
            grid.fill::<L>(first, within([sx, sy], samples), &mut work.shading.primary.rays);
            counts = counts + trace_waves::<L>(scene, &mut work.shading, &mut ());
            for (sum, part) in work.sum.iter_mut().zip(&work.shading.radiance) {
                for i in 0..BATCH {
                    sum[i] += part[i];
                }
            }
        }
    }
    counts
}

/// Which ray of a batch lies at x, y of a tile; the inverse of [`PLACE`].
const RAY: [[u8; TILE]; TILE] = {
    let mut ray = [[0; TILE]; TILE];
    let mut i = 0;
    while i < BATCH {
        let [x, y] = PLACE[i];
        ray[y as usize][x as usize] = i as u8;
        i += 1;
    }
    ray
};

/// The rays of a tile's first block of pixels, and which belong together.
struct Block {
    /// The rays' pixels.
    places: [[f32; BATCH]; 2],
    /// What [`Grid::corner`] gives for the rays' samples.
    starts: [[f32; BATCH]; 3],
    /// The rays by sample, and by pixel within.
    order: [u8; BATCH],
}

impl Block {
    fn new(grid: &Grid, first: [usize; 2], samples: usize) -> Self {
        let mut block = Self { places: [[0.0; BATCH]; 2], starts: [[0.0; BATCH]; 3], order: [0; BATCH] };
        let mut at = 0;
        for sy in 0..samples {
            for sx in 0..samples {
                let corner = grid.corner(first, within([sx, sy], samples));
                for y in 0..TILE / samples {
                    for x in 0..TILE / samples {
                        let ray = RAY[y * samples + sy][x * samples + sx];
                        block.order[at] = ray;
                        at += 1;
                        let ray = usize::from(ray);
                        (block.places[0][ray], block.places[1][ray]) = (x as f32, y as f32);
                        (0..3).for_each(|axis| block.starts[axis][ray] = corner[axis]);
                    }
                }
            }
        }
        block
    }
}

/// The sums of a tile's pixels, a batch for all samples of each of its blocks of pixels: such a batch is as narrow as a
/// tile of a picture that is `samples` times as wide and high. The edge of a tile must be a multiple of `samples`.
fn by_blocks<L: Lanes>(scene: &Scene, grid: &Grid, first: [usize; 2], samples: usize, work: &mut Work) -> Counts {
    let mut counts = Counts::default();
    let edge = TILE / samples;
    let block = Block::new(grid, first, samples);
    for y0 in (0..TILE).step_by(edge).take_while(|y| grid.has([first[0], first[1] + y])) {
        for x0 in (0..TILE).step_by(edge).take_while(|x| grid.has([first[0] + x, first[1]])) {
            let rays = &mut work.shading.primary.rays;
            let mut places = block.places;
            for (column, from) in places.iter_mut().zip([x0, y0]) {
                for place in column {
                    *place += from as f32;
                }
            }
            grid.fill_places::<L>(&places, |at| Vec3::load(&block.starts, at), BATCH, rays);
            grid.end_at_edges::<L>(first, &places, rays);
            counts = counts + trace_waves::<L>(scene, &mut work.shading, &mut ());
            for axis in 0..3 {
                let totals = totals(&work.shading.radiance[axis], &block.order, edge * edge);
                for (y, row) in RAY[y0..y0 + edge].iter().enumerate() {
                    for x in 0..edge {
                        work.sum[axis][usize::from(row[x0 + x])] = totals[y * edge + x];
                    }
                }
            }
        }
    }
    counts
}

/// The sums of the first so many `pixels`' rays. Pixel by pixel for each ray, so that no sum waits for the one before.
#[inline(always)]
fn totals(part: &[f32; BATCH], order: &[u8; BATCH], pixels: usize) -> [f32; BATCH / 4] {
    let mut totals = [0.0; BATCH / 4];
    for rays in order.chunks_exact(pixels) {
        for (total, &ray) in totals.iter_mut().zip(rays) {
            *total += part[usize::from(ray)];
        }
    }
    totals
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene;

    /// The largest difference of a picture's sums, sample by sample and by blocks, over the largest sum.
    fn difference<L: Lanes>(name: &str, samples: usize) -> f32 {
        let description = scene::load(name).expect("a scene");
        let scene = scene::compile(&description).expect("it compiles");
        let size = [37, 21];
        let grid = Grid::new(&Camera::new(&description.camera, 37.0 / 21.0), size[0], size[1]);
        let [mut a, mut b] = [Work::default(), Work::default()];
        let (mut most, mut off) = (0.0f32, 0.0f32);
        for y in (0..size[1]).step_by(TILE) {
            for x in (0..size[0]).step_by(TILE) {
                let counts = by_samples::<L>(&scene, &grid, [x, y], samples, &mut a);
                assert_eq!(counts, by_blocks::<L>(&scene, &grid, [x, y], samples, &mut b), "{name}");
                for (i, place) in PLACE.iter().enumerate() {
                    if grid.has([x + usize::from(place[0]), y + usize::from(place[1])]) {
                        for axis in 0..3 {
                            most = most.max(a.sum[axis][i]);
                            off = off.max((a.sum[axis][i] - b.sum[axis][i]).abs());
                        }
                    }
                }
            }
        }
        assert!(most > 1.0);
        off / most
    }

    #[test]
    fn blocks_and_samples_give_the_same_sums() {
        for samples in [2, 4, 8, 16] {
            assert_eq!(difference::<wide::f32x8>("flake", samples), 0.0, "{samples}");
        }
        assert_eq!(difference::<f32>("flake", 2), 0.0);
        // Where rays branch, a ray's parts are added in the order that its company sets.
        assert!(difference::<wide::f32x4>("glass", 4) < 1e-6);
    }
}
