//! Sphere tracing of a torus: from a point no surface is nearer than the distance to it, so that is how far to step.

use super::{LaneHits, ROUNDOFF, SeenTorus, Span, along};
use crate::math::{LaneMask, Lanes, Vec3, map2};

/// The most steps.
const MAX_STEPS: usize = 256;

/// At what distance from the surface the march ends, in R + r: what rounds along the way is half of that.
const NEAR: f32 = 4.0 * ROUNDOFF;

/// Steps as long as the distance to the torus, until that is at most 4 ε (R + r).
///
/// Hart, *Sphere Tracing: A Geometric Method for the Antialiased Ray Tracing of Implicit Surfaces* (The Visual Computer
/// 12, 1996, pp. 527–545), with the distance √((ρ − R)² + z²) − r. Deviations: from inside it steps by the negative
/// distance; the march is kept to the ball and the planes that the default searches in; it ends after 256 steps and then
/// hits nothing; the side it is on is the one where it first is farther off than 4 ε (R + r), so that it leaves a surface
/// that it starts on.
///
/// **Error.** A hit is off the torus by less than 10 ε (R + r) + 4 ε |o − center|. But at an incidence θ every step leaves
/// 1 − cos θ of the distance, so that some 15 / cos θ are needed: rays that graze the torus run out of steps and are lost,
/// and those that touch it cost the most.
///
/// The march starts at `t_min`, so that this is on a surface as an origin is. t is short by up to 4 ε (R + r) / cos θ beside
/// the rounding; directions are of unit length; NaN hits nothing.
#[inline(never)]
pub fn sphere_trace<L: Lanes>(seen: &SeenTorus<L>, direction: Vec3<L>, t_min: L, t_max: L) -> LaneHits<L> {
    let per_major = L::splat(1.0) / seen.major;
    let d = along(&seen.axes, direction);
    // s counts from the closest approach q to the centre.
    let b = seen.f.dot(d);
    let q = d.mul_add(-b, seen.f);
    let ends = map2([t_min, t_max], |t| t.mul_add(per_major, b));
    let Span { ends: [mut s, high], live: mut active, .. } = Span::around(seen.kappa, q, d, ends)?;
    let zero = L::zero();
    let near = L::splat(NEAR) * (L::splat(1.0) + seen.kappa);
    let nowhere = zero.lt(zero);
    let (mut outside, mut inside, mut found) = (nowhere, nowhere, nowhere);
    for _ in 0..MAX_STEPS {
        let away = distance(d.mul_add(s, q), seen.kappa);
        let hit = active & ((outside & away.le(near)) | (inside & away.ge(-near)));
        found = found | hit;
        active = active & !hit;
        let unknown = active & !outside & !inside;
        outside = outside | (unknown & away.gt(near));
        inside = inside | (unknown & away.lt(-near));
        s = (s + away.abs().max(near)).select(active, s);
        active = active & s.lt(high);
        if !active.any() {
            break;
        }
    }
    let t = (s - b) * seen.major;
    let found = found & t.gt(t_min) & t.lt(t_max);
    found.any().then_some((t, found))
}

/// From the torus with R = 1; below zero inside.
#[inline(always)]
fn distance<L: Lanes>(p: Vec3<L>, kappa: L) -> L {
    let aside = p.x.mul_add(p.x, p.y * p.y).sqrt() - L::splat(1.0);
    aside.mul_add(aside, p.z * p.z).sqrt() - kappa
}
