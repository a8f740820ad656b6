//! Menger sponges.

use glam::Vec3;

use super::{Kind, KindName};
use crate::bvh::Aabb;
use crate::geometry::Fractals;
use crate::scene::Invalid;
use crate::scene::rules::{At, place, require, size};

/// The most iterations of a fractal: its smallest cubes are 3⁻⁸ of the whole, some thousand ε.
const MAX_ITERATIONS: u32 = 8;

/// A Menger sponge: a cube of which every iteration removes, from each of its 20 · 20 · … cubes, the middle third
/// of each of the three directions. Seen from outside and inside.
///
/// (u, v) and checker coordinates are those of a [`Cuboid`](super::Cuboid) as large as the whole cube, by the face's
/// direction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fractal {
    /// The middle of the cube.
    pub center: Vec3,
    /// Half the cube's edge, above zero.
    pub radius: f32,
    /// 0 (the whole cube) to 8.
    pub iterations: u32,
    /// Index into [`Description::materials`](crate::scene::Description::materials).
    pub material: usize,
}

impl Kind for Fractal {
    const NAME: KindName = KindName {
        one: "fractal",
        many: "fractals",
        method: "method `sphere_trace`, in steps that end on the grid's planes",
    };
    type Storage = Fractals;

    fn check(&self, at: &At) -> Result<(), Invalid> {
        at.rule("center", place(self.center))?;
        at.rule("radius", size(self.radius))?;
        let iterations = self.iterations;
        at.rule(
            "iterations",
            require(iterations <= MAX_ITERATIONS, || format!("must be 0 to {MAX_ITERATIONS}, got {iterations}")),
        )?;
        at.material(self.material)
    }
    fn materials(&self, wear: &mut impl FnMut(usize)) {
        wear(self.material);
    }
    /// Its size is that of its smallest cubes.
    fn near(&self, near: &impl Fn(Vec3, f64) -> bool) -> bool {
        near(self.center, f64::from(self.radius) / 3f64.powi(self.iterations as i32))
    }

    fn store(&self, to: &mut Fractals) {
        to.push(self.center, self.radius, self.iterations, self.material as u32);
    }
    fn bounds(of: &Fractals, i: usize) -> Option<Aabb> {
        let [min, max] = of.bounds(i);
        Some(Aabb { min, max })
    }
}

/// How a scene file holds it.
#[cfg(feature = "files")]
mod table {
    use glam::Vec3;

    use super::{Fractal, Kind};
    use crate::scene::read::toml::elements::{Array, Element, Fault, Readable, Reader, table};

    table! {
        /// Its table.
        pub(crate) struct FractalFile {
            center: Vec3,
            radius: f32,
            iterations: u32,
            material: Option<String>,
        }
    }

    impl Element for FractalFile {
        type Kind = Fractal;
        const KEY: &'static str = Fractal::KEY;

        fn describe(self, reader: &mut Reader<'_>) -> Result<Fractal, Fault> {
            let material = reader.material(self.material)?;
            Ok(Fractal { center: self.center, radius: self.radius, iterations: self.iterations, material })
        }
    }

    impl Readable for Fractal {
        type Elements = Array<FractalFile>;
    }
}
