//! Whitted shading: the light that arrives along a ray.
use super::{Tracer, texture, turned};
use crate::scene::{Light, Material, Pigment};
use glam::DVec3;
use std::f64::consts::PI;

/// How roughly a path is followed. All but [`Rounding::FINE`] is there to ask how a picture looks to a tracer that
/// computes with fewer digits.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rounding {
    /// How far a secondary ray starts off its surface, relative to the size of the numbers involved: |p|, the sphere's
    /// radius, the triangle's longest edge.
    pub lift: f64,
    /// How far secondary rays are off where they hit, relative to the same size.
    pub shift: DVec3,
}

impl Rounding {
    /// As fine as `f64` allows.
    ///
    /// A hit point is put back onto its surface before use, which leaves an error of a few 2^-53 of the numbers
    /// involved. The lift is some thousand times that, and 1e-12 of the scene: far below any `f32` step.
    pub const FINE: Self = Self { lift: 1.0 / (1u64 << 40) as f64, shift: DVec3::ZERO };
}

/// What a ray carries through the recursion.
#[derive(Clone, Copy)]
struct Way<'a> {
    rounding: &'a Rounding,
    /// The number of segments so far; the eye ray is 1.
    depth: u32,
}

/// A point on a surface, as shading sees it.
struct Point<'a> {
    /// Exactly on the surface but for rounding.
    position: DVec3,
    /// Unit, turned against the ray.
    normal: DVec3,
    /// The size of the numbers that made `position`.
    scale: f64,
    material: &'a Material,
    base: DVec3,
}

impl Tracer {
    /// The linear radiance seen from `origin` along the unit `direction`.
    pub fn radiance(&self, origin: DVec3, direction: DVec3) -> DVec3 {
        self.radiance_rounded(origin, direction, &Rounding::FINE)
    }

    /// The same, as it looks with more rounding.
    pub fn radiance_rounded(&self, origin: DVec3, direction: DVec3, rounding: &Rounding) -> DVec3 {
        self.radiance_along(origin, direction, Way { rounding, depth: 1 })
    }

    fn radiance_along(&self, origin: DVec3, direction: DVec3, way: Way<'_>) -> DVec3 {
        let Some(point) = self.visible(origin, direction, way) else { return texture::sky(&self.sky, direction) };
        let mirrored = reflect(direction, point.normal);
        let reflectance = f64::from(point.material.reflectance);
        let ambient = self.settings.ambient.as_dvec3() * point.base;
        let lit: DVec3 = self.lights.iter().map(|light| self.direct(light, &point, mirrored, way.rounding)).sum();
        let own = (1.0 - reflectance) * (ambient + lit);
        if reflectance > 0.0 && way.depth < self.settings.max_depth {
            let next = Way { depth: way.depth + 1, ..way };
            own + reflectance * self.radiance_along(point.lifted(way.rounding), mirrored, next)
        } else {
            own
        }
    }

    fn visible(&self, origin: DVec3, direction: DVec3, way: Way<'_>) -> Option<Point<'_>> {
        let hit = self.intersect(origin, direction, f64::INFINITY)?;
        let mut rough = origin + hit.t * direction;
        let scale = rough.length().max(self.extent(hit.primitive));
        if way.depth > 1 {
            rough += slid(way.rounding.shift * scale, direction, hit.normal);
        }
        let primitive = &self.primitives[hit.primitive as usize];
        let position = primitive.project(rough);
        let material = &self.materials[primitive.material()];
        let normal = turned(primitive.normal(position), direction);
        let base = match material.pigment {
            Pigment::Color(color) => color.as_dvec3(),
            Pigment::Checker { colors, size } => checker(colors, primitive.checker(position) / f64::from(size)),
            Pigment::Texture { texture, size } => {
                texture::sample(&self.textures[texture], primitive.uv(position) / f64::from(size))
            }
        };
        Some(Point { position, normal, scale, material, base })
    }

    /// What one light adds: E (base n·l + specular max(0, r·l)^shininess), unless something is in the way.
    fn direct(&self, light: &Light, point: &Point<'_>, mirrored: DVec3, rounding: &Rounding) -> DVec3 {
        let position = light.position.as_dvec3();
        let to_light = position - point.position;
        let Some(l) = to_light.try_normalize() else { return DVec3::ZERO };
        let cosine = point.normal.dot(l);
        if cosine <= 0.0 || self.shadowed(point, position, rounding) {
            return DVec3::ZERO;
        }
        let power = light.power.as_dvec3();
        let irradiance = if self.settings.attenuation { power / (4.0 * PI * to_light.length_squared()) } else { power };
        let shininess = f64::from(point.material.shininess);
        let highlight = f64::from(point.material.specular) * mirrored.dot(l).max(0.0).powf(shininess);
        irradiance * (point.base * cosine + DVec3::splat(highlight))
    }

    /// Whether anything lies between the surface and a light, the two ends left out.
    fn shadowed(&self, point: &Point<'_>, light: DVec3, rounding: &Rounding) -> bool {
        let start = point.lifted(rounding);
        let (direction, distance) = (light - start).normalize_and_length();
        // A surface through the light itself does not block it.
        let slack = rounding.lift * (distance + light.length());
        self.blocked(start, direction, distance - slack)
    }
}

impl Point<'_> {
    /// Where a secondary ray starts: off the surface by more than the rounding of its position.
    fn lifted(&self, rounding: &Rounding) -> DVec3 {
        self.position + rounding.lift * self.scale * self.normal
    }
}

/// How far the hit point slides on its surface, to first order, when the ray is shifted.
fn slid(shift: DVec3, direction: DVec3, normal: DVec3) -> DVec3 {
    // The normal faces the ray. Next to grazing, a curved surface ends the slide before the plane would.
    let slope = normal.dot(direction).min(-1e-3);
    shift - direction * (shift.dot(normal) / slope)
}

fn reflect(direction: DVec3, normal: DVec3) -> DVec3 {
    direction - 2.0 * direction.dot(normal) * normal
}

/// The first colour in cells whose indices sum to an even number.
fn checker(colors: [glam::Vec3; 2], cell: DVec3) -> DVec3 {
    let sum = cell.floor().element_sum();
    colors[usize::from(sum.rem_euclid(2.0) != 0.0)].as_dvec3()
}
