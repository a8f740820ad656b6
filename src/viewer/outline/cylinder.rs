//! Cylinders: pieces of ellipses, lines, the caps' chords.

use super::{Extent, Outline, revolution};
use crate::scene::Cylinder;
use crate::viewer::section::{Cut, Section};

impl Outline for Cylinder {
    fn cuts(&self, section: &Section, emit: &mut dyn FnMut(Cut)) {
        revolution::side_cuts([self.base, self.apex], [self.radius; 2], self.caps, section, emit);
    }

    fn extent(&self) -> Option<Extent> {
        Some(revolution::side_extent([self.base, self.apex], [self.radius; 2]))
    }
}
