//! Planes: an endless line.

use super::{Extent, Outline};
use crate::scene::Plane;
use crate::viewer::section::{Cut, Section, flat};

impl Outline for Plane {
    /// Nothing when the plane is parallel to the slice.
    fn cuts(&self, section: &Section, emit: &mut dyn FnMut(Cut)) {
        let normal = self.normal.as_dvec3();
        let across = flat(self.normal);
        let (length, offset) = (across.length_squared(), f64::from(self.distance) + normal.y * section.y);
        // A nearly parallel plane is cut far away, where clipping leaves it out.
        if length > 0.0 {
            emit(Cut::Line { point: across * (-offset / length), direction: across.perp() });
        }
    }

    fn extent(&self) -> Option<Extent> {
        None
    }
}
