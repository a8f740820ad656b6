//! Boxes: a segment a face.

use super::polygon::polygon_cut;
use super::{Extent, Outline};
use crate::scene::Cuboid;
use crate::viewer::section::{Cut, Section};
use glam::Vec3Swizzles;

impl Outline for Cuboid {
    fn cuts(&self, section: &Section, emit: &mut dyn FnMut(Cut)) {
        let (min, max) = (self.min.as_dvec3(), self.max.as_dvec3());
        if !section.meets((min + max) / 2.0, (max - min).length() / 2.0) {
            return;
        }
        let corners = self.corners();
        for [a, b] in [[1, 2], [2, 4], [4, 1]] {
            let opposite = 7 - a - b;
            for first in [0, opposite] {
                let face = [first, first + a, first + a + b, first + b].map(|i| corners[i]);
                polygon_cut(&face, section.y).into_iter().for_each(&mut *emit);
            }
        }
    }

    fn extent(&self) -> Option<Extent> {
        Extent::of(self.corners().map(|p| p.xz()))
    }
}
