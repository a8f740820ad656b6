//! The answer for one ray: every primitive in turn, by the library's scalar tests, nothing left out.

use glam::Vec3;
use raypacket::geometry::{plane, sphere, triangle};
use raypacket::math::RayBatch;
use raypacket::scene::Scene;
use raypacket::trace::NONE;

/// A ray, and what is wanted of it.
#[derive(Clone, Copy, Debug)]
pub struct Ray {
    pub origin: Vec3,
    pub direction: Vec3,
    pub t_min: f32,
    pub t_max: f32,
}

impl Ray {
    /// Ray `i` of a batch, as the batch says that it is to be read.
    pub fn of(rays: &RayBatch, i: usize) -> Self {
        let at = |columns: &[[f32; 256]; 3], i: usize| Vec3::from_array([0, 1, 2].map(|axis| columns[axis][i]));
        Self {
            origin: at(&rays.origin, if rays.common_origin { 0 } else { i }),
            direction: at(&rays.direction, i),
            t_min: rays.t_min[i],
            t_max: rays.t_max[i],
        }
    }
}

/// What a query has to say about a ray.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Answer {
    /// Nothing: the ray is inactive, and what stood there stays.
    Untouched,
    /// Anything, as the ray is not finite; both queries the same.
    Broken,
    /// This distance and id; (∞, NONE) for a miss.
    Hit(f32, u32),
}

impl Answer {
    pub fn new(scene: &Scene, ray: &Ray) -> Self {
        if ray.t_max < 0.0 || ray.t_max.is_nan() {
            Self::Untouched
        } else if ray.origin.is_finite() && ray.direction.is_finite() {
            let (t, id) = nearest(scene, ray);
            Self::Hit(t, id)
        } else {
            Self::Broken
        }
    }
}

/// Distance and id of an active ray's nearest hit.
fn nearest(scene: &Scene, ray: &Ray) -> (f32, u32) {
    let Ray { origin, direction, t_min, t_max } = *ray;
    let (o, d) = (origin.into(), direction.into());
    let mut best = (t_max, NONE);
    let mut take = |hit: Option<(f32, bool)>, id: usize| {
        // Only a strictly nearer hit replaces one that is there, so the lowest id keeps a tie.
        if let Some((t, true)) = hit.filter(|(t, _)| *t < best.0) {
            best = (t, id as u32);
        }
    };
    let [planes, spheres] = [scene.planes.len(), scene.spheres.len()];
    for i in 0..planes {
        take(plane::nearest::<f32>(&scene.planes.seen(i, o), d, t_min, t_max), i);
    }
    for i in 0..spheres {
        take(sphere::stable::<f32>(&scene.spheres.seen(i, o), d, t_min, t_max), planes + i);
    }
    for i in 0..scene.triangles.len() {
        take(triangle::moller_trumbore::<f32>(&scene.triangles.seen(i, o), d, t_min, t_max), planes + spheres + i);
    }
    if best.1 == NONE { (f32::INFINITY, NONE) } else { best }
}
