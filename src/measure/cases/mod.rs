//! Hard cases: scenes and rays where ray tracers fail, each with one dial.
//!
//! A [`Generator`] makes a [`Case`] for a setting of its dial: a scene, and rays that are aimed at where the tests of its
//! subject lose digits. All are in [`ALL`]; [`find`] knows them by name.
//!
//! A dial's value holds for the numbers that are traced, not for some that were rounded afterwards: everything is
//! made in `f64`, rounded to `f32`, measured in `f64` as rounded, and where that is more than a quarter off the dial,
//! drawn again (2000 times at the most, then the best is taken). Where a ray's start is said to be *on* a surface, it is
//! the nearest `f32` to a point that is, computed in `f64`. Directions are unit vectors, rounded. Primitives are in the
//! poses a seed gives them; the same dial, number of rays and seed give the same bits.

mod axial;
mod cuboid;
mod draw;
mod fractal;
mod glass;
mod leaving;
mod light;
mod mesh;
mod mixed;
mod plane;
mod sphere;
mod table;
#[cfg(test)]
mod tests;
mod torus;
mod triangle;

use super::random::Pcg;
use crate::scene::Description;

pub use crate::trace::Ray;
pub use table::ALL;

/// The subject that a case judges.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Subject {
    /// The test of planes.
    Plane,
    /// Of spheres.
    Sphere,
    /// Of triangles.
    Triangle,
    /// Of quads.
    Quad,
    /// Of boxes.
    Cuboid,
    /// Of cylinders.
    Cylinder,
    /// Of cones.
    Cone,
    /// Of tori.
    Torus,
    /// Of fractals.
    Fractal,
    /// Of discs.
    Disc,
    /// All of them, together.
    All,
    /// Refraction; the rays are the eye's.
    Refraction,
    /// Shadows; the rays are shadow rays.
    Shadow,
}

/// How settings of a dial are spaced.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Spacing {
    /// By equal differences.
    Linear,
    /// By equal ratios.
    Logarithmic,
}

/// A dial that is turned to make a case harder.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dial {
    /// The quantity that it measures.
    pub meaning: &'static str,
    /// In which unit.
    pub unit: &'static str,
    /// The least setting.
    pub least: f64,
    /// The greatest.
    pub most: f64,
    /// How to step from one to the other.
    pub spacing: Spacing,
}

impl Dial {
    /// `count` settings from the least to the greatest, both included; just the least when `count` is 1.
    pub fn settings(&self, count: usize) -> impl Iterator<Item = f64> {
        let Self { least, most, spacing, .. } = *self;
        let last = count.saturating_sub(1).max(1) as f64;
        (0..count).map(move |i| match (i as f64 / last, spacing) {
            (1.0, _) => most,
            (part, Spacing::Linear) => least + (most - least) * part,
            (part, Spacing::Logarithmic) => least * (most / least).powf(part),
        })
    }
}

/// A scene and the rays to trace in it.
#[derive(Clone, Debug, PartialEq)]
pub struct Case {
    /// The scene; it compiles.
    pub description: Description,
    /// Finite but for `t_max`.
    pub rays: Vec<Ray>,
    /// The subject that is judged.
    pub subject: Subject,
}

/// A kind of hard case.
#[derive(Clone, Copy, Debug)]
pub struct Generator {
    /// In kebab case.
    pub name: &'static str,
    /// Which rays and which scene, and what is exact about them.
    pub about: &'static str,
    /// The dial that makes it harder.
    pub dial: Dial,
    /// The subject that is judged.
    pub subject: Subject,
    make: fn(f64, usize, &mut Pcg) -> Made,
}

/// The scene and the rays that makers return.
type Made = (Description, Vec<Ray>);

impl Generator {
    /// The case at `dial`, with that many rays. A setting outside the dial's range counts as the range's end, NaN as the
    /// least.
    pub fn make(&self, dial: f64, rays: usize, seed: u64) -> Case {
        let dial = dial.max(self.dial.least).min(self.dial.most);
        let (description, rays) = (self.make)(dial, rays, &mut Pcg::new(seed));
        Case { description: Description { name: self.name.into(), ..description }, rays, subject: self.subject }
    }
}

/// The generator of that name.
pub fn find(name: &str) -> Option<&'static Generator> {
    ALL.iter().find(|g| g.name == name)
}
