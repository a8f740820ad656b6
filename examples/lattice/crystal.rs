//! Makes `scenes/lattice.toml`; shared by the example that prints it and the test that compares it.
//!
//! The crystal is diamond's: two face-centred cubic lattices, one moved by a quarter of the cell's diagonal, so that
//! every atom has four neighbours of the other kind. Places are whole numbers of quarter cells: the first kind has
//! three even ones whose sum is 0 modulo 4, the second three odd ones whose sum is 3. Cut along the planes of an
//! octahedron, as real diamonds grow. Only + − × ÷ is computed, and digits are few, so that every machine prints the
//! same text.

use std::{collections::BTreeSet, fmt::Write};

type Place = [i32; 3];

/// The octahedron: the greatest |x| + |y| + |z|, in quarter cells.
const EXTENT: i32 = 12;

/// A quarter cell in world units.
const QUARTER: f64 = 0.22;

/// The radius of an atom, world units.
const ATOM: f64 = 0.13;

/// The radius of a bond, world units.
const BOND: f64 = 0.045;

/// From an atom of the first kind to its neighbours; those of the second kind are opposite.
const NEIGHBOURS: [Place; 4] = [[1, 1, 1], [1, -1, -1], [-1, 1, -1], [-1, -1, 1]];

fn first_kind(place: Place) -> bool {
    place[0] % 2 == 0
}

fn is_atom([x, y, z]: Place) -> bool {
    let remainders = [x, y, z].map(|n| n.rem_euclid(2));
    let sum = (x + y + z).rem_euclid(4);
    x.abs() + y.abs() + z.abs() <= EXTENT && ((remainders == [0; 3] && sum == 0) || (remainders == [1; 3] && sum == 3))
}

fn neighbours(place: Place, atoms: &BTreeSet<Place>) -> Vec<Place> {
    let sign = if first_kind(place) { 1 } else { -1 };
    let all = NEIGHBOURS.map(|n| std::array::from_fn(|i| place[i] + sign * n[i]));
    all.into_iter().filter(|n| atoms.contains(n)).collect()
}

/// The atoms of the octahedron, without those that would hang on less than two bonds.
fn atoms() -> BTreeSet<Place> {
    let range = || -EXTENT..=EXTENT;
    let all = range().flat_map(|x| range().flat_map(move |y| range().map(move |z| [x, y, z])));
    let mut atoms: BTreeSet<Place> = all.filter(|place| is_atom(*place)).collect();
    loop {
        let held: BTreeSet<Place> = atoms.iter().copied().filter(|p| neighbours(*p, &atoms).len() >= 2).collect();
        if held.len() == atoms.len() {
            return atoms;
        }
        atoms = held;
    }
}

/// The material of an atom: the second kind by its octahedral shell, from the core outward.
fn material(place: Place) -> &'static str {
    if first_kind(place) {
        return "pale";
    }
    match place.iter().map(|n| n.abs()).sum() {
        ..=5 => "core",
        6..=8 => "middle",
        _ => "rim",
    }
}

/// The whole file.
pub fn toml() -> String {
    let atoms = atoms();
    let lowest = atoms.iter().map(|place| place[1]).min().unwrap_or_default();
    // The lowest atoms stand on the floor. Adding 0 makes a rounded −0 a plain 0.
    let round = |x: f64| (x * 1e5).round() / 1e5 + 0.0;
    let world = |[x, y, z]: Place| {
        let [x, y, z] = [x, y - lowest, z].map(|n| f64::from(n) * QUARTER);
        let [x, y, z] = [x, y + ATOM, z].map(round);
        format!("[{x}, {y}, {z}]")
    };
    let mut out = String::from(HEAD);
    out.push_str("sphere = [\n");
    for &atom in &atoms {
        let _ = writeln!(out, "  {{ center = {}, radius = {ATOM}, material = \"{}\" }},", world(atom), material(atom));
    }
    out.push_str("]\n\ncylinder = [\n");
    for &atom in atoms.iter().filter(|atom| first_kind(**atom)) {
        for other in neighbours(atom, &atoms) {
            let (base, apex) = (world(atom), world(other));
            let _ = writeln!(out, "  {{ base = {base}, apex = {apex}, radius = {BOND}, material = \"bond\" }},");
        }
    }
    out.push_str("]\n");
    out
}

const HEAD: &str = r#"# lattice: a diamond crystal, 265 atoms and 460 bonds, over a mirror.
# Made by `cargo run --example lattice`; edit a copy, not this file.

# Tables are written as dotted keys here, so that the long lists can come last.
camera.eye = [2.8, 2.9, 9.2]
camera.look_at = [0.0, 1.75, 0.0]
camera.fov = 35
settings.max_depth = 6
settings.ambient = [0.09, 0.1, 0.12]
sky.gradient = [[0.3, 0.24, 0.2], [0.06, 0.16, 0.4]]

light = [
  { position = [5, 9, 6], power = [1250, 1150, 1000] },  # key, warm
  { position = [-7, 5, 4], power = [210, 260, 340] },    # fill, cool
  { position = [-2, 7, -7], power = [330, 280, 260] },   # from behind
]

materials.floor = { color = [0.05, 0.06, 0.08], reflectance = 0.45 }
materials.pale = { color = [0.92, 0.88, 0.8], reflectance = 0.15, specular = 0.5, shininess = 90 }
materials.core = { color = [0.95, 0.25, 0.12], reflectance = 0.2, specular = 0.6, shininess = 90 }
materials.middle = { color = [0.98, 0.55, 0.12], reflectance = 0.2, specular = 0.6, shininess = 90 }
materials.rim = { color = [0.12, 0.5, 0.75], reflectance = 0.25, specular = 0.6, shininess = 90 }
materials.bond = { color = [0.42, 0.45, 0.5], reflectance = 0.35, specular = 0.5, shininess = 60 }

plane = [{ normal = [0, 1, 0], distance = 0, material = "floor" }]

"#;
