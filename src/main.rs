//! The command line; see `cli`.
use std::path::Path;
fn main() {
    let a: Vec<String> = std::env::args().collect();
    let d = raypacket::scene::load(&a[2]).unwrap();
    match a[1].as_str() {
        "bench" => {
            let rays = a.get(3).map(|p| Path::new(p).to_path_buf());
            let o = raypacket::measure::bench::Options { rays, ..Default::default() };
            let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build().unwrap();
            println!("{}", pool.install(|| raypacket::measure::bench::run(&d, &o).unwrap()));
        }
        "verify" => println!("{}", raypacket::measure::verify::verify(&d, &raypacket::render::Kernel::ALL, 256, 128)),
        _ => {
            let s = raypacket::scene::compile(&d).unwrap();
            let c = raypacket::render::Camera::new(&d.camera, 2.0);
            let mut px = vec![0u32; 1024 * 512];
            raypacket::render::render_display(&s, &c, Default::default(), 1024, 512, &mut px);
            let b: Vec<u8> = px.iter().flat_map(|p| [(p >> 16) as u8, (p >> 8) as u8, *p as u8]).collect();
            image::save_buffer(&a[3], &b, 1024, 512, image::ExtendedColorType::Rgb8).unwrap();
        }
    }
}
