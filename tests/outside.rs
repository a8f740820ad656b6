//! The library from outside: a short program in a crate of its own, with the tracer alone and names from the root only.

use std::path::Path;
use std::process::Command;
use std::{env, fs};

const PROGRAM: &str = r#"use raypacket::{Camera, Description, Kernel, Light, Material, Mesh, Ray, compile, intersect_rays, render_into};
use std::ops::ControlFlow;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let corners = [[-1.0, -1.0, 0.0], [1.0, -1.0, 0.0], [0.0, 1.0, 0.0]];
    let scene = compile(&Description {
        meshes: vec![Mesh::new(&corners, &[[0, 1, 2]])],
        materials: vec![Material::diffuse([0.5, 0.25, 1.0])],
        lights: vec![Light::new([0.0, 0.0, 3.0], [36.0 * std::f32::consts::PI; 3])],
        ..Description::default()
    })?;

    let rays: Vec<Ray> =
        (0..1000).map(|i| Ray::new([i as f32 / 250.0 - 2.0, -0.5, 5.0], [0.0, 0.0, -1.0])).collect();
    let mut hits = vec![None; rays.len()];
    intersect_rays(&scene, &rays, &mut hits);
    let first = hits.iter().flatten().next().ok_or("no hit")?;
    println!("{} hits, the first at {}", hits.iter().flatten().count(), first.t);
    println!("{:?}", scene.primitive(first.primitive).ok_or("no primitive")?.kind);

    let mut pixels = vec![[9.0; 3]; 9 * 9];
    let camera = Camera::look_at([0.0, 0.0, 3.0], [0.0, 0.0, 0.0], 60.0, 1.0);
    render_into(&scene, &camera, Kernel::default(), 1, [9, 9], &mut pixels, &|_| ControlFlow::Continue(()))?;
    println!("{:.3?} {:.3?}", pixels[0], pixels[40]);
    Ok(())
}
"#;

/// By hand: at y = −½ the triangle reaches from −¾ to ¾, where rays 313 to 687 pass. The light is 3 above its middle and
/// gives it an irradiance of 1, so it shows its colour there; the corner sees the black sky.
const OUTPUT: &str = "375 hits, the first at 5\nMesh\n[0.000, 0.000, 0.000] [0.500, 0.250, 1.000]\n";

/// Builds as a user's crate is built, but into a folder that stays from one run to the next.
#[test]
fn a_short_program_in_a_crate_of_its_own() {
    assert!(PROGRAM.lines().count() <= 30);
    assert_eq!(PROGRAM.matches("raypacket::").count(), 1, "names from the root only");
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let folder = tempfile::tempdir().expect("a temporary folder");
    let manifest = format!(
        "[package]\nname = \"outside\"\nversion = \"0.0.0\"\nedition = \"2024\"\n\n[dependencies]\n\
         raypacket = {{ path = {root:?}, default-features = false }}\n\n[profile.dev]\ndebug = false\n\n\
         [workspace]\n"
    );
    fs::create_dir(folder.path().join("src")).expect("a folder");
    fs::write(folder.path().join("Cargo.toml"), manifest).expect("the manifest");
    fs::write(folder.path().join("src/main.rs"), PROGRAM).expect("the program");
    // The same versions as here, which are at hand.
    fs::copy(root.join("Cargo.lock"), folder.path().join("Cargo.lock")).expect("the versions");

    let target = Path::new(env!("CARGO_TARGET_TMPDIR")).join("outside");
    let cargo = env::var_os("CARGO").unwrap_or("cargo".into());
    let mut build = Command::new(cargo);
    build.args(["build", "--offline", "--quiet", "--target-dir"]).arg(&target).current_dir(folder.path());
    // What Cargo told this test of its own build is of no account for another.
    build.env_remove("CARGO_TARGET_DIR");
    let built = build.output().expect("Cargo");
    assert!(built.status.success(), "{}", String::from_utf8_lossy(&built.stderr));

    let output = Command::new(target.join("debug").join(format!("outside{}", env::consts::EXE_SUFFIX)))
        .output()
        .expect("the program");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    assert_eq!(String::from_utf8_lossy(&output.stdout), OUTPUT);
}
