//! `raypacket contest`: frames a second along a fixed path, with a check of the answers in the same run.
//!
//! The path is one turn of the eye around the point that the scene's camera looks at, about the camera's `up`, in
//! [`Options::frames`] equal steps; the first frame is the scene's own. The eye keeps its distance and its height, and
//! looks at the same point. In `classic` it stays outside of all spheres, which is tested.

use std::f64::consts::TAU;
use std::time::Duration;

use glam::DVec3;
use rayon::{ThreadPool, ThreadPoolBuildError, ThreadPoolBuilder};
use serde::Serialize;

use super::bench::agrees_with_reference;
use super::stamp::Stamp;
use super::turns::{Times, take_turns};
use crate::math::isa;
use crate::render::{Camera, Kernel, render_display};
use crate::scene::{CameraDescription, Description, Scene};

/// Options of a contest; only with the default size, frames and kernel it is the contest.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Options {
    /// Width and height of a frame.
    pub size: [usize; 2],
    /// Frames of the path.
    pub frames: usize,
    /// The width of the tracer.
    pub kernel: Kernel,
    /// Time for the rounds of one scene, on one thread and on all together; there are 3 at the least.
    pub budget: Duration,
}

impl Options {
    /// Whether only the time differs from the default.
    fn standard(&self) -> bool {
        Self { budget: Self::default().budget, ..*self } == Self::default()
    }
}

impl Default for Options {
    fn default() -> Self {
        Self { size: [512, 512], frames: 24, kernel: Kernel::X8, budget: Duration::from_secs(10) }
    }
}

/// The path on so many threads.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Timed {
    /// Threads.
    pub threads: usize,
    /// Frames a second, median of the rounds; a round draws the whole path.
    pub fps_median: f64,
    /// The best round.
    pub fps_best: f64,
    /// 10⁶ rays of all kinds a second, median of the rounds.
    pub mrays_median: f64,
    /// Nanoseconds a pixel, median of the rounds.
    pub ns_per_pixel: f64,
    /// Rounds that were timed.
    pub runs: usize,
    /// How far the rounds lie apart, as a share of the median: see [`Times::spread`].
    pub spread: f64,
}

/// The findings of [`run`].
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Entry {
    /// The scene's name.
    pub scene: String,
    /// Width and height of a frame.
    pub size: [usize; 2],
    /// Frames of the path.
    pub frames: usize,
    /// `x1`, `x4` or `x8`.
    pub kernel: &'static str,
    /// Whether size, frames and kernel are the contest's.
    pub standard: bool,
    /// The instruction set this build uses.
    pub isa: &'static str,
    /// On what, from what and when.
    #[serde(flatten)]
    pub stamp: Stamp,
    /// Rays of all kinds along the path.
    pub rays: u64,
    /// What all pixels of the path come to, the same wherever the same build ran right.
    pub digest: String,
    /// Whether the answers agreed: see [`run`].
    pub valid: bool,
    /// On one thread, and on all of the pool.
    pub results: Vec<Timed>,
}

/// Holds the contest on a scene, on one thread and on all of the caller's rayon pool, which take turns; `scene` is what
/// [`crate::scene::compile`] made of `description`.
///
/// The answers agree when all threads draw the pixels that one draws, all kernels draw the same first frame to the bit,
/// and small pictures of the first frame and of one a third around pass [`super::verify`].
///
/// # Errors
/// When a thread cannot be started.
pub fn run(description: &Description, scene: &Scene, options: &Options) -> Result<Entry, ThreadPoolBuildError> {
    let Options { size, frames, kernel, .. } = *options;
    let path = Path::new(scene, &description.camera, options);
    let all = rayon::current_num_threads();
    let one = ThreadPoolBuilder::new().num_threads(1).build()?;
    let pools: Vec<Option<&ThreadPool>> = if all == 1 { vec![None] } else { vec![Some(&one), None] };
    let drawn: Vec<(u64, u64)> = pools.iter().map(|pool| within(*pool, || path.digest())).collect();
    let times = take_turns(pools.len(), options.budget, |i| {
        within(pools[i], || path.draw(|_| ()));
    });
    let (rays, digest) = drawn[0];
    let pixels = (frames * size[0] * size[1]) as f64;
    let timed = |(pool, times): (&Option<&ThreadPool>, Vec<f64>)| {
        let Times { median, best, spread, runs } = Times::of(times);
        Timed {
            threads: if pool.is_some() { 1 } else { all },
            fps_median: frames as f64 / median,
            fps_best: frames as f64 / best,
            mrays_median: rays as f64 / median * 1e-6,
            ns_per_pixel: median / pixels * 1e9,
            runs,
            spread,
        }
    };
    Ok(Entry {
        scene: description.name.clone(),
        size,
        frames,
        kernel: kernel.name(),
        standard: options.standard(),
        isa: isa(),
        stamp: Stamp::now(),
        rays,
        digest: format!("{digest:016x}"),
        valid: drawn.iter().all(|d| *d == drawn[0]) && path.same_at_all_widths() && right(description, scene, frames),
        results: pools.iter().zip(times).map(timed).collect(),
    })
}

/// Calls `work` in a pool, or in the caller's.
fn within<T: Send>(pool: Option<&ThreadPool>, work: impl FnOnce() -> T + Send) -> T {
    match pool {
        Some(pool) => pool.install(work),
        None => work(),
    }
}

/// Whether small pictures from two places of the path agree with the reference.
fn right(description: &Description, scene: &Scene, frames: usize) -> bool {
    let camera = turned(&description.camera, frames / 3, frames);
    agrees_with_reference(description, scene)
        && (frames < 3 || agrees_with_reference(&Description { camera, ..description.clone() }, scene))
}

/// The frames, ready to be drawn.
struct Path<'a> {
    scene: &'a Scene,
    cameras: Vec<Camera>,
    kernel: Kernel,
    size: [usize; 2],
}

impl<'a> Path<'a> {
    fn new(scene: &'a Scene, camera: &CameraDescription, options: &Options) -> Self {
        let Options { size, frames, kernel, .. } = *options;
        let aspect = size[0] as f32 / size[1] as f32;
        let cameras = (0..frames).map(|i| Camera::new(&turned(camera, i, frames), aspect)).collect();
        Self { scene, cameras, kernel, size }
    }

    /// Draws all frames, and gives the number of rays.
    fn draw(&self, mut see: impl FnMut(&[u32])) -> u64 {
        let [width, height] = self.size;
        let mut pixels = vec![0; width * height];
        let mut rays = 0;
        for camera in &self.cameras {
            rays += render_display(self.scene, camera, self.kernel, width, height, &mut pixels).total();
            see(&pixels);
        }
        rays
    }

    /// The number of rays and the pixels' digest: FNV-1a with 64 bits over the pixels 0x00RRGGBB, row by row.
    fn digest(&self) -> (u64, u64) {
        let mut digest: u64 = 0xcbf2_9ce4_8422_2325;
        let rays = self.draw(|pixels| {
            for &pixel in pixels {
                digest = (digest ^ u64::from(pixel)).wrapping_mul(0x0100_0000_01b3);
            }
        });
        (rays, digest)
    }

    /// Whether all kernels draw the same first frame.
    fn same_at_all_widths(&self) -> bool {
        let [width, height] = self.size;
        let Some(camera) = self.cameras.first() else { return true };
        let drawn = Kernel::ALL.map(|kernel| {
            let mut pixels = vec![0; width * height];
            render_display(self.scene, camera, kernel, width, height, &mut pixels);
            pixels
        });
        drawn.windows(2).all(|pair| pair[0] == pair[1])
    }
}

/// The camera of frame `i` of `frames`: the eye has gone that share of a turn.
fn turned(camera: &CameraDescription, i: usize, frames: usize) -> CameraDescription {
    if i == 0 {
        return *camera;
    }
    let axis = camera.up.as_dvec3().try_normalize().unwrap_or(DVec3::Y);
    let (sin, cos) = (TAU * i as f64 / frames as f64).sin_cos();
    let look_at = camera.look_at.as_dvec3();
    let away = camera.eye.as_dvec3() - look_at;
    let away = away * cos + axis.cross(away) * sin + axis * (axis.dot(away) * (1.0 - cos));
    CameraDescription { eye: (look_at + away).as_vec3(), ..*camera }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene;

    #[test]
    fn the_eye_goes_around_and_stays_outside() {
        let classic = scene::load("classic").unwrap();
        let frames = Options::default().frames;
        let first = classic.camera;
        for i in 0..frames {
            let camera = turned(&first, i, frames);
            assert!((camera.eye.y - first.eye.y).abs() < 1e-5, "frame {i} keeps its height: {}", camera.eye);
            let [near, far] = [camera, first].map(|c| c.eye.distance(c.look_at));
            assert!((near - far).abs() < 1e-5, "frame {i} keeps its distance");
            for sphere in &classic.spheres {
                assert!(camera.eye.distance(sphere.center) > sphere.radius + 0.05, "frame {i} is in {sphere:?}");
            }
        }
        assert_eq!(turned(&first, 0, frames), first);
        let half = turned(&first, frames / 2, frames).eye;
        assert!((half.x + first.eye.x).abs() < 1e-5 && (half.z + first.eye.z).abs() < 1e-5, "{half}");
    }

    #[test]
    fn a_small_contest() {
        let description = scene::load("classic").unwrap();
        let scene = scene::compile(&description).unwrap();
        let options = Options { size: [24, 24], frames: 3, kernel: Kernel::X4, budget: Duration::ZERO };
        let pool = ThreadPoolBuilder::new().num_threads(3).build().unwrap();
        let entry = pool.install(|| run(&description, &scene, &options)).unwrap();
        assert!(entry.valid && !entry.standard);
        assert!(Options { budget: Duration::ZERO, ..Options::default() }.standard());
        assert_eq!(entry.results.iter().map(|r| r.threads).collect::<Vec<_>>(), [1, 3]);
        assert!(entry.rays > 3 * 24 * 24);
        for Timed { fps_median, fps_best, mrays_median, ns_per_pixel, .. } in &entry.results {
            assert!(0.0 < *fps_median && fps_median <= fps_best);
            assert!((fps_median * ns_per_pixel * 24.0 * 24.0 * 1e-9 - 1.0).abs() < 1e-9);
            assert!((mrays_median / fps_median - entry.rays as f64 / 3.0 * 1e-6).abs() < 1e-9);
        }
        let wide = Options { kernel: Kernel::X8, ..options };
        let digests = [&options, &wide].map(|o| Path::new(&scene, &description.camera, o).digest());
        assert_eq!(format!("{:016x}", digests[0].1), entry.digest);
        assert_eq!(digests[0], digests[1], "the same at every width");
        let shorter = Options { frames: 2, ..options };
        assert_ne!(Path::new(&scene, &description.camera, &shorter).digest().1, digests[0].1);
    }
}
