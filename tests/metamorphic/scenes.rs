//! Scenes whose numbers are whole multiples of 1/64, so that moving them by such takes no rounding.

use glam::{Vec3, vec3};
use proptest::prelude::*;
use raypacket::scene::{Cone, Cuboid, Cylinder, Description, Disc, Fractal, Quad, Sides, Torus, check};

use crate::common::{empty, light, mesh, plane, sphere};

/// Three of −127 to 127.
pub type Steps = [i8; 3];

/// A primitive of any kind.
#[derive(Clone, Debug)]
pub struct Item {
    kind: Kind,
    at: Steps,
    a: Steps,
    b: Steps,
    size: u8,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    Plane,
    Sphere,
    Triangle,
    Quad,
    Cuboid,
    Turned,
    Cylinder,
    Cone,
    Torus,
    Fractal,
    Disc,
}

const KINDS: [Kind; 11] = [
    Kind::Sphere,
    Kind::Triangle,
    Kind::Quad,
    Kind::Cuboid,
    Kind::Turned,
    Kind::Cylinder,
    Kind::Cone,
    Kind::Torus,
    Kind::Fractal,
    Kind::Disc,
    Kind::Plane,
];

/// Steps in each direction.
pub fn vector() -> impl Strategy<Value = Steps> {
    prop::array::uniform3(-127..=127_i8)
}

/// What a scene consists of.
pub fn items() -> impl Strategy<Value = Vec<Item>> {
    let item = (prop::sample::select(&KINDS[..]), vector(), vector(), vector(), 4..64_u8);
    prop::collection::vec(item.prop_map(|(kind, at, a, b, size)| Item { kind, at, a, b, size }), 1..14)
}

pub fn place(steps: Steps) -> Vec3 {
    Vec3::from_array(steps.map(|x| f32::from(x) / 64.0))
}

impl Item {
    /// Whether its image, when it is turned anyhow, is of its kind.
    pub fn turns(&self) -> bool {
        self.kind != Kind::Fractal
    }

    fn add(&self, s: &mut Description) {
        let (at, a, b, size) = (place(self.at), place(self.a), place(self.b), f32::from(self.size) / 64.0);
        let half = a.abs() * 0.25 + 0.0625;
        let (material, sides, caps) = (0, Sides::Both, self.size.is_multiple_of(2));
        match self.kind {
            Kind::Plane => s.planes.push(plane(a, b.x * 2.0)),
            Kind::Sphere => s.spheres.push(sphere(at, size * 0.5)),
            Kind::Triangle => s.meshes.push(mesh(&[[at, at + a, at + b]])),
            Kind::Quad => s.quads.push(Quad { corner: at, u: a, v: b, material }),
            Kind::Cuboid => s.cuboids.push(Cuboid { min: at - half, max: at + half, rotation: Vec3::ZERO, material }),
            Kind::Turned => s.cuboids.push(Cuboid { min: at - half, max: at + half, rotation: b * 64.0, material }),
            Kind::Cylinder => {
                s.cylinders.push(Cylinder { base: at, apex: at + a, radius: size * 0.5, caps, sides, material });
            }
            Kind::Cone => {
                let (base_radius, apex_radius) = (size * 0.5, b.x.abs() * 0.25);
                s.cones.push(Cone { base: at, base_radius, apex: at + a, apex_radius, caps, sides, material });
            }
            Kind::Torus => {
                let (major_radius, minor_radius) = (size, size * 0.25);
                s.tori.push(Torus { center: at, axis: a, major_radius, minor_radius, material });
            }
            Kind::Fractal => {
                s.fractals.push(Fractal {
                    center: at,
                    radius: size * 0.5,
                    iterations: u32::from(self.size % 4),
                    material,
                });
            }
            Kind::Disc => {
                let inner_radius = if caps { size * 0.25 } else { 0.0 };
                s.discs.push(Disc { center: at, normal: a, radius: size, inner_radius, material });
            }
        }
    }
}

/// A scene of what is sound, lit, and seen from a little outside.
pub fn scene(items: &[Item]) -> Description {
    let mut scene = Description { lights: vec![light(vec3(3.0, 4.5, 5.25))], ..empty() };
    (scene.camera.eye, scene.camera.look_at) = (vec3(0.75, 1.25, 4.5), vec3(0.125, -0.25, 0.5));
    for item in items {
        let mut more = scene.clone();
        item.add(&mut more);
        // A vector may be zero, or two of them parallel.
        if check(&more).is_ok() {
            scene = more;
        }
    }
    scene
}
