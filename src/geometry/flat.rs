//! The geometry that triangles, quads and discs share: a plane by its unit normal, and coordinates along two edges.

use super::{Footing, Surface, frame};
use crate::math::{Lanes, Vec3, map2, map3};

/// The surface at `point` of the plane through `corner` with this unit normal.
#[inline(always)]
pub(super) fn surface<L: Lanes>(unit: glam::Vec3, corner: glam::Vec3, reach: f32, point: Vec3<L>) -> Surface<L> {
    let normal = Vec3::splat(unit);
    let height = normal.dot(point - Vec3::splat(corner));
    Surface { point: normal.mul_add(-height, point), normal, reach }
}

/// Where a ray goes on through a flat primitive that holds a circle of radius `inner` about `middle`: nearer to there by so
/// much that rounding does not take the point across an edge, where another primitive of the same body may begin.
#[inline(always)]
pub(super) fn footing<L: Lanes>(middle: glam::Vec3, inner: f32, surface: &Surface<L>) -> Footing<L> {
    let share = surface.point.max_abs() * L::splat((4.0 * f32::EPSILON / inner).min(f32::MAX));
    let share = share.min(L::splat(0.5));
    let point = (Vec3::splat(middle) - surface.point).mul_add(share, surface.point);
    Footing { point, curvature: 0.0 }
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
