//! One frame: the 3D view and the slice of the same camera, and how the two share the window.

use super::{draw::Picture, map::Map, slice};
use crate::{
    render::{self, Camera, Counts, Kernel},
    scene::{CameraDescription, Description, Scene},
    shade::{self, Segment},
};
use rayon::prelude::*;
use std::time::{Duration, Instant};

/// Every how many pixels of the middle row a ray is drawn in the slice.
const EVERY: usize = 10;

/// A request for a frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Request {
    /// Where from.
    pub camera: CameraDescription,
    /// At which width.
    pub kernel: Kernel,
    /// The window's width and height.
    pub size: (usize, usize),
    /// The part of the world that the slice covers.
    pub map: Map,
}

/// A finished frame.
#[derive(Clone, Debug, Default)]
pub struct Frame {
    /// The 3D view.
    pub view: Picture,
    /// The 2D view.
    pub slice: Picture,
    /// The width it was traced at.
    pub kernel: Kernel,
    /// The 3D view's rays.
    pub counts: Counts,
    /// How long the 3D view took.
    pub tracing: Duration,
    /// Threads of the pool that traced it.
    pub threads: usize,
}

/// The widths of the 3D view and the slice in a window: halves, of which the view takes the odd pixel.
pub fn panes(width: usize) -> (usize, usize) {
    (width.div_ceil(2), width / 2)
}

impl Frame {
    /// Traces and draws what is asked for, over an earlier frame, whose memory it takes; leaves off when `go_on` says
    /// so. Runs in the caller's pool.
    pub fn paint(
        &mut self,
        scene: &Scene,
        description: &Description,
        request: &Request,
        go_on: &(dyn Fn() -> bool + Sync),
    ) {
        let ((left, right), height) = (panes(request.size.0), request.size.1);
        self.view.resize(left, height);
        self.slice.resize(right, height);
        self.kernel = request.kernel;
        self.threads = rayon::current_num_threads();
        if left == 0 || height == 0 {
            self.counts = Counts::default();
            return;
        }
        let camera = Camera::new(&request.camera, left as f32 / height as f32);
        let start = Instant::now();
        let pixels = &mut self.view.pixels;
        self.counts = render::render_display_while(scene, &camera, request.kernel, [left, height], pixels, go_on);
        self.tracing = start.elapsed();
        if right > 0 {
            let layout = request.map.layout(right, height);
            slice::draw(&mut self.slice, &layout, description, &camera, &middle_row(scene, &camera, left, go_on));
        }
    }

    /// Draws both views side by side on a picture of the window's size. A frame of another size, as the last one
    /// before a resize, is stretched.
    pub fn compose(&self, window: &mut Picture) {
        let (left, right) = panes(window.width);
        window.paste(&self.view, 0, left);
        window.paste(&self.slice, left, right);
    }
}

/// The light paths of every tenth pixel of the screen's middle row.
fn middle_row(scene: &Scene, camera: &Camera, width: usize, go_on: &(dyn Fn() -> bool + Sync)) -> Vec<Segment> {
    let path = |column: usize| {
        if !go_on() {
            return Vec::new();
        }
        let u = ((column * EVERY) as f32 + 0.5) / width as f32;
        shade::path(scene, camera.eye, camera.direction(u, 0.5))
    };
    (0..width.div_ceil(EVERY)).into_par_iter().flat_map_iter(path).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn panes_share_the_width() {
        for width in [0, 1, 2, 3, 1024, 1025] {
            let (left, right) = panes(width);
            assert!(left + right == width && left >= right && left - right <= 1);
        }
    }

    #[test]
    fn both_views_fill_the_window() {
        let mut frame = Frame { view: Picture::new(3, 4), slice: Picture::new(2, 4), ..Frame::default() };
        frame.view.fill(1);
        frame.slice.fill(2);
        for (width, height) in [(5, 4), (1, 1), (0, 0), (64, 1), (7, 33)] {
            let mut window = Picture::new(width, height);
            frame.compose(&mut window);
            for (i, &pixel) in window.pixels.iter().enumerate() {
                assert_eq!(pixel, if i % width < panes(width).0 { 1 } else { 2 });
            }
        }
    }
}
