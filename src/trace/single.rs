//! One ray at a time, for drawing and picking: a batch of one.

use glam::Vec3;
use wide::f32x8;

use super::{Blocked, HitBatch, NONE, RayBatch, Scratch, intersect, occluded};
use crate::scene::Scene;

/// One hit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    /// Distance along the unit direction.
    pub t: f32,
    /// The primitive's id; [`Scene::primitive`] tells what it stands for, and [`Scene::surface`] what is there.
    pub primitive: u32,
}

/// Room to trace single rays in, kept from one to the next.
#[derive(Clone, Debug, Default)]
pub struct Probe {
    rays: RayBatch,
    hits: HitBatch,
    blocked: Blocked,
    scratch: Scratch,
}

impl Probe {
    /// Nearest hit of one ray in (0, ∞); `direction` has unit length.
    pub fn intersect(&mut self, scene: &Scene, origin: Vec3, direction: Vec3) -> Option<Hit> {
        self.beyond(scene, origin, direction, 0.0)
    }

    /// Nearest hit in (`t_min`, ∞).
    pub fn beyond(&mut self, scene: &Scene, origin: Vec3, direction: Vec3, t_min: f32) -> Option<Hit> {
        self.aim(origin, direction, t_min, f32::INFINITY);
        // Eight wide for the sake of the scratch; the answer is the same at every width.
        intersect::<f32x8>(scene, &self.rays, &mut self.hits, &mut self.scratch);
        let hit = Hit { t: self.hits.t[0], primitive: self.hits.primitive[0] };
        (hit.primitive != NONE).then_some(hit)
    }

    /// Whether anything lies in (0, t_max) along one ray, on either side of it; `direction` has unit length.
    pub fn occluded(&mut self, scene: &Scene, origin: Vec3, direction: Vec3, t_max: f32) -> bool {
        self.aim(origin, direction, 0.0, t_max);
        self.blocked = Blocked::default();
        occluded::<f32x8>(scene, &self.rays, &mut self.blocked, &mut self.scratch);
        self.blocked.get(0, 1) != 0
    }

    fn aim(&mut self, origin: Vec3, direction: Vec3, t_min: f32, t_max: f32) {
        self.rays.clear();
        self.hits.primitive[0] = NONE;
        self.rays.push(origin, direction, t_min, t_max);
    }
}

/// [`Probe::intersect`] for a single ray.
pub fn intersect_one(scene: &Scene, origin: Vec3, direction: Vec3) -> Option<Hit> {
    Probe::default().intersect(scene, origin, direction)
}

/// [`Probe::occluded`] for a single ray.
pub fn occluded_one(scene: &Scene, origin: Vec3, direction: Vec3, t_max: f32) -> bool {
    Probe::default().occluded(scene, origin, direction, t_max)
}
