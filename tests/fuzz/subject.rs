//! What is done with a file: read it, compile what it describes, trace a few rays.

use std::path::Path;

use raypacket::{
    math::Lanes,
    render::{Camera, Film, Kernel, render},
    scene::{self, Description, Scene, Structure},
    trace::{Blocked, HitBatch, NONE, RayBatch, Scratch, intersect, occluded},
};
use wide::f32x8;

/// The picture's size; its rays are traced by themselves as well.
const SIZE: [usize; 2] = [5, 4];

/// The longest message: what it quotes is cut, but it may name several files.
const MAX_MESSAGE: usize = 4000;

/// How many rays hit something, or why the file is refused. `read` is called when it has been read.
pub fn run(path: &Path, read: impl FnOnce()) -> Result<usize, String> {
    let loaded = scene::load(path.to_str().expect("an ordinary path"));
    read();
    let description = loaded.map_err(|error| {
        let message = error.to_string();
        let here = path.parent().expect("a folder").to_str().expect("an ordinary path");
        assert!(message.starts_with(here), "no file in {message:?}");
        assert!(!message.chars().any(char::is_control), "{message:?}");
        assert!(message.len() < MAX_MESSAGE, "{message:?}");
        message
    })?;
    Ok(trace(&description))
}

/// How many rays hit. One at a time without a tree and eight at a time with one find the same, to the bit.
fn trace(description: &Description) -> usize {
    let compile =
        |structure: Structure| scene::compile_with(description, &structure.into()).expect("what is read is sound");
    let [plain, tree] = [Structure::None, Structure::Tree].map(compile);
    let camera = Camera::new(&description.camera, SIZE[0] as f32 / SIZE[1] as f32);
    let rays = rays(&camera);
    let [one, eight] = [answers::<f32>(&plain, &rays), answers::<f32x8>(&tree, &rays)];
    assert_eq!(one, eight);
    let [one, eight] = [picture(&plain, &camera, Kernel::X1), picture(&tree, &camera, Kernel::X8)];
    assert_eq!(one, eight, "pictures");
    answers::<f32x8>(&plain, &rays).iter().filter(|(_, id, _)| *id != NONE).count()
}

/// A ray through the middle of every pixel, and one back.
fn rays(camera: &Camera) -> RayBatch {
    let mut rays = RayBatch::default();
    for i in 0..SIZE[0] * SIZE[1] {
        let along = |at: usize, of: usize| (at as f32 + 0.5) / of as f32;
        let direction = camera.direction(along(i % SIZE[0], SIZE[0]), along(i / SIZE[0], SIZE[1]));
        rays.push(camera.eye, direction, 0.0, f32::INFINITY);
        rays.push(camera.eye, -direction, 0.0, f32::INFINITY);
    }
    rays
}

/// Distances, to the bit, and ids; a ray that has a hit is blocked.
fn answers<L: Lanes>(scene: &Scene, rays: &RayBatch) -> Vec<(u32, u32, u32)> {
    let (mut hits, mut blocked) = (HitBatch::default(), Blocked::default());
    let mut scratch = Scratch::default();
    intersect::<L>(scene, rays, &mut hits, &mut scratch);
    occluded::<L>(scene, rays, &mut blocked, &mut scratch);
    let answer = |i: usize| {
        let (t, id) = (hits.t[i], hits.primitive[i]);
        assert!(t > 0.0 && t.is_finite() == (id != NONE), "ray {i}: {t} {id}");
        // By a side that is not seen as well.
        assert!(blocked.get(i, 1) != 0 || id == NONE, "ray {i}: {t} {id}");
        (t.to_bits(), id, blocked.get(i, 1))
    };
    (0..rays.len).map(answer).collect()
}

/// The picture to the bit, but that one NaN is as good as another.
fn picture(scene: &Scene, camera: &Camera, kernel: Kernel) -> Vec<u32> {
    let mut film = Film::new(SIZE[0], SIZE[1]);
    render(scene, camera, kernel, 1, &mut film, &|_| ());
    film.pixels.as_flattened().iter().map(|c| if c.is_nan() { f32::NAN } else { *c }.to_bits()).collect()
}
