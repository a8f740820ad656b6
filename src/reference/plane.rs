//! The plane p·n + D = 0, seen from both sides.
use super::{Edge, Edges, Primitive, Primitives, axes};
use crate::scene;
use glam::{DVec2, DVec3};

#[derive(Clone, Debug)]
pub(super) struct Plane {
    /// Of unit length.
    normal: DVec3,
    offset: f64,
    material: usize,
}

impl Plane {
    pub fn new(plane: &scene::Plane) -> Self {
        let normal = plane.normal.as_dvec3();
        let length = normal.length();
        Self { normal: normal / length, offset: f64::from(plane.distance) / length, material: plane.material }
    }

    fn height(&self, point: DVec3) -> f64 {
        self.normal.dot(point) + self.offset
    }
}

impl Primitives for scene::Plane {
    fn add(&self, to: &mut Vec<Box<dyn Primitive>>) {
        to.push(Box::new(Plane::new(self)));
    }
}

impl Primitive for Plane {
    /// t = −(n·o + D) / (n·d). A parallel ray hits nothing, not even from within the plane.
    fn distance(&self, origin: DVec3, direction: DVec3) -> Option<f64> {
        let slope = self.normal.dot(direction);
        let t = -self.height(origin) / slope;
        (slope != 0.0 && t > 0.0).then_some(t)
    }

    fn project(&self, point: DVec3) -> DVec3 {
        point - self.normal * self.height(point)
    }

    fn normal(&self, _point: DVec3) -> DVec3 {
        self.normal
    }

    fn extent(&self) -> f64 {
        0.0
    }

    fn material(&self) -> usize {
        self.material
    }

    fn uv(&self, point: DVec3) -> DVec2 {
        let DVec3 { x, y, .. } = self.checker(point);
        DVec2::new(x, -y)
    }

    fn edges(&self, _point: DVec3) -> Edges {
        [[Edge::None; 2]; 2]
    }

    fn checker(&self, point: DVec3) -> DVec3 {
        let [t, b] = axes(self.normal);
        DVec3::new(point.dot(t), point.dot(b), 0.0)
    }
}
