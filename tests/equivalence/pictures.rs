//! Pictures do not depend on the kernel, on the threads, or on the way to the display.

use raypacket::render::{Camera, Film, Kernel, primary_hits, render, render_display, tone_map};
use raypacket::scene::{Scene, load};

use crate::common::{compiled, film_bits};

/// No multiple of a tile's 16 pixels.
const SIZE: [usize; 2] = [70, 45];

/// Everything that is made of a scene in one go.
#[derive(Debug, PartialEq)]
struct Made {
    film: Vec<u32>,
    sampled: Vec<u32>,
    display: Vec<u32>,
    t: Vec<u32>,
    ids: Vec<u32>,
    normals: Vec<u32>,
}

impl Made {
    fn new(scene: &Scene, camera: &Camera, kernel: Kernel) -> Self {
        let [width, height] = SIZE;
        let mut film = Film::new(width, height);
        render(scene, camera, kernel, 1, &mut film, &|_| ());
        let mut sampled = Film::new(19, 17);
        render(scene, camera, kernel, 2, &mut sampled, &|_| ());
        let mut display = vec![0; width * height];
        render_display(scene, camera, kernel, width, height, &mut display);
        let hits = primary_hits(scene, camera, kernel, width, height);
        let toned: Vec<u32> = film.pixels.iter().map(|&p| tone_map(p)).collect();
        assert!(display == toned, "{}: the display shows the film", kernel.name());
        Self {
            film: film_bits(&film),
            sampled: film_bits(&sampled),
            display,
            t: hits.t.iter().map(|t| t.to_bits()).collect(),
            ids: hits.primitive,
            normals: hits.normal.as_flattened().iter().map(|n| n.to_bits()).collect(),
        }
    }
}

fn check(name: &str) {
    let description = load(name).expect("a built-in scene");
    let scene = compiled(&description);
    let camera = Camera::new(&description.camera, SIZE[0] as f32 / SIZE[1] as f32);
    let mut first: Option<Made> = None;
    for threads in [1, 2, 5] {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("a pool");
        for kernel in Kernel::ALL {
            let made = pool.install(|| Made::new(&scene, &camera, kernel));
            let first = first.get_or_insert_with(|| Made::new(&scene, &camera, Kernel::X1));
            assert!(made == *first, "{name}: {} with {threads} threads differs", kernel.name());
        }
    }
    let colors: std::collections::HashSet<_> = first.expect("one was made").display.into_iter().collect();
    assert!(colors.len() > 100, "{name}: there is something to see, in {} colours", colors.len());
}

#[test]
fn classic() {
    check("classic");
}

#[test]
fn flake() {
    check("flake");
}

#[test]
fn hall() {
    check("hall");
}

#[test]
fn cosmos() {
    check("cosmos");
}
