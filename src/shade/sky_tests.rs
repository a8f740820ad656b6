use super::*;
use crate::reference::Tracer;
use crate::scene::Description;
use glam::{DVec3, vec3};
use wide::{f32x4, f32x8};

fn random(state: &mut u64) -> f32 {
    *state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
    (*state >> 40) as f32 / (1u64 << 24) as f32
}

fn noise(width: usize, height: usize, rotation: f32) -> Dome {
    let mut state = (width * 31 + height) as u64;
    let mut value = || random(&mut state);
    let texels = (0..width * height).map(|_| [value(), value(), value()]).collect();
    Dome { width, height, texels, rotation }
}

fn seen(sky: &Sky, direction: glam::Vec3) -> glam::Vec3 {
    radiance::<f32>(sky, direction.into()).into()
}

fn exact(sky: &Sky, direction: glam::Vec3) -> DVec3 {
    let scene = Description { sky: sky.clone(), ..Description::default() };
    Tracer::new(&scene).radiance(DVec3::ZERO, direction.as_dvec3())
}

/// Both tracers must see this color there.
#[track_caller]
fn assert_seen(sky: &Sky, direction: glam::Vec3, color: [f32; 3]) {
    let color = glam::Vec3::from(color);
    let (kernel, reference) = (seen(sky, direction), exact(sky, direction).as_vec3());
    assert!(kernel.abs_diff_eq(color, 1e-5), "{direction}: {kernel}, not {color}");
    assert!(reference.abs_diff_eq(color, 1e-5), "{direction}: the reference sees {reference}, not {color}");
}

/// Its columns are told apart by red, its rows by green.
fn chart(rotation: f32) -> Sky {
    let texels = (0..4).flat_map(|row| (0..8).map(move |column| [column as f32, row as f32, 1.0])).collect();
    Sky::Dome(Dome { width: 8, height: 4, texels, rotation }.into())
}

#[test]
fn the_middle_is_ahead_right_is_right_and_up_is_up() {
    let (x, y, z) = (vec3(1.0, 0.0, 0.0), vec3(0.0, 1.0, 0.0), vec3(0.0, 0.0, 1.0));
    let sky = chart(0.0);
    // −z is between columns 3 and 4, the horizon between rows 1 and 2.
    assert_seen(&sky, -z, [3.5, 1.5, 1.0]);
    assert_seen(&sky, x, [5.5, 1.5, 1.0]);
    assert_seen(&sky, -x, [1.5, 1.5, 1.0]);
    assert_seen(&sky, z, [3.5, 1.5, 1.0]); // between 7 and 0
    for (up, row) in [(y, 0.0), (-y, 3.0)] {
        assert_eq!((seen(&sky, up).y, exact(&sky, up).y), (row, f64::from(row)));
        let almost = (up + 0.01 * x).normalize();
        assert_seen(&sky, almost, [5.5, row, 1.0]);
    }
    // 45° down is between rows 2 and 3.
    assert_seen(&sky, (x - y).normalize(), [5.5, 2.5, 1.0]);
}

#[test]
fn rotation_turns_what_is_seen_to_the_left() {
    let x = vec3(1.0, 0.0, 0.0);
    let ahead = vec3(0.0, 0.0, -1.0);
    for rotation in [90.0, 90.0 + 360.0, 90.0 - 720.0, 90.0 + 360_000.0] {
        // What was on the right is ahead, what was ahead is on the left.
        assert_seen(&chart(rotation), ahead, [5.5, 1.5, 1.0]);
        assert_seen(&chart(rotation), -x, [3.5, 1.5, 1.0]);
    }
    assert!(seen(&chart(3e38), ahead).is_finite());
}

#[test]
fn it_agrees_with_the_reference() {
    let mut state = 9;
    for (width, height, rotation) in
        [(1, 1, 0.0), (1, 4, 70.0), (5, 1, -1.0), (2, 2, 33.0), (64, 32, 0.0), (64, 32, -517.3)]
    {
        let sky = Sky::Dome(noise(width, height, rotation).into());
        for i in 0..3000 {
            let mut component = || random(&mut state) - 0.5;
            let mut d = vec3(component(), component(), component());
            match i % 6 {
                0 => d = vec3(0.001 * d.x, d.y, 0.001 * d.z), // near a pole
                1 => d = vec3(1e-4 * d.x, d.y, d.z),          // near the middle and the seam
                2 => d[i / 6 % 3] = [0.0, -0.0][i / 18 % 2],
                _ => {}
            }
            let d = d.normalize();
            let (got, exact) = (seen(&sky, d).as_dvec3(), exact(&sky, d));
            let most = 2.0 * (width + height) as f64 / (1 << 22) as f64 + 1e-6;
            assert!(got.abs_diff_eq(exact, most), "{width} x {height}, {d}: {got}, not {exact}");
        }
    }
}

#[test]
fn any_direction_is_safe() {
    let sky = Sky::Dome(noise(7, 5, 12.0).into());
    let odd = [0.0, -0.0, 1.0, -1e-45, f32::MAX, f32::NAN, f32::INFINITY, f32::NEG_INFINITY];
    for x in odd {
        for y in odd {
            for z in odd {
                let color = seen(&sky, vec3(x, y, z));
                assert!(color.min_element() >= 0.0 && color.max_element() <= 1.0, "{x} {y} {z}: {color}");
            }
        }
    }
}

#[test]
fn all_widths_give_the_same_bits() {
    fn all<L: Lanes>(sky: &Sky, directions: &[[f32; 512]; 3]) -> [[f32; 512]; 3] {
        let mut out = [[0.0; 512]; 3];
        (0..512).step_by(L::WIDTH).for_each(|at| radiance(sky, Vec3::<L>::load(directions, at)).store(&mut out, at));
        out
    }
    let mut state = 3;
    let mut directions = [[0.0; 512]; 3];
    directions.iter_mut().flatten().for_each(|x| *x = random(&mut state) - 0.5);
    (directions[0][5], directions[2][5], directions[1][77]) = (0.0, -0.0, f32::NAN);
    let sky = Sky::Dome(noise(13, 5, 100.0).into());
    let one = all::<f32>(&sky, &directions);
    assert_eq!(one, all::<f32x4>(&sky, &directions));
    assert_eq!(one, all::<f32x8>(&sky, &directions));
}
