//! The geometry that triangles, quads and discs share: a plane by its unit normal, and coordinates along two edges.

use super::{Surface, frame};
use crate::math::{Lanes, Vec3, map2, map3};

/// The surface at `point` of the plane through `corner` with this unit normal.
#[inline(always)]
pub(super) fn surface<L: Lanes>(unit: glam::Vec3, corner: glam::Vec3, reach: f32, point: Vec3<L>) -> Surface<L> {
    let normal = Vec3::splat(unit);
    let height = normal.dot(point - Vec3::splat(corner));
    Surface { point: normal.mul_add(-height, point), normal, reach }
}

/// The a and b of a point corner + a u + b v, by areas as a part of that of u × v, whose unit vector `unit` is.
#[inline(always)]
pub(super) fn coordinates<L: Lanes>(corner_and_edges: [glam::Vec3; 3], unit: glam::Vec3, point: Vec3<L>) -> [L; 2] {
    let [corner, u, v] = map3(corner_and_edges, Vec3::splat);
    let unit = Vec3::splat(unit);
    let q = point - corner;
    let per_area = L::splat(1.0) / unit.dot(u.cross(v));
    [unit.dot(q.cross(v)) * per_area, unit.dot(u.cross(q)) * per_area]
}

/// (p·T, p·B) with the axes of [`frame`] of the unit normal, for a checkerboard.
#[inline(always)]
pub(super) fn checker<L: Lanes>(unit: glam::Vec3, point: Vec3<L>) -> Vec3<L> {
    let [t, b] = map2(frame(unit), Vec3::splat);
    Vec3::new(point.dot(t), point.dot(b), L::zero())
}
