//! One file per primitive: storage, tests by named methods, surface point and normal.
//!
//! A test takes what depends on the ray's origin alone apart (`Seen…`), since rays that share their origin share
//! it too; computed once for a batch or in every lane, it is the same arithmetic and so the same bits.

mod frame;
pub mod plane;
pub mod sphere;
pub mod triangle;

pub use frame::frame;
pub use plane::Planes;
pub use sphere::Spheres;
pub use triangle::Triangles;

use crate::math::{Lanes, Vec3};

/// The nearest distance inside the interval, where the mask is true; `None` when no lane has one.
pub type Nearest<L> = Option<(L, <L as Lanes>::Mask)>;

/// Where a ray meets a primitive, for shading.
#[derive(Clone, Copy, Debug)]
pub struct Surface<L> {
    /// The hit point, moved onto the surface: its distance from it is at most 4 ε · (largest coordinate + reach).
    pub point: Vec3<L>,
    /// Unit geometric normal, outward or as wound.
    pub normal: Vec3<L>,
    /// A length the rounding of the primitive's tests is proportional to: a sphere's radius, a triangle's longest
    /// edge (more for a sliver), nothing for a plane.
    pub reach: f32,
}
