//! Discs, with or without a hole.

use glam::Vec3;

use super::{Kind, KindName};
use crate::bvh::Aabb;
use crate::geometry::{Discs, frame};
use crate::scene::Invalid;
use crate::scene::rules::{At, direction, place, require, size};

/// A flat disc about `center`, across `normal`; a ring where `inner_radius` is above 0. Seen from both sides. The front
/// is where the normal points.
///
/// With the axes T, B ([`crate::geometry::frame`]) of the unit normal and q = p − center: u = ½ + atan2(q·T, q·B) / 2π
/// as on a cylinder's side, and v = (|q| − inner_radius) / (radius − inner_radius), which runs outward from 0 to 1.
/// Checker coordinates are (q·T, q·B).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Disc {
    /// The middle.
    pub center: Vec3,
    /// Across the disc; of any length but zero.
    pub normal: Vec3,
    /// Above zero.
    pub radius: f32,
    /// The hole's; 0 for none, and below `radius`.
    pub inner_radius: f32,
    /// Index into [`Description::materials`](crate::scene::Description::materials).
    pub material: usize,
}

impl Kind for Disc {
    const NAME: KindName = KindName {
        one: "disc",
        many: "discs",
        method: "method `planar`: where the ray meets the plane, by the distance from the centre",
    };
    type Storage = Discs;

    fn check(&self, at: &At) -> Result<(), Invalid> {
        at.rule("center", place(self.center))?;
        at.rule("normal", direction(self.normal))?;
        at.rule("radius", size(self.radius))?;
        let hole = (0.0..self.radius).contains(&self.inner_radius);
        let problem = || format!("must be 0 or more and below radius, got {}", self.inner_radius);
        at.rule("inner_radius", require(hole, problem))?;
        at.material(self.material)
    }
    fn materials(&self, wear: &mut impl FnMut(usize)) {
        wear(self.material);
    }
    /// Its size is its radius, or the ring's width; it is as far away as its middle or four points of its rim.
    fn near(&self, near: &impl Fn(Vec3, f64) -> bool) -> bool {
        let size = f64::from(self.radius) - f64::from(self.inner_radius);
        let [t, b] = frame(self.normal.as_dvec3().normalize().as_vec3()).map(|a| a * self.radius);
        [Vec3::ZERO, t, -t, b, -b].iter().all(|&out| near(self.center + out, size))
    }

    fn store(&self, to: &mut Discs) {
        to.push(self.center, self.normal, self.radius, self.inner_radius, self.material as u32);
    }
    fn bounds(of: &Discs, i: usize) -> Option<Aabb> {
        let [min, max] = of.bounds(i);
        Some(Aabb { min, max })
    }
}

/// How a scene file holds it.
#[cfg(feature = "files")]
mod table {
    use glam::Vec3;

    use super::{Disc, Kind};
    use crate::scene::read::toml::elements::{Array, Element, Fault, Readable, Reader, table};

    table! {
        /// Its table.
        pub(crate) struct DiscFile {
            center: Vec3,
            normal: Vec3,
            radius: f32,
            inner_radius: f32 = 0.0,
            material: Option<String>,
        }
    }

    impl Element for DiscFile {
        type Kind = Disc;
        const KEY: &'static str = Disc::KEY;

        fn describe(self, reader: &mut Reader<'_>) -> Result<Disc, Fault> {
            let material = reader.material(self.material)?;
            let (center, normal) = (self.center, self.normal);
            Ok(Disc { center, normal, radius: self.radius, inner_radius: self.inner_radius, material })
        }
    }

    impl Readable for Disc {
        type Elements = Array<DiscFile>;
    }
}
