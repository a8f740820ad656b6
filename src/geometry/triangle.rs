//! The triangle v0, v0 + e1, v0 + e2, seen from both sides.
//!
//! One method: [`moller_trumbore`] (Möller, Trumbore, *Fast, Minimum Storage Ray/Triangle Intersection*, 1997) with its
//! determinants expanded along the direction instead of the edges: with T = o − v0 and N = e1 × e2,
//!
//! det = d·N, u = d·(T × e2) / det, v = d·(e1 × T) / det, t = −T·N / det
//!
//! so that everything but three scalar products belongs to the origin. The plane is missed by at most
//! 8 ε (|T| + longest edge) / sin of the smallest angle. A triangle without area is never hit; an edge belongs to
//! both triangles that share it, but rounding may open a crack of some ε |T| between them.

use super::{Nearest, Surface};
use crate::math::{LaneMask, Lanes, Vec3};

/// Triangles, column by column.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Triangles {
    /// First corners.
    pub v0: [Vec<f32>; 3],
    /// Second corner − first.
    pub e1: [Vec<f32>; 3],
    /// Third corner − first.
    pub e2: [Vec<f32>; 3],
    /// Unit normals, zero for a triangle without area; for shading.
    pub unit: Vec<glam::Vec3>,
    /// The longest edge over the sine of the angle at the first corner: what the rounding of the test is
    /// proportional to, as N's is to |e1| |e2|.
    pub reach: Vec<f32>,
    /// Indices into the scene's materials.
    pub material: Vec<u32>,
}

/// What a triangle's test needs of it and of the rays' origin.
#[derive(Clone, Copy, Debug)]
pub struct SeenTriangle<L> {
    /// N = e1 × e2.
    pub n: Vec3<L>,
    /// T × e2.
    pub u: Vec3<L>,
    /// e1 × T.
    pub v: Vec3<L>,
    /// −T·N.
    pub height: L,
}

impl Triangles {
    /// The number of triangles.
    pub fn len(&self) -> usize {
        self.material.len()
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.material.is_empty()
    }

    /// Adds a triangle by its corners.
    pub fn push(&mut self, corners: [glam::Vec3; 3], material: u32) {
        let [a, b, c] = corners;
        for axis in 0..3 {
            self.v0[axis].push(a[axis]);
            self.e1[axis].push((b - a)[axis]);
            self.e2[axis].push((c - a)[axis]);
        }
        self.material.push(material);
        // In f64, where no product of lengths overflows or vanishes.
        let [e1, e2] = [(b - a).as_dvec3(), (c - a).as_dvec3()];
        let n = e1.cross(e2);
        let longest = e1.length().max(e2.length()).max((e2 - e1).length());
        self.unit.push(n.try_normalize().unwrap_or_default().as_vec3());
        self.reach.push((longest * (e1.length() * e2.length() / n.length()).max(1.0)) as f32);
    }

    /// First corner and two edges of triangle `i`.
    #[inline(always)]
    pub fn corner_and_edges(&self, i: usize) -> [glam::Vec3; 3] {
        [&self.v0, &self.e1, &self.e2].map(|c| glam::Vec3::new(c[0][i], c[1][i], c[2][i]))
    }

    /// Triangle `i` as seen from `origin`.
    #[inline(always)]
    pub fn seen<L: Lanes>(&self, i: usize, origin: Vec3<L>) -> SeenTriangle<L> {
        let [v0, e1, e2] = self.corner_and_edges(i).map(Vec3::splat);
        SeenTriangle::new(v0, e1, e2, origin)
    }

    /// The surface of triangle `i` at `point`, which lies near its plane.
    #[inline(always)]
    pub fn surface<L: Lanes>(&self, i: usize, point: Vec3<L>) -> Surface<L> {
        let normal = Vec3::splat(self.unit[i]);
        let height = normal.dot(point - Vec3::splat(self.corner_and_edges(i)[0]));
        Surface { point: normal.mul_add(-height, point), normal, reach: self.reach[i] }
    }
}

impl<L: Lanes> SeenTriangle<L> {
    /// A triangle as seen from `origin`.
    #[inline(always)]
    pub fn new(v0: Vec3<L>, e1: Vec3<L>, e2: Vec3<L>, origin: Vec3<L>) -> Self {
        let n = e1.cross(e2);
        let t = origin - v0;
        Self { n, u: t.cross(e2), v: e1.cross(t), height: -t.dot(n) }
    }
}

impl SeenTriangle<f32> {
    /// The same in every lane.
    #[inline(always)]
    pub fn splat<L: Lanes>(&self) -> SeenTriangle<L> {
        let [n, u, v] = [self.n, self.u, self.v].map(|a| Vec3::splat(a.into()));
        SeenTriangle { n, u, v, height: L::splat(self.height) }
    }
}

/// See the module's text.
#[inline(always)]
pub fn moller_trumbore<L: Lanes>(seen: &SeenTriangle<L>, direction: Vec3<L>, t_min: L, t_max: L) -> Nearest<L> {
    let inverse = L::splat(1.0) / seen.n.dot(direction);
    let t = seen.height * inverse;
    let inside = t.gt(t_min) & t.lt(t_max);
    if !inside.any() {
        return None;
    }
    let u = seen.u.dot(direction) * inverse;
    let v = seen.v.dot(direction) * inverse;
    let inside = inside & L::zero().le(u.min(v)) & (u + v).le(L::splat(1.0));
    inside.any().then_some((t, inside))
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::{Vec3 as V, vec3};

    fn hit(corners: [V; 3], origin: V, direction: V) -> Option<f32> {
        let mut triangles = Triangles::default();
        triangles.push(corners, 0);
        moller_trumbore(&triangles.seen(0, origin.into()), direction.into(), 0.0, f32::INFINITY).map(|(t, _)| t)
    }

    const UNIT: [V; 3] = [V::ZERO, V::X, V::Y];

    #[test]
    fn both_sides_and_either_winding() {
        let [a, b, c] = UNIT;
        for corners in [[a, b, c], [a, c, b], [b, c, a]] {
            assert_eq!(hit(corners, vec3(0.25, 0.25, 2.0), V::NEG_Z), Some(2.0));
            assert_eq!(hit(corners, vec3(0.25, 0.25, -2.0), V::Z), Some(2.0));
            assert_eq!(hit(corners, vec3(0.25, 0.25, -2.0), V::NEG_Z), None);
            assert_eq!(hit(corners, vec3(0.75, 0.75, 2.0), V::NEG_Z), None);
            assert_eq!(hit(corners, vec3(-0.01, 0.5, 2.0), V::NEG_Z), None);
        }
    }

    #[test]
    fn edges_and_corners_belong_to_the_triangle() {
        for p in [V::ZERO, V::X, V::Y, vec3(0.5, 0.0, 0.0), vec3(0.0, 0.5, 0.0), vec3(0.5, 0.5, 0.0)] {
            assert_eq!(hit(UNIT, p + V::Z, V::NEG_Z), Some(1.0), "{p}");
        }
    }

    #[test]
    fn parallel_rays_and_degenerate_triangles_miss() {
        assert_eq!(hit(UNIT, vec3(-1.0, 0.2, 0.0), V::X), None);
        assert_eq!(hit(UNIT, vec3(-1.0, 0.2, 1.0), V::X), None);
        assert_eq!(hit([V::ZERO, V::X, V::X * 2.0], vec3(0.5, 0.0, 1.0), V::NEG_Z), None);
        assert_eq!(hit([V::ONE; 3], vec3(1.0, 1.0, 3.0), V::NEG_Z), None);
    }
}
