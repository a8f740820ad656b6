//! A small closed mesh, far from the world's origin or from the eye.

use glam::{DVec3, Vec3};

use super::draw::{passes_by, towards, until};
use super::triangle::alone;
use super::{Made, Pcg};
use crate::scene::Description;

/// Rings of vertices between the poles.
const RINGS: u32 = 7;

/// Vertices a ring.
const AROUND: u32 = 12;

/// A globe of radius 1 with uneven ground, about `center`.
fn globe(center: DVec3, rng: &mut Pcg) -> Description {
    let axis = rng.direction();
    let x = rng.across(axis);
    let y = axis.cross(x);
    let mut positions = vec![axis];
    for ring in 1..=RINGS {
        let (sin, cos) = (std::f64::consts::PI * f64::from(ring) / f64::from(RINGS + 1)).sin_cos();
        for k in 0..AROUND {
            let (east, north) = (std::f64::consts::TAU * f64::from(k) / f64::from(AROUND)).sin_cos();
            let ground = rng.between(0.9, 1.0);
            positions.push((axis * cos + (x * north + y * east) * sin) * ground);
        }
    }
    positions.push(-axis);
    let at = |ring: u32, k: u32| 1 + ring * AROUND + k % AROUND;
    let last = 1 + RINGS * AROUND;
    let mut triangles = Vec::new();
    for k in 0..AROUND {
        triangles.push([0, at(0, k), at(0, k + 1)]);
        for ring in 0..RINGS - 1 {
            let [near, far] = [ring, ring + 1].map(|r| [at(r, k), at(r, k + 1)]);
            triangles.push([near[0], far[0], far[1]]);
            triangles.push([near[0], far[1], near[1]]);
        }
        triangles.push([at(RINGS - 1, k), last, at(RINGS - 1, k + 1)]);
    }
    alone(positions.into_iter().map(|p| (center + p).as_vec3()).collect(), triangles)
}

/// A point of one of its triangles.
fn target(globe: &Description, rng: &mut Pcg) -> DVec3 {
    let mesh = &globe.meshes[0];
    let [a, b, c] = rng.pick(&mesh.triangles).map(|i| mesh.positions[i as usize].as_dvec3());
    let (u, v) = (rng.between(0.0, 1.0), rng.between(0.0, 1.0));
    a + ((b - a) * (1.0 - v) + (c - a) * v) * u.sqrt()
}

/// The mesh `dial` from the world's origin; eyes 3 to 5 from it look at points of its rounded triangles.
pub fn moved(dial: f64, rays: usize, rng: &mut Pcg) -> Made {
    let center = rng.direction() * dial;
    let globe = globe(center, rng);
    let aim = |_| {
        let origin = (center + rng.direction() * rng.between(3.0, 5.0)).as_vec3();
        towards(origin, target(&globe, rng))
    };
    let rays = (0..rays).map(aim).collect();
    (globe, rays)
}

/// The mesh near the world's origin, the eyes `dial` from it; rays pass its centre by up to 1.1.
pub fn far(dial: f64, rays: usize, rng: &mut Pcg) -> Made {
    let center: Vec3 = rng.cube();
    let c = center.as_dvec3();
    let globe = globe(c, rng);
    let aim = |_| {
        let draw = || {
            let origin = (c + rng.direction() * (1.0 + dial)).as_vec3();
            towards(origin, target(&globe, rng))
        };
        until(draw, |ray| passes_by(ray, c) <= 1.1)
    };
    let rays = (0..rays).map(aim).collect();
    (globe, rays)
}
