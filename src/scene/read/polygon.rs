//! Polygons to triangles, by clipping ears (Meisters, *Polygons have ears*, 1975).
//!
//! The corners are projected along the axis nearest to the polygon's normal, rather than along the normal itself:
//! the same triangulation for a planar polygon, and the coordinates stay the `f32`s of the file, whose differences
//! and areas `f64` takes nearly without rounding. A corner is clipped where it is convex and no reflex corner is in
//! its triangle; a k-d tree of the reflex corners answers that. Clipping an ear makes ears only of its neighbours, so
//! that about 3 n questions are asked, each usually answered in O(√n), and in O(n) at worst.

use std::collections::VecDeque;

use glam::{DVec2, DVec3, Vec3, Vec3Swizzles};

/// The most corners of a face: at worst, time grows with their square.
pub(super) const MAX_CORNERS: usize = 1 << 16;

/// The roundoff of `f64`.
const UNIT: f64 = f64::EPSILON / 2.0;

/// Divides a polygon into n − 2 triangles that are oriented as it is, by indices into `points`.
///
/// The polygon may be concave and, slightly, not planar; a convex one becomes the fan about corner 0. Corners may
/// repeat, lie on the line of their neighbours, or touch other parts of the outline, as those of a bridge to a hole
/// do: some triangles then have no area. What crosses itself is divided somehow. `None` when the polygon has no area
/// that stands out from rounding, or coordinates that are not finite.
pub(super) fn triangulate(points: &[Vec3]) -> Option<Vec<[u32; 3]>> {
    let flat = project(points)?;
    if convex(&flat) {
        return Some((2..flat.len() as u32).map(|i| [0, i - 1, i]).collect());
    }
    Some(Clipper::new(flat).triangles())
}

/// The corners in two dimensions, so turned that they run counter-clockwise.
fn project(points: &[Vec3]) -> Option<Vec<DVec2>> {
    u32::try_from(points.len()).ok()?;
    let origin = points.first()?.as_dvec3();
    let from_origin = |i: usize| points[i % points.len()].as_dvec3() - origin;
    // Twice the area along each axis (Newell), and what its rounding is measured by.
    let (mut area, mut terms) = (DVec3::ZERO, DVec3::ZERO);
    for i in 1..points.len() {
        let (p, q) = (from_origin(i), from_origin(i + 1));
        area += p.cross(q);
        terms += p.yzx().abs() * q.zxy().abs() + p.zxy().abs() * q.yzx().abs();
    }
    let axis = area.abs().max_position();
    // Products and difference round by 2 u of the terms, the n sums by n u of them.
    let rounding = (points.len() + 4) as f64 * UNIT * terms[axis];
    if !(area[axis].abs() > rounding && terms.is_finite()) {
        return None;
    }
    let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
    let (u, v) = if area[axis] > 0.0 { (u, v) } else { (v, u) };
    Some(points.iter().map(|p| DVec2::new(p[u].into(), p[v].into())).collect())
}

/// Twice the area of a triangle: above 0 where it runs counter-clockwise.
fn area(a: DVec2, b: DVec2, c: DVec2) -> f64 {
    (b - a).perp_dot(c - a)
}

/// Whether the outline only turns left, and only once around.
fn convex(points: &[DVec2]) -> bool {
    let n = points.len();
    let upward = |a: DVec2, b: DVec2| b.y > a.y || (b.y == a.y && b.x > a.x);
    let mut changes = 0;
    for i in 0..n {
        let [a, b, c] = [points[i], points[(i + 1) % n], points[(i + 2) % n]];
        let turn = area(a, b, c);
        // A repeated corner, or a turn on the spot, is left to the clipper.
        if turn < 0.0 || (turn == 0.0 && (b - a).dot(c - b) <= 0.0) {
            return false;
        }
        changes += u32::from(upward(a, b) != upward(b, c));
    }
    changes == 2
}

/// How readily a corner is clipped; each step is taken only when no corner is left that passes the one before.
#[derive(Clone, Copy)]
enum Care {
    /// Without area: a repeated corner, or one where the outline turns back. First, since a new edge nearby may take
    /// from it by rounding what shows it to be one.
    Spike,
    /// An ear.
    Ear,
    /// Its triangle may touch other corners, but not hold any.
    Touching,
    /// Any corner that is not reflex.
    Convex,
    /// Whatever is there.
    Any,
}

const CARES: [Care; 5] = [Care::Spike, Care::Ear, Care::Touching, Care::Convex, Care::Any];

struct Clipper {
    points: Vec<DVec2>,
    /// The corners that are left, as a ring.
    next: Vec<u32>,
    previous: Vec<u32>,
    clipped: Vec<bool>,
    reflex: Tree,
}

impl Clipper {
    fn new(points: Vec<DVec2>) -> Self {
        let n = points.len() as u32;
        let ring = |step: u32| (0..n).map(move |i| (i + step) % n).collect::<Vec<u32>>();
        let mut clipper = Self {
            next: ring(1),
            previous: ring(n - 1),
            clipped: vec![false; points.len()],
            reflex: Tree::default(),
            points,
        };
        let reflex = (0..n).filter(|&i| clipper.turn(i) <= 0.0).collect();
        clipper.reflex = Tree::new(reflex, &clipper.points);
        clipper
    }

    /// Corner i between the ones before and after it.
    fn corner(&self, i: u32) -> [u32; 3] {
        [self.previous[i as usize], i, self.next[i as usize]]
    }

    fn at(&self, corner: [u32; 3]) -> [DVec2; 3] {
        corner.map(|i| self.points[i as usize])
    }

    fn turn(&self, i: u32) -> f64 {
        let [a, b, c] = self.at(self.corner(i));
        area(a, b, c)
    }

    fn triangles(mut self) -> Vec<[u32; 3]> {
        let n = self.points.len();
        let mut triangles = Vec::with_capacity(n - 2);
        // The corners that wait, by the care they are still to be tried with. None waits twice with the same care.
        let mut waiting = CARES.map(|_| VecDeque::new());
        let mut waits = vec![0_u8; n];
        waiting[0].extend(0..n as u32);
        waits.fill(1);
        while triangles.len() < n - 2 {
            let Some(care) = waiting.iter().position(|queue| !queue.is_empty()) else { break };
            let Some(i) = waiting[care].pop_front() else { break };
            waits[i as usize] &= !(1 << care);
            if self.clipped[i as usize] {
                continue;
            }
            let [a, _, c] = self.corner(i);
            let last = triangles.len() == n - 3;
            if !last && !self.may_clip(i, CARES[care]) {
                enqueue(&mut waiting, &mut waits, care + 1, i);
                continue;
            }
            triangles.push([a, i, c]);
            self.clip(i);
            for neighbour in [a, c] {
                enqueue(&mut waiting, &mut waits, 0, neighbour);
            }
        }
        triangles
    }

    fn may_clip(&self, i: u32, care: Care) -> bool {
        let corner @ [ia, _, ic] = self.corner(i);
        let [a, b, c] = self.at(corner);
        let turn = area(a, b, c);
        let touching = match care {
            Care::Spike => return turn == 0.0 && (a == b || b == c || (a - b).dot(c - b) > 0.0),
            Care::Ear => false,
            Care::Touching => true,
            Care::Convex => return turn >= 0.0,
            Care::Any => return true,
        };
        // The new edge has to leave its ends towards the inside. Where those are reflex it does.
        let [before, _, _] = self.at(self.corner(ia));
        let [_, _, after] = self.at(self.corner(ic));
        let inside = |space: f64| space > 0.0 || (touching && space == 0.0);
        let leaves =
            (self.turn(ia) <= 0.0 || inside(area(a, c, before))) && (self.turn(ic) <= 0.0 || inside(area(c, after, a)));
        turn > 0.0 && leaves && !self.reflex.any_in([a, b, c], touching)
    }

    fn clip(&mut self, i: u32) {
        let [a, _, c] = self.corner(i);
        self.next[a as usize] = c;
        self.previous[c as usize] = a;
        self.clipped[i as usize] = true;
        self.reflex.remove(i);
        for neighbour in [a, c] {
            if self.turn(neighbour) > 0.0 {
                self.reflex.remove(neighbour);
            }
        }
    }
}

fn enqueue(waiting: &mut [VecDeque<u32>; CARES.len()], waits: &mut [u8], care: usize, i: u32) {
    if waits[i as usize] & (1 << care) == 0 {
        waits[i as usize] |= 1 << care;
        waiting[care].push_back(i);
    }
}

/// Corners are looked through one by one below this number.
const LEAF: usize = 8;

/// No place in the tree.
const NONE: u32 = u32::MAX;

/// A k-d tree of corners that only ever loses some.
#[derive(Default)]
struct Tree {
    /// The corners and where they are, as the tree orders them: every node is a range, its children are the halves.
    corners: Vec<(u32, DVec2)>,
    /// By corner: its place in `corners`, while it is there.
    places: Vec<u32>,
    /// Node i has the children 2 i and 2 i + 1; the root is 1.
    nodes: Vec<Node>,
}

#[derive(Clone, Copy, Default)]
struct Node {
    low: DVec2,
    high: DVec2,
    /// How many of its corners are left.
    left: u32,
}

impl Tree {
    fn new(corners: Vec<u32>, points: &[DVec2]) -> Self {
        let corners: Vec<_> = corners.into_iter().map(|i| (i, points[i as usize])).collect();
        let leaves = corners.len().div_ceil(LEAF).next_power_of_two();
        let mut tree = Self { corners, places: vec![NONE; points.len()], nodes: vec![Node::default(); 2 * leaves] };
        tree.build(1, 0, tree.corners.len());
        for (place, (i, _)) in tree.corners.iter().enumerate() {
            tree.places[*i as usize] = place as u32;
        }
        tree
    }

    fn build(&mut self, node: usize, start: usize, end: usize) {
        let corners = &mut self.corners[start..end];
        let (low, high) = corners
            .iter()
            .fold((DVec2::INFINITY, DVec2::NEG_INFINITY), |(low, high), (_, p)| (low.min(*p), high.max(*p)));
        self.nodes[node] = Node { low, high, left: corners.len() as u32 };
        if corners.len() <= LEAF {
            return;
        }
        let axis = (high - low).max_position();
        let middle = corners.len() / 2;
        corners.select_nth_unstable_by(middle, |(_, p), (_, q)| p[axis].total_cmp(&q[axis]));
        self.build(2 * node, start, start + middle);
        self.build(2 * node + 1, start + middle, end);
    }

    fn remove(&mut self, corner: u32) {
        let place = std::mem::replace(&mut self.places[corner as usize], NONE) as usize;
        if place >= self.corners.len() {
            return;
        }
        let (mut node, mut start, mut end) = (1, 0, self.corners.len());
        loop {
            self.nodes[node].left -= 1;
            if end - start <= LEAF {
                return;
            }
            let middle = start + (end - start) / 2;
            let right = place >= middle;
            (start, end) = if right { (middle, end) } else { (start, middle) };
            node = 2 * node + usize::from(right);
        }
    }

    /// Whether one of the corners is in the triangle, or on its outline unless it may touch. Corners at the very
    /// place of one of the triangle's never count.
    fn any_in(&self, triangle: [DVec2; 3], touching: bool) -> bool {
        self.any_below(1, (0, self.corners.len()), &triangle, touching)
    }

    fn any_below(&self, node: usize, (start, end): (usize, usize), triangle: &[DVec2; 3], touching: bool) -> bool {
        let Node { low, high, left } = self.nodes[node];
        if left == 0 || outside(low, high, triangle) {
            return false;
        }
        if end - start <= LEAF {
            let [a, b, c] = *triangle;
            let least = |p: DVec2| area(a, b, p).min(area(b, c, p)).min(area(c, a, p));
            let inside = |p: DVec2| if touching { least(p) > 0.0 } else { least(p) >= 0.0 };
            let there = |i: u32| self.places[i as usize] != NONE;
            return self.corners[start..end].iter().any(|(i, p)| there(*i) && inside(*p) && !triangle.contains(p));
        }
        let middle = start + (end - start) / 2;
        self.any_below(2 * node, (start, middle), triangle, touching)
            || self.any_below(2 * node + 1, (middle, end), triangle, touching)
    }
}

/// Whether a box and a triangle are apart: by the box's sides, or because the box is right of one of the edges.
fn outside(low: DVec2, high: DVec2, triangle: &[DVec2; 3]) -> bool {
    let [a, b, c] = *triangle;
    if a.max(b).max(c).cmplt(low).any() || a.min(b).min(c).cmpgt(high).any() {
        return true;
    }
    [(a, b), (b, c), (c, a)].into_iter().any(|(from, to)| {
        let edge = to - from;
        // The corner of the box that is farthest to the left.
        let farthest = DVec2::new(if edge.y > 0.0 { low.x } else { high.x }, if edge.x > 0.0 { high.y } else { low.y });
        area(from, to, farthest) < 0.0
    })
}

#[cfg(test)]
#[path = "polygon_tests.rs"]
mod tests;
