//! Cones and frusta about any axis, open or closed.
use super::{Edge, Edges, FACE, Primitive, Primitives, around, axes, turn};
use crate::scene::{self, Sides};
use glam::{DVec2, DVec3};

/// Heights and coordinates count from the narrow end, so that a tip is exactly where it is.
#[derive(Clone, Debug)]
pub(super) struct Cone {
    narrow: DVec3,
    /// T and B of the description, and the unit axis from the narrow to the wide end.
    frame: [DVec3; 3],
    length: f64,
    /// At the narrow and at the wide end.
    radii: [f64; 2],
    /// Whether the narrow end is the description's apex.
    upright: bool,
    caps: bool,
    sides: Sides,
    material: usize,
}

/// The nearest part of a cone.
enum Part {
    Side,
    Narrow,
    Wide,
}

impl Cone {
    pub fn new(it: &scene::Cone) -> Self {
        let [base, apex] = [it.base, it.apex].map(|p| p.as_dvec3());
        let [base_radius, apex_radius] = [it.base_radius, it.apex_radius].map(f64::from);
        let axis = (apex - base).normalize();
        let [t, b] = axes(axis);
        let upright = apex_radius < base_radius;
        Self {
            narrow: if upright { apex } else { base },
            frame: [t, b, if upright { -axis } else { axis }],
            length: (apex - base).length(),
            radii: [base_radius.min(apex_radius), base_radius.max(apex_radius)],
            upright,
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

    /// Above the description's base.
    fn height(&self, q: DVec3) -> f64 {
        if self.upright { self.length - q.z } else { q.z }
    }

    /// The growth of the radius per unit of height.
    fn slope(&self) -> f64 {
        (self.radii[1] - self.radii[0]) / self.length
    }

    /// A point's distance from the side, above 0 outside.
    fn outside(&self, q: DVec3) -> f64 {
        let radius = self.radii[0] + self.slope() * q.z;
        (q.truncate().length() - radius) / self.slope().hypot(1.0)
    }

    fn part(&self, point: DVec3) -> Part {
        let q = self.along(point - self.narrow);
        let end = |radius: f64, height: f64| if radius > 0.0 { height.abs() } else { f64::INFINITY };
        let (narrow, wide) = (end(self.radii[0], q.z), end(self.radii[1], q.z - self.length));
        match () {
            _ if !self.caps || self.outside(q).abs() <= narrow.min(wide) => Part::Side,
            _ if narrow < wide => Part::Narrow,
            _ => Part::Wide,
        }
    }

    /// Where the line meets the endless double cone x² + y² = (r + m z)², in its own coordinates.
    ///
    /// With R = r + m z and G = m d_z: a = d_x² + d_y² − G², b = x d_x + y d_y − R G, c = x² + y² − R². The discriminant
    /// b² − a c is expanded into differences that are small where the line passes close to the tip, so that it does not
    /// cancel for a distant origin. A tangent counts as a hit.
    fn roots(&self, o: DVec3, d: DVec3) -> Vec<f64> {
        let (p, radius) = (o.truncate(), self.radii[0] + self.slope() * o.z);
        let (d, growth) = (d.truncate(), self.slope() * d.z);
        let a = (d.length() - growth) * (d.length() + growth);
        let b = p.dot(d) - radius * growth;
        let c = (p.length() - radius) * (p.length() + radius);
        let discriminant = (growth * p - radius * d).length_squared() - p.perp_dot(d).powi(2);
        if discriminant < 0.0 {
            return Vec::new();
        }
        let q = if b > 0.0 { -b - discriminant.sqrt() } else { -b + discriminant.sqrt() };
        // Parallel to the slant there is one root; from the tip itself both are 0.
        let roots = [if q == 0.0 { 0.0 } else { c / q }, q / a];
        roots.into_iter().filter(|t| t.is_finite()).collect()
    }

    /// Whether a point of the endless cone lies between the ends: by its height, or by its radius on a flat cone, where
    /// that says it more precisely.
    fn between_ends(&self, q: DVec3) -> bool {
        let [r0, r1] = self.radii;
        if self.slope() <= 1.0 {
            return (0.0..=self.length).contains(&q.z);
        }
        let this_side = r0 + self.slope() * q.z >= 0.0;
        this_side && (r0..=r1).contains(&q.truncate().length())
    }

    /// The nearest of: the side's roots between the ends, the ends' planes within their radii. From outside the
    /// direction runs against the outward normal.
    fn meets(&self, sides: Sides, origin: DVec3, direction: DVec3) -> Option<f64> {
        let (o, d) = (self.along(origin - self.narrow), self.along(direction));
        let side = self.roots(o, d).into_iter().map(|t| (t, o + t * d)).filter(|(_, q)| self.between_ends(*q));
        // The gradient of x² + y² − (r + m z)².
        let outward = |q: DVec3| q.truncate().extend(-self.slope() * (self.radii[0] + self.slope() * q.z));
        let side = side.map(|(t, q)| (t, outward(q).dot(d) < 0.0));
        let ends = [(-o.z, d.z > 0.0, self.radii[0]), (self.length - o.z, d.z < 0.0, self.radii[1])];
        let ends = ends.map(|(height, from_outside, radius)| (height / d.z, from_outside, radius));
        let within = |t: f64, radius: f64| d.z != 0.0 && (o + t * d).truncate().length() <= radius;
        let ends = ends.into_iter().filter(|(t, _, radius)| self.caps && within(*t, *radius));
        let there = |from_outside: bool| match sides {
            Sides::Both => true,
            Sides::Front => from_outside,
            Sides::Back => !from_outside,
        };
        let ends = ends.map(|(t, from_outside, _)| (t, from_outside));
        side.chain(ends).filter(|(t, from_outside)| *t > 0.0 && there(*from_outside)).map(|(t, _)| t).reduce(f64::min)
    }
}

impl Primitives for scene::Cone {
    fn add(&self, to: &mut Vec<Box<dyn Primitive>>) {
        to.push(Box::new(Cone::new(self)));
    }
}

impl Primitive for Cone {
    fn distance(&self, origin: DVec3, direction: DVec3) -> Option<f64> {
        self.meets(self.sides, origin, direction)
    }

    fn stops(&self, origin: DVec3, direction: DVec3) -> Option<f64> {
        self.meets(Sides::Both, origin, direction)
    }

    fn project(&self, point: DVec3) -> DVec3 {
        let q = self.along(point - self.narrow);
        let off = match self.part(point) {
            Part::Side => self.outside(q),
            Part::Narrow => -q.z,
            Part::Wide => q.z - self.length,
        };
        point - off * self.normal(point)
    }

    fn normal(&self, point: DVec3) -> DVec3 {
        let [t, b, axis] = self.frame;
        let q = self.along(point - self.narrow);
        match self.part(point) {
            Part::Side => ((q.x * t + q.y * b).normalize_or(t) - self.slope() * axis).normalize(),
            Part::Narrow => -axis,
            Part::Wide => axis,
        }
    }

    /// From the middle of the narrow end to the wide rim.
    fn extent(&self) -> f64 {
        self.length.hypot(self.radii[1])
    }

    fn material(&self) -> usize {
        self.material
    }

    fn uv(&self, point: DVec3) -> DVec2 {
        let q = self.along(point - self.narrow);
        match self.part(point) {
            Part::Side => DVec2::new(turn(q.x, q.y), self.height(q) / self.length),
            Part::Narrow => 0.5 + q.truncate() / (2.0 * self.radii[0]),
            Part::Wide => 0.5 + q.truncate() / (2.0 * self.radii[1]),
        }
    }

    fn edges(&self, point: DVec3) -> Edges {
        let end = |radius: f64| if radius > 0.0 { Edge::Border } else { Edge::Point };
        let [narrow, wide] = self.radii.map(end);
        match self.part(point) {
            Part::Side if self.upright => around(wide, narrow),
            Part::Side => around(narrow, wide),
            _ => FACE,
        }
    }

    fn checker(&self, point: DVec3) -> DVec3 {
        let q = self.along(point - self.narrow);
        match self.part(point) {
            Part::Side => q.truncate().extend(self.height(q)),
            _ => q.truncate().extend(0.0),
        }
    }
}
