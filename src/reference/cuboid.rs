//! Not traced yet.
use super::Primitive;
use crate::scene;
use glam::{DVec2, DVec3};

#[derive(Clone, Debug)]
pub(super) struct Cuboid {
    material: usize,
}

impl Cuboid {
    pub fn new(it: &scene::Cuboid) -> Self {
        Self { material: it.material }
    }
}

impl Primitive for Cuboid {
    fn distance(&self, _origin: DVec3, _direction: DVec3) -> Option<f64> {
        None
    }

    fn project(&self, point: DVec3) -> DVec3 {
        point
    }

    fn normal(&self, point: DVec3) -> DVec3 {
        point
    }

    fn extent(&self) -> f64 {
        0.0
    }

    fn material(&self) -> usize {
        self.material
    }

    fn uv(&self, _point: DVec3) -> DVec2 {
        DVec2::ZERO
    }

    fn checker(&self, point: DVec3) -> DVec3 {
        point
    }
}
