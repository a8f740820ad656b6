//! The disc of the points with q·n = 0 and inner radius ≤ |q| ≤ radius, with q = p − center and the unit normal n; seen
//! from both sides.
//!
//! One method, [`planar`]: the ray meets the plane at t = −(f·n) / (d·n) with f = o − center (Haines, *Essential Ray
//! Tracing Algorithms*, in Glassner, *An Introduction to Ray Tracing*, 1989, ch. 2), and there |q|² is compared with
//! the squares of both radii, as in pbrt (Pharr, Jakob, Humphreys, *Physically Based Rendering*, 4th ed. 2023, §6.4.2),
//! but in the world's axes: q = f + t d lies in the plane, so that its length is the distance from the middle. Taken
//! relative to the centre, it is as good for a distant disc as the ray is.
//!
//! With e = |o − center|, f is off by ε e, its height by 3 ε e, the slope by 3 ε, the quotient by ε t, and n by ε,
//! which at the rim is ε radius; t ≤ e + radius. So the plane is missed by at most 8 ε (e + radius), and t is off by
//! that over cos θ at incidence θ. However large that is: t is exact for a ray whose origin is moved along n and whose
//! direction is turned towards n, and across n such a ray's q is the same. What q then has along n, at most
//! 8 ε (e + radius), makes |q| longer by no more. q itself rounds by ε (t + |q|), its square and those of the radii by
//! another 2 ε |q|. In all, rounding acts as if the origin were moved by at most 10 ε (e + radius) and the direction
//! turned by at most 3 ε, and hits differ only where such a ray's would.
//!
//! Edges belong to the disc, those of the hole too. A ray in its plane misses it; so does one that starts on it.

use super::numbers::numbers;
use super::{
    Balls, Bounded, Cull, Footing, LaneHits, Mapping, Never, Number, Primitives, Surface, axial, columns, flat,
};
use crate::math::{LaneMask, Lanes, Vec3, angle, map2, map3};
use glam::DVec3;

/// Discs, column by column.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Discs {
    /// The middles.
    pub center: [Vec<f32>; 3],
    /// The unit axes T, B and the normal.
    pub axes: Vec<[glam::Vec3; 3]>,
    /// Radii.
    pub radius: Vec<f32>,
    /// Radii of the holes; 0 where there is none.
    pub inner: Vec<f32>,
    /// Indices into the scene's materials.
    pub material: Vec<u32>,
    boxes: Vec<[glam::Vec3; 2]>,
    balls: Balls,
}

numbers! {
    /// A disc as stored.
    DiscShape {
        /// Its middle.
        center: Vec3,
        /// Its unit normal.
        normal: Vec3,
        /// The squares of the hole's radius and of its own.
        squares: [T; 2],
        /// The box around it.
        bounds: [Vec3; 2],
    }
    /// What a disc's test needs of it and of the rays' origin.
    SeenDisc {
        /// f = o − center.
        f: Vec3,
        /// Its unit normal.
        normal: Vec3,
        /// −f·n.
        height: T,
        /// The squares of the hole's radius and of its own.
        squares: [T; 2],
    }
}

impl Discs {
    /// Adds a disc. The normal may have any length but zero; without a hole `inner` is 0.
    pub fn push(&mut self, center: glam::Vec3, normal: glam::Vec3, radius: f32, inner: f32, material: u32) {
        let (axes, _) = axial::axes(glam::Vec3::ZERO, normal);
        columns::push(&mut self.center, center);
        self.axes.push(axes.map(|a| a.as_vec3()));
        self.radius.push(radius);
        self.inner.push(inner);
        self.material.push(material);
        self.boxes.push(enclose(center.as_dvec3(), axes[2], radius.into()));
        self.balls.push(center, radius * (1.0 + 2.0 * f32::EPSILON));
    }

    /// A box around disc `i`.
    #[inline]
    pub fn bounds(&self, i: usize) -> [glam::Vec3; 2] {
        self.boxes[i]
    }

    /// The middle of disc `i`.
    #[inline(always)]
    pub fn center(&self, i: usize) -> glam::Vec3 {
        columns::at(&self.center, i)
    }

    /// The coordinates of a point of disc `i` along T and B, from its middle.
    #[inline(always)]
    fn local<L: Lanes>(&self, i: usize, point: Vec3<L>) -> [L; 2] {
        let q = point - Vec3::splat(self.center(i));
        let [t, b, _] = map3(self.axes[i], Vec3::splat);
        [t.dot(q), b.dot(q)]
    }
}

/// The box around a disc with this unit normal, rounded outward.
fn enclose(center: DVec3, n: DVec3, radius: f64) -> [glam::Vec3; 2] {
    // √(1 − n²) a component, without cancelling.
    let half = DVec3::new(n.y.hypot(n.z), n.z.hypot(n.x), n.x.hypot(n.y)) * radius;
    let (low, high) = (center - half, center + half);
    // Twice what the corners round by.
    let slack = f64::from(f32::EPSILON) * low.abs().max(high.abs()).max_element();
    [(low - slack).as_vec3(), (high + slack).as_vec3()]
}

impl Bounded for Discs {
    /// A flat ray's distance may be off by any number of ε.
    const BOXED: bool = true;
    const COST: [f64; 2] = [2.0, 0.3];
    #[inline(always)]
    fn extent<L: Lanes>(disc: &DiscShape<L>) -> [Vec3<L>; 2] {
        disc.bounds
    }
    #[inline(always)]
    fn around(&self, i: usize) -> [glam::Vec3; 2] {
        self.boxes[i]
    }
}

impl Primitives for Discs {
    type Shape<T: Number> = DiscShape<T>;
    type Variant = ();
    type Seen<T: Copy> = SeenDisc<T>;
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
    fn shape(&self, i: usize) -> DiscShape<f32> {
        let (inner, radius) = (self.inner[i], self.radius[i]);
        DiscShape {
            center: self.center(i).into(),
            normal: self.axes[i][2].into(),
            squares: [inner * inner, radius * radius],
            bounds: map2(self.boxes[i], Vec3::from),
        }
    }
    #[inline]
    fn variant(&self, _: usize) {}
    #[inline(always)]
    fn zip<A: Number, B: Number, C: Number>(
        a: &DiscShape<A>,
        b: &DiscShape<B>,
        f: impl Fn(&A, &B) -> C,
    ) -> DiscShape<C> {
        a.zip(b, f)
    }
    #[inline(always)]
    fn seen<L: Lanes>(disc: &DiscShape<L>, (): (), origin: Vec3<L>) -> SeenDisc<L> {
        let DiscShape { center, normal, squares, .. } = *disc;
        let f = origin - center;
        SeenDisc { f, normal, height: -f.dot(normal), squares }
    }
    #[inline(always)]
    fn splat_seen<L: Lanes>(seen: &SeenDisc<f32>) -> SeenDisc<L> {
        seen.map(|number| L::splat(*number))
    }
    #[inline(always)]
    fn nearest<L: Lanes>(seen: &SeenDisc<L>, (): (), d: &Vec3<L>, t_min: L, t_max: L) -> LaneHits<L> {
        planar(seen, *d, t_min, t_max)
    }

    /// A reach of a radius is what the test's rounding asks for; of two, as shadow rays come from far away.
    #[inline(always)]
    fn surface<L: Lanes>(&self, i: usize, point: Vec3<L>) -> Surface<L> {
        flat::surface(self.axes[i][2], self.center(i), 2.0 * self.radius[i], point)
    }
    #[inline(always)]
    fn footing<L: Lanes>(&self, i: usize, surface: &Surface<L>) -> Option<Footing<L>> {
        (self.inner[i] == 0.0).then(|| flat::footing(self.center(i), self.radius[i], surface))
    }
    #[inline(always)]
    fn uv<L: Lanes>(&self, i: usize, surface: &Surface<L>) -> [L; 2] {
        let [x, y] = self.local(i, surface.point);
        let (inner, radius) = (self.inner[i], self.radius[i]);
        let outward = x.mul_add(x, y * y).sqrt() - L::splat(inner);
        [angle::turn(x, y), outward * L::splat(1.0 / (radius - inner))]
    }
    #[inline(always)]
    fn mapping<L: Lanes>(&self, i: usize, _: &Surface<L>) -> Mapping<L> {
        Mapping::around([self.inner[i] == 0.0, false])
    }
    #[inline(always)]
    fn checker<L: Lanes>(&self, i: usize, surface: &Surface<L>) -> Vec3<L> {
        let [x, y] = self.local(i, surface.point);
        Vec3::new(x, y, L::zero())
    }
}

/// See the module's text.
#[inline(always)]
pub fn planar<L: Lanes>(seen: &SeenDisc<L>, direction: Vec3<L>, t_min: L, t_max: L) -> LaneHits<L> {
    let SeenDisc { f, normal, height, squares: [inner, outer] } = *seen;
    // In the plane, infinite or NaN.
    let t = height / normal.dot(direction);
    let inside = t.gt(t_min) & t.lt(t_max);
    if !inside.any() {
        return None;
    }
    let q = direction.mul_add(t, f);
    let square = q.dot(q);
    let inside = inside & inner.le(square) & square.le(outer);
    inside.any().then_some((t, inside))
}

#[cfg(test)]
#[path = "disc_tests.rs"]
mod tests;
