//! Pictures that are no multiple of anything.

use raypacket::measure::verify::verify;
use raypacket::render::{Film, Kernel, render};
use raypacket::scene::load;

use crate::common::{compiled, film_bits, picture};

#[test]
fn a_pixel_a_column_a_strip() {
    right_at(&[[1, 1], [1, 500], [17, 3], [16, 16], [15, 33]]);
}

#[test]
fn a_row() {
    right_at(&[[500, 1]]);
}

fn right_at(sizes: &[[usize; 2]]) {
    let scene = load("classic").expect("a built-in scene");
    for &[width, height] in sizes {
        let report = verify(&scene, &Kernel::ALL, width, height);
        assert!(report.pass && report.identical, "{width} × {height}: {report:?}");
        let film = picture(&scene, Kernel::X8, width, height);
        assert_eq!(film.pixels.len(), width * height);
        assert!(film.pixels.iter().all(|p| *p != [0.0; 3]), "ambient light and sky leave nothing black");
    }
}

#[test]
fn nothing_at_all() {
    let scene = compiled(&load("classic").expect("a built-in scene"));
    let camera = raypacket::render::Camera::new(&Default::default(), 1.0);
    for [width, height] in [[0, 0], [0, 5], [5, 0]] {
        let counts = render(&scene, &camera, Kernel::X8, 1, &mut Film::new(width, height), &|_| ());
        assert_eq!(counts.total(), 0);
    }
}

/// No samples are one sample.
#[test]
fn at_least_one_sample() {
    let description = load("hall").expect("a built-in scene");
    let camera = raypacket::render::Camera::new(&description.camera, 1.0);
    let film = |samples| {
        let mut film = Film::new(20, 20);
        render(&compiled(&description), &camera, Kernel::X8, samples, &mut film, &|_| ());
        film_bits(&film)
    };
    assert_eq!(film(0), film(1));
}
