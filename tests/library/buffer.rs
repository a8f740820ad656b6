//! Pictures into memory of one's own: those of a film, watched and stopped.

use std::ops::ControlFlow;
use std::sync::Mutex;

use raypacket::{Camera, Cancelled, Film, Kernel, compile, render, render_into, scene};

const SIZE: [usize; 2] = [70, 37];

#[test]
fn it_holds_the_film_and_tells_how_far_it_is() {
    let description = scene::load("classic").expect("built in");
    let scene = compile(&description).expect("a sound scene");
    let camera = Camera::new(&description.camera, SIZE[0] as f32 / SIZE[1] as f32);
    for samples in [1, 2] {
        let mut film = Film::new(SIZE[0], SIZE[1]);
        let counts = render(&scene, &camera, Kernel::X8, samples, &mut film, &|_| ());
        let (mut pixels, shares) = (vec![[-1.0; 3]; SIZE[0] * SIZE[1]], Mutex::new(Vec::new()));
        let watch = |share| {
            shares.lock().expect("no panic").push(share);
            ControlFlow::Continue(())
        };
        let pool = raypacket::rayon::ThreadPoolBuilder::new().num_threads(1).build().expect("a pool");
        let got = pool.install(|| render_into(&scene, &camera, Kernel::X8, samples, SIZE, &mut pixels, &watch));
        assert_eq!(got, Ok(counts));
        assert!(pixels == film.pixels);
        // 5 × 3 tiles, and the end.
        let wanted: Vec<f32> = (0..=15).map(|done| done as f32 / 15.0).collect();
        assert_eq!(shares.into_inner().expect("no panic"), wanted);
    }
}

#[test]
fn what_is_stopped_leaves_the_rest_as_it_was() {
    let description = scene::load("classic").expect("built in");
    let scene = compile(&description).expect("a sound scene");
    let camera = Camera::new(&description.camera, SIZE[0] as f32 / SIZE[1] as f32);
    let untouched = [-1.0; 3];
    let mut pixels = vec![untouched; SIZE[0] * SIZE[1]];
    let stop = |_| ControlFlow::Break(());
    assert_eq!(render_into(&scene, &camera, Kernel::X8, 1, SIZE, &mut pixels, &stop), Err(Cancelled::default()));
    assert!(pixels.iter().all(|p| *p == untouched));
    let later = |share| if share > 0.5 { ControlFlow::Break(()) } else { ControlFlow::Continue(()) };
    assert!(render_into(&scene, &camera, Kernel::X8, 1, SIZE, &mut pixels, &later).is_err());
    let left = pixels.iter().filter(|p| **p == untouched).count();
    assert!(left > 0 && left < pixels.len(), "{left}");
}

#[test]
fn a_picture_of_nothing_is_done() {
    let scene = compile(&crate::common::empty()).expect("a sound scene");
    let camera = Camera::look_at([0.0; 3], [0.0, 0.0, -1.0], 60.0, 1.0);
    for size in [[0, 0], [0, 5], [5, 0]] {
        let done = render_into(&scene, &camera, Kernel::X8, 1, size, &mut [], &|_| ControlFlow::Continue(()));
        assert!(done.is_ok());
    }
}

#[test]
#[should_panic(expected = "the buffer holds the picture")]
fn a_buffer_of_another_size_is_refused() {
    let scene = compile(&crate::common::empty()).expect("a sound scene");
    let camera = Camera::look_at([0.0; 3], [0.0, 0.0, -1.0], 60.0, 1.0);
    let _ = render_into(&scene, &camera, Kernel::X8, 1, [2, 2], &mut [[0.0; 3]; 3], &|_| ControlFlow::Continue(()));
}
