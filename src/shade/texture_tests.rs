use super::*;
use crate::math::map2;
use crate::reference;
use crate::scene::{Description, Material, Pigment, Quad, Wrap};
use glam::{DVec3, vec3};
use wide::{f32x4, f32x8};

/// A fixed sequence of numbers from 0 to 1.
fn random(state: &mut u64) -> f32 {
    *state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
    (*state >> 40) as f32 / (1u64 << 24) as f32
}

fn noise(width: usize, height: usize) -> Texture {
    let mut state = (width * 31 + height) as u64;
    let mut byte = || (random(&mut state) * 255.99) as u8;
    Texture { width, height, texels: (0..width * height).map(|_| [byte(), byte(), byte()]).collect() }
}

fn color(texture: &Texture, u: f32, v: f32) -> [f32; 3] {
    glam::Vec3::from(sample::<f32>(texture, [u, v], &Mapping::endless(), 1.0)).to_array()
}

fn linear(byte: u8) -> f32 {
    linear_of_bytes()[usize::from(byte)]
}

/// The reference's colour on a quad whose corners have the given (u, v), in its middle.
fn exact(texture: &Texture, u: f32, v: f32) -> DVec3 {
    // A mesh of one triangle, all of whose vertices have the same coordinates.
    let positions = vec![vec3(-1.0, -1.0, 0.0), vec3(1.0, -1.0, 0.0), vec3(0.0, 1.0, 0.0)];
    let mesh = crate::scene::Mesh {
        positions,
        triangles: vec![[0, 1, 2]],
        uvs: vec![glam::vec2(u, v); 3],
        ..Default::default()
    };
    let scene = Description { meshes: vec![mesh], ..lit(texture, 1.0) };
    reference::Tracer::new(&scene).radiance(DVec3::Z, -DVec3::Z)
}

/// A scene in which a surface with the texture shows its very colour.
fn lit(texture: &Texture, size: f32) -> Description {
    let material = Material { pigment: Pigment::Texture { texture: 0, size, wrap: Wrap::Ends }, ..Material::default() };
    let mut scene = Description::default();
    scene.settings.ambient = glam::Vec3::ONE;
    scene.materials = vec![material];
    scene.textures = vec![texture.clone().into()];
    scene
}

#[test]
fn texel_centres_give_the_texels_and_v_runs_upward() {
    let texture = noise(4, 3);
    for row in 0..3 {
        for column in 0..4 {
            let (u, v) = ((column as f32 + 0.5) / 4.0, 1.0 - (row as f32 + 0.5) / 3.0);
            let texel = texture.texels[row * 4 + column].map(linear);
            for (u, v) in [(u, v), (u + 1.0, v - 2.0), (u - 3.0, v + 5.0)] {
                let got = color(&texture, u, v);
                assert!((0..3).all(|c| (got[c] - texel[c]).abs() < 1e-5), "({u}, {v}): {got:?}, not {texel:?}");
            }
        }
    }
}

#[test]
fn between_centres_linear_light_is_mixed_not_bytes() {
    let texture = Texture { width: 2, height: 1, texels: vec![[0; 3], [255; 3]] };
    assert_eq!(color(&texture, 0.5, 0.3), [0.5; 3]);
    assert_eq!(color(&texture, 0.0, 0.3), [0.5; 3], "the seam is between the last and the first");
    assert_eq!(color(&texture, 0.375, 9.0), [0.25; 3]);
}

#[test]
fn it_agrees_with_the_reference() {
    let mut state = 1;
    for (width, height) in [(1, 1), (1, 7), (6, 1), (2, 2), (5, 3), (64, 32)] {
        let texture = noise(width, height);
        for i in 0..1500 {
            let reach = [1.0, 4.0, 1000.0][i % 3];
            let mut coordinate = || match (random(&mut state) * 20.0) as u32 {
                0 => random(&mut state).round() * reach,
                1 => -1e-9 * random(&mut state),
                _ => (random(&mut state) - 0.5) * reach,
            };
            let (u, v) = (coordinate(), coordinate());
            let got = glam::Vec3::from_array(color(&texture, u, v)).as_dvec3();
            let exact = exact(&texture, u, v);
            // A step of 2^-22 of the image, times the steepest slope between two texels: their number.
            let most = (width + height) as f64 / (1 << 22) as f64 + 1e-6;
            assert!(got.abs_diff_eq(exact, most), "{width} x {height} at ({u}, {v}): {got}, not {exact}");
        }
    }
}

#[test]
fn whatever_the_coordinates_the_color_is_one_of_the_image() {
    let texture = Texture { width: 3, height: 2, texels: vec![[255; 3], [10; 3], [20; 3], [30; 3], [40; 3], [50; 3]] };
    let strange = [0.0, -0.0, 1.0, -1e-30, 1e-45, 8_388_607.5, -8_388_609.0, 1e18, -3e38, f32::MAX];
    let wild = [f32::NAN, f32::INFINITY, f32::NEG_INFINITY];
    for u in strange.into_iter().chain(wild) {
        for v in strange.into_iter().chain(wild) {
            let [red, ..] = color(&texture, u, v);
            assert!((linear(10)..=1.0).contains(&red), "({u}, {v}): {red}");
            let single = Texture { width: 1, height: 1, texels: vec![[7, 8, 9]] };
            assert_eq!(color(&single, u, v), [7, 8, 9].map(linear), "({u}, {v})");
        }
    }
    for (u, v) in wild.into_iter().flat_map(|u| wild.map(|v| (u, v))) {
        assert_eq!(color(&texture, u, v), [1.0; 3]);
    }
}

#[test]
fn all_widths_give_the_same_bits() {
    fn all<L: Lanes>(texture: &Texture, uv: &[[f32; 2]]) -> Vec<[u32; 3]> {
        let columns = [0, 1].map(|k| uv.iter().map(|uv| uv[k]).collect::<Vec<_>>());
        let mut bits = vec![Vec::new(); 3];
        for at in (0..uv.len()).step_by(L::WIDTH) {
            let uv = map2([0, 1], |k: usize| L::load(&columns[k][at..]));
            let mappings = [Mapping::endless(), Mapping::face(), Mapping::around([true; 2])];
            for (bits, mapping) in bits.iter_mut().zip(mappings) {
                let color = sample(texture, uv, &mapping, 2.4);
                let color = at_poles(color, &[glam::Vec3::X; 2], uv[1], &mapping, 2.4, texture.height);
                let mut out = [[0.0; 8]; 3];
                color.store(&mut out, 0);
                (0..L::WIDTH).for_each(|i| bits.push(out.map(|channel| channel[i].to_bits())));
            }
        }
        bits.concat()
    }
    let mut state = 5;
    let mut number = || (random(&mut state) - 0.5) * if random(&mut state) < 0.5 { 2.0 } else { 3e9 };
    let mut uv: Vec<[f32; 2]> = (0..512).map(|_| [number(), number()]).collect();
    uv[3][0] = f32::NAN;
    uv[77][1] = f32::INFINITY;
    let texture = noise(13, 5);
    let one = all::<f32>(&texture, &uv);
    assert_eq!(one, all::<f32x4>(&texture, &uv));
    assert_eq!(one, all::<f32x8>(&texture, &uv));
}

#[test]
fn the_first_row_is_at_the_top_of_a_quad_seen_from_the_front() {
    let texture = Texture { width: 2, height: 2, texels: vec![[255, 0, 0], [0, 255, 0], [0, 0, 255], [255; 3]] };
    let quad =
        Quad { corner: vec3(-1.0, -1.0, 0.0), u: 2.0 * vec3(1.0, 0.0, 0.0), v: 2.0 * vec3(0.0, 1.0, 0.0), material: 0 };
    let scene = Description { quads: vec![quad], ..lit(&texture, 1.0) };
    let tracer = reference::Tracer::new(&scene);
    let compiled = crate::scene::compile(&scene).unwrap();
    let mut film = crate::render::Film::new(2, 2);
    // Straight at the middle, with the four pixels' rays through the quad's quarters.
    let camera = crate::scene::CameraDescription {
        eye: vec3(0.0, 0.0, 2.0),
        look_at: vec3(0.0, 0.0, 0.0),
        up: vec3(0.0, 1.0, 0.0),
        fov: 53.13,
    };
    let camera = crate::render::Camera::new(&camera, 1.0);
    crate::render::render(&compiled, &camera, crate::render::Kernel::X4, 1, &mut film, &|_| ());
    let corners = [(-0.5, 0.5), (0.5, 0.5), (-0.5, -0.5), (0.5, -0.5)];
    for (i, ((x, y), texel)) in corners.into_iter().zip(&texture.texels).enumerate() {
        let expected = DVec3::from_array(texel.map(|byte| f64::from(byte) / 255.0));
        let seen = tracer.radiance(DVec3::new(x, y, 1.0), -DVec3::Z);
        assert!(seen.abs_diff_eq(expected, 1e-6), "the reference at {i}: {seen}");
        let pixel = glam::Vec3::from_array(film.pixels[i]).as_dvec3();
        assert!(pixel.abs_diff_eq(expected, 1e-4), "pixel {i}: {pixel}, not {expected}");
    }
}
