//! The sphere |p − c| = r.
use super::{Edge, Edges, Primitive, Primitives, around, turn};
use crate::scene::{self, Sides};
use glam::{DVec2, DVec3};
use std::f64::consts::PI;

#[derive(Clone, Debug)]
pub(super) struct Sphere {
    center: DVec3,
    radius: f64,
    sides: Sides,
    material: usize,
}

impl Sphere {
    pub fn new(sphere: &scene::Sphere) -> Self {
        Self {
            center: sphere.center.as_dvec3(),
            radius: f64::from(sphere.radius),
            sides: sphere.sides,
            material: sphere.material,
        }
    }

    /// The first root above 0 of t² + 2bt + c = 0, with b = (o − c)·d and c = |o − c|² − r².
    ///
    /// The quarter discriminant b² − c is taken as r² less the squared distance of the ray's line from the
    /// centre, and the roots as q and c/q: the plain formulae cancel for a small sphere far away even in `f64`.
    /// A tangent counts as a hit.
    fn meets(&self, sides: Sides, origin: DVec3, direction: DVec3) -> Option<f64> {
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
        let there = match sides {
            Sides::Both => &[first, second][..],
            Sides::Front => &[first],
            Sides::Back => &[second],
        };
        there.iter().copied().find(|&t| t > 0.0)
    }
}

impl Primitives for scene::Sphere {
    fn add(&self, to: &mut Vec<Box<dyn Primitive>>) {
        to.push(Box::new(Sphere::new(self)));
    }
}

impl Primitive for Sphere {
    fn distance(&self, origin: DVec3, direction: DVec3) -> Option<f64> {
        self.meets(self.sides, origin, direction)
    }

    fn stops(&self, origin: DVec3, direction: DVec3) -> Option<f64> {
        self.meets(Sides::Both, origin, direction)
    }

    fn normal(&self, point: DVec3) -> DVec3 {
        (point - self.center).normalize()
    }

    fn project(&self, point: DVec3) -> DVec3 {
        self.center + self.radius * self.normal(point)
    }

    fn extent(&self) -> f64 {
        self.radius
    }

    fn material(&self) -> usize {
        self.material
    }

    fn uv(&self, point: DVec3) -> DVec2 {
        let n = self.normal(point);
        DVec2::new(turn(n.x, n.z), 0.5 + n.y.clamp(-1.0, 1.0).asin() / PI)
    }

    fn edges(&self, _point: DVec3) -> Edges {
        around(Edge::Point, Edge::Point)
    }

    fn checker(&self, point: DVec3) -> DVec3 {
        point - self.center
    }
}
