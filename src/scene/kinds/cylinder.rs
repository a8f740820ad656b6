//! Cylinders, open or capped.

use glam::Vec3;

use super::{Kind, KindName};
use crate::bvh::Aabb;
use crate::geometry::Cylinders;
use crate::scene::rules::{At, axis, place, size};
use crate::scene::{Invalid, Sides};

/// A cylinder about the line from `base` to `apex`.
///
/// With the unit axis A = normalize(apex − base), its axes T, B ([`crate::geometry::frame`]) and q = p − base: on the
/// side u = ½ + atan2(q·T, q·B) / 2π and v = q·A / |apex − base|; on the caps (u, v) = ½ + (q·T, q·B) / (2 radius).
/// Checker coordinates are (q·T, q·B, q·A), on the caps only the first two.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cylinder {
    /// The middle of one end.
    pub base: Vec3,
    /// The middle of the other.
    pub apex: Vec3,
    /// Above zero.
    pub radius: f32,
    /// Whether the ends are closed.
    pub caps: bool,
    /// Which side is there.
    pub sides: Sides,
    /// Index into [`Description::materials`](crate::scene::Description::materials).
    pub material: usize,
}

impl Kind for Cylinder {
    const NAME: KindName = KindName {
        one: "cylinder",
        many: "cylinders",
        method: "method `stable`; a closed one is an endless one within a slab, without cracks",
    };
    type Storage = Cylinders;

    fn check(&self, at: &At) -> Result<(), Invalid> {
        at.rule("apex", axis(self.base, self.apex))?;
        at.rule("base", place(self.base))?;
        at.rule("radius", size(self.radius))?;
        at.material(self.material)
    }
    fn materials(&self, wear: &mut impl FnMut(usize)) {
        wear(self.material);
    }
    fn near(&self, near: &impl Fn(Vec3, f64) -> bool) -> bool {
        let size = f64::from(self.radius).min(self.base.as_dvec3().distance(self.apex.as_dvec3()));
        near(self.base, size) && near(self.apex, size)
    }
    fn sides(&self) -> Sides {
        self.sides
    }

    fn store(&self, to: &mut Cylinders) {
        to.push(self.base, self.apex, self.radius, self.caps, self.sides, self.material as u32);
    }
    fn bounds(of: &Cylinders, i: usize) -> Option<Aabb> {
        let [min, max] = of.bounds(i);
        Some(Aabb { min, max })
    }
}

/// How a scene file holds it.
#[cfg(feature = "files")]
mod table {
    use glam::Vec3;

    use super::{Cylinder, Kind};
    use crate::scene::Sides;
    use crate::scene::read::toml::elements::{Array, Element, Fault, Readable, Reader, table};

    table! {
        /// Its table.
        pub(crate) struct CylinderFile {
            base: Vec3,
            apex: Vec3,
            radius: f32,
            caps: bool = false,
            material: Option<String>,
        }
    }

    impl Element for CylinderFile {
        type Kind = Cylinder;
        const KEY: &'static str = Cylinder::KEY;

        fn describe(self, reader: &mut Reader<'_>) -> Result<Cylinder, Fault> {
            let material = reader.material(self.material)?;
            let (base, apex) = (self.base, self.apex);
            Ok(Cylinder { base, apex, radius: self.radius, caps: self.caps, sides: Sides::Both, material })
        }
    }

    impl Readable for Cylinder {
        type Elements = Array<CylinderFile>;
    }
}
