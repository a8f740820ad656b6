//! Sixteen rays that have lost coherence, together as long as that pays: each child of a node against all of them, each ray
//! with its own interval, and those that meet it go on. Where few are left they go on one by one. (Benthin, Wald, Woop,
//! Ernst, Mark, *Combining Single and Packet-Ray Tracing for Arbitrary Ray Distributions on the Intel MIC Architecture*,
//! 2012, §3.)

use crate::bvh::{Child, Kind, MOST_DEPTH, Node};
use crate::geometry::methods::TriangleMethod;
use crate::geometry::triangle::{Aim, Flat, covers};
use crate::math::{BATCH, LaneMask, Lanes, NONE, Vec3, three};
use wide::f32x16;

use super::Walk;
use super::leaf::sphere_of;
use super::line::Lines;

/// Rays of a packet.
pub const RAYS: usize = 16;
/// Cache lines of the next batch that are fetched at every step of the descent.
const LINES: usize = 2;
/// As many go on one by one.
const FEW: u32 = 5;

/// A child, the distance from which on some ray may hit it, and those that may.
#[derive(Clone, Copy, Debug)]
struct Part {
    enter: f32,
    child: Child,
    lanes: u32,
}

/// What is left, the nearest of every node's on top.
#[derive(Clone, Debug)]
pub struct Parts {
    parts: [Part; 7 * MOST_DEPTH + 8],
    len: usize,
}

impl Default for Parts {
    fn default() -> Self {
        Self { parts: [Part { enter: 0.0, child: Child::EMPTY, lanes: 0 }; 7 * MOST_DEPTH + 8], len: 0 }
    }
}

impl Parts {
    /// The next one.
    #[inline(always)]
    fn pop(&mut self) -> Option<Part> {
        self.len = self.len.checked_sub(1)?;
        Some(self.parts[self.len])
    }

    /// Adds a part where it belongs above `base`.
    #[inline(always)]
    fn sort_in(&mut self, base: usize, part: Part) {
        let mut at = self.len;
        while at > base && self.parts[at - 1].enter < part.enter {
            self.parts[at] = self.parts[at - 1];
            at -= 1;
        }
        self.parts[at] = part;
        self.len += 1;
    }
}

/// A ray in every lane: [`super::line::Line`] turned about.
struct Packet {
    inverse: [f32x16; 3],
    near: [f32x16; 3],
    far: [f32x16; 3],
    /// Which end of a box is the near one, where that is the same for all: 0 for the least.
    side: [usize; 3],
    /// Whether it is not along any axis.
    mixed: bool,
}

impl Packet {
    #[inline(always)]
    fn new(lines: &Lines, at: usize, active: u32) -> Self {
        let load = |columns: &[[f32; BATCH]; 3]| three([0, 1, 2], |axis| f32x16::load(&columns[axis][at..]));
        let inverse = load(&lines.inverse);
        let behind = three(inverse, |inverse| LaneMask::bits(Lanes::lt(inverse, f32x16::ZERO)) & active);
        Self {
            inverse,
            near: load(&lines.near),
            far: load(&lines.far),
            side: three(behind, |b| usize::from(b != 0)),
            mixed: behind.into_iter().any(|b| b != 0 && b != active),
        }
    }

    /// The rays' entries into a child of a node, not below zero, and which meet it no later than at `end`.
    #[inline(always)]
    fn meets<const MIXED: bool>(&self, node: &Node, child: usize, end: f32x16) -> (f32x16, u32) {
        let mut enter = f32x16::ZERO;
        let mut exit = end;
        for axis in 0..3 {
            let inverse = self.inverse[axis];
            let side = if MIXED { 0 } else { self.side[axis] };
            let (near, far) = (node.end(axis, side, child), node.end(axis, side ^ 1, child));
            let (near, far) = if MIXED {
                let (near, far) = (f32x16::splat(near) * inverse, f32x16::splat(far) * inverse);
                (Lanes::min(near, far) - self.near[axis], Lanes::max(near, far) - self.far[axis])
            } else {
                let margin = (self.near[axis], self.far[axis]);
                (f32x16::splat(near).mul_sub(inverse, margin.0), f32x16::splat(far).mul_sub(inverse, margin.1))
            };
            // What is NaN (∞ − ∞) is passed over.
            enter = Lanes::max(near, enter);
            exit = Lanes::min(far, exit);
        }
        (enter, LaneMask::bits(Lanes::le(enter, exit)))
    }
}

impl Walk<'_> {
    /// Traces rays `at` to `at + 16`, whose [`Lines`] are known.
    #[inline(always)]
    pub fn packet<const ANY: bool, const RARE: bool>(&mut self, at: usize) {
        let packet = Packet::new(&self.state.lines, at, self.looking(at, 0.0));
        match packet.mixed {
            true => self.descend_packet::<ANY, RARE, true>(&packet, at),
            false => self.descend_packet::<ANY, RARE, false>(&packet, at),
        }
    }

    /// The rays that still look as far as that.
    #[inline(always)]
    fn looking(&self, at: usize, enter: f32) -> u32 {
        LaneMask::bits(Lanes::ge(f32x16::load(&self.state.t[at..]), f32x16::splat(enter)))
    }

    #[inline(never)]
    fn descend_packet<const ANY: bool, const RARE: bool, const MIXED: bool>(&mut self, packet: &Packet, at: usize) {
        self.state.parts.len = 0;
        let mut part = Part { enter: 0.0, child: self.bvh.root, lanes: self.looking(at, 0.0) };
        loop {
            self.ahead.step(LINES);
            let few = part.lanes.count_ones() <= FEW;
            match part.child.kind() {
                Kind::Node if few => each(part.lanes, |lane| self.single::<ANY, RARE>(at + lane, part.child)),
                Kind::Node => self.children::<MIXED>(packet, at, &part),
                Kind::Triangles if !few => self.sixteen_triangles::<ANY, RARE>(at, part.child.index()),
                Kind::Spheres if !few => self.sixteen_spheres::<ANY, RARE>(at, part.child.index()),
                _ => each(part.lanes, |lane| self.block_alone::<ANY, RARE>(at + lane, part.child)),
            }
            loop {
                let Some(next) = self.state.parts.pop() else { return };
                part = Part { lanes: next.lanes & self.looking(at, next.enter), ..next };
                if part.lanes != 0 {
                    break;
                }
            }
        }
    }

    /// Puts aside the children of a node that any of a part's rays meets.
    #[inline(always)]
    fn children<const MIXED: bool>(&mut self, packet: &Packet, at: usize, part: &Part) {
        let node = &self.bvh.nodes[part.child.index()];
        let base = self.state.parts.len;
        let end = f32x16::load(&self.state.t[at..]);
        for lane in 0..8 {
            let child = node.child[lane];
            if child == Child::EMPTY {
                break;
            }
            let (enter, met) = packet.meets::<MIXED>(node, lane, end);
            let lanes = met & part.lanes;
            if lanes != 0 {
                self.bvh.fetch_child(child);
                let far = f32x16::splat(f32::INFINITY);
                let enter = Lanes::select(enter, LaneMask::from_bits(lanes), far).least();
                self.state.parts.sort_in(base, Part { enter, child, lanes });
            }
        }
    }

    /// The triangles of a block against all rays.
    #[inline(always)]
    fn sixteen_triangles<const ANY: bool, const RARE: bool>(&mut self, at: usize, block: usize) {
        let block = &self.bvh.triangles[block];
        if RARE && self.scene.triangles.method != TriangleMethod::Watertight {
            self.triangles_one_by_one::<f32x16, ANY>(block, at..at + RAYS);
            return;
        }
        let aim = Aim::new(Vec3::<f32x16>::load(&self.rays.direction, at));
        let origin = self.rays.origins::<f32x16>(at);
        for (lane, id) in block.id.into_iter().enumerate().take_while(|&(_, id)| id != NONE) {
            let corners = three(block.triangle(lane), Vec3::from);
            let seen = three(corners, |corner| Vec3::splat(corner.into()) - origin);
            if let Some(inside) = covers(&seen, &aim) {
                self.triangle::<f32x16, ANY, RARE>(at, &Flat::of(corners, origin), inside, id);
            }
        }
    }

    /// The spheres of a block likewise.
    #[inline(always)]
    fn sixteen_spheres<const ANY: bool, const RARE: bool>(&mut self, at: usize, block: usize) {
        let block = &self.bvh.spheres[block];
        let Some(side) = self.sphere_side::<RARE>() else {
            self.spheres_one_by_one::<f32x16, ANY>(block, at..at + RAYS);
            return;
        };
        for (lane, id) in block.id.into_iter().enumerate().take_while(|&(_, id)| id != NONE) {
            self.sphere::<f32x16, ANY, RARE>(&sphere_of(block, lane, side), at..at + RAYS, id);
        }
    }
}

/// Every bit that is set.
#[inline(always)]
fn each(mut bits: u32, mut take: impl FnMut(usize)) {
    while bits != 0 {
        take(bits.trailing_zeros() as usize);
        bits &= bits - 1;
    }
}
