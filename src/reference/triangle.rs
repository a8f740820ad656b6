//! Triangles, seen from both sides.
use glam::DVec3;

#[derive(Clone, Debug)]
pub(super) struct Triangle {
    corners: [DVec3; 3],
    /// Unit, (v1 − v0) × (v2 − v0); zero when the triangle has no area.
    pub normal: DVec3,
    pub material: usize,
}

impl Triangle {
    pub fn new(corners: [DVec3; 3], material: usize) -> Self {
        let [a, b, c] = corners;
        Self { corners, normal: (b - a).cross(c - a).normalize_or_zero(), material }
    }

    /// Where the ray meets the triangle's plane, if it passes all edges on the same side.
    ///
    /// The side is the sign of the volume that the direction spans with the edge's two corners, seen from the
    /// origin. It is exactly opposite for two triangles that share the edge, so no ray slips between them. An
    /// edge belongs to the triangle; a triangle without area, or seen edge-on, is never hit.
    pub fn distance(&self, origin: DVec3, direction: DVec3) -> Option<f64> {
        let [a, b, c] = self.corners.map(|corner| corner - origin);
        let sides = [a.cross(b), b.cross(c), c.cross(a)].map(|normal| normal.dot(direction));
        let inside = sides.iter().all(|&s| s >= 0.0) || sides.iter().all(|&s| s <= 0.0);
        let slope = self.normal.dot(direction);
        if !inside || slope == 0.0 {
            return None;
        }
        let t = self.normal.dot(a) / slope;
        (t > 0.0).then_some(t)
    }

    /// The point of the triangle's plane nearest to `point`.
    pub fn project(&self, point: DVec3) -> DVec3 {
        point - self.normal * self.normal.dot(point - self.corners[0])
    }

    pub fn longest_edge(&self) -> f64 {
        let [a, b, c] = self.corners;
        a.distance(b).max(b.distance(c)).max(c.distance(a))
    }
}
