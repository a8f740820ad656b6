use super::*;

fn obj(text: impl AsRef<[u8]>) -> Result<Mesh, String> {
    parse(text.as_ref(), Path::new("m.obj")).map_err(|error| error.to_string())
}

#[test]
fn faces_keep_their_order_and_polygons_become_fans() {
    let text = "# a comment\nmtllib none.mtl\no first\nv 0 0 0\nv 1 0 0 # here\nv 1 1 0\nv 0 1 0\nvn 0 0 1\n\
                f 3//1 2//1 1//1\ng second\nusemtl x\ns off\nl 1 2\nv 0.5 2 0\r\nf -5 -4 -3 -1 -2\n";
    let mesh = obj(text).unwrap();
    let corners: Vec<[[f32; 2]; 3]> =
        mesh.triangles.iter().map(|t| t.map(|i| mesh.positions[i as usize].truncate().into())).collect();
    let [a, b, c, d, e] = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0], [0.5, 2.0]];
    assert_eq!(corners, [[c, b, a], [a, b, c], [a, c, e], [a, e, d]]);
}

#[test]
fn weights_divide_colours_are_skipped_and_degenerate_triangles_stay() {
    let mesh = obj("v 2 4 6 2\nv 1 0 0 0.5 0.5 0.5\nv 3 0 0 1 1 1 1\nf 1 2 2\nf 1 2 3\n").unwrap();
    assert_eq!(mesh.positions, [Vec3::new(1.0, 2.0, 3.0), Vec3::X, Vec3::X * 3.0]);
    assert_eq!(mesh.triangles, [[0, 1, 1], [0, 1, 2]]);
}

#[test]
fn a_face_may_name_a_later_vertex() {
    assert_eq!(obj("f 1 2 3\nv 0 0 0\nv 1 0 0\nv 0 1 0").unwrap().triangles, [[0, 1, 2]]);
}

#[test]
fn positions_are_the_exact_f32_of_the_text() {
    let mesh = obj("v 2.20000005 -1.40e-3 .1\nv 16777217 1e-45 -0\nv 1 1 1\nf 1 2 3").unwrap();
    assert_eq!(mesh.positions[0], Vec3::new(2.2, -0.0014, 0.1));
    assert_eq!(mesh.positions[1].to_array().map(f32::to_bits), [16777216.0, 1e-45, -0.0f32].map(f32::to_bits));
}

#[test]
fn every_fault_names_its_line() {
    let v = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    for (text, message) in [
        ("v 0 0\n".into(), "m.obj:1: v: expected 3 numbers, got 2"),
        ("\nv 0 0 0 0 0\n".into(), "m.obj:2: v: expected 3 numbers, got 5"),
        ("v 0 zero 0\n".into(), "m.obj:1: v: not a number: zero"),
        ("v 0 nan 0\n".into(), "m.obj:1: v: must be finite and within ±1e12, got [0, NaN, 0]"),
        ("v 0 0 1e60\n".into(), "m.obj:1: v: must be finite and within ±1e12, got [0, 0, inf]"),
        ("v 1 1 1 0\n".into(), "m.obj:1: v: must be finite and within ±1e12, got [inf, inf, inf]"),
        (format!("{v}f 1 2\n"), "m.obj:4: f: a face needs 3 vertices, got 2"),
        (format!("{v}f\n"), "m.obj:4: f: a face needs 3 vertices, got 0"),
        (format!("{v}f 1 2 3\nf 1 2 4\n"), "m.obj:5: f: vertex 4 of 3 does not exist"),
        (format!("{v}f 0 1 2\n"), "m.obj:4: f: vertex 0 of 3 does not exist"),
        (format!("{v}f -1 -2 -4\n"), "m.obj:4: f: vertex -4 of 3 does not exist"),
        (format!("{v}f 1 2 -9223372036854775808\n"), "m.obj:4: f: vertex -9223372036854775808 of 3 does not exist"),
        (format!("{v}f 1 2 9223372036854775807\n"), "m.obj:4: f: vertex 9223372036854775807 of 3 does not exist"),
        (format!("{v}f 1 2 99999999999999999999\n"), "m.obj:4: f: not a vertex index: 99999999999999999999"),
        (format!("{v}f 1 /2 3\n"), "m.obj:4: f: not a vertex index: /2"),
        (v.into(), "m.obj: no faces"),
        (String::new(), "m.obj: no faces"),
    ] {
        assert_eq!(obj(&text).unwrap_err(), message, "{text:?}");
    }
    assert_eq!(obj(b"v 1 \xff\x1b[31m 2\n").unwrap_err(), "m.obj:1: v: not a number: \u{fffd}\\u{1b}[31m");
}

#[test]
fn texture_and_normal_indices_are_not_looked_at() {
    let text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvn x\nf 1/9223372036854775807 2/-7 3//9\n";
    assert_eq!(obj(text).unwrap().triangles, [[0, 1, 2]]);
}
