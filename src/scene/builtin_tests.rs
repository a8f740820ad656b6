use super::*;
use crate::scene::{Pigment, Sphere};

#[path = "../../examples/sphereflake/flake.rs"]
mod flake;

#[path = "../../examples/lattice/crystal.rs"]
mod crystal;

fn scene(name: &str) -> Description {
    load(name).unwrap()
}

fn radii(spheres: &[Sphere]) -> (f32, f32) {
    spheres.iter().fold((f32::INFINITY, 0.0), |(low, high), s| (low.min(s.radius), high.max(s.radius)))
}

#[test]
fn every_builtin_is_sound_and_bears_its_name() {
    for builtin in builtins() {
        let scene = scene(builtin.name);
        assert_eq!(scene.name, builtin.name);
        assert!(!builtin.summary.contains('\n') && scene.primitives() > 0 && !scene.lights.is_empty());
        let eye = scene.camera.eye.as_dvec3();
        for (i, s) in scene.spheres.iter().enumerate() {
            let outside = eye.distance(s.center.as_dvec3()) > f64::from(s.radius);
            assert!(outside, "{}: the eye is in sphere {i}", builtin.name);
        }
    }
}

#[test]
fn classic_is_the_lectures_scene() {
    let classic = scene("classic");
    let mirror = |low: f32, high: f32| {
        classic.spheres.iter().any(|s| (low..=high).contains(&classic.materials[s.material].reflectance))
    };
    assert!((3..=7).contains(&classic.spheres.len()) && classic.lights.len() == 2 && classic.planes.len() == 1);
    assert!(mirror(0.85, 1.0), "one full mirror");
    assert!(mirror(0.3, 0.5), "one partial mirror");
    assert!(matches!(classic.materials[classic.planes[0].material].pigment, Pigment::Checker { .. }));
    assert_eq!(classic.settings.max_depth, 6);
    for (i, a) in classic.spheres.iter().enumerate() {
        for b in &classic.spheres[..i] {
            assert!(a.center.distance(b.center) > a.radius + b.radius, "spheres {i} and another overlap");
        }
    }
}

#[test]
fn flake_is_what_its_generator_makes() {
    let source = builtins().iter().find(|b| b.name == "flake").unwrap().source;
    assert!(source == flake::toml(), "run `cargo run --example sphereflake > scenes/flake.toml`");
}

#[test]
fn flake_has_five_levels_that_touch() {
    let flake = scene("flake");
    assert_eq!((flake.spheres.len(), flake.planes.len()), (7381, 1));
    for (level, count) in [1, 9, 81, 729, 6561].into_iter().enumerate() {
        let radius = 0.5 / 3.0_f32.powi(level as i32);
        let found = flake.spheres.iter().filter(|s| (s.radius - radius).abs() < 1e-5).count();
        assert_eq!(found, count, "level {level}");
    }
    let root = flake.spheres[0];
    let children = flake.spheres.iter().filter(|s| (s.radius - 0.5 / 3.0).abs() < 1e-4);
    for child in children {
        assert!((root.center.distance(child.center) - root.radius - child.radius).abs() < 3e-5);
    }
    let lowest = flake.spheres.iter().map(|s| s.center.y - s.radius).fold(f32::INFINITY, f32::min);
    assert!(lowest.abs() < 1e-5, "it stands on the floor, not in it: {lowest}");
}

#[test]
fn hall_has_facing_mirrors() {
    let hall = scene("hall");
    let mirrors: Vec<_> = hall.planes.iter().filter(|p| hall.materials[p.material].reflectance > 0.9).collect();
    assert_eq!(mirrors.len(), 2);
    assert_eq!(mirrors[0].normal, -mirrors[1].normal);
    assert_eq!(hall.settings.max_depth, 12);
    for (i, s) in hall.spheres.iter().enumerate() {
        for p in &hall.planes {
            assert!(p.normal.dot(s.center) + p.distance >= s.radius, "sphere {i} cuts a plane");
        }
    }
}

#[test]
fn cosmos_spans_nine_orders_of_magnitude() {
    let cosmos = scene("cosmos");
    assert_eq!(radii(&cosmos.spheres), (1e-3, 1e6));
    assert!(cosmos.planes.is_empty() && !cosmos.settings.attenuation);
    let eye = cosmos.camera.eye;
    assert!(cosmos.spheres.iter().any(|s| s.center.distance(eye) < 0.1));
    assert!(cosmos.spheres.iter().any(|s| s.center.distance(eye) > 5e5));
}

#[test]
fn lattice_is_what_its_generator_makes() {
    let source = builtins().iter().find(|b| b.name == "lattice").unwrap().source;
    assert!(source == crystal::toml(), "run `cargo run --example lattice > scenes/lattice.toml`");
}

#[test]
fn lattice_is_a_diamonds() {
    let lattice = scene("lattice");
    assert_eq!((lattice.spheres.len(), lattice.cylinders.len(), lattice.planes.len()), (265, 460, 1));
    let mut bonds = vec![Vec::new(); lattice.spheres.len()];
    for c in &lattice.cylinders {
        let ends = [(c.base, c.apex), (c.apex, c.base)];
        for (end, other) in ends {
            let atom = lattice.spheres.iter().position(|s| s.center == end).expect("a bond ends in an atom");
            bonds[atom].push((other - end).as_dvec3().normalize());
        }
        assert!((c.base.distance(c.apex) - 0.22 * 3.0_f32.sqrt()).abs() < 1e-5);
    }
    for directions in &bonds {
        assert!((2..=4).contains(&directions.len()));
        for (i, a) in directions.iter().enumerate() {
            for b in &directions[..i] {
                assert!((a.dot(*b) + 1.0 / 3.0).abs() < 1e-5, "the angle of a tetrahedron");
            }
        }
    }
    // Only the octahedron's faces and edges cut bonds off.
    let whole = bonds.iter().filter(|b| b.len() == 4).count();
    assert!(whole * 2 > bonds.len(), "{whole} of {}", bonds.len());
    let lowest = lattice.spheres.iter().map(|s| s.center.y - s.radius).fold(f32::INFINITY, f32::min);
    assert!(lowest.abs() < 1e-5, "it stands on the floor, not in it: {lowest}");
}

/// Every mesh has normals, on the side of its triangles; and the balls, one of which is of glass, are closed.
#[test]
fn vase_is_shaded_smoothly() {
    let vase = scene("vase");
    assert_eq!(vase.meshes.iter().map(|m| m.triangles.len()).collect::<Vec<_>>(), [364, 80, 80, 80]);
    for mesh in &vase.meshes {
        let mut edges = std::collections::HashSet::new();
        for &[i, j, k] in &mesh.triangles {
            let [a, b, c] = [i, j, k].map(|v| mesh.positions[v as usize]);
            let own = (b - a).cross(c - a);
            assert!([i, j, k].iter().all(|&v| mesh.normals[v as usize].dot(own) > 0.0));
            edges.extend([[i, j], [j, k], [k, i]]);
        }
        assert_eq!(edges.len(), 3 * mesh.triangles.len(), "no edge runs twice the same way");
        let closed = edges.iter().all(|&[i, j]| edges.contains(&[j, i]));
        assert_eq!(closed, mesh.triangles.len() == 80);
    }
    assert!(vase.materials[vase.meshes[3].material].transmission > 0.9);
}

#[test]
fn what_cannot_be_loaded_is_said_in_one_line() {
    for (name, message) in [
        (
            "nowhere",
            "nowhere: no such file, nor a built-in scene (classic, flake, hall, cosmos, primitives, glass, textures, sky, sponge, lattice, vase)",
        ),
        (
            "",
            ": no such file, nor a built-in scene (classic, flake, hall, cosmos, primitives, glass, textures, sky, sponge, lattice, vase)",
        ),
        (
            "a\nb",
            "a\\nb: no such file, nor a built-in scene (classic, flake, hall, cosmos, primitives, glass, textures, sky, sponge, lattice, vase)",
        ),
        (
            "x.png",
            "x.png: no such file, nor a built-in scene (classic, flake, hall, cosmos, primitives, glass, textures, sky, sponge, lattice, vase)",
        ),
        ("bunny.obj", "bunny.obj: No such file or directory (os error 2)"),
        ("balls.NFF", "balls.NFF: No such file or directory (os error 2)"),
        ("Cargo.lock", "Cargo.lock: a scene is a .toml, .nff or .obj file"),
        ("none.toml", "none.toml: No such file or directory (os error 2)"),
    ] {
        assert_eq!(load(name).unwrap_err().to_string(), message);
    }
}
