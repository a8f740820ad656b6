//! Triangles.
use super::{Edge, Edges, FACE, Primitive, Primitives, axes};
use crate::scene::{Mesh, Sides};
use glam::{DVec2, DVec3};

#[derive(Clone, Debug)]
pub(super) struct Triangle {
    corners: [DVec3; 3],
    /// Unit, (v1 − v0) × (v2 − v0); zero when the triangle has no area.
    normal: DVec3,
    /// At the corners, unit.
    normals: Option<[DVec3; 3]>,
    uvs: Option<[DVec2; 3]>,
    sides: Sides,
    material: usize,
}

impl Triangle {
    /// Triangle `i` of a mesh.
    pub fn new(mesh: &Mesh, i: usize) -> Self {
        let vertices = mesh.triangles[i].map(|v| v as usize);
        let corners = vertices.map(|v| mesh.positions[v].as_dvec3());
        let [a, b, c] = corners;
        Self {
            corners,
            normal: (b - a).cross(c - a).normalize_or_zero(),
            normals: (!mesh.normals.is_empty()).then(|| vertices.map(|v| mesh.normals[v].as_dvec3().normalize())),
            uvs: (!mesh.uvs.is_empty()).then(|| vertices.map(|v| mesh.uvs[v].as_dvec2())),
            sides: mesh.sides,
            material: mesh.materials.get(i).map_or(mesh.material, |&m| m as usize),
        }
    }

    /// The corners as seen from a point.
    fn from(&self, point: DVec3) -> [DVec3; 3] {
        let [a, b, c] = self.corners;
        [a - point, b - point, c - point]
    }

    /// The weights of the corners at a point of the plane: the areas of the triangles opposite to them.
    fn weights(&self, point: DVec3) -> [f64; 3] {
        let [a, b, c] = self.from(point);
        let area = |a: DVec3, b: DVec3| a.cross(b).dot(self.normal);
        let [u, v, w] = [area(b, c), area(c, a), area(a, b)];
        let sum = u + v + w;
        [u / sum, v / sum, w / sum]
    }

    /// Where the ray meets the triangle's plane, if it passes all edges on the same side.
    ///
    /// The side is the sign of the volume that the direction spans with the edge's two corners, seen from the
    /// origin. It is exactly opposite for two triangles that share the edge, so no ray slips between them. An
    /// edge belongs to the triangle; a triangle without area, or seen edge-on, is never hit.
    fn meets(&self, sides: Sides, origin: DVec3, direction: DVec3) -> Option<f64> {
        let [a, b, c] = self.from(origin);
        let volumes = [a.cross(b).dot(direction), b.cross(c).dot(direction), c.cross(a).dot(direction)];
        let inside = volumes.iter().all(|&s| s >= 0.0) || volumes.iter().all(|&s| s <= 0.0);
        let slope = self.normal.dot(direction);
        let there = match sides {
            Sides::Both => slope != 0.0,
            Sides::Front => slope < 0.0,
            Sides::Back => slope > 0.0,
        };
        if !inside || !there {
            return None;
        }
        let t = self.normal.dot(a) / slope;
        (t > 0.0).then_some(t)
    }
}

impl Primitives for Mesh {
    fn add(&self, to: &mut Vec<Box<dyn Primitive>>) {
        (0..self.triangles.len()).for_each(|i| to.push(Box::new(Triangle::new(self, i))));
    }
}

impl Primitive for Triangle {
    fn distance(&self, origin: DVec3, direction: DVec3) -> Option<f64> {
        self.meets(self.sides, origin, direction)
    }

    fn stops(&self, origin: DVec3, direction: DVec3) -> Option<f64> {
        self.meets(Sides::Both, origin, direction)
    }

    fn project(&self, point: DVec3) -> DVec3 {
        point - self.normal * self.normal.dot(point - self.corners[0])
    }

    fn normal(&self, _point: DVec3) -> DVec3 {
        self.normal
    }

    fn shading_normal(&self, point: DVec3) -> DVec3 {
        let Some([a, b, c]) = self.normals else { return self.normal };
        let [u, v, w] = self.weights(point);
        let n = u * a + v * b + w * c;
        // Normals that cancel out leave the triangle's own.
        if n.length_squared() > 1e-12 { n.normalize() } else { self.normal }
    }

    /// The mean, weighed as normals are, of where the point comes to lie when it is moved up onto each tangent plane
    /// that it is beneath.
    fn seen_from(&self, point: DVec3, towards: DVec3) -> DVec3 {
        let Some(normals) = self.normals else { return point };
        let side = if self.shading_normal(point).dot(towards) < 0.0 { -1.0 } else { 1.0 };
        let moved = normals.iter().zip(self.corners).map(|(n, corner)| {
            let height = side * n.dot(point - corner);
            if height < 0.0 { point - height * side * n } else { point }
        });
        moved.zip(self.weights(point)).map(|(place, weight)| weight * place).sum()
    }

    /// The longest edge.
    fn extent(&self) -> f64 {
        let [a, b, c] = self.corners;
        a.distance(b).max(b.distance(c)).max(c.distance(a))
    }

    fn material(&self) -> usize {
        self.material
    }

    fn uv(&self, point: DVec3) -> DVec2 {
        let [a, b, c] = self.uvs.unwrap_or([DVec2::ZERO, DVec2::X, DVec2::Y]);
        let [u, v, w] = self.weights(point);
        u * a + v * b + w * c
    }

    fn edges(&self, _point: DVec3) -> Edges {
        if self.uvs.is_some() { [[Edge::None; 2]; 2] } else { FACE }
    }

    fn checker(&self, point: DVec3) -> DVec3 {
        let [t, b] = axes(self.normal);
        DVec3::new(point.dot(t), point.dot(b), 0.0)
    }
}
