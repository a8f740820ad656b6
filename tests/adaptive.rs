//! Adaptive samples against the full grid.

use raypacket::render::{ALIKE, Camera, Film, Kernel, render, render_adaptive};
use raypacket::{scene, tone_map};

/// The share of the full grid's rays, the greatest difference in display codes, and how many pixels differ by more than 2.
fn compare(name: &str, [width, height]: [usize; 2], codes: u8) -> (f64, u8, usize) {
    let description = scene::load(name).expect("a scene");
    let compiled = scene::compile(&description).expect("it compiles");
    let camera = Camera::new(&description.camera, width as f32 / height as f32);
    let [mut full, mut adaptive] = [Film::new(width, height), Film::new(width, height)];
    let all = render(&compiled, &camera, Kernel::X8, 4, &mut full, &|_| ()).total();
    let some = render_adaptive(&compiled, &camera, Kernel::X8, codes, &mut adaptive, &|_| ()).total();
    let off = |(a, b): (&[f32; 3], &[f32; 3])| {
        let [a, b] = [a, b].map(|rgb| tone_map(*rgb).to_be_bytes());
        (0..4).map(|i| a[i].abs_diff(b[i])).max().unwrap_or(0)
    };
    let offs: Vec<u8> = full.pixels.iter().zip(&adaptive.pixels).map(off).collect();
    let worst = offs.iter().copied().max().expect("pixels");
    (some as f64 / all as f64, worst, offs.iter().filter(|&&off| off > 2).count())
}

#[test]
fn classic_needs_half_the_rays_and_no_pixel_is_off_by_more_than_two_codes() {
    let (share, worst, _) = compare("classic", [1024, 512], ALIKE);
    assert!(share <= 0.5 && worst <= 2, "{share:.3} of the rays, {worst} codes");
}

/// The tolerance buys rays.
#[test]
fn the_more_may_differ_the_fewer_rays() {
    let [fine, usual, coarse] = [1, ALIKE, 20].map(|codes| compare("classic", [256, 128], codes));
    assert!(fine.0 > usual.0 && usual.0 > coarse.0, "{} {} {}", fine.0, usual.0, coarse.0);
    assert!(fine.1 <= 1 && coarse.1 > 2, "{} {}", fine.1, coarse.1);
}

/// Scenes with sparks and with edges everywhere: what is missed is rare.
#[test]
fn elsewhere_few_pixels_are_off() {
    for (name, most) in [("hall", 10), ("primitives", 10), ("glass", 10), ("sky", 10), ("textures", 0)] {
        let (share, _, off) = compare(name, [512, 256], ALIKE);
        assert!(share < 1.0 && off <= most, "{name}: {share:.3} of the rays, {off} pixels");
    }
}

/// The width of the packets, the threads and the edges of the picture change no bit.
#[test]
fn every_kernel_gives_the_same_bits() {
    let description = scene::load("classic").expect("a scene");
    let compiled = scene::compile(&description).expect("it compiles");
    let camera = Camera::new(&description.camera, 1.5);
    let draw = |kernel, threads| {
        let mut film = Film::new(75, 50);
        let pool = raypacket::rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
        pool.install(|| render_adaptive(&compiled, &camera, kernel, ALIKE, &mut film, &|_| ()));
        film.pixels.iter().flatten().map(|channel| channel.to_bits()).collect::<Vec<_>>()
    };
    let once = draw(Kernel::X1, 1);
    assert!(once == draw(Kernel::X4, 2) && once == draw(Kernel::X8, 3));
}

/// Where all looks alike, four rays are enough; where nothing does, the picture is the full grid's.
#[test]
fn the_ends_of_the_range() {
    let sky = scene::compile(&raypacket::Description::default()).expect("it compiles");
    let mut film = Film::new(20, 20);
    let camera = Camera::look_at([0.0, 0.0, 0.0], [0.0, 0.0, -1.0], 45.0, 1.0);
    let rays = render_adaptive(&sky, &camera, Kernel::X8, ALIKE, &mut film, &|_| ()).total();
    assert_eq!(rays, 4 * 400);

    let board = r#"
        camera = { eye = [0, 0, 1], look_at = [0, 0, 0], fov = 90 }
        settings.ambient = [1, 1, 1]
        materials.board.checker = { colors = [[1, 1, 1], [0, 0, 0]], size = 0.02 }
        plane = [{ normal = [0, 0, 1], distance = 0, material = "board" }]
    "#;
    let description = scene::parse(board, "board.toml".as_ref()).expect("a scene");
    let compiled = scene::compile(&description).expect("it compiles");
    let camera = Camera::new(&description.camera, 1.0);
    let [mut full, mut adaptive] = [Film::new(40, 40), Film::new(40, 40)];
    let all = render(&compiled, &camera, Kernel::X8, 4, &mut full, &|_| ()).total();
    assert_eq!(render_adaptive(&compiled, &camera, Kernel::X8, ALIKE, &mut adaptive, &|_| ()).total(), all);
    for (a, b) in full.pixels.iter().flatten().zip(adaptive.pixels.iter().flatten()) {
        assert!((a - b).abs() < 1e-6, "{a} {b}");
    }
}
