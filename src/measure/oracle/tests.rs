//! The checks and their means: [`arithmetic`] the numbers; [`residuals`] roots by the implicit equations in the
//! rational numbers of another crate, and that there is none before by Descartes' rule of signs; [`faces`] flat shapes
//! by Cramer's rule and sponges by all their cubes; [`closed`] cases known by hand; [`nearby`] what is settled;
//! [`against`] everything by the `f64` reference.
use super::*;
use crate::scene::{Cone, Cuboid, Cylinder, Disc, Fractal, Plane, Quad, Sides, Sphere, Torus};
use glam::vec3;

mod against;
mod arithmetic;
mod closed;
mod faces;
mod nearby;
mod rational;
mod residuals;

/// Numbers from −1 to 1, always the same.
struct Random(u64);

impl Random {
    fn next(&mut self) -> f32 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        ((self.0 >> 40) as f32 / (1 << 23) as f32) - 1.0
    }

    fn vector(&mut self) -> Vec3 {
        vec3(self.next(), self.next(), self.next())
    }

    /// From 0 to `n` − 1.
    fn below(&mut self, n: u32) -> u32 {
        ((self.next() * 0.5 + 0.5) * n as f32) as u32
    }

    /// From outside of what is around the origin towards it; or, one in four, from within.
    fn ray(&mut self) -> Ray {
        let from = self.vector() * if self.below(4) == 0 { 0.5 } else { 6.0 };
        let to = self.vector() * 0.9;
        Ray::new(from, (to - from).normalize_or(Vec3::X))
    }

    fn sides(&mut self) -> Sides {
        [Sides::Both, Sides::Front, Sides::Back][self.below(3) as usize]
    }

    /// One of the kinds, about the origin, of size 1.
    fn shape(&mut self, kind: usize) -> Shape {
        let (a, b, c, material) = (self.vector(), self.vector(), self.vector(), 0);
        let size = 0.6 + 0.4 * self.next();
        match kind {
            0 => Shape::Plane(Plane { normal: a, distance: size * 0.5, material }),
            1 => Shape::Sphere(Sphere { center: a * 0.3, radius: size, sides: self.sides(), material }),
            2 => Shape::Triangle(Triangle { corners: [a, b, c], sides: self.sides() }),
            3 => Shape::Quad(Quad { corner: a, u: b - a, v: c - a, material }),
            4 => Shape::Cuboid(Cuboid { min: a.min(b) - 0.1, max: a.max(b) + 0.1, rotation: Vec3::ZERO, material }),
            5 => Shape::Cuboid(Cuboid { min: a.min(b) - 0.1, max: a.max(b) + 0.1, rotation: c * 400.0, material }),
            6 => {
                let (radius, caps, sides) = (size * 0.6, self.below(2) == 0, self.sides());
                Shape::Cylinder(Cylinder { base: a, apex: b, radius, caps, sides, material })
            }
            7 => {
                let (base_radius, apex_radius) = (size, [0.0, size * 0.4][self.below(2) as usize]);
                let (caps, sides) = (self.below(2) == 0, self.sides());
                Shape::Cone(Cone { base: a, apex: b, base_radius, apex_radius, caps, sides, material })
            }
            8 => {
                let (major_radius, minor_radius) = (size, size * (0.5 + 0.4 * self.next()));
                Shape::Torus(Torus { center: a * 0.3, axis: b, major_radius, minor_radius, material })
            }
            9 => {
                let iterations = self.below(5);
                Shape::Fractal(Fractal { center: a * 0.3, radius: size, iterations, material })
            }
            _ => {
                let inner_radius = [0.0, size * 0.3][self.below(2) as usize];
                Shape::Disc(Disc { center: a * 0.3, normal: b, radius: size, inner_radius, material })
            }
        }
    }
}

const KINDS: usize = 11;

fn sphere(center: Vec3, radius: f32) -> Shape {
    Shape::Sphere(Sphere { center, radius, sides: Sides::Both, material: 0 })
}

fn torus(major_radius: f32, minor_radius: f32) -> Shape {
    Shape::Torus(Torus { center: Vec3::ZERO, axis: Vec3::Z, major_radius, minor_radius, material: 0 })
}

/// Of a ray that starts at t = 0 and has no end.
fn ahead(shape: &Shape, origin: Vec3, direction: Vec3) -> Option<(f64, DVec3)> {
    nearest(shape, &Ray::new(origin, direction), 0.0, f64::INFINITY).map(|truth| (truth.t, truth.normal))
}
