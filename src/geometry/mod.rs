//! One file per primitive: storage, tests by named methods, surface point and normal, texture coordinates.
//!
//! A test takes what depends on the ray's origin alone apart ([`Primitives::Seen`]), since rays that share their origin
//! share it too; computed once for a batch or in every lane, it is the same arithmetic and so the same bits.

mod axial;
#[cfg(test)]
mod axial_tests;
mod balls;
mod columns;
pub mod cone;
pub mod cuboid;
pub mod cylinder;
pub mod disc;
#[cfg(test)]
mod edge_on_tests;
pub(crate) mod face;
mod flat;
pub mod fractal;
mod frame;
mod mapping;
pub mod methods;
pub(crate) mod numbers;
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
pub use disc::Discs;
pub use fractal::Fractals;
pub use frame::frame;
pub use mapping::Mapping;
pub use plane::Planes;
pub use quad::Quads;
pub use sphere::Spheres;
pub use torus::Tori;
pub use triangle::Triangles;

use crate::math::{Lanes, Vec3};

/// The nearest distance inside the interval, where the mask is true; `None` when no lane has one.
pub type LaneHits<L> = Option<(L, <L as Lanes>::Mask)>;

/// Which side of a surface is there. A ray that looks for the nearest hit and comes from the other passes through; light
/// is stopped by both ([`crate::trace::occluded()`]), so that a shadow is the same whichever way its ray runs.
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

/// Where a ray goes on that passes through a surface, if the rounding along the normal is all that matters there.
#[derive(Clone, Copy, Debug)]
pub struct Footing<L> {
    /// The hit point, off edges by more than its rounding.
    pub point: Vec3<L>,
    /// What the rounding along the surface adds to that along the normal: half of its square times this.
    pub curvature: f32,
}

/// A number of a primitive: one, lanes, or a column of a block.
pub trait Number: Copy + Send + Sync {}

impl<T: Copy + Send + Sync> Number for T {}

/// The variant of a primitive within its kind, beside its numbers: all of a block have it in common, so that a test
/// chooses once for all lanes.
pub trait Variant: Copy + Default + PartialEq + std::fmt::Debug + Send + Sync {
    /// A number below 32, another for each.
    fn code(self) -> u8;
    /// The same with all of its sides there.
    #[inline(always)]
    fn both_sides(self) -> Self {
        self
    }
}

/// None.
impl Variant for () {
    fn code(self) -> u8 {
        0
    }
}

impl Variant for Sides {
    fn code(self) -> u8 {
        self as u8
    }
    #[inline(always)]
    fn both_sides(self) -> Self {
        Self::Both
    }
}

/// The geometry by which a batch's bounds leave out primitives of a kind.
pub enum Cull<'a> {
    /// Balls around them.
    Balls(&'a Balls),
    /// Sides of planes.
    Planes(&'a Planes),
    /// Sides of triangles and of planes through their edges.
    Triangles(&'a Triangles),
}

/// Primitives of one kind in SoA storage, as the queries and the shading see them; i counts from 0 within the kind.
///
/// The kind's default test is part of it. All functions work lane by lane, whether the lanes are rays or primitives, so
/// that one ray against eight primitives gives the same bits as a packet against each.
pub trait Primitives: Sized {
    /// The numbers that the test needs of a primitive.
    type Shape<T: Number>: Number;
    /// The variant that the test needs beside numbers; that of the plainest primitives is the default.
    type Variant: Variant;
    /// A primitive as seen from the rays' origin.
    type Seen<T: Copy>: Copy;
    /// The rays' directions as the test takes them; the directions themselves for most.
    type Aim<L: Lanes>: Copy + From<Vec3<L>>;
    /// Other methods for the same test; [`Never`] where there are none.
    type Named: Test<Self>;

    /// The primitives' materials, as indices.
    fn materials(&self) -> &[u32];
    /// The number of primitives.
    #[inline(always)]
    fn len(&self) -> usize {
        self.materials().len()
    }
    /// Whether there is none.
    #[inline]
    fn is_empty(&self) -> bool {
        self.len() == 0
    }
    /// Index of the material of primitive `i`.
    #[inline(always)]
    fn material(&self, i: usize) -> u32 {
        self.materials()[i]
    }
    /// The geometry by which a batch's bounds leave out primitives.
    fn cull(&self) -> Cull<'_>;

    /// Primitive `i`'s numbers.
    fn shape(&self, i: usize) -> Self::Shape<f32>;
    /// Primitive `i`'s variant.
    fn variant(&self, i: usize) -> Self::Variant;
    /// Number by number, from two shapes.
    fn zip<A: Number, B: Number, C: Number>(
        a: &Self::Shape<A>,
        b: &Self::Shape<B>,
        f: impl Fn(&A, &B) -> C,
    ) -> Self::Shape<C>;
    /// Number by number.
    #[inline(always)]
    fn map<A: Number, B: Number>(shape: &Self::Shape<A>, f: impl Fn(&A) -> B) -> Self::Shape<B> {
        Self::zip(shape, shape, |a, _| f(a))
    }
    /// One primitive in every lane.
    #[inline(always)]
    fn splat<L: Lanes>(shape: &Self::Shape<f32>) -> Self::Shape<L> {
        Self::map(shape, |number| L::splat(*number))
    }

    /// Primitives as seen from `origin`.
    fn seen<L: Lanes>(shape: &Self::Shape<L>, variant: Self::Variant, origin: Vec3<L>) -> Self::Seen<L>;
    /// One view in every lane.
    fn splat_seen<L: Lanes>(seen: &Self::Seen<f32>) -> Self::Seen<L>;
    /// Prepares unit directions, once for all primitives of the kind.
    #[inline(always)]
    fn aim<L: Lanes>(direction: Vec3<L>) -> Self::Aim<L> {
        direction.into()
    }
    /// The default test: the nearest distance inside (`t_min`, `t_max`).
    fn nearest<L: Lanes>(
        seen: &Self::Seen<L>,
        variant: Self::Variant,
        aim: &Self::Aim<L>,
        t_min: L,
        t_max: L,
    ) -> LaneHits<L>;
    /// The method that was asked for, where that is not the default.
    #[inline(always)]
    fn named(&self) -> Option<Self::Named> {
        None
    }

    /// Primitive `i` against rays, by the kind's method: the nearest distance inside (`t_min`, `t_max`).
    #[inline(always)]
    fn test<L: Lanes>(&self, i: usize, origin: Vec3<L>, direction: Vec3<L>, t_min: L, t_max: L) -> LaneHits<L> {
        let (shape, variant, aim) = (Self::splat(&self.shape(i)), self.variant(i), Self::aim(direction));
        match self.named() {
            None => Self::nearest(&Self::seen(&shape, variant, origin), variant, &aim, t_min, t_max),
            Some(test) => test.nearest(&test.seen(&shape, variant, origin), variant, &aim, t_min, t_max),
        }
    }

    /// The surface of primitive `i` at `point`, which lies near it.
    fn surface<L: Lanes>(&self, i: usize, point: Vec3<L>) -> Surface<L>;
    /// Where a ray goes on that passes through; `None` where the rounding along the surface matters, as next to a cone's
    /// apex.
    #[inline(always)]
    fn footing<L: Lanes>(&self, _i: usize, _surface: &Surface<L>) -> Option<Footing<L>> {
        None
    }
    /// Texture coordinates at a point of the surface.
    fn uv<L: Lanes>(&self, i: usize, surface: &Surface<L>) -> [L; 2];
    /// Where those coordinates end.
    fn mapping<L: Lanes>(&self, i: usize, surface: &Surface<L>) -> Mapping<L>;
    /// The coordinates that a checkerboard is laid in; 0 for the third where it is flat.
    fn checker<L: Lanes>(&self, i: usize, surface: &Surface<L>) -> Vec3<L>;
}

/// Primitives that have an end, so that a tree can hold them.
pub trait Bounded: Primitives {
    /// Whether hits count only within the box around the primitive, widened by 32 ε of its farthest corner's distance:
    /// for tests that say little about their rounding. (Triangles see to that themselves.)
    const BOXED: bool;
    /// The cost of a block in a tree for a ray that visits it, in visits of a node: of the block, and of each of its
    /// primitives (measured).
    const COST: [f64; 2];
    /// The least and the greatest corner of a box around a primitive.
    fn extent<L: Lanes>(shape: &Self::Shape<L>) -> [Vec3<L>; 2];
    /// The least and the greatest corner of a box around primitive `i`.
    #[inline(always)]
    fn around(&self, i: usize) -> [glam::Vec3; 2] {
        let [min, max] = Self::extent(&self.shape(i));
        [min.into(), max.into()]
    }
    /// Into how many pieces a tree had best cut primitive `i`: more than one for what is long and slanted, whose box is
    /// mostly empty. Only for tests whose hits all lie on the primitive, but for the margin of a tree's boxes.
    #[inline(always)]
    fn pieces(&self, _: usize) -> u32 {
        1
    }
    /// A box around piece `k` of `n` of primitive `i`.
    fn piece(&self, i: usize, _k: u32, _n: u32) -> [glam::Vec3; 2] {
        self.around(i)
    }
}

/// A test of a kind's primitives by one method.
pub trait Test<K: Primitives>: Copy {
    /// A primitive as seen from the rays' origin, for this method.
    type Seen<T: Copy>: Copy;
    /// Primitives as seen from `origin`.
    fn seen<L: Lanes>(self, shape: &K::Shape<L>, variant: K::Variant, origin: Vec3<L>) -> Self::Seen<L>;
    /// One view in every lane.
    fn splat_seen<L: Lanes>(seen: &Self::Seen<f32>) -> Self::Seen<L>;
    /// The nearest distance inside (`t_min`, `t_max`).
    fn nearest<L: Lanes>(
        self,
        seen: &Self::Seen<L>,
        variant: K::Variant,
        aim: &K::Aim<L>,
        t_min: L,
        t_max: L,
    ) -> LaneHits<L>;
}

/// The default method of any kind.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Standard;

impl<K: Primitives> Test<K> for Standard {
    type Seen<T: Copy> = K::Seen<T>;
    #[inline(always)]
    fn seen<L: Lanes>(self, shape: &K::Shape<L>, variant: K::Variant, origin: Vec3<L>) -> K::Seen<L> {
        K::seen(shape, variant, origin)
    }
    #[inline(always)]
    fn splat_seen<L: Lanes>(seen: &K::Seen<f32>) -> K::Seen<L> {
        K::splat_seen(seen)
    }
    #[inline(always)]
    fn nearest<L: Lanes>(
        self,
        seen: &K::Seen<L>,
        variant: K::Variant,
        aim: &K::Aim<L>,
        t_min: L,
        t_max: L,
    ) -> LaneHits<L> {
        K::nearest(seen, variant, aim, t_min, t_max)
    }
}

/// The other method of a kind that has only one: there is no such value.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Never {}

impl<K: Primitives> Test<K> for Never {
    type Seen<T: Copy> = ();
    fn seen<L: Lanes>(self, _: &K::Shape<L>, _: K::Variant, _: Vec3<L>) {
        match self {}
    }
    fn splat_seen<L: Lanes>(_: &()) {}
    fn nearest<L: Lanes>(self, _: &(), _: K::Variant, _: &K::Aim<L>, _: L, _: L) -> LaneHits<L> {
        match self {}
    }
}
