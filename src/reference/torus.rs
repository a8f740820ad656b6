//! Tori, in units of the major radius about the centre, along their own axes.
use super::{Edge, Edges, Primitive, Primitives, axes, turn};
use crate::scene;
use glam::{DMat3, DVec2, DVec3};

#[derive(Clone, Debug)]
pub(super) struct Torus {
    center: DVec3,
    /// T, B and the unit axis, as rows.
    to_local: DMat3,
    major: f64,
    minor: f64,
    material: usize,
}

impl Torus {
    pub fn new(it: &scene::Torus) -> Self {
        let axis = it.axis.as_dvec3().normalize();
        let [t, b] = axes(axis);
        Self {
            center: it.center.as_dvec3(),
            to_local: DMat3::from_cols(t, b, axis).transpose(),
            major: f64::from(it.major_radius),
            minor: f64::from(it.minor_radius),
            material: it.material,
        }
    }

    /// (q·T, q·B, q·A).
    fn local(&self, point: DVec3) -> DVec3 {
        self.to_local * (point - self.center)
    }

    /// The point of the tube's middle nearest to a point, and the direction from there to the point.
    fn spine(&self, point: DVec3) -> (DVec3, DVec3) {
        let q = self.local(point);
        // On the axis all directions are alike.
        let middle = DVec3::new(q.x, q.y, 0.0).try_normalize().unwrap_or(DVec3::X) * self.major;
        let outward = (q - middle).try_normalize().unwrap_or(DVec3::Z);
        let to_world = self.to_local.transpose();
        (self.center + to_world * middle, to_world * outward)
    }
}

impl Primitives for scene::Torus {
    fn add(&self, to: &mut Vec<Box<dyn Primitive>>) {
        to.push(Box::new(Torus::new(self)));
    }
}

impl Primitive for Torus {
    /// Between the extrema of the quartic (|p|² + 1 − κ²)² − 4 ρ², κ = minor / major, it is monotone: so its sign at
    /// the extrema tells the roots apart, which are then bisected. A tangent counts as a hit.
    ///
    /// The ray is followed from its closest approach to the centre, to as far as one major radius beyond the torus. The
    /// sign is taken of (ρ − 1)² + z² − κ², the quartic's factor that may be negative; expanded it cancels.
    fn distance(&self, origin: DVec3, direction: DVec3) -> Option<f64> {
        let kappa = self.minor / self.major;
        let (f, d) = (self.local(origin) / self.major, self.to_local * direction);
        let b = f.dot(d);
        let q = f - b * d;
        let half = ((2.0 + kappa).powi(2) - q.length_squared()).sqrt();
        let first = b.max(-half);
        // Also where the ray passes by, and half is no number.
        if first.partial_cmp(&half) != Some(std::cmp::Ordering::Less) {
            return None;
        }
        // |p|² + 1 − κ² and ρ², by powers of s.
        let n = [q.length_squared() + 1.0 - kappa * kappa, 2.0 * q.dot(d), d.length_squared()];
        let (q2, d2) = (q.truncate(), d.truncate());
        let rho2 = [q2.length_squared(), 2.0 * q2.dot(d2), d2.length_squared()];
        let quartic = [
            n[0] * n[0] - 4.0 * rho2[0],
            2.0 * n[0] * n[1] - 4.0 * rho2[1],
            2.0 * n[0] * n[2] + n[1] * n[1] - 4.0 * rho2[2],
            2.0 * n[1] * n[2],
            n[2] * n[2],
        ];
        let surface = |s: f64| {
            let p = q + s * d;
            (p.truncate().length() - 1.0).powi(2) + p.z * p.z - kappa * kappa
        };
        let extrema = roots(&derivative(&quartic), first, half);
        let roots = crossings(surface, first, half, &extrema);
        roots.into_iter().map(|s| (s - b) * self.major).find(|t| *t > 0.0)
    }

    fn project(&self, point: DVec3) -> DVec3 {
        let (middle, outward) = self.spine(point);
        middle + self.minor * outward
    }

    fn normal(&self, point: DVec3) -> DVec3 {
        self.spine(point).1
    }

    fn extent(&self) -> f64 {
        self.major + self.minor
    }

    fn material(&self) -> usize {
        self.material
    }

    fn uv(&self, point: DVec3) -> DVec2 {
        let q = self.local(point);
        DVec2::new(turn(q.x, q.y), turn(q.z, q.truncate().length() - self.major))
    }

    fn edges(&self, _point: DVec3) -> Edges {
        [[Edge::None; 2]; 2]
    }

    fn checker(&self, point: DVec3) -> DVec3 {
        self.local(point)
    }
}

/// Of a polynomial, the constant term first.
fn derivative(polynomial: &[f64]) -> Vec<f64> {
    polynomial.iter().enumerate().skip(1).map(|(power, c)| power as f64 * c).collect()
}

/// The roots of a polynomial after `from` and up to `to`, ascending: there is at most one between two of its
/// derivative's.
fn roots(polynomial: &[f64], from: f64, to: f64) -> Vec<f64> {
    if polynomial.len() < 2 {
        return Vec::new();
    }
    let value = |x: f64| polynomial.iter().rev().fold(0.0, |sum, c| sum * x + c);
    crossings(value, from, to, &roots(&derivative(polynomial), from, to))
}

/// Where a function that is monotone between `extrema` becomes zero, after `from` and up to `to`.
fn crossings(f: impl Fn(f64) -> f64, from: f64, to: f64, extrema: &[f64]) -> Vec<f64> {
    let mut found = Vec::new();
    let mut a = from;
    for &b in extrema.iter().chain([&to]) {
        if f(b) == 0.0 || f(a) * f(b) < 0.0 {
            found.push(bisect(&f, a, b));
        }
        a = b;
    }
    found
}

/// The root between two places with unlike signs, or `b` where the function is zero there.
fn bisect(f: impl Fn(f64) -> f64, mut a: f64, mut b: f64) -> f64 {
    let end = f(b);
    // From a length of a few to less than an f64 can tell, even next to 0.
    for _ in 0..100 {
        let middle = 0.5 * (a + b);
        match end == 0.0 {
            true => break,
            false if (f(middle) < 0.0) == (end < 0.0) => b = middle,
            false => a = middle,
        }
    }
    b
}
