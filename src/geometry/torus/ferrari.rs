//! The textbook's way to a torus: the quartic multiplied out, and its roots in closed form.

use super::{LaneHits, SeenTorus, along};
use crate::math::{LaneMask, Lanes, MAX_LANES, Vec3};

/// The roots of the quartic in closed form.
///
/// Jochen Schwarze, *Cubic and Quartic Roots* (Graphics Gems, 1990, pp. 404–407): t = y − a₃ / 4 makes the quartic
/// y⁴ + p y² + q y + r; with a root z of the resolvent z³ − ½ p z² − r z + ½ p r − ⅛ q², by Cardano's formula or, where
/// there are three, by Viète's cosine, it is the product of the quadratics y² ± v y + z ∓ u with u² = z² − r and
/// v² = 2 z − p. Deviations: in `f32`; always the greatest z; squares that rounding brings below zero count as zero; no
/// epsilon decides what else is zero.
///
/// **Error.** The coefficients grow with the fourth power of the distance, and their rounding with them. Next to a torus
/// with r = R / 4 hits are off it by 100 ε (R + r) in the median and by some 10⁴ at worst; from 30 R, or with r below
/// R / 100, most answers are wrong. At double roots, and where a ray starts on the surface, rounding makes hits and loses
/// them.
///
/// A root counts inside (`t_min`, `t_max`) as it was rounded, also one that should be where the ray starts. Directions are
/// of unit length; NaN hits nothing.
///
/// All in lanes but for the root of the resolvent, which takes the lanes one after another, as cube roots and cosines do.
#[inline(never)]
pub fn ferrari<L: Lanes>(seen: &SeenTorus<L>, direction: Vec3<L>, t_min: L, t_max: L) -> LaneHits<L> {
    let d = along(&seen.axes, direction);
    let [a3, a2, a1, a0] = quartic(seen.f, d, seen.kappa);
    let (zero, half, quarter) = (L::zero(), L::splat(0.5), L::splat(0.25));
    let shift = a3 * quarter;
    let shift2 = shift * shift;
    let p = shift2.mul_add(L::splat(-6.0), a2);
    let q = shift.mul_add(shift2.mul_add(L::splat(8.0), -(a2 + a2)), a1);
    let r = shift.mul_add(shift.mul_add(shift2.mul_add(L::splat(-3.0), a2), -a1), a0);
    let z = greatest_root(-(half * p), -r, (half * p).mul_add(r, q * q * L::splat(-0.125)));
    let u = z.mul_add(z, -r).max(zero).sqrt();
    let v = (z + z - p).max(zero).sqrt();
    let v = (-v).select(q.lt(zero), v);
    let (mut t, mut found) = (t_max, zero.lt(zero));
    for (middle, product) in [(-(half * v), z - u), (half * v, z + u)] {
        // NaN where there are none, and then they are inside nothing.
        let apart = middle.mul_add(middle, -product).sqrt();
        for y in [middle - apart, middle + apart] {
            let root = (y - shift) * seen.major;
            let nearer = root.gt(t_min) & root.lt(t);
            t = root.select(nearer, t);
            found = found | nearer;
        }
    }
    found.any().then_some((t, found))
}

/// (|p|² + 1 − κ²)² − 4 ρ² along p = f + t d, from t³ down; that of t⁴ is 1.
#[inline(always)]
fn quartic<L: Lanes>(f: Vec3<L>, d: Vec3<L>, kappa: L) -> [L; 4] {
    let flat = |a: Vec3<L>, b: Vec3<L>| a.x.mul_add(b.x, a.y * b.y) * L::splat(4.0);
    let twice = |x: L| x + x;
    let (k, b) = (f.dot(f) + (L::splat(1.0) - kappa * kappa), twice(f.dot(d)));
    [twice(b), b.mul_add(b, twice(k)) - flat(d, d), twice(k * b - flat(f, d)), k.mul_add(k, -flat(f, f))]
}

/// The greatest root of z³ + a z² + b z + c.
#[inline(always)]
fn greatest_root<L: Lanes>(a: L, b: L, c: L) -> L {
    let third = L::splat(1.0 / 3.0);
    let a = a * third;
    // w³ + 3 p w + 2 q for w = z + a / 3.
    let p = b.mul_add(third, -(a * a));
    let q = a.mul_add(a.mul_add(a, b * L::splat(-0.5)), c * L::splat(0.5));
    let discriminant = (p * p).mul_add(p, q * q);
    let [mut w, mut qs, mut discriminants] = [[0.0; MAX_LANES]; 3];
    p.store(&mut w);
    q.store(&mut qs);
    discriminant.store(&mut discriminants);
    for ((w, q), discriminant) in w.iter_mut().zip(qs).zip(discriminants).take(L::WIDTH) {
        *w = greatest_of_depressed(*w, q, discriminant);
    }
    L::load(&w) - a
}

/// The greatest root of w³ + 3 p w + 2 q, whose discriminant is q² + p³.
fn greatest_of_depressed(p: f32, q: f32, discriminant: f32) -> f32 {
    if discriminant >= 0.0 {
        let root = discriminant.sqrt();
        return (root - q).cbrt() - (root + q).cbrt();
    }
    let radius = (-p).sqrt();
    let cosine = -q / (radius * radius * radius);
    2.0 * radius * (cosine.clamp(-1.0, 1.0).acos() / 3.0).cos()
}
