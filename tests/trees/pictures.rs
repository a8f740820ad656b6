//! Whole pictures with the tree and without it.

use raypacket::render::{Camera, Film, Kernel, render};
use raypacket::scene::{Description, Scene, Structure, compile_with};

use crate::common::{all_builtins, film_bits};

/// Compiles the scene with a structure, whatever its plan says.
pub fn compiled(description: &Description, structure: Structure) -> Scene {
    let scene = compile_with(description, &structure.into()).unwrap_or_else(|e| panic!("a sound scene: {e}"));
    assert_eq!(scene.bvh.is_some(), structure == Structure::Tree);
    scene
}

/// One sample a pixel, in the caller's pool.
pub fn picture(description: &Description, scene: &Scene, kernel: Kernel, [width, height]: [usize; 2]) -> Film {
    let camera = Camera::new(&description.camera, width as f32 / height as f32);
    let mut film = Film::new(width, height);
    render(scene, &camera, kernel, 1, &mut film, &|_| ());
    film
}

/// With everything that a picture takes: reflection, refraction, shadows from lights and from points. Scenes are compiled
/// in the pool that renders them, so that trees built by one and by two threads are compared, too.
#[test]
fn every_built_in_scene_looks_the_same() {
    // Six tiles, of which three are cut.
    let size = [40, 20];
    let pools = [1, 2].map(|n| rayon::ThreadPoolBuilder::new().num_threads(n).build().expect("a pool"));
    for description in all_builtins() {
        let mut wanted = None;
        for structure in [Structure::None, Structure::Tree] {
            for (pool, threads) in pools.iter().zip(1..) {
                let scene = pool.install(|| compiled(&description, structure));
                for kernel in Kernel::ALL {
                    let film = pool.install(|| picture(&description, &scene, kernel, size));
                    let bits = film_bits(&film);
                    let wanted = wanted.get_or_insert_with(|| bits.clone());
                    let differ = bits.iter().zip(&*wanted).filter(|(a, b)| a != b).count();
                    let name = &description.name;
                    assert!(
                        differ == 0,
                        "{name}, {structure:?}, {threads} threads, {kernel:?}: {differ} values differ"
                    );
                }
            }
        }
        let mut different = wanted.expect("a picture");
        different.sort_unstable();
        different.dedup();
        assert!(different.len() > 50, "{}: there is something to see", description.name);
    }
}
