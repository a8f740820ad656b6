//! Meshes: a segment a triangle.

use super::polygon::polygon_cut;
use super::{Extent, Outline};
use crate::scene::Mesh;
use crate::viewer::section::{Cut, Section, flat};

impl Outline for Mesh {
    /// A triangle that names a vertex that does not exist is none.
    fn cuts(&self, section: &Section, emit: &mut dyn FnMut(Cut)) {
        let corner = |i: u32| self.positions.get(i as usize).map(|p| p.as_dvec3());
        let triangle = |&[a, b, c]: &[u32; 3]| polygon_cut(&[corner(a)?, corner(b)?, corner(c)?], section.y);
        self.triangles.iter().filter_map(triangle).for_each(emit);
    }

    fn extent(&self) -> Option<Extent> {
        Extent::of(self.positions.iter().copied().map(flat))
    }
}
