//! Menger sponges.

use super::{Balls, Bounded, Nearest, Primitives, Sides, Surface};
use crate::math::{Lanes, Vec3};

/// Fractals, not traced yet.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Fractals {
    material: Vec<u32>,
    balls: Balls,
}

impl Fractals {
    /// Adds one.
    #[allow(clippy::too_many_arguments, unused_variables)]
    pub fn push(&mut self, center: glam::Vec3, radius: f32, iterations: u32, material: u32) {
        self.material.push(material);
        self.balls.push(glam::Vec3::ZERO, 0.0);
    }
}

impl Bounded for Fractals {
    fn balls(&self) -> &Balls {
        &self.balls
    }
}

#[allow(unused_variables)]
impl Primitives for Fractals {
    type Record = Sides;
    type Seen<L: Lanes> = Vec3<L>;
    type Aim<L: Lanes> = Vec3<L>;

    fn len(&self) -> usize {
        self.material.len()
    }
    fn material(&self, i: usize) -> u32 {
        self.material[i]
    }
    fn record(&self, i: usize) -> Sides {
        Sides::Both
    }
    fn seen<L: Lanes>(r: &Sides, origin: Vec3<L>) -> Vec3<L> {
        origin
    }
    fn splat<L: Lanes>(s: &Vec3<f32>) -> Vec3<L> {
        Vec3::splat((*s).into())
    }
    fn aim<L: Lanes>(direction: Vec3<L>) -> Vec3<L> {
        direction
    }
    fn nearest<L: Lanes, const SIDED: bool>(seen: &Vec3<L>, d: &Vec3<L>, t_min: L, t_max: L) -> Nearest<L> {
        None
    }
    fn surface<L: Lanes>(&self, i: usize, point: Vec3<L>) -> Surface<L> {
        Surface { point, normal: point, reach: 0.0 }
    }
    fn uv<L: Lanes>(&self, i: usize, surface: &Surface<L>) -> [L; 2] {
        [L::zero(), L::zero()]
    }
    fn checker<L: Lanes>(&self, i: usize, surface: &Surface<L>) -> Vec3<L> {
        surface.point
    }
}
