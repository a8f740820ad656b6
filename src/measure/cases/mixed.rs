//! One of every kind, scaled and moved.

use glam::{DVec3, Vec3, dvec3};

use super::draw::{empty, towards};
use super::{Made, Pcg};
use crate::scene::{Cone, Cuboid, Cylinder, Description, Disc, Fractal, Mesh, Plane, Quad, Sides, Sphere, Torus};

/// Up to 2 sizes from the world's origin along each axis.
pub fn place(size: f64, rng: &mut Pcg) -> Vec3 {
    (rng.cube().as_dvec3() * (2.0 * size)).as_vec3()
}

/// Where the scene's own coordinates lie in the world.
struct Frame {
    scale: f64,
    offset: DVec3,
}

impl Frame {
    fn at(&self, x: f64, y: f64, z: f64) -> Vec3 {
        self.world(dvec3(x, y, z)).as_vec3()
    }

    fn world(&self, p: DVec3) -> DVec3 {
        self.offset + p * self.scale
    }

    fn long(&self, x: f64) -> f32 {
        (x * self.scale) as f32
    }

    /// Bodies in two rows within 5 of the middle, above a plane.
    fn scene(&self) -> Description {
        let (sides, caps, material) = (Sides::Both, true, 0);
        let (base, apex) = (self.at(-4.0, -1.0, -2.0), self.at(-3.5, 1.5, -2.5));
        let cylinder = Cylinder { base, apex, radius: self.long(1.0), caps, sides, material };
        let (base, apex) = (self.at(3.5, -1.0, -2.0), self.at(3.0, 1.5, -2.5));
        let cone = Cone { base, base_radius: self.long(1.3), apex, apex_radius: 0.0, caps, sides, material };
        let (major_radius, minor_radius) = (self.long(1.1), self.long(0.4));
        let axis = Vec3::new(0.2, 1.0, 0.4);
        let positions = [[-4.5, -1.0, 1.0], [-2.5, -1.0, 2.5], [-3.0, 1.5, 1.5]].map(|[x, y, z]| self.at(x, y, z));
        let mesh = Mesh { positions: positions.into(), triangles: vec![[0, 1, 2]], ..Mesh::default() };
        let edge = |x, y, z| (dvec3(x, y, z) * self.scale).as_vec3();
        let (u, v) = (edge(2.0, 0.5, 0.0), edge(0.0, 2.0, -1.0));
        let (min, max) = (self.at(-1.0, -2.5, 1.5), self.at(1.0, -0.5, 3.5));
        // n·p + distance = 0 at the point three below the middle.
        let normal = Vec3::new(0.0, 1.0, 0.25);
        let distance = -normal.as_dvec3().dot(self.world(dvec3(0.0, -3.0, 0.0))) as f32;
        Description {
            planes: vec![Plane { normal, distance, material }],
            spheres: vec![Sphere { center: self.at(0.0, 1.5, 2.0), radius: self.long(1.2), sides, material }],
            meshes: vec![mesh],
            quads: vec![Quad { corner: self.at(2.5, -1.0, 2.0), u, v, material }],
            cuboids: vec![Cuboid { min, max, rotation: Vec3::new(10.0, 20.0, 30.0), material }],
            cylinders: vec![cylinder],
            cones: vec![cone],
            tori: vec![Torus { center: self.at(0.0, 2.5, -2.0), axis, major_radius, minor_radius, material }],
            fractals: vec![Fractal {
                center: self.at(0.0, -0.5, -2.0),
                radius: self.long(1.2),
                iterations: 2,
                material,
            }],
            discs: vec![Disc {
                center: self.at(2.5, 2.5, 0.5),
                normal: Vec3::new(0.3, 0.4, 1.0),
                radius: self.long(1.1),
                inner_radius: self.long(0.4),
                material,
            }],
            ..empty()
        }
    }

    /// From 12 off the middle, to points up to 4 off it.
    fn make(&self, rays: usize, rng: &mut Pcg) -> Made {
        let aim = |_| {
            let back = rng.direction();
            let origin = self.world(back * 12.0).as_vec3();
            let aside = rng.across(back) * (4.0 * rng.between(0.0, 1.0).sqrt());
            towards(origin, self.world(aside))
        };
        let rays = (0..rays).map(aim).collect();
        (self.scene(), rays)
    }
}

/// The scene, `dial` times as large.
pub fn scaled(dial: f64, rays: usize, rng: &mut Pcg) -> Made {
    Frame { scale: dial, offset: DVec3::ZERO }.make(rays, rng)
}

/// The scene, as large as it is, `dial` away from the world's origin.
pub fn moved(dial: f64, rays: usize, rng: &mut Pcg) -> Made {
    Frame { scale: 1.0, offset: rng.direction() * dial }.make(rays, rng)
}
