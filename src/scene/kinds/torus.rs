//! Tori.

use glam::Vec3;

use super::{Kind, KindName};
use crate::bvh::Aabb;
use crate::geometry::Tori;
use crate::geometry::methods::{Methods, TorusMethod};
use crate::scene::Invalid;
use crate::scene::rules::{At, direction, place, require, size};

/// A torus: the points at `minor_radius` from the circle of `major_radius` about `center`, across `axis`. Seen from
/// outside and inside.
///
/// With the unit axis A, its axes T, B ([`crate::geometry::frame`]), q = p − center and ρ = |q − A (q·A)|:
/// u = ½ + atan2(q·T, q·B) / 2π, v = ½ + atan2(q·A, ρ − major_radius) / 2π. Checker coordinates are
/// (q·T, q·B, q·A).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Torus {
    /// Its middle.
    pub center: Vec3,
    /// The direction of its axis, of any length but zero.
    pub axis: Vec3,
    /// From the middle to the middle of the tube; at least `minor_radius`.
    pub major_radius: f32,
    /// Of the tube, above zero.
    pub minor_radius: f32,
    /// Index into [`Description::materials`](crate::scene::Description::materials).
    pub material: usize,
}

impl Kind for Torus {
    const NAME: KindName = KindName {
        one: "torus",
        many: "tori",
        method: "method `monotone_newton`, which loses no root that stands clear of rounding",
    };
    type Storage = Tori;

    fn check(&self, at: &At) -> Result<(), Invalid> {
        at.rule("center", place(self.center))?;
        at.rule("axis", direction(self.axis))?;
        at.rule("major_radius", size(self.major_radius))?;
        at.rule("minor_radius", size(self.minor_radius))?;
        let ring = self.minor_radius <= self.major_radius;
        at.rule("minor_radius", require(ring, || format!("must be at most major_radius, got {}", self.minor_radius)))?;
        at.material(self.material)
    }
    fn materials(&self, wear: &mut impl FnMut(usize)) {
        wear(self.material);
    }
    fn near(&self, near: &impl Fn(Vec3, f64) -> bool) -> bool {
        near(self.center, f64::from(self.minor_radius))
    }

    fn store(&self, to: &mut Tori) {
        to.push(self.center, self.axis, self.major_radius, self.minor_radius, self.material as u32);
    }
    fn set_methods(to: &mut Tori, methods: &Methods) {
        to.method = methods.torus;
    }
    fn bounds(of: &Tori, i: usize) -> Option<Aabb> {
        let [min, max] = of.bounds(i);
        Some(Aabb { min, max })
    }

    fn other_method(methods: &Methods) -> Option<&'static str> {
        (methods.torus != TorusMethod::default()).then(|| methods.torus.name())
    }
}

/// How a scene file holds it.
#[cfg(feature = "files")]
mod table {
    use glam::Vec3;

    use super::{Kind, Torus};
    use crate::scene::read::toml::elements::{Array, Element, Fault, Readable, Reader, table};

    table! {
        /// Its table.
        pub(crate) struct TorusFile {
            center: Vec3,
            axis: Vec3,
            major_radius: f32,
            minor_radius: f32,
            material: Option<String>,
        }
    }

    impl Element for TorusFile {
        type Kind = Torus;
        const KEY: &'static str = Torus::KEY;

        fn describe(self, reader: &mut Reader<'_>) -> Result<Torus, Fault> {
            Ok(Torus {
                center: self.center,
                axis: self.axis,
                major_radius: self.major_radius,
                minor_radius: self.minor_radius,
                material: reader.material(self.material)?,
            })
        }
    }

    impl Readable for Torus {
        type Elements = Array<TorusFile>;
    }
}
