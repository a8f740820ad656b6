//! Menger sponges: the closed set of the smallest cubes that are left, a grid of N × N × N cells, N = 3^iterations.
//!
//! The ray is followed from one plane of the grid to the next. All planes' distances are brought over one denominator, so
//! that they are compared, and found equal, exactly. Between planes the ray is in solid or in void; the hit is the first
//! plane where that changes, or where it touches a cube in an edge or corner.

use super::body::{Body, Crossing, Line, exact3};
use super::exact::{Exact, Exact3, minus};
use super::root::Root;
use crate::scene::Fractal;
use glam::DVec3;

/// As the description allows.
const MAX_ITERATIONS: u32 = 8;

/// The ray along one axis of the grid. Planes and cells count in the order in which the ray passes them: cell j lies
/// between the planes j and j + 1, and the sponge, which is its own mirror image, does not change by that.
enum Progress {
    /// It has passed the planes before `next`, which comes at `t`; the others `step` after each other.
    Moving { next: i64, t: Exact, step: Exact },
    /// It stays in a cell, or in the plane between two.
    Still([i64; 2]),
}

impl Progress {
    fn next(&self) -> Option<&Exact> {
        match self {
            Self::Moving { t, .. } => Some(t),
            Self::Still(_) => None,
        }
    }

    /// The cells that the ray is in or touches before, after, or while it passes the next plane.
    fn cells(&self, when: When) -> [i64; 2] {
        match (self, when) {
            (Self::Still(cells), _) => *cells,
            (Self::Moving { next, .. }, When::Before) => [next - 1; 2],
            (Self::Moving { next, .. }, When::After) => [*next; 2],
            (Self::Moving { next, .. }, When::During) => [next - 1, *next],
        }
    }
}

#[derive(Clone, Copy, PartialEq)]
enum When {
    Before,
    During,
    After,
}

impl Body for Fractal {
    fn first(&self, line: &Line) -> Option<Crossing> {
        let walk = Walk::new(self, line)?;
        let (t, normal) = walk.first_change()?;
        Some(Crossing { t, normal })
    }

    fn tips(&self, _width: f64) -> Vec<DVec3> {
        vec![]
    }

    fn ball(&self) -> Option<(DVec3, f64)> {
        Some((self.center.as_dvec3(), f64::from(self.radius) * 3f64.sqrt()))
    }

    fn thickness(&self) -> f64 {
        2.0 * f64::from(self.radius) / 3f64.powi(self.iterations.min(8) as i32)
    }
}

struct Walk {
    axes: [Progress; 3],
    ascending: [bool; 3],
    cells: i64,
    /// All of `t` is to be divided by this.
    denominator: Exact,
    end: Option<Exact>,
}

impl Walk {
    /// At the first plane of each axis in the interval and not before the cube; `None` where the ray misses the cube.
    fn new(it: &Fractal, line: &Line) -> Option<Self> {
        let cells = 3i64.pow(it.iterations.min(MAX_ITERATIONS));
        let f = minus(&line.origin, &exact3(it.center)?);
        let (d, radius, n) = (&line.direction, Exact::from_f32(it.radius)?, Exact::integer(cells));
        if radius.sign().is_le() {
            return None;
        }
        let product = |skipped: Option<usize>| {
            let moving = (0..3).filter(|axis| Some(*axis) != skipped && !d[*axis].is_zero());
            moving.fold(Exact::integer(1), |product, axis| product * d[axis].abs())
        };
        let denominator = product(None) * &n;
        let scale = |t: &Option<Exact>| t.as_ref().map(|t| t * &denominator);
        let (start, end) = (scale(&line.span.low), scale(&line.span.high));
        // From plane 0 of each axis.
        let mut axes: Vec<Progress> = Vec::with_capacity(3);
        for axis in 0..3 {
            if d[axis].is_zero() {
                axes.push(Progress::Still(still(&f[axis], &radius, cells)?));
                continue;
            }
            let ahead = if d[axis].sign().is_gt() { -&f[axis] } else { f[axis].clone() };
            let others = product(Some(axis));
            let t = (ahead - &radius) * &n * &others;
            axes.push(Progress::Moving { next: 0, t, step: radius.scaled(1) * others });
        }
        let span = |progress: &Progress| match progress {
            Progress::Moving { t, step, .. } => Some((t.clone(), t + &n * step)),
            Progress::Still(_) => None,
        };
        let (enter, exit) = (axes.iter().filter_map(span)).reduce(|a, b| (a.0.max(b.0), a.1.min(b.1)))?;
        if enter > exit {
            return None;
        }
        for progress in &mut axes {
            let Progress::Moving { next, t, step } = progress else { continue };
            // Planes before `enter`, or up to and with `start`.
            let passed = match &start {
                Some(start) if *start >= enter => (start - &*t).floor_quotient(step).saturating_add(1),
                _ => -(&*t - &enter).floor_quotient(step),
            };
            *next = passed.clamp(0, cells + 1);
            *t = &*t + Exact::integer(*next) * &*step;
        }
        let axes = axes.try_into().ok()?;
        Some(Self { axes, ascending: [0, 1, 2].map(|i| d[i].sign().is_gt()), cells, denominator, end })
    }

    /// Where solid and void change, with the outward normal.
    fn first_change(mut self) -> Option<(Exact, Exact3)> {
        loop {
            let t = self.axes.iter().filter_map(Progress::next).min()?.clone();
            let crossed = self.axes.each_ref().map(|axis| axis.next().is_some_and(|next| *next == t));
            let beyond = |axis: &Progress| matches!(axis, Progress::Moving { next, .. } if *next > self.cells);
            if self.end.as_ref().is_some_and(|end| t >= *end) || self.axes.iter().any(beyond) {
                return None;
            }
            let [before, during, after] = [When::Before, When::During, When::After].map(|w| self.solid(crossed, w));
            if before != after || (during && !before) {
                let t = Root::ratio(t, self.denominator.clone())?.value();
                return Some((t, self.normal(crossed, before)));
            }
            for (axis, crossed) in self.axes.iter_mut().zip(crossed) {
                if let (Progress::Moving { next, t, step }, true) = (axis, crossed) {
                    (*next, *t) = (*next + 1, &*t + &*step);
                }
            }
        }
    }

    fn places(&self, crossed: [bool; 3], when: When) -> [[i64; 2]; 3] {
        [0, 1, 2].map(|i| self.axes[i].cells(if crossed[i] { when } else { When::Before }))
    }

    /// Whether the ray is in solid cubes, or touches one.
    fn solid(&self, crossed: [bool; 3], when: When) -> bool {
        each(self.places(crossed, when)).any(|cell| is_solid(cell, self.cells))
    }

    /// Of the planes that are crossed at once, the first that separates solid from void there. There is one: from a solid
    /// cell to the void that the ray is in, crossing a plane at a time, one step leads out.
    fn normal(&self, crossed: [bool; 3], leaves: bool) -> Exact3 {
        let (void, solid) = if leaves { (When::After, When::Before) } else { (When::Before, When::After) };
        let separates = |axis: &usize| {
            let mut around = self.places(crossed, When::During);
            let mut beside = |when| {
                around[*axis] = self.axes[*axis].cells(when);
                each(around).map(|cell| is_solid(cell, self.cells)).collect::<Vec<_>>()
            };
            beside(solid).into_iter().zip(beside(void)).any(|(solid, void)| solid && !void)
        };
        let axis = (0..3).filter(|axis| crossed[*axis]).find(separates).unwrap_or(0);
        let side = if self.ascending[axis] == leaves { 1 } else { -1 };
        [0, 1, 2].map(|i| Exact::integer(if i == axis { side } else { 0 }))
    }
}

/// Where a coordinate from the centre is in the grid; `None` outside of the cube.
fn still(f: &Exact, radius: &Exact, cells: i64) -> Option<[i64; 2]> {
    if f.abs() > *radius {
        return None;
    }
    let (place, cell) = ((f + radius) * Exact::integer(cells), radius.scaled(1));
    let j = place.floor_quotient(&cell);
    let in_plane = place == Exact::integer(j) * cell;
    Some(if in_plane { [j - 1, j] } else { [j; 2] })
}

/// The cells that have one of two places along each axis.
fn each(places: [[i64; 2]; 3]) -> impl Iterator<Item = [i64; 3]> {
    let [x, y, z] = places.map(|[a, b]| std::iter::once(a).chain((a != b).then_some(b)));
    x.flat_map(move |x| {
        z.clone().flat_map({
            let y = y.clone();
            move |z| y.clone().map(move |y| [x, y, z])
        })
    })
}

/// Whether a cell is left: on no level are two of its coordinates in the middle.
fn is_solid(cell: [i64; 3], cells: i64) -> bool {
    let in_middle = |size: i64| cell.iter().filter(|c| *c / size % 3 == 1).count();
    let sizes = std::iter::successors(Some(cells / 3), |size| Some(size / 3)).take_while(|size| *size > 0);
    cell.iter().all(|c| (0..cells).contains(c)) && sizes.into_iter().all(|size| in_middle(size) < 2)
}
