//! The cylinder |q − A (q·A)| = radius, 0 ≤ q·A ≤ length, with q = p − base and the unit axis A; open, or closed by a
//! disc at each end. Seen from outside and inside.
//!
//! One method, [`stable`], in the body's own axes T, B and A. With the origin's parts p across the axis and h along it,
//! and the direction's u·√a (u of unit length) and d_A, the ray meets the endless cylinder where
//! s² + 2 (p·u) s + |p|² − r² = 0, s = t √a: pbrt's quadratic (Pharr, Jakob, Humphreys, *Physically Based Rendering*,
//! 4th ed. 2023, §6.3.2), with three deviations:
//!
//! - the discriminant is r² − (p × u)², r² less the squared distance of the ray's line from the axis, which does not
//!   cancel for a distant origin (as [`super::sphere`] takes it after Ray Tracing Gems, ch. 7); from inside it is
//!   (p·u)² − c with c = |p|² − r² < 0, a sum, so that a ray from inside always leaves. The root that would cancel is
//!   c / q;
//! - a closed cylinder is the endless one within the slab between its ends (Cyrus and Beck 1978): the ray enters it at the
//!   later entry and leaves at the earlier exit, so there is no crack where side and end meet;
//! - a direction within 2⁻³⁰ = ε / 64 of the axis counts as parallel to it, and meets ends alone.
//!
//! Rounding acts as if the origin were moved by at most 8 ε (|o − base| + length + radius) and the direction turned by
//! at most 6 ε: t is off by that over cos θ at incidence θ, and hits differ only where such a ray's would. A ray that
//! leaves the surface hits nothing there; one that enters, the far side; one that runs along the side in parallel to the
//! axis, nothing. A tangent hits when the computed discriminant is not negative.

use super::axial::{self, Crossing, Hull, slab};
use super::numbers::numbers;
use super::{Balls, Bounded, Cull, LaneHits, Mapping, Never, Number, Primitives, Sides, Surface, columns};
use crate::math::{LaneMask, Lanes, Vec3, angle, map2, map3};

/// Squared sine of the angle to the axis below which a ray is parallel to it: 2⁻⁶⁰.
const PARALLEL: f32 = 1.0 / (1u64 << 60) as f32;

/// By how much of the origin's distance from the axis a ray must pass outside to be seen to miss before its direction is
/// normalised: 16 ε, of which rounding of the product takes 4.
const MARGIN: f32 = 1.0 / (1 << 20) as f32;

/// Cylinders, column by column.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Cylinders {
    /// The middles of the ends at height 0.
    pub base: [Vec<f32>; 3],
    /// The unit axes T, B and A.
    pub axes: Vec<[glam::Vec3; 3]>,
    /// Radii.
    pub radius: Vec<f32>,
    /// Lengths.
    pub length: Vec<f32>,
    /// Twice the distance from the base's middle to the other rim; see [`Surface::reach`].
    pub reach: Vec<f32>,
    /// Whether the ends are closed, and which side is there.
    pub hull: Vec<Hull>,
    /// Indices into the scene's materials.
    pub material: Vec<u32>,
    boxes: Vec<[glam::Vec3; 2]>,
    balls: Balls,
}

numbers! {
    /// A cylinder as stored.
    CylinderShape {
        /// The middle of the end at height 0.
        base: Vec3,
        /// T, B and A.
        axes: [Vec3; 3],
        /// Its radius.
        radius: T,
        /// Its length.
        length: T,
        /// The box around it.
        bounds: [Vec3; 2],
    }
    /// A cylinder as seen from the rays' origin.
    SeenCylinder {
        /// T, B and A.
        axes: [Vec3; 3],
        /// p: the origin's coordinates along T and B.
        p: [T; 2],
        /// c = |p|² − r²: below zero inside the endless cylinder.
        c: T,
        /// r.
        radius: T,
        /// r².
        r2: T,
        /// From the origin to the planes of base and apex, along A.
        ends: [T; 2],
    }
}

impl Cylinders {
    /// Adds a cylinder.
    pub fn push(&mut self, base: glam::Vec3, apex: glam::Vec3, radius: f32, caps: bool, sides: Sides, material: u32) {
        let (axes, length) = axial::axes(base, apex);
        columns::push(&mut self.base, base);
        self.axes.push(axes.map(|a| a.as_vec3()));
        self.radius.push(radius);
        self.length.push(length as f32);
        self.reach.push((2.0 * length.hypot(f64::from(radius))) as f32);
        self.hull.push(Hull { caps, sides });
        self.material.push(material);
        self.boxes.push(self.enclose(self.material.len() - 1));
        self.balls.push_around(self.bounds(self.material.len() - 1));
    }

    /// A box around cylinder `i`.
    #[inline]
    pub fn bounds(&self, i: usize) -> [glam::Vec3; 2] {
        self.boxes[i]
    }

    fn enclose(&self, i: usize) -> [glam::Vec3; 2] {
        self.piece(i, 0, 1)
    }

    /// The middle of cylinder `i`'s end at height 0.
    #[inline(always)]
    pub fn base(&self, i: usize) -> glam::Vec3 {
        columns::at(&self.base, i)
    }

    /// A point's coordinates along T, B and A of cylinder `i`, from its base.
    #[inline(always)]
    fn local<L: Lanes>(&self, i: usize, point: Vec3<L>) -> [L; 3] {
        let q = point - Vec3::splat(self.base(i));
        map3(self.axes[i], |a| Vec3::splat(a).dot(q))
    }

    /// Where a point with these coordinates is nearer to an end of cylinder `i` than to its side.
    #[inline(always)]
    fn on_cap<L: Lanes>(&self, i: usize, [x, y, h]: [L; 3]) -> L::Mask {
        if !self.hull[i].caps {
            return L::Mask::from_bits(0);
        }
        let to_side = (x.mul_add(x, y * y).sqrt() - L::splat(self.radius[i])).abs();
        h.abs().min((L::splat(self.length[i]) - h).abs()).lt(to_side)
    }
}

impl Bounded for Cylinders {
    /// Rounding acts as if the ray were moved, so that every hit lies next to the surface, if anywhere.
    const BOXED: bool = false;
    const COST: [f64; 2] = [4.0, 0.2];
    #[inline(always)]
    fn extent<L: Lanes>(cylinder: &CylinderShape<L>) -> [Vec3<L>; 2] {
        cylinder.bounds
    }
    #[inline(always)]
    fn around(&self, i: usize) -> [glam::Vec3; 2] {
        self.boxes[i]
    }
    fn pieces(&self, i: usize) -> u32 {
        axial::pieces(|k, n| self.piece(i, k, n))
    }
    fn piece(&self, i: usize, k: u32, n: u32) -> [glam::Vec3; 2] {
        let end = |k: u32| {
            let height = self.length[i] * (k as f32 / n as f32);
            (self.base(i) + self.axes[i][2] * height, self.radius[i])
        };
        axial::bounds(self.axes[i][2], [end(k), end(k + 1)], self.length[i] + self.radius[i])
    }
}

impl Primitives for Cylinders {
    type Shape<T: Number> = CylinderShape<T>;
    type Variant = Hull;
    type Seen<T: Copy> = SeenCylinder<T>;
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
    fn shape(&self, i: usize) -> CylinderShape<f32> {
        CylinderShape {
            base: self.base(i).into(),
            axes: map3(self.axes[i], Vec3::from),
            radius: self.radius[i],
            length: self.length[i],
            bounds: map2(self.boxes[i], Vec3::from),
        }
    }
    #[inline(always)]
    fn variant(&self, i: usize) -> Hull {
        self.hull[i]
    }
    #[inline(always)]
    fn zip<A: Number, B: Number, C: Number>(
        a: &CylinderShape<A>,
        b: &CylinderShape<B>,
        f: impl Fn(&A, &B) -> C,
    ) -> CylinderShape<C> {
        a.zip(b, f)
    }
    #[inline(always)]
    fn seen<L: Lanes>(cylinder: &CylinderShape<L>, _: Hull, origin: Vec3<L>) -> SeenCylinder<L> {
        let CylinderShape { base, axes, radius, length, .. } = *cylinder;
        let f = origin - base;
        let [x, y, h] = map3(axes, |a| a.dot(f));
        let r2 = radius * radius;
        let c = x.mul_add(x, y * y) - r2;
        SeenCylinder { axes, p: [x, y], c, radius, r2, ends: [-h, length - h] }
    }
    #[inline(always)]
    fn splat_seen<L: Lanes>(seen: &SeenCylinder<f32>) -> SeenCylinder<L> {
        seen.map(|number| L::splat(*number))
    }
    #[inline(always)]
    fn nearest<L: Lanes>(seen: &SeenCylinder<L>, hull: Hull, d: &Vec3<L>, t_min: L, t_max: L) -> LaneHits<L> {
        stable(seen, *d, hull, t_min, t_max)
    }

    #[inline(always)]
    fn surface<L: Lanes>(&self, i: usize, point: Vec3<L>) -> Surface<L> {
        let [x, y, h] = self.local(i, point);
        let [t, b, axis] = map3(self.axes[i], Vec3::splat);
        let rho = x.mul_add(x, y * y).sqrt();
        // On the axis itself, where rounding is as large as the radius, any direction is as good.
        let radial = b.mul_add(y / rho, t * (x / rho)).select(rho.gt(L::zero()), t);
        let length = L::splat(self.length[i]);
        let upper = (h + h).gt(length);
        let cap = self.on_cap(i, [x, y, h]);
        let normal = axis.select(upper, -axis).select(cap, radial);
        let height = (h - length).select(upper, -h).select(cap, rho - L::splat(self.radius[i]));
        Surface { point: normal.mul_add(-height, point), normal, reach: self.reach[i] }
    }
    #[inline(always)]
    fn uv<L: Lanes>(&self, i: usize, surface: &Surface<L>) -> [L; 2] {
        let [x, y, h] = self.local(i, surface.point);
        let cap = self.on_cap(i, [x, y, h]);
        let (half, across) = (L::splat(0.5), L::splat(0.5 / self.radius[i]));
        let side = [angle::turn(x, y), h * L::splat(1.0 / self.length[i])];
        [x.mul_add(across, half).select(cap, side[0]), y.mul_add(across, half).select(cap, side[1])]
    }
    #[inline(always)]
    fn mapping<L: Lanes>(&self, i: usize, surface: &Surface<L>) -> Mapping<L> {
        Mapping::around([false; 2]).capped(self.on_cap(i, self.local(i, surface.point)))
    }
    #[inline(always)]
    fn checker<L: Lanes>(&self, i: usize, surface: &Surface<L>) -> Vec3<L> {
        let [x, y, h] = self.local(i, surface.point);
        Vec3::new(x, y, L::zero().select(self.on_cap(i, [x, y, h]), h))
    }
}

/// See the module's text.
#[inline(always)]
pub fn stable<L: Lanes>(seen: &SeenCylinder<L>, direction: Vec3<L>, hull: Hull, t_min: L, t_max: L) -> LaneHits<L> {
    let SeenCylinder { axes, p: [px, py], c, radius, r2, ends: [low, high] } = *seen;
    let [x, y, along] = map3(axes, |a| a.dot(direction));
    let a = x.mul_add(x, y * y);
    // Most rays pass so far outside that no root and no quotient is needed to see it, whatever rounding does.
    let aside = py.neg_mul_add(x, px * y);
    let reach = (px.abs() + py.abs()).mul_add(L::splat(MARGIN), radius);
    let beside = c.ge(L::zero()) & (aside * aside).gt(a * (reach * reach));
    if beside.all() {
        return None;
    }
    let per_length = L::splat(1.0) / a.sqrt();
    let (x, y) = (x * per_length, y * per_length);
    let parallel = a.lt(L::splat(PARALLEL));
    let inside = c.lt(L::zero());
    let b = px.mul_add(x, py * y);
    // How far the ray's line passes from the axis: this does not cancel as b² − c does.
    let apart = py.neg_mul_add(x, px * y);
    let discriminant = b.mul_add(b, -c).select(inside, apart.neg_mul_add(apart, r2));
    let ahead = b.lt(L::zero());
    // From outside and moving away, both roots are at most zero.
    let possible = parallel & inside | !parallel & (ahead | inside) & discriminant.ge(L::zero());
    if !possible.any() {
        return None;
    }
    let root = discriminant.sqrt();
    let q = (root - b).select(ahead, -(b + root));
    let other = c / q;
    let far = L::splat(f32::INFINITY);
    let enter = (-far).select(parallel, other.select(ahead, q) * per_length);
    let exit = far.select(parallel, q.select(ahead, other) * per_length);
    let (start, end) = slab(low, high, along);
    let crossing = if hull.caps {
        let (enter, exit) = (enter.max(start), exit.min(end));
        let met = possible & enter.le(exit);
        Crossing { enter, exit, entered: met, left: met }
    } else {
        let between = |t: L| possible & t.ge(start) & t.le(end);
        Crossing { enter, exit, entered: between(enter), left: between(exit) }
    };
    crossing.nearest(hull.sides, t_min, t_max)
}

#[cfg(test)]
#[path = "cylinder_tests.rs"]
mod tests;
