//! The scalar `f64` reference tracer: slow, plain, and the measure of everything else.
//!
//! It proves the packet tracer's answers, so it shares nothing with it but the [`Description`]: one ray at a
//! time, an array of structs per kind, textbook formulae, no acceleration structure, recursion for mirrors. A
//! fault in a packet kernel cannot hide in its own check.
//!
//! - [`Tracer`]: nearest hit ([`Tracer::intersect`]), any hit ([`Tracer::blocked`]) and Whitted shading
//!   ([`Tracer::radiance`]).
//! - [`Camera`]: the lecture's camera.
//! - [`render`] and [`hits`]: whole pictures, in the caller's rayon pool.
//!
//! All vectors are `f64`; directions have unit length, lengths are in world units, colours are linear RGB.
use crate::scene::{Description, Light, Material, Settings};
use glam::DVec3;

mod camera;
mod image;
mod plane;
mod shade;
mod sphere;
mod triangle;

pub use camera::Camera;
pub use image::{hits, render, render_with_progress};
pub use shade::Rounding;

use plane::Plane;
use sphere::Sphere;
use triangle::Triangle;

/// A nearest hit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    /// Distance along the unit direction.
    pub t: f64,
    /// Primitive id: planes first, then spheres, then the triangles of all meshes in order.
    pub primitive: u32,
    /// Unit geometric normal, turned against the ray.
    pub normal: DVec3,
}

/// A scene to trace, one ray at a time.
#[derive(Clone, Debug)]
pub struct Tracer {
    planes: Vec<Plane>,
    spheres: Vec<Sphere>,
    triangles: Vec<Triangle>,
    materials: Vec<Material>,
    lights: Vec<Light>,
    sky: DVec3,
    settings: Settings,
}

/// One primitive, found by its id.
#[derive(Clone, Copy)]
enum Primitive<'a> {
    Plane(&'a Plane),
    Sphere(&'a Sphere),
    Triangle(&'a Triangle),
}

impl Tracer {
    /// Takes a scene over; numbers are widened to `f64`, nothing else happens to them.
    ///
    /// # Panics
    /// When a mesh names a vertex that does not exist ([`crate::scene::check`] finds that).
    pub fn new(scene: &Description) -> Self {
        let triangles = scene.meshes.iter().flat_map(|mesh| {
            let corner = |i: u32| mesh.positions[i as usize].as_dvec3();
            mesh.triangles.iter().map(move |t| Triangle::new(t.map(corner), mesh.material))
        });
        Self {
            planes: scene.planes.iter().map(Plane::new).collect(),
            spheres: scene.spheres.iter().map(Sphere::new).collect(),
            triangles: triangles.collect(),
            materials: scene.materials.clone(),
            lights: scene.lights.clone(),
            sky: scene.sky.color.as_dvec3(),
            settings: scene.settings,
        }
    }

    /// The nearest hit in (0, `t_max`); on equal distance the lower id wins.
    pub fn intersect(&self, origin: DVec3, direction: DVec3, t_max: f64) -> Option<Hit> {
        let mut nearest = None;
        let mut t_max = t_max;
        // Ids ascend, and a later primitive has to be strictly nearer: so ties go to the lower id.
        self.distances(origin, direction).for_each(|(id, t)| {
            if t < t_max {
                t_max = t;
                nearest = Some(id);
            }
        });
        nearest.map(|id| {
            let normal = self.normal(id, origin + t_max * direction);
            Hit { t: t_max, primitive: id, normal: turned(normal, direction) }
        })
    }

    /// Whether anything lies in (0, `t_max`).
    pub fn blocked(&self, origin: DVec3, direction: DVec3, t_max: f64) -> bool {
        self.distances(origin, direction).any(|(_, t)| t < t_max)
    }

    /// A primitive's own size: a sphere's radius, a triangle's longest edge, 0 for planes and unknown ids.
    pub fn extent(&self, id: u32) -> f64 {
        match self.primitive(id) {
            Some(Primitive::Sphere(sphere)) => sphere.radius,
            Some(Primitive::Triangle(triangle)) => triangle.longest_edge(),
            Some(Primitive::Plane(_)) | None => 0.0,
        }
    }

    /// Every primitive the ray hits at t > 0, with its first such t, in the order of ids.
    fn distances(&self, origin: DVec3, direction: DVec3) -> impl Iterator<Item = (u32, f64)> {
        let planes = self.planes.iter().map(move |p| p.distance(origin, direction));
        let spheres = self.spheres.iter().map(move |s| s.distance(origin, direction));
        let triangles = self.triangles.iter().map(move |t| t.distance(origin, direction));
        let all = planes.chain(spheres).chain(triangles).enumerate();
        all.filter_map(|(id, t)| t.map(|t| (id as u32, t)))
    }

    fn primitive(&self, id: u32) -> Option<Primitive<'_>> {
        let sphere = (id as usize).wrapping_sub(self.planes.len());
        let triangle = sphere.wrapping_sub(self.spheres.len());
        None.or(self.planes.get(id as usize).map(Primitive::Plane))
            .or(self.spheres.get(sphere).map(Primitive::Sphere))
            .or(self.triangles.get(triangle).map(Primitive::Triangle))
    }

    /// The unit normal as described or wound: not turned towards anyone.
    fn normal(&self, id: u32, point: DVec3) -> DVec3 {
        match self.primitive(id) {
            Some(Primitive::Plane(plane)) => plane.normal,
            Some(Primitive::Sphere(sphere)) => sphere.normal(point),
            Some(Primitive::Triangle(triangle)) => triangle.normal,
            None => DVec3::ZERO,
        }
    }
}

/// `normal`, turned against `direction`.
fn turned(normal: DVec3, direction: DVec3) -> DVec3 {
    if normal.dot(direction) > 0.0 { -normal } else { normal }
}

#[cfg(test)]
mod tests;
