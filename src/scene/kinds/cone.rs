//! Cones and frusta, open or capped.

use glam::Vec3;

use super::{Kind, KindName};
use crate::bvh::Aabb;
use crate::geometry::Cones;
use crate::scene::rules::{At, axis, end_radius, place, require};
use crate::scene::{Invalid, Sides};

/// A cone or frustum about the line from `base` to `apex`. The radii differ, and one of them may be zero.
///
/// (u, v) and checker coordinates are those of a [`Cylinder`](super::Cylinder), with the cap's own radius.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cone {
    /// The middle of one end.
    pub base: Vec3,
    /// The radius there, zero or more.
    pub base_radius: f32,
    /// The middle of the other end.
    pub apex: Vec3,
    /// The radius there, zero or more.
    pub apex_radius: f32,
    /// Whether the ends are closed.
    pub caps: bool,
    /// Which side is there.
    pub sides: Sides,
    /// Index into [`Description::materials`](crate::scene::Description::materials).
    pub material: usize,
}

impl Kind for Cone {
    const NAME: KindName = KindName {
        one: "cone",
        many: "cones",
        method: "method `stable`, in the cone's own product, so that its tip and slant do not cancel",
    };
    type Storage = Cones;

    fn check(&self, at: &At) -> Result<(), Invalid> {
        at.rule("apex", axis(self.base, self.apex))?;
        at.rule("base", place(self.base))?;
        at.rule("base_radius", end_radius(self.base_radius))?;
        at.rule("apex_radius", end_radius(self.apex_radius))?;
        let differ = self.base_radius != self.apex_radius;
        at.rule("apex_radius", require(differ, || "must differ from base_radius; that is a cylinder".into()))?;
        at.material(self.material)
    }
    fn materials(&self, wear: &mut impl FnMut(usize)) {
        wear(self.material);
    }
    fn near(&self, near: &impl Fn(Vec3, f64) -> bool) -> bool {
        let length = self.base.as_dvec3().distance(self.apex.as_dvec3());
        let size = f64::from(self.base_radius.max(self.apex_radius)).min(length);
        near(self.base, size) && near(self.apex, size)
    }
    fn sides(&self) -> Sides {
        self.sides
    }

    fn store(&self, to: &mut Cones) {
        let radii = [self.base_radius, self.apex_radius];
        to.push([self.base, self.apex], radii, self.caps, self.sides, self.material as u32);
    }
    fn bounds(of: &Cones, i: usize) -> Option<Aabb> {
        let [min, max] = of.bounds(i);
        Some(Aabb { min, max })
    }
}

/// How a scene file holds it.
#[cfg(feature = "files")]
mod table {
    use glam::Vec3;

    use super::{Cone, Kind};
    use crate::scene::Sides;
    use crate::scene::read::toml::elements::{Array, Element, Fault, Readable, Reader, table};

    table! {
        /// Its table.
        pub(crate) struct ConeFile {
            base: Vec3,
            base_radius: f32,
            apex: Vec3,
            apex_radius: f32,
            caps: bool = false,
            material: Option<String>,
        }
    }

    impl Element for ConeFile {
        type Kind = Cone;
        const KEY: &'static str = Cone::KEY;

        fn describe(self, reader: &mut Reader<'_>) -> Result<Cone, Fault> {
            Ok(Cone {
                base: self.base,
                base_radius: self.base_radius,
                apex: self.apex,
                apex_radius: self.apex_radius,
                caps: self.caps,
                sides: Sides::Both,
                material: reader.material(self.material)?,
            })
        }
    }

    impl Readable for Cone {
        type Elements = Array<ConeFile>;
    }
}
