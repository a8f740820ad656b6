//! Textures and panoramas against cases worked out by hand.
use super::*;
use glam::dvec3;

fn texture() -> Texture {
    Texture { width: 2, height: 2, texels: vec![[255, 0, 0], [0, 255, 0], [0, 0, 255], [188; 3]] }
}

#[track_caller]
fn at(u: f64, v: f64, expected: DVec3) {
    let got = sample(&texture(), DVec2::new(u, v));
    assert!(got.abs_diff_eq(expected, 1e-12), "({u}, {v}): {got}, not {expected}");
}

#[test]
fn a_texture_repeats_and_runs_upward() {
    let grey = DVec3::splat(((188.0_f64 / 255.0 + 0.055) / 1.055).powf(2.4));
    for (du, dv) in [(0.0, 0.0), (1.0, -2.0), (-7.0, 4.0)] {
        at(0.25 + du, 0.75 + dv, DVec3::X);
        at(0.75 + du, 0.75 + dv, DVec3::Y);
        at(0.25 + du, 0.25 + dv, DVec3::Z);
        at(0.75 + du, 0.25 + dv, grey);
        at(0.5 + du, 0.75 + dv, dvec3(0.5, 0.5, 0.0));
        at(du, 0.75 + dv, dvec3(0.5, 0.5, 0.0));
        at(0.25 + du, dv, dvec3(0.5, 0.0, 0.5));
        at(0.375 + du, 0.75 + dv, dvec3(0.75, 0.25, 0.0));
    }
    let dark = Texture { width: 1, height: 1, texels: vec![[10; 3]] };
    assert!(sample(&dark, DVec2::ZERO).abs_diff_eq(DVec3::splat(10.0 / 255.0 / 12.92), 1e-12));
}

#[test]
fn nothing_is_read_beyond_the_image() {
    let odd = [0.0, -0.0, -1e-300, 1.0 - 1e-16, 1e18, -1e300, f64::NAN, f64::INFINITY, f64::NEG_INFINITY];
    let dome = Dome { width: 3, height: 2, texels: vec![[1.0; 3]; 6], rotation: 400.0 };
    for u in odd {
        for v in odd {
            sample(&texture(), DVec2::new(u, v));
            for w in odd {
                panorama(&dome, dvec3(u, v, w));
            }
        }
    }
}

#[test]
fn a_panorama_hangs_the_right_way() {
    let texels = (0..8).map(|i| [(i % 4) as f32, (i / 4) as f32, 0.0]).collect();
    let mut dome = Dome { width: 4, height: 2, texels, rotation: 0.0 };
    let see = |dome: &Dome, x: f64, y: f64, z: f64, column: f64, row: f64| {
        let got = panorama(dome, dvec3(x, y, z).normalize());
        assert!(got.abs_diff_eq(dvec3(column, row, 0.0), 1e-12), "{x} {y} {z}: {got}");
    };
    see(&dome, 0.0, 0.0, -1.0, 1.5, 0.5);
    see(&dome, 1.0, 0.0, 0.0, 2.5, 0.5);
    see(&dome, 1.0, 0.0, -1.0, 2.0, 0.5);
    see(&dome, 1.0, 1.0, 0.0, 2.5, 0.0);
    see(&dome, 1.0, 3.0, 0.0, 2.5, 0.0);
    see(&dome, 1.0, -3.0, 0.0, 2.5, 1.0);
    see(&dome, 0.0, 0.0, 1.0, 1.5, 0.5);
    dome.rotation = 90.0;
    see(&dome, 0.0, 0.0, -1.0, 2.5, 0.5);
    see(&dome, -1.0, 0.0, 0.0, 1.5, 0.5);
}
