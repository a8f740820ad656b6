//! The readers from outside: every fault gives its exact line, and no content of any file makes them panic.

use std::{
    fs,
    path::Path,
    time::{Duration, Instant},
};

use glam::Vec3;
use proptest::prelude::*;
use raypacket::scene::{self, Description, Pigment, Sky};

fn parse(text: &str) -> Result<Description, String> {
    scene::parse(text, Path::new("s.toml")).map_err(|error| error.to_string())
}

#[track_caller]
fn fault(text: &str, message: &str) {
    assert_eq!(parse(text).expect_err("the fault must be found"), message, "{text}");
}

#[test]
fn an_empty_file_is_the_default_scene() {
    let expected = Description { name: "s".into(), ..Description::default() };
    assert_eq!(parse("").unwrap(), expected);
}

#[test]
fn every_key_is_read() {
    let text = r#"
        camera = { eye = [1, 2, 3], look_at = [4, 5.5, 6], up = [0, 0, 1], fov = 70 }
        settings = { max_depth = 3, attenuation = false, ambient = [0.5, 0, 0] }
        sky.color = [0, 0, 1]
        light = [{ position = [7, 8, 9], power = [10, 11, 12] }]
        [materials.a]
        checker = { colors = [[1, 1, 1], [0, 0, 0]], size = 2 }
        [materials.b]
        color = [0.1, 0.2, 0.3]
        reflectance = 1
        specular = 0.25
        shininess = 9
        [[plane]]
        normal = [0, 2, 0]
        distance = -1
        material = "b"
        [[sphere]]
        center = [1, 0, 0]
        radius = 3
        material = "a"
        [[sphere]]
        center = [0, 1, 0]
        radius = 0.5
    "#;
    let d = parse(text).unwrap();
    assert_eq!((d.camera.eye, d.camera.look_at), (Vec3::new(1.0, 2.0, 3.0), Vec3::new(4.0, 5.5, 6.0)));
    assert_eq!((d.camera.up, d.camera.fov), (Vec3::Z, 70.0));
    assert_eq!((d.settings.max_depth, d.settings.attenuation, d.settings.ambient), (3, false, Vec3::X * 0.5));
    assert_eq!((d.sky.clone(), d.lights[0].position), (Sky::Color(Vec3::Z), Vec3::new(7.0, 8.0, 9.0)));
    assert_eq!(d.lights[0].power, Vec3::new(10.0, 11.0, 12.0));
    assert_eq!(d.materials.iter().map(|m| m.name.as_str()).collect::<Vec<_>>(), ["a", "b", "default"]);
    let [a, b, default] = &d.materials[..] else { panic!("three materials") };
    assert_eq!(a.pigment, Pigment::Checker { colors: [Vec3::ONE, Vec3::ZERO], size: 2.0 });
    assert_eq!(b.pigment, Pigment::Color(Vec3::new(0.1, 0.2, 0.3)));
    assert_eq!((b.reflectance, b.specular, b.shininess), (1.0, 0.25, 9.0));
    assert_eq!(default.pigment, Pigment::Color(Vec3::splat(0.8)));
    assert_eq!((default.reflectance, default.specular, default.shininess), (0.0, 0.0, 50.0));
    assert_eq!((d.planes[0].normal, d.planes[0].distance, d.planes[0].material), (Vec3::Y * 2.0, -1.0, 1));
    assert_eq!((d.spheres[0].radius, d.spheres[0].material, d.spheres[1].material), (3.0, 0, 2));
}

#[test]
fn every_kind_of_primitive_is_read() {
    let text = r#"
        sky.gradient = [[1, 2, 3], [4, 5, 6]]
        [materials.glass]
        transmission = 0.75
        ior = 1.25
        absorption = [1, 2, 3]
        [[triangle]]
        vertices = [[0, 0, 0], [1, 0, 0], [0, 1, 0]]
        normals = [[0, 0, 1], [0, 1, 1], [1, 0, 1]]
        uvs = [[0, 0.5], [1, 0], [2, 2]]
        material = "glass"
        [[quad]]
        corner = [1, 2, 3]
        u = [1, 0, 0]
        v = [0, 0, 2]
        [[box]]
        min = [-1, -2, -3]
        max = [1, 2, 3]
        rotation = [10, 20, 30]
        [[cylinder]]
        base = [0, 1, 0]
        apex = [0, 3, 0]
        radius = 0.5
        [[cone]]
        base = [0, 0, 0]
        base_radius = 2
        apex = [0, 3, 0]
        apex_radius = 0
        caps = true
        [[torus]]
        center = [5, 0, 0]
        axis = [0, 2, 0]
        major_radius = 2
        minor_radius = 0.5
        [[fractal]]
        center = [0, 0, 7]
        radius = 1
        iterations = 3
        [[disc]]
        center = [0, 0, 9]
        normal = [0, 3, 0]
        radius = 2
    "#;
    let d = parse(text).unwrap();
    assert_eq!(d.sky, Sky::Gradient { below: Vec3::new(1.0, 2.0, 3.0), above: Vec3::new(4.0, 5.0, 6.0) });
    let glass = &d.materials[0];
    assert_eq!((glass.transmission, glass.ior, glass.absorption), (0.75, 1.25, Vec3::new(1.0, 2.0, 3.0)));
    assert!(!glass.additive);
    assert_eq!(d.meshes[0].normals[1], Vec3::new(0.0, 1.0, 1.0));
    assert_eq!((d.meshes[0].uvs[0].y, d.meshes[0].material), (0.5, 0));
    assert_eq!((d.quads[0].corner, d.quads[0].v), (Vec3::new(1.0, 2.0, 3.0), Vec3::Z * 2.0));
    assert_eq!((d.cuboids[0].min, d.cuboids[0].rotation), (Vec3::new(-1.0, -2.0, -3.0), Vec3::new(10.0, 20.0, 30.0)));
    assert_eq!((d.cylinders[0].apex, d.cylinders[0].radius, d.cylinders[0].caps), (Vec3::Y * 3.0, 0.5, false));
    assert_eq!((d.cones[0].base_radius, d.cones[0].apex_radius, d.cones[0].caps), (2.0, 0.0, true));
    assert_eq!((d.tori[0].axis, d.tori[0].major_radius, d.tori[0].minor_radius), (Vec3::Y * 2.0, 2.0, 0.5));
    assert_eq!((d.fractals[0].center, d.fractals[0].radius, d.fractals[0].iterations), (Vec3::Z * 7.0, 1.0, 3));
    assert_eq!((d.discs[0].center, d.discs[0].normal), (Vec3::Z * 9.0, Vec3::Y * 3.0));
    assert_eq!((d.discs[0].radius, d.discs[0].inner_radius), (2.0, 0.0));
    assert_eq!((d.primitives(), d.materials.len()), (8, 2));
}

#[test]
fn discs_are_read_and_checked() {
    let disc = |rest: &str| format!("[[disc]]\ncenter = [1, 2, 3]\nnormal = [0, 0, -2]\n{rest}");
    let d = parse(&disc("radius = 2\ninner_radius = 0.5")).unwrap().discs[0];
    assert_eq!((d.center, d.normal, d.radius, d.inner_radius), (Vec3::new(1.0, 2.0, 3.0), Vec3::Z * -2.0, 2.0, 0.5));
    for (radius, problem) in [
        ("0", "must be above 0, got 0"),
        ("-1", "must be above 0, got -1"),
        ("nan", "must be above 0, got NaN"),
        ("inf", "must be finite, got inf"),
        ("1e13", "must be 1e-12 to 1e12, got 1e13"),
    ] {
        fault(&disc(&format!("radius = {radius}")), &format!("s.toml:4: disc[0].radius: {problem}"));
    }
    for inner in ["2", "3.5", "-0.5", "NaN"] {
        let line = format!("radius = 2\ninner_radius = {}", inner.to_lowercase());
        let problem = format!("s.toml:5: disc[0].inner_radius: must be 0 or more and below radius, got {inner}");
        fault(&disc(&line), &problem);
    }
    fault("[[disc]]\ncenter = [0, 0, 0]\nnormal = [0, 0, 0]\nradius = 1", "s.toml:3: disc[0].normal: must not be zero");
    fault(
        "[[disc]]\ncenter = [0, 2e12, 0]\nnormal = [0, 1, 0]\nradius = 1",
        "s.toml:2: disc[0].center: must be finite and within ±1e12, got [0, 2000000000000, 0]",
    );
    fault(
        &disc("radius = 1\nhole = 1"),
        "s.toml:5: disc[0].hole: unknown key, expected one of `center`, `normal`, \
         `radius`, `inner_radius`, `material`",
    );
    fault("[[disc]]\ncenter = [0, 0, 0]\nnormal = [0, 1, 0]", "s.toml:1: disc[0].radius: missing");
}

#[test]
fn degenerate_primitives() {
    fault(
        "[[triangle]]\nvertices = [[0, 0, 0], [1, 1, 1], [2, 2, 2]]",
        "s.toml:2: triangle[0].vertices: must span an area",
    );
    fault("[[quad]]\ncorner = [0, 0, 0]\nu = [1, 0, 0]\nv = [2, 0, 0]", "s.toml:4: quad[0].v: must span an area");
    fault("[[box]]\nmin = [0, 0, 0]\nmax = [1, 0, 1]", "s.toml:3: box[0].max: must exceed box[0].min, got [1, 0, 1]");
    fault(
        "[[box]]\nmin = [1e6, 0, 0]\nmax = [1000000.1, 1, 1]",
        "s.toml:3: box[0].max: must exceed box[0].min, got [1000000.1, 1, 1]",
    );
    fault(
        "[[cylinder]]\nbase = [1, 1, 1]\napex = [1, 1, 1]\nradius = 1",
        "s.toml:3: cylinder[0].apex: must be at least 1e-12 away from base, is 0e0",
    );
    fault(
        "[[cylinder]]\nbase = [0, 0, 0]\napex = [1, 1, 1]\nradius = 0",
        "s.toml:4: cylinder[0].radius: must be above 0, got 0",
    );
    fault(
        "[[cone]]\nbase = [0, 0, 0]\nbase_radius = 1\napex = [1, 1, 1]\napex_radius = 1",
        "s.toml:5: cone[0].apex_radius: must differ from base_radius; that is a cylinder",
    );
    fault(
        "[[cone]]\nbase = [0, 0, 0]\nbase_radius = nan\napex = [1, 1, 1]\napex_radius = 1",
        "s.toml:3: cone[0].base_radius: must be 0, or 1e-12 to 1e12, got NaN",
    );
    fault(
        "[[torus]]\ncenter = [0, 0, 0]\naxis = [0, 0, 0]\nmajor_radius = 2\nminor_radius = 1",
        "s.toml:3: torus[0].axis: must not be zero",
    );
    fault(
        "[[torus]]\ncenter = [0, 0, 0]\naxis = [0, 0, 1]\nmajor_radius = 2\nminor_radius = 3",
        "s.toml:5: torus[0].minor_radius: must be at most major_radius, got 3",
    );
    fault(
        "[[fractal]]\ncenter = [0, 0, 0]\nradius = 1\niterations = 9",
        "s.toml:4: fractal[0].iterations: must be 0 to 8, got 9",
    );
}

#[test]
fn materials_and_skies_out_of_range() {
    let material = |line: &str, problem: &str| {
        let (key, _) = line.split_once(' ').unwrap();
        fault(&format!("[materials.a]\n{line}"), &format!("s.toml:2: materials.a.{key}: {problem}"));
    };
    material("transmission = 1.5", "must be 0 to 1, got 1.5");
    material("ior = 0", "must be 0.1 to 10, got 0");
    material("absorption = [0, -1, 0]", "must be finite and 0 or more, got [0, -1, 0]");
    material("color = [0, 2e9, 0]", "must be at most 1e9, got [0, 2000000000, 0]");
    material("specular = 2e9", "must be at most 1e9, got 2000000000");
    material("texture_size = 2", "only goes with texture");
    material("texture_wrap = \"clamp\"", "only goes with texture");
    fault(
        "[materials.a]\nreflectance = 0.5\ntransmission = 0.625",
        "s.toml:3: materials.a.transmission: with reflectance at most 1, got 1.125",
    );
    fault(
        "[materials.a]\ncolor = [1, 1, 1]\ntexture = \"x.png\"",
        "s.toml:3: materials.a.texture: only one of color, checker and texture",
    );
    fault("[sky]\ncolor = [1, 1, 1]\nimage = \"x.hdr\"", "s.toml:3: sky.image: only one of color, gradient and image");
    fault("[sky]\nrotation = 5", "s.toml:2: sky.rotation: only goes with image");
    fault(
        "sky.gradient = [[0, 0, 0], [0, 0, -1]]",
        "s.toml:1: sky.gradient[1]: must be finite and 0 or more, got [0, 0, -1]",
    );
}

#[test]
fn a_file_may_define_the_default_material() {
    let d = parse("[materials.default]\ncolor = [1, 0, 0]\n[[sphere]]\ncenter = [0, 0, 0]\nradius = 1").unwrap();
    assert_eq!((d.materials.len(), &d.materials[0].pigment), (1, &Pigment::Color(Vec3::X)));
}

#[test]
fn syntax_faults() {
    fault("[camera]\nfov = = 3", "s.toml:2: fov: invalid TOML: extra `=`, expected nothing");
    fault("a = \"x", "s.toml:1: a: invalid TOML: invalid basic string, expected `\"`");
    fault("[camera\nfov = 3", "s.toml:1: [camera: invalid TOML: unclosed table, expected `]`");
    fault("[camera]\nfov = 3\nfov = 4", "s.toml:3: fov: invalid TOML: duplicate key");
    fault("[camera]\n[camera]", "s.toml:2: [camera]: invalid TOML: duplicate key");
    fault("\nx", "s.toml:2: x: invalid TOML: key with no value, expected `=`");
    fault(
        &format!("x = {}", "[".repeat(100_000)),
        "s.toml:1: x: invalid TOML: cannot recurse further; max recursion depth met",
    );
    fault(
        &"a.".repeat(100_000),
        "s.toml:1: a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.: invalid TOML: key with no value, expected `=`",
    );
    fault(
        &format!("{}a = 1", "a.".repeat(100_000)),
        "s.toml:1: a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.: invalid TOML: recursion limit",
    );
    fault(
        &format!("[{}a]", "a.".repeat(100_000)),
        "s.toml:1: [a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a: invalid TOML: recursion limit",
    );
    fault(
        &format!("x = {}", "{a=".repeat(100_000)),
        "s.toml:1: x: invalid TOML: cannot recurse further; max recursion depth met",
    );
}

/// Tables that take no room in the file take much in memory.
#[test]
fn too_many_tables() {
    let most = 1 << 20;
    let problem = format!("s.toml: more than {most} tables");
    for many in ["{},", "1.1 .1.1", "{a.a={a.a=1}},", "\"\".''.", "[1.1.a]\n"] {
        fault(&format!("x = [\n{}", many.repeat(most + 2)), &problem);
    }
}

#[test]
fn unknown_keys() {
    fault(
        "colour = 3",
        "s.toml:1: colour: unknown key, expected one of `camera`, `settings`, `sky`, `light`, `materials`, `plane`, `sphere`, `triangle`, `quad`, `box`, `cylinder`, `cone`, `torus`, `fractal`, `disc`, `mesh`",
    );
    fault(
        "[camera]\nfov = 3\nzoom = 2",
        "s.toml:3: camera.zoom: unknown key, expected one of `eye`, `look_at`, `up`, `fov`",
    );
    fault(
        "[[sphere]]\ncenter = [0, 0, 0]\nradius = 1\n[[sphere]]\ncenter = [0, 0, 0]\nradius = 1\nrad = 1",
        "s.toml:7: sphere[1].rad: unknown key, expected one of `center`, `radius`, `material`",
    );
    fault(
        "[[blob]]\nvertices = []",
        "s.toml:1: blob: unknown key, expected one of `camera`, `settings`, `sky`, `light`, `materials`, `plane`, `sphere`, `triangle`, `quad`, `box`, `cylinder`, `cone`, `torus`, `fractal`, `disc`, `mesh`",
    );
    fault(
        "[materials.floor]\ndensity = 1",
        "s.toml:2: materials.floor.density: unknown key, expected one of `color`, `checker`, `texture`, `texture_size`, `texture_wrap`, `reflectance`, `transmission`, `ior`, `absorption`, `specular`, `shininess`",
    );
    fault(
        "[materials.floor.checker]\nior = 1",
        "s.toml:2: materials.floor.checker.ior: unknown key, expected `colors` or `size`",
    );
    fault(
        "\"a\\nb\" = 1",
        "s.toml:1: \"a\\nb\": unknown key, expected one of `camera`, `settings`, `sky`, `light`, `materials`, `plane`, `sphere`, `triangle`, `quad`, `box`, `cylinder`, `cone`, `torus`, `fractal`, `disc`, `mesh`",
    );
    fault(
        "[sky]\nstars = 5",
        "s.toml:2: sky.stars: unknown key, expected one of `color`, `gradient`, `image`, `rotation`",
    );
}

#[test]
fn missing_keys() {
    fault("[[sphere]]\nradius = 1\n\n[[sphere]]\ncenter = [0, 0, 0]", "s.toml:1: sphere[0].center: missing");
    fault("sphere = [\n {},\n]", "s.toml:2: sphere[0].center: missing");
    fault("\n[[light]]\nposition = [0, 0, 0]", "s.toml:2: light[0].power: missing");
    fault("[materials.\"my floor\".checker]\nsize = 1", "s.toml:1: materials.\"my floor\".checker.colors: missing");
    fault("\n[[mesh]]", "s.toml:2: mesh[0].file: missing");
}

#[test]
fn wrong_types() {
    fault("[camera]\nfov = \"wide\"", "s.toml:2: camera.fov: invalid type: string \"wide\", expected a number");
    fault("[camera]\neye = [1, 2]", "s.toml:2: camera.eye: invalid length 2, expected an array of 3");
    fault("[camera]\neye = [1, 2, 3, 4]", "s.toml:2: camera.eye: invalid length 4, expected an array of 3");
    fault(
        "[camera]\neye = [\n1,\ntrue,\n3]",
        "s.toml:4: camera.eye[1]: invalid type: boolean `true`, expected a number",
    );
    fault("[camera]\neye = 1", "s.toml:2: camera.eye: invalid type: integer `1`, expected an array of 3");
    fault(
        "camera = [[0, 0, 0], [0, 0, 1], [0, 1, 0], 60]",
        "s.toml:1: camera: invalid type: sequence, expected a table",
    );
    fault("camera = 1", "s.toml:1: camera: invalid type: integer `1`, expected a table");
    fault("[sphere]\nradius = 1", "s.toml:1: sphere: invalid type: map, expected an array");
    fault("sphere = [1]", "s.toml:1: sphere[0]: invalid type: integer `1`, expected a table");
    fault(
        "settings.max_depth = -1",
        "s.toml:1: settings.max_depth: invalid value: integer `-1`, expected a whole number",
    );
    fault(
        "settings.max_depth = 2.5",
        "s.toml:1: settings.max_depth: invalid type: floating point `2.5`, expected a whole number",
    );
    fault(
        "settings.max_depth = 99999999999",
        "s.toml:1: settings.max_depth: invalid value: integer `99999999999`, expected a whole number",
    );
    fault("settings.attenuation = 1", "s.toml:1: settings.attenuation: invalid type: integer `1`, expected a boolean");
    fault(
        "camera.fov = 99999999999999999999999999999999999999999999999999999",
        "s.toml:1: camera.fov: integer number overflowed",
    );
    fault(
        "camera.fov = 99999999999999999999",
        "s.toml:1: camera.fov: invalid type: integer `99999999999999999999` as i128, expected a number",
    );
    fault(
        "camera.fov = 0x1_0000_0000_0000_0000",
        "s.toml:1: camera.fov: invalid type: integer `18446744073709551616` as i128, expected a number",
    );
    fault(
        "settings.max_depth = 2.0",
        "s.toml:1: settings.max_depth: invalid type: floating point `2.0`, expected a whole number",
    );
    fault("camera.fov = 1979-05-27", "s.toml:1: camera.fov: invalid type: date, expected a number");
    fault("camera = 1979-05-27", "s.toml:1: camera: invalid type: date, expected a table");
    fault("materials = 1", "s.toml:1: materials: invalid type: integer `1`, expected a table");
    fault("materials.a = 1", "s.toml:1: materials.a: invalid type: integer `1`, expected a table");
    fault(
        "materials.a.checker = { colors = [[1, 1, 1]], size = 1 }",
        "s.toml:1: materials.a.checker.colors: invalid length 1, expected an array of 2",
    );
    fault(
        "[[sphere]]\ncenter = [0, 0, 0]\nradius = 1\nmaterial = 7",
        "s.toml:4: sphere[0].material: invalid type: integer `7`, expected a string",
    );
}

#[test]
fn values_out_of_range() {
    fault(
        "\n\n[camera]\neye = [1, 2, 3]\nlook_at = [1, 2, 3]",
        "s.toml:5: camera.look_at: must differ from camera.eye",
    );
    fault("[camera]\neye = [0, 1, 0]", "s.toml:1: camera.look_at: must differ from camera.eye");
    fault("[camera]\nup = [0, 0, 0]", "s.toml:2: camera.up: must not be zero");
    fault("[camera]\nfov = 180", "s.toml:2: camera.fov: must be at least 0.01 and below 180, got 180");
    fault("[camera]\neye = [0, nan, 0]", "s.toml:2: camera.eye: must be finite and within ±1e18, got [0, NaN, 0]");
    fault("[camera]\neye = [0, 1e60, 0]", "s.toml:2: camera.eye: must be finite and within ±1e18, got [0, inf, 0]");
    fault("[camera]\neye = [0, 1e999, 0]", "s.toml:2: camera.eye[1]: floating-point number overflowed");
    fault("settings.max_depth = 65", "s.toml:1: settings.max_depth: must be 1 to 64, got 65");
    fault("[sky]\ncolor = [0, 0, -1]", "s.toml:2: sky.color: must be finite and 0 or more, got [0, 0, -1]");
    fault(
        "[[light]]\nposition = [0, 0, 0]\npower = [0, 0, -1]",
        "s.toml:3: light[0].power: must be finite and 0 or more, got [0, 0, -1]",
    );
    fault(
        "[[light]]\nposition = [0, 0, inf]\npower = [0, 0, 1]",
        "s.toml:2: light[0].position: must be finite and within ±1e18, got [0, 0, inf]",
    );
    fault("\n[materials.a]\nreflectance = 1.01", "s.toml:3: materials.a.reflectance: must be 0 to 1, got 1.01");
    fault(
        "[materials.\"my floor\"]\nchecker = { colors = [[1, 1, 1], [0, 0, 0]], size = 0 }",
        "s.toml:2: materials.\"my floor\".checker.size: must be above 0, got 0",
    );
    fault(
        "[materials.a]\ncolor = [1, 1, 1]\nchecker = { colors = [[1, 1, 1], [0, 0, 0]], size = 1 }",
        "s.toml:3: materials.a.checker: only one of color, checker and texture",
    );
    fault(
        "[materials.a]\ncolor = [1, 1, -1]",
        "s.toml:2: materials.a.color: must be finite and 0 or more, got [1, 1, -1]",
    );
    fault("[[plane]]\nnormal = [0, 0, 0]\ndistance = 1", "s.toml:2: plane[0].normal: must not be zero");
    fault(
        "sphere = [\n { center = [0, 0, 0], radius = 1 },\n { center = [0, 0, 0], radius = -1 },\n]",
        "s.toml:3: sphere[1].radius: must be above 0, got -1",
    );
    fault(
        "[[sphere]]\ncenter = [0, 0, 0]\nradius = 1\n[[sphere]]\ncenter = [0, 0, 0]\nradius = 0",
        "s.toml:6: sphere[1].radius: must be above 0, got 0",
    );
}

#[test]
fn materials_that_do_not_exist() {
    let scene = |name: &str| {
        format!(
            "[materials.floor]\n[materials.gold]\n[[sphere]]\ncenter = [0, 0, 0]\nradius = 1\nmaterial = \"{name}\""
        )
    };
    fault(&scene("glod"), "s.toml:6: sphere[0].material: no material \"glod\", did you mean \"gold\"?");
    fault(&scene("silver"), "s.toml:6: sphere[0].material: no material \"silver\"");
    fault(&scene("a\\nb"), "s.toml:6: sphere[0].material: no material \"a\\nb\"");
    let long = parse(&scene(&"x".repeat(5000))).unwrap_err();
    assert!(long.ends_with("x…") && long.len() < 400, "{long}");
    // A name full of dots must not make the search for its line long.
    let dots = format!("[materials.\"{}\"]\nreflectance = 2", "a.".repeat(100_000));
    assert!(parse(&dots).unwrap_err().starts_with("s.toml:2: materials.\"a.a."));
}

/// A folder with the given files, which goes away with the value.
fn folder(files: &[(&str, &[u8])]) -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    for (name, content) in files {
        fs::write(folder.path().join(name), content).unwrap();
    }
    folder
}

/// What reading the folder's `s.toml` says, with the folder's own path left out.
fn read(folder: &tempfile::TempDir) -> Result<Description, String> {
    let result = scene::read(&folder.path().join("s.toml"));
    result.map_err(|error| error.to_string().replace(&format!("{}/", folder.path().display()), ""))
}

const MESH: &[u8] = b"[[mesh]]\nfile = \"m.obj\"\n";

#[test]
fn a_mesh_is_found_beside_its_scene() {
    let f =
        folder(&[("s.toml", MESH), ("m.obj", b"v -12 0 -12\nv 12 0 12\nv 12 0 -12\nv -12 0 12\nf 1 2 3\nf 1 4 2\n")]);
    let scene = read(&f).unwrap();
    assert_eq!((scene.name.as_str(), scene.primitives()), ("s", 2));
    let corner = |t: usize, i: usize| scene.meshes[0].positions[scene.meshes[0].triangles[t][i] as usize];
    assert_eq!([corner(0, 0), corner(0, 1)], [Vec3::new(-12.0, 0.0, -12.0), Vec3::new(12.0, 0.0, 12.0)]);
    assert_eq!([corner(1, 1), corner(1, 2)], [Vec3::new(-12.0, 0.0, 12.0), Vec3::new(12.0, 0.0, 12.0)]);
}

#[test]
fn mesh_faults_name_both_files() {
    let fault = |obj: &[u8], message: &str| {
        let f = folder(&[("s.toml", MESH), ("m.obj", obj)]);
        assert_eq!(read(&f).unwrap_err(), message);
    };
    fault(b"v 0 0 0\nf 1 1 2\n", "s.toml:2: mesh[0].file: m.obj:2: f: vertex 2 of 1 does not exist");
    fault(b"v 0 0 nan\n", "s.toml:2: mesh[0].file: m.obj:1: v: must be finite and within ±1e12, got [0, 0, NaN]");
    fault(b"\x00\xff\xfe", "s.toml:2: mesh[0].file: m.obj: no faces");
    let missing = read(&folder(&[("s.toml", MESH)])).unwrap_err();
    assert_eq!(missing, "s.toml:2: mesh[0].file: m.obj: No such file or directory (os error 2)");
    let itself = read(&folder(&[("s.toml", b"mesh = [{ file = \".\" }]")])).unwrap_err();
    assert!(itself.starts_with("s.toml:1: mesh[0].file: ") && itself.ends_with(": not a regular file"), "{itself}");
    let nul = read(&folder(&[("s.toml", br#"mesh = [{ file = "a\u0000\nb" }]"#)])).unwrap_err();
    assert_eq!(nul, "s.toml:1: mesh[0].file: a\\u{0}\\nb: file name contained an unexpected NUL byte");
}

/// As long as a line may be, in the shortest parts: minutes, if each part cost as much as all before.
#[test]
fn a_line_that_goes_on_a_million_times() {
    let obj = format!("v 0 0 0 \\\n{}\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", "\\\n".repeat(1_900_000));
    let f = folder(&[("s.toml", MESH), ("m.obj", obj.as_bytes())]);
    let started = Instant::now();
    assert_eq!(read(&f).unwrap().primitives(), 1);
    assert!(started.elapsed() < Duration::from_secs(30), "{:?}", started.elapsed());
}

#[test]
fn mesh_files_share_one_limit() {
    let f = folder(&[("s.toml", b"[[mesh]]\nfile = \"a.obj\"\n[[mesh]]\nfile = \"b.obj\"\n"), ("b.obj", b"")]);
    fs::write(f.path().join("a.obj"), "v 0 0 0\nf 1 1 1\n").unwrap();
    fs::File::options().write(true).open(f.path().join("b.obj")).unwrap().set_len(scene::MAX_OBJ_BYTES).unwrap();
    assert_eq!(read(&f).unwrap_err(), "s.toml:4: mesh[1].file: b.obj: longer than 1073741808 bytes");
}

#[test]
fn files_that_cannot_be_read() {
    assert_eq!(read(&folder(&[])).unwrap_err(), "s.toml: No such file or directory (os error 2)");
    let not_text = read(&folder(&[("s.toml", b"[sky]\ncolor = \"\xff\"\n")])).unwrap_err();
    assert_eq!(not_text, "s.toml:2: color: not UTF-8 text");
    let f = folder(&[("s.toml", b"")]);
    fs::File::create(f.path().join("s.toml")).unwrap().set_len(scene::MAX_TOML_BYTES + 1).unwrap();
    assert_eq!(read(&f).unwrap_err(), "s.toml: longer than 16777216 bytes");
    let error = scene::parse("x", Path::new("a\nb.toml")).unwrap_err();
    assert_eq!(error.to_string(), "a\\nb.toml:1: x: invalid TOML: key with no value, expected `=`");
}

fn one_line(result: Result<Description, String>) {
    if let Err(message) = result {
        assert!(!message.chars().any(char::is_control) && !message.is_empty(), "{message:?}");
    }
}

/// The built-in scenes, without most of the flake's spheres.
fn sources() -> Vec<String> {
    scene::builtins().iter().map(|b| b.source.lines().take(140).collect::<Vec<_>>().join("\n")).collect()
}

/// Text spoiled in a few places: bytes left out, and something put there instead.
fn spoil(text: &str, faults: &[(prop::sample::Index, usize, String)]) -> Vec<u8> {
    let mut bytes = text.as_bytes().to_vec();
    for (at, gap, insert) in faults {
        let start = at.index(bytes.len() + 1);
        let end = (start + gap).min(bytes.len());
        bytes.splice(start..end, insert.bytes());
    }
    bytes
}

fn faults() -> impl Strategy<Value = Vec<(prop::sample::Index, usize, String)>> {
    let bits = prop::sample::select(vec![
        "",
        "\n",
        "-",
        "1",
        "nan",
        "inf",
        "1e60",
        "[",
        "]",
        "{",
        "}",
        "=",
        "\"",
        "'",
        "\"\"\"",
        ".",
        ",",
        "#",
        "a",
        "é",
        "\0",
        "\r",
        "[[sphere]]",
        "f 1 2 3\n",
        "f -1 -2 -3\n",
        "/",
        "//",
        "v 1 2 3\n",
        "99999999999",
        "\u{2028}",
    ]);
    prop::collection::vec((any::<prop::sample::Index>(), 0..6usize, bits.prop_map(str::to_owned)), 1..5)
}

const OBJ: &str = "# cube\no cube\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nvt 0 0\nvn 0 0 1\n\
                   f 1/1/1 2/1/1 3/1/1\nf 1//1 3//1 4//1\ng top\nf -1 -2 -3 1 2\n";

proptest! {
    #![proptest_config(ProptestConfig { cases: 300, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn any_bytes_are_read_or_refused(bytes in prop::collection::vec(any::<u8>(), 0..300)) {
        one_line(parse(&String::from_utf8_lossy(&bytes)));
        one_line(read(&folder(&[("s.toml", &bytes)])));
        one_line(read(&folder(&[("s.toml", MESH), ("m.obj", &bytes)])));
    }

    #[test]
    fn spoiled_scenes_are_read_or_refused(which in 0..4usize, faults in faults()) {
        one_line(parse(&String::from_utf8_lossy(&spoil(&sources()[which], &faults))));
    }

    #[test]
    fn spoiled_meshes_are_read_or_refused(faults in faults()) {
        one_line(read(&folder(&[("s.toml", MESH), ("m.obj", &spoil(OBJ, &faults))])));
    }
}
