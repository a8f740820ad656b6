//! Boxes, aligned to the axes or turned.

use glam::Vec3;

use super::{Kind, KindName};
use crate::bvh::Aabb;
use crate::geometry::Cuboids;
use crate::scene::Invalid;
use crate::scene::rules::{At, MIN_RADIUS, angles, place, require, triple};

/// A box, seen from outside and inside.
///
/// Turned about its centre by `rotation`: x first, then y, then z. In its own axes, with q = p − centre, every face
/// is divided into (u, v) from 0 to 1: along (−z, y) on +x, (z, y) on −x, (x, −z) on +y, (x, z) on −y, (x, y) on +z
/// and (−x, y) on −z, so that an image stands upright on the sides, as seen from outside. Checker coordinates are the
/// two of q along the face.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cuboid {
    /// The corner with the least coordinates, before it is turned.
    pub min: Vec3,
    /// The corner with the greatest; each coordinate greater than `min`'s.
    pub max: Vec3,
    /// Degrees about x, y and z.
    pub rotation: Vec3,
    /// Index into [`Description::materials`](crate::scene::Description::materials).
    pub material: usize,
}

impl Kind for Cuboid {
    const NAME: KindName =
        KindName { one: "box", many: "boxes", method: "method `slabs`: no ray slips through an edge or corner" };
    type Storage = Cuboids;

    fn check(&self, at: &At) -> Result<(), Invalid> {
        at.rule("min", place(self.min))?;
        at.rule("max", place(self.max))?;
        // Thinner than a few ε of its place it has no inside.
        let least = self.min.abs().max(self.max.abs()) * (8.0 * f32::EPSILON);
        let thick = (self.max - self.min).cmpgt(least.max(Vec3::splat(MIN_RADIUS))).all();
        at.rule("max", require(thick, || format!("must exceed {at}.min, got {}", triple(self.max))))?;
        at.rule("rotation", angles(self.rotation))?;
        at.material(self.material)
    }
    fn materials(&self, wear: &mut impl FnMut(usize)) {
        wear(self.material);
    }
    fn near(&self, near: &impl Fn(Vec3, f64) -> bool) -> bool {
        let size = f64::from((self.max - self.min).min_element());
        near(self.min, size) && near(self.max, size)
    }

    fn store(&self, to: &mut Cuboids) {
        to.push(self.min, self.max, self.rotation, self.material as u32);
    }
    fn bounds(of: &Cuboids, i: usize) -> Option<Aabb> {
        let [min, max] = of.bounds(i);
        Some(Aabb { min, max })
    }
}

/// How a scene file holds it.
#[cfg(feature = "files")]
mod table {
    use glam::Vec3;

    use super::{Cuboid, Kind};
    use crate::scene::read::toml::elements::{Array, Element, Fault, Readable, Reader, table};

    table! {
        /// Its table.
        pub(crate) struct BoxFile {
            min: Vec3,
            max: Vec3,
            rotation: Option<Vec3>,
            material: Option<String>,
        }
    }

    impl Element for BoxFile {
        type Kind = Cuboid;
        const KEY: &'static str = Cuboid::KEY;

        fn describe(self, reader: &mut Reader<'_>) -> Result<Cuboid, Fault> {
            let rotation = self.rotation.unwrap_or_default();
            let material = reader.material(self.material)?;
            Ok(Cuboid { min: self.min, max: self.max, rotation, material })
        }
    }

    impl Readable for Cuboid {
        type Elements = Array<BoxFile>;
    }
}
