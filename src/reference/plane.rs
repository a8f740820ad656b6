//! The plane p·n + D = 0, seen from both sides.
use crate::scene;
use glam::DVec3;

#[derive(Clone, Debug)]
pub(super) struct Plane {
    /// Of unit length.
    pub normal: DVec3,
    offset: f64,
    pub material: usize,
}

impl Plane {
    pub fn new(plane: &scene::Plane) -> Self {
        let normal = plane.normal.as_dvec3();
        let length = normal.length();
        Self { normal: normal / length, offset: f64::from(plane.distance) / length, material: plane.material }
    }

    /// t = −(n·o + D) / (n·d). A parallel ray hits nothing, not even from within the plane.
    pub fn distance(&self, origin: DVec3, direction: DVec3) -> Option<f64> {
        let slope = self.normal.dot(direction);
        let t = -self.height(origin) / slope;
        (slope != 0.0 && t > 0.0).then_some(t)
    }

    /// The point of the plane nearest to `point`.
    pub fn project(&self, point: DVec3) -> DVec3 {
        point - self.normal * self.height(point)
    }

    fn height(&self, point: DVec3) -> f64 {
        self.normal.dot(point) + self.offset
    }
}
