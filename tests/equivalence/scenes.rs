//! The scenes of the matrix.

use glam::{Vec3, vec3};
use raypacket::scene::{Cone, Cuboid, Cylinder, Description, Disc, Fractal, Quad, Sides, Torus};

use crate::common::{Pcg, empty, mesh, plane, sphere};

/// What a scene is made of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    Planes,
    Spheres,
    Triangles,
    Mixed,
    Empty,
    /// Quads, boxes, cylinders, cones, tori, fractals and discs.
    Bodies,
    /// Spheres, triangles, cylinders and cones, most of them only seen from one side.
    OneSided,
    /// Everything twice over, so that every hit is a tie.
    Coincident,
}

impl Kind {
    /// Numbers of planes, spheres and triangles: no multiples of a width.
    fn counts(self) -> [usize; 3] {
        match self {
            Kind::Planes => [9, 0, 0],
            Kind::Spheres => [0, 45, 0],
            Kind::Triangles => [0, 0, 45],
            Kind::Mixed => [3, 29, 30],
            Kind::Empty => [0; 3],
            Kind::Bodies => [1, 0, 0],
            Kind::OneSided => [0, 12, 15],
            Kind::Coincident => [3, 13, 11],
        }
    }
}

/// Where a scene lies, and how large it is.
#[derive(Clone, Copy, Debug)]
pub struct Place {
    pub center: Vec3,
    pub scale: f32,
}

impl Place {
    /// Scales from 1e-3 to 1e6, at the world's origin and away from it.
    pub fn random(rng: &mut Pcg) -> Self {
        let scale = rng.pick(&[1.0, 1.0, 1e-3, 0.1, 30.0, 1e3, 1e6]);
        Self { center: rng.cube() * (scale * rng.pick(&[0.0, 1.0, 100.0])), scale }
    }

    /// Anywhere in it.
    pub fn point(&self, rng: &mut Pcg) -> Vec3 {
        self.center + rng.cube() * self.scale
    }
}

/// A random scene.
pub fn scene(kind: Kind, place: Place, rng: &mut Pcg) -> Description {
    let mut scene = empty();
    let [planes, spheres, triangles] = kind.counts();
    for _ in 0..planes {
        // Some through whole points along an axis, where rays start on planes and run parallel to them.
        let normal = if rng.chance(0.5) { rng.pick(&Vec3::AXES) } else { rng.cube() } * rng.pick(&[1.0, -3.0, 0.125]);
        let normal = if normal == Vec3::ZERO { Vec3::Y } else { normal };
        // Some through the world's origin, where rays start at no distance or next to none.
        let through = if rng.chance(0.2) { Vec3::ZERO } else { place.point(rng) };
        scene.planes.push(plane(normal, -normal.dot(through)));
    }
    for _ in 0..spheres {
        // From grains to one that holds most of the others.
        let radius = place.scale * rng.pick(&[0.01, 0.05, 0.2, 0.2, 0.5, 1.5]) * rng.range(0.5, 1.0);
        scene.spheres.push(sphere(place.point(rng), radius));
    }
    let corners: Vec<_> = (0..triangles).map(|_| triangle(place, rng)).collect();
    if triangles > 0 {
        scene.meshes.push(mesh(&corners));
    }
    if matches!(kind, Kind::Bodies | Kind::OneSided) {
        bodies(&mut scene, place, rng);
    }
    if kind == Kind::OneSided {
        scene.quads.clear();
        scene.cuboids.clear();
        scene.tori.clear();
        scene.fractals.clear();
        scene.discs.clear();
        // Trees test spheres together when all have the same side.
        let common = rng.pick(&[None, Some(Sides::Front), Some(Sides::Back)]);
        let mut sides = || rng.pick(&[Sides::Both, Sides::Front, Sides::Back]);
        scene.spheres.iter_mut().for_each(|s| s.sides = common.unwrap_or_else(&mut sides));
        scene.cylinders.iter_mut().for_each(|c| c.sides = sides());
        scene.cones.iter_mut().for_each(|c| c.sides = sides());
        scene.meshes.extend(scene.meshes.clone());
        (scene.meshes[0].sides, scene.meshes[1].sides) = (Sides::Front, Sides::Back);
    }
    if kind == Kind::Coincident {
        scene.planes.extend(scene.planes.clone());
        scene.spheres.extend(scene.spheres.clone());
        scene.meshes.extend(scene.meshes.clone());
    }
    scene
}

/// A few of every kind of body.
fn bodies(scene: &mut Description, place: Place, rng: &mut Pcg) {
    let size = |rng: &mut Pcg| place.scale * rng.pick(&[0.05, 0.2, 0.5]) * rng.range(0.5, 1.0);
    for i in 0..7 {
        let p = place.point(rng);
        let (u, v) = (rng.unit() * size(rng), rng.unit() * size(rng));
        scene.quads.push(Quad { corner: p, u, v, material: 0 });
        let p = place.point(rng);
        let half = vec3(size(rng), size(rng), size(rng));
        let rotation = if i % 2 == 0 { Vec3::ZERO } else { rng.cube() * 180.0 };
        scene.cuboids.push(Cuboid { min: p - half, max: p + half, rotation, material: 0 });
        let base = place.point(rng);
        let along = if i % 3 == 0 { rng.pick(&Vec3::AXES) } else { rng.unit() };
        let apex = base + along * size(rng);
        let (radius, caps, sides) = (size(rng), rng.chance(0.5), Sides::Both);
        scene.cylinders.push(Cylinder { base, apex, radius, caps, sides, material: 0 });
        let base = place.point(rng);
        let apex = base + along * size(rng);
        let (base_radius, apex_radius) = (size(rng), rng.pick(&[0.0, 0.02, 1.2]) * size(rng));
        if base_radius != apex_radius {
            scene.cones.push(Cone { base, base_radius, apex, apex_radius, caps: rng.chance(0.5), sides, material: 0 });
        }
        let major_radius = size(rng);
        let minor_radius = major_radius * rng.pick(&[0.05, 0.3, 1.0]);
        scene.tori.push(Torus { center: place.point(rng), axis: along, major_radius, minor_radius, material: 0 });
        let iterations = rng.below(4) as u32;
        scene.fractals.push(Fractal { center: place.point(rng), radius: size(rng), iterations, material: 0 });
        let (center, normal, radius) = (place.point(rng), along * rng.pick(&[1.0, -0.01, 30.0]), size(rng));
        let inner_radius = radius * rng.pick(&[0.0, 0.3, 0.99]);
        scene.discs.push(Disc { center, normal, radius, inner_radius, material: 0 });
    }
}

/// Small and large, slivers, some in an axis plane; a few without area.
fn triangle(place: Place, rng: &mut Pcg) -> [Vec3; 3] {
    let a = place.point(rng);
    let size = place.scale * rng.pick(&[0.05, 0.3, 1.0, 3.0]);
    let flat = rng.pick(&[Vec3::ONE, Vec3::ONE, vec3(1.0, 0.0, 1.0), vec3(1.0, 1.0, 1e-3)]);
    let (b, c) = (a + rng.cube() * size * flat, a + rng.cube() * size * flat);
    if rng.chance(0.05) { [a, b, b] } else { [a, b, c] }
}

/// Whether a primitive of a [`Kind::Coincident`] scene repeats an earlier one.
pub fn is_copy(id: u32) -> bool {
    let [planes, spheres, triangles] = Kind::Coincident.counts();
    let within = |first: usize, count: usize| (first + count..first + 2 * count).contains(&(id as usize));
    within(0, planes) || within(2 * planes, spheres) || within(2 * (planes + spheres), triangles)
}
