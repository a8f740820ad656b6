//! Planes without an end.

use glam::Vec3;

use super::{Kind, KindName};
use crate::bvh::Aabb;
use crate::geometry::Planes;
use crate::scene::Invalid;
use crate::scene::rules::{At, direction, offset};

/// An infinite plane: the points p with p·normal + distance = 0. Seen from both sides.
///
/// With the axes T, B of its unit normal ([`crate::geometry::frame`]): (u, v) = (p·T, −p·B), and checker coordinates are
/// (p·T, p·B).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Plane {
    /// Of any length but zero; the plane is the same when normal and distance are scaled together.
    pub normal: Vec3,
    /// The plane's offset.
    pub distance: f32,
    /// Index into [`Description::materials`](crate::scene::Description::materials).
    pub material: usize,
}

impl Kind for Plane {
    const NAME: KindName =
        KindName { one: "plane", many: "planes", method: "unbounded; left out where no ray of a batch turns to it" };
    const WEIGHT: usize = 0;
    const PLAIN: bool = true;
    type Storage = Planes;

    fn check(&self, at: &At) -> Result<(), Invalid> {
        at.rule("normal", direction(self.normal))?;
        at.rule("distance", offset(self.normal, self.distance))?;
        at.material(self.material)
    }
    fn materials(&self, wear: &mut impl FnMut(usize)) {
        wear(self.material);
    }
    fn near(&self, _: &impl Fn(Vec3, f64) -> bool) -> bool {
        true
    }

    fn store(&self, to: &mut Planes) {
        to.push(self.normal, self.distance, self.material as u32);
    }
    fn bounds(_: &Planes, _: usize) -> Option<Aabb> {
        None
    }
}

/// How a scene file holds it.
#[cfg(feature = "files")]
mod table {
    use glam::Vec3;

    use super::{Kind, Plane};
    use crate::scene::read::toml::elements::{Array, Element, Fault, Readable, Reader, table};

    table! {
        /// Its table.
        pub(crate) struct PlaneFile {
            normal: Vec3,
            distance: f32,
            material: Option<String>,
        }
    }

    impl Element for PlaneFile {
        type Kind = Plane;
        const KEY: &'static str = Plane::KEY;

        fn describe(self, reader: &mut Reader<'_>) -> Result<Plane, Fault> {
            Ok(Plane { normal: self.normal, distance: self.distance, material: reader.material(self.material)? })
        }
    }

    impl Readable for Plane {
        type Elements = Array<PlaneFile>;
    }
}
