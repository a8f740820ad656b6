//! The scenes of the matrix.

use glam::{Vec3, vec3};
use raypacket::scene::Description;

use crate::common::{Pcg, empty, mesh, plane, sphere};

/// What a scene is made of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    Planes,
    Spheres,
    Triangles,
    Mixed,
    Empty,
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
    if kind == Kind::Coincident {
        scene.planes.extend(scene.planes.clone());
        scene.spheres.extend(scene.spheres.clone());
        scene.meshes.extend(scene.meshes.clone());
    }
    scene
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
