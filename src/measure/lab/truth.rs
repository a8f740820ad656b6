//! The exact nearest hits of a whole scene.

use glam::DVec3;
use rayon::prelude::*;

use crate::measure::cases::Ray;
use crate::measure::oracle::{self, Shape, Truth};
use crate::scene::Description;

/// ε, the unit roundoff of `f32`.
const ROUNDOFF: f64 = 0.5 * f32::EPSILON as f64;

/// The nearest hit of every ray, in the caller's rayon pool.
pub fn of(description: &Description, rays: &[Ray]) -> Vec<Option<Truth>> {
    let shapes = oracle::shapes(description);
    rays.par_iter().map(|ray| nearest(&shapes, ray)).collect()
}

fn nearest(shapes: &[Shape], ray: &Ray) -> Option<Truth> {
    let asked = oracle::Ray::new(ray.origin, ray.direction);
    let [t_min, t_max] = [ray.t_min, ray.t_max].map(f64::from);
    let near = shapes.iter().filter(|shape| may_hit(shape, ray));
    let hits = near.filter_map(|shape| oracle::nearest(shape, &asked, t_min, t_max));
    hits.min_by(|a, b| a.t.total_cmp(&b.t))
}

/// False for a triangle that the ray passes for certain: the oracle takes too long to ask it about a whole mesh.
fn may_hit(shape: &Shape, ray: &Ray) -> bool {
    let Shape::Triangle(triangle) = shape else { return true };
    let corners = triangle.corners.map(|c| c.as_dvec3());
    let center: DVec3 = corners.into_iter().sum::<DVec3>() / 3.0;
    let radius = corners.map(|c| c.distance(center)).into_iter().fold(0.0, f64::max);
    let (origin, direction) = ray.line();
    let to = center - origin;
    // A million times what f64 rounds, and NaN counts as a hit.
    let slack = 1e-9 * (to.length() + center.length() + radius);
    let apart = to.cross(direction).length();
    apart <= radius + slack || apart.is_nan()
}

/// Whether the answer to a ray that was decided wrongly is not a matter of rounding: it stays what it is when the ray
/// moves aside by 4 ε of the hit's distance and of the origin's largest coordinate.
///
/// Only for scenes of one primitive; next to an edge that two triangles share, neither's own answer is settled.
pub fn settled(shape: &Shape, ray: &Ray, t: f64) -> bool {
    let largest = f64::from(ray.origin.abs().max_element());
    let width = 4.0 * ROUNDOFF * (t.abs() + largest);
    let asked = oracle::Ray::new(ray.origin, ray.direction);
    oracle::settled(shape, &asked, ray.t_min.into(), ray.t_max.into(), width)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measure::cases;

    /// Leaving triangles out changes no answer.
    #[test]
    fn a_mesh_is_judged_as_all_of_its_triangles() {
        for (name, dial) in [("mesh-moved", 1e3), ("mesh-far", 1e4), ("triangle-vertex", 1e-5)] {
            let case = cases::find(name).unwrap().make(dial, 12, 5);
            let shapes = oracle::shapes(&case.description);
            let found = of(&case.description, &case.rays);
            assert!(found.iter().flatten().count() > 2, "{name}");
            for (ray, found) in case.rays.iter().zip(found) {
                let asked = oracle::Ray::new(ray.origin, ray.direction);
                let all = shapes.iter().filter_map(|s| oracle::nearest(s, &asked, 0.0, f64::INFINITY));
                assert_eq!(all.map(|t| t.t).min_by(f64::total_cmp), found.map(|t| t.t), "{name} {ray:?}");
            }
        }
    }
}
