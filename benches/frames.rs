//! Whole frames on one thread: all rays, shading, and the way to the display. Throughput counts rays of all kinds.

mod common;

use std::hint::black_box;

use criterion::{BenchmarkId, Criterion, SamplingMode, Throughput, criterion_group, criterion_main};
use raypacket::measure::verify::verify;
use raypacket::render::{Camera, Kernel, render_display};
use raypacket::scene::{compile, load};

const SIZE: [usize; 2] = [256, 128];

fn frames(criterion: &mut Criterion) {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build().expect("a pool");
    for name in ["classic", "hall"] {
        let [width, height] = SIZE;
        let description = load(name).expect("a built-in scene");
        let report = verify(&description, &Kernel::ALL, width / 4, height / 4);
        assert!(report.pass, "{name} agrees with the reference: {report:?}");
        let scene = compile(&description).expect("a sound scene");
        let camera = Camera::new(&description.camera, width as f32 / height as f32);
        let mut pixels = vec![0; width * height];
        let first = pool.install(|| render_display(&scene, &camera, Kernel::X1, width, height, &mut pixels));
        let expected = pixels.clone();
        let mut group = criterion.benchmark_group(format!("frames/{name}"));
        group.sampling_mode(SamplingMode::Flat).throughput(Throughput::Elements(first.total()));
        for kernel in Kernel::ALL {
            let mut frame = || render_display(&scene, &camera, kernel, width, height, black_box(&mut pixels));
            let counts = pool.install(&mut frame);
            group.bench_function(BenchmarkId::from_parameter(kernel.name()), |b| {
                pool.install(|| b.iter(&mut frame));
            });
            assert!(pixels == expected && counts == first, "{name}: {} shows what x1 shows", kernel.name());
        }
    }
}

criterion_group! { name = benches; config = common::short(); targets = frames }
criterion_main!(benches);
