//! Cones and frusta: pieces of conic sections, the caps' chords.

use super::{Extent, Outline, revolution};
use crate::scene::Cone;
use crate::viewer::section::{Cut, Section};

impl Outline for Cone {
    fn cuts(&self, section: &Section, emit: &mut dyn FnMut(Cut)) {
        let radii = [self.base_radius, self.apex_radius];
        revolution::side_cuts([self.base, self.apex], radii, self.caps, section, emit);
    }

    fn extent(&self) -> Option<Extent> {
        Some(revolution::side_extent([self.base, self.apex], [self.base_radius, self.apex_radius]))
    }
}
