//! Tiles: 16 × 16 pixels whose rays go through the tracer together.
//!
//! A rayon task is a few tiles of a row, whose pixels it owns and writes without locks; the picture depends neither on the
//! order of the tiles nor on the number of threads.

use std::sync::Mutex;

use rayon::prelude::*;

use super::kernel::with_lanes;
use super::{Camera, Kernel, Tone};
use crate::math::{BATCH, HitBatch, Lanes, MAX_LANES, NONE, RayBatch, Vec3, map2};
use crate::scene::Scene;
use crate::shade::{Counts, Observer, Stage, Workspace, facing_normals, trace_waves};
use crate::trace::{Scratch, intersect};

/// Pixels along a tile's edge.
pub const TILE: usize = 16;

const _: () = assert!(TILE * TILE == BATCH);

/// Where ray i lies in its tile, `[x, y]`: blocks of 4 × 4 pixels, row by row within and among them, so that 4 and
/// 8 rays in a row are 4 × 1 and 4 × 2 pixels.
pub(super) const PLACE: [[u8; 2]; BATCH] = {
    let mut place = [[0; 2]; BATCH];
    let mut i = 0;
    while i < BATCH {
        let (block, pixel) = (i / 16, i % 16);
        place[i] = [(block % 4 * 4 + pixel % 4) as u8, (block / 4 * 4 + pixel / 4) as u8];
        i += 1;
    }
    place
};

/// [`PLACE`] as numbers, column by column.
const OFFSET: [[f32; BATCH]; 2] = {
    let mut offset = [[0.0; BATCH]; 2];
    let mut i = 0;
    while i < BATCH {
        offset[0][i] = PLACE[i][0] as f32;
        offset[1][i] = PLACE[i][1] as f32;
        i += 1;
    }
    offset
};

/// The eye rays of a picture: a camera and the picture's size.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Grid {
    camera: Camera,
    pub(super) width: usize,
    height: usize,
}

impl Grid {
    pub(crate) fn new(camera: &Camera, width: usize, height: usize) -> Self {
        Self { camera: *camera, width, height }
    }

    /// Fills a batch with the eye rays of the tile whose first pixel is `first`, through the point `within` of every
    /// pixel (½, ½ is the centre). Rays beyond the picture's edge are inactive.
    pub(crate) fn fill<L: Lanes>(&self, first: [usize; 2], within: [f32; 2], rays: &mut RayBatch) {
        let corner = Vec3::splat(self.corner(first, within));
        self.fill_places::<L>(&OFFSET, |_| corner, BATCH, rays);
        self.end_at_edges::<L>(first, &OFFSET, rays);
    }

    /// Whether a pixel lies in the picture.
    pub(super) fn has(&self, [x, y]: [usize; 2]) -> bool {
        x < self.width && y < self.height
    }

    /// Makes the rays of a batch, through pixels at `places` of a tile, inactive beyond the picture's edge.
    pub(super) fn end_at_edges<L: Lanes>(&self, first: [usize; 2], places: &[[f32; BATCH]; 2], rays: &mut RayBatch) {
        if first[0] + TILE <= self.width && first[1] + TILE <= self.height {
            return;
        }
        let left = map2([self.width - first[0], self.height - first[1]], |n| L::splat(n as f32));
        for at in (0..BATCH).step_by(L::WIDTH) {
            let active = L::load(&places[0][at..]).lt(left[0]) & L::load(&places[1][at..]).lt(left[1]);
            L::splat(f32::INFINITY).select(active, L::splat(-1.0)).store(&mut rays.t_max[at..]);
        }
    }

    /// The direction through the point `within` of a tile's first pixel, of any length.
    pub(super) fn corner(&self, first: [usize; 2], within: [f32; 2]) -> glam::Vec3 {
        // The tile's own corner, from f64: what is added to it in a tile is small beside it.
        let [across, down] = self.steps();
        let corner = self.camera.corner
            + across * (first[0] as f64 + f64::from(within[0]))
            + down * (first[1] as f64 + f64::from(within[1]));
        corner.as_vec3()
    }

    /// From a pixel to the next, and to the one below.
    fn steps(&self) -> [glam::DVec3; 2] {
        [self.camera.across / self.width as f64, self.camera.down / self.height as f64]
    }

    /// Fills a batch with `len` eye rays, through the pixels at `places` of a tile with a [`Grid::corner`] for each.
    pub(super) fn fill_places<L: Lanes>(
        &self,
        places: &[[f32; BATCH]; 2],
        corner: impl Fn(usize) -> Vec3<L>,
        len: usize,
        rays: &mut RayBatch,
    ) {
        let [across, down] = map2(self.steps(), |step| Vec3::splat(step.as_vec3()));
        rays.set_common_origin(self.camera.eye);
        // Whole packets are written; what is too much is taken back.
        rays.set_len(len.next_multiple_of(MAX_LANES));
        for at in (0..len).step_by(L::WIDTH) {
            let (x, y) = (L::load(&places[0][at..]), L::load(&places[1][at..]));
            let direction = across.mul_add(x, down.mul_add(y, corner(at))).normalize();
            direction.store(&mut rays.direction, at);
            L::splat(f32::INFINITY).store(&mut rays.t_max[at..]);
        }
        rays.set_len(len);
    }
}

/// Renders one sample a pixel straight to 0RGB with the sRGB curve, for a window; `pixels` holds width × height.
///
/// # Panics
/// When `pixels` has another length.
pub fn render_display(
    scene: &Scene,
    camera: &Camera,
    kernel: Kernel,
    width: usize,
    height: usize,
    pixels: &mut [u32],
) -> Counts {
    render_display_while(scene, camera, kernel, [width, height], pixels, &|| true)
}

/// As [`render_display`], as long as `go_on` says so, which is asked before every tile; the other pixels stay as they
/// were.
///
/// # Panics
/// When `pixels` does not hold width × height.
pub fn render_display_while(
    scene: &Scene,
    camera: &Camera,
    kernel: Kernel,
    [width, height]: [usize; 2],
    pixels: &mut [u32],
    go_on: &(dyn Fn() -> bool + Sync),
) -> Counts {
    assert_eq!(pixels.len(), width * height, "the buffer holds the picture");
    let grid = Grid::new(camera, width, height);
    let tone = Tone::get();
    over_tiles_while(pixels, width, go_on, |work, first, out| {
        let counts = with_lanes!(kernel, centred(scene, &grid, first, work));
        tone.map_columns(&work.shading.radiance, out);
        counts
    })
}

/// The nearest hits of the pixel-centre rays, row by row.
#[derive(Clone, Debug, PartialEq)]
pub struct PrimaryHits {
    /// Distance along the ray; infinite where nothing is hit.
    pub t: Vec<f32>,
    /// Distance along the camera's view; infinite where nothing is hit.
    pub z: Vec<f32>,
    /// Primitive id; [`NONE`] where nothing is hit.
    pub primitive: Vec<u32>,
    /// Unit normal of the surface itself, turned against the ray; zero where nothing is hit.
    pub normal: Vec<[f32; 3]>,
    /// Unit normal for shading, on the same side; zero where nothing is hit.
    pub shading_normal: Vec<[f32; 3]>,
}

/// Traces the pixel-centre rays only, in the caller's rayon pool.
pub fn primary_hits(scene: &Scene, camera: &Camera, kernel: Kernel, width: usize, height: usize) -> PrimaryHits {
    let grid = Grid::new(camera, width, height);
    let view = camera.view();
    let mut hits = vec![(f32::INFINITY, f32::INFINITY, NONE, [[0.0; 3]; 2]); width * height];
    over_tiles(&mut hits, width, |work, first, out| {
        with_lanes!(kernel, traced(scene, &grid, first, work));
        let rays = &work.shading.primary.rays;
        for (i, out) in out.iter_mut().enumerate() {
            let (t, id) = (work.hits.t[i], work.hits.primitive[i]);
            let direction = glam::Vec3::from_array([0, 1, 2].map(|axis| rays.direction[axis][i]));
            // Rays beyond the picture's edge have no answer of their own.
            let known = rays.t_max[i] >= 0.0;
            let normals =
                if known { facing_normals(scene, id, rays.first_origin(), direction, t) } else { [[0.0; 3]; 2] };
            let z = f64::from(t) * direction.as_dvec3().dot(view);
            *out = (t, z as f32, id, normals);
        }
        Counts::default()
    });
    PrimaryHits {
        t: hits.iter().map(|h| h.0).collect(),
        z: hits.iter().map(|h| h.1).collect(),
        primitive: hits.iter().map(|h| h.2).collect(),
        normal: hits.iter().map(|h| h.3[0]).collect(),
        shading_normal: hits.iter().map(|h| h.3[1]).collect(),
    }
}

/// Memory that a thread keeps between tiles.
#[derive(Clone, Debug)]
#[repr(align(64))]
pub(super) struct Work {
    pub(super) shading: Workspace,
    pub(super) sum: [[f32; BATCH]; 3],
    hits: HitBatch,
    candidates: Scratch,
}

impl Default for Work {
    fn default() -> Self {
        Self {
            shading: Workspace::default(),
            sum: [[0.0; BATCH]; 3],
            hits: HitBatch::default(),
            candidates: Scratch::default(),
        }
    }
}

/// Runs `tile` on every tile, rows of tiles in parallel, and stores the pixels it gives, ray by ray, where they belong.
pub(super) fn over_tiles<P: Copy + Default + Send>(
    pixels: &mut [P],
    width: usize,
    tile: impl Fn(&mut Work, [usize; 2], &mut [P; BATCH]) -> Counts + Sync,
) -> Counts {
    over_tiles_while(pixels, width, &|| true, tile)
}

/// As [`over_tiles`], as long as `go_on` says so.
pub(super) fn over_tiles_while<P: Copy + Default + Send>(
    pixels: &mut [P],
    width: usize,
    go_on: &(dyn Fn() -> bool + Sync),
    tile: impl Fn(&mut Work, [usize; 2], &mut [P; BATCH]) -> Counts + Sync,
) -> Counts {
    // Work is kept for the next task, whichever thread does it.
    let spare = Mutex::new(Vec::<Box<Work>>::new());
    let part = |part: &mut Part<P>| {
        let mut work = spare.lock().expect("no panic").pop().unwrap_or_default();
        let mut counts = Counts::default();
        let mut done = [P::default(); BATCH];
        for x in (0..part.rows[0].len()).step_by(TILE).take_while(|_| go_on()) {
            counts = counts + tile(&mut work, [part.first[0] + x, part.first[1]], &mut done);
            put(&done, &mut part.rows, x);
        }
        spare.lock().expect("no panic").push(work);
        counts
    };
    // Each part may be stolen alone: else a thread is left at the end with several, and the others wait.
    parts(pixels, width).par_iter_mut().with_max_len(1).map(part).reduce(Counts::default, |a, b| a + b)
}

/// A task: some tiles of a row of tiles.
struct Part<'a, P> {
    /// The first pixel.
    first: [usize; 2],
    /// The pixels, row by row; those beyond the picture's edge are empty.
    rows: [&'a mut [P]; TILE],
}

/// Tiles of a task: few, so that threads are done at about the same time.
const TILES: usize = 8;

/// A picture in parts.
fn parts<P>(pixels: &mut [P], width: usize) -> Vec<Part<'_, P>> {
    let mut parts = Vec::new();
    for (row, strip) in pixels.chunks_mut((width * TILE).max(1)).enumerate() {
        let from = parts.len();
        for (y, line) in strip.chunks_mut(width.max(1)).enumerate() {
            for (i, piece) in line.chunks_mut(TILES * TILE).enumerate() {
                if y == 0 {
                    let first = [i * TILES * TILE, row * TILE];
                    parts.push(Part { first, rows: std::array::from_fn(|_| Default::default()) });
                }
                parts[from + i].rows[y] = piece;
            }
        }
    }
    parts
}

/// Stores a tile whose left edge is `x0` in its rows; what lies beyond the picture's edge is left out.
fn put<P: Copy>(tile: &[P; BATCH], rows: &mut [&mut [P]; TILE], x0: usize) {
    // Four rays in a row are four pixels in a row.
    for (four, place) in tile.as_chunks::<4>().0.iter().zip(PLACE.as_chunks::<4>().0) {
        let row = &mut rows[usize::from(place[0][1]) % TILE];
        let x = x0 + usize::from(place[0][0]);
        if let Some(row) = row.get_mut(x..) {
            match row.first_chunk_mut::<4>() {
                Some(row) => *row = *four,
                None => row.iter_mut().zip(four).for_each(|(to, from)| *to = *from),
            }
        }
    }
}

fn centred<L: Lanes>(scene: &Scene, grid: &Grid, first: [usize; 2], work: &mut Work) -> Counts {
    grid.fill::<L>(first, [0.5, 0.5], &mut work.shading.primary.rays);
    trace_waves::<L>(scene, &mut work.shading, &mut ())
}

/// [`render_display`] on this thread, its stages shown to `observer`.
pub fn render_observed(
    scene: &Scene,
    camera: &Camera,
    kernel: Kernel,
    [width, height]: [usize; 2],
    pixels: &mut [u32],
    observer: &mut impl Observer,
) -> Counts {
    let grid = Grid::new(camera, width, height);
    let mut work = Box::<Workspace>::default();
    let mut done = [0; BATCH];
    let mut counts = Counts::default();
    for Part { first, mut rows } in parts(pixels, width) {
        for x in (0..rows[0].len()).step_by(TILE) {
            counts =
                counts + with_lanes!(kernel, observed(scene, &grid, [first[0] + x, first[1]], &mut work, observer));
            Tone::get().map_columns(&work.radiance, &mut done);
            observer.done(Stage::Curve);
            put(&done, &mut rows, x);
            observer.done(Stage::Store);
        }
    }
    counts
}

fn observed<L: Lanes>(
    scene: &Scene,
    grid: &Grid,
    first: [usize; 2],
    work: &mut Workspace,
    observer: &mut impl Observer,
) -> Counts {
    grid.fill::<L>(first, [0.5, 0.5], &mut work.primary.rays);
    observer.done(Stage::Eye);
    trace_waves::<L>(scene, work, observer)
}

/// Renders every `stride`-th tile on this thread, in order, and shows its rays to `observer`.
pub fn record(
    scene: &Scene,
    camera: &Camera,
    kernel: Kernel,
    [width, height]: [usize; 2],
    stride: usize,
    observer: &mut impl Observer,
) -> Counts {
    let grid = Grid::new(camera, width, height);
    let mut work = Box::<Workspace>::default();
    let mut counts = Counts::default();
    let across = width.div_ceil(TILE);
    for tile in (0..across * height.div_ceil(TILE)).step_by(stride.max(1)) {
        grid.fill::<f32>([tile % across * TILE, tile / across * TILE], [0.5, 0.5], &mut work.primary.rays);
        counts = counts + with_lanes!(kernel, trace_waves(scene, &mut work, observer));
    }
    counts
}

fn traced<L: Lanes>(scene: &Scene, grid: &Grid, first: [usize; 2], work: &mut Work) {
    grid.fill::<L>(first, [0.5, 0.5], &mut work.shading.primary.rays);
    intersect::<L>(scene, &work.shading.primary.rays, &mut work.hits, &mut work.candidates);
}
