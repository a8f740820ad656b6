//! What makes a description sound: every rule, once, whoever wrote the description.

use glam::Vec3;

use super::{Description, Invalid, Material, Mesh, Pigment};

/// The largest coordinate, radius or distance: its square, and a sum of a few of them, still fits an `f32`.
pub const MAX_LENGTH: f32 = 1e18;

/// The largest coordinate of a mesh: the product of two edges and the distance of an eye as far still fits an `f32`.
pub const MAX_MESH_LENGTH: f32 = 1e12;

/// The smallest radius: its square is a normal `f32` with room to spare.
pub const MIN_RADIUS: f32 = 1e-12;

/// The smallest field of view, in degrees: narrower, neighbouring pixels have the same direction.
const MIN_FOV: f32 = 0.01;

/// The largest Phong exponent: a highlight a thousandth of a radian across.
const MAX_SHININESS: f32 = 1e6;

/// Primitive ids are `u32`, and the last value is kept for "nothing".
const MAX_PRIMITIVES: usize = (u32::MAX - 1) as usize;

/// Says what is wrong with a description, if anything is.
///
/// # Errors
/// The first fault, by its key as the TOML file spells it.
pub fn check(description: &Description) -> Result<(), Invalid> {
    camera(description)?;
    settings(description)?;
    for (i, light) in description.lights.iter().enumerate() {
        rule(point(light.position), || format!("light[{i}].position"))?;
        rule(color(light.power), || format!("light[{i}].power"))?;
    }
    for material in &description.materials {
        surface(material)?;
    }
    primitives(description)
}

/// Puts the key to a rule's verdict; the key is only spelled out when it is needed.
fn rule(verdict: Result<(), String>, key: impl FnOnce() -> String) -> Result<(), Invalid> {
    verdict.map_err(|problem| Invalid { key: key(), problem })
}

fn require(holds: bool, problem: impl FnOnce() -> String) -> Result<(), String> {
    if holds { Ok(()) } else { Err(problem()) }
}

fn camera(description: &Description) -> Result<(), Invalid> {
    let camera = &description.camera;
    rule(point(camera.eye), || "camera.eye".into())?;
    rule(point(camera.look_at), || "camera.look_at".into())?;
    rule(require(camera.look_at != camera.eye, || "must differ from camera.eye".into()), || "camera.look_at".into())?;
    rule(direction(camera.up), || "camera.up".into())?;
    let fov = camera.fov;
    rule(
        require((MIN_FOV..180.0).contains(&fov), || format!("must be at least {MIN_FOV} and below 180, got {fov}")),
        || "camera.fov".into(),
    )
}

fn settings(description: &Description) -> Result<(), Invalid> {
    let depth = description.settings.max_depth;
    rule(require((1..=64).contains(&depth), || format!("must be 1 to 64, got {depth}")), || {
        "settings.max_depth".into()
    })?;
    rule(color(description.settings.ambient), || "settings.ambient".into())?;
    rule(color(description.sky.color), || "sky.color".into())
}

fn surface(material: &Material) -> Result<(), Invalid> {
    let key = |field: &str| format!("materials.{}.{field}", key_part(&material.name));
    match &material.pigment {
        Pigment::Color(c) => rule(color(*c), || key("color"))?,
        Pigment::Checker { colors, size } => {
            for (i, c) in colors.iter().enumerate() {
                rule(color(*c), || key(&format!("checker.colors[{i}]")))?;
            }
            rule(positive(*size), || key("checker.size"))?;
        }
    }
    let Material { reflectance, specular, shininess, .. } = *material;
    rule(require((0.0..=1.0).contains(&reflectance), || format!("must be 0 to 1, got {reflectance}")), || {
        key("reflectance")
    })?;
    rule(
        require(specular >= 0.0 && specular.is_finite(), || format!("must be finite and 0 or more, got {specular}")),
        || key("specular"),
    )?;
    rule(
        require(shininess > 0.0 && shininess <= MAX_SHININESS, || {
            format!("must be above 0 and at most {MAX_SHININESS:e}, got {shininess}")
        }),
        || key("shininess"),
    )
}

fn primitives(description: &Description) -> Result<(), Invalid> {
    let known = description.materials.len();
    for (i, plane) in description.planes.iter().enumerate() {
        rule(direction(plane.normal), || format!("plane[{i}].normal"))?;
        rule(offset(plane.normal, plane.distance), || format!("plane[{i}].distance"))?;
        rule(material(plane.material, known), || format!("plane[{i}].material"))?;
    }
    for (i, sphere) in description.spheres.iter().enumerate() {
        rule(point(sphere.center), || format!("sphere[{i}].center"))?;
        rule(length(sphere.radius), || format!("sphere[{i}].radius"))?;
        rule(material(sphere.material, known), || format!("sphere[{i}].material"))?;
    }
    for (i, mesh) in description.meshes.iter().enumerate() {
        triangles(i, mesh)?;
        rule(material(mesh.material, known), || format!("mesh[{i}].material"))?;
    }
    rule(count(description.primitives()), || "primitives".into())
}

fn triangles(index: usize, mesh: &Mesh) -> Result<(), Invalid> {
    for (i, p) in mesh.positions.iter().enumerate() {
        rule(vertex(*p), || format!("mesh[{index}].positions[{i}]"))?;
    }
    let known = mesh.positions.len();
    for (i, corners) in mesh.triangles.iter().enumerate() {
        for &corner in corners {
            rule(require((corner as usize) < known, || format!("vertex {corner} of {known} does not exist")), || {
                format!("mesh[{index}].triangles[{i}]")
            })?;
        }
    }
    Ok(())
}

/// A place in the world.
fn point(p: Vec3) -> Result<(), String> {
    within(p, MAX_LENGTH)
}

/// A vertex of a mesh.
pub(super) fn vertex(p: Vec3) -> Result<(), String> {
    within(p, MAX_MESH_LENGTH)
}

fn within(p: Vec3, most: f32) -> Result<(), String> {
    require(p.abs().max_element() <= most && p.is_finite(), || {
        format!("must be finite and within ±{most:e}, got {}", triple(p))
    })
}

fn direction(v: Vec3) -> Result<(), String> {
    require(v.is_finite(), || format!("must be finite, got {}", triple(v)))?;
    require(v != Vec3::ZERO, || "must not be zero".into())
}

/// A plane's offset counts in lengths of its normal.
fn offset(normal: Vec3, distance: f32) -> Result<(), String> {
    let world = f64::from(distance) / normal.as_dvec3().length();
    require(world.abs() <= f64::from(MAX_LENGTH), || {
        format!("must be finite and within ±{MAX_LENGTH:e} normal lengths, got {distance}")
    })
}

fn color(c: Vec3) -> Result<(), String> {
    require(c.is_finite() && c.min_element() >= 0.0, || format!("must be finite and 0 or more, got {}", triple(c)))
}

fn positive(x: f32) -> Result<(), String> {
    require(x > 0.0, || format!("must be above 0, got {x}"))?;
    require(x.is_finite(), || format!("must be finite, got {x}"))
}

fn length(x: f32) -> Result<(), String> {
    positive(x)?;
    require((MIN_RADIUS..=MAX_LENGTH).contains(&x), || format!("must be {MIN_RADIUS:e} to {MAX_LENGTH:e}, got {x:e}"))
}

fn material(index: usize, known: usize) -> Result<(), String> {
    require(index < known, || format!("material {index} of {known} does not exist"))
}

fn count(primitives: usize) -> Result<(), String> {
    require(primitives <= MAX_PRIMITIVES, || format!("at most {MAX_PRIMITIVES} fit, got {primitives}"))
}

fn triple(v: Vec3) -> String {
    format!("[{}, {}, {}]", v.x, v.y, v.z)
}

/// A name as a part of a dotted key: bare when TOML lets it, quoted otherwise.
pub(super) fn key_part(name: &str) -> String {
    let bare = !name.is_empty() && name.bytes().all(|b| b.is_ascii_alphanumeric() || b == b'_' || b == b'-');
    if bare { name.into() } else { format!("{name:?}") }
}

#[cfg(test)]
#[path = "check_tests.rs"]
mod tests;
