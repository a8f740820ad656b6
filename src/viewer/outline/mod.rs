//! Each kind of primitive as the slice shows it, a file a kind: the outline that a horizontal plane cuts out of it, and
//! how far it spreads on the map.
//!
//! Curves other than circles come as segments. There are as many as the pane can show, and none where it shows
//! nothing, so that the work of a frame is bounded by the primitives' number and the pane's size.

mod cone;
mod cuboid;
mod cylinder;
mod disc;
mod extent;
mod fractal;
mod plane;
mod polygon;
mod quad;
mod revolution;
mod sphere;
mod torus;
mod triangle;

pub use extent::Extent;

use super::section::{Cut, Section};

/// A primitive, or a mesh of them, as the slice shows it.
pub trait Outline {
    /// Hands on what a horizontal plane cuts, as far as it is seen. Of odd numbers come odd ones.
    fn cuts(&self, section: &Section, emit: &mut dyn FnMut(Cut));

    /// How far it spreads in (x, z); none of what has no end, or of nothing.
    fn extent(&self) -> Option<Extent>;
}
