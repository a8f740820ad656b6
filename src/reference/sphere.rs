//! The sphere |p − c| = r, seen from outside and inside.
use crate::scene;
use glam::DVec3;

#[derive(Clone, Debug)]
pub(super) struct Sphere {
    pub center: DVec3,
    pub radius: f64,
    pub material: usize,
}

impl Sphere {
    pub fn new(sphere: &scene::Sphere) -> Self {
        Self { center: sphere.center.as_dvec3(), radius: f64::from(sphere.radius), material: sphere.material }
    }

    /// The first root above 0 of t² + 2bt + c = 0, with b = (o − c)·d and c = |o − c|² − r².
    ///
    /// The quarter discriminant b² − c is taken as r² less the squared distance of the ray's line from the
    /// centre, and the roots as q and c/q: the plain formulae cancel for a small sphere far away even in `f64`.
    /// A tangent counts as a hit.
    pub fn distance(&self, origin: DVec3, direction: DVec3) -> Option<f64> {
        let from_center = origin - self.center;
        let b = from_center.dot(direction);
        let discriminant = self.radius * self.radius - (from_center - b * direction).length_squared();
        if discriminant < 0.0 {
            return None;
        }
        let distance = from_center.length();
        let c = (distance - self.radius) * (distance + self.radius);
        let root = discriminant.sqrt();
        let (first, second) = if b > 0.0 {
            let q = -b - root;
            (q, c / q)
        } else {
            let q = -b + root;
            (c / q, q)
        };
        [first, second].into_iter().find(|&t| t > 0.0)
    }

    /// Unit, outward.
    pub fn normal(&self, point: DVec3) -> DVec3 {
        (point - self.center).normalize()
    }

    /// The point of the sphere nearest to `point`.
    pub fn project(&self, point: DVec3) -> DVec3 {
        self.center + self.radius * self.normal(point)
    }
}
