//! Trials of a primitive's test: the same bits at all widths, and the reference's answers but for rounding.

use super::{Primitives, Surface};
use crate::math::{LaneMask, Lanes, Vec3};
use crate::reference::Tracer;
use glam::Vec3 as V;
use wide::{f32x4, f32x8};

/// ε, in `f64`.
pub const ROUNDOFF: f64 = 1.0 / (1u64 << 24) as f64;

/// How many ε a ray may be moved to explain an answer.
const MOVED: f64 = 8.0;

/// Random numbers (Steele, Lea and Flood's SplitMix64).
pub struct Random(pub u64);

impl Random {
    pub fn unit(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 53) as f64
    }

    pub fn below(&mut self, n: usize) -> usize {
        (self.unit() * n as f64) as usize
    }

    /// Within the cube from −1 to 1.
    pub fn cube(&mut self) -> V {
        let mut one = || (2.0 * self.unit() - 1.0) as f32;
        V::new(one(), one(), one())
    }

    pub fn direction(&mut self) -> V {
        loop {
            let v = self.cube();
            if (0.01..=1.0).contains(&v.length_squared()) {
                return v.normalize();
            }
        }
    }

    /// Along an axis, with zeros of either sign.
    pub fn along_axis(&mut self) -> V {
        let mut v = V::ZERO.map(|_| if self.unit() < 0.5 { 0.0 } else { -0.0 });
        v[self.below(3)] = if self.unit() < 0.5 { 1.0 } else { -1.0 };
        v
    }

    /// In a plane of two axes, with a zero of either sign.
    pub fn across_axis(&mut self) -> V {
        let mut v = self.direction();
        v[self.below(3)] = 0.0;
        let zero = if self.unit() < 0.5 { 0.0 } else { -0.0 };
        v.try_normalize().unwrap_or(V::X).map(|c| if c == 0.0 { zero } else { c })
    }
}

/// How far from its surface a ray starts ([`crate::shade`]): ε (8 reach + 9 M).
pub fn lift(surface: &Surface<f32>) -> f32 {
    0.5 * f32::EPSILON * (8.0 * surface.reach + 9.0 * surface.point.max_abs())
}

/// A ray with t_min = 0.
#[derive(Clone, Copy, Debug)]
pub struct Ray {
    pub origin: V,
    pub direction: V,
}

/// The hits of all rays within (`t_min`, ∞), with so many lanes at once.
fn hits<K: Primitives, L: Lanes>(kind: &K, rays: &[Ray], t_min: f32) -> Vec<Option<f32>> {
    let mut hits = Vec::new();
    for packet in rays.chunks(L::WIDTH) {
        let lane = |pick: &dyn Fn(&Ray) -> f32| {
            let mut lanes = vec![pick(&packet[0]); L::WIDTH];
            lanes.iter_mut().zip(packet).for_each(|(lane, ray)| *lane = pick(ray));
            L::load(&lanes)
        };
        let origin = Vec3::new(lane(&|r| r.origin.x), lane(&|r| r.origin.y), lane(&|r| r.origin.z));
        let direction = Vec3::new(lane(&|r| r.direction.x), lane(&|r| r.direction.y), lane(&|r| r.direction.z));
        let found = kind.test(0, origin, direction, L::splat(t_min), L::splat(f32::INFINITY));
        let mut t = vec![0.0; L::WIDTH];
        let bits = found.map_or(0, |(at, mask)| {
            at.store(&mut t);
            mask.bits()
        });
        hits.extend((0..packet.len()).map(|i| (bits >> i & 1 == 1).then_some(t[i])));
    }
    hits
}

/// The hits beyond `t_min`, to the bit the same at all widths.
pub fn all_widths<K: Primitives>(kind: &K, rays: &[Ray], t_min: f32) -> Vec<Option<f32>> {
    let bits = |hits: &[Option<f32>]| hits.iter().map(|t| t.map(f32::to_bits)).collect::<Vec<_>>();
    let one = hits::<K, f32>(kind, rays, t_min);
    assert_eq!(bits(&one), bits(&hits::<K, f32x4>(kind, rays, t_min)), "x4");
    assert_eq!(bits(&one), bits(&hits::<K, f32x8>(kind, rays, t_min)), "x8");
    one
}

/// Asserts that the only primitive answers as the reference does: its surface is missed by at most `off` (of the ray
/// and t), or the reference says the same for a ray that is moved by [`MOVED`] ε of `size` (the greatest length
/// involved) and turned by as many ε. Returns how many rays hit, and how many answers needed such an explanation.
pub fn agree<K: Primitives>(
    kind: &K,
    tracer: &Tracer,
    rays: &[Ray],
    size: impl Fn(&Ray) -> f64,
    off: impl Fn(&Ray, f64) -> f64,
) -> [usize; 2] {
    let mut counts = [0; 2];
    for (ray, t) in rays.iter().zip(all_widths(kind, rays, 0.0)) {
        let (origin, direction) = (ray.origin.as_dvec3(), ray.direction.as_dvec3());
        let truth = tracer.intersect(origin, direction, f64::INFINITY);
        counts[0] += usize::from(t.is_some());
        let near = match (t, truth) {
            (Some(t), Some(hit)) => (f64::from(t) - hit.t).abs() * hit.normal.dot(direction).abs() <= off(ray, hit.t),
            (None, None) => true,
            _ => false,
        };
        if !near {
            counts[1] += 1;
            assert!(
                explained(tracer, ray, t, size(ray), off(ray, t.map_or(0.0, f64::from))),
                "{ray:?}: {t:?}, not {truth:?}"
            );
        }
    }
    counts
}

/// Whether rays nearby have such answers: none, or distances on both sides of `t`, give or take `slack`.
fn explained(tracer: &Tracer, ray: &Ray, t: Option<f32>, size: f64, slack: f64) -> bool {
    let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
    let mut random = Random(1);
    // Every other time at all scales and along some axes only: a thin thing may be missed by next to nothing.
    let near = |random: &mut Random, fine: bool| {
        random.cube().as_dvec3().map(|c| match random.below(3) {
            0 if fine => 0.0,
            _ if fine => MOVED * ROUNDOFF * c * 1e-12_f64.powf(random.unit()),
            _ => MOVED * ROUNDOFF * c,
        })
    };
    for i in 0..20_000 {
        let fine = i % 2 == 1;
        let origin = ray.origin.as_dvec3() + size * near(&mut random, fine);
        let direction = (ray.direction.as_dvec3() + near(&mut random, fine)).normalize();
        match (tracer.intersect(origin, direction, f64::INFINITY), t) {
            (None, None) => return true,
            (Some(hit), Some(_)) => (low, high) = (low.min(hit.t), high.max(hit.t)),
            _ => {}
        }
        if t.is_some_and(|t| (low - slack..=high + slack).contains(&f64::from(t))) {
            return true;
        }
    }
    false
}
