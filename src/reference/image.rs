//! Whole pictures, row by row in the caller's rayon pool.
use super::{Camera, Hit, Tracer};
use crate::scene::Description;
use glam::DVec3;
use rayon::prelude::*;
use std::sync::atomic::{AtomicUsize, Ordering};

/// Linear radiance per pixel, row by row from the top: the mean of a regular `samples` × `samples` grid.
pub fn render(scene: &Description, width: usize, height: usize, samples: u32) -> Vec<DVec3> {
    render_with_progress(scene, width, height, samples, &|_| ())
}

/// As [`render`]; `progress` is called now and then with the share done, 0 to 1, from any thread.
pub fn render_with_progress(
    scene: &Description,
    width: usize,
    height: usize,
    samples: u32,
    progress: &(dyn Fn(f32) + Sync),
) -> Vec<DVec3> {
    let done = AtomicUsize::new(0);
    let tracer = Tracer::new(scene);
    let offsets: Vec<f64> = (0..samples).map(|i| (f64::from(i) + 0.5) / f64::from(samples)).collect();
    let weight = 1.0 / (f64::from(samples) * f64::from(samples));
    let camera = Camera::new(&scene.camera, width as f64 / height as f64);
    per_pixel(width, height, |x, y| {
        if x == 0.0 {
            progress(done.fetch_add(1, Ordering::Relaxed) as f32 / height as f32);
        }
        let grid = offsets.iter().flat_map(|dy| offsets.iter().map(move |dx| (dx, dy)));
        let sum: DVec3 = grid
            .map(|(dx, dy)| {
                let (eye, direction) = camera.ray((x + dx) / width as f64, (y + dy) / height as f64);
                tracer.radiance(eye, direction)
            })
            .sum();
        sum * weight
    })
}

/// The nearest hits of the rays through the pixels' centres, row by row from the top.
pub fn hits(scene: &Description, width: usize, height: usize) -> Vec<Option<Hit>> {
    let tracer = Tracer::new(scene);
    let camera = Camera::new(&scene.camera, width as f64 / height as f64);
    per_pixel(width, height, |x, y| {
        let (eye, direction) = camera.ray((x + 0.5) / width as f64, (y + 0.5) / height as f64);
        tracer.intersect(eye, direction, f64::INFINITY)
    })
}

/// `value` for every pixel's left and top edge, counted in pixels.
fn per_pixel<T: Send>(width: usize, height: usize, value: impl Fn(f64, f64) -> T + Sync) -> Vec<T> {
    let row = |y: usize| -> Vec<T> { (0..width).map(|x| value(x as f64, y as f64)).collect() };
    (0..height).into_par_iter().flat_map_iter(row).collect()
}
