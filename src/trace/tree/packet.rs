//! Sixteen rays that have lost coherence, together as long as that pays: each child of a node against all of them, each ray
//! with its own interval, and those that meet it go on. Where few are left they go on one by one. (Benthin, Wald, Woop,
//! Ernst, Mark, *Combining Single and Packet-Ray Tracing for Arbitrary Ray Distributions on the Intel MIC Architecture*,
//! 2012, §3.)

use super::bits::Bits;
use super::leaf::{Sixteen, block};
use super::line::Lines;
use super::stack::Part;
use super::walk::Walk;
use crate::bvh::{Child, Kind, Node};
use crate::math::{BATCH, LaneMask, Lanes, map3};
use crate::trace::query::Query;
use wide::f32x16;

/// Cache lines of the next batch that are fetched at every step of the descent.
const LINES: usize = 2;
/// As many go on one by one.
const FEW: u32 = 5;

/// A ray in every lane: [`super::line::Line`] turned about.
pub struct Lines16 {
    inverse: [f32x16; 3],
    near: [f32x16; 3],
    far: [f32x16; 3],
    /// Which end of a box is the near one, where that is the same for all: 0 for the least.
    side: [usize; 3],
    /// Whether along some axis it is not the same for all.
    mixed: bool,
}

impl Lines16 {
    /// Rays `at` to `at + 16`, of which the `active` ones count.
    #[inline(always)]
    pub fn new(lines: &Lines, at: usize, active: u32) -> Self {
        let load = |columns: &[[f32; BATCH]; 3]| map3([0, 1, 2], |axis| f32x16::load(&columns[axis][at..]));
        let inverse = load(&lines.inverse);
        let behind = map3(inverse, |inverse| LaneMask::bits(Lanes::lt(inverse, f32x16::ZERO)) & active);
        Self {
            inverse,
            near: load(&lines.near),
            far: load(&lines.far),
            side: map3(behind, |b| usize::from(b != 0)),
            mixed: behind.into_iter().any(|b| b != 0 && b != active),
        }
    }

    /// The rays' entries into a child of a node, not below zero, and which meet it no later than at `end`.
    #[inline(always)]
    pub fn meets<const MIXED: bool>(&self, node: &Node, child: usize, end: f32x16) -> (f32x16, u32) {
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
    pub fn packet<Q: Query>(&mut self, at: usize) {
        let packet = Lines16::new(&self.state.lines, at, self.looking(at));
        match packet.mixed {
            true => self.descend_packet::<Q, true>(&packet, at),
            false => self.descend_packet::<Q, false>(&packet, at),
        }
    }

    /// The rays that are not done.
    #[inline(always)]
    fn looking(&self, at: usize) -> u32 {
        LaneMask::bits(Lanes::ge(f32x16::load(&self.state.t[at..]), f32x16::ZERO))
    }

    #[inline(never)]
    fn descend_packet<Q: Query, const MIXED: bool>(&mut self, packet: &Lines16, at: usize) {
        self.state.apart.clear();
        let (mut child, mut lanes) = (self.bvh.root, self.looking(at));
        loop {
            self.prefetch.step(LINES);
            let few = lanes.count_ones() <= FEW;
            match child.kind() {
                Kind::Node if few => {
                    for lane in Bits(lanes) {
                        self.single::<Q>(at + lane, child);
                    }
                }
                Kind::Node => self.children::<MIXED>(packet, at, child, lanes),
                _ => {
                    block::<Q, _>(self, child, &Sixteen { at, lanes });
                }
            }
            loop {
                let t = f32x16::load(&self.state.t[at..]);
                let Some(next) = self.state.apart.pop() else { return };
                child = next.child;
                // Those that still look as far.
                lanes = next.lanes & LaneMask::bits(Lanes::le(f32x16::load(&next.enter.0), t));
                if lanes != 0 {
                    break;
                }
            }
        }
    }

    /// Puts aside the children of a node that any of a part's rays meets.
    #[inline(always)]
    fn children<const MIXED: bool>(&mut self, packet: &Lines16, at: usize, from: Child, active: u32) {
        let node = &self.bvh.nodes[from.index()];
        let base = self.state.apart.len();
        let end = f32x16::load(&self.state.t[at..]);
        let entries = &mut self.state.entries;
        // All tests before the first choice: guesses of which child is met next are wrong too often.
        let mut some = 0;
        for lane in 0..8 {
            let (enter, met) = packet.meets::<MIXED>(node, lane, end);
            enter.store(&mut entries.enter[lane].0);
            entries.met[lane] = met & active;
            some |= u32::from(met & active != 0) << lane;
        }
        for lane in Bits(some & node.used()) {
            let (child, lanes) = (node.child[lane & 7], self.state.entries.met[lane & 7]);
            self.places.fetch_child(child);
            let enter = self.state.entries.enter[lane & 7];
            let near = enter.0[lanes.trailing_zeros() as usize & 15];
            self.state.apart.sort_in(base, Part { near, enter, child, lanes });
        }
    }
}
