//! What breaks ray tracers: self-shadowing, leaks, eyes and lights in awkward places, depth, odd sizes.

mod bodies;
#[path = "../common/mod.rs"]
mod common;
mod depth;
mod eyes;
mod formulae;
mod glass;
mod leak;
mod lights;
mod reintersect;
mod shadows;
mod sides;
mod sizes;
mod symmetry;
mod textbook;
mod thin;
mod watertight;

use common::Pcg;
use glam::Vec3;

/// Sizes of things, in world units.
const SCALES: [f32; 6] = [1e-3, 1.0, 10.0, 1e3, 1e4, 1e6];

/// A direction within the hemisphere around `normal`, not next to grazing.
fn upward(normal: Vec3, rng: &mut Pcg) -> Vec3 {
    loop {
        let d = rng.unit();
        if d.dot(normal) > 0.05 {
            return d;
        }
    }
}
