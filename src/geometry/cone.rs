//! The cone or frustum |q − A (q·A)| = R(h) at the heights h = q·A from 0 to length, with R linear; open, or closed by
//! a disc at each end that has a radius. Seen from outside and inside.
//!
//! Here q and A run from the narrow end, so that a tip is the origin of all coordinates and keeps its full precision.
//! With the half-angle α, lengths in units of a power of two near the size, and every point as P = (q·T cos α,
//! q·B cos α, R(h) cos α), the endless cone is ⟨P, P⟩ = 0 under ⟨P, Q⟩ = P₁Q₁ + P₂Q₂ − P₃Q₃, without a slope that could
//! be infinite (Schneider and Eberly, *Geometric Tools for Computer Graphics*, 2003, §11.3.5, in other words). A ray
//! P + t Q meets it where a t² + 2 b t + c = 0, a = ⟨Q, Q⟩, b = ⟨P, Q⟩, c = ⟨P, P⟩.
//!
//! One method, [`stable`], with four deviations:
//!
//! - the discriminant b² − a c is taken as (P₃Q₁ − P₁Q₃)² + (P₃Q₂ − P₂Q₃)² − (P₁Q₂ − P₂Q₁)², Lagrange's identity
//!   under this product, whose terms are as small as the ray passes close to the tip; inside, where all terms have one
//!   sign, as b² − a c. The root that would cancel is c / q;
//! - a ray nearly parallel to the slant (a ≈ 0) cancels in a and b nevertheless: a root much closer to the tip than the
//!   origin is solved for again from where it is;
//! - which of the roots enters the solid cone on this side of the tip is told by the signs of a and Q₃, not by where
//!   they are. A closed body is that cone within the slab between its ends, as in [`super::cylinder`], and the wide disc
//!   belongs to it whatever the roots say: its rim is sharp, and a flat cone's side as close to it as rounding;
//! - on an open cone, the height says whether a root lies between the ends, or for a ray steeper than the slant the
//!   radius: each changes less than the other along such a ray, so that an error in t matters less.
//!
//! Rounding acts as if the origin were moved by at most 12 ε (|o − narrow end| + length + radius) and the direction
//! turned by at most 8 ε: t is off by that over cos θ at incidence θ, and hits differ only where such a ray's would. A
//! cone flatter than 2⁻⁴⁰ of its radius is as high as that. What leaves the surface hits nothing there.

use super::axial::{self, Crossing, Hull, slab};
use super::numbers::numbers;
use super::{Balls, Bounded, Cull, LaneHits, Mapping, Never, Number, Primitives, Sides, Surface, columns};
use crate::math::{LaneMask, Lanes, Vec3, angle, map2, map3};

/// The least height, in differences of the radii: far below ε, and its square a normal number.
const FLATTEST: f64 = 1.0 / (1u64 << 40) as f64;

/// Cones, column by column.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Cones {
    /// The middles of the narrow ends.
    pub narrow: [Vec<f32>; 3],
    /// The unit axes T and B of the description, and A from the narrow to the wide end.
    pub axes: Vec<[glam::Vec3; 3]>,
    /// The radii of the narrow and the wide ends.
    pub radii: Vec<[f32; 2]>,
    /// Lengths.
    pub length: Vec<f32>,
    /// The test's numbers, made of these.
    pub numbers: Vec<ConeNumbers<f32>>,
    /// Whether the narrow end is the apex of the description, so that heights count from the wide one.
    pub upright: Vec<bool>,
    /// 2½ times the distance from the narrow end's middle to the wide rim; see [`Surface::reach`].
    pub reach: Vec<f32>,
    /// Whether the ends are closed, and which side is there.
    pub hull: Vec<Hull>,
    /// Indices into the scene's materials.
    pub material: Vec<u32>,
    boxes: Vec<[glam::Vec3; 2]>,
    balls: Balls,
}

numbers! {
    /// A cone's numbers, lengths in the cone's own unit unless said otherwise.
    ConeNumbers {
        /// T cos α, B cos α.
        across: [Vec3; 2],
        /// cos α and sin α of the half-angle α.
        turn: [T; 2],
        /// The radii of the narrow and the wide end, times cos α.
        radii: [T; 2],
        /// The length.
        length: T,
        /// Units in a world unit, a power of two.
        scale: T,
        /// World units in a unit.
        unit: T,
    }
    /// A cone as stored.
    ConeShape {
        /// The middle of the narrow end, in world units.
        narrow: Vec3,
        /// T cos α, B cos α and A.
        axes: [Vec3; 3],
        /// cos α and sin α of the half-angle α.
        turn: [T; 2],
        /// The radii of the narrow and the wide end, times cos α, in the cone's unit.
        radii: [T; 2],
        /// The length, in the cone's unit.
        length: T,
        /// Units in a world unit, a power of two.
        scale: T,
        /// World units in a unit.
        unit: T,
        /// The box around it.
        bounds: [Vec3; 2],
    }
    /// A cone as seen from the rays' origin, in the cone's unit.
    SeenCone {
        /// T cos α, B cos α and A.
        axes: [Vec3; 3],
        /// The origin's P.
        p: [T; 3],
        /// c = ⟨P, P⟩: below zero inside the cone, and inside its mirror image beyond the tip.
        c: T,
        /// From the origin to the planes of the narrow and the wide end, along A.
        ends: [T; 2],
        /// sin α.
        sin: T,
        /// The radii of the narrow and the wide end, times cos α.
        radii: [T; 2],
        /// World units in a unit.
        unit: T,
    }
}

impl Cones {
    /// Adds a cone.
    pub fn push(
        &mut self,
        [base, apex]: [glam::Vec3; 2],
        [base_radius, apex_radius]: [f32; 2],
        caps: bool,
        sides: Sides,
        material: u32,
    ) {
        let ([t, b, axis], length) = axial::axes(base, apex);
        let upright = apex_radius < base_radius;
        let (narrow, radii, axis) =
            if upright { (apex, [apex_radius, base_radius], -axis) } else { (base, [base_radius, apex_radius], axis) };
        let [inner, outer] = radii.map(f64::from);
        let length = length.max((outer - inner) * FLATTEST);
        let slant = length.hypot(outer - inner);
        let (cos, sin) = (length / slant, (outer - inner) / slant);
        let scale = 2f64.powi(-length.max(outer).log2().floor() as i32);
        columns::push(&mut self.narrow, narrow);
        self.axes.push([t, b, axis].map(|a| a.as_vec3()));
        self.radii.push(radii);
        self.length.push(length as f32);
        self.numbers.push(ConeNumbers {
            across: [t, b].map(|a| (a * cos).as_vec3().into()),
            turn: [cos as f32, sin as f32],
            radii: [inner, outer].map(|r| (r * scale * cos) as f32),
            length: (length * scale) as f32,
            scale: scale as f32,
            unit: (1.0 / scale) as f32,
        });
        self.upright.push(upright);
        self.reach.push((2.5 * length.hypot(outer)) as f32);
        self.hull.push(Hull { caps, sides });
        self.material.push(material);
        self.boxes.push(self.enclose(self.material.len() - 1));
        self.balls.push_around(self.bounds(self.material.len() - 1));
    }

    /// A box around cone `i`.
    #[inline]
    pub fn bounds(&self, i: usize) -> [glam::Vec3; 2] {
        self.boxes[i]
    }

    fn enclose(&self, i: usize) -> [glam::Vec3; 2] {
        self.piece(i, 0, 1)
    }

    /// The middle of cone `i`'s narrow end.
    #[inline(always)]
    pub fn narrow(&self, i: usize) -> glam::Vec3 {
        columns::at(&self.narrow, i)
    }

    /// A point relative to cone `i`.
    #[inline(always)]
    fn local<L: Lanes>(&self, i: usize, point: Vec3<L>) -> Local<L> {
        let q = point - Vec3::splat(self.narrow(i));
        let [x, y, h] = map3(self.axes[i], |a| Vec3::splat(a).dot(q));
        let rho = x.mul_add(x, y * y).sqrt();
        let [cos, sin] = self.numbers[i].turn;
        let inner = L::splat(self.numbers[i].radii[0] * self.numbers[i].unit);
        let outside = rho.mul_add(L::splat(cos), -h.mul_add(L::splat(sin), inner));
        let beyond = h - L::splat(self.length[i]);
        let wide = beyond.abs().lt(h.abs());
        let [narrow, _] = self.radii[i];
        let mut cap = L::Mask::from_bits(0);
        if self.hull[i].caps {
            // A tip has no disc.
            let nearest = if narrow > 0.0 { h.abs().min(beyond.abs()) } else { beyond.abs() };
            cap = nearest.lt(outside.abs()) & (wide | L::splat(narrow).gt(L::zero()));
        }
        Local { x, y, h, rho, outside, beyond, cap, wide }
    }

    /// The description's height above the base, of a height above the narrow end.
    #[inline(always)]
    fn height<L: Lanes>(&self, i: usize, h: L) -> L {
        if self.upright[i] { L::splat(self.length[i]) - h } else { h }
    }
}

/// A point relative to a cone.
#[derive(Clone, Copy, Debug)]
struct Local<L: Lanes> {
    /// Coordinates along T, B and A, from the narrow end.
    x: L,
    y: L,
    h: L,
    /// The distance from the axis.
    rho: L,
    /// The distance from the side, above zero outside.
    outside: L,
    /// The height above the wide end.
    beyond: L,
    /// Whether an end is nearer than the side.
    cap: L::Mask,
    /// Whether the wide end is nearer than the narrow one.
    wide: L::Mask,
}

impl Bounded for Cones {
    /// Rounding acts as if the ray were moved, so that every hit lies next to the surface, if anywhere.
    const BOXED: bool = false;
    const COST: [f64; 2] = [4.0, 0.2];
    #[inline(always)]
    fn extent<L: Lanes>(cone: &ConeShape<L>) -> [Vec3<L>; 2] {
        cone.bounds
    }
    #[inline(always)]
    fn around(&self, i: usize) -> [glam::Vec3; 2] {
        self.boxes[i]
    }
    fn pieces(&self, i: usize) -> u32 {
        axial::pieces(|k, n| self.piece(i, k, n))
    }
    fn piece(&self, i: usize, k: u32, n: u32) -> [glam::Vec3; 2] {
        let ([narrow, axis], [inner, outer]) = ([self.narrow(i), self.axes[i][2]], self.radii[i]);
        let end = |k: u32| {
            let part = k as f32 / n as f32;
            (narrow + axis * (self.length[i] * part), inner * (1.0 - part) + outer * part)
        };
        axial::bounds(axis, [end(k), end(k + 1)], self.length[i] + inner.max(outer))
    }
}

impl Primitives for Cones {
    type Shape<T: Number> = ConeShape<T>;
    type Variant = Hull;
    type Seen<T: Copy> = SeenCone<T>;
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
    fn shape(&self, i: usize) -> ConeShape<f32> {
        let ConeNumbers { across: [t, b], turn, radii, length, scale, unit } = self.numbers[i];
        let (narrow, axes) = (self.narrow(i).into(), [t, b, self.axes[i][2].into()]);
        ConeShape { narrow, axes, turn, radii, length, scale, unit, bounds: map2(self.boxes[i], Vec3::from) }
    }
    #[inline(always)]
    fn variant(&self, i: usize) -> Hull {
        self.hull[i]
    }
    #[inline(always)]
    fn zip<A: Number, B: Number, C: Number>(
        a: &ConeShape<A>,
        b: &ConeShape<B>,
        f: impl Fn(&A, &B) -> C,
    ) -> ConeShape<C> {
        a.zip(b, f)
    }
    #[inline(always)]
    fn seen<L: Lanes>(cone: &ConeShape<L>, _: Hull, origin: Vec3<L>) -> SeenCone<L> {
        let ConeShape { narrow, axes, turn: [_, sin], radii, length, scale, unit, .. } = *cone;
        let f = (origin - narrow) * scale;
        let [x, y, h] = map3(axes, |a| a.dot(f));
        let z = h.mul_add(sin, radii[0]);
        // Not fused: what is rounded alike cancels on the surface.
        let c = x * x + y * y - z * z;
        SeenCone { axes, p: [x, y, z], c, ends: [-h, length - h], sin, radii, unit }
    }
    #[inline(always)]
    fn splat_seen<L: Lanes>(seen: &SeenCone<f32>) -> SeenCone<L> {
        seen.map(|number| L::splat(*number))
    }
    #[inline(always)]
    fn nearest<L: Lanes>(seen: &SeenCone<L>, hull: Hull, d: &Vec3<L>, t_min: L, t_max: L) -> LaneHits<L> {
        stable(seen, *d, hull, t_min, t_max)
    }

    #[inline(always)]
    fn surface<L: Lanes>(&self, i: usize, point: Vec3<L>) -> Surface<L> {
        let Local { x, y, h, rho, outside, beyond, cap, wide } = self.local(i, point);
        let [t, b, axis] = map3(self.axes[i], Vec3::splat);
        let [cos, sin] = map2(self.numbers[i].turn, L::splat);
        // At the tip any direction is as good.
        let radial = b.mul_add(y / rho, t * (x / rho)).select(rho.gt(L::zero()), t);
        let side = axis.mul_add(-sin, radial * cos);
        let normal = axis.select(wide, -axis).select(cap, side);
        let height = beyond.select(wide, -h).select(cap, outside);
        Surface { point: normal.mul_add(-height, point), normal, reach: self.reach[i] }
    }
    #[inline(always)]
    fn uv<L: Lanes>(&self, i: usize, surface: &Surface<L>) -> [L; 2] {
        let Local { x, y, h, cap, wide, .. } = self.local(i, surface.point);
        let [narrow, outer] = map2(self.radii[i], |r| L::splat(0.5 / r));
        let (half, across) = (L::splat(0.5), outer.select(wide, narrow));
        let side = [angle::turn(x, y), self.height(i, h) * L::splat(1.0 / self.length[i])];
        [x.mul_add(across, half).select(cap, side[0]), y.mul_add(across, half).select(cap, side[1])]
    }
    #[inline(always)]
    fn mapping<L: Lanes>(&self, i: usize, surface: &Surface<L>) -> Mapping<L> {
        let (tip, upright) = (self.radii[i][0] == 0.0, self.upright[i]);
        Mapping::around([tip & !upright, tip & upright]).capped(self.local(i, surface.point).cap)
    }
    #[inline(always)]
    fn checker<L: Lanes>(&self, i: usize, surface: &Surface<L>) -> Vec3<L> {
        let Local { x, y, h, cap, .. } = self.local(i, surface.point);
        Vec3::new(x, y, L::zero().select(cap, self.height(i, h)))
    }
}

/// ⟨P, Q⟩ of the module's text.
#[inline(always)]
fn product<L: Lanes>(p: [L; 3], q: [L; 3]) -> L {
    p[2].neg_mul_add(q[2], p[0].mul_add(q[0], p[1] * q[1]))
}

/// A ray in a cone's coordinates: P, Q, and the coefficients of its quadratic.
#[derive(Clone, Copy, Debug)]
struct Line<L> {
    p: [L; 3],
    q: [L; 3],
    a: L,
    b: L,
    c: L,
}

impl<L: Lanes> Line<L> {
    /// The discriminant b² − a c; below zero or NaN where the line misses the cone.
    #[inline(always)]
    fn discriminant(&self) -> L {
        let outside = expanded(self.p, self.q);
        // Steeper than the slant, every line meets the cone.
        let steep = self.a.lt(L::zero());
        let outside = L::zero().select(steep & outside.lt(L::zero()), outside);
        let inside = !steep & self.c.lt(L::zero());
        self.a.neg_mul_add(self.c, self.b * self.b).select(inside, outside)
    }

    /// Both roots, the lesser first.
    #[inline(always)]
    fn roots(&self, root: L) -> (L, L) {
        let ahead = self.b.lt(L::zero());
        let q = (root - self.b).select(ahead, -(self.b + root));
        // From the tip itself all is zero, and both roots are.
        let other = (self.c / q).select(!q.eq(L::zero()), L::zero());
        let [first, second] = [self.refined(q / self.a, ahead), self.refined(other, !ahead)];
        (first.min(second), first.max(second))
    }

    /// The root at `t`, solved for again from there, twice at most, where that is a quarter as far from the tip or less.
    /// `leaving` says at which of the two roots ⟨P, P⟩ grows.
    #[inline(always)]
    fn refined(&self, t: L, leaving: L::Mask) -> L {
        let size = |[x, y, z]: [L; 3]| x.mul_add(x, y.mul_add(y, z * z));
        let (mut t, mut last) = (t, size(self.p));
        // The first root may be off by some parts in a hundred, the second by as much of that.
        for _ in 0..2 {
            let p = map3([0, 1, 2], |k| self.q[k].mul_add(t, self.p[k]));
            let near = (size(p) * L::splat(16.0)).lt(last);
            if !near.any() {
                break;
            }
            // All of it anew from this point, so that it belongs to one line.
            let (b, c) = (product(p, self.q), product(p, p));
            let root = expanded(p, self.q).max(L::zero()).sqrt();
            let slope = root.select(leaving, -root);
            // Of the two forms of the root the one with the smaller error: that of b is ε |P| |Q| over a, that of c is
            // ε |P|² over b + slope, which does not cancel where both have one sign.
            let sum = b + slope;
            let by_c = (b * slope).gt(L::zero()) & (self.a * self.a * size(p)).lt(sum * sum * size(self.q));
            let step = (-c / sum).select(by_c, (slope - b) / self.a);
            let sound = near & step.abs().lt(L::splat(f32::INFINITY));
            t = (t + step).select(sound, t);
            last = size(p).select(near, last);
        }
        t
    }
}

/// ⟨P, Q⟩² − ⟨P, P⟩⟨Q, Q⟩ as the module's text expands it.
#[inline(always)]
fn expanded<L: Lanes>([px, py, pz]: [L; 3], [qx, qy, qz]: [L; 3]) -> L {
    let (x, y) = (px.neg_mul_add(qz, pz * qx), py.neg_mul_add(qz, pz * qy));
    let apart = py.neg_mul_add(qx, px * qy);
    apart.neg_mul_add(apart, x.mul_add(x, y * y))
}

/// See the module's text.
#[inline(always)]
pub fn stable<L: Lanes>(seen: &SeenCone<L>, direction: Vec3<L>, hull: Hull, t_min: L, t_max: L) -> LaneHits<L> {
    let [x, y, along] = map3(seen.axes, |a| a.dot(direction));
    let (p, q) = (seen.p, [x, y, along * seen.sin]);
    let line = Line { p, q, a: product(q, q), b: product(p, q), c: seen.c };
    let discriminant = line.discriminant();
    let possible = discriminant.ge(L::zero());
    if !possible.any() {
        return None;
    }
    let (least, most) = line.roots(discriminant.sqrt());
    // Steeper than the slant, one root is the mirror image's, and the cone has no end on the other side.
    let steep = line.a.lt(L::zero());
    let opening = q[2].gt(L::zero());
    let far = L::splat(f32::INFINITY);
    let enter = most.select(opening, -far).select(steep, least);
    let exit = far.select(opening, least).select(steep, most);
    // From inside the ray has entered already, and is yet to leave.
    let inside = seen.c.lt(L::zero()) & p[2].gt(L::zero());
    let enter = enter.min(L::zero()).select(inside, enter);
    let exit = exit.max(L::zero()).select(inside, exit);
    let [low, high] = seen.ends;
    let (start, end) = slab(low, high, along);
    // The squared distance from the axis, in units of cos α.
    let away = |t: L| {
        let (x, y) = (q[0].mul_add(t, p[0]), q[1].mul_add(t, p[1]));
        x.mul_add(x, y * y)
    };
    let [inner, outer] = seen.radii;
    let (inner2, outer2) = (inner * inner, outer * outer);
    let mut crossing = if hull.caps {
        let (enter, exit) = (enter.max(start), exit.min(end));
        let wide = high / along;
        let disc = away(wide).le(outer2);
        let (enter, exit) = (wide.min(enter).select(disc, enter), wide.max(exit).select(disc, exit));
        let met = possible & enter.le(exit);
        Crossing { enter, exit, entered: met, left: met }
    } else {
        let between = |t: L| {
            let away = away(t);
            let by_radius = steep & away.ge(inner2) & away.le(outer2);
            possible & (by_radius | !steep & t.ge(start) & t.le(end))
        };
        let (entered, left) = (between(enter), between(exit));
        // Along the slant all is rounding, and a root of the right radius may seem to lie beyond the ends.
        let held = |t: L| t.max(start).min(end).select(steep, t);
        Crossing { enter: held(enter), exit: held(exit), entered, left }
    };
    (crossing.enter, crossing.exit) = (crossing.enter * seen.unit, crossing.exit * seen.unit);
    crossing.nearest(hull.sides, t_min, t_max)
}

#[cfg(test)]
#[path = "cone_tests.rs"]
mod tests;
