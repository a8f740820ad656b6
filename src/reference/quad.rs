//! Parallelograms.
use super::{Edges, FACE, Primitive, Primitives, axes};
use crate::scene;
use glam::{DMat3, DVec2, DVec3};

#[derive(Clone, Debug)]
pub(super) struct Quad {
    corner: DVec3,
    /// Unit, u × v.
    normal: DVec3,
    /// From the world to (a, b, height) with p = corner + a u + b v + height n.
    coordinates: DMat3,
    size: f64,
    material: usize,
}

impl Quad {
    pub fn new(quad: &scene::Quad) -> Self {
        let [u, v] = [quad.u, quad.v].map(|e| e.as_dvec3());
        let normal = u.cross(v).normalize();
        Self {
            corner: quad.corner.as_dvec3(),
            normal,
            coordinates: DMat3::from_cols(u, v, normal).inverse(),
            size: u.length().max(v.length()),
            material: quad.material,
        }
    }
}

impl Primitives for scene::Quad {
    fn add(&self, to: &mut Vec<Box<dyn Primitive>>) {
        to.push(Box::new(Quad::new(self)));
    }
}

impl Primitive for Quad {
    /// In the quad's own coordinates it is the unit square. Edges belong to it.
    fn distance(&self, origin: DVec3, direction: DVec3) -> Option<f64> {
        let (o, d) = (self.coordinates * (origin - self.corner), self.coordinates * direction);
        let t = -o.z / d.z;
        let unit = 0.0..=1.0;
        let inside = unit.contains(&(o.x + t * d.x)) && unit.contains(&(o.y + t * d.y));
        (d.z != 0.0 && t > 0.0 && inside).then_some(t)
    }

    fn project(&self, point: DVec3) -> DVec3 {
        point - self.normal * self.normal.dot(point - self.corner)
    }

    fn normal(&self, _point: DVec3) -> DVec3 {
        self.normal
    }

    fn extent(&self) -> f64 {
        self.size
    }

    fn material(&self) -> usize {
        self.material
    }

    fn uv(&self, point: DVec3) -> DVec2 {
        (self.coordinates * (point - self.corner)).truncate()
    }

    fn edges(&self, _point: DVec3) -> Edges {
        FACE
    }

    fn checker(&self, point: DVec3) -> DVec3 {
        let [t, b] = axes(self.normal);
        DVec3::new(point.dot(t), point.dot(b), 0.0)
    }
}
