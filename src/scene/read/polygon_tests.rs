use std::{f32::consts::TAU, time::Instant};

use super::*;

fn flat(points: &[[f32; 2]]) -> Vec<Vec3> {
    points.iter().map(|[x, y]| Vec3::new(*x, *y, 0.0)).collect()
}

/// Points around a circle, at the radius that `radius` gives for each.
fn round(n: usize, radius: impl Fn(usize) -> f32) -> Vec<Vec3> {
    (0..n)
        .map(|i| Vec3::new((TAU * i as f32 / n as f32).cos(), (TAU * i as f32 / n as f32).sin(), 0.0) * radius(i))
        .collect()
}

fn newell(points: &[Vec3]) -> DVec3 {
    let p = |i: usize| points[i % points.len()].as_dvec3() - points[0].as_dvec3();
    (0..points.len()).map(|i| p(i).cross(p(i + 1))).sum::<DVec3>() / 2.0
}

/// Checks that the triangles are n − 2, oriented as the polygon, and cover its area once: as the sum of their
/// signed areas is the polygon's in any case, they overlap nowhere if none is turned over.
#[track_caller]
fn divides(points: &[Vec3]) -> Vec<[u32; 3]> {
    let triangles = triangulate(points).unwrap();
    assert_eq!(triangles.len(), points.len() - 2);
    let whole = newell(points);
    let mut sum = 0.0;
    for t in &triangles {
        let part = newell(&t.map(|i| points[i as usize])).dot(whole.normalize());
        assert!(part >= -1e-7 * whole.length(), "{t:?} is turned over: {part:e}");
        sum += part.abs();
    }
    assert!((sum - whole.length()).abs() <= 1e-6 * whole.length(), "{sum} of {}", whole.length());
    triangles
}

/// As given, reversed, from every corner on (for small ones), and tilted.
#[track_caller]
fn divides_anyhow(points: &[Vec3]) {
    let mut turned = points.to_vec();
    for _ in 0..points.len().min(30) {
        turned.rotate_left(1);
        divides(&turned);
        let reversed: Vec<Vec3> = turned.iter().rev().copied().collect();
        divides(&reversed);
        let tilt = glam::Mat3::from_euler(glam::EulerRot::XYZ, 0.7, 1.1, 0.3);
        divides(&turned.iter().map(|p| tilt * *p + Vec3::new(3.0, -7.0, 1.0)).collect::<Vec<_>>());
    }
}

#[test]
fn what_is_convex_becomes_a_fan() {
    assert_eq!(triangulate(&flat(&[[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]])).unwrap(), [[0, 1, 2]]);
    let square = flat(&[[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]]);
    assert_eq!(triangulate(&square).unwrap(), [[0, 1, 2], [0, 2, 3]]);
    let clockwise: Vec<Vec3> = square.iter().rev().copied().collect();
    assert_eq!(triangulate(&clockwise).unwrap(), [[0, 1, 2], [0, 2, 3]]);
    let ring = divides(&round(100, |_| 1.0));
    assert!(ring.iter().enumerate().all(|(i, t)| *t == [0, i as u32 + 1, i as u32 + 2]));
}

#[test]
fn concave_polygons_keep_area_and_orientation() {
    divides_anyhow(&flat(&[[0.0, 0.0], [2.0, 0.0], [0.5, 0.5], [0.0, 2.0]]));
    divides_anyhow(&flat(&[[0.0, 0.0], [3.0, 0.0], [3.0, 1.0], [1.0, 1.0], [1.0, 3.0], [0.0, 3.0]]));
    divides_anyhow(&round(10, |i| if i % 2 == 0 { 1.0 } else { 0.3 }));
    // A gear: four corners a tooth.
    divides_anyhow(&round(144, |i| if i % 4 < 2 { 1.0 } else { 0.9 }));
    // A comb, and a spiral.
    let comb = (0..40).map(|i| [i as f32, if i % 2 == 0 { 0.1 } else { 5.0 }]).chain([[39.0, 0.0], [0.0, 0.0]]);
    divides_anyhow(&flat(&comb.collect::<Vec<_>>()));
    let arm = |i: usize, off: f32| {
        Vec3::new((i as f32 * 0.2).cos(), (i as f32 * 0.2).sin(), 0.0) * (1.0 + i as f32 * 0.1 + off)
    };
    let spiral: Vec<Vec3> = (0..200).map(|i| arm(i, 0.0)).rev().chain((0..200).map(|i| arm(i, 1.0))).collect();
    divides_anyhow(&spiral);
}

#[test]
fn repeated_and_collinear_corners_count() {
    // An L with every edge divided, and corners that repeat.
    let l = [[0.0, 0.0], [1.0, 0.0], [3.0, 0.0], [3.0, 1.0], [3.0, 1.0], [2.0, 1.0], [1.0, 1.0], [1.0, 1.0]];
    let rest = [[1.0, 1.0], [1.0, 2.0], [1.0, 3.0], [0.5, 3.0], [0.0, 3.0], [0.0, 1.5], [0.0, 0.0]];
    divides_anyhow(&flat(&[&l[..], &rest[..]].concat()));
    // Spikes without area, outward and inward.
    divides_anyhow(&flat(&[[0.0, 0.0], [1.0, 0.0], [2.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]]));
    divides_anyhow(&flat(&[[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [1.0, 1.0], [2.0, 1.0], [2.0, 2.0], [0.0, 2.0]]));
    // A square with a square hole, entered and left by a bridge, in one piece or two.
    let outer = [[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [0.0, 4.0], [0.0, 0.0]];
    let hole = [[1.0, 1.0], [1.0, 3.0], [3.0, 3.0], [3.0, 1.0], [1.0, 1.0]];
    divides_anyhow(&flat(&[&outer[..], &hole[..]].concat()));
    divides_anyhow(&flat(&[&outer[..], &[[0.5, 0.5]], &hole[..], &[[0.5, 0.5]]].concat()));
    // Two squares that touch at a corner.
    divides_anyhow(&flat(&[
        [0.0, 0.0],
        [1.0, 0.0],
        [1.0, 1.0],
        [2.0, 1.0],
        [2.0, 2.0],
        [1.0, 2.0],
        [1.0, 1.0],
        [0.0, 1.0],
    ]));
}

#[test]
fn slightly_bent_polygons_are_divided() {
    let bent: Vec<Vec3> = round(60, |i| if i % 3 == 0 { 0.5 } else { 1.0 })
        .into_iter()
        .enumerate()
        .map(|(i, p)| p + Vec3::Z * 0.01 * (i % 7) as f32)
        .collect();
    let triangles = triangulate(&bent).unwrap();
    assert_eq!(triangles.len(), 58);
    assert!(triangles.iter().all(|t| newell(&t.map(|i| bent[i as usize])).z > -1e-3));
}

#[test]
fn what_has_no_area_is_refused() {
    assert_eq!(triangulate(&[]), None);
    assert_eq!(triangulate(&[Vec3::X]), None);
    assert_eq!(triangulate(&[Vec3::X, Vec3::Y]), None);
    assert_eq!(triangulate(&[Vec3::ONE; 5]), None);
    assert_eq!(triangulate(&flat(&[[0.0, 0.0], [1.0, 1.0], [2.0, 2.0], [3.0, 3.0]])), None);
    assert_eq!(triangulate(&flat(&[[0.0, 0.0], [1.0, 1.0], [1.0, 0.0], [0.0, 1.0]])), None, "a bow tie");
    assert_eq!(triangulate(&flat(&[[0.0, 0.0], [f32::NAN, 1.0], [1.0, 0.0]])), None);
    assert_eq!(triangulate(&flat(&[[0.0, 0.0], [f32::INFINITY, 0.0], [1.0, 2.0]])), None);
}

#[test]
fn size_and_place_do_not_matter() {
    let star = round(50, |i| if i % 2 == 0 { 1.0 } else { 0.4 });
    let bits = |points: &[Vec3]| triangulate(points).unwrap();
    for scale in [2.0_f32.powi(-60), 2.0_f32.powi(-20), 2.0_f32.powi(39)] {
        assert_eq!(bits(&star.iter().map(|p| *p * scale).collect::<Vec<_>>()), bits(&star));
    }
    divides(&star.iter().map(|p| *p + Vec3::new(1e4, 2e4, 3e4)).collect::<Vec<_>>());
}

/// A generator of numbers (SplitMix64), in 0 to 1.
fn random(state: &mut u64) -> f32 {
    *state = state.wrapping_add(0x9e37_79b9_7f4a_7c15);
    let z = (*state ^ (*state >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    ((z ^ (z >> 31)) >> 40) as f32 / (1 << 24) as f32
}

#[test]
fn random_stars_are_divided_and_random_scribbles_end() {
    let mut state = 1;
    for case in 0..2000 {
        let n = 3 + case % 60;
        let radii: Vec<f32> = (0..n).map(|_| 0.05 + random(&mut state)).collect();
        if n > 4 {
            divides(&round(n, |i| radii[i]));
        }
        // A coarse grid repeats corners and edges, and crosses itself.
        let scribble: Vec<Vec3> = (0..n)
            .map(|_| Vec3::new((random(&mut state) * 5.0).floor(), (random(&mut state) * 5.0).floor(), 0.0))
            .collect();
        if let Some(triangles) = triangulate(&scribble) {
            assert_eq!(triangles.len(), n - 2);
        }
    }
}

#[test]
fn ten_thousand_corners_take_no_time() {
    let mut state = 7;
    let n = 10_000;
    let jagged: Vec<f32> = (0..n).map(|_| 0.05 + random(&mut state)).collect();
    let comb =
        (0..n - 2).map(|i| [i as f32, if i % 2 == 0 { 0.1 } else { 5000.0 }]).chain([[n as f32, 0.0], [0.0, 0.0]]);
    let skewed = comb.clone().map(|[x, y]| [x + y, y]);
    let scribble = (0..n).map(|_| [random(&mut state), random(&mut state)]).collect::<Vec<_>>();
    for (name, points) in [
        ("star", round(n, |i| if i % 2 == 0 { 1.0 } else { 0.3 })),
        ("jagged", round(n, |i| jagged[i])),
        ("comb", flat(&comb.collect::<Vec<_>>())),
        ("skewed comb", flat(&skewed.collect::<Vec<_>>())),
        ("scribble", flat(&scribble)),
    ] {
        let start = Instant::now();
        assert_eq!(triangulate(&points).unwrap().len(), n - 2);
        let seconds = start.elapsed().as_secs_f64();
        println!("{name}: {seconds:.3} s");
        assert!(seconds < 5.0, "{name}: {seconds} s");
    }
}
