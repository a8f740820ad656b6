//! The parallelogram corner + a u + b v, a and b from 0 to 1, seen from both sides.
//!
//! One method, [`planar`], as discs have it ([`super::disc`]): the ray meets the plane at t = −(T·n) / (d·n), with
//! T = o − corner and the unit normal n, and a and b are what q = T + t d there has along two vectors in the plane, each of
//! which is across one edge. So a hit is where q is on the quad, also where a ray is nearly in its plane and t is off by
//! much; it is none where rounding moves q off it. (Möller's and Trumbore's a and b, as triangles have them, are those of
//! the line and not of q, so that t may be anything then.)
//!
//! As with discs, the plane is missed by at most 8 ε (|o − corner| + longest edge), and rounding acts as if the origin were
//! moved by as much over the sine of the angle between the edges. Edges belong to the quad. A ray in its plane misses it.

use super::numbers::numbers;
use super::{Balls, Bounded, Cull, Footing, LaneHits, Mapping, Never, Number, Primitives, Surface, columns, flat};
use crate::math::{LaneMask, Lanes, Vec3, map2, map3};

/// Quads, column by column.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Quads {
    /// The corners.
    pub corner: [Vec<f32>; 3],
    /// The edges along which the first coordinate runs.
    pub u: [Vec<f32>; 3],
    /// The edges along which the second runs.
    pub v: [Vec<f32>; 3],
    /// Unit normals, u × v; for shading.
    pub unit: Vec<glam::Vec3>,
    /// Vectors in the plane: across v, and 1 along u; and the other way round.
    across: Vec<[glam::Vec3; 2]>,
    /// The longest edge over the sine of the angle between the edges.
    pub reach: Vec<f32>,
    /// Indices into the scene's materials.
    pub material: Vec<u32>,
    boxes: Vec<[glam::Vec3; 2]>,
    balls: Balls,
}

numbers! {
    /// A quad as stored.
    QuadShape {
        /// Its corner.
        corner: Vec3,
        /// Its unit normal.
        normal: Vec3,
        /// What tells a and b.
        across: [Vec3; 2],
        /// The box around it.
        bounds: [Vec3; 2],
    }
    /// A quad as seen from the rays' origin.
    SeenQuad {
        /// T = o − corner.
        from: Vec3,
        /// Its unit normal.
        normal: Vec3,
        /// What tells a and b.
        across: [Vec3; 2],
        /// −T·n.
        height: T,
    }
}

impl Quads {
    /// Adds a quad.
    pub fn push(&mut self, corner: glam::Vec3, u: glam::Vec3, v: glam::Vec3, material: u32) {
        columns::push(&mut self.corner, corner);
        columns::push(&mut self.u, u);
        columns::push(&mut self.v, v);
        self.material.push(material);
        let [u, v] = [u, v].map(|e| e.as_dvec3());
        let n = u.cross(v);
        self.unit.push(n.normalize().as_vec3());
        self.across.push([v.cross(n), n.cross(u)].map(|w| (w / n.length_squared()).as_vec3()));
        self.reach.push((u.length().max(v.length()) * (u.length() * v.length() / n.length())) as f32);
        self.boxes.push(self.enclose(self.material.len() - 1));
        self.balls.push_around(self.bounds(self.material.len() - 1));
    }

    /// A box around quad `i`.
    #[inline]
    pub fn bounds(&self, i: usize) -> [glam::Vec3; 2] {
        self.boxes[i]
    }

    fn enclose(&self, i: usize) -> [glam::Vec3; 2] {
        let [corner, u, v] = self.corner_and_edges(i);
        let corners = [corner, corner + u, corner + v, corner + u + v];
        let around =
            |pick: fn(glam::Vec3, glam::Vec3) -> glam::Vec3| corners.into_iter().reduce(pick).unwrap_or(corner);
        // The far corners were rounded.
        let slack = glam::Vec3::splat(f32::EPSILON * corners.iter().map(|c| c.abs().max_element()).fold(0.0, f32::max));
        [around(glam::Vec3::min) - slack, around(glam::Vec3::max) + slack]
    }

    /// Corner and edges of quad `i`.
    #[inline(always)]
    pub fn corner_and_edges(&self, i: usize) -> [glam::Vec3; 3] {
        map3([&self.corner, &self.u, &self.v], |c| columns::at(c, i))
    }
}

impl Bounded for Quads {
    const BOXED: bool = true;
    const COST: [f64; 2] = [2.0, 0.3];
    #[inline(always)]
    fn extent<L: Lanes>(quad: &QuadShape<L>) -> [Vec3<L>; 2] {
        quad.bounds
    }
    #[inline(always)]
    fn around(&self, i: usize) -> [glam::Vec3; 2] {
        self.boxes[i]
    }
}

impl Primitives for Quads {
    type Shape<T: Number> = QuadShape<T>;
    type Variant = ();
    type Seen<T: Copy> = SeenQuad<T>;
    type Aim<L: Lanes> = Vec3<L>;
    type Named = Never;

    #[inline(always)]
    fn materials(&self) -> &[u32] {
        &self.material
    }
    #[inline]
    fn cull(&self) -> Cull<'_> {
        Cull::Balls(&self.balls)
    }
    #[inline(always)]
    fn shape(&self, i: usize) -> QuadShape<f32> {
        let [corner, normal] = map2([columns::at(&self.corner, i), self.unit[i]], Vec3::from);
        QuadShape { corner, normal, across: map2(self.across[i], Vec3::from), bounds: map2(self.boxes[i], Vec3::from) }
    }
    #[inline]
    fn variant(&self, _: usize) {}
    #[inline(always)]
    fn zip<A: Number, B: Number, C: Number>(
        a: &QuadShape<A>,
        b: &QuadShape<B>,
        f: impl Fn(&A, &B) -> C,
    ) -> QuadShape<C> {
        a.zip(b, f)
    }
    #[inline(always)]
    fn seen<L: Lanes>(quad: &QuadShape<L>, (): (), origin: Vec3<L>) -> SeenQuad<L> {
        let QuadShape { corner, normal, across, .. } = *quad;
        let from = origin - corner;
        SeenQuad { from, normal, across, height: -from.dot(normal) }
    }
    #[inline(always)]
    fn splat_seen<L: Lanes>(seen: &SeenQuad<f32>) -> SeenQuad<L> {
        seen.map(|number| L::splat(*number))
    }
    #[inline(always)]
    fn nearest<L: Lanes>(seen: &SeenQuad<L>, (): (), d: &Vec3<L>, t_min: L, t_max: L) -> LaneHits<L> {
        planar(seen, *d, t_min, t_max)
    }

    #[inline(always)]
    fn surface<L: Lanes>(&self, i: usize, point: Vec3<L>) -> Surface<L> {
        flat::surface(self.unit[i], columns::at(&self.corner, i), self.reach[i], point)
    }
    #[inline(always)]
    fn footing<L: Lanes>(&self, i: usize, surface: &Surface<L>) -> Option<Footing<L>> {
        let [corner, u, v] = self.corner_and_edges(i);
        let [long, wide] = [u, v].map(|edge| edge.as_dvec3());
        let inner = 0.5 * long.cross(wide).length() / long.length().max(wide.length());
        Some(flat::footing(corner + 0.5 * (u + v), inner as f32, surface))
    }
    #[inline(always)]
    fn uv<L: Lanes>(&self, i: usize, surface: &Surface<L>) -> [L; 2] {
        flat::coordinates(self.corner_and_edges(i), self.unit[i], surface.point)
    }
    #[inline(always)]
    fn mapping<L: Lanes>(&self, _: usize, _: &Surface<L>) -> Mapping<L> {
        Mapping::face()
    }
    #[inline(always)]
    fn checker<L: Lanes>(&self, i: usize, surface: &Surface<L>) -> Vec3<L> {
        flat::checker(self.unit[i], surface.point)
    }
}

/// See the module's text.
#[inline(always)]
pub fn planar<L: Lanes>(seen: &SeenQuad<L>, direction: Vec3<L>, t_min: L, t_max: L) -> LaneHits<L> {
    let SeenQuad { from, normal, across: [across_v, across_u], height } = *seen;
    // In the plane, infinite or NaN.
    let t = height / normal.dot(direction);
    let inside = t.gt(t_min) & t.lt(t_max);
    if !inside.any() {
        return None;
    }
    let q = direction.mul_add(t, from);
    let (a, b) = (q.dot(across_v), q.dot(across_u));
    let inside = inside & L::zero().le(a.min(b)) & a.max(b).le(L::splat(1.0));
    inside.any().then_some((t, inside))
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::{Vec3 as V, vec3};

    fn quads() -> Quads {
        let mut quads = Quads::default();
        quads.push(vec3(1.0, 0.0, 0.0), V::X * 2.0, vec3(1.0, 3.0, 0.0), 0);
        quads
    }

    fn hit(origin: V, direction: V) -> Option<f32> {
        let quads = quads();
        planar(&Quads::seen(&quads.shape(0), (), origin.into()), direction.into(), 0.0, f32::INFINITY).map(|(t, _)| t)
    }

    #[test]
    fn inside_outside_and_both_sides() {
        for (x, y, inside) in [
            (1.5, 0.5, true),
            (3.9, 2.9, true),
            (1.0, 0.0, true),
            (4.0, 3.0, true),
            (2.0, 3.0, true),
            (1.5, 2.9, false),
            (3.5, 0.5, false),
            (0.9, 0.0, false),
            (2.0, 3.1, false),
            (2.0, -0.1, false),
        ] {
            assert_eq!(hit(vec3(x, y, 2.0), V::NEG_Z), inside.then_some(2.0), "{x} {y}");
            assert_eq!(hit(vec3(x, y, -2.0), V::Z), inside.then_some(2.0), "{x} {y}");
            assert_eq!(hit(vec3(x, y, -2.0), V::NEG_Z), None);
        }
    }

    #[test]
    fn rays_in_the_plane_miss() {
        assert_eq!(hit(vec3(-1.0, 1.0, 0.0), V::X), None);
        assert_eq!(hit(vec3(2.0, 1.0, 0.0), V::Z), None);
    }

    #[test]
    fn uv_are_the_coordinates() {
        let quads = quads();
        let [u, v] = quads.uv(0, &quads.surface::<f32>(0, vec3(3.0, 1.5, 0.25).into()));
        assert!((u - 0.75).abs() < 1e-6 && (v - 0.5).abs() < 1e-6, "{u} {v}");
    }

    #[test]
    fn bounds_hold_all_corners() {
        assert_eq!(quads().bounds(0).map(|v| v.round()), [vec3(1.0, 0.0, 0.0), vec3(4.0, 3.0, 0.0)]);
    }
}
