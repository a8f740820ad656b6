//! The rules that several parts of a description share: a verdict is what is wrong with a value, if anything is.

use std::fmt;

use glam::Vec3;

use super::Invalid;

/// The largest coordinate, radius or distance: its square, and a sum of a few of them, still fits an `f32`.
const MAX_LENGTH: f32 = 1e18;

/// The largest coordinate of a mesh: the product of two edges and the distance of an eye as far still fits an `f32`.
const MAX_MESH_LENGTH: f32 = 1e12;

/// The smallest radius: its square is a normal `f32` with room to spare.
pub(super) const MIN_RADIUS: f32 = 1e-12;

/// The greatest distance of a quad's or other body's ends from the world's origin, and its greatest size.
const MAX_BODY_LENGTH: f32 = MAX_MESH_LENGTH;

/// The greatest part of a colour, and strength of a highlight: far more than the sun's in a panorama.
pub(super) const MAX_COLOR: f32 = 1e9;

/// The smallest field of view, in degrees: narrower, neighbouring pixels have the same direction.
const MIN_FOV: f32 = 0.01;

/// Which element of which array of the description is checked: `sphere[3]`.
pub(crate) struct At {
    key: &'static str,
    index: usize,
    materials: usize,
}

impl At {
    /// Element `index` of the array `key`, where there are so many materials.
    pub(super) fn new(key: &'static str, index: usize, materials: usize) -> Self {
        Self { key, index, materials }
    }

    /// Puts the key to a rule's verdict; the key is only spelled out when it is needed.
    pub(super) fn rule(&self, key: impl fmt::Display, verdict: Result<(), String>) -> Result<(), Invalid> {
        rule(verdict, || format!("{self}.{key}"))
    }

    /// The material that `key` names.
    pub(super) fn material_of(&self, key: impl fmt::Display, index: usize) -> Result<(), Invalid> {
        let known = self.materials;
        self.rule(key, require(index < known, || format!("material {index} of {known} does not exist")))
    }

    /// The element's only material.
    pub(super) fn material(&self, index: usize) -> Result<(), Invalid> {
        self.material_of("material", index)
    }
}

impl fmt::Display for At {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}[{}]", self.key, self.index)
    }
}

/// Puts the key to a rule's verdict; the key is only spelled out when it is needed.
pub(super) fn rule(verdict: Result<(), String>, key: impl FnOnce() -> String) -> Result<(), Invalid> {
    verdict.map_err(|problem| Invalid { key: key(), problem })
}

pub(super) fn require(holds: bool, problem: impl FnOnce() -> String) -> Result<(), String> {
    if holds { Ok(()) } else { Err(problem()) }
}

/// A place in the world.
pub(super) fn point(p: Vec3) -> Result<(), String> {
    within(p, MAX_LENGTH)
}

/// A vertex of a mesh.
pub(super) fn vertex(p: Vec3) -> Result<(), String> {
    within(p, MAX_MESH_LENGTH)
}

/// Where a quad or body is.
pub(super) fn place(p: Vec3) -> Result<(), String> {
    within(p, MAX_BODY_LENGTH)
}

/// Two edges that span something.
pub(super) fn area(u: Vec3, v: Vec3) -> Result<(), String> {
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

pub(super) fn size(x: f32) -> Result<(), String> {
    positive(x)?;
    let fits = (MIN_RADIUS..=MAX_BODY_LENGTH).contains(&x);
    require(fits, || format!("must be {MIN_RADIUS:e} to {MAX_BODY_LENGTH:e}, got {x:e}"))
}

pub(super) fn length(x: f32) -> Result<(), String> {
    positive(x)?;
    require((MIN_RADIUS..=MAX_LENGTH).contains(&x), || format!("must be {MIN_RADIUS:e} to {MAX_LENGTH:e}, got {x:e}"))
}

/// The radius at an end of a cone.
pub(super) fn end_radius(radius: f32) -> Result<(), String> {
    let ending = radius == 0.0 || size(radius).is_ok();
    require(ending, || format!("must be 0, or {MIN_RADIUS:e} to {MAX_BODY_LENGTH:e}, got {radius}"))
}

pub(super) fn angles(v: Vec3) -> Result<(), String> {
    require(v.is_finite() && v.abs().max_element() <= 1e6, || {
        format!("must be finite and within ±1e6 degrees, got {}", triple(v))
    })
}

pub(super) fn finite(x: f32) -> Result<(), String> {
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
pub(super) fn offset(normal: Vec3, distance: f32) -> Result<(), String> {
    let world = f64::from(distance) / normal.as_dvec3().length();
    require(world.abs() <= f64::from(MAX_LENGTH), || {
        format!("must be finite and within ±{MAX_LENGTH:e} normal lengths, got {distance}")
    })
}

pub(super) fn color(c: Vec3) -> Result<(), String> {
    parts(c, MAX_COLOR)
}

/// A light's power.
pub(super) fn power(c: Vec3) -> Result<(), String> {
    parts(c, f32::MAX)
}

/// What has a red, a green and a blue part, each from 0 to the greatest.
pub(super) fn parts(c: Vec3, most: f32) -> Result<(), String> {
    require(c.is_finite() && c.min_element() >= 0.0, || format!("must be finite and 0 or more, got {}", triple(c)))?;
    require(c.max_element() <= most, || format!("must be at most {most:e}, got {}", triple(c)))
}

pub(super) fn positive(x: f32) -> Result<(), String> {
    require(x > 0.0, || format!("must be above 0, got {x}"))?;
    require(x.is_finite(), || format!("must be finite, got {x}"))
}

/// A field of view in degrees.
pub(super) fn fov(fov: f32) -> Result<(), String> {
    require((MIN_FOV..180.0).contains(&fov), || format!("must be at least {MIN_FOV} and below 180, got {fov}"))
}

pub(super) fn triple(v: Vec3) -> String {
    format!("[{}, {}, {}]", v.x, v.y, v.z)
}

/// A name as a part of a dotted key: bare when TOML lets it, quoted otherwise.
pub(super) fn key_part(name: &str) -> String {
    let bare = !name.is_empty() && name.bytes().all(|b| b.is_ascii_alphanumeric() || b == b'_' || b == b'-');
    if bare { name.into() } else { format!("{name:?}") }
}
