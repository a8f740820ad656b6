//! Cylinders about any axis, open or closed.
use super::{Edge, Edges, FACE, Primitive, Primitives, around, axes, turn};
use crate::scene::{self, Sides};
use glam::{DVec2, DVec3};

#[derive(Clone, Debug)]
pub(super) struct Cylinder {
    base: DVec3,
    /// T, B and the unit axis.
    frame: [DVec3; 3],
    length: f64,
    radius: f64,
    caps: bool,
    sides: Sides,
    material: usize,
}

/// The nearest part of a cylinder.
enum Part {
    Side,
    Base,
    Apex,
}

impl Cylinder {
    pub fn new(it: &scene::Cylinder) -> Self {
        let base = it.base.as_dvec3();
        let along = it.apex.as_dvec3() - base;
        let [t, b] = axes(along.normalize());
        Self {
            base,
            frame: [t, b, along.normalize()],
            length: along.length(),
            radius: f64::from(it.radius),
            caps: it.caps,
            sides: it.sides,
            material: it.material,
        }
    }

    /// Along T, B and the axis, of a vector.
    fn along(&self, v: DVec3) -> DVec3 {
        let [x, y, z] = self.frame;
        DVec3::new(x.dot(v), y.dot(v), z.dot(v))
    }

    fn part(&self, point: DVec3) -> Part {
        let q = self.along(point - self.base);
        let [side, base, apex] = [q.truncate().length() - self.radius, q.z, q.z - self.length].map(f64::abs);
        match () {
            _ if !self.caps || side <= base.min(apex) => Part::Side,
            _ if base < apex => Part::Base,
            _ => Part::Apex,
        }
    }

    /// Where the line enters and leaves the endless cylinder, as often as it does.
    ///
    /// The quadratic in the plane across the axis; its discriminant is r² less the squared distance of the line from the
    /// axis, and the roots are q and c/q, as in [`super::sphere`]. A tangent counts as a hit.
    fn roots(&self, o: DVec3, d: DVec3) -> Option<[f64; 2]> {
        let (p, across) = (o.truncate(), d.truncate().length());
        if across == 0.0 {
            return None;
        }
        let d = d.truncate() / across;
        let b = p.dot(d);
        let discriminant = self.radius * self.radius - p.perp_dot(d).powi(2);
        if discriminant < 0.0 {
            return None;
        }
        let c = (p.length() - self.radius) * (p.length() + self.radius);
        let root = discriminant.sqrt();
        let q = if b > 0.0 { -b - root } else { -b + root };
        // A tangent at the origin has both roots there.
        let other = if q == 0.0 { 0.0 } else { c / q };
        Some([q.min(other) / across, q.max(other) / across])
    }

    /// The nearest of: the side's roots between the ends, the ends' planes within the radius. From outside the
    /// direction runs against the outward normal.
    fn meets(&self, sides: Sides, origin: DVec3, direction: DVec3) -> Option<f64> {
        let (o, d) = (self.along(origin - self.base), self.along(direction));
        let side = self.roots(o, d).into_iter().flat_map(|[enter, leave]| [(enter, true), (leave, false)]);
        let side = side.filter(|(t, _)| (0.0..=self.length).contains(&(o.z + t * d.z)));
        let ends = [(-o.z / d.z, d.z > 0.0), ((self.length - o.z) / d.z, d.z < 0.0)];
        let within = |t: f64| d.z != 0.0 && (o + t * d).truncate().length() <= self.radius;
        let ends = ends.into_iter().filter(|(t, _)| self.caps && within(*t));
        let there = |from_outside: bool| match sides {
            Sides::Both => true,
            Sides::Front => from_outside,
            Sides::Back => !from_outside,
        };
        side.chain(ends).filter(|(t, from_outside)| *t > 0.0 && there(*from_outside)).map(|(t, _)| t).reduce(f64::min)
    }
}

impl Primitives for scene::Cylinder {
    fn add(&self, to: &mut Vec<Box<dyn Primitive>>) {
        to.push(Box::new(Cylinder::new(self)));
    }
}

impl Primitive for Cylinder {
    fn distance(&self, origin: DVec3, direction: DVec3) -> Option<f64> {
        self.meets(self.sides, origin, direction)
    }

    fn stops(&self, origin: DVec3, direction: DVec3) -> Option<f64> {
        self.meets(Sides::Both, origin, direction)
    }

    fn project(&self, point: DVec3) -> DVec3 {
        let q = self.along(point - self.base);
        let off = match self.part(point) {
            Part::Side => q.truncate().length() - self.radius,
            Part::Base => -q.z,
            Part::Apex => q.z - self.length,
        };
        point - off * self.normal(point)
    }

    fn normal(&self, point: DVec3) -> DVec3 {
        let [t, b, axis] = self.frame;
        let q = self.along(point - self.base);
        match self.part(point) {
            Part::Side => (q.x * t + q.y * b).normalize_or(t),
            Part::Base => -axis,
            Part::Apex => axis,
        }
    }

    /// From the middle of an end to the other's rim.
    fn extent(&self) -> f64 {
        self.length.hypot(self.radius)
    }

    fn material(&self) -> usize {
        self.material
    }

    fn uv(&self, point: DVec3) -> DVec2 {
        let q = self.along(point - self.base);
        match self.part(point) {
            Part::Side => DVec2::new(turn(q.x, q.y), q.z / self.length),
            _ => 0.5 + q.truncate() / (2.0 * self.radius),
        }
    }

    fn edges(&self, point: DVec3) -> Edges {
        if matches!(self.part(point), Part::Side) { around(Edge::Border, Edge::Border) } else { FACE }
    }

    fn checker(&self, point: DVec3) -> DVec3 {
        let q = self.along(point - self.base);
        match self.part(point) {
            Part::Side => q,
            _ => q.truncate().extend(0.0),
        }
    }
}
