//! Makes `scenes/flake.toml`; shared by the example that prints it and the test that compares it.
//!
//! The sphereflake is Eric Haines' (A Proposal for Standard Graphics Environments, 1987): each sphere carries nine of a
//! third of its radius, six around its equator and three above. The arithmetic is only + − × ÷ √, and digits are
//! few, so that every machine prints the same text.

use std::fmt::Write;

type Vector = [f64; 3];

const LEVELS: usize = 5;
const RADIUS: f64 = 0.5;

/// A right-handed frame; spheres grow along its third axis.
type Frame = [Vector; 3];

fn combine(weights: Vector, frame: &Frame) -> Vector {
    std::array::from_fn(|i| weights[0] * frame[0][i] + weights[1] * frame[1][i] + weights[2] * frame[2][i])
}

fn normalize(v: Vector) -> Vector {
    let length = (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]).sqrt();
    v.map(|x| x / length)
}

fn cross(a: Vector, b: Vector) -> Vector {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// The nine directions in which children sit.
fn directions() -> [Vector; 9] {
    let (half, s) = (0.5, 0.75_f64.sqrt());
    // The upper three stand at cos θ = √(2/3), which is as far from each other as from the six.
    let (sin, cos) = ((1.0_f64 / 3.0).sqrt(), (2.0_f64 / 3.0).sqrt());
    [
        [1.0, 0.0, 0.0],
        [half, s, 0.0],
        [-half, s, 0.0],
        [-1.0, 0.0, 0.0],
        [-half, -s, 0.0],
        [half, -s, 0.0],
        [sin * s, sin * half, cos],
        [-sin * s, sin * half, cos],
        [0.0, -sin, cos],
    ]
}

fn grow(center: Vector, radius: f64, frame: &Frame, level: usize, out: &mut String) {
    // Adding 0 makes a rounded −0 a plain 0.
    let round = |x: f64| (x * 1e5).round() / 1e5 + 0.0;
    let [x, y, z] = center.map(round);
    let _ = writeln!(out, "  {{ center = [{x}, {y}, {z}], radius = {}, material = \"l{level}\" }},", round(radius));
    if level + 1 == LEVELS {
        return;
    }
    for d in directions() {
        let axis = combine(d, frame);
        // The new frame: the old axis as far as it is perpendicular to the new one.
        let up = frame[2];
        let along = up[0] * axis[0] + up[1] * axis[1] + up[2] * axis[2];
        let u = normalize(std::array::from_fn(|i| up[i] - along * axis[i]));
        let reach = radius * 4.0 / 3.0;
        let child = std::array::from_fn(|i| center[i] + reach * axis[i]);
        grow(child, radius / 3.0, &[u, cross(axis, u), axis], level + 1, out);
    }
}

/// The whole file.
pub fn toml() -> String {
    let mut out = String::from(HEAD);
    out.push_str("sphere = [\n");
    let upright = [[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]];
    grow([0.0, RADIUS, 0.0], RADIUS, &upright, 0, &mut out);
    out.push_str("]\n");
    out
}

const HEAD: &str = r#"# flake: Eric Haines' sphereflake, 7,381 spheres on a floor.
# Made by `cargo run --example sphereflake`; edit a copy, not this file.

# Tables are written as dotted keys here, so that the long list of spheres can come last.
camera.eye = [1.2, 1.4, 2.9]
camera.look_at = [0.0, 0.6, 0.0]
camera.fov = 40
settings.max_depth = 6
settings.ambient = [0.03, 0.035, 0.05]
sky.color = [0.14, 0.2, 0.34]

light = [
  { position = [4, 6, 3], power = [620, 560, 470] },     # key, warm
  { position = [-5, 3.5, 2.5], power = [150, 185, 250] },  # fill, cool
  { position = [-2, 4, -4], power = [120, 105, 130] },     # from behind
]

materials.floor = { checker = { colors = [[0.5, 0.46, 0.4], [0.3, 0.27, 0.25]], size = 0.5 }, reflectance = 0.1 }

# One material a level, from the large sphere to the small ones.
materials.l0 = { color = [1.0, 0.86, 0.6], reflectance = 0.5, specular = 0.5, shininess = 120 }
materials.l1 = { color = [0.95, 0.6, 0.3], reflectance = 0.4, specular = 0.5, shininess = 100 }
materials.l2 = { color = [0.85, 0.35, 0.3], reflectance = 0.3, specular = 0.4, shininess = 80 }
materials.l3 = { color = [0.5, 0.45, 0.8], reflectance = 0.25, specular = 0.4, shininess = 60 }
materials.l4 = { color = [0.45, 0.75, 0.9], reflectance = 0.2, specular = 0.3, shininess = 40 }

plane = [{ normal = [0, 1, 0], distance = 0, material = "floor" }]

"#;
