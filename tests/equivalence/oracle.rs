//! The answer for one ray: every primitive in turn, by the library's scalar tests, nothing left out.

use glam::Vec3;
use raypacket::geometry::Primitives;
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
    let mut best = Best { ray, t: ray.t_max, id: NONE };
    best.among(&scene.planes, 0);
    best.among(&scene.spheres, scene.first.spheres);
    best.among(&scene.triangles, scene.first.triangles);
    best.among(&scene.quads, scene.first.quads);
    best.among(&scene.cuboids, scene.first.cuboids);
    best.among(&scene.cylinders, scene.first.cylinders);
    best.among(&scene.cones, scene.first.cones);
    best.among(&scene.tori, scene.first.tori);
    best.among(&scene.fractals, scene.first.fractals);
    if best.id == NONE { (f32::INFINITY, NONE) } else { (best.t, best.id) }
}

struct Best<'a> {
    ray: &'a Ray,
    t: f32,
    id: u32,
}

impl Best<'_> {
    /// Tries all primitives of a kind.
    fn among<K: Primitives>(&mut self, kind: &K, first: u32) {
        let (origin, aim) = (self.ray.origin.into(), K::aim::<f32>(self.ray.direction.into()));
        for i in 0..kind.len() {
            let seen = K::seen(&kind.record(i), origin);
            // Only a strictly nearer hit replaces one that is there, so the lowest id keeps a tie.
            let hit = K::nearest::<f32, true>(&seen, &aim, self.ray.t_min, self.t);
            if let Some((t, true)) = hit.filter(|(t, _)| *t < self.t) {
                (self.t, self.id) = (t, first + i as u32);
            }
        }
    }
}
