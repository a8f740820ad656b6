//! Menger sponges.
use super::{Edges, FACE, cuboid::face_uv};
use super::{Primitive, Primitives};
use crate::scene;
use glam::{DVec2, DVec3, IVec3};

#[derive(Clone, Debug)]
pub(super) struct Fractal {
    center: DVec3,
    radius: f64,
    iterations: u32,
    material: usize,
}

/// A ray in the sponge's grid: the smallest cubes have edge 1, the whole has its least corner at 0.
///
/// The planes are whole numbers there, so every t is exact but for the subtraction and the division by which it is
/// made, and the same for all cubes that share the plane.
struct GridRay {
    origin: DVec3,
    direction: DVec3,
}

/// A stretch of the ray within touching solid cubes.
type Run = Option<(f64, f64)>;

impl GridRay {
    /// Where the ray enters and leaves a closed cube, if it meets it ahead.
    fn through(&self, low: IVec3, size: i32) -> Option<(f64, f64)> {
        let (mut enter, mut exit) = (f64::NEG_INFINITY, f64::INFINITY);
        for axis in 0..3 {
            let (o, d) = (self.origin[axis], self.direction[axis]);
            let (near, far) = (f64::from(low[axis]), f64::from(low[axis] + size));
            if d == 0.0 {
                if o < near || o > far {
                    return None;
                }
                continue;
            }
            let (first, last) = if d > 0.0 { (near, far) } else { (far, near) };
            enter = enter.max((first - o) / d);
            exit = exit.min((last - o) / d);
        }
        (enter <= exit && exit > 0.0).then_some((enter, exit))
    }

    /// Goes through the solid cubes of one cube front to back; the distance of the first boundary above 0 once it is
    /// known. `run` is the stretch that the ray is in or has just left.
    fn first_boundary(&self, low: IVec3, size: i32, run: &mut Run) -> Option<f64> {
        let Some(third) = (size > 1).then_some(size / 3) else {
            let (enter, exit) = self.through(low, size)?;
            return extend(run, enter, exit);
        };
        let mut met = Vec::new();
        for i in 0..27 {
            let place = IVec3::new(i % 3, i / 3 % 3, i / 9);
            let middles = place.to_array().iter().filter(|&&p| p == 1).count();
            let low = low + place * third;
            if let (true, Some((enter, _))) = (middles < 2, self.through(low, third)) {
                met.push((enter, low));
            }
        }
        met.sort_by(|a, b| a.0.total_cmp(&b.0));
        met.into_iter().find_map(|(_, low)| self.first_boundary(low, third, run))
    }
}

/// Adds a solid cube's stretch to the run, or says where the first boundary above 0 is when it does not touch it.
fn extend(run: &mut Run, enter: f64, exit: f64) -> Option<f64> {
    match run {
        // Two roundings in each of two quotients: closer stretches touch in an edge or corner.
        Some((_, end)) if enter - *end <= 2.0 * f64::EPSILON * (enter.abs() + end.abs()) => *end = end.max(exit),
        Some((_, end)) if *end > 0.0 => return Some(*end),
        _ => *run = Some((enter, exit)),
    }
    run.and_then(|(start, _)| (start > 0.0).then_some(start))
}

impl Fractal {
    pub fn new(fractal: &scene::Fractal) -> Self {
        Self {
            center: fractal.center.as_dvec3(),
            radius: f64::from(fractal.radius),
            iterations: fractal.iterations,
            material: fractal.material,
        }
    }

    /// How many of the smallest cubes make an edge.
    fn cells(&self) -> i32 {
        3_i32.pow(self.iterations)
    }

    /// A point in the grid.
    fn grid(&self, point: DVec3) -> DVec3 {
        ((point - self.center) / self.radius + 1.0) * (f64::from(self.cells()) / 2.0)
    }

    /// Whether one of the smallest cubes is there.
    fn solid(&self, cell: IVec3) -> bool {
        let inside = cell.min_element() >= 0 && cell.max_element() < self.cells();
        let digits = |level: u32| cell / 3_i32.pow(level) % 3;
        let kept = |level| digits(level).to_array().iter().filter(|&&d| d == 1).count() < 2;
        inside && (0..self.iterations).all(kept)
    }

    /// The face at a point close to it: its axis, its plane in the grid and the outward side.
    ///
    /// Of the planes of the grid next to the point, the nearest that has a solid cube on one side only.
    fn face(&self, point: DVec3) -> (usize, f64, f64) {
        let grid = self.grid(point);
        let last = f64::from(self.cells() - 1);
        let cell = grid.floor().clamp(DVec3::ZERO, DVec3::splat(last)).as_ivec3();
        let mut nearest = (f64::INFINITY, (0, 0.0, 1.0));
        for axis in 0..3 {
            let plane = grid[axis].round().clamp(0.0, last + 1.0);
            let (mut below, mut above) = (cell, cell);
            (below[axis], above[axis]) = (plane as i32 - 1, plane as i32);
            let (below, above) = (self.solid(below), self.solid(above));
            let side = if below { 1.0 } else { -1.0 };
            // On an edge rounding may show the point beside it, where nothing changes: then the nearest plane has to do,
            // if no other is within a part of a cell.
            let far = if below == above { 1.0 / 16.0 } else { 0.0 };
            let distance = far + (grid[axis] - plane).abs();
            if distance < nearest.0 {
                nearest = (distance, (axis, plane, side));
            }
        }
        nearest.1
    }
}

impl Primitives for scene::Fractal {
    fn add(&self, to: &mut Vec<Box<dyn Primitive>>) {
        to.push(Box::new(Fractal::new(self)));
    }
}

impl Primitive for Fractal {
    /// Divides the cube down to the smallest, front to back, and stops at the first face between solid and void.
    fn distance(&self, origin: DVec3, direction: DVec3) -> Option<f64> {
        let per_unit = f64::from(self.cells()) / (2.0 * self.radius);
        let ray = GridRay { origin: self.grid(origin), direction: direction * per_unit };
        ray.through(IVec3::ZERO, self.cells())?;
        let mut run = None;
        let found = ray.first_boundary(IVec3::ZERO, self.cells(), &mut run);
        found.or_else(|| run.map(|(_, end)| end).filter(|&end| end > 0.0))
    }

    fn project(&self, point: DVec3) -> DVec3 {
        let (axis, plane, _) = self.face(point);
        let mut projected = point;
        projected[axis] = self.center[axis] + self.radius * (2.0 * plane / f64::from(self.cells()) - 1.0);
        projected
    }

    fn normal(&self, point: DVec3) -> DVec3 {
        let (axis, _, side) = self.face(point);
        side * DVec3::AXES[axis]
    }

    /// Half the diagonal.
    fn extent(&self) -> f64 {
        self.radius * 3.0_f64.sqrt()
    }

    fn material(&self) -> usize {
        self.material
    }

    fn uv(&self, point: DVec3) -> DVec2 {
        let (axis, _, side) = self.face(point);
        face_uv((point - self.center) / self.radius, axis, side)
    }

    fn edges(&self, _point: DVec3) -> Edges {
        FACE
    }

    fn checker(&self, point: DVec3) -> DVec3 {
        let (axis, ..) = self.face(point);
        let mut q = point - self.center;
        q[axis] = 0.0;
        q
    }
}
