//! One eye ray and all that follows from it, segment by segment; for drawing.

use super::spawn;
use super::surface::surface;
use crate::math::Vec3 as Lane3;
use crate::scene::{Scene, ShadowStart};
use crate::trace::Probe;
use glam::Vec3;

/// What a segment of a path is.
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
}

/// One straight piece of the light paths that one eye ray sets off.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Segment {
    /// What it is.
    pub kind: SegmentKind,
    /// Where it starts.
    pub from: Vec3,
    /// Where it ends; None when it leaves the scene.
    pub to: Option<Vec3>,
    /// Its unit direction.
    pub direction: Vec3,
}

/// All segments an eye ray sets off, in the order they are traced.
pub fn path(scene: &Scene, origin: Vec3, direction: Vec3) -> Vec<Segment> {
    let mut probe = Probe::default();
    let mut segments = Vec::new();
    let (mut from, mut direction) = (origin, direction);
    let mut kind = SegmentKind::Primary;
    for depth in 1..=scene.plan.waves {
        let hit = probe.intersect(scene, from, direction);
        let Some(hit) = hit else {
            segments.push(Segment { kind, from, to: None, direction });
            break;
        };
        let (s, material) = surface::<f32>(scene, hit.primitive, (from + direction * hit.t).into());
        let (point, normal) = (Vec3::from(s.point), Vec3::from(s.normal));
        segments.push(Segment { kind, from, to: Some(point), direction });
        let normal = if normal.dot(direction) > 0.0 { -normal } else { normal };
        let lift = spawn::lift::<f32>(s.point, s.reach);
        for (light, start) in scene.lights.iter().zip(&scene.plan.shadows) {
            let spawn = match start {
                ShadowStart::Light => spawn::shadow_from_light::<f32>,
                ShadowStart::Point => spawn::shadow_from_point::<f32>,
            };
            let ray = spawn(light.position.into(), s.point, normal.into(), lift);
            if ray.cosine > 0.0 {
                let blocked = probe.occluded(scene, ray.origin.into(), ray.direction.into(), ray.t_max);
                let direction = (light.position - point).normalize();
                let kind = SegmentKind::Shadow { blocked };
                segments.push(Segment { kind, from: point, to: Some(light.position), direction });
            }
        }
        if depth == scene.plan.waves || scene.materials[material as usize].reflectance <= 0.0 {
            break;
        }
        let (o, d) = spawn::reflected::<f32>(Lane3::from(direction), s.point, normal.into(), lift);
        (from, direction, kind) = (o.into(), d.into(), SegmentKind::Reflection);
    }
    segments
}
