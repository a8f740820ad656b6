use super::*;
use std::{
    io::Cursor,
    time::{Duration, Instant},
};

const VIEW: &str = "v from 0 0 5 at 0 0 0 up 0 1 0 angle 45 hither 0.1 resolution 512 512\n";

fn raw(text: impl AsRef<[u8]>) -> Result<Description, String> {
    // A small buffer, so that tokens and comments run across its ends.
    let input = BufReader::with_capacity(7, Cursor::new(text.as_ref()));
    parse(input, Path::new("m.nff"), 1 << 20, &mut |_| ()).map_err(|error| error.to_string())
}

/// A file with the view in its first line.
fn nff(text: &str) -> Result<Description, String> {
    raw(format!("{VIEW}{text}"))
}

fn sound(text: &str) -> Description {
    nff(text).unwrap_or_else(|error| panic!("{text:?}: {error}"))
}

/// Every entity, once.
const ALL: &str = "b 0.1 0.2 0.3\nl 4 3 2\nl 1 -4 4 1 0.5 0\nf 1 0.5 0.25 0.8 0.5 30 0 0\ns 1 2 3 0.5\n\
    c 0 0 0 1 0 0 2 0.5\nc 0 0 0 1 0 0 2 1\np 4\n0 0 0\n2 0 0\n2 1 0\n0 1 0\n\
    pp 3\n0 0 0 0 0 1\n1 0 0 0 0 2\n0 1 0 0 1 1\n";

#[test]
fn every_entity_becomes_what_it_is() {
    let d = sound(ALL);
    assert_eq!(d.name, "m");
    assert_eq!(d.camera, CameraDescription { eye: Vec3::Z * 5.0, look_at: Vec3::ZERO, up: Vec3::Y, fov: 45.0 });
    assert_eq!(d.sky, Sky::Color(Vec3::new(0.1, 0.2, 0.3)));
    assert_eq!(
        d.lights.iter().map(|l| l.position).collect::<Vec<_>>(),
        [Vec3::new(4.0, 3.0, 2.0), Vec3::new(1.0, -4.0, 4.0)]
    );
    let material = Material {
        name: "f1".into(),
        pigment: Pigment::Color(Vec3::new(1.0, 0.5, 0.25) * 0.8),
        reflectance: 0.5,
        ior: 1.0,
        additive: true,
        specular: 0.5,
        shininess: 30.0,
        ..Material::default()
    };
    assert_eq!(d.materials, [material]);
    let (sides, material, caps) = (Sides::Front, 0, false);
    assert_eq!(d.spheres, [Sphere { center: Vec3::new(1.0, 2.0, 3.0), radius: 0.5, sides, material }]);
    let (base, apex) = (Vec3::ZERO, Vec3::Z * 2.0);
    assert_eq!(d.cones, [Cone { base, base_radius: 1.0, apex, apex_radius: 0.5, caps, sides, material }]);
    assert_eq!(d.cylinders, [Cylinder { base, apex, radius: 1.0, caps, sides, material }]);
    let [flat, smooth] = &d.meshes[..] else { panic!("{} meshes", d.meshes.len()) };
    assert_eq!(flat.positions, [[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [0.0, 1.0]].map(|[x, y]| Vec3::new(x, y, 0.0)));
    assert_eq!((flat.triangles.len(), &flat.materials[..], flat.sides), (2, &[0, 0][..], Sides::Front));
    assert!(flat.normals.is_empty());
    assert_eq!(smooth.positions, [Vec3::ZERO, Vec3::X, Vec3::Y]);
    assert_eq!(smooth.normals, [Vec3::Z, Vec3::Z * 2.0, Vec3::new(0.0, 1.0, 1.0)]);
    assert_eq!((&smooth.triangles[..], &smooth.materials[..], smooth.sides), (&[[0, 1, 2]][..], &[0][..], Sides::Both));
    assert_eq!(d.primitives(), 1 + 1 + 1 + 2 + 1);
}

#[test]
fn white_space_and_comments_do_not_matter() {
    let one_line = format!("{VIEW}{ALL}").replace('\n', " ");
    assert_eq!(raw(one_line).unwrap(), sound(ALL));
    let line_each = format!("{VIEW}{ALL}").replace([' ', '\n'], " # s 1 1 1 1\r\n\t");
    assert_eq!(raw(line_each).unwrap(), sound(ALL));
    let touching = format!("#\n#v\n{VIEW}{ALL}").replace("\n", "#x\n") + "# no end of the line";
    assert_eq!(raw(touching).unwrap(), sound(ALL));
}

#[test]
fn the_parts_of_a_view_come_in_any_order_and_some_may_be_absent() {
    let view = "v\nangle 30\nup 0 0 2\nat 1 1 1\nfrom 2 3 4\n";
    let camera = CameraDescription {
        eye: Vec3::new(2.0, 3.0, 4.0),
        look_at: Vec3::ONE,
        up: Vec3::new(0.0, 0.0, 2.0),
        fov: 30.0,
    };
    let d = raw(view).unwrap();
    assert_eq!(d.camera, camera);
    assert_eq!(d, Description { name: "m".into(), camera, settings: d.settings, ..Description::default() });
}

#[test]
fn lights_share_what_the_format_gives_them() {
    for (n, intensity) in [(1, 0.5), (2, 0.353_553_39), (4, 0.25), (7, 0.188_982_24), (16, 0.125)] {
        let d = sound(&"l 1 2 3\n".repeat(n));
        assert!(d.lights.len() == n && d.lights.iter().all(|l| l.power == Vec3::splat(intensity)), "{n}");
        assert_eq!(
            d.settings,
            Settings { max_depth: 5, attenuation: false, ambient: Vec3::splat(intensity), ..Settings::default() }
        );
    }
    let none = sound("s 0 0 0 1\n");
    assert_eq!(none.settings, Settings { max_depth: 5, attenuation: false, ..Settings::default() });
    // A coloured light counts, and keeps its colour.
    let d = sound("l 1 2 3 0.5 0.6 0.7 l 3 2 1 l 1 1 1 l 2 2 2 s 0 0 0 1");
    assert_eq!(d.lights[0].power, Vec3::new(0.5, 0.6, 0.7));
    assert!(d.lights[1..].iter().all(|l| l.power == Vec3::splat(0.25)));
    assert_eq!(d.settings.ambient, Vec3::splat(0.25));
}

#[test]
fn materials_are_shared_and_follow_the_conventions() {
    let ball = "s 0 0 0 1\n";
    let d = sound(&format!(
        "{ball}f 1 1 1 0.5 0.25 100000 0 0\n{ball}f 1 1 1 0.5 0.25 0 0.75 1.5\n{ball}f 1 1 1 0.5 0.25 100000 0 0\n\
         {ball}f 0.5 1 0 1 1 99999 1 2.5\n{ball}"
    ));
    assert_eq!(d.spheres.iter().map(|s| s.material).collect::<Vec<_>>(), [0, 1, 2, 1, 3]);
    assert_eq!(d.materials.iter().map(|m| m.name.as_str()).collect::<Vec<_>>(), ["default", "f1", "f2", "f3"]);
    assert_eq!(d.materials[0], Material::default());
    let lit = |i: usize| {
        let m = &d.materials[i];
        [m.reflectance, m.specular, m.transmission, m.ior]
    };
    assert_eq!([lit(1), lit(2), lit(3)], [[0.25, 0.0, 0.0, 1.0], [0.25, 0.0, 0.75, 1.5], [1.0, 1.0, 1.0, 2.5]]);
    assert_eq!(d.materials[3].shininess, 99999.0);
    assert!(d.materials[1..].iter().all(|m| m.additive));
}

#[test]
fn sides_follow_the_radius_and_the_material() {
    let things = "s 0 0 0 2 s 0 0 0 -2\nc 0 0 0 1 1 0 0 1 c 0 0 0 -1 1 0 0 -1\n\
        c 0 0 0 1 1 0 0 0 c 0 0 0 0 1 0 0 -1 c 0 0 0 -2 1 0 0 -1\np 3 0 0 0 1 0 0 0 1 0\n\
        pp 3 0 0 0 0 0 1 1 0 0 0 0 1 0 1 0 0 0 1\n";
    let d = sound(&format!("{things}f 1 1 1 1 0 1 0.5 1.5 {things}"));
    let (front, back, both) = (Sides::Front, Sides::Back, Sides::Both);
    assert_eq!(d.spheres.iter().map(|s| s.sides).collect::<Vec<_>>(), [front, back, both, both]);
    assert_eq!(d.cylinders.iter().map(|c| c.sides).collect::<Vec<_>>(), [front, back, both, both]);
    assert_eq!(d.cones.iter().map(|c| c.sides).collect::<Vec<_>>(), [front, back, back, both, both, both]);
    let meshes: Vec<_> = d.meshes.iter().map(|m| (m.sides, &m.materials[..], m.normals.len())).collect();
    assert_eq!(meshes, [(front, &[0][..], 0), (both, &[1][..], 0), (both, &[0, 1][..], 6)]);
    assert!(d.spheres.iter().all(|s| s.radius == 2.0) && d.cylinders.iter().all(|c| c.radius == 1.0));
    assert_eq!((d.cones[1].base_radius, d.cones[1].apex_radius), (0.0, 1.0));
}

/// Twice the vector area of a mesh's triangles, and twice the sum of their areas.
fn areas(mesh: &Mesh) -> (DVec3, f64) {
    mesh.triangles.iter().fold((DVec3::ZERO, 0.0), |(sum, total), corners| {
        let [a, b, c] = corners.map(|i| mesh.positions[i as usize].as_dvec3());
        let area = (b - a).cross(c - a);
        (sum + area, total + area.length())
    })
}

#[test]
fn concave_polygons_keep_their_area_and_their_front() {
    // A wheel of 16 teeth: of its 64 corners half are reflex. Seen along z, counter-clockwise.
    let mut text = String::from("p 64\n");
    let mut outline = Vec::new();
    for i in 0..64 {
        let radius = if i % 4 < 2 { 1.0 } else { 0.75 };
        let angle = f64::from(i) / 64.0 * std::f64::consts::TAU;
        let [x, y] = [angle.cos() * radius, angle.sin() * radius].map(|x| x as f32);
        text += &format!("{x} {y} 2\n");
        outline.push(DVec3::new(x.into(), y.into(), 0.0));
    }
    let shoelace: DVec3 = (0..64).map(|i| outline[i].cross(outline[(i + 1) % 64])).sum();
    let d = sound(&text);
    let (sum, total) = areas(&d.meshes[0]);
    assert_eq!(d.meshes[0].triangles.len(), 62);
    assert!((sum - shoelace).length() < 1e-12 && (total - shoelace.z).abs() < 1e-12, "{sum} {total} {shoelace}");
    assert!(shoelace.z > 4.0);
}

#[test]
fn several_polygons_share_a_mesh() {
    let square = "p 4 0 0 0 1 0 0 1 1 0 0 1 0\n";
    let d = sound(&format!("f 1 0 0 1 0 1 0 0 {square}f 0 1 0 1 0 1 0 0 p 3 5 0 0 6 0 0 5 1 0\n{square}"));
    assert_eq!(d.meshes.len(), 1);
    let mesh = &d.meshes[0];
    assert_eq!((mesh.positions.len(), mesh.triangles.len(), &mesh.materials[..]), (11, 5, &[0, 0, 1, 1, 1][..]));
    let (sum, total) = areas(mesh);
    assert_eq!((sum, total), (DVec3::Z * 5.0, 5.0));
}

#[test]
fn patches_turn_to_where_their_normals_point() {
    for (z, front) in [("1", 1.0), ("-3", -1.0)] {
        let d = sound(&format!("pp 4 0 0 0 0 0 {z} 2 0 0 0 0 {z} 2 2 0 1 0 {z} 0 2 0 0 0 {z}"));
        assert_eq!(areas(&d.meshes[0]), (DVec3::Z * 8.0 * front, 8.0));
        assert_eq!(d.meshes[0].normals[2], Vec3::new(1.0, 0.0, z.parse().unwrap()));
    }
}

/// Files that have a view in their first line, with what is wrong with them.
const FAULTS: [(&str, &str); 51] = [
    ("q 1 2", "2: q: unknown entity, expected v, b, l, f, s, c, p or pp"),
    ("b 0 0 0\nfrom 1 2 3", "3: from: unknown entity, expected v, b, l, f, s, c, p or pp"),
    ("s 0 0 0 1\ns 0 0 0 1 2\n", "3: 2: unknown entity, expected v, b, l, f, s, c, p or pp"),
    ("S 0 0 0 1", "2: S: unknown entity, expected v, b, l, f, s, c, p or pp"),
    ("s 0 0 0", "2: s: expected 1 number, got 0"),
    ("s 0\n0\n\n", "3: s: expected 3 numbers, got 2"),
    ("s 0 0\ns 0 0 0 1", "2: s: expected 3 numbers, got 2"),
    ("s", "2: s: expected 3 numbers, got 0"),
    ("s 0\n# 1\n0 x 1", "4: s: not a number: x"),
    ("s 0 0 0 0", "2: s: the radius must be above 0, got 0"),
    ("s 0 0 0 -0", "2: s: the radius must be above 0, got 0"),
    ("s 0 0 0\nnan", "3: s: the radius must be above 0, got NaN"),
    ("s 0 0 0 1e-20", "2: s: the radius must be 1e-12 to 1e18, got 1e-20"),
    ("s 0 0 0 -inf", "2: s: the radius must be finite, got inf"),
    ("s 0 0 1e60 1", "2: s: must be finite and within ±1e18, got [0, 0, inf]"),
    ("c 1 2 3 1\n1 2 3 1", "3: c: the apex must be at least 1e-12 away from base, is 0e0"),
    ("c 0 0 0 0 0 0 1 0", "2: c: the radii must not both be 0"),
    ("c 0 0 0 1 0 0 1 -1", "2: c: the radii must have the same sign, got 1 and -1"),
    ("c 0 0 0 nan 0 0 1 1", "2: c: a radius must be 0, or 1e-12 to 1e12, got NaN"),
    ("c 0 0 0 1 0 0 1 1e30", "2: c: a radius must be 0, or 1e-12 to 1e12, got 1000000000000000000000000000000"),
    ("c 0 0 1e13 1 0 0 1 1", "2: c: must be finite and within ±1e12, got [0, 0, 10000000000000]"),
    ("c 0 0 0 1 0 nan 1 1", "2: c: must be finite and within ±1e12, got [0, NaN, 1]"),
    ("c 0 0 0 1 0 0 1", "2: c: expected 1 number, got 0"),
    ("b 0 -1 0", "2: b: must be finite and 0 or more, got [0, -1, 0]"),
    ("b 0 0 0\nb\n0 0 0", "3: b: there is a background already"),
    ("l 1 2", "2: l: expected 3 numbers, got 2"),
    ("l 1 2 3 1", "2: l: expected 3 numbers, got 1"),
    ("l 1 2 3 1 -1 1", "2: l: must be finite and 0 or more, got [1, -1, 1]"),
    ("b 0 2e9 0", "2: b: must be at most 1e9, got [0, 2000000000, 0]"),
    ("f 2e5 1 1 2e5 0 1 0 0", "2: f: r g b times Kd must be at most 1e9, got [40000000000, 200000, 200000]"),
    ("l inf 2 3", "2: l: must be finite and within ±1e18, got [inf, 2, 3]"),
    ("f 1 1 1 1 1 1 1", "2: f: expected 8 numbers, got 7"),
    ("f 1 -1 1 -1 0 1 0 0", "2: f: r g b must be finite and 0 or more, got [1, -1, 1]"),
    ("f 1 1 1 -1 0 1 0 0", "2: f: r g b times Kd must be finite and 0 or more, got [-1, -1, -1]"),
    ("f 1 1 1 1 1.5 1 0 0", "2: f: Ks must be 0 to 1, got 1.5"),
    ("f 1 1 1 1 0 -1 0 0", "2: f: Shine must be finite and 0 or more, got -1"),
    ("f 1 1 1 1 0 1 nan 0", "2: f: T must be 0 to 1, got NaN"),
    ("f 1 1 1 1 0 1 1 0", "2: f: ior must be 0.1 to 10, got 0"),
    ("p", "2: p: expected a number of corners"),
    ("p 2 0 0 0 1 1 1", "2: p: must have 3 to 65536 corners, got 2"),
    ("p 4000000000 0 0 0", "2: p: must have 3 to 65536 corners, got 4000000000"),
    ("p -3", "2: p: not a number of corners: -3"),
    ("p 3.5", "2: p: not a number of corners: 3.5"),
    ("p 3\n0 0 0\n1 0 0\n0 1\ns 0 0 0 1", "5: p: expected 3 corners of 3 numbers, got 2"),
    ("p 3\n0 0 0\n1 0 0\n0 1e20 0", "5: p: must be finite and within ±1e12, got [0, 100000000000000000000, 0]"),
    ("s 0 0 0 1\np 3\n0 0 0\n1 1 1\n2 2 2\n", "3: p: the corners span no area"),
    ("pp 3 0 0 0 0 0 1 0 0 0 0 0 1 0 0 0 0 0 1", "2: pp: the corners span no area"),
    ("pp 3\n0 0 0 0 0 1\n1 0 0 0 0 0\n0 1 0 0 0 1", "4: pp: a normal must not be zero"),
    ("pp 3\n0 0 0 0 0 1\n1 0 0 0 nan 0\n0 1 0 0 0 1", "4: pp: a normal must be finite, got [0, NaN, 0]"),
    ("pp 3\n0 0 0 0 0 1\n1 0 0", "4: pp: expected 3 corners of 6 numbers, got 1"),
    ("v from 0 0 5 at 0 0 0 up 0 1 0 angle 45", "2: v: there is a view already"),
];

#[test]
fn every_fault_names_its_line() {
    for (text, message) in FAULTS {
        assert_eq!(nff(text).unwrap_err(), format!("m.nff:{message}"), "{text:?}");
    }
    for (text, message) in [
        ("", " no view (v)"),
        ("# v\ns 0 0 0 1", " no view (v)"),
        ("v", "1: v: from is missing"),
        ("\nv from 0 0 0\nup 0 0 1 angle 20", "2: v: at is missing"),
        ("v from 0 0 0 at 1 1 1 angle 20 s 0 0 0 1", "1: v: up is missing"),
        ("v from 0 0 0 at 1 1 1 up 0 1 0", "1: v: angle is missing"),
        ("v from 1 1 1\nat 1 1 1 up 0 1 0 angle 20", "1: v: at must differ from from"),
        ("v\nfrom 0 0", "2: from: expected 3 numbers, got 2"),
        ("v from 0 0 0\nup 0 0 0", "2: up: must not be zero"),
        ("v angle\n180", "2: angle: must be at least 0.01 and below 180, got 180"),
        ("v hither x", "1: hither: not a number: x"),
        ("v resolution 512 at", "1: resolution: expected 2 numbers, got 1"),
    ] {
        assert_eq!(raw(text).unwrap_err(), format!("m.nff:{message}"), "{text:?}");
    }
}

#[test]
fn what_is_no_text_or_endless_is_a_fault_too() {
    assert_eq!(raw(b"\n\xff\x1b[31m 2").unwrap_err(), {
        "m.nff:2: \u{fffd}\\u{1b}[31m: unknown entity, expected v, b, l, f, s, c, p or pp"
    });
    assert_eq!(nff(&format!("s 0 0 0 {:0>256}", 1)).unwrap().spheres[0].radius, 1.0);
    let long = "1".repeat(257);
    assert_eq!(nff(&format!("s 0 0 0\n{long}")).unwrap_err(), format!("m.nff:3: {long}: longer than 256 bytes"));
    let mut endless = BufReader::new(std::io::repeat(b' '));
    let error = parse(&mut endless, Path::new("m.nff"), 1000, &mut |_| ()).unwrap_err();
    assert_eq!(error.to_string(), "m.nff: longer than 1000 bytes");
}

#[test]
fn progress_runs_from_nothing_to_the_whole_file() {
    let text = format!("{VIEW}{}", "s 0 0 0 1\n".repeat(250_000));
    let mut told = Vec::new();
    parse(text.as_bytes(), Path::new("m.nff"), MAX_NFF_BYTES, &mut |bytes| told.push(bytes)).unwrap();
    assert_eq!((told.first(), told.last()), (Some(&0), Some(&(text.len() as u64))));
    assert!(told.is_sorted() && told.len() == 4, "{told:?}");
}

#[test]
fn folders_and_what_is_not_there_are_faults() {
    assert_eq!(read(Path::new("src"), &mut |_, _| ()).unwrap_err().to_string(), "src: not a regular file");
    assert_eq!(
        read(Path::new("no.nff"), &mut |_, _| ()).unwrap_err().to_string(),
        "no.nff: No such file or directory (os error 2)"
    );
}

#[test]
fn no_mutation_of_a_file_panics_or_takes_long() {
    let start = Instant::now();
    let file = format!("{VIEW}{ALL}").into_bytes();
    let mut state = 0x9e37_79b9_7f4a_7c15_u64;
    let mut random = |below: usize| {
        // Marsaglia's xorshift.
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        (state >> 16) as usize % below
    };
    let pieces: [&[u8]; 16] = [
        b" ", b"\n", b"#", b"-", b"e", b"9", b".", b"nan", b"inf", b"1e30", b" v ", b" p ", b" pp ", b" s ", b"\xff",
        b"\0",
    ];
    let mut outcomes = [0; 2];
    for _ in 0..20_000 {
        let mut file = file.clone();
        for _ in 0..=random(2) {
            let at = random(file.len());
            let to = (at + random(12)).min(file.len());
            match random(4) {
                0 => file.truncate(at.max(1)),
                1 => drop(file.drain(at..to)),
                2 => drop(file.splice(at..to, pieces[random(pieces.len())].iter().copied())),
                _ => file[at] = random(256) as u8,
            }
            if file.is_empty() {
                break;
            }
        }
        let read = raw(&file);
        outcomes[usize::from(read.is_ok())] += 1;
        let message = read.err().unwrap_or_default();
        assert!(!message.contains('\n'), "{message}");
    }
    assert!(outcomes.iter().all(|n| *n > 1000), "{outcomes:?}");
    assert!(start.elapsed() < Duration::from_secs(60), "{:?}", start.elapsed());
}
