//! Parallelograms.

use glam::Vec3;

use super::{Kind, KindName, triangle_near};
use crate::bvh::Aabb;
use crate::geometry::Quads;
use crate::scene::Invalid;
use crate::scene::rules::{At, area, place};

/// The parallelogram of the points corner + a u + b v, a and b from 0 to 1; seen from both sides. The front is where
/// u × v points.
///
/// (u, v) = (a, b). Checker coordinates are (p·T, p·B) with the axes of [`crate::geometry::frame`] of u × v.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Quad {
    /// One corner.
    pub corner: Vec3,
    /// From there to the next.
    pub u: Vec3,
    /// And to the other; not parallel to `u`.
    pub v: Vec3,
    /// Index into [`Description::materials`](crate::scene::Description::materials).
    pub material: usize,
}

impl Kind for Quad {
    const NAME: KindName =
        KindName { one: "quad", many: "quads", method: "method `planar`: a hit is on the quad, however flat its ray" };
    type Storage = Quads;

    fn check(&self, at: &At) -> Result<(), Invalid> {
        for (v, name) in [(self.corner, "corner"), (self.u, "u"), (self.v, "v")] {
            at.rule(name, place(v))?;
        }
        at.rule("v", area(self.u, self.v))?;
        at.material(self.material)
    }
    fn materials(&self, wear: &mut impl FnMut(usize)) {
        wear(self.material);
    }
    /// Both its triangles.
    fn near(&self, near: &impl Fn(Vec3, f64) -> bool) -> bool {
        let Self { corner, u, v, .. } = *self;
        triangle_near(corner, u, v, near) && triangle_near(corner + u + v, -u, -v, near)
    }

    fn store(&self, to: &mut Quads) {
        to.push(self.corner, self.u, self.v, self.material as u32);
    }
    fn bounds(of: &Quads, i: usize) -> Option<Aabb> {
        let [min, max] = of.bounds(i);
        Some(Aabb { min, max })
    }
}

/// How a scene file holds it.
#[cfg(feature = "files")]
mod table {
    use glam::Vec3;

    use super::{Kind, Quad};
    use crate::scene::read::toml::elements::{Array, Element, Fault, Readable, Reader, table};

    table! {
        /// Its table.
        pub(crate) struct QuadFile {
            corner: Vec3,
            u: Vec3,
            v: Vec3,
            material: Option<String>,
        }
    }

    impl Element for QuadFile {
        type Kind = Quad;
        const KEY: &'static str = Quad::KEY;

        fn describe(self, reader: &mut Reader<'_>) -> Result<Quad, Fault> {
            let material = reader.material(self.material)?;
            Ok(Quad { corner: self.corner, u: self.u, v: self.v, material })
        }
    }

    impl Readable for Quad {
        type Elements = Array<QuadFile>;
    }
}
