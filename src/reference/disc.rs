//! Discs, with or without a hole.
use super::{Edge, Edges, Primitive, Primitives, around, axes, turn};
use crate::scene;
use glam::{DMat3, DVec2, DVec3};

#[derive(Clone, Debug)]
pub(super) struct Disc {
    center: DVec3,
    /// Unit.
    normal: DVec3,
    /// From the world's axes to T, B and the normal.
    turned: DMat3,
    inner: f64,
    radius: f64,
    material: usize,
}

impl Disc {
    pub fn new(it: &scene::Disc) -> Self {
        let normal = it.normal.as_dvec3().normalize();
        let [t, b] = axes(normal);
        Self {
            center: it.center.as_dvec3(),
            normal,
            turned: DMat3::from_cols(t, b, normal).transpose(),
            inner: f64::from(it.inner_radius),
            radius: f64::from(it.radius),
            material: it.material,
        }
    }

    /// A point's coordinates along T, B and the normal, from the middle.
    fn local(&self, point: DVec3) -> DVec3 {
        self.turned * (point - self.center)
    }
}

impl Primitives for scene::Disc {
    fn add(&self, to: &mut Vec<Box<dyn Primitive>>) {
        to.push(Box::new(Disc::new(self)));
    }
}

impl Primitive for Disc {
    /// In the disc's own axes it lies at height 0, and the distance from the middle is one in two dimensions. Edges
    /// belong to it.
    fn distance(&self, origin: DVec3, direction: DVec3) -> Option<f64> {
        let (o, d) = (self.local(origin), self.turned * direction);
        let t = -o.z / d.z;
        let out = (o.x + t * d.x).hypot(o.y + t * d.y);
        (d.z != 0.0 && t > 0.0 && (self.inner..=self.radius).contains(&out)).then_some(t)
    }

    fn project(&self, point: DVec3) -> DVec3 {
        point - self.normal * self.local(point).z
    }

    fn normal(&self, _point: DVec3) -> DVec3 {
        self.normal
    }

    fn extent(&self) -> f64 {
        self.radius
    }

    fn material(&self) -> usize {
        self.material
    }

    fn uv(&self, point: DVec3) -> DVec2 {
        let q = self.local(point).truncate();
        DVec2::new(turn(q.x, q.y), (q.length() - self.inner) / (self.radius - self.inner))
    }

    fn edges(&self, _point: DVec3) -> Edges {
        around(if self.inner > 0.0 { Edge::Border } else { Edge::Point }, Edge::Border)
    }

    fn checker(&self, point: DVec3) -> DVec3 {
        self.local(point).truncate().extend(0.0)
    }
}
