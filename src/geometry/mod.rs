//! One file per primitive: storage, tests by named methods, surface point and normal, texture coordinates.
//!
//! A test takes what depends on the ray's origin alone apart (`Seen…`), since rays that share their origin share
//! it too; computed once for a batch or in every lane, it is the same arithmetic and so the same bits.

mod axial;
#[cfg(test)]
mod axial_tests;
mod balls;
mod columns;
pub mod cone;
pub mod cuboid;
pub mod cylinder;
pub(crate) mod face;
mod flat;
pub mod fractal;
mod frame;
pub mod methods;
pub mod plane;
pub mod quad;
pub mod sphere;
pub mod torus;
#[cfg(test)]
mod trial;
pub mod triangle;

pub use balls::Balls;
pub use cone::Cones;
pub use cuboid::Cuboids;
pub use cylinder::Cylinders;
pub use fractal::Fractals;
pub use frame::frame;
pub use plane::Planes;
pub use quad::Quads;
pub use sphere::{SphereRecord, Spheres};
pub use torus::Tori;
pub use triangle::Triangles;

use crate::math::{Lanes, Vec3};

/// The nearest distance inside the interval, where the mask is true; `None` when no lane has one.
pub type Nearest<L> = Option<(L, <L as Lanes>::Mask)>;

/// Which side of a surface is there. A ray that comes from the other passes through.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Sides {
    /// Seen from both sides.
    #[default]
    Both,
    /// Only seen from outside, or where a mesh's corners run counter-clockwise.
    Front,
    /// Only seen from inside, or where they run clockwise.
    Back,
}

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

/// Primitives of one kind in SoA storage, as the queries and the shading see them; i counts from 0 within the kind.
pub trait Primitives {
    /// What the test needs of a primitive, as stored.
    type Record: Copy;
    /// The same as seen from the rays' origins.
    type Seen<L: Lanes>: Copy;
    /// What the test needs of the rays' directions; the directions themselves for most.
    type Aim<L: Lanes>: Copy + From<Vec3<L>>;

    /// The primitives' materials, as indices.
    fn materials(&self) -> &[u32];
    /// The number of primitives.
    #[inline(always)]
    fn len(&self) -> usize {
        self.materials().len()
    }
    /// Whether there is none.
    fn is_empty(&self) -> bool {
        self.len() == 0
    }
    /// Index of the material of primitive `i`.
    #[inline(always)]
    fn material(&self, i: usize) -> u32 {
        self.materials()[i]
    }

    /// Primitive `i` as stored.
    fn record(&self, i: usize) -> Self::Record;
    /// A primitive as seen from `origin`.
    fn seen<L: Lanes>(record: &Self::Record, origin: Vec3<L>) -> Self::Seen<L>;
    /// The same view in every lane.
    fn splat<L: Lanes>(seen: &Self::Seen<f32>) -> Self::Seen<L>;
    /// Prepares unit directions, once for all primitives of the kind.
    #[inline(always)]
    fn aim<L: Lanes>(direction: Vec3<L>) -> Self::Aim<L> {
        direction.into()
    }
    /// The default test: the nearest distance inside (`t_min`, `t_max`). Without `SIDED` all are seen from both sides,
    /// whatever their [`Sides`].
    fn nearest<L: Lanes, const SIDED: bool>(seen: &Self::Seen<L>, aim: &Self::Aim<L>, t_min: L, t_max: L)
    -> Nearest<L>;

    /// The surface of primitive `i` at `point`, which lies near it.
    fn surface<L: Lanes>(&self, i: usize, point: Vec3<L>) -> Surface<L>;
    /// Texture coordinates at a point of the surface.
    fn uv<L: Lanes>(&self, i: usize, surface: &Surface<L>) -> [L; 2];
    /// The coordinates that a checkerboard is laid in; 0 for the third where it is flat.
    fn checker<L: Lanes>(&self, i: usize, surface: &Surface<L>) -> Vec3<L>;
}

/// Primitives that a ball holds, each.
pub trait Bounded: Primitives {
    /// A ball around each primitive.
    fn balls(&self) -> &Balls;
}
