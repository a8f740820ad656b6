//! Transparent bodies, and gaps between them, that are thin beside their coordinates.

use glam::{Vec3, vec3};
use raypacket::geometry::methods::{Choice, OffsetMethod};
use raypacket::measure::verify::{verify, verify_with};
use raypacket::render::Kernel;
use raypacket::scene::{CameraDescription, Description, Material, Pigment, Quad, Sky};
use raypacket::{CompileOptions, Cuboid, Disc};

use crate::common::{empty, mesh, picture, plane};

/// A kind of primitive that a pane is made of.
const KINDS: [fn(&mut Description, Vec3, Vec3); 4] = [by_box, by_quads, by_mesh, by_discs];

fn by_box(scene: &mut Description, min: Vec3, max: Vec3) {
    scene.cuboids.push(Cuboid { min, max, rotation: Vec3::ZERO, material: 0 });
}

/// The corners of a box, bit i of the number for axis i; and its faces, outward.
fn corners(min: Vec3, max: Vec3) -> [Vec3; 8] {
    std::array::from_fn(|i| {
        Vec3::from_array([0, 1, 2].map(|axis| if i >> axis & 1 == 1 { max[axis] } else { min[axis] }))
    })
}
const FACES: [[usize; 4]; 6] = [[0, 4, 6, 2], [1, 3, 7, 5], [0, 1, 5, 4], [2, 6, 7, 3], [0, 2, 3, 1], [4, 5, 7, 6]];

fn by_quads(scene: &mut Description, min: Vec3, max: Vec3) {
    let at = corners(min, max);
    scene.quads.extend(FACES.map(|[a, b, _, d]| Quad {
        corner: at[a],
        u: at[b] - at[a],
        v: at[d] - at[a],
        material: 0,
    }));
}

fn by_mesh(scene: &mut Description, min: Vec3, max: Vec3) {
    let at = corners(min, max);
    let triangles = FACES.iter().flat_map(|&[a, b, c, d]| [[at[a], at[b], at[c]], [at[a], at[c], at[d]]]);
    scene.meshes.push(mesh(&triangles.collect::<Vec<_>>()));
}

/// Round, and open at the side, which no ray comes to here.
fn by_discs(scene: &mut Description, min: Vec3, max: Vec3) {
    for (z, normal) in [(min.z, Vec3::NEG_Z), (max.z, Vec3::Z)] {
        let center = (0.5 * (min + max)).with_z(z);
        scene.discs.push(Disc::new(center, normal, 50.0));
    }
}

/// A view through what lies about (x, 1, 0) towards a wall.
fn view(x: f32) -> Description {
    let mut scene = empty();
    scene.camera =
        CameraDescription { eye: vec3(x, 1.0, 4.0), look_at: vec3(x + 1.0, 1.0, 0.0), up: Vec3::Y, fov: 30.0 };
    scene.materials = vec![
        Material { transmission: 1.0, ior: 1.52, absorption: vec3(100.0, 2.0, 100.0), ..Material::default() },
        // Of one colour: the edges of a checkerboard are where rounding puts them.
        Material { pigment: Pigment::Color(vec3(0.9, 0.8, 0.7)), ..Material::default() },
    ];
    scene.settings.ambient = Vec3::splat(0.8);
    scene.settings.max_depth = 12;
    scene.sky = Sky::Color(vec3(0.3, 0.5, 0.8));
    scene.planes = vec![plane(Vec3::Z, 3.0)];
    scene.planes[0].material = 1;
    scene
}

/// Every pixel is the reference's, and none needs an explanation.
fn holds(scene: &Description, what: &str) {
    let report = verify(scene, &Kernel::ALL, 48, 32);
    assert!(report.pass, "{what}: {report:?}");
    let explained: usize = report.kernels.iter().map(|kernel| kernel.comparison.pixels_different).sum();
    assert_eq!(explained, 0, "{what}");
    let film = picture(scene, Kernel::X8, 48, 32);
    // A way of 4 mm and more a pane in glass of absorption 100: a third of the red is gone, and not all.
    assert!(film.pixels.iter().all(|[r, g, _]| r < g && *r > 0.05), "{what}");
}

#[test]
fn a_pane_far_from_the_origin_is_not_solid() {
    for (kind, pane) in KINDS.iter().enumerate() {
        for x in [0.0, 7500.0, 20000.0] {
            let mut scene = view(x);
            pane(&mut scene, vec3(x - 5.0, -4.0, -0.004), vec3(x + 7.0, 6.0, 0.0));
            holds(&scene, &format!("kind {kind} at {x}"));
        }
    }
}

/// By the largest coordinate, as rays were lifted once, the pane turns solid, and that has no excuse.
#[test]
fn verify_tells_of_a_pane_that_turned_solid() {
    for x in [7500.0, 20000.0] {
        let mut scene = view(x);
        by_box(&mut scene, vec3(x - 5.0, -4.0, -0.004), vec3(x + 7.0, 6.0, 0.0));
        let solid = CompileOptions { methods: vec![Choice::Offset(OffsetMethod::Scaled)], ..CompileOptions::default() };
        let report = verify_with(&scene, &solid, &[Kernel::X8], 24, 16);
        assert!(!report.pass && report.kernels[0].comparison.pixels_unexplained > 100, "{report:?}");
    }
}

#[test]
fn gaps_between_panes() {
    for gap in [1e-3, 1e-5, 1e-6] {
        let mut scene = view(0.0);
        for i in 0..3 {
            let near = -(0.004 + gap) * i as f32;
            by_box(&mut scene, vec3(-5.0, -4.0, near - 0.004), vec3(7.0, 6.0, near));
        }
        holds(&scene, &format!("gap {gap}"));
    }
}
