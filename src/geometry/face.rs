//! The geometry that boxes and fractals share: pairs of faces across three axes.

use crate::math::{Lanes, Vec3};

/// A unit direction, and what the distance of a face is multiplied by.
#[derive(Clone, Copy, Debug)]
pub struct Aim<L> {
    /// d.
    pub direction: Vec3<L>,
    /// 1 / |d|; infinite where the ray runs along the faces.
    pub inverse: Vec3<L>,
}

impl<L: Lanes> Aim<L> {
    /// For unit directions.
    #[inline(always)]
    pub fn new(direction: Vec3<L>) -> Self {
        let one = L::splat(1.0);
        let Vec3 { x, y, z } = direction;
        Self { direction, inverse: Vec3::new(one / x.abs(), one / y.abs(), one / z.abs()) }
    }
}

impl<L: Lanes> From<Vec3<L>> for Aim<L> {
    #[inline(always)]
    fn from(direction: Vec3<L>) -> Self {
        Self::new(direction)
    }
}

/// By how much of its farthest corner's distance along any axis a box is made wider that holds a primitive's hits: 32 ε.
/// The margin of the tree's boxes ([`crate::trace`]) rests on it.
pub const PAD: f32 = 1.0 / (1 << 19) as f32;

/// Where rays from the origin enter and leave the closed box from `low` to `high`; they meet it where the first is at
/// most the second.
///
/// A face's plane that the ray runs in gives 0 · ∞, a NaN, which `min` and `max` pass over: such a ray is between the
/// faces. Every other parallel one gives ±∞ by its side.
#[inline(always)]
pub fn between<L: Lanes>(low: Vec3<L>, high: Vec3<L>, aim: &Aim<L>) -> (L, L) {
    // Mirrored where the direction is below zero, as −0 is not: then the lower face is the one that comes first.
    let (near, far) = (by_sign(aim.direction, low, -high), by_sign(aim.direction, high, -low));
    let mut enter = L::splat(f32::NEG_INFINITY);
    let mut exit = L::splat(f32::INFINITY);
    for (near, far, inverse) in
        [(near.x, far.x, aim.inverse.x), (near.y, far.y, aim.inverse.y), (near.z, far.z, aim.inverse.z)]
    {
        enter = (near * inverse).max(enter);
        exit = (far * inverse).min(exit);
    }
    (enter, exit)
}

/// By component, `below` where `q` is below zero, `other` elsewhere.
#[inline(always)]
pub fn by_sign<L: Lanes>(q: Vec3<L>, other: Vec3<L>, below: Vec3<L>) -> Vec3<L> {
    let zero = L::zero();
    by_axis([q.x.lt(zero), q.y.lt(zero), q.z.lt(zero)], below, other)
}

/// By component, `a` where the axis' mask is true, `b` elsewhere.
#[inline(always)]
pub fn by_axis<L: Lanes>([x, y, z]: [L::Mask; 3], a: Vec3<L>, b: Vec3<L>) -> Vec3<L> {
    Vec3::new(a.x.select(x, b.x), a.y.select(y, b.y), a.z.select(z, b.z))
}

/// By component, −1 below zero and 1 elsewhere.
#[inline(always)]
pub fn signs<L: Lanes>(q: Vec3<L>) -> Vec3<L> {
    by_sign(q, Vec3::splat(glam::Vec3::ONE), Vec3::splat(glam::Vec3::NEG_ONE))
}

/// (u, v) of a point at `share` of the box's half size from its centre, on the face whose normal is an axis up to
/// rounding; see [`crate::scene::Cuboid`].
#[inline(always)]
pub fn uv<L: Lanes>(share: Vec3<L>, normal: Vec3<L>) -> [L; 2] {
    let [on_x, on_y, _] = axis(normal);
    let Vec3 { x: sx, y: sy, z: sz } = signs(normal);
    let Vec3 { x, y, z } = share;
    let half = L::splat(0.5);
    let u = (-(sx * z)).select(on_x, x.select(on_y, sz * x));
    let v = (-(sy * z)).select(on_y, y);
    [u.mul_add(half, half), v.mul_add(half, half)]
}

/// The two coordinates along the face with this normal; 0 for the third.
#[inline(always)]
pub fn along<L: Lanes>(q: Vec3<L>, normal: Vec3<L>) -> Vec3<L> {
    by_axis(axis(normal), Vec3::splat(glam::Vec3::ZERO), q)
}

/// Which axis a normal is, up to rounding.
#[inline(always)]
fn axis<L: Lanes>(normal: Vec3<L>) -> [L::Mask; 3] {
    let half = L::splat(0.5);
    let (x, y) = (normal.x.abs().gt(half), normal.y.abs().gt(half));
    [x, y, !x & !y]
}
