//! Fractals, from next to their surface.

use glam::{DVec3, IVec3, Vec3};

use super::draw::{along, closest, empty, off, side};
use super::{Made, Pcg};
use crate::scene::{Description, Fractal};

/// Of the sponge.
const ITERATIONS: u32 = 4;

/// Cells along an edge.
pub const CELLS: i32 = 3_i32.pow(ITERATIONS);

/// Whether a cell, counted from 0 along each axis, is material: no digit to the base 3 of two of its coordinates is 1
/// in the same place. Outside the cube none is.
pub fn solid(cell: IVec3) -> bool {
    let [x, y, z] = cell.to_array();
    let inside = [x, y, z].iter().all(|c| (0..CELLS).contains(c));
    let void = |power: u32| [x, y, z].iter().filter(|&&c| c / 3_i32.pow(power) % 3 == 1).count() >= 2;
    inside && !(0..ITERATIONS).any(void)
}

/// The edge of a cell: the width of the finest holes.
pub fn width(radius: f32) -> f64 {
    2.0 * f64::from(radius) / f64::from(CELLS)
}

/// Two cells that share a face of the surface: the void one, and the way to the material one.
fn face(rng: &mut Pcg) -> (IVec3, IVec3) {
    loop {
        let cell = IVec3::from_array(std::array::from_fn(|_| rng.below(CELLS as usize) as i32));
        let mut step = IVec3::ZERO;
        step[rng.below(3)] = rng.sign() as i32;
        if !solid(cell) && solid(cell + step) {
            return (cell, step);
        }
    }
}

/// Rays in all directions from `dial` widths of the finest holes off a face, in the void and in the material in turn;
/// no other face is nearer.
pub fn surface(dial: f64, rays: usize, rng: &mut Pcg) -> Made {
    let fractal = Fractal { center: rng.cube() * 0.5, radius: 1.0, iterations: ITERATIONS, material: 0 };
    let (c, width) = (fractal.center.as_dvec3(), width(fractal.radius));
    let aim = |i| {
        let (cell, step) = face(rng);
        let out = -step.as_dvec3();
        let middle = c + (cell.as_dvec3() - DVec3::splat(0.5 * f64::from(CELLS - 1))) * width;
        let foot = middle - out * (0.5 * width);
        let draw = || {
            let beside = out.cross(rng.direction()) * (0.5 - dial);
            (foot + (beside + out * (side(i) * dial)) * width).as_vec3()
        };
        let height = |origin: &Vec3| (origin.as_dvec3() - foot).dot(out) * side(i) / width;
        let origin = closest(draw, |o| off(height(o), dial));
        along(origin, rng.direction())
    };
    let rays = (0..rays).map(aim).collect();
    (Description { fractals: vec![fractal], ..empty() }, rays)
}
