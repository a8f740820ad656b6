//! The outlines that a horizontal plane cuts out of a scene's primitives, in (x, z), in `f64` from the description.
//!
//! What is curved but no circle comes as segments. There are as many as the pane can show, and none where it shows
//! nothing, so that the work of a frame is bounded by the primitives' number and the pane's size.

use super::{
    map::{Layout, flat},
    turned,
};
use crate::scene::{Cuboid, Description, Fractal, Plane, Quad, Sphere};
use glam::{DMat3, DVec2, DVec3, Vec2Swizzles, Vec3Swizzles};

/// A piece of what a horizontal plane cuts out of a primitive, in (x, z).
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Cut {
    /// Out of a sphere, or of the side of a body that stands upright.
    Circle {
        /// Its middle.
        center: DVec2,
        /// Not negative.
        radius: f64,
    },
    /// Out of a plane: an endless line.
    Line {
        /// One of its points.
        point: DVec2,
        /// Of any length but zero.
        direction: DVec2,
    },
    /// Out of something flat, or a piece of a curve.
    Segment(DVec2, DVec2),
}

/// The part of a horizontal plane that is seen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Section {
    /// The plane's height.
    pub y: f64,
    /// The middle of what is seen, in (x, z).
    pub center: DVec2,
    /// All that is seen is no further from there.
    pub radius: f64,
    /// What a pixel measures in the world: outlines are right to a quarter of it.
    pub pixel: f64,
}

impl Section {
    /// What a pane shows of the plane at height `y`.
    pub fn new(layout: &Layout, y: f32) -> Self {
        Self { y: y.into(), center: layout.center, radius: layout.reach(), pixel: 1.0 / layout.scale }
    }

    /// Whether a ball comes to the part that is seen.
    pub fn meets(&self, center: DVec3, radius: f64) -> bool {
        (center.y - self.y).abs() <= radius && center.xz().distance(self.center) <= radius + self.radius
    }

    /// Into how many pieces to divide half an ellipse, evenly by its angle, whose greater semi-axis is `size` or which
    /// shows no more of it: the middles of their chords are size (1 − cos(π / 2n)) ≈ size π² / 8n² off.
    pub fn pieces(&self, size: f64) -> u32 {
        let pixels = size.min(self.radius) / self.pixel;
        // Down to at least an octagon; a pane of 16384² pixels needs no more than 239. NaN becomes 0.
        ((std::f64::consts::PI * (pixels / 2.0).sqrt()).ceil() as u32).clamp(4, 256)
    }
}

/// Hands on everything that a horizontal plane cuts, as far as it is seen.
pub fn cuts(description: &Description, section: &Section, mut emit: impl FnMut(Cut)) {
    let y = section.y;
    // Whatever the description holds, nothing but numbers gets through.
    let emit = &mut |cut: Cut| {
        let sound = match cut {
            Cut::Circle { center, radius } => center.is_finite() && radius.is_finite(),
            Cut::Line { point, direction } => point.is_finite() && direction.is_finite(),
            Cut::Segment(from, to) => from.is_finite() && to.is_finite(),
        };
        if sound {
            emit(cut);
        }
    };
    description.planes.iter().filter_map(|plane| plane_cut(plane, y)).for_each(&mut *emit);
    description.spheres.iter().filter_map(|sphere| sphere_cut(sphere, y)).for_each(&mut *emit);
    for mesh in &description.meshes {
        let corner = |i: u32| mesh.positions.get(i as usize).map(|p| p.as_dvec3());
        let triangle = |&[a, b, c]: &[u32; 3]| polygon_cut(&[corner(a)?, corner(b)?, corner(c)?], y);
        mesh.triangles.iter().filter_map(triangle).for_each(&mut *emit);
    }
    description.quads.iter().filter_map(|quad| polygon_cut(&quad_corners(quad), y)).for_each(&mut *emit);
    description.cuboids.iter().for_each(|cuboid| cuboid_cuts(cuboid, section, emit));
    for c in &description.cylinders {
        turned::side_cuts([c.base, c.apex], [c.radius, c.radius], c.caps, section, emit);
    }
    for c in &description.cones {
        turned::side_cuts([c.base, c.apex], [c.base_radius, c.apex_radius], c.caps, section, emit);
    }
    description.tori.iter().for_each(|torus| turned::torus_cuts(torus, section, emit));
    description.fractals.iter().for_each(|fractal| fractal_cuts(fractal, section, emit));
}

/// None when the plane is parallel to the slice.
fn plane_cut(plane: &Plane, y: f64) -> Option<Cut> {
    let normal = plane.normal.as_dvec3();
    let across = flat(plane.normal);
    let (length, offset) = (across.length_squared(), f64::from(plane.distance) + normal.y * y);
    // A nearly parallel plane is cut far away, where clipping leaves it out.
    (length > 0.0).then(|| Cut::Line { point: across * (-offset / length), direction: across.perp() })
}

fn sphere_cut(sphere: &Sphere, y: f64) -> Option<Cut> {
    let (radius, above) = (f64::from(sphere.radius), (f64::from(sphere.center.y) - y).abs());
    let squared = (radius - above) * (radius + above);
    (above <= radius).then(|| Cut::Circle { center: flat(sphere.center), radius: squared.max(0.0).sqrt() })
}

/// What the plane cuts out of a convex polygon.
///
/// A corner on the slice counts as above it, so that neighbours agree on a shared edge and corner, and a polygon that
/// lies in the slice is not cut.
fn polygon_cut(corners: &[DVec3], y: f64) -> Option<Cut> {
    let next = corners.iter().cycle().skip(1);
    let mut crossings = corners.iter().zip(next).filter(|(a, b)| (a.y >= y) != (b.y >= y)).map(|(&a, &b)| {
        // Always from below, so that neighbours agree on the point as well.
        let (from, to) = if a.y >= y { (b, a) } else { (a, b) };
        from.lerp(to, (y - from.y) / (to.y - from.y)).xz()
    });
    Some(Cut::Segment(crossings.next()?, crossings.next()?))
}

/// In order.
pub fn quad_corners(quad: &Quad) -> [DVec3; 4] {
    let [corner, u, v] = [quad.corner, quad.u, quad.v].map(|v| v.as_dvec3());
    [corner, corner + u, corner + u + v, corner + v]
}

/// The corner of index i has the greater x, y, z, before it is turned, where bit 0, 1, 2 of i is set.
pub fn cuboid_corners(cuboid: &Cuboid) -> [DVec3; 8] {
    let (min, max) = (cuboid.min.as_dvec3(), cuboid.max.as_dvec3());
    let (center, half) = ((min + max) / 2.0, (max - min) / 2.0);
    let [x, y, z] = cuboid.rotation.as_dvec3().to_array().map(f64::to_radians);
    let turn = DMat3::from_rotation_z(z) * DMat3::from_rotation_y(y) * DMat3::from_rotation_x(x);
    let axes = [turn.x_axis * half.x, turn.y_axis * half.y, turn.z_axis * half.z];
    std::array::from_fn(|i| {
        let side = |bit: usize| if i >> bit & 1 == 1 { axes[bit] } else { -axes[bit] };
        center + side(0) + side(1) + side(2)
    })
}

fn cuboid_cuts(cuboid: &Cuboid, section: &Section, emit: &mut dyn FnMut(Cut)) {
    let (min, max) = (cuboid.min.as_dvec3(), cuboid.max.as_dvec3());
    if !section.meets((min + max) / 2.0, (max - min).length() / 2.0) {
        return;
    }
    let corners = cuboid_corners(cuboid);
    for [a, b] in [[1, 2], [2, 4], [4, 1]] {
        let opposite = 7 - a - b;
        for first in [0, opposite] {
            let face = [first, first + a, first + a + b, first + b].map(|i| corners[i]);
            polygon_cut(&face, section.y).into_iter().for_each(&mut *emit);
        }
    }
}

/// Cells narrower than this many pixels are drawn as one with those around them.
const CELL_PIXELS: f64 = 3.0;

/// The outline of what a Menger sponge holds at a height: a grid of 3ⁿ × 3ⁿ cells, with a line wherever a full one
/// meets an empty one.
fn fractal_cuts(fractal: &Fractal, section: &Section, emit: &mut dyn FnMut(Cut)) {
    let (center, radius) = (fractal.center.as_dvec3(), f64::from(fractal.radius));
    if !section.meets(center, radius * 3f64.sqrt()) {
        return;
    }
    let (low, edge) = (center - radius, 2.0 * radius);
    let fits = |&level: &u32| edge / 3f64.powi(level as i32) >= CELL_PIXELS * section.pixel;
    // The description allows 8; what does not is nothing to hang on.
    let level = (1..=fractal.iterations.min(8)).take_while(fits).last().unwrap_or(0);
    let n = 3usize.pow(level);
    let cell = edge / n as f64;
    // As with corners, a face on the slice counts as above it.
    let layer = ((section.y - low.y) / cell).ceil() - 1.0;
    if !(layer >= 0.0 && layer < n as f64) {
        return;
    }
    let layer = middles(layer as usize, level);
    // The cells that are seen; conversion to an integer saturates.
    let seen = |low: f64, center: f64| {
        let index = |x: f64| (((x - low) / cell).floor() as usize).min(n);
        index(center - section.radius)..(index(center + section.radius) + 1).min(n)
    };
    let seen = [seen(low.x, section.center.x), seen(low.z, section.center.y)];
    let columns: Vec<usize> = (0..n).map(|i| middles(i, level)).collect();
    let full = |i: usize, k: usize| match (columns.get(i), columns.get(k)) {
        (Some(i), Some(k)) => (i & k) | (i & layer) | (k & layer) == 0,
        _ => false,
    };
    for axis in 0..2 {
        let place = |i: usize, k: usize| {
            let offset = DVec2::new(i as f64, k as f64) * cell;
            low.xz() + if axis == 0 { offset } else { offset.yx() }
        };
        for i in seen[axis].start..=seen[axis].end {
            // A section is the same when x and z are exchanged. Before the first cell comes index −1, outside.
            let edge = |k: &usize| full(i, *k) != full(i.wrapping_sub(1), *k);
            let mut k = seen[1 - axis].start;
            while let Some(start) = (k..seen[1 - axis].end).find(edge) {
                k = (start..seen[1 - axis].end).find(|k| !edge(k)).unwrap_or(seen[1 - axis].end);
                emit(Cut::Segment(place(i, start), place(i, k)));
            }
        }
    }
}

/// The iterations in which a cell's row (column, layer) is the middle one of three, as bits. Those cells are empty
/// in which an iteration finds two of the three so.
fn middles(index: usize, level: u32) -> usize {
    (0..level).filter(|&digit| index / 3usize.pow(digit) % 3 == 1).map(|digit| 1 << digit).sum()
}

#[cfg(test)]
#[path = "cut_tests.rs"]
mod tests;
