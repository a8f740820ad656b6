//! One eye ray and all that follows from it, segment by segment; for drawing.

use super::around::around;
use super::medium::{Deeper, MediumStack, Passage};
use super::refract::split;
use super::spawn::{self, Offsets};
use super::surface::{smooth, start, surface};
use crate::geometry::Surface;
use crate::math::Vec3 as Lane3;
use crate::scene::{MIN_WEIGHT, Scene, ShadowStart};
use crate::trace::Probe;
use glam::Vec3;

/// The kind of a path's segment.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SegmentKind {
    /// From the eye.
    Primary,
    /// From a hit point to a light that it faces.
    Shadow {
        /// Whether something lies between them.
        blocked: bool,
    },
    /// From a mirror.
    Reflection,
    /// Through a transparent surface.
    Refraction,
}

/// One straight piece of the light paths that one eye ray sets off.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Segment {
    /// Its kind.
    pub kind: SegmentKind,
    /// Where it starts.
    pub from: Vec3,
    /// Where it ends; None when it leaves the scene.
    pub to: Option<Vec3>,
    /// Its unit direction.
    pub direction: Vec3,
}

/// The most segments of one path: where reflections and refractions branch, the rest is not drawn.
const MAX_SEGMENTS: usize = 1000;

/// The segments an eye ray sets off: first the eye ray's, then those of every further ray before those that it sets
/// off itself. The first thousand are followed; absorption is not taken into account.
pub fn path(scene: &Scene, origin: Vec3, direction: Vec3) -> Vec<Segment> {
    let mut deeper = Deeper::default();
    let inside = match scene.plan.refracts {
        true => around(scene, origin, &mut deeper),
        false => MediumStack::default(),
    };
    let mut tree = Tree { scene, probe: Probe::default(), deeper, segments: Vec::new(), waiting: Vec::new() };
    tree.waiting.push(Ray { kind: SegmentKind::Primary, origin, direction, inside, weight: 1.0, depth: 1 });
    while let Some(ray) = tree.waiting.pop().filter(|_| tree.segments.len() < MAX_SEGMENTS) {
        tree.follow(&ray);
    }
    tree.segments
}

/// A ray on its way.
struct Ray {
    kind: SegmentKind,
    origin: Vec3,
    direction: Vec3,
    inside: MediumStack,
    weight: f32,
    depth: u32,
}

/// A path while it is followed.
struct Tree<'a> {
    scene: &'a Scene,
    probe: Probe,
    deeper: Deeper,
    segments: Vec<Segment>,
    waiting: Vec<Ray>,
}

/// Where a ray arrived, with both normals turned against it.
struct Arrival {
    point: Lane3<f32>,
    normal: Lane3<f32>,
    geometric: Lane3<f32>,
    /// From where it sees lights.
    raised: Lane3<f32>,
    lift: f32,
}

impl Tree<'_> {
    fn follow(&mut self, ray: &Ray) {
        let Ray { kind, origin: from, direction, .. } = *ray;
        let Some(hit) = self.probe.intersect(self.scene, from, direction) else {
            self.segments.push(Segment { kind, from, to: None, direction });
            return;
        };
        let (s, material) = surface::<f32>(self.scene, hit.primitive, (from + direction * hit.t).into());
        self.segments.push(Segment { kind, from, to: Some(s.point.into()), direction });
        let front = Vec3::from(s.normal).dot(direction) <= 0.0;
        let facing = |n: Lane3<f32>| if front { n } else { -n };
        let geometric = facing(s.normal);
        let smooth = smooth(self.scene, hit.primitive, &Surface { normal: geometric, ..s });
        let raised = match smooth.filter(|_| self.scene.plan.raised) {
            Some([_, rise]) => spawn::raise(s.point, rise, geometric),
            None => s.point,
        };
        let transparent = self.scene.medium_of[material as usize] != 0;
        let (point, coordinate) = start(self.scene, hit.primitive, &s, transparent);
        let arrival = Arrival {
            point,
            normal: smooth.map_or(geometric, |[normal, _]| normal),
            geometric,
            raised,
            lift: Offsets::of(&self.scene.plan.methods).lift_by::<f32>(coordinate, s.reach),
        };
        self.shadows(&arrival);
        if ray.depth < self.scene.plan.waves {
            self.go_on(ray, &arrival, material as usize, front);
        }
    }

    fn shadows(&mut self, at: &Arrival) {
        for (light, start) in self.scene.lights.iter().zip(&self.scene.plan.shadows) {
            let spawn = match start {
                ShadowStart::Light => spawn::shadow_from_light::<f32>,
                ShadowStart::Point => spawn::shadow_from_point::<f32>,
            };
            let ray =
                spawn(&Offsets::of(&self.scene.plan.methods), light.position.into(), at.raised, at.geometric, at.lift);
            let from = Vec3::from(at.raised);
            let direction = (light.position - from).normalize();
            let faces = !self.scene.plan.smooth || Vec3::from(at.normal).dot(direction) > 0.0;
            if (ray.cosine > 0.0 || self.scene.plan.raised) && faces {
                let blocked = self.probe.occluded(self.scene, ray.origin.into(), ray.direction.into(), ray.t_max);
                let kind = SegmentKind::Shadow { blocked };
                self.segments.push(Segment { kind, from, to: Some(light.position), direction });
            }
        }
    }

    /// Adds the reflected and the refracted ray, of which the first is followed first.
    fn go_on(&mut self, ray: &Ray, at: &Arrival, material: usize, front: bool) {
        let m = &self.scene.materials[material];
        let passage = Passage::new(self.scene, ray.inside, self.scene.medium_of[material], front, &mut self.deeper);
        let parts = [m.reflectance, m.transmission].map(|part| part * ray.weight);
        let direction = Lane3::from(ray.direction);
        let split = split::<f32>(direction, at.normal, Some(at.geometric), passage.eta, parts, m.additive);
        let least = if self.scene.plan.refracts { MIN_WEIGHT } else { f32::MIN_POSITIVE };
        let mut add = |kind, lift: f32, direction: Lane3<f32>, inside, weight| {
            if weight >= least {
                let origin = at.geometric.mul_add(lift, at.point).into();
                let depth = ray.depth + 1;
                self.waiting.push(Ray { kind, origin, direction: direction.into(), inside, weight, depth });
            }
        };
        add(SegmentKind::Refraction, -at.lift, split.refracted, passage.inside, split.transmitted);
        add(SegmentKind::Reflection, at.lift, split.reflected, ray.inside, split.mirror);
    }
}
