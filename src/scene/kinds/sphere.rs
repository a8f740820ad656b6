//! Spheres.

use glam::Vec3;

use super::{Kind, KindName};
use crate::bvh::Aabb;
use crate::geometry::Spheres;
use crate::geometry::methods::{Methods, SphereMethod};
use crate::scene::rules::{At, length, point};
use crate::scene::{Invalid, Plan, Sides};

/// A sphere.
///
/// With n = (p − center) / radius: u = ½ + atan2(n.x, n.z) / 2π, v = ½ + asin(n.y) / π. Checker coordinates are
/// p − center.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sphere {
    /// Its centre.
    pub center: Vec3,
    /// Above zero.
    pub radius: f32,
    /// Which side is there.
    pub sides: Sides,
    /// Index into [`Description::materials`](crate::scene::Description::materials).
    pub material: usize,
}

impl Kind for Sphere {
    const NAME: KindName = KindName {
        one: "sphere",
        many: "spheres",
        method: "method `stable`, right from inside, on and far from a sphere",
    };
    const WEIGHT: usize = 1;
    const PLAIN: bool = true;
    type Storage = Spheres;

    fn check(&self, at: &At) -> Result<(), Invalid> {
        at.rule("center", point(self.center))?;
        at.rule("radius", length(self.radius))?;
        at.material(self.material)
    }
    fn materials(&self, wear: &mut impl FnMut(usize)) {
        wear(self.material);
    }
    fn near(&self, near: &impl Fn(Vec3, f64) -> bool) -> bool {
        near(self.center, f64::from(self.radius))
    }
    fn sides(&self) -> Sides {
        self.sides
    }

    fn store(&self, to: &mut Spheres) {
        to.push(self.center, self.radius, self.sides, self.material as u32);
    }
    fn set_methods(to: &mut Spheres, methods: &Methods) {
        to.method = methods.sphere;
        to.steps = methods.normalize.steps();
    }
    fn bounds(_: &Spheres, _: usize) -> Option<Aabb> {
        None
    }

    fn other_method(methods: &Methods) -> Option<&'static str> {
        (methods.sphere != SphereMethod::default()).then(|| methods.sphere.name())
    }
    fn reason(plan: &Plan) -> Option<&str> {
        Some(&plan.why)
    }
}

/// How a scene file holds it.
#[cfg(feature = "files")]
mod table {
    use glam::Vec3;

    use super::{Kind, Sphere};
    use crate::scene::Sides;
    use crate::scene::read::toml::elements::{Array, Element, Fault, Readable, Reader, table};

    table! {
        /// Its table.
        pub(crate) struct SphereFile {
            center: Vec3,
            radius: f32,
            material: Option<String>,
        }
    }

    impl Element for SphereFile {
        type Kind = Sphere;
        const KEY: &'static str = Sphere::KEY;

        fn describe(self, reader: &mut Reader<'_>) -> Result<Sphere, Fault> {
            let material = reader.material(self.material)?;
            Ok(Sphere { center: self.center, radius: self.radius, sides: Sides::Both, material })
        }
    }

    impl Readable for Sphere {
        type Elements = Array<SphereFile>;
    }
}
