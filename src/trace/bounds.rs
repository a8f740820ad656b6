//! Bounds of all rays of a batch: boxes around their origins and directions, and a ball and a cone around those.

use crate::geometry::triangle::normal;
use crate::geometry::{Balls, Planes, Primitives, Triangles};
use crate::math::{LaneMask, Lanes, RayBatch, Vec3, map3};

/// Bounds of the active rays of a batch.
#[derive(Clone, Copy, Debug)]
pub struct Bounds {
    /// A box around the origins.
    pub origin: Span,
    /// A box around the directions.
    pub direction: Span,
    /// Whether all rays share one origin.
    pub shared: bool,
    /// Radius of a ball around the origins.
    pub spread: f32,
    /// The cone that holds all directions, if they are within a half-space with room to spare.
    pub cone: Option<Cone>,
}

/// Sides of flat primitives.
impl Bounds {
    /// Whether no ray of the batch meets plane `i`: all start on one side of it and none turns to the other.
    #[inline(always)]
    pub fn miss_plane(&self, planes: &Planes, i: usize) -> bool {
        let normal = Vec3::from(planes.normal(i));
        let height = Planes::seen(&planes.shape(i), (), self.origin.middle).height;
        self.turn_away(normal, height, planes.distance[i].abs(), 0.0)
    }

    /// Whether no ray of the batch meets triangle `i`: all turn away from its plane, or, where they share their
    /// origin, pass the same edge on the outside.
    #[inline(always)]
    pub fn miss_triangle(&self, triangles: &Triangles, i: usize) -> bool {
        let corners = triangles.shape(i).corners();
        let n = normal(corners);
        let [a, b, c] = map3(corners, |corner| corner - self.origin.middle);
        let height = a.dot(n);
        let size = a.max_abs().max(b.max_abs()).max(c.max_abs());
        // N is off by some ε of the product of the edges, and a thin triangle's hits do not come from it.
        let edges = (b - a).max_abs() * (c - a).max_abs();
        const THIN: f32 = 2e-6;
        if !self.shared {
            let reach = triangles.corners(i)[0].abs().max_element();
            // A hit may lie 3 · 32 ε of the size off the plane: `triangle::Flat` keeps it in a box.
            let far = reach + size;
            return self.turn_away(n, height, 8.0 * far * n.max_abs() + 2.0 * far * edges, THIN * edges);
        }
        // The test's own rounding, in units of the products that it compares: below 3e-6 (see `watertight`).
        const SLACK: f32 = 1e-5;
        // Beyond the slack, all that a ray meets lies on the side that the height says, and the volumes that the ray
        // spans with the edges all have its sign.
        let s = if height > 0.0 { 1.0 } else { -1.0 };
        if height.abs() <= size * (SLACK * n.max_abs() + THIN * edges) {
            return false;
        }
        let outside = |edge: Vec3<f32>, slack: f32| self.direction.greatest(edge * s) < -slack;
        let slack = SLACK * size * size;
        outside(n, SLACK * n.max_abs() + THIN * edges)
            || outside(a.cross(b), slack)
            || outside(b.cross(c), slack)
            || outside(c.cross(a), slack)
    }

    /// Shows the balls that the batch's cone meets, or all without a cone, in order.
    #[inline(always)]
    pub fn balls_met<L: Lanes>(&self, balls: &Balls, show: &mut impl FnMut(usize)) {
        let count = balls.len();
        let Some(cone) = &self.cone else {
            for i in 0..count {
                show(i);
            }
            return;
        };
        let Balls { center: [x, y, z], radius, .. } = balls;
        let origin = Vec3::splat(self.origin.middle.into());
        for at in (0..count).step_by(L::WIDTH) {
            let center = Vec3::new(L::load(&x[at..]), L::load(&y[at..]), L::load(&z[at..]));
            let radius = L::load(&radius[at..]) + L::splat(self.spread);
            let real = u32::MAX >> (32 - (count - at).min(L::WIDTH));
            let mut met = (!cone.misses(center - origin, radius)).bits() & real;
            while met != 0 {
                show(at + met.trailing_zeros() as usize);
                met &= met - 1;
            }
        }
    }

    /// Whether all origins lie on one side of a plane and no direction leads to the other, `height` being −(n·o + d)
    /// for the middle of the origins, `offset` a bound on the size of d, and `slack` on how far n·direction is off.
    #[inline(always)]
    fn turn_away(&self, normal: Vec3<f32>, height: f32, offset: f32, slack: f32) -> bool {
        let Vec3 { x, y, z } = self.origin.half;
        let spread = (normal.x * x).abs() + (normal.y * y).abs() + (normal.z * z).abs();
        let size = self.origin.middle.max_abs() * normal.max_abs();
        let spread = spread * (1.0 + 1e-6) + 1e-6 * (size + offset) * f32::from(!self.shared);
        if height > spread {
            self.direction.greatest(normal) < -slack
        } else if height < -spread {
            self.direction.greatest(-normal) < -slack
        } else {
            false
        }
    }
}

/// A box: its middle and half its size.
#[derive(Clone, Copy, Debug)]
pub struct Span {
    /// The middle.
    pub middle: Vec3<f32>,
    /// Half the size.
    pub half: Vec3<f32>,
}

/// Directions within an angle of an axis.
#[derive(Clone, Copy, Debug)]
pub struct Cone {
    /// Unit axis.
    pub axis: Vec3<f32>,
    /// Sine of the half-angle, rounded up.
    pub sin: f32,
    /// Cosine of the half-angle.
    pub cos: f32,
}

impl Bounds {
    /// One pass over the batch; `None` when no ray is active. Rays with NaN do not count: they hit nothing.
    #[inline(always)]
    pub fn of<L: Lanes>(rays: &RayBatch) -> Option<Self> {
        let (mut origins, mut directions) = (Extent::<L>::empty(), Extent::<L>::empty());
        let mut any = false;
        for at in (0..rays.len).step_by(L::WIDTH) {
            let active = L::load(&rays.t_max[at..]).ge(L::zero());
            if !active.any() {
                continue;
            }
            any = true;
            directions.include(Vec3::load(&rays.direction, at), active);
            if !rays.common_origin {
                origins.include(Vec3::load(&rays.origin, at), active);
            }
        }
        if !any {
            return None;
        }
        let origin = if rays.common_origin { Span::at(rays.first_origin()) } else { origins.span() };
        Some(Self::new(origin, directions.span()))
    }

    /// From boxes around the origins and the directions.
    #[inline(always)]
    pub fn new(origin: Span, direction: Span) -> Self {
        let Vec3 { x, y, z } = origin.half;
        let shared = x == 0.0 && y == 0.0 && z == 0.0;
        let spread = if shared { 0.0 } else { origin.half.dot(origin.half).sqrt() * (1.0 + 1e-5) };
        Self { origin, direction, shared, spread, cone: Cone::around(&direction) }
    }
}

/// A box that grows, per lane.
#[derive(Clone, Copy, Debug)]
pub struct Extent<L> {
    min: Vec3<L>,
    max: Vec3<L>,
}

impl<L: Lanes> Extent<L> {
    /// Around nothing.
    #[inline(always)]
    pub fn empty() -> Self {
        let far = L::splat(f32::INFINITY);
        let far = Vec3::new(far, far, far);
        Self { min: far, max: -far }
    }

    /// Takes in `v` where `active`; NaN is passed over.
    #[inline(always)]
    pub fn include(&mut self, v: Vec3<L>, active: L::Mask) {
        let (min, max) = (v.min(self.min), v.max(self.max));
        if active.all() {
            (self.min, self.max) = (min, max);
        } else {
            (self.min, self.max) = (min.select(active, self.min), max.select(active, self.max));
        }
    }

    /// The box around all lanes.
    #[inline(always)]
    pub fn span(&self) -> Span {
        let Self { min, max } = self;
        let (x, y, z) = (Span::axis(min.x, max.x), Span::axis(min.y, max.y), Span::axis(min.z, max.z));
        Span { middle: Vec3 { x: x.0, y: y.0, z: z.0 }, half: Vec3 { x: x.1, y: y.1, z: z.1 } }
    }
}

impl Span {
    /// A single point.
    #[inline(always)]
    pub fn at(point: glam::Vec3) -> Self {
        Self { middle: point.into(), half: Vec3 { x: 0.0, y: 0.0, z: 0.0 } }
    }

    /// Middle and half the size along one axis, from the ends per lane.
    #[inline(always)]
    fn axis<L: Lanes>(min: L, max: L) -> (f32, f32) {
        let (min, max) = (min.least(), max.greatest());
        // Where both ends are equal the middle is exactly that value.
        let middle = if min == max { min } else { 0.5 * min + 0.5 * max };
        // Counted from the rounded middle, so that both ends stay inside.
        (middle, f32::max(max - middle, middle - min))
    }

    /// The greatest value of a·p over the box, rounded up; NaN if it is unknown.
    #[inline(always)]
    pub fn greatest(&self, a: Vec3<f32>) -> f32 {
        let Vec3 { x, y, z } = self.middle;
        let most = a.dot(self.middle) + a.x.abs() * self.half.x + a.y.abs() * self.half.y + a.z.abs() * self.half.z;
        // Some thirty roundings at the most, of terms no larger than these.
        let largest = |a: f32, middle: f32, half: f32| (a * middle).abs().max((a * half).abs());
        let Vec3 { x: hx, y: hy, z: hz } = self.half;
        most + 2e-6 * largest(a.x, x, hx).max(largest(a.y, y, hy)).max(largest(a.z, z, hz))
    }
}

impl Cone {
    /// Around a box of directions: the ball around the box fills the cone of sine radius / distance.
    #[inline(always)]
    fn around(directions: &Span) -> Option<Self> {
        let Span { middle: axis, half } = *directions;
        let length = axis.dot(axis).sqrt();
        let sin = half.dot(half).sqrt() / length * (1.0 + 1e-5);
        // A wider cone culls next to nothing. NaN fails the comparison too.
        (sin < 0.95).then(|| Self { axis: axis * (1.0 / length), sin, cos: (1.0 - sin * sin).sqrt() })
    }

    /// Whether no ray from within `spread` of `origin` with a direction in this cone meets the ball; where true, it
    /// is certain.
    ///
    /// A ray that starts `spread` away meets a ball of radius R only if the parallel one from the centre meets
    /// one of radius R + `spread`. The distance of the ball's centre f from the cone's surface is at least
    /// p cos − a sin, with a and p the parts of f along and across the axis. The margin covers the rounding
    /// of every term, which is below 20 ε |f|².
    #[inline(always)]
    pub fn misses<L: Lanes>(&self, f: Vec3<L>, radius: L) -> L::Mask {
        let axis = Vec3::new(L::splat(self.axis.x), L::splat(self.axis.y), L::splat(self.axis.z));
        let f2 = f.dot(f);
        let along = f.dot(axis);
        let across2 = along.neg_mul_add(along, f2);
        let margin = f2 * L::splat(1e-5);
        let reach = along.mul_add(L::splat(self.sin), radius);
        let reach2 = reach * reach;
        let beside = across2.mul_add(L::splat(self.cos * self.cos), -margin).gt(reach2);
        let behind = reach.lt(L::zero()) & reach2.gt(margin);
        beside & reach.ge(L::zero()) | behind
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use wide::f32x8;

    fn random(state: &mut u32) -> f32 {
        *state = state.wrapping_mul(747_796_405).wrapping_add(2_891_336_453);
        let w = ((*state >> ((*state >> 28) + 4)) ^ *state).wrapping_mul(277_803_737);
        ((w >> 22) ^ w) as f32 / 4_294_967_296.0 * 2.0 - 1.0
    }

    /// Whatever a cone leaves out, no ray of the batch meets, in exact-enough f64.
    #[test]
    fn what_is_culled_is_never_hit() {
        let mut seed = 7;
        let mut culled = 0;
        for round in 0..2_000 {
            let spread = [0.0, 0.01, 1.0][round % 3];
            let width = [0.01, 0.1, 0.6][round / 3 % 3];
            let mut v = || glam::Vec3::new(random(&mut seed), random(&mut seed), random(&mut seed));
            let (base, axis) = (v() * 10.0, v().normalize());
            let mut rays = RayBatch::default();
            for _ in 0..64 {
                rays.push(base + v() * spread, (axis + v() * width).normalize(), 0.0, 1e30);
            }
            let bounds = Bounds::of::<f32x8>(&rays).unwrap();
            let Some(cone) = bounds.cone else { continue };
            for _ in 0..20 {
                let (center, radius) = (v() * 20.0, v().x.abs() * 2.0 + 1e-3);
                let f = Vec3::from(center) - bounds.origin.middle;
                if !cone.misses::<f32>(f, radius + bounds.spread) {
                    continue;
                }
                culled += 1;
                for i in 0..rays.len {
                    let o = glam::DVec3::from_array([0, 1, 2].map(|a| f64::from(rays.origin[a][i])));
                    let d = glam::DVec3::from_array([0, 1, 2].map(|a| f64::from(rays.direction[a][i])));
                    let to = center.as_dvec3() - o;
                    let closest = to - d * to.dot(d).max(0.0);
                    assert!(closest.length() > f64::from(radius), "round {round}");
                }
            }
        }
        assert!(culled > 5_000, "{culled}");
    }

    /// No point of the box has more, however the terms cancel.
    #[test]
    fn the_greatest_value_is_never_exceeded() {
        let mut seed = 9;
        let mut close = 0;
        for _ in 0..100_000 {
            let mut v = || glam::Vec3::new(random(&mut seed), random(&mut seed), random(&mut seed));
            let (middle, half, mut a) = (v(), v().abs() * v().x.powi(8), v());
            // Across the middle, as planes are that a batch looks along.
            a -= middle * (a.dot(middle) / middle.length_squared());
            let span = Span { middle: middle.into(), half: half.into() };
            let exact = a.as_dvec3().dot(middle.as_dvec3()) + a.as_dvec3().abs().dot(half.as_dvec3());
            let greatest = f64::from(span.greatest(a.into()));
            assert!(greatest >= exact, "{middle} {half} {a}: {greatest} for {exact}");
            close += usize::from(greatest - exact < 1e-5);
        }
        assert!(close > 90_000, "{close}");
    }

    /// Where the plane's test finds a hit, its batch is not left out: for origins that are off the plane by no more than
    /// they round, and directions along it.
    #[test]
    fn a_plane_that_is_met_within_rounding_is_not_culled() {
        let mut seed = 11;
        let (mut culled, mut hits) = (0, 0);
        for round in 0..40_000 {
            let mut v = || glam::Vec3::new(random(&mut seed), random(&mut seed), random(&mut seed));
            let (normal, far) = (v().normalize(), [1.0, 30.0, 1000.0][round % 3]);
            let mut planes = Planes::default();
            planes.push(normal, v().x * far, 0);
            let [n, base] = [normal.as_dvec3(), (v() * far).as_dvec3()];
            let offset = f64::from(planes.distance[0]) / planes.normal(0).as_dvec3().length();
            let on = base - n * (base.dot(n) + offset);
            let mut rays = RayBatch::default();
            for _ in 0..8 {
                // On one side by what rounds, or by what is clear of that.
                let above = f64::from(far * f32::EPSILON * [1.5 + 1.5 * v().x, 60.0 + 20.0 * v().x][round / 27 % 2]);
                let across = v().as_dvec3().reject_from_normalized(n);
                let origin = on + across * f64::from(far * [0.0, 1e-6, 1e-3][round / 3 % 3]) + n * above;
                let tilt = n * [1e-8, 1e-6, 1.0][round / 9 % 3] * f64::from(1.0 + v().y);
                rays.push(origin.as_vec3(), (across + tilt).normalize().as_vec3(), 0.0, 1e30);
            }
            let bounds = Bounds::of::<f32x8>(&rays).unwrap();
            let met = (0..8).filter(|&i| {
                let at = |columns: &[[f32; crate::math::BATCH]; 3]| Vec3::<f32>::load(columns, i);
                planes.test::<f32>(0, at(&rays.origin), at(&rays.direction), 0.0, f32::INFINITY).is_some()
            });
            let met = met.count();
            if bounds.miss_plane(&planes, 0) {
                culled += 1;
                assert_eq!(met, 0, "round {round}");
            } else {
                hits += met;
            }
        }
        assert!(culled > 500 && hits > 5_000, "{culled} {hits}");
    }

    #[test]
    fn nan_rays_neither_count_nor_hide_others() {
        let mut rays = RayBatch::default();
        rays.push(glam::Vec3::X, glam::Vec3::Z, 0.0, 1.0);
        rays.push(glam::Vec3::NAN, glam::Vec3::NAN, 0.0, 1.0);
        rays.push(-glam::Vec3::X, glam::Vec3::Z, 0.0, 1.0);
        for width in 0..2 {
            let b = if width == 0 { Bounds::of::<f32>(&rays) } else { Bounds::of::<f32x8>(&rays) }.unwrap();
            assert!(b.origin.middle.x == 0.0 && b.spread >= 1.0 && b.spread < 1.01 && b.cone.is_some());
        }
    }
}
