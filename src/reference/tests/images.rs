//! Textures and panoramas against cases worked out by hand.
use super::super::{FACE, around};
use super::*;
use glam::dvec3;

fn texture() -> Texture {
    Texture { width: 2, height: 2, texels: vec![[255, 0, 0], [0, 255, 0], [0, 0, 255], [188; 3]] }
}

fn repeated(texture: &Texture, u: f64, v: f64) -> DVec3 {
    sample(texture, [u, v], [[Edge::None; 2]; 2], 1.0, Wrap::Ends)
}

#[track_caller]
fn at(u: f64, v: f64, expected: DVec3) {
    let got = repeated(&texture(), u, v);
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
    assert!(repeated(&dark, 0.0, 0.0).abs_diff_eq(DVec3::splat(10.0 / 255.0 / 12.92), 1e-12));
}

/// Red and green above blue and grey.
#[test]
fn a_texture_ends_where_the_mapping_does() {
    let grey = DVec3::splat(linear(188.0 / 255.0));
    let seen = |edges: Edges, size: f64, wrap: Wrap, u: f64, v: f64| sample(&texture(), [u, v], edges, size, wrap);
    for (u, v, expected) in [(0.0, 1.0, DVec3::X), (1.0, 1.0, DVec3::Y), (0.0, 0.0, DVec3::Z), (1.0, 0.0, grey)] {
        assert_eq!(seen(FACE, 1.0, Wrap::Ends, u, v), expected, "({u}, {v})");
        assert_eq!(seen(FACE, 0.5, Wrap::Ends, u, v), expected, "({u}, {v}) of two repeats");
        assert_eq!(seen(FACE, 1.0, Wrap::Clamp, 5.0 * u - 2.0, 5.0 * v - 2.0), expected, "({u}, {v}) beyond");
        let mean = (DVec3::ONE + grey) / 4.0;
        assert!(seen(FACE, 1.0, Wrap::Repeat, u, v).abs_diff_eq(mean, 1e-15), "({u}, {v}) repeated");
    }
    // Two repeats meet in the middle as ever, and half a texture ends in its middle.
    assert!(seen(FACE, 0.5, Wrap::Ends, 0.5, 1.0).abs_diff_eq((DVec3::X + DVec3::Y) / 2.0, 1e-15));
    assert_eq!(seen(FACE, 2.0, Wrap::Ends, 1.0, 0.5), DVec3::Z);
    // Around a sphere: one colour at the pole, half of it a quarter of a texel on.
    let ball = around(Edge::Point, Edge::Point);
    let upper = (DVec3::X + DVec3::Y) / 2.0;
    for u in [0.0, 0.2, 0.75] {
        assert!(seen(ball, 1.0, Wrap::Ends, u, 1.0).abs_diff_eq(upper, 1e-15), "{u}");
        assert!(seen(ball, 1.0, Wrap::Ends, u, 0.0).abs_diff_eq((DVec3::Z + grey) / 2.0, 1e-15), "{u}");
    }
    assert!(seen(ball, 1.0, Wrap::Ends, 0.75, 0.875).abs_diff_eq((upper + DVec3::Y) / 2.0, 1e-15));
    assert_eq!(seen(around(Edge::Border, Edge::Border), 1.0, Wrap::Ends, 0.75, 1.0), DVec3::Y);
}

#[test]
fn nothing_is_read_beyond_the_image() {
    let odd = [0.0, -0.0, -1e-300, 1.0 - 1e-16, 1e18, -1e300, f64::NAN, f64::INFINITY, f64::NEG_INFINITY];
    let dome = Dome { width: 3, height: 2, texels: vec![[1.0; 3]; 6], rotation: 400.0 };
    for u in odd {
        for v in odd {
            for edges in [[[Edge::None; 2]; 2], FACE, around(Edge::Point, Edge::Point)] {
                for (size, wrap) in [(1.0, Wrap::Ends), (1e-45, Wrap::Ends), (1e30, Wrap::Ends), (0.3, Wrap::Clamp)] {
                    sample(&texture(), [u, v], edges, size, wrap);
                }
            }
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
