//! Transparent media: what fills the bodies of transparent materials.

use std::ops::Range;

use glam::Vec3;

use super::in_tree::InTree;
use super::{Material, Scene, with_primitive};
use crate::bvh::{Aabb, Source};
use crate::geometry::Primitives;

/// The substance of a transparent solid.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Medium {
    /// Index of refraction.
    pub ior: f32,
    /// Absorption a world unit, by channel.
    pub absorption: Vec3,
    /// A box around all surfaces of it; without an end where one of them is a plane.
    pub bounds: Aabb,
}

/// The media of transparent materials, and which material makes which ([`Scene::medium_of`]).
pub(super) fn media(materials: &[Material]) -> (Vec<Medium>, Vec<u16>) {
    let mut media = vec![Medium { ior: 1.0, absorption: Vec3::ZERO, bounds: Aabb::EMPTY }];
    let number = |m: &Material| {
        if m.transmission <= 0.0 {
            return 0;
        }
        media.push(Medium { ior: m.ior, absorption: m.absorption, bounds: Aabb::EMPTY });
        (media.len() - 1) as u16
    };
    let medium_of = materials.iter().map(number).collect();
    (media, medium_of)
}

impl Scene {
    /// The ids of all primitives.
    pub(crate) fn ids(&self) -> Range<u32> {
        0..self.first.spheres + InTree(self).len() as u32
    }

    /// The medium that the surface of a primitive encloses; 0 for none.
    #[inline]
    pub(crate) fn medium(&self, id: u32) -> u16 {
        self.medium_of[with_primitive!(self, id, |kind, i| kind.material(i)) as usize]
    }

    /// Finds [`Medium::bounds`].
    pub(super) fn bound_media(&mut self) {
        if !self.plan.refracts {
            return;
        }
        let planes = self.first.spheres;
        for id in self.ids() {
            let medium = usize::from(self.medium(id));
            if medium != 0 {
                let bounds = match id.checked_sub(planes) {
                    None => Aabb { min: Vec3::NEG_INFINITY, max: Vec3::INFINITY },
                    Some(i) => InTree(self).bounds(i as usize),
                };
                self.media[medium].bounds = self.media[medium].bounds.union(bounds);
            }
        }
    }
}
