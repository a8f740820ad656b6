//! The box min ≤ p ≤ max, aligned to the axes or turned about its centre; seen from outside and inside.
//!
//! One method, [`slabs`] (Kay and Kajiya, *Ray Tracing Complex Scenes*, SIGGRAPH 1986): the ray is in the box where it is
//! between both faces of all three pairs. In the box's own axes, with half its size h and the origin at q, it is between
//! a pair from (∓h − q) / d to (±h − q) / d; it enters the box at the greatest of the starts and leaves at the least of the
//! ends. Both come from the same six quotients, so no ray slips through an edge or a corner that two faces share.
//!
//! - The box is closed. A ray that runs in a face's plane (d = 0, q = ±h: the quotient 0 / 0 is NaN, and passed over)
//!   is between that pair, so it meets the box where it crosses the face's border; a ray that runs along an edge meets
//!   it at the edge's end; one that touches an edge or a corner hits it. Of a turned box, rounding decides.
//! - From inside and from the surface the ray meets the box where it leaves it; a ray that starts on a face and leaves
//!   the box meets nothing.
//! - Not turned: t is off by 3 ε t. Two boxes that share a face leave no gap: the quotient is the same for both.
//! - Turned: the rotation is made in `f64` and rounded once. The faces are missed by 5 ε |o − centre| + 7 ε t + 2 ε
//!   |furthest corner|.

use super::face;
pub use super::face::Aim;
use super::frame::along;
use super::numbers::numbers;
use super::{Balls, Bounded, Cull, Footing, LaneHits, Mapping, Never, Number, Primitives, Surface, Variant, columns};
use crate::math::{LaneMask, Lanes, Vec3, map2, map3};
use glam::DMat3;

/// ε, the unit roundoff.
const ROUNDOFF: f32 = 0.5 * f32::EPSILON;

/// Boxes, column by column.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Cuboids {
    /// The corners with the least coordinates, before they are turned.
    pub min: [Vec<f32>; 3],
    /// The corners with the greatest.
    pub max: [Vec<f32>; 3],
    /// The box's own unit axes; none where they are the world's.
    pub axes: Vec<Option<[glam::Vec3; 3]>>,
    /// Indices into the scene's materials.
    pub material: Vec<u32>,
    boxes: Vec<[glam::Vec3; 2]>,
    balls: Balls,
}

numbers! {
    /// A box as stored.
    CuboidShape {
        /// The corner with the least coordinates, before it is turned.
        min: Vec3,
        /// The corner with the greatest.
        max: Vec3,
        /// Its own axes; of account only where it is turned.
        axes: [Vec3; 3],
        /// The box along the world's axes around it.
        bounds: [Vec3; 2],
    }
    /// A box as seen from the rays' origin.
    SeenCuboid {
        /// The lower face of each pair, from the origin, in the box's own axes.
        low: Vec3,
        /// The upper face.
        high: Vec3,
        /// The box's own axes; of account only where it is turned.
        axes: [Vec3; 3],
    }
}

/// Whether a box's axes are not the world's.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Turned(pub bool);

impl Variant for Turned {
    fn code(self) -> u8 {
        u8::from(self.0)
    }
}

impl Cuboids {
    /// Adds a box: `rotation` in degrees about x, then y, then z.
    pub fn push(&mut self, min: glam::Vec3, max: glam::Vec3, rotation: glam::Vec3, material: u32) {
        columns::push(&mut self.min, min);
        columns::push(&mut self.max, max);
        let turn = turned(rotation);
        let axes = [turn.x_axis, turn.y_axis, turn.z_axis].map(|axis| axis.as_vec3());
        self.axes.push((turn != DMat3::IDENTITY).then_some(axes));
        self.material.push(material);
        self.boxes.push(self.enclose(self.material.len() - 1));
        self.balls.push_around(self.bounds(self.material.len() - 1));
    }

    /// The corners of box `i` with the least and the greatest coordinates, before they are turned.
    #[inline(always)]
    pub fn corners(&self, i: usize) -> [glam::Vec3; 2] {
        map2([&self.min, &self.max], |c| columns::at(c, i))
    }

    /// Centre and half the size of box `i`, each rounded once.
    #[inline(always)]
    pub fn center_and_half(&self, i: usize) -> [glam::Vec3; 2] {
        let [min, max] = self.corners(i);
        [(min + max) * 0.5, (max - min) * 0.5]
    }

    /// A box along the world's axes around box `i`.
    #[inline]
    pub fn bounds(&self, i: usize) -> [glam::Vec3; 2] {
        self.boxes[i]
    }

    fn enclose(&self, i: usize) -> [glam::Vec3; 2] {
        let [center, half] = self.center_and_half(i);
        let Some([x, y, z]) = self.axes[i] else { return self.corners(i) };
        let around = x.abs() * half.x + y.abs() * half.y + z.abs() * half.z;
        // Eight roundings at most: axes, half, sums and centre.
        let slack = 8.0 * ROUNDOFF * (center.abs().max_element() + around.max_element());
        [center - around - slack, center + around + slack]
    }

    /// A point in the box's own axes, from its centre, and half the box's size.
    #[inline(always)]
    fn own<L: Lanes>(&self, i: usize, point: Vec3<L>) -> [Vec3<L>; 2] {
        let [center, half] = map2(self.center_and_half(i), Vec3::splat);
        let q = point - center;
        [self.axes[i].map_or(q, |axes| along(&map3(axes, Vec3::splat), q)), half]
    }

    /// A surface's normal in the box's own axes, up to rounding.
    #[inline(always)]
    fn own_normal<L: Lanes>(&self, i: usize, surface: &Surface<L>) -> Vec3<L> {
        self.axes[i].map_or(surface.normal, |axes| along(&map3(axes, Vec3::splat), surface.normal))
    }
}

/// The rotation about x, then y, then z by degrees, exact for quarter turns.
fn turned(degrees: glam::Vec3) -> DMat3 {
    let [x, y, z] = degrees.to_array().map(|degrees| {
        let degrees = f64::from(degrees) % 360.0;
        let quarters = (degrees / 90.0).round();
        let (sin, cos) = (degrees - 90.0 * quarters).to_radians().sin_cos();
        match (quarters as i32).rem_euclid(4) {
            0 => (sin, cos),
            1 => (cos, -sin),
            2 => (-sin, -cos),
            _ => (-cos, sin),
        }
    });
    let about_x = DMat3::from_cols_array(&[1.0, 0.0, 0.0, 0.0, x.1, x.0, 0.0, -x.0, x.1]);
    let about_y = DMat3::from_cols_array(&[y.1, 0.0, -y.0, 0.0, 1.0, 0.0, y.0, 0.0, y.1]);
    let about_z = DMat3::from_cols_array(&[z.1, z.0, 0.0, -z.0, z.1, 0.0, 0.0, 0.0, 1.0]);
    about_z * about_y * about_x
}

impl Bounded for Cuboids {
    const BOXED: bool = true;
    const COST: [f64; 2] = [2.0, 0.3];
    #[inline(always)]
    fn extent<L: Lanes>(cuboid: &CuboidShape<L>) -> [Vec3<L>; 2] {
        cuboid.bounds
    }
    #[inline(always)]
    fn around(&self, i: usize) -> [glam::Vec3; 2] {
        self.boxes[i]
    }
}

impl Primitives for Cuboids {
    type Shape<T: Number> = CuboidShape<T>;
    type Variant = Turned;
    type Seen<T: Copy> = SeenCuboid<T>;
    type Aim<L: Lanes> = Aim<L>;
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
    fn shape(&self, i: usize) -> CuboidShape<f32> {
        let [min, max] = map2(self.corners(i), Vec3::from);
        let axes = self.axes[i].unwrap_or([glam::Vec3::X, glam::Vec3::Y, glam::Vec3::Z]);
        CuboidShape { min, max, axes: map3(axes, Vec3::from), bounds: map2(self.boxes[i], Vec3::from) }
    }
    #[inline(always)]
    fn variant(&self, i: usize) -> Turned {
        Turned(self.axes[i].is_some())
    }
    #[inline(always)]
    fn zip<A: Number, B: Number, C: Number>(
        a: &CuboidShape<A>,
        b: &CuboidShape<B>,
        f: impl Fn(&A, &B) -> C,
    ) -> CuboidShape<C> {
        a.zip(b, f)
    }
    #[inline(always)]
    fn seen<L: Lanes>(cuboid: &CuboidShape<L>, turned: Turned, origin: Vec3<L>) -> SeenCuboid<L> {
        let CuboidShape { min, max, axes, .. } = *cuboid;
        if !turned.0 {
            return SeenCuboid { low: min - origin, high: max - origin, axes };
        }
        let half = (max - min) * L::splat(0.5);
        let q = along(&axes, origin - (min + max) * L::splat(0.5));
        SeenCuboid { low: -half - q, high: half - q, axes }
    }
    #[inline(always)]
    fn splat_seen<L: Lanes>(seen: &SeenCuboid<f32>) -> SeenCuboid<L> {
        seen.map(|number| L::splat(*number))
    }
    #[inline(always)]
    fn nearest<L: Lanes>(seen: &SeenCuboid<L>, turned: Turned, aim: &Aim<L>, t_min: L, t_max: L) -> LaneHits<L> {
        slabs(seen, turned, aim, t_min, t_max)
    }

    /// The face is the one whose share of the box's size the point is farthest out by, x before y before z.
    ///
    /// The point is kept off the other faces by more than it can be off itself: a ray that starts there from inside is
    /// still inside. Not turned, it lies exactly on its face, and the test sees exactly on which side of the face a
    /// ray starts: nothing is left to `reach`. Turned, with the half diagonal H, the point is off the face by
    /// √3 (4 ε H + ε M), and the test sees it off by 5 ε H more.
    #[inline(always)]
    fn surface<L: Lanes>(&self, i: usize, point: Vec3<L>) -> Surface<L> {
        let [q, half] = self.own(i, point);
        let out = Vec3::new(q.x.abs() / half.x, q.y.abs() / half.y, q.z.abs() / half.z);
        let on_x = out.x.ge(out.y) & out.x.ge(out.z);
        let on_y = !on_x & out.y.ge(out.z);
        let on = [on_x, on_y, !on_x & !on_y];
        let [center, size] = self.center_and_half(i);
        let [min, max] = self.corners(i);
        let most = min.abs().max(max.abs());
        let Some(axes) = self.axes[i] else {
            let margin = (most * (4.0 * ROUNDOFF)).min(size * 0.5);
            let within = point.max(Vec3::splat(min + margin)).min(Vec3::splat(max - margin));
            let face = face::by_sign(q, Vec3::splat(max), Vec3::splat(min));
            let normal = face::by_axis(on, face::signs(q), Vec3::splat(glam::Vec3::ZERO));
            return Surface { point: face::by_axis(on, face, within), normal, reach: 0.0 };
        };
        let reach = 2.0 * size.length();
        let margin = glam::Vec3::splat(ROUNDOFF * (8.0 * reach + 4.0 * most.max_element())).min(size * 0.5);
        let within = Vec3::splat(size - margin);
        let q_on = face::by_axis(on, face::by_sign(q, half, -half), q.max(-within).min(within));
        let [x, y, z] = map3(axes, Vec3::splat);
        let point = x.mul_add(q_on.x, y.mul_add(q_on.y, z * q_on.z)) + Vec3::splat(center);
        let sign = face::signs(q);
        let normal = (x * sign.x).select(on_x, (y * sign.y).select(on_y, z * sign.z));
        Surface { point, normal, reach }
    }
    #[inline(always)]
    fn footing<L: Lanes>(&self, _: usize, surface: &Surface<L>) -> Option<Footing<L>> {
        Some(Footing { point: surface.point, curvature: 0.0 })
    }
    #[inline(always)]
    fn uv<L: Lanes>(&self, i: usize, surface: &Surface<L>) -> [L; 2] {
        let [q, half] = self.own(i, surface.point);
        face::uv(Vec3::new(q.x / half.x, q.y / half.y, q.z / half.z), self.own_normal(i, surface))
    }
    #[inline(always)]
    fn mapping<L: Lanes>(&self, _: usize, _: &Surface<L>) -> Mapping<L> {
        Mapping::face()
    }
    #[inline(always)]
    fn checker<L: Lanes>(&self, i: usize, surface: &Surface<L>) -> Vec3<L> {
        face::along(self.own(i, surface.point)[0], self.own_normal(i, surface))
    }
}

/// See the module's text.
#[inline(always)]
pub fn slabs<L: Lanes>(seen: &SeenCuboid<L>, turned: Turned, aim: &Aim<L>, t_min: L, t_max: L) -> LaneHits<L> {
    let turned = turned.0.then(|| Aim::new(along(&seen.axes, aim.direction)));
    let (enter, exit) = face::between(seen.low, seen.high, turned.as_ref().unwrap_or(aim));
    let t = enter.select(enter.gt(t_min), exit);
    let inside = enter.le(exit) & t.gt(t_min) & t.lt(t_max);
    inside.any().then_some((t, inside))
}

#[cfg(test)]
mod tests;
