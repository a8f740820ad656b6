//! Height fields of many triangles: the tree is built, gives the right picture, and takes no more memory than it says.

use glam::{Vec3, vec3};
use raypacket::render::Kernel;
use raypacket::scene::{Description, Mesh, Structure, compile};
use std::process::Command;
use std::time::Instant;

use crate::common::{Pcg, empty, film_bits, light, part_of};
use crate::pictures::{compiled, picture};

/// Set in the process that a test runs in by itself.
const ALONE: &str = "RAYPACKET_TEST_ALONE";

/// Runs a test in a process of its own, so that the most memory this ever had is the test's and nobody else's.
fn alone(name: &str, test: impl FnOnce()) {
    if std::env::var_os(ALONE).is_some() {
        return test();
    }
    let program = std::env::current_exe().expect("a running program has a path");
    let args = ["--exact", name, "--include-ignored", "--nocapture"];
    let run = Command::new(program).args(args).env(ALONE, "1").output().expect("the test program runs");
    let [out, err] = [&run.stdout, &run.stderr].map(|text| String::from_utf8_lossy(text));
    println!("{out}");
    assert!(run.status.success() && out.contains("1 passed"), "{out}\n{err}");
}

#[test]
fn three_hundred_thousand_triangles() {
    alone("field::three_hundred_thousand_triangles", || check(388, [64, 64]));
}

#[test]
#[ignore = "takes 1.5 GB, and the longer the less the build is optimized"]
fn five_million_triangles() {
    alone("field::five_million_triangles", || {
        let side = (part_of(5_000_000) as f64 / 2.0).sqrt().ceil();
        check(side as usize, [16, 16]);
    });
}

/// Of `side` × `side` squares, each cut in two; `brute` is the size of the picture that is traced without the tree, too.
fn check(side: usize, brute: [usize; 2]) {
    let description = field(side);
    let triangles = description.primitives();
    assert_eq!(triangles, 2 * side * side);
    let before = memory("VmRSS:");
    let started = Instant::now();
    let scene = compile(&description).expect("a sound scene");
    assert_eq!(scene.plan.structure, Structure::Tree, "so many ask for a tree");
    let seconds = started.elapsed().as_secs_f64();
    let peak = memory("VmHWM:");
    let bvh = scene.bvh.as_ref().expect("there is a tree");
    let stats = bvh.stats();
    assert_eq!(stats.primitives, triangles, "every triangle is in one block");
    println!("{triangles} triangles: compiled in {seconds:.2} s, the tree in {:?}; {stats}", scene.build_time);
    if let (Some(before), Some(peak)) = (before, peak) {
        let taken = peak - before;
        println!("{taken} bytes at most beside the description, {} a triangle", taken / triangles);
        let most = stats.bytes + (ARRAYS + BUILDING) * triangles + SLACK;
        assert!(taken <= most, "{taken} bytes for {triangles} triangles; {most} would do");
    }

    let film = picture(&description, &scene, Kernel::X8, [64, 64]);
    let dark = film.pixels.iter().filter(|p| **p == [0.0; 3]).count();
    assert!((200..3000).contains(&dark), "part of the picture is shadow and sky, part is lit: {dark} pixels are dark");
    let without = compiled(&description, Structure::None);
    let [with, without] = [&scene, &without].map(|scene| film_bits(&picture(&description, scene, Kernel::X8, brute)));
    let differ = with.iter().zip(&without).filter(|(a, b)| a != b).count();
    assert!(differ == 0 && with.len() == without.len(), "{differ} of {} values differ without the tree", with.len());
}

/// A rough square from −1 to 1, seen from a corner, with a light low enough for hills to cast shadows.
fn field(side: usize) -> Description {
    let mut rng = Pcg::new(side as u64);
    let at = |i: usize| i as f32 / side as f32 * 2.0 - 1.0;
    let mut mesh = Mesh::default();
    mesh.positions.reserve_exact((side + 1) * (side + 1));
    mesh.triangles.reserve_exact(2 * side * side);
    for (i, j) in (0..=side).flat_map(|i| (0..=side).map(move |j| (i, j))) {
        let (x, z) = (at(i), at(j));
        let height = 0.15 * (5.0 * x).sin() * (7.0 * z + x).cos() + rng.range(0.0, 0.5) / side as f32;
        mesh.positions.push(vec3(x, height, z));
    }
    for (i, j) in (0..side).flat_map(|i| (0..side).map(move |j| (i, j))) {
        let corner = |i: usize, j: usize| (i * (side + 1) + j) as u32;
        let [a, b, c, d] = [corner(i, j), corner(i, j + 1), corner(i + 1, j), corner(i + 1, j + 1)];
        mesh.triangles.extend([[a, b, c], [c, b, d]]);
    }
    let mut scene = empty();
    scene.meshes.push(mesh);
    scene.lights.push(light(vec3(3.0, 2.5, -2.0)));
    scene.camera.eye = vec3(1.2, 0.7, 1.4);
    scene.camera.look_at = Vec3::ZERO;
    scene
}

/// What the scene's arrays take for a triangle: nine coordinates, the normal, a length, material and sides.
const ARRAYS: usize = 4 * (9 + 3 + 1 + 1) + 1;
/// What building takes for a triangle beside the finished tree; [`raypacket::bvh`] says so.
const BUILDING: usize = 140;
/// For threads, what the allocator keeps, and an array that is there twice for the moment in which it grows.
const SLACK: usize = 8 << 20;

/// A line of what Linux tells about this process's memory, in bytes; None elsewhere.
fn memory(key: &str) -> Option<usize> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find_map(|line| line.strip_prefix(key))?;
    line.trim().strip_suffix(" kB")?.parse::<usize>().ok().map(|kib| kib << 10)
}
