//! Parallelograms: a segment.

use super::polygon::polygon_cut;
use super::{Extent, Outline};
use crate::scene::Quad;
use crate::viewer::section::{Cut, Section};
use glam::Vec3Swizzles;

impl Outline for Quad {
    fn cuts(&self, section: &Section, emit: &mut dyn FnMut(Cut)) {
        polygon_cut(&self.corners(), section.y).into_iter().for_each(emit);
    }

    fn extent(&self) -> Option<Extent> {
        Extent::of(self.corners().map(|p| p.xz()))
    }
}
