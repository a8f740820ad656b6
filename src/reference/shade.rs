//! Whitted shading: the light that arrives along a ray.
use super::{Primitive, Tracer, turned};
use crate::scene::{Light, Material, Pigment};
use glam::DVec3;
use std::f64::consts::PI;

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
        self.radiance_at(origin, direction, 1)
    }

    /// `depth` counts the segments of the path; the eye ray is 1.
    fn radiance_at(&self, origin: DVec3, direction: DVec3, depth: u32) -> DVec3 {
        let Some(point) = self.visible(origin, direction) else { return self.sky };
        let mirrored = reflect(direction, point.normal);
        let reflectance = f64::from(point.material.reflectance);
        let ambient = self.settings.ambient.as_dvec3() * point.base;
        let lit: DVec3 = self.lights.iter().map(|light| self.direct(light, &point, mirrored)).sum();
        let own = (1.0 - reflectance) * (ambient + lit);
        if reflectance > 0.0 && depth < self.settings.max_depth {
            own + reflectance * self.radiance_at(self.lifted(&point), mirrored, depth + 1)
        } else {
            own
        }
    }

    fn visible(&self, origin: DVec3, direction: DVec3) -> Option<Point<'_>> {
        let hit = self.intersect(origin, direction, f64::INFINITY)?;
        let rough = origin + hit.t * direction;
        let primitive = self.primitive(hit.primitive)?;
        let (position, material) = match primitive {
            Primitive::Plane(plane) => (plane.project(rough), plane.material),
            Primitive::Sphere(sphere) => (sphere.project(rough), sphere.material),
            Primitive::Triangle(triangle) => (triangle.project(rough), triangle.material),
        };
        let material = &self.materials[material];
        let normal = self.normal(hit.primitive, position);
        let base = match (material.pigment, primitive) {
            (Pigment::Color(color), _) => color.as_dvec3(),
            (Pigment::Checker { colors, size }, Primitive::Sphere(sphere)) => {
                checker(colors, ((position - sphere.center) / f64::from(size)).to_array())
            }
            (Pigment::Checker { colors, size }, _) => {
                let [tangent, bitangent] = axes(normal);
                checker(colors, [tangent, bitangent].map(|axis| position.dot(axis) / f64::from(size)))
            }
        };
        let scale = position.length().max(self.extent(hit.primitive));
        Some(Point { position, normal: turned(normal, direction), scale, material, base })
    }

    /// What one light adds: E (base n·l + specular max(0, r·l)^shininess), unless something is in the way.
    fn direct(&self, light: &Light, point: &Point<'_>, mirrored: DVec3) -> DVec3 {
        let position = light.position.as_dvec3();
        let to_light = position - point.position;
        let Some(l) = to_light.try_normalize() else { return DVec3::ZERO };
        let cosine = point.normal.dot(l);
        if cosine <= 0.0 || self.shadowed(point, position) {
            return DVec3::ZERO;
        }
        let power = light.power.as_dvec3();
        let irradiance = if self.settings.attenuation { power / (4.0 * PI * to_light.length_squared()) } else { power };
        let shininess = f64::from(point.material.shininess);
        let highlight = f64::from(point.material.specular) * mirrored.dot(l).max(0.0).powf(shininess);
        irradiance * (point.base * cosine + DVec3::splat(highlight))
    }

    /// Whether anything lies between the surface and a light, the two ends left out.
    fn shadowed(&self, point: &Point<'_>, light: DVec3) -> bool {
        let start = self.lifted(point);
        let (direction, distance) = (light - start).normalize_and_length();
        // A surface through the light itself does not block it.
        let slack = self.lift * (distance + light.length());
        self.blocked(start, direction, distance - slack)
    }

    /// Where a secondary ray starts: off the surface by more than the rounding of its position.
    fn lifted(&self, point: &Point<'_>) -> DVec3 {
        point.position + self.lift * point.scale * point.normal
    }
}

fn reflect(direction: DVec3, normal: DVec3) -> DVec3 {
    direction - 2.0 * direction.dot(normal) * normal
}

/// The axes of a checkerboard in a plane or triangle with the unit normal `n`, as described or wound.
fn axes(n: DVec3) -> [DVec3; 2] {
    let [x, y, z] = n.abs().to_array();
    let across = if (y >= x && y >= z) || x < z { DVec3::X } else { DVec3::Z };
    let tangent = (across - n * n.dot(across)).normalize();
    [tangent, tangent.cross(n)]
}

/// The first colour in cells whose indices sum to an even number.
fn checker<const N: usize>(colors: [glam::Vec3; 2], cell: [f64; N]) -> DVec3 {
    let sum: f64 = cell.iter().map(|c| c.floor()).sum();
    colors[usize::from(sum.rem_euclid(2.0) != 0.0)].as_dvec3()
}
