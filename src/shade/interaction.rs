//! The surface at a hit, for whoever shades by code of their own.

use glam::{Vec2, Vec3};

use super::spawn::{Offsets, shadow_from_point};
use super::surface::{shading_normal, surface};
use crate::geometry::Primitives;
use crate::math;
use crate::scene::{Scene, with_primitive};
use crate::trace::{Hit, Ray};

/// A surface where a ray has hit it, in world space.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct SurfaceInteraction {
    /// The point, on the surface to within rounding.
    pub point: Vec3,
    /// The unit geometric normal: outward, or where a mesh's corners run counter-clockwise, whichever side the ray is
    /// on. Zero for a triangle without area.
    pub normal: Vec3,
    /// The unit normal for shading, on the same side: interpolated where a mesh has vertex normals, else `normal`.
    pub shading_normal: Vec3,
    /// Whether the ray came from the side of the normals.
    pub front: bool,
    /// Texture coordinates, as the primitive's type in [`scene`](crate::scene) defines them.
    pub uv: Vec2,
    /// Its material, by its place in [`Scene::materials`].
    pub material: usize,
    /// How far off the surface, in world units, a ray has to start so as not to meet it again by rounding. This is a
    /// bound on the rounding, unless the scene was compiled with another method of `offset`.
    pub lift: f32,
    offsets: Offsets,
}

impl Scene {
    /// The surface at the hit of a ray.
    ///
    /// # Panics
    /// When the hit's id is of no primitive of this scene ([`NONE`](crate::trace::NONE) is of none).
    pub fn surface(&self, ray: &Ray, hit: &Hit) -> SurfaceInteraction {
        let [direction, origin] = [ray.direction, ray.origin].map(math::Vec3::<f32>::from);
        let (surface, material) = surface(self, hit.primitive, direction.mul_add(hit.t, origin));
        let uv = with_primitive!(self, hit.primitive, |kind, i| kind.uv(i, &surface));
        let normal = Vec3::from(surface.normal);
        let offsets = Offsets::of(&self.plan.methods);
        SurfaceInteraction {
            point: surface.point.into(),
            normal,
            shading_normal: shading_normal(self, hit.primitive, &surface).into(),
            front: normal.dot(ray.direction) <= 0.0,
            uv: uv.into(),
            material: material as usize,
            lift: offsets.lift(surface.point, surface.reach),
            offsets,
        }
    }
}

impl SurfaceInteraction {
    /// The ray that leaves the surface in a unit direction, to either side, without an end. It does not meet the
    /// surface that it leaves by rounding, and needs no `t_min`.
    pub fn spawn_ray(&self, direction: Vec3) -> Ray {
        Ray::new(self.point + self.towards(direction) * self.lift, direction)
    }

    /// The ray that leaves the surface towards a point, and ends just before it: a shadow ray to a light.
    pub fn spawn_ray_to(&self, target: Vec3) -> Ray {
        let normal = self.towards(target - self.point);
        let [target, point, normal] = [target, self.point, normal].map(math::Vec3::<f32>::from);
        let ray = shadow_from_point(&self.offsets, target, point, normal, self.lift);
        Ray { origin: ray.origin.into(), direction: ray.direction.into(), t_min: 0.0, t_max: ray.t_max }
    }

    /// The normal on the side that a direction leads to.
    fn towards(&self, direction: Vec3) -> Vec3 {
        if self.normal.dot(direction) < 0.0 { -self.normal } else { self.normal }
    }
}
