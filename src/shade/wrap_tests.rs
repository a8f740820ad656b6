//! Textures at the ends of every kind's mapping, by the packet tracer and by the reference.

use crate::math::linear_of_bytes;
use crate::reference::Tracer;
use crate::render::{Camera, Film, Kernel, render};
use crate::scene::{
    CameraDescription, Cone, Cuboid, Cylinder, Description, Disc, Fractal, Material, Mesh, Pigment, Plane, Quad, Sides,
    Sphere, Texture, Torus, Wrap, compile,
};
use glam::{DVec3, Vec3, vec3};

/// Texels along an edge.
const SIDE: usize = 4;

/// No two of its texels are alike.
fn texture() -> Texture {
    let texel = |i: usize| [i * 255 / 15, (i * 7) % 16 * 255 / 15, (i * 5 + 3) % 16 * 255 / 15].map(|c| c as u8);
    Texture { width: SIDE, height: SIDE, texels: (0..SIDE * SIDE).map(texel).collect() }
}

fn texel(column: usize, row: usize) -> Vec3 {
    Vec3::from_array(texture().texels[row * SIDE + column].map(|byte| linear_of_bytes()[usize::from(byte)]))
}

/// A scene in which surfaces show the texture as it is.
fn scene(size: f32, wrap: Wrap) -> Description {
    let material = Material { pigment: Pigment::Texture { texture: 0, size, wrap }, ..Material::default() };
    let mut scene = Description { materials: vec![material], textures: vec![texture().into()], ..Default::default() };
    scene.settings.ambient = Vec3::ONE;
    scene
}

fn quad() -> Quad {
    Quad { corner: vec3(-1.0, -1.0, 0.0), u: 2.0 * Vec3::X, v: 2.0 * Vec3::Y, material: 0 }
}

fn sphere() -> Sphere {
    Sphere { center: Vec3::ZERO, radius: 1.0, sides: Sides::Both, material: 0 }
}

/// What the packet tracer and the reference see at `point` from `from`, which agree.
#[track_caller]
fn seen(scene: &Description, from: Vec3, point: Vec3) -> Vec3 {
    let camera = CameraDescription { eye: from, look_at: point, ..CameraDescription::default() };
    let mut film = Film::new(1, 1);
    render(&compile(scene).unwrap(), &Camera::new(&camera, 1.0), Kernel::X8, 1, &mut film, &|_| ());
    let packets = Vec3::from_array(film.pixels[0]);
    let [eye, at] = [from, point].map(|p| p.as_dvec3());
    let reference = Tracer::new(scene).radiance(eye, (at - eye).normalize());
    // 2⁻¹⁸ of a repeat, for the rounding of the ray, times the greatest slope, a colour a texel.
    assert!(packets.as_dvec3().abs_diff_eq(reference, 1e-4), "{packets}, not {reference}, at {point} from {from}");
    packets
}

#[track_caller]
fn alike(a: Vec3, b: Vec3) {
    assert!(a.abs_diff_eq(b, 2e-4), "{a}, not {b}");
}

/// A hair's breadth.
const HAIR: f32 = 1e-5;

#[test]
fn a_poster_shows_no_edge_of_the_other_side() {
    let mut poster = scene(1.0, Wrap::Ends);
    poster.quads = vec![quad()];
    let at = |scene: &Description, x: f32, y: f32| seen(scene, vec3(x, y, 2.0), vec3(x, y, 0.0));
    let edge = 1.0 - HAIR;
    let corners = [(-edge, edge, 0, 0), (edge, edge, 3, 0), (-edge, -edge, 0, 3), (edge, -edge, 3, 3)];
    for (x, y, column, row) in corners {
        alike(at(&poster, x, y), texel(column, row));
    }
    // Three repeats and a half: whole ones meet as ever, and the last ends in the middle of the image.
    poster.materials[0].pigment = Pigment::Texture { texture: 0, size: 2.0 / 7.0, wrap: Wrap::Ends };
    alike(at(&poster, -edge, -edge), texel(0, 3));
    alike(at(&poster, edge, -edge), texel(1, 3));
    alike(at(&poster, 4.0 / 7.0 - 1.0, -edge), (texel(0, 3) + texel(3, 3)) / 2.0);
    // As asked for.
    poster.materials[0].pigment = Pigment::Texture { texture: 0, size: 1.0, wrap: Wrap::Repeat };
    let all = [texel(0, 0), texel(3, 0), texel(0, 3), texel(3, 3)].into_iter().sum::<Vec3>() / 4.0;
    corners.iter().for_each(|&(x, y, ..)| alike(at(&poster, x, y), all));
    poster.materials[0].pigment = Pigment::Texture { texture: 0, size: 0.5, wrap: Wrap::Clamp };
    alike(at(&poster, -edge, edge), texel(0, 0));
    alike(at(&poster, 0.9, 0.9), texel(3, 0));
}

#[test]
fn a_floor_repeats_unless_it_is_told_otherwise() {
    let mut floor = scene(1.0, Wrap::Ends);
    floor.planes = vec![Plane { normal: Vec3::Y, distance: 0.0, material: 0 }];
    // (u, v) = (x, −z) or so: whichever way, it is the same a repeat on, and mixed at a border.
    let at = |scene: &Description, x: f32, z: f32| seen(scene, vec3(x, 2.0, z), vec3(x, 0.0, z));
    for (x, z) in [(0.125, 0.625), (0.01, 0.99), (0.4, 0.0)] {
        alike(at(&floor, x, z), at(&floor, x + 3.0, z - 7.0));
    }
    floor.materials[0].pigment = Pigment::Texture { texture: 0, size: 1.0, wrap: Wrap::Clamp };
    let far = [(9.0, 9.0), (9.0, -9.0), (-9.0, 9.0), (-9.0, -9.0)].map(|(x, z)| at(&floor, x, z));
    for corner in [texel(0, 0), texel(3, 0), texel(0, 3), texel(3, 3)] {
        assert!(far.iter().any(|c| c.abs_diff_eq(corner, 1e-6)), "{corner} is not in {far:?}");
    }
}

/// A point where all of u comes together has one colour: the mean of the texels around it.
#[test]
fn poles_and_tips_and_middles_have_one_color() {
    let mean = |row: usize| (0..SIDE).map(|column| texel(column, row)).sum::<Vec3>() / SIDE as f32;
    let mut ball = scene(1.0, Wrap::Ends);
    ball.spheres = vec![sphere()];
    let mut cone = scene(1.0, Wrap::Ends);
    cone.cones = vec![Cone {
        base: Vec3::ZERO,
        base_radius: 1.0,
        apex: Vec3::Y,
        apex_radius: 0.0,
        caps: true,
        sides: Sides::Both,
        material: 0,
    }];
    let mut disc = scene(1.0, Wrap::Ends);
    disc.discs = vec![Disc { center: Vec3::ZERO, normal: Vec3::Y, radius: 1.0, inner_radius: 0.0, material: 0 }];
    for turn in 0..7 {
        let aside = vec3((turn as f32).cos(), 0.0, (turn as f32).sin()) * 1e-4;
        alike(seen(&ball, Vec3::Y * 3.0, Vec3::Y + aside), mean(0));
        alike(seen(&ball, Vec3::Y * -3.0, -Vec3::Y + aside), mean(3));
        let tip = Vec3::Y + aside - Vec3::Y * 1e-4;
        assert!(seen(&cone, tip + vec3(0.0, 2.0, 0.0), tip).abs_diff_eq(mean(0), 2e-3));
        assert!(seen(&disc, Vec3::Y * 3.0, aside).abs_diff_eq(mean(3), 2e-3));
        // And its rim is the image's border.
        let rim = aside * 1e4;
        alike(
            seen(&disc, rim * (1.0 - HAIR) + Vec3::Y, rim * (1.0 - HAIR)),
            seen(&disc, rim * 0.875 + Vec3::Y, rim * 0.875),
        );
    }
    // Not if the texture shall repeat: then the pole is a wheel of colours, in which opposite rows are mixed.
    ball.materials[0].pigment = Pigment::Texture { texture: 0, size: 1.0, wrap: Wrap::Repeat };
    let wheel =
        [0.0f32, 2.0].map(|turn| seen(&ball, Vec3::Y * 3.0, Vec3::Y + vec3(turn.cos(), 0.0, turn.sin()) * 1e-3));
    assert!(!wheel[0].abs_diff_eq(wheel[1], 0.01), "{wheel:?}");
}

#[test]
fn sides_and_caps_and_faces_end_by_themselves() {
    // At an end, and half a texel before it: the same.
    let mut tin = scene(1.0, Wrap::Ends);
    tin.cylinders =
        vec![Cylinder { base: Vec3::ZERO, apex: Vec3::Y, radius: 1.0, caps: true, sides: Sides::Both, material: 0 }];
    let mut cube = scene(1.0, Wrap::Ends);
    cube.cuboids = vec![Cuboid { min: Vec3::ZERO, max: Vec3::ONE, rotation: Vec3::ZERO, material: 0 }];
    let mut sponge = scene(1.0, Wrap::Ends);
    sponge.fractals = vec![Fractal { center: Vec3::splat(0.5), radius: 0.5, iterations: 0, material: 0 }];
    let side = |scene: &Description, y: f32| seen(scene, vec3(2.7, y, 1.9), vec3(0.8, y, 0.5));
    let top = |scene: &Description, x: f32, z: f32| seen(scene, vec3(x, 3.0, z), vec3(x, 1.0, z));
    for scene in [&tin, &cube, &sponge] {
        alike(side(scene, HAIR), side(scene, 0.124));
        alike(side(scene, 1.0 - HAIR), side(scene, 0.876));
        // The middle is mixed.
        assert!(!side(scene, 0.5).abs_diff_eq(side(scene, 0.6), 0.01));
    }
    for scene in [&cube, &sponge] {
        alike(top(scene, HAIR, 0.6), top(scene, 0.124, 0.6));
        alike(top(scene, 0.6, 1.0 - HAIR), top(scene, 0.6, 0.876));
    }
    alike(top(&tin, -1.0 + HAIR, 0.0), top(&tin, -0.751, 0.0));
    alike(top(&tin, 0.0, 1.0 - HAIR), top(&tin, 0.0, 0.751));
    // Around, the first texel comes after the last.
    let around = |angle: f32| {
        let out = vec3(angle.cos(), 0.6, angle.sin());
        seen(&tin, out * vec3(3.0, 1.0, 3.0), out)
    };
    let steps: Vec<Vec3> = (0..=400).map(|i| around(i as f32 * std::f32::consts::TAU / 400.0)).collect();
    // A colour a texel, a hundred steps each.
    let jump = steps.windows(2).map(|w| (w[0] - w[1]).abs().max_element()).fold(0.0, f32::max);
    assert!(jump < 0.0101, "{jump}");
}

#[test]
fn vertices_with_coordinates_repeat_and_those_without_do_not() {
    let mesh = |uvs: &[[f32; 2]]| Mesh {
        positions: vec![vec3(-1.0, -1.0, 0.0), vec3(1.0, -1.0, 0.0), vec3(-1.0, 1.0, 0.0)],
        triangles: vec![[0, 1, 2]],
        uvs: uvs.iter().map(|&uv| uv.into()).collect(),
        ..Mesh::default()
    };
    let mut plain = scene(1.0, Wrap::Ends);
    let mut mapped = plain.clone();
    plain.meshes = vec![mesh(&[])];
    mapped.meshes = vec![mesh(&[[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]])];
    let corner = vec3(HAIR - 1.0, HAIR - 1.0, 0.0);
    alike(seen(&plain, corner + Vec3::Z, corner), texel(0, 3));
    let all = [texel(0, 0), texel(3, 0), texel(0, 3), texel(3, 3)].into_iter().sum::<Vec3>() / 4.0;
    alike(seen(&mapped, corner + Vec3::Z, corner), all);
}

/// Random points of all kinds, with repeats of all sizes: [`seen`] compares.
#[test]
fn the_reference_agrees_everywhere() {
    let mut all = scene(1.0, Wrap::Ends);
    let at = |x: f32| vec3(x, 0.0, 0.0);
    all.quads = vec![Quad { corner: at(0.0) - vec3(1.0, 1.0, 0.0), ..quad() }];
    all.spheres = vec![Sphere { center: at(4.0), ..sphere() }];
    all.tori = vec![Torus { center: at(8.0), axis: Vec3::Y, major_radius: 0.7, minor_radius: 0.3, material: 0 }];
    let [base, apex] = [at(12.0) - Vec3::Y, at(12.0) + Vec3::Y];
    all.cylinders = vec![Cylinder { base, apex, radius: 0.8, caps: true, sides: Sides::Both, material: 0 }];
    let [base, apex] = [at(16.0) - Vec3::Y, at(16.0) + Vec3::Y];
    let cone = Cone { base, base_radius: 0.0, apex, apex_radius: 0.9, caps: true, sides: Sides::Both, material: 0 };
    all.cones = vec![cone];
    all.cuboids =
        vec![Cuboid { min: at(19.2), max: at(20.7) + Vec3::Y + Vec3::Z, rotation: Vec3::ONE * 20.0, material: 0 }];
    all.discs = vec![Disc { center: at(24.0), normal: Vec3::ONE, radius: 1.0, inner_radius: 0.2, material: 0 }];
    let mut state = 7u64;
    let mut random = || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 40) as f32 / (1u64 << 24) as f32 - 0.5
    };
    let mut wrong = Vec::new();
    let mut count = 0;
    for size in [1.0f32, 0.5, 0.3, 2.5, 0.1, 7.0] {
        for wrap in [Wrap::Ends, Wrap::Repeat, Wrap::Clamp] {
            all.materials[0].pigment = Pigment::Texture { texture: 0, size, wrap };
            let (compiled, tracer) = (compile(&all).unwrap(), Tracer::new(&all));
            for _ in 0..700 {
                let middle = at(4.0 * ((random() + 0.5) * 7.0).floor());
                let look_at = middle + 1.4 * vec3(random(), random(), random());
                let eye = middle + 6.0 * vec3(random(), random(), random());
                if eye.distance(middle) < 2.0 {
                    continue;
                }
                let camera = CameraDescription { eye, look_at, ..CameraDescription::default() };
                let mut film = Film::new(1, 1);
                render(&compiled, &Camera::new(&camera, 1.0), Kernel::X1, 1, &mut film, &|_| ());
                let [o, p] = [eye, look_at].map(|p| p.as_dvec3());
                let exact = tracer.radiance(o, (p - o).normalize());
                let got = DVec3::from_array(film.pixels[0].map(f64::from));
                // Up to ten repeats of four texels, by what rounding does to a hit at a slant.
                if !got.abs_diff_eq(exact, 2e-3) {
                    wrong.push((size, wrap, eye, look_at, got, exact));
                }
                count += 1;
            }
        }
    }
    // Next to an edge, rounding may choose the other face.
    assert!(wrong.len() * 1000 <= count, "{} of {count}: {:?}", wrong.len(), &wrong[..wrong.len().min(5)]);
}
