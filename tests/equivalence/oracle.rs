//! The answer for one ray: every primitive in turn, by the library's scalar tests, nothing left out.

use glam::Vec3;
use raypacket::bvh::Aabb;
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
    let boxes = |first: u32| &scene.boxes[(first - scene.first.quads) as usize..];
    let mut best = Best { ray, t: ray.t_max, id: NONE };
    best.among(&scene.planes, 0, &[]);
    best.among(&scene.spheres, scene.first.spheres, &[]);
    best.among(&scene.triangles, scene.first.triangles, &[]);
    best.among(&scene.quads, scene.first.quads, boxes(scene.first.quads));
    best.among(&scene.cuboids, scene.first.cuboids, boxes(scene.first.cuboids));
    best.among(&scene.cylinders, scene.first.cylinders, boxes(scene.first.cylinders));
    best.among(&scene.cones, scene.first.cones, boxes(scene.first.cones));
    best.among(&scene.tori, scene.first.tori, boxes(scene.first.tori));
    best.among(&scene.fractals, scene.first.fractals, boxes(scene.first.fractals));
    best.among(&scene.discs, scene.first.discs, boxes(scene.first.discs));
    if best.id == NONE { (f32::INFINITY, NONE) } else { (best.t, best.id) }
}

struct Best<'a> {
    ray: &'a Ray,
    t: f32,
    id: u32,
}

impl Best<'_> {
    /// Tries all primitives of a kind; of what has `boxes` only hits in there count.
    fn among<K: Primitives>(&mut self, kind: &K, first: u32, boxes: &[Aabb]) {
        for i in 0..kind.len() {
            let within = match boxes.get(i) {
                Some(bounds) => self.within(bounds),
                None => Some((f32::NEG_INFINITY, f32::INFINITY)),
            };
            let Some((enter, exit)) = within else { continue };
            let (origin, direction) = (self.ray.origin.into(), self.ray.direction.into());
            let hit = kind.test::<f32>(i, origin, direction, self.ray.t_min, self.ray.t_max);
            // Only a strictly nearer hit replaces one that is there, so the lowest id keeps a tie.
            let hit = hit.map(|(t, inside)| (t.max(enter).min(exit), inside));
            if let Some((t, true)) = hit.filter(|(t, _)| *t < self.t) {
                (self.t, self.id) = (t, first + i as u32);
            }
        }
    }

    /// Where the ray is in a box that is wider by 32 ε of its farthest corner's distance.
    fn within(&self, bounds: &Aabb) -> Option<(f32, f32)> {
        let (low, high) = (bounds.min - self.ray.origin, bounds.max - self.ray.origin);
        let pad = low.abs().max(high.abs()).max_element() * 16.0 * f32::EPSILON;
        let (mut enter, mut exit) = (f32::NEG_INFINITY, f32::INFINITY);
        for axis in 0..3 {
            let (low, high, d) = (low[axis] - pad, high[axis] + pad, self.ray.direction[axis]);
            let (near, far) = if d < 0.0 { (-high, -low) } else { (low, high) };
            // `max` and `min` pass over NaN, of a ray in a face's plane.
            enter = enter.max(near * (1.0 / d.abs()));
            exit = exit.min(far * (1.0 / d.abs()));
        }
        (enter <= exit && exit > self.ray.t_min && enter < self.t).then_some((enter, exit))
    }
}
