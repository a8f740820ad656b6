//! Batches of rays that are hard on boxes.

use glam::Vec3;
use raypacket::bvh::Aabb;
use raypacket::math::BATCH;
use raypacket::trace::{NONE, RayBatch};

use crate::common::Pcg;
use crate::pair::Pair;

/// Where the rays of a batch start.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Origins {
    /// At one point.
    Shared,
    /// Close together.
    Near,
    /// Anywhere.
    Apart,
}

/// Where they go.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Directions {
    /// Within a cone, from narrow to wide, towards something.
    Coherent,
    /// Anywhere.
    Random,
    /// To corners, edges, faces and insides of boxes.
    Boxes,
    /// Along axes and diagonals, with 0 and −0.
    Axes,
    /// From a point in a triangle's, quad's or disc's plane, in this plane or a few ε off it.
    Flat,
    /// To points on the lines of the edges of triangles and quads and of discs' axes, on them and next to their ends.
    Ends,
}

/// A batch as it comes, and the same with intervals that end or start at hits.
pub fn batches(pair: &mut Pair, rng: &mut Pcg) -> [RayBatch; 2] {
    let rays = batch(pair, rng);
    let hits = pair.hits(&rays);
    let mut cut = rays.clone();
    for i in (0..rays.len).filter(|&i| rays.t_max[i] >= 0.0 && hits.primitive[i] != NONE) {
        let t = hits.t[i];
        match rng.below(6) {
            0 => cut.t_max[i] = t,
            1 => cut.t_min[i] = t,
            // Just so that the hit is still in.
            2 => cut.t_max[i] = t.next_up(),
            3 => cut.t_min[i] = t.next_down().max(0.0),
            4 => (cut.t_min[i], cut.t_max[i]) = (t, t),
            _ => {}
        }
    }
    [rays, cut]
}

fn batch(pair: &mut Pair, rng: &mut Pcg) -> RayBatch {
    let origins = rng.pick(&[Origins::Shared, Origins::Near, Origins::Apart]);
    let directions = rng.pick(&[
        Directions::Coherent,
        Directions::Coherent,
        Directions::Random,
        Directions::Boxes,
        Directions::Axes,
        Directions::Flat,
        Directions::Ends,
    ]);
    let bounds = pair.bounds;
    let size = (bounds.max - bounds.min).max_element().max(1e-6);
    let flat = if directions == Directions::Flat { flat_of(pair, rng) } else { None };
    let base = start_in(flat, pair, size, rng);
    let spread = size * rng.pick(&[0.3, 0.05, 1e-3, 1e-6, 1e-12]);
    let toward = pair.boxes.get(rng.below(pair.boxes.len().max(1))).map_or(rng.cube(), |b| within(b, rng) - base);
    let axis = toward.try_normalize().unwrap_or_else(|| rng.unit());
    let width = rng.pick(&[0.7, 0.14, 0.1, 0.01, 1e-4, 1e-7]);
    let inactive = rng.pick(&[0.0, 0.0, 0.1, 0.6]);
    let mut rays = RayBatch::default();
    let len = rng.pick(&[1, 2, 8, 15, 16, 17, 40, 100, 255, BATCH]);
    for i in 0..len {
        // A whole group of inactive rays here and there.
        if rng.chance(inactive) || (inactive > 0.0 && i / 16 % 3 == 1) {
            rays.push_inactive();
            continue;
        }
        let origin = match origins {
            Origins::Shared => base,
            Origins::Near => base + rng.cube() * spread,
            Origins::Apart => start_in(flat, pair, size, rng),
        };
        let direction = match directions {
            Directions::Coherent => axis + rng.cube() * width,
            Directions::Boxes if !pair.boxes.is_empty() => {
                within(&pair.boxes[rng.below(pair.boxes.len())], rng) - origin
            }
            Directions::Axes => Vec3::from_array([0, 1, 2].map(|_| rng.pick(&[0.0, -0.0, 0.0, -0.0, 1.0, -1.0]))),
            Directions::Flat if flat.is_some() => {
                flat.map_or(axis, |f| f.along(origin, rng)) + rng.unit() * rng.pick(&[0.0, 0.0, 1e-8, 1e-7, 1e-6, 1e-4])
            }
            Directions::Ends => flat_of(pair, rng).map_or(axis, |f| f.end(rng) - origin),
            _ => rng.unit(),
        };
        let direction = direction.try_normalize().unwrap_or_else(|| rng.pick(&Vec3::AXES));
        let t_min = if rng.chance(0.1) { size * rng.range(0.0, 1.0) } else { 0.0 };
        let t_max = match rng.below(10) {
            0 => 0.0,
            1 | 2 => size * rng.range(0.0, 2.0),
            _ => f32::INFINITY,
        };
        rays.push(origin, direction, t_min, t_max);
    }
    if rng.chance(0.3) {
        // It may be true all the same.
        rays.common_origin = false;
        if origins == Origins::Shared {
            for (axis, value) in base.to_array().into_iter().enumerate() {
                rays.origin[axis][..len].fill(value);
            }
        }
    }
    if rays.common_origin {
        // Nothing but ray 0's may be read then.
        let other = rng.pick(&[Vec3::NAN, bounds.min - size, bounds.max + size * 30.0, bounds.center()]);
        (0..3).for_each(|axis| rays.origin[axis][1..].fill(other[axis]));
    }
    rays
}

/// In the plane of `flat`, if that is wanted.
fn start_in(flat: Option<Flat>, pair: &mut Pair, size: f32, rng: &mut Pcg) -> Vec3 {
    match flat {
        Some(flat) => flat.start(rng),
        None => start(pair, size, rng),
    }
}

/// Far off, in boxes and on their faces, edges and corners, on surfaces, at the world's origin, anywhere.
fn start(pair: &mut Pair, size: f32, rng: &mut Pcg) -> Vec3 {
    let bounds = pair.bounds;
    let anywhere = bounds.min + (bounds.max - bounds.min) * (rng.cube() * 0.5 + 0.5);
    let some = pair.boxes.get(rng.below(pair.boxes.len().max(1))).copied();
    match (rng.below(8), some) {
        (0, _) => bounds.center() + rng.unit() * (size * rng.pick(&[1.0, 3.0, 50.0])),
        (1..4, Some(b)) => within(&b, rng),
        (4 | 5, Some(b)) => on_surface(pair, &b, rng).unwrap_or(anywhere),
        (6, _) => Vec3::ZERO,
        _ => anywhere,
    }
}

/// A point of a box: its coordinates are of a face, the middle or anything between.
fn within(b: &Aabb, rng: &mut Pcg) -> Vec3 {
    let share = Vec3::from_array([0, 1, 2].map(|_| {
        let between = rng.range(0.0, 1.0);
        rng.pick(&[0.0, 1.0, 0.5, between, between])
    }));
    let p = b.min + (b.max - b.min) * share;
    // On the far face to the bit.
    Vec3::select(share.cmpeq(Vec3::ONE), b.max, p)
}

/// A point on what a ray to the box hits.
fn on_surface(pair: &mut Pair, b: &Aabb, rng: &mut Pcg) -> Option<Vec3> {
    let direction = rng.unit();
    let origin = b.center() - direction * ((b.max - b.min).max_element() * rng.range(0.5, 3.0));
    let mut one = RayBatch::default();
    one.push(origin, direction, 0.0, f32::INFINITY);
    let hits = pair.hits(&one);
    (hits.primitive[0] != NONE).then(|| origin + direction * hits.t[0])
}

/// A corner and two edges.
#[derive(Clone, Copy)]
struct Flat {
    corner: Vec3,
    edges: [Vec3; 2],
}

/// Of some triangle or quad; a disc's edges are its axes.
fn flat_of(pair: &Pair, rng: &mut Pcg) -> Option<Flat> {
    let scene = &pair.with;
    let (triangles, quads) = (scene.triangles.material.len(), scene.quads.material.len());
    let discs = scene.discs.material.len();
    let i = rng.below((triangles + quads + discs).max(1));
    let [corner, u, v] = match i.checked_sub(triangles) {
        None => scene.triangles.corner_and_edges(i),
        Some(i) if i < quads => scene.quads.corner_and_edges(i),
        Some(i) if i - quads < discs => {
            let (i, axes) = (i - quads, scene.discs.axes[i - quads]);
            [scene.discs.center(i), axes[0] * scene.discs.radius[i], axes[1] * scene.discs.radius[i]]
        }
        Some(_) => return None,
    };
    Some(Flat { corner, edges: [u, v] })
}

impl Flat {
    /// On the line of an edge, mostly near one of its ends.
    fn end(&self, rng: &mut Pcg) -> Vec3 {
        let [u, v] = self.edges;
        let (from, along) = rng.pick(&[(Vec3::ZERO, u), (Vec3::ZERO, v), (u, v - u), (u, v), (v, u)]);
        let off = rng.pick(&[0.0, 1e-7, -1e-7, 1e-6, 1e-5, 1e-4, -1e-4, 1e-3]);
        let any = rng.range(0.0, 1.0);
        self.corner + from + along * rng.pick(&[-off, 1.0 + off, any])
    }

    /// In its plane, mostly outside.
    fn start(&self, rng: &mut Pcg) -> Vec3 {
        let mut share = || {
            let any = rng.range(-2.0, 3.0);
            rng.pick(&[0.0, 1.0, any, any * 10.0])
        };
        self.corner + self.edges[0] * share() + self.edges[1] * share()
    }

    /// From there to a point of it, or along an edge.
    fn along(&self, origin: Vec3, rng: &mut Pcg) -> Vec3 {
        let [u, v] = self.edges;
        let along = rng.pick(&[u, v, u + v, u - v, -u, -v]);
        let to = self.corner + u * rng.range(0.0, 1.0) + v * rng.range(0.0, 1.0) - origin;
        rng.pick(&[along, to, to]).normalize_or_zero()
    }
}
