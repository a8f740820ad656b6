//! One primitive's surface near a point, and the normals there.

use super::spawn::Offsets;
use crate::geometry::{Footing, Primitives, Surface};
use crate::math::{Lanes, Vec3};
use crate::scene::{Scene, with_primitive};

/// The normal that primitive `id` is shaded by, on the side of the surface's own.
#[inline(always)]
pub fn shading_normal<L: Lanes>(scene: &Scene, id: u32, surface: &Surface<L>) -> Vec3<L> {
    smooth(scene, id, surface).map_or(surface.normal, |[normal, _]| normal)
}

/// Where primitive `id` has vertex normals, that normal, and how far it is to where lights are seen from
/// ([`crate::geometry::Triangles::smooth`]).
#[inline(always)]
pub fn smooth<L: Lanes>(scene: &Scene, id: u32, surface: &Surface<L>) -> Option<[Vec3<L>; 2]> {
    let triangles = scene.first.triangles..scene.first.quads;
    triangles.contains(&id).then(|| scene.triangles.smooth((id - triangles.start) as usize, surface)).flatten()
}

/// Where rays start that leave primitive `id`, and what stands for the largest coordinate in their lift.
#[inline(always)]
pub fn start<L: Lanes>(scene: &Scene, id: u32, surface: &Surface<L>, transparent: bool) -> (Vec3<L>, L) {
    let footing = if transparent { footing(scene, id, surface) } else { None };
    match footing {
        None => (surface.point, surface.point.max_abs()),
        Some(footing) => (footing.point, Offsets::of(&scene.plan.methods).along(&footing, surface.normal)),
    }
}

/// [`Primitives::footing`] of primitive `id`.
#[inline(never)]
fn footing<L: Lanes>(scene: &Scene, id: u32, surface: &Surface<L>) -> Option<Footing<L>> {
    with_primitive!(scene, id, |kind, i| kind.footing(i, surface))
}

/// Primitive `id`'s surface near the points `p`, and its material.
pub fn surface<L: Lanes>(scene: &Scene, id: u32, p: Vec3<L>) -> (Surface<L>, u32) {
    with_primitive!(scene, id, |kind, i| (kind.surface(i, p), kind.material(i)))
}

/// The unit normals where one ray hit a primitive, the surface's own and that for shading, on the side that the ray came
/// from; zero for a ray that hit nothing.
pub(crate) fn facing_normals(
    scene: &Scene,
    id: u32,
    origin: glam::Vec3,
    direction: glam::Vec3,
    t: f32,
) -> [[f32; 3]; 2] {
    if id == crate::math::NONE {
        return [[0.0; 3]; 2];
    }
    let (surface, _) = surface::<f32>(scene, id, (origin + direction * t).into());
    let normals = [surface.normal, shading_normal(scene, id, &surface)].map(glam::Vec3::from);
    let behind = normals[0].dot(direction) > 0.0;
    normals.map(|n| (if behind { -n } else { n }).to_array())
}
