//! What holds for all rays of a batch: a ball around their origins and a cone around their directions.

use crate::math::{LaneMask, Lanes, RayBatch, Vec3};

/// Bounds of the active rays of a batch.
#[derive(Clone, Copy, Debug)]
pub struct Bounds {
    /// Centre of the origins.
    pub origin: Vec3<f32>,
    /// Radius of a ball around them; 0 when all rays share one origin.
    pub spread: f32,
    /// The cone that holds all directions, if they are within a half-space with room to spare.
    pub cone: Option<Cone>,
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
        let far = L::splat(f32::INFINITY);
        let (mut o_min, mut o_max) = (Vec3::new(far, far, far), -Vec3::new(far, far, far));
        let (mut d_min, mut d_max) = (o_min, o_max);
        let mut any = false;
        for at in (0..rays.len).step_by(L::WIDTH) {
            let active = L::load(&rays.t_max[at..]).ge(L::zero());
            if !active.any() {
                continue;
            }
            any = true;
            let (o, d) = (Vec3::load(&rays.origin, at), Vec3::load(&rays.direction, at));
            if active.all() {
                (o_min, o_max) = (o.min(o_min), o.max(o_max));
                (d_min, d_max) = (d.min(d_min), d.max(d_max));
            } else {
                (o_min, o_max) = (o.min(o_min).select(active, o_min), o.max(o_max).select(active, o_max));
                (d_min, d_max) = (d.min(d_min).select(active, d_min), d.max(d_max).select(active, d_max));
            }
        }
        if !any {
            return None;
        }
        let (origin, half) = middle(o_min, o_max);
        let shared = half.x == 0.0 && half.y == 0.0 && half.z == 0.0;
        let spread = if shared { 0.0 } else { half.dot(half).sqrt() * (1.0 + 1e-5) };
        Some(Self { origin, spread, cone: Cone::around(d_min, d_max) })
    }

    /// Whether all rays share one origin.
    pub fn shared(&self) -> bool {
        self.spread == 0.0
    }
}

/// Middle and half the size of a box given per lane.
#[inline(always)]
fn middle<L: Lanes>(min: Vec3<L>, max: Vec3<L>) -> (Vec3<f32>, Vec3<f32>) {
    let least = |v: L| v.fold(Lanes::min);
    let most = |v: L| v.fold(Lanes::max);
    let min = Vec3 { x: least(min.x), y: least(min.y), z: least(min.z) };
    let max = Vec3 { x: most(max.x), y: most(max.y), z: most(max.z) };
    // Where both ends are equal the middle is exactly that value.
    let mid = |a: f32, b: f32| if a == b { a } else { 0.5 * a + 0.5 * b };
    let middle = Vec3 { x: mid(min.x, max.x), y: mid(min.y, max.y), z: mid(min.z, max.z) };
    // Half the size, counted from the rounded middle, so that the box stays inside.
    let reach = |a: f32, m: f32, b: f32| f32::max(b - m, m - a);
    let half =
        Vec3 { x: reach(min.x, middle.x, max.x), y: reach(min.y, middle.y, max.y), z: reach(min.z, middle.z, max.z) };
    (middle, half)
}

impl Cone {
    /// Around a box of directions: the ball around the box fills the cone of sine radius / distance.
    #[inline(always)]
    fn around<L: Lanes>(min: Vec3<L>, max: Vec3<L>) -> Option<Self> {
        let (axis, half) = middle(min, max);
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
                let f = Vec3::from(center) - bounds.origin;
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

    #[test]
    fn nan_rays_neither_count_nor_hide_others() {
        let mut rays = RayBatch::default();
        rays.push(glam::Vec3::X, glam::Vec3::Z, 0.0, 1.0);
        rays.push(glam::Vec3::NAN, glam::Vec3::NAN, 0.0, 1.0);
        rays.push(-glam::Vec3::X, glam::Vec3::Z, 0.0, 1.0);
        for width in 0..2 {
            let b = if width == 0 { Bounds::of::<f32>(&rays) } else { Bounds::of::<f32x8>(&rays) }.unwrap();
            assert!(b.origin.x == 0.0 && b.spread >= 1.0 && b.spread < 1.01 && b.cone.is_some());
        }
    }
}
