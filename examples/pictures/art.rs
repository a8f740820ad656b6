//! The pictures of the built-in scenes, by noise: no photograph, so nobody's but ours.
use std::f64::consts::{PI, TAU};

type Rgb = [f64; 3];

/// A tiling wall, 256 × 256, sRGB.
pub fn brick() -> Vec<[u8; 3]> {
    const SIZE: i64 = 256;
    picture(SIZE, SIZE, |x, y| {
        // Noise moves the edges a little; bricks are 64 × 32, every other row is shifted by half of one.
        let bend = |seed| 1.5 * (tiled(x / 16.0, y / 16.0, 16, seed) - 0.5);
        let (px, py) = (x + bend(1), y + bend(2));
        let row = (py / 32.0).floor();
        let px = px + 32.0 * row.rem_euclid(2.0);
        let column = (px / 64.0).floor();
        let id = hash(column.rem_euclid(4.0) as i64, row.rem_euclid(8.0) as i64, 0, 3);
        let (dx, dy) = (px - 64.0 * column, py - 32.0 * row);
        let inside = dx.min(64.0 - dx).min(dy).min(32.0 - dy);
        let grain = octaves(4, |f, seed| tiled(x * f / 16.0, y * f / 16.0, (16.0 * f) as i64, 10 + seed));
        let fired = mix([0.45, 0.17, 0.11], [0.66, 0.30, 0.19], id);
        let fired =
            mix(fired, [0.36, 0.20, 0.17], step(0.8, 0.95, hash(column.rem_euclid(4.0) as i64, row as i64 & 7, 1, 3)));
        let face = scale(fired, 0.5 + 0.95 * grain);
        let mortar = scale([0.62, 0.59, 0.55], 0.8 + 0.35 * grain);
        // The upper left edges catch the light, the lower right ones lie in shade.
        let lit = step(5.0, 2.0, dx.min(dy)) - step(5.0, 2.0, (64.0 - dx).min(32.0 - dy));
        mix(mortar, scale(face, 1.0 + 0.18 * lit), step(1.3, 2.8, inside + 1.2 * (grain - 0.5)))
    })
}

/// A planet's map, 512 × 256, equirectangular, sRGB.
pub fn globe() -> Vec<[u8; 3]> {
    let (width, height) = (512, 256);
    picture(width, height, |x, y| {
        let p = on_sphere(x / width as f64, y / height as f64);
        let warp = [0, 1, 2].map(|k| solid(scale(p, 2.0), 20 + k) - 0.5);
        let q = [0, 1, 2].map(|k| p[k] + 0.45 * warp[k]);
        let relief = octaves(6, |f, seed| solid(scale(q, 1.7 * f), 30 + seed));
        let detail = octaves(4, |f, seed| solid(scale(p, 9.0 * f), 40 + seed));
        let land = (relief - 0.525) * 5.0;
        let latitude = p[1].abs() + 0.12 * (detail - 0.5);
        let sea = mix([0.02, 0.09, 0.27], [0.06, 0.32, 0.48], step(-0.55, 0.0, land).powi(2));
        let dry = step(0.18, 0.30, latitude) * step(0.62, 0.42, latitude) * step(0.40, 0.60, detail);
        let green = mix([0.10, 0.31, 0.09], [0.30, 0.38, 0.16], step(0.35, 0.7, latitude));
        let low = mix(green, [0.71, 0.58, 0.35], dry);
        let high = mix([0.42, 0.34, 0.25], [0.80, 0.79, 0.78], step(0.85, 1.15, land + 0.4 * (detail - 0.5)));
        let ground = mix(low, high, step(0.38, 0.85, land + 0.5 * (detail - 0.5)));
        let ground = scale(ground, 0.85 + 0.3 * detail);
        let beach = mix([0.76, 0.69, 0.47], ground, step(0.0, 0.07, land));
        let surface = mix(sea, beach, step(-0.012, 0.012, land));
        let ice = step(0.925, 0.955, latitude + 0.05 * land.clamp(-1.0, 1.0));
        mix(surface, scale([0.91, 0.94, 0.97], 0.95 + 0.08 * detail), ice)
    })
}

/// A sky after sunset, 256 × 128, equirectangular, linear radiance. The sun stands a little to the right of −z.
pub fn dusk() -> Vec<[f32; 3]> {
    let (width, height) = (256, 128);
    let sun = unit([0.38, 0.075, -0.92]);
    pixels(width, height, |x, y| {
        let d = on_sphere(x / width as f64, y / height as f64);
        let toward = dot(d, sun);
        let up = d[1].max(0.0);
        let warm = (0.5 + 0.5 * toward).powi(3);
        let low = mix([0.55, 0.38, 0.48], [2.30, 0.90, 0.28], warm);
        let middle = mix([0.25, 0.28, 0.58], [1.10, 0.52, 0.46], warm);
        let air = mix(mix(low, middle, step(0.0, 0.34, up)), [0.07, 0.14, 0.40], step(0.10, 0.95, up));
        let glow = (18.0 * (toward - 1.0)).exp();
        let disc = 36.0 * step(0.99935, 0.99975, toward);
        let sky = add(add(air, scale([1.5, 0.62, 0.18], glow)), scale([1.0, 0.62, 0.28], disc));
        // Clouds on a flat layer, thinned out towards the horizon, lit from the sun's side.
        let layer = [d[0] / (up + 0.10), 0.0, d[2] / (up + 0.10)];
        let drawn = [1.1 * layer[0], 0.0, 2.4 * layer[2]];
        let density = octaves(5, |f, seed| solid(scale(drawn, 0.5 * f), 50 + seed));
        let cover = step(0.46, 0.66, density) * step(0.015, 0.14, up) * 0.85;
        let cloud = add(mix([0.34, 0.27, 0.40], [1.90, 0.70, 0.40], warm), scale([1.2, 0.6, 0.3], 0.7 * glow));
        let sky = mix(sky, scale(cloud, 0.75 + 0.7 * (0.66 - density)), cover);
        // Hills along the horizon, dark ground below.
        let ridge = 0.012 + 0.05 * octaves(4, |f, seed| solid(scale(unit([d[0], 0.0, d[2]]), 3.0 * f), 60 + seed));
        let ground = mix([0.060, 0.050, 0.052], [0.210, 0.115, 0.075], warm * step(-0.6, 0.0, d[1]));
        mix(ground, sky, step(ridge - 0.015, ridge + 0.015, d[1]))
    })
    .map(|rgb| rgb.map(|c| c as f32))
    .collect()
}

/// The values at the pixels' centres, row by row.
fn pixels(width: i64, height: i64, color: impl Fn(f64, f64) -> Rgb) -> impl Iterator<Item = Rgb> {
    (0..width * height).map(move |i| color((i % width) as f64 + 0.5, (i / width) as f64 + 0.5))
}

fn picture(width: i64, height: i64, color: impl Fn(f64, f64) -> Rgb) -> Vec<[u8; 3]> {
    pixels(width, height, color).map(|rgb| rgb.map(|c| (c.clamp(0.0, 1.0) * 255.0).round() as u8)).collect()
}

/// The direction that a panorama shows at (u, v), v from the top.
fn on_sphere(u: f64, v: f64) -> Rgb {
    let (longitude, polar) = ((u - 0.5) * TAU, v * PI);
    [polar.sin() * longitude.sin(), polar.cos(), -polar.sin() * longitude.cos()]
}

/// A number from 0 to 1 for a lattice point.
fn hash(x: i64, y: i64, z: i64, seed: u64) -> f64 {
    let mut h = seed.wrapping_mul(0x9e37_79b9_7f4a_7c15);
    for k in [x, y, z] {
        h = (h ^ k as u64).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        h ^= h >> 29;
    }
    (h >> 11) as f64 / (1u64 << 53) as f64
}

/// Smooth noise from 0 to 1 in the plane that repeats after `period` lattice steps.
fn tiled(x: f64, y: f64, period: i64, seed: u64) -> f64 {
    lattice([x, y, 0.0], |i, j, _| hash(i.rem_euclid(period), j.rem_euclid(period), 0, seed))
}

/// Smooth noise from 0 to 1 in space.
fn solid(p: Rgb, seed: u64) -> f64 {
    lattice(p, |i, j, k| hash(i, j, k, seed))
}

/// Between the eight lattice points around p, with a smooth weight.
fn lattice(p: Rgb, value: impl Fn(i64, i64, i64) -> f64) -> f64 {
    let [i, j, k] = p.map(|c| c.floor() as i64);
    let [x, y, z] = p.map(|c| step(0.0, 1.0, c - c.floor()));
    let line = |j, k| value(i, j, k) * (1.0 - x) + value(i + 1, j, k) * x;
    let face = |k| line(j, k) * (1.0 - y) + line(j + 1, k) * y;
    face(k) * (1.0 - z) + face(k + 1) * z
}

/// Noise of `count` scales, each half as large and as strong as the one before; `noise` gets the frequency and a seed.
fn octaves(count: i32, noise: impl Fn(f64, u64) -> f64) -> f64 {
    let all: f64 = (0..count).map(|i| noise(2f64.powi(i), i as u64) / 2f64.powi(i)).sum();
    all / (2.0 - 2f64.powi(1 - count))
}

/// 0 up to a, 1 from b on, smooth between; b may be less than a.
fn step(a: f64, b: f64, x: f64) -> f64 {
    let t = ((x - a) / (b - a)).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

fn mix(a: Rgb, b: Rgb, t: f64) -> Rgb {
    [0, 1, 2].map(|k| a[k] + t * (b[k] - a[k]))
}

fn scale(a: Rgb, s: f64) -> Rgb {
    a.map(|c| c * s)
}

fn add(a: Rgb, b: Rgb) -> Rgb {
    [0, 1, 2].map(|k| a[k] + b[k])
}

fn dot(a: Rgb, b: Rgb) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn unit(a: Rgb) -> Rgb {
    scale(a, 1.0 / dot(a, a).sqrt())
}
