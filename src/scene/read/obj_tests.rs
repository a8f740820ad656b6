use std::{fs, sync::Arc, time::Instant};

use super::*;
use crate::scene::{Pigment, Texture, Wrap};

/// A folder of files, and how they are read.
struct Folder(tempfile::TempDir);

impl Folder {
    fn new(files: &[(&str, &[u8])]) -> Self {
        let folder = tempfile::tempdir().unwrap();
        for (name, content) in files {
            fs::write(folder.path().join(name), content).unwrap();
        }
        Self(folder)
    }

    fn path(&self, name: &str) -> std::path::PathBuf {
        self.0.path().join(name)
    }

    /// Reads `m.obj`; messages come without the folder's own path.
    fn model(&self) -> Result<(Model, Vec<Arc<Texture>>), String> {
        let assets = Assets::beside(&self.path("m.obj"));
        let mut images = Images::new(&assets);
        read(&assets, "m.obj", Some(&mut images), &mut Budget::default(), &mut |_, _| ())
            .map(|model| (model, images.textures))
            .map_err(|error| error.to_string().replace(&format!("{}/", self.0.path().display()), ""))
    }

    fn alone(&self) -> Result<crate::scene::Description, String> {
        alone(&self.path("m.obj"), &mut |_, _| ())
            .map_err(|error| error.to_string().replace(&format!("{}/", self.0.path().display()), ""))
    }
}

fn obj(text: impl AsRef<[u8]>) -> Result<Mesh, String> {
    Folder::new(&[("m.obj", text.as_ref())]).model().map(|(model, _)| model.mesh)
}

/// The first two coordinates of the triangles' corners.
fn corners(mesh: &Mesh) -> Vec<[[f32; 2]; 3]> {
    mesh.triangles.iter().map(|t| t.map(|i| mesh.positions[i as usize].truncate().into())).collect()
}

/// The sum of the triangles' areas, all of which must face along z.
fn area(mesh: &Mesh) -> f32 {
    let one = |[a, b, c]: [[f32; 2]; 3]| (Vec2::from(b) - Vec2::from(a)).perp_dot(Vec2::from(c) - Vec2::from(a)) / 2.0;
    corners(mesh).into_iter().map(one).inspect(|area| assert!(*area >= 0.0, "{area}")).sum()
}

/// A polygon as a file, the face before its vertices if `early`.
fn polygon_file(points: &[[f32; 2]], early: bool) -> String {
    let vertices: String = points.iter().map(|[x, y]| format!("v {x} {y} 0\n")).collect();
    let face = (1..=points.len()).fold("f".to_owned(), |face, i| format!("{face} {i}"));
    if early { format!("{face}\n{vertices}") } else { format!("{vertices}{face}\n") }
}

#[test]
fn faces_keep_their_order_and_convex_polygons_become_fans() {
    let text = "\u{feff}# a comment\no first\nv 0 0 0\nv 1 0 0 # here\nv 1 1 0\nv 0 1 0\nvn 0 0 1\n\
                f 3 2 1\ng second\nusemtl x\ns off\nl 1 2\nv 0.5 2 0\r\nf -5 -4 \\\n-3 -1 -2# there\n";
    let mesh = obj(text).unwrap();
    let [a, b, c, d, e] = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0], [0.5, 2.0]];
    assert_eq!(corners(&mesh), [[c, b, a], [a, b, c], [a, c, e], [a, e, d]]);
    assert!(mesh.normals.is_empty() && mesh.uvs.is_empty() && mesh.materials.is_empty());
}

#[test]
fn concave_faces_are_divided() {
    let l = [[0.0, 0.0], [3.0, 0.0], [3.0, 1.0], [1.0, 1.0], [1.0, 3.0], [0.0, 3.0]];
    let round = |n: usize, radius: fn(usize) -> f32| -> Vec<[f32; 2]> {
        let at = |i: usize| Vec2::from_angle(i as f32 * std::f32::consts::TAU / n as f32) * radius(i);
        (0..n).map(|i| at(i).into()).collect()
    };
    let star = round(10, |i| if i % 2 == 0 { 1.0 } else { 0.3 });
    let gear = round(144, |i| if i % 4 < 2 { 1.0 } else { 0.9 });
    for points in [l.to_vec(), star, gear] {
        let n = points.len();
        let shoelace = |i: usize| Vec2::from(points[i]).perp_dot(points[(i + 1) % n].into()) / 2.0;
        let whole: f32 = (0..n).map(shoelace).sum();
        for early in [false, true] {
            let mesh = obj(polygon_file(&points, early)).unwrap();
            assert_eq!(mesh.triangles.len(), n - 2);
            assert!((area(&mesh) - whole).abs() < 1e-5, "{} of {whole}", area(&mesh));
        }
    }
}

#[test]
fn what_has_no_area_stays() {
    let mesh = obj("v 2 4 6 2\nv 1 0 0 0.5 0.5 0.5\nv 3 0 0 1 1 1 1\nf 1 2 2\nf 1 2 3\nf 1 1 2 2\n").unwrap();
    assert_eq!(mesh.positions, [Vec3::new(1.0, 2.0, 3.0), Vec3::X, Vec3::X * 3.0]);
    assert_eq!(mesh.triangles, [[0, 1, 1], [0, 1, 2], [0, 0, 1], [0, 1, 1]]);
}

#[test]
fn a_face_may_name_what_comes_later() {
    assert_eq!(obj("f 1 2 3\nv 0 0 0\nv 1 0 0\nv 0 1 0").unwrap().triangles, [[0, 1, 2]]);
    let mesh = obj("f 1/1/1 2/1/1 3/1/1\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 2 3\nvn 0 0 2").unwrap();
    assert_eq!((mesh.uvs, mesh.normals), (vec![Vec2::new(2.0, 3.0); 3], vec![Vec3::Z; 3]));
}

#[test]
fn positions_are_the_exact_f32_of_the_text() {
    let mesh = obj("v 2.20000005 -1.40e-3 .1\nv 16777217 1e-45 -0\nv 1 1 1\nf 1 2 3").unwrap();
    assert_eq!(mesh.positions[0], Vec3::new(2.2, -0.0014, 0.1));
    assert_eq!(mesh.positions[1].to_array().map(f32::to_bits), [16777216.0, 1e-45, -0.0f32].map(f32::to_bits));
}

#[test]
fn vertices_are_shared_by_all_three_indices() {
    let text = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1\nvt 1 1 0\nvt 0 1\nvn 0 0 1\nvn 0 1 0\n\
                f 1/1/1 2/2/1 3/3/1\nf 1/1/1 -2/-2/-2 4/4/2\nf 3/3/2 4/4/2 1/1/2\n";
    let mesh = obj(text).unwrap();
    assert_eq!(mesh.triangles, [[0, 1, 2], [0, 2, 3], [4, 3, 5]]);
    assert_eq!(
        mesh.positions,
        [Vec3::ZERO, Vec3::X, Vec3::new(1.0, 1.0, 0.0), Vec3::Y, Vec3::new(1.0, 1.0, 0.0), Vec3::ZERO]
    );
    assert_eq!(mesh.uvs, [Vec2::ZERO, Vec2::X, Vec2::ONE, Vec2::Y, Vec2::ONE, Vec2::ZERO]);
    assert_eq!(mesh.normals, [Vec3::Z, Vec3::Z, Vec3::Z, Vec3::Y, Vec3::Y, Vec3::Y]);
}

#[test]
fn corners_without_normal_or_uv_get_one() {
    // The first face comes before any other index; the last has a normal of no length.
    let text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nvt 5 6\nvn 3 0 0\nvn 0 0 0\n\
                f 1 2 3\nf 1//1 2//1 4//1\nf 1/1 3/1 4/1\nf 1//2 4//2 2//1\n";
    let mesh = obj(text).unwrap();
    let of = |t: usize, i: usize| mesh.normals[mesh.triangles[t][i] as usize];
    assert_eq!([of(0, 0), of(0, 1), of(0, 2)], [Vec3::Z; 3]);
    assert_eq!([of(1, 0), of(1, 1), of(1, 2)], [Vec3::X; 3]);
    assert_eq!([of(2, 0), of(2, 1), of(2, 2)], [Vec3::X; 3]);
    assert_eq!([of(3, 0), of(3, 1), of(3, 2)], [Vec3::Y, Vec3::Y, Vec3::X]);
    let uv = |t: usize, i: usize| mesh.uvs[mesh.triangles[t][i] as usize];
    assert_eq!([uv(0, 0), uv(1, 2), uv(2, 1)], [Vec2::ZERO, Vec2::ZERO, Vec2::new(5.0, 6.0)]);
    assert!(mesh.normals.iter().all(|n| n.is_normalized()));
    let places = [[0, 1, 2], [0, 1, 3], [0, 2, 3], [0, 3, 1]];
    let named = [Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::Z];
    for (triangle, place) in mesh.triangles.iter().zip(places) {
        assert_eq!(triangle.map(|v| mesh.positions[v as usize]), place.map(|i: usize| named[i]));
    }
}

#[test]
fn every_fault_names_its_line() {
    let v = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    let long = format!("{v}\n{}", "#".repeat(5 << 20));
    let many = format!("{v}f{}", " 1".repeat(polygon::MAX_CORNERS + 1));
    for (text, message) in [
        ("v 0 0\n".into(), "m.obj:1: v: expected 3 numbers, got 2"),
        ("\nv 0 0 0 0 0\n".into(), "m.obj:2: v: expected 3 numbers, got 5"),
        ("v 0 zero 0\n".into(), "m.obj:1: v: not a number: zero"),
        ("v 0 nan 0\n".into(), "m.obj:1: v: must be finite and within ±1e12, got [0, NaN, 0]"),
        ("v 0 0 1e60\n".into(), "m.obj:1: v: must be finite and within ±1e12, got [0, 0, inf]"),
        ("v 1 1 1 0\n".into(), "m.obj:1: v: must be finite and within ±1e12, got [inf, inf, inf]"),
        ("v 1 1 \\\n1\nv 1 \\\nx 1\n".into(), "m.obj:3: v: not a number: x"),
        ("vt\n".into(), "m.obj:1: vt: expected 2 numbers, got 0"),
        ("vt 0 inf\n".into(), "m.obj:1: vt: must be finite, got [0, inf]"),
        ("vn 0 1\n".into(), "m.obj:1: vn: expected 3 numbers, got 2"),
        ("vn 0 1 nan\n".into(), "m.obj:1: vn: must be finite, got [0, 1, NaN]"),
        (format!("{v}f 1 2\n"), "m.obj:4: f: a face needs 3 vertices, got 2"),
        (format!("{v}f\n"), "m.obj:4: f: a face needs 3 vertices, got 0"),
        (format!("{v}f 1 2 3\nf 1 2 4\n"), "m.obj:5: f: vertex 4 of 3 does not exist"),
        (format!("{v}f 0 1 2\n"), "m.obj:4: f: vertex 0 of 3 does not exist"),
        (format!("{v}f -1 -2 -4\n"), "m.obj:4: f: vertex -4 of 3 does not exist"),
        (format!("{v}f 1 2 -9223372036854775808\n"), "m.obj:4: f: vertex -9223372036854775808 of 3 does not exist"),
        (format!("{v}f 1 2 9223372036854775807\n"), "m.obj:4: f: vertex 9223372036854775807 of 3 does not exist"),
        (format!("{v}f 1 2 4294967295\n"), "m.obj:4: f: vertex 4294967295 of 3 does not exist"),
        (format!("{v}f 1 2 4294967294\n"), "m.obj:4: f: vertex 4294967294 of 3 does not exist"),
        (format!("{v}f 1 2 99999999999999999999\n"), "m.obj:4: f: not a vertex index: 99999999999999999999"),
        (format!("{v}f 1 /2 3\n"), "m.obj:4: f: not a vertex index: /2"),
        (format!("{v}f 1/x 2 3\n"), "m.obj:4: f: not a texture coordinate index: 1/x"),
        (format!("{v}f 1//x 2 3\n"), "m.obj:4: f: not a normal index: 1//x"),
        (format!("{v}vn 0 0 1\nf 1//1/1 2 3\n"), "m.obj:5: f: not a vertex index: 1//1/1"),
        (format!("{v}vt 0 0\nf 1/1 2/2 3/1\n"), "m.obj:5: f: texture coordinate 2 of 1 does not exist"),
        (format!("{v}f 1//1 2//1 3//1\n"), "m.obj:4: f: normal 1 of 0 does not exist"),
        (format!("{v}f 1//-1 2 3\n"), "m.obj:4: f: normal -1 of 0 does not exist"),
        (long, "m.obj:5: line: longer than 4194304 bytes"),
        (many, "m.obj:4: f: a face has at most 65536 vertices"),
        (v.into(), "m.obj: no faces"),
        (String::new(), "m.obj: no faces"),
    ] {
        assert_eq!(obj(&text).unwrap_err(), message, "{:?}", text.chars().take(300).collect::<String>());
    }
    assert_eq!(obj(b"v 1 \xff\x1b[31m 2\n").unwrap_err(), "m.obj:1: v: not a number: \u{fffd}\\u{1b}[31m");
}

#[test]
fn limits_hold_for_all_files_together() {
    let f = Folder::new(&[("m.obj", b"v 0 0 0\nf 1 1 1\nf 1 1 1 1\n")]);
    let go = |budget: &mut Budget| read_path(&f.path("m.obj"), None, budget, &mut |_, _| ()).map(|_| ());
    let mut budget = Budget { bytes: 60, triangles: 5 };
    go(&mut budget).unwrap();
    assert_eq!((budget.bytes, budget.triangles), (60 - 26, 2));
    assert!(
        go(&mut budget)
            .unwrap_err()
            .to_string()
            .ends_with(":3: f: mesh files have at most 33554432 triangles together")
    );
    let mut budget = Budget { bytes: 25, triangles: 5 };
    assert!(go(&mut budget).unwrap_err().to_string().ends_with("m.obj: longer than 25 bytes"));
}

#[test]
fn progress_runs_to_the_end() {
    let f = Folder::new(&[("m.obj", format!("v 0 0 0\nf 1 1 1\n{}", "# filler\n".repeat(400_000)).as_bytes())]);
    let mut seen = Vec::new();
    read_path(&f.path("m.obj"), None, &mut Budget::default(), &mut |done, total| seen.push((done, total))).unwrap();
    assert_eq!(seen.len(), 4);
    assert!(seen[0] == (0, 3_600_016) && seen.iter().all(|s| s.1 == 3_600_016) && seen.is_sorted());
}

const SQUARE: &str = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

#[test]
fn materials_are_those_of_the_library() {
    let text = format!(
        "mtllib a.mtl my b.mtl none\n{SQUARE}f 1 2 3\nusemtl unused\nusemtl red\nf 1 2 3 4\nusemtl Material #25\n\
         f 1 2 3\nusemtl red\nf 1 2 3\n"
    )
    .replace(" none", "");
    let text = text.replace("mtllib a.mtl my b.mtl", "mtllib a.mtl c.mtl # both\nmtllib my b.mtl");
    let a = b"# first\nKd 9 9 9\nnewmtl red\r\nKa 1 1 1\nKd 1 0 0.5 # rgb\nKs 0.25 0.5 0.75\nNs 2e9\nillum 5\nd 0.75\nNi 20\nTr 0.9\n";
    let b = b"newmtl Material #25\nKd 0.5\nillum 1\nKs 1 1 1\nTr 1\nNs 0\nKe x y z\n";
    let f =
        Folder::new(&[("m.obj", text.as_bytes()), ("a.mtl", a), ("my b.mtl", b), ("c.mtl", b"newmtl red\nKd 0 1 0")]);
    let (model, _) = f.model().unwrap();
    assert_eq!(model.mesh.materials, [2, 0, 0, 1, 0]);
    assert!(model.bare);
    let red = Material {
        name: "red".into(),
        pigment: Pigment::Color(Vec3::new(1.0, 0.0, 0.5)),
        reflectance: 0.5,
        transmission: 0.25,
        ior: 10.0,
        specular: 0.5,
        shininess: 1e6,
        ..Material::default()
    };
    let other = Material {
        name: "Material #25".into(),
        pigment: Pigment::Color(Vec3::splat(0.5)),
        transmission: 1.0,
        ior: 1.0,
        shininess: 1.0,
        ..Material::default()
    };
    assert_eq!(model.materials, [red, other]);
    let mut added = Vec::new();
    let mesh = model.merge(7, |m| {
        added.push(m.name);
        10 + added.len()
    });
    assert_eq!((mesh.materials, added.join("|")), (vec![7, 11, 11, 12, 11], "red|Material #25".into()));
}

#[test]
fn one_material_for_all_or_none_is_the_meshs_own() {
    let text = format!("mtllib a.mtl\nusemtl red\n{SQUARE}f 1 2 3 4\n");
    let f = Folder::new(&[("m.obj", text.as_bytes()), ("a.mtl", b"newmtl red")]);
    let mesh = f.model().unwrap().0.merge(0, |_| 3);
    assert_eq!((mesh.material, mesh.materials), (3, vec![]));
    let f = Folder::new(&[("m.obj", format!("usemtl red\n{SQUARE}f 1 2 3 4\n").as_bytes())]);
    let mesh = f.model().unwrap().0.merge(5, |_| 3);
    assert_eq!((mesh.material, mesh.materials), (5, vec![]));
}

#[test]
fn faults_of_materials_name_file_and_line() {
    let missing = "No such file or directory (os error 2)";
    let obj = format!("{SQUARE}mtllib a.mtl\nusemtl red\nf 1 2 3 4\n");
    let fault = |obj: &str, mtl: &[u8]| {
        Folder::new(&[("m.obj", obj.as_bytes()), ("a.mtl", mtl)]).model().map(|_| ()).unwrap_err()
    };
    assert_eq!(
        Folder::new(&[("m.obj", obj.as_bytes())]).model().map(|_| ()).unwrap_err(),
        format!("m.obj:5: mtllib: a.mtl: {missing}")
    );
    assert_eq!(fault(&obj.replace("a.mtl", "."), b""), "m.obj:5: mtllib: .: not a regular file");
    assert_eq!(fault(&obj, b"newmtl blue"), "m.obj:6: usemtl: no material \"red\"");
    for (mtl, message) in [
        ("\nKd 1 x 1", "a.mtl:3: Kd: not a number: x"),
        ("Kd 1 1", "a.mtl:2: Kd: expected 3 numbers, got 2"),
        ("Kd 1 -1 1", "a.mtl:2: Kd: must be finite and 0 or more, got [1, -1, 1]"),
        ("Kd 1 2e9 1", "a.mtl:2: Kd: must be at most 1e9, got [1, 2000000000, 1]"),
        ("Ks 2e9", "a.mtl:2: Ks: must be at most 1e9, got [2000000000, 2000000000, 2000000000]"),
        ("Ks nan", "a.mtl:2: Ks: must be finite and 0 or more, got [NaN, NaN, NaN]"),
        ("Ns", "a.mtl:2: Ns: expected a number, got 0"),
        ("d inf", "a.mtl:2: d: must be finite, got inf"),
        ("Ni 1 2", "a.mtl:2: Ni: expected a number, got 2"),
        ("illum two", "a.mtl:2: illum: not a whole number: two"),
        ("map_Kd -clamp on", "a.mtl:2: map_Kd: expected a file"),
        ("map_Kd -s 1 1 1 -clamp on no such.png", &format!("a.mtl:2: map_Kd: no such.png: {missing}")),
    ] {
        let message = message.to_owned();
        let found = fault(&obj, format!("newmtl red\n{mtl}\n").as_bytes());
        if !mtl.ends_with(".png") {
            assert_eq!(found, message);
        } else {
            assert!(found.starts_with("a.mtl:2: map_Kd: no such.png: "), "{found}");
        }
    }
    // Nobody asked for the materials.
    let f = Folder::new(&[("m.obj", obj.as_bytes())]);
    assert!(read_path(&f.path("m.obj"), None, &mut Budget::default(), &mut |_, _| ()).unwrap().bare);
}

#[test]
fn textures_are_beside_their_library() {
    let mut picture = Vec::new();
    let image = ::image::RgbImage::from_raw(2, 1, vec![255, 0, 0, 0, 0, 255]).unwrap();
    image.write_to(&mut std::io::Cursor::new(&mut picture), ::image::ImageFormat::Png).unwrap();
    let f =
        Folder::new(&[("m.obj", format!("{SQUARE}mtllib lib/a.mtl\nusemtl x\nf 1 2 3\nusemtl y\nf 1 3 4").as_bytes())]);
    fs::create_dir_all(f.path("lib/maps")).unwrap();
    let mtl = "newmtl x\nKd 1 1 1\nmap_Kd -s 2 2 -bm 1 maps\\my picture.png\nnewmtl y\nmap_kd other.png\n";
    fs::write(f.path("lib/a.mtl"), mtl).unwrap();
    fs::write(f.path("lib/maps/my picture.png"), &picture).unwrap();
    fs::write(f.path("other.png"), &picture).unwrap();
    let (model, textures) = f.model().unwrap();
    let pigments: Vec<Pigment> = model.materials.iter().map(|m| m.pigment).collect();
    assert_eq!(pigments, [0, 1].map(|texture| Pigment::Texture { texture, size: 1.0, wrap: Wrap::Ends }));
    let expected = Texture { width: 2, height: 1, texels: vec![[255, 0, 0], [0, 0, 255]] };
    assert!(textures.len() == 2 && textures.iter().all(|t| **t == expected));
}

#[test]
fn a_library_is_read_once_however_it_is_spelled() {
    let libraries: String = (0..300).map(|i| format!("mtllib {}a.mtl\n", "d/../".repeat(i % 150))).collect();
    let (obj, mtl) = (format!("{libraries}{SQUARE}usemtl x\nf 1 2 3\n"), "newmtl x\nKd 1 0 0\n");
    let f = Folder::new(&[("m.obj", obj.as_bytes()), ("a.mtl", mtl.as_bytes())]);
    fs::create_dir(f.path("d")).unwrap();
    let assets = Assets::beside(&f.path("m.obj"));
    let mut budget = Budget::default();
    read_path(&f.path("m.obj"), Some(&mut Images::new(&assets)), &mut budget, &mut |_, _| ()).unwrap();
    assert_eq!(MAX_OBJ_BYTES - budget.bytes, (obj.len() + mtl.len()) as u64);
}

#[test]
fn a_scenes_material_counts_before_those_of_the_file() {
    let text = format!("{SQUARE}f 1 2 3 4\nmtllib a.mtl\nusemtl red\nf 1 2 4\nf 1 2 3\n");
    let f = Folder::new(&[("m.obj", text.as_bytes())]);
    let scene = |text: &str| crate::scene::parse(text, &f.path("s.toml")).map_err(|error| error.to_string());
    let own = scene("materials.z.color = [0, 0, 1]\n[[mesh]]\nfile = \"m.obj\"\nmaterial = \"z\"").unwrap();
    assert_eq!((own.materials.len(), own.meshes[0].material, own.meshes[0].materials.len()), (1, 0, 0));
    let file = "[[mesh]]\nfile = \"m.obj\"\n";
    assert!(scene(file).unwrap_err().contains("s.toml:2: mesh[0].file: "));
    fs::write(f.path("a.mtl"), "newmtl red\nKd 1 0 0").unwrap();
    let names =
        |d: &crate::scene::Description| d.materials.iter().map(|m| m.name.as_str()).collect::<Vec<_>>().join(" ");
    let twice = scene(&format!("materials.\"m.obj:red\".color = [0, 0, 1]\n{file}{file}")).unwrap();
    assert_eq!(names(&twice), "m.obj:red default m.obj:red#2 m.obj:red#3");
    assert_eq!([&twice.meshes[0].materials, &twice.meshes[1].materials], [&[1, 1, 2, 2], &[1, 1, 3, 3]]);
    // The scene's own default is the default of the file's faces, too.
    let default = scene(&format!("materials.default.color = [0, 0, 1]\n{file}")).unwrap();
    assert_eq!((names(&default).as_str(), &default.meshes[0].materials[..]), ("default m.obj:red", &[0, 0, 1, 1][..]));
}

#[test]
fn a_file_alone_is_a_scene() {
    let text = format!("{SQUARE}v 0 0 2\nf 1 2 3 4\nmtllib a.mtl\nusemtl red\nf 1 2 5\n");
    let f = Folder::new(&[("m.obj", text.as_bytes()), ("a.mtl", b"newmtl red\nKd 1 0 0")]);
    let scene = f.alone().unwrap();
    let names: Vec<&str> = scene.materials.iter().map(|m| m.name.as_str()).collect();
    assert_eq!((scene.name.as_str(), names.join(" ")), ("m", "floor default red".into()));
    assert_eq!(scene.meshes[0].materials, [1, 1, 2]);
    let size = 6.0_f32.sqrt();
    assert_eq!(scene.camera.look_at, Vec3::new(0.5, 0.5, 1.0));
    assert!((scene.camera.eye.distance(scene.camera.look_at) - 1.15 * size).abs() < 1e-5);
    assert!((0.0..0.01).contains(&scene.planes[0].distance) && scene.planes[0].distance > 0.0);
    assert!(matches!(scene.materials[0].pigment, Pigment::Checker { size, .. } if size == 0.2));
}

#[test]
fn a_mesh_of_any_size_is_a_scene_and_a_point_is_none() {
    for scale in [1e-38_f32, 1e-20, 1e-3, 7.0, 1e4, 4e11] {
        for (x, y, z) in [(1.0, 0.0, 1.0), (0.0, 1.0, 1.0), (1.0, 2.0, 0.0), (0.0, 0.0, 2.0)] {
            let [x, y, z] = [x * scale, y * scale, z * scale];
            let f = Folder::new(&[("m.obj", format!("v 0 0 0\nv {x} {y} {z}\nv {x} 0 0\nf 1 2 3").as_bytes())]);
            let scene = f.alone().unwrap();
            crate::scene::compile(&scene).unwrap();
        }
    }
    // Far from the origin, an ulp apart.
    let f = Folder::new(&[("m.obj", b"v 1e6 1e6 1e6\nv 1000000.06 1e6 1e6\nv 1e6 1e6 1e6\nf 1 2 3")]);
    let _ = f.alone();
    let f = Folder::new(&[("m.obj", b"v 1 2 3\nv 4 5 6\nf 1 1 1")]);
    assert_eq!(f.alone().unwrap_err(), "m.obj: all vertices are at one place");
}

/// A generator of whole numbers (SplitMix64) below a bound.
fn random(state: &mut u64, below: usize) -> usize {
    *state = state.wrapping_add(0x9e37_79b9_7f4a_7c15);
    let z = (*state ^ (*state >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    ((z ^ (z >> 31)) % below as u64) as usize
}

fn spoil(text: &str, state: &mut u64) -> Vec<u8> {
    const BITS: [&str; 28] = [
        "",
        "\n",
        "-",
        "1",
        "nan",
        "inf",
        "1e60",
        "#",
        "a",
        "é",
        "\0",
        "\r",
        "\\\n",
        "/",
        "//",
        " ",
        "f 1 2 3\n",
        "f -1 -2 -3 -4 -5\n",
        "v 1 2 3\n",
        "v 1e12 -1e12 1e-45\n",
        "vn 0 0 0\n",
        "vt 1\n",
        "99999999999",
        "usemtl b\n",
        "usemtl a\n",
        "newmtl a\n",
        "d 0.5\n",
        "map_Kd -o 1 2 x.png\n",
    ];
    let mut bytes = text.as_bytes().to_vec();
    for _ in 0..1 + random(state, 3) {
        let start = random(state, bytes.len() + 1);
        let end = (start + random(state, 6)).min(bytes.len());
        bytes.splice(start..end, BITS[random(state, BITS.len())].bytes());
    }
    bytes
}

/// Reads text as `m.obj`, from memory.
fn read_text(text: &[u8], images: Option<&mut Images<'_>>) -> Result<Model, String> {
    let (path, mut budget, mut ignore) = (Path::new("m.obj"), Budget::default(), |_, _| ());
    let lines = Lines::new(text, path, (budget.bytes, text.len() as u64), &mut ignore);
    read_lines(lines, path, images, &mut budget).map_err(|error| error.to_string())
}

#[track_caller]
fn one_line(message: &str) {
    assert!(!message.chars().any(char::is_control) && !message.is_empty(), "{message:?}");
}

#[test]
fn spoiled_files_are_read_or_refused() {
    let obj = "v 0 0 0\nv 3 0 0\nv 3 1 0\nv 1 1 0\nv 1 3 0\nv 0 3 0\nvt 0 0\nvt 1 1\nvn 0 0 1\nvn 0 1 0\nusemtl a\n\
               f 1/1/1 2/2/1 3/1/2\nusemtl b\nf 1 2 3 4 5 6\nf 1//1 3//1 4//2\nf -1 -2 -3 1/1 2/2\n";
    let (mut state, mut sound, start) = (3, 0, Instant::now());
    let assets = Assets::Builtin;
    for _ in 0..20_000 {
        let model = read_text(&spoil(obj, &mut state), Some(&mut Images::new(&assets)));
        let scene = model.map(|model| crate::scene::Description {
            meshes: vec![model.merge(0, |_| 0)],
            materials: vec![Material::default()],
            ..Default::default()
        });
        match scene {
            Ok(scene) => {
                assert_eq!(crate::scene::check(&scene), Ok(()));
                sound += 1;
            }
            Err(message) => one_line(&message),
        }
    }
    let seconds = start.elapsed().as_secs_f64();
    println!("{sound} of 20000 could be read, {seconds:.1} s");
    assert!((2000..18_000).contains(&sound), "{sound}");
    assert!(seconds < 60.0, "{seconds} s");
}

#[test]
fn spoiled_materials_are_read_or_refused() {
    let mtl = "newmtl a\nKd 1 0 0\nKs 0.5 0.5 0.5\nNs 10\nillum 3\nnewmtl b\nd 0.5\nNi 1.5\nTr 0.5\nKd 0.5\n";
    let (mut state, mut sound) = (4, 0);
    let assets = Assets::Builtin;
    for _ in 0..20_000 {
        let text = spoil(mtl, &mut state);
        let (path, mut ignore, mut library) = (Path::new("a.mtl"), |_, _| (), Library::default());
        let lines = Lines::new(&text[..], path, (1 << 20, text.len() as u64), &mut ignore);
        let read = library.read_lines(lines, path).map(|_| ());
        let mut images = Images::new(&assets);
        let mut material = |name| library.material(name, Path::new(""), &mut images);
        match read.and_then(|()| Ok([material("a")?, material("b")?])) {
            Ok(materials) => {
                let materials = materials.into_iter().flatten().collect();
                assert_eq!(crate::scene::check(&crate::scene::Description { materials, ..Default::default() }), Ok(()));
                sound += 1;
            }
            Err(error) => one_line(&error.to_string()),
        }
    }
    println!("{sound} of 20000 could be read");
    assert!((2000..18_000).contains(&sound), "{sound}");
}
