//! The rules of a sound description: each once, whoever wrote the description.

use super::kinds::{Kind, each_kind};
use super::rules::{
    At, MAX_COLOR, color, direction, finite, fov, key_part, parts, point, positive, power, require, rule,
};
use super::{Description, Dome, Invalid, Material, Pigment, Sky};

/// Indices of refraction: from well below that of anything but vacuum in glass, to well above diamond's.
const IOR: std::ops::RangeInclusive<f32> = 0.1..=10.0;

/// The greatest absorption a world unit.
const MAX_ABSORPTION: f32 = 1e18;

/// The most materials that transmit, as a ray keeps the bodies it is in by numbers of 16 bits, of which one has another use.
pub const MAX_BODIES: usize = u16::MAX as usize - 1;

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
        rule(power(light.power), || format!("light[{i}].power"))?;
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
    let materials = description.materials.len();
    each_kind!(description, |all| elements(all, materials)).into_iter().collect::<Result<(), _>>()?;
    rule(count(description.primitives()), || "primitives".into())
}

/// The elements of one kind.
fn elements<K: Kind>(all: &[K], materials: usize) -> Result<(), Invalid> {
    all.iter().enumerate().try_for_each(|(i, element)| element.check(&At::new(K::KEY, i, materials)))
}

fn camera(description: &Description) -> Result<(), Invalid> {
    let camera = &description.camera;
    rule(point(camera.eye), || "camera.eye".into())?;
    rule(point(camera.look_at), || "camera.look_at".into())?;
    rule(require(camera.look_at != camera.eye, || "must differ from camera.eye".into()), || "camera.look_at".into())?;
    rule(direction(camera.up), || "camera.up".into())?;
    rule(fov(camera.fov), || "camera.fov".into())
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
    let sound = |t: &[f32; 3]| t.iter().all(|c| (0.0..=MAX_COLOR).contains(c));
    require(texels.iter().all(sound), || format!("a texel is below 0, above {MAX_COLOR:e} or not a number"))
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
        Pigment::Texture { texture, size, .. } => {
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
    rule(parts(absorption, MAX_ABSORPTION), || key("absorption"))?;
    rule(
        require(specular >= 0.0 && specular.is_finite(), || format!("must be finite and 0 or more, got {specular}")),
        || key("specular"),
    )?;
    rule(require(specular <= MAX_COLOR, || format!("must be at most {MAX_COLOR:e}, got {specular}")), || {
        key("specular")
    })?;
    rule(
        require(shininess > 0.0 && shininess <= MAX_SHININESS, || {
            format!("must be above 0 and at most {MAX_SHININESS:e}, got {shininess}")
        }),
        || key("shininess"),
    )
}

fn count(primitives: usize) -> Result<(), String> {
    require(primitives <= MAX_PRIMITIVES, || format!("at most {MAX_PRIMITIVES} fit, got {primitives}"))
}

#[cfg(test)]
#[path = "check_tests.rs"]
mod tests;
