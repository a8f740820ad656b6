//! What makes a description sound: every rule, once, whoever wrote the description.

use glam::Vec3;

use super::{Description, Dome, Invalid, Material, Mesh, Pigment, Sky};

/// The largest coordinate, radius or distance: its square, and a sum of a few of them, still fits an `f32`.
pub const MAX_LENGTH: f32 = 1e18;

/// The largest coordinate of a mesh: the product of two edges and the distance of an eye as far still fits an `f32`.
pub const MAX_MESH_LENGTH: f32 = 1e12;

/// The smallest radius: its square is a normal `f32` with room to spare.
pub const MIN_RADIUS: f32 = 1e-12;

/// The greatest distance of a quad's or other body's ends from the world's origin, and its greatest size.
const MAX_BODY_LENGTH: f32 = MAX_MESH_LENGTH;

/// The most iterations of a fractal: its smallest cubes are 3⁻⁸ of the whole, some thousand ε.
const MAX_ITERATIONS: u32 = 8;

/// Indices of refraction: from well below that of anything but vacuum in glass, to well above diamond's.
const IOR: std::ops::RangeInclusive<f32> = 0.1..=10.0;

/// The greatest absorption a world unit.
const MAX_ABSORPTION: f32 = 1e18;

/// The most materials that transmit, as a ray keeps the bodies it is in by numbers of 16 bits.
pub const MAX_BODIES: usize = (1 << 16) - 1;

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
    for (i, texture) in description.textures.iter().enumerate() {
        rule(image(texture.width, texture.height, texture.texels.len()), || format!("textures[{i}]"))?;
    }
    for material in &description.materials {
        surface(material, description.textures.len())?;
    }
    let bodies = description.materials.iter().filter(|m| m.transmission > 0.0).count();
    rule(require(bodies <= MAX_BODIES, || format!("at most {MAX_BODIES} may transmit, got {bodies}")), || {
        "materials".into()
    })?;
    primitives(description)?;
    bodies_of(description)?;
    rule(count(description.primitives()), || "primitives".into())
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
    rule(fov(camera.fov), || "camera.fov".into())
}

/// A field of view in degrees.
pub(super) fn fov(fov: f32) -> Result<(), String> {
    require((MIN_FOV..180.0).contains(&fov), || format!("must be at least {MIN_FOV} and below 180, got {fov}"))
}

fn settings(description: &Description) -> Result<(), Invalid> {
    let depth = description.settings.max_depth;
    rule(require((1..=64).contains(&depth), || format!("must be 1 to 64, got {depth}")), || {
        "settings.max_depth".into()
    })?;
    rule(color(description.settings.ambient), || "settings.ambient".into())?;
    let tolerance = description.settings.tolerance;
    rule(
        require(tolerance >= 0.0 && tolerance.is_finite(), || format!("must be a number from 0 on, got {tolerance}")),
        || "settings.tolerance".into(),
    )?;
    match &description.sky {
        Sky::Color(c) => rule(color(*c), || "sky.color".into()),
        Sky::Gradient { below, above } => {
            rule(color(*below), || "sky.gradient[0]".into())?;
            rule(color(*above), || "sky.gradient[1]".into())
        }
        Sky::Dome(dome) => {
            rule(finite(dome.rotation), || "sky.rotation".into())?;
            rule(panorama(dome), || "sky.image".into())
        }
    }
}

fn panorama(dome: &Dome) -> Result<(), String> {
    let Dome { width, height, ref texels, .. } = *dome;
    image(width, height, texels.len())?;
    let sound = |t: &[f32; 3]| t.iter().all(|c| c.is_finite() && *c >= 0.0);
    require(texels.iter().all(sound), || "a texel is not finite, or below 0".into())
}

/// A number of pixels that makes a rectangle.
fn image(width: usize, height: usize, texels: usize) -> Result<(), String> {
    let all = texels > 0 && width.checked_mul(height) == Some(texels);
    require(all, || format!("no image of {width} × {height}"))
}

pub(super) fn surface(material: &Material, textures: usize) -> Result<(), Invalid> {
    let key = |field: &str| format!("materials.{}.{field}", key_part(&material.name));
    match &material.pigment {
        Pigment::Color(c) => rule(color(*c), || key("color"))?,
        Pigment::Checker { colors, size } => {
            for (i, c) in colors.iter().enumerate() {
                rule(color(*c), || key(&format!("checker.colors[{i}]")))?;
            }
            rule(positive(*size), || key("checker.size"))?;
        }
        Pigment::Texture { texture, size } => {
            let exists = *texture < textures;
            rule(require(exists, || format!("texture {texture} of {textures} does not exist")), || key("texture"))?;
            rule(positive(*size), || key("texture_size"))?;
        }
    }
    let Material { reflectance, transmission, ior, absorption, additive, specular, shininess, .. } = *material;
    let share = |x: f32| require((0.0..=1.0).contains(&x), || format!("must be 0 to 1, got {x}"));
    rule(share(reflectance), || key("reflectance"))?;
    rule(share(transmission), || key("transmission"))?;
    // Numbers like 0.3 and 0.7 may sum to a little more.
    let sum = reflectance + transmission;
    rule(require(additive || sum <= 1.0 + f32::EPSILON, || format!("with reflectance at most 1, got {sum}")), || {
        key("transmission")
    })?;
    let [least, most] = [IOR.start(), IOR.end()];
    rule(require(IOR.contains(&ior), || format!("must be {least} to {most}, got {ior}")), || key("ior"))?;
    rule(color(absorption), || key("absorption"))?;
    rule(
        require(absorption.max_element() <= MAX_ABSORPTION, || {
            format!("must be at most {MAX_ABSORPTION:e}, got {}", triple(absorption))
        }),
        || key("absorption"),
    )?;
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
        for (k, &m) in mesh.materials.iter().enumerate() {
            rule(material(m as usize, known), || format!("mesh[{i}].materials[{k}]"))?;
        }
    }
    Ok(())
}

/// The other bounded primitives.
fn bodies_of(description: &Description) -> Result<(), Invalid> {
    let known = description.materials.len();
    for (i, quad) in description.quads.iter().enumerate() {
        for (v, name) in [(quad.corner, "corner"), (quad.u, "u"), (quad.v, "v")] {
            rule(place(v), || format!("quad[{i}].{name}"))?;
        }
        rule(area(quad.u, quad.v), || format!("quad[{i}].v"))?;
        rule(material(quad.material, known), || format!("quad[{i}].material"))?;
    }
    for (i, cuboid) in description.cuboids.iter().enumerate() {
        rule(place(cuboid.min), || format!("box[{i}].min"))?;
        rule(place(cuboid.max), || format!("box[{i}].max"))?;
        // Thinner than a few ε of its place it has no inside.
        let least = cuboid.min.abs().max(cuboid.max.abs()) * (8.0 * f32::EPSILON);
        let thick = (cuboid.max - cuboid.min).cmpgt(least.max(Vec3::splat(MIN_RADIUS))).all();
        rule(require(thick, || format!("must exceed box[{i}].min, got {}", triple(cuboid.max))), || {
            format!("box[{i}].max")
        })?;
        rule(angles(cuboid.rotation), || format!("box[{i}].rotation"))?;
        rule(material(cuboid.material, known), || format!("box[{i}].material"))?;
    }
    for (i, c) in description.cylinders.iter().enumerate() {
        rule(axis(c.base, c.apex), || format!("cylinder[{i}].apex"))?;
        rule(place(c.base), || format!("cylinder[{i}].base"))?;
        rule(size(c.radius), || format!("cylinder[{i}].radius"))?;
        rule(material(c.material, known), || format!("cylinder[{i}].material"))?;
    }
    for (i, c) in description.cones.iter().enumerate() {
        rule(axis(c.base, c.apex), || format!("cone[{i}].apex"))?;
        rule(place(c.base), || format!("cone[{i}].base"))?;
        for (radius, name) in [(c.base_radius, "base_radius"), (c.apex_radius, "apex_radius")] {
            rule(end_radius(radius), || format!("cone[{i}].{name}"))?;
        }
        rule(
            require(c.base_radius != c.apex_radius, || "must differ from base_radius; that is a cylinder".into()),
            || format!("cone[{i}].apex_radius"),
        )?;
        rule(material(c.material, known), || format!("cone[{i}].material"))?;
    }
    for (i, torus) in description.tori.iter().enumerate() {
        rule(place(torus.center), || format!("torus[{i}].center"))?;
        rule(direction(torus.axis), || format!("torus[{i}].axis"))?;
        rule(size(torus.major_radius), || format!("torus[{i}].major_radius"))?;
        rule(size(torus.minor_radius), || format!("torus[{i}].minor_radius"))?;
        let ring = torus.minor_radius <= torus.major_radius;
        rule(require(ring, || format!("must be at most major_radius, got {}", torus.minor_radius)), || {
            format!("torus[{i}].minor_radius")
        })?;
        rule(material(torus.material, known), || format!("torus[{i}].material"))?;
    }
    for (i, fractal) in description.fractals.iter().enumerate() {
        rule(place(fractal.center), || format!("fractal[{i}].center"))?;
        rule(size(fractal.radius), || format!("fractal[{i}].radius"))?;
        let iterations = fractal.iterations;
        rule(
            require(iterations <= MAX_ITERATIONS, || format!("must be 0 to {MAX_ITERATIONS}, got {iterations}")),
            || format!("fractal[{i}].iterations"),
        )?;
        rule(material(fractal.material, known), || format!("fractal[{i}].material"))?;
    }
    Ok(())
}

fn triangles(index: usize, mesh: &Mesh) -> Result<(), Invalid> {
    for (i, p) in mesh.positions.iter().enumerate() {
        rule(vertex(*p), || format!("mesh[{index}].positions[{i}]"))?;
    }
    let known = mesh.positions.len();
    for (columns, name) in [(mesh.normals.len(), "normals"), (mesh.uvs.len(), "uvs")] {
        rule(require([0, known].contains(&columns), || format!("{columns} for {known} vertices")), || {
            format!("mesh[{index}].{name}")
        })?;
    }
    for (i, n) in mesh.normals.iter().enumerate() {
        rule(direction(*n), || format!("mesh[{index}].normals[{i}]"))?;
    }
    for (i, uv) in mesh.uvs.iter().enumerate() {
        rule(require(uv.is_finite(), || format!("must be finite, got [{}, {}]", uv.x, uv.y)), || {
            format!("mesh[{index}].uvs[{i}]")
        })?;
    }
    let materials = [0, mesh.triangles.len()].contains(&mesh.materials.len());
    rule(require(materials, || format!("{} for {} triangles", mesh.materials.len(), mesh.triangles.len())), || {
        format!("mesh[{index}].materials")
    })?;
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
pub(super) fn point(p: Vec3) -> Result<(), String> {
    within(p, MAX_LENGTH)
}

/// A vertex of a mesh.
pub(super) fn vertex(p: Vec3) -> Result<(), String> {
    within(p, MAX_MESH_LENGTH)
}

/// The corners of a triangle that stands alone.
pub(super) fn triangle(corners: [Vec3; 3]) -> Result<(), String> {
    corners.into_iter().try_for_each(vertex)?;
    let [a, b, c] = corners;
    area(b - a, c - a)
}

/// Where a quad or body is.
pub(super) fn place(p: Vec3) -> Result<(), String> {
    within(p, MAX_BODY_LENGTH)
}

/// Two edges that span something.
fn area(u: Vec3, v: Vec3) -> Result<(), String> {
    let spanned = u.as_dvec3().cross(v.as_dvec3()).length();
    // Less is no more than the rounding of the corners.
    let least = f64::from(f32::EPSILON) * u.as_dvec3().length() * v.as_dvec3().length();
    require(spanned > least, || "must span an area".into())
}

/// The end of an axis that starts at `base`.
pub(super) fn axis(base: Vec3, apex: Vec3) -> Result<(), String> {
    place(apex)?;
    let length = (apex.as_dvec3() - base.as_dvec3()).length();
    require(length >= f64::from(MIN_RADIUS), || {
        format!("must be at least {MIN_RADIUS:e} away from base, is {length:e}")
    })
}

fn size(x: f32) -> Result<(), String> {
    positive(x)?;
    let fits = (MIN_RADIUS..=MAX_BODY_LENGTH).contains(&x);
    require(fits, || format!("must be {MIN_RADIUS:e} to {MAX_BODY_LENGTH:e}, got {x:e}"))
}

/// The radius at an end of a cone.
pub(super) fn end_radius(radius: f32) -> Result<(), String> {
    let ending = radius == 0.0 || size(radius).is_ok();
    require(ending, || format!("must be 0, or {MIN_RADIUS:e} to {MAX_BODY_LENGTH:e}, got {radius}"))
}

fn angles(v: Vec3) -> Result<(), String> {
    require(v.is_finite() && v.abs().max_element() <= 1e6, || {
        format!("must be finite and within ±1e6 degrees, got {}", triple(v))
    })
}

fn finite(x: f32) -> Result<(), String> {
    require(x.is_finite(), || format!("must be finite, got {x}"))
}

fn within(p: Vec3, most: f32) -> Result<(), String> {
    require(p.abs().max_element() <= most && p.is_finite(), || {
        format!("must be finite and within ±{most:e}, got {}", triple(p))
    })
}

pub(super) fn direction(v: Vec3) -> Result<(), String> {
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

pub(super) fn color(c: Vec3) -> Result<(), String> {
    require(c.is_finite() && c.min_element() >= 0.0, || format!("must be finite and 0 or more, got {}", triple(c)))
}

fn positive(x: f32) -> Result<(), String> {
    require(x > 0.0, || format!("must be above 0, got {x}"))?;
    require(x.is_finite(), || format!("must be finite, got {x}"))
}

pub(super) fn length(x: f32) -> Result<(), String> {
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
