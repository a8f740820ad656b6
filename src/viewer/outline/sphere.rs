//! Spheres: a circle.

use super::{Extent, Outline};
use crate::scene::Sphere;
use crate::viewer::section::{Cut, Section, flat};
use glam::DVec2;

impl Outline for Sphere {
    fn cuts(&self, section: &Section, emit: &mut dyn FnMut(Cut)) {
        let (radius, above) = (f64::from(self.radius), (f64::from(self.center.y) - section.y).abs());
        let squared = (radius - above) * (radius + above);
        if above <= radius {
            emit(Cut::Circle { center: flat(self.center), radius: squared.max(0.0).sqrt() });
        }
    }

    fn extent(&self) -> Option<Extent> {
        Some(Extent::around(flat(self.center), DVec2::splat(self.radius.into())))
    }
}
