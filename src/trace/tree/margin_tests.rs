//! Rays that graze a box within the last bits of its margin: it is met, by every structure that boxes are tested with.
//!
//! That a box is met where its last entry *is* its first exit, or begins where the nearest hit so far is, is the margin's
//! doing, too: [`super::beam`] says why.

use super::beam::Beam;
use super::beams::{Beams, Ends};
use super::line::{Line, Lines};
use super::packet::Lines16;
use super::state::State;
use crate::bvh::{Aabb, Bvh, Child, Kind, Node};
use crate::math::{BATCH, RayBatch};
use glam::{DVec3, Vec3};
use wide::{f32x8, f32x16};

/// 56 ε: what is left of the margin after the boxes' own arithmetic.
const NEAR: f64 = 56.0 / (1u64 << 24) as f64;

/// Numbers from −1 to 1.
struct Random(u64);

impl Random {
    fn next(&mut self) -> f32 {
        self.0 = self.0.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (self.0 >> 40) as f32 / (1 << 23) as f32 - 1.0
    }

    fn below(&mut self, n: usize) -> usize {
        ((0.5 + 0.5 * self.next()) * n as f32) as usize % n
    }

    fn point(&mut self) -> Vec3 {
        Vec3::new(self.next(), self.next(), self.next())
    }
}

/// A ray that passes a box of the scene at distance `t`, outside of it by nearly [`NEAR`] of D + |o| along one, two or three
/// axes.
struct Graze {
    scene: Aabb,
    bounds: Aabb,
    origin: Vec3,
    direction: Vec3,
    t: f32,
}

fn graze(random: &mut Random) -> Option<Graze> {
    let center = random.point() * [0.0, 1.0, 100.0][random.below(3)];
    let scene = Aabb { min: center - 1.0, max: center + 1.0 };
    let (p, mut size) = (center + random.point() * 0.9, (0.5 + 0.5 * random.point()) * 0.1);
    // Flat ones, too.
    if random.below(2) == 0 {
        size[random.below(3)] = 0.0;
    }
    let bounds = Aabb { min: p, max: p + size };
    let origin = center + random.point() * [0.5, 3.0, 1e3][random.below(3)];
    let away = (scene.max - origin).abs().max((origin - scene.min).abs());
    let near = NEAR * f64::from(away.max_element() + origin.abs().max_element());
    let mut to = DVec3::ZERO;
    for axis in 0..3 {
        let [low, high] = [bounds.min, bounds.max].map(|end| f64::from(end[axis]));
        to[axis] = match random.below(4) {
            0 => low - 0.98 * near,
            1 => high + 0.98 * near,
            2 => low,
            _ => low + (high - low) * f64::from(0.5 + 0.5 * random.next()),
        };
    }
    let mut direction = (to - origin.as_dvec3()).normalize().as_vec3();
    let mut origin = origin;
    if random.below(4) == 0 {
        // Along a plane of two axes.
        let axis = random.below(3);
        origin[axis] = to[axis] as f32;
        to[axis] = f64::from(origin[axis]);
        direction = (to - origin.as_dvec3()).normalize().as_vec3();
        direction[axis] = 0.0;
    }
    let (o, d) = (origin.as_dvec3(), direction.as_dvec3());
    let t = ((to - o).dot(d) / d.length_squared()) as f32;
    let at = o + d * f64::from(t);
    let away = (scene.max - origin).abs().max((origin - scene.min).abs());
    let near = NEAR * f64::from(away.max_element() + origin.abs().max_element());
    let (low, high) = (bounds.min.as_dvec3() - near, bounds.max.as_dvec3() + near);
    (t > 0.0 && at.cmpge(low).all() && at.cmple(high).all()).then_some(Graze { scene, bounds, origin, direction, t })
}

fn bvh(bounds: Aabb) -> Bvh {
    let (nodes, blocks) = (Vec::new(), Default::default());
    Bvh { bounds, grain: 1e9, nodes, blocks, root: Child::EMPTY, depth: 0 }
}

/// The box as the only child of a node.
fn node(Aabb { min, max }: Aabb) -> Node {
    let mut node = Node::EMPTY;
    for axis in 0..3 {
        (node.ends[0][axis][0], node.ends[1][axis][0]) = (min[axis], max[axis]);
    }
    node.child[0] = Child::new(Kind::Node, 0);
    node
}

/// The structures that do not meet the box, for a whole batch of the same ray.
fn blind(it: &Graze, rays: &mut RayBatch, state: &mut State) -> Vec<&'static str> {
    let (bvh, node) = (bvh(it.scene), node(it.bounds));
    rays.clear();
    for _ in 0..BATCH {
        rays.push(it.origin, it.direction, 0.0, it.t);
    }
    state.start::<f32x8>(rays);
    let mut blind = Vec::new();
    let mut note = |name, met: bool| {
        if !met {
            blind.push(name)
        }
    };

    let beam = Beam::new([it.origin; 2], [it.direction; 2], &bvh);
    let (enter, met) = beam.meets::<true>(|axis, near| node.faces(axis, near), f32x8::splat(it.t));
    note("a beam", met & 1 != 0 && enter.to_array()[0] < it.t);

    let ends = Ends::of(rays, state);
    let beams = Beams::new(&ends, 0xffff, &bvh, false);
    note("sixteen beams", beams.meets_child::<true>(&node, 0, f32x16::splat(it.t)) == 0xffff);
    let one = beams.one(3).meets::<true>(|axis, near| node.faces(axis, near), f32x8::splat(it.t)).1;
    note("one of sixteen", one & 1 != 0);

    let mut lines = Lines::default();
    lines.prepare(rays, &bvh, 0..16);
    let (enter, met) = Line::new(&lines, 5).meets(&node, f32x8::splat(it.t));
    note("a ray", met & 1 != 0 && enter.to_array()[0] < it.t);
    let packet = Lines16::new(&lines, 0, 0xffff);
    note("a packet", packet.meets::<true>(&node, 0, f32x16::splat(it.t)).1 == 0xffff);
    note("a packet to one side", packet.meets::<false>(&node, 0, f32x16::splat(it.t)).1 == 0xffff);
    blind
}

/// Where the nearest hit so far ends the ray right there, too; and the entry lies before that, so that whoever puts a box
/// aside takes it up again.
#[test]
fn what_lies_within_the_margin_is_met() {
    let (mut random, mut tested) = (Random(1), 0);
    let (mut rays, mut state) = (RayBatch::default(), State::default());
    for round in 0..40_000 {
        let Some(it) = graze(&mut random) else { continue };
        tested += 1;
        let blind = blind(&it, &mut rays, &mut state);
        let Graze { scene, bounds, origin, direction, t } = it;
        assert!(
            blind.is_empty(),
            "{round}: {blind:?} miss {bounds:?} in {scene:?} from {origin} to {direction} at {t}"
        );
    }
    assert!(tested > 15_000, "{tested}");
}

/// The margin is no larger than it needs to be: by four of them off nothing is met.
#[test]
fn what_lies_far_beyond_the_margin_is_not_met() {
    let mut random = Random(2);
    let (mut rays, mut state) = (RayBatch::default(), State::default());
    for _ in 0..4_000 {
        let Some(mut it) = graze(&mut random) else { continue };
        let size = (it.scene.max - it.origin).abs().max((it.origin - it.scene.min).abs()).max_element();
        let off = 4.0 * super::beam::PAD * (size + it.origin.abs().max_element());
        // Beside the line, across two axes.
        let axis = it.direction.abs().max_position();
        let (a, b) = ((axis + 1) % 3, (axis + 2) % 3);
        let at = it.origin + it.direction * it.t;
        let slant = 1.0 + it.direction[a].abs() + it.direction[b].abs();
        let half = Vec3::splat(off * 0.1);
        let mut place = at;
        place[a] += off * slant * 2.0;
        it.bounds = Aabb { min: place - half, max: place + half };
        it.t = f32::INFINITY;
        let blind = blind(&it, &mut rays, &mut state);
        assert!(blind.len() == 6, "{blind:?}");
    }
}
