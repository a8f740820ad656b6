//! What the benchmarks share: short runs, and times by the ray.
#![allow(dead_code, reason = "every benchmark program compiles this, and none uses all of it")]

use std::time::{Duration, Instant};

use criterion::measurement::WallTime;
use criterion::{BenchmarkGroup, BenchmarkId, Criterion, SamplingMode, Throughput};

/// Ten samples of under a tenth of a second each.
pub fn short() -> Criterion {
    Criterion::default()
        .without_plots()
        .sample_size(10)
        .warm_up_time(Duration::from_millis(200))
        .measurement_time(Duration::from_millis(800))
}

/// Times `pass`, which works on `rays` rays, and reports the time of one.
pub fn per_ray(group: &mut BenchmarkGroup<'_, WallTime>, id: BenchmarkId, rays: u64, mut pass: impl FnMut()) {
    group.sampling_mode(SamplingMode::Flat).throughput(Throughput::Elements(1));
    group.bench_function(id, |bencher| {
        bencher.iter_custom(|wanted| {
            let passes = wanted.div_ceil(rays);
            let start = Instant::now();
            for _ in 0..passes {
                pass();
            }
            start.elapsed().mul_f64(wanted as f64 / (passes * rays) as f64)
        });
    });
}
