//! Triangles of a block: what the test needs of the directions is known, and corners come in the order of the axes after
//! the directions' largest.

use super::alone::Alone;
use super::beams::RAYS;
use super::behind::Met;
use super::bits::{Bits, Bits128};
use super::edges::{Edges, Shears};
use super::leaf::{Leaf, Sixteen, columns, take_eight};
use super::walk::Walk;
use crate::bvh::{BLOCK, Block};
use crate::geometry::triangle::{Aim, Flat, TriangleShape, covers, covers_ordered, normal, shown};
use crate::geometry::{Sides, Triangles};
use crate::math::{LaneMask, Lanes, NONE, Vec3, map3};
use crate::trace::packet::Packet;
use crate::trace::query::Query;
use wide::{f32x8, f32x16};

/// As many rays are tested one by one.
const FEW: u32 = 5;
/// Cache lines of the next batch that are fetched for every triangle.
const LINES: usize = 8;

impl Leaf for Triangles {
    const EDGES: bool = true;

    #[inline(always)]
    fn groups<Q: Query, L: Lanes>(walk: &mut Walk, block: &Block<Self>, sides: Sides, met: &Met) -> bool {
        if let (Some(shears), Some(major)) = (met.shears, met.major) {
            return from_one_point::<Q, L>(walk, block, sides, met, (shears, major));
        }
        let (mut pairs, mut groups) = (0u128, 0);
        for lane in Bits(met.primitives) {
            walk.prefetch.step(LINES);
            let lane = lane & (BLOCK - 1);
            pairs |= u128::from(met.groups[lane]) << (16 * lane);
            groups |= met.groups[lane];
        }
        walk.state.make_shears(walk.rays, groups);
        let covers = |walk: &Walk, lane: usize, at: usize| {
            let Some(major) = met.major else {
                return covers(&seen::<L>(walk, block, lane, at), &Aim::new(Vec3::load(&walk.rays.direction, at)));
            };
            let (corners, origin) = (&block.shape.corners, walk.rays.origins::<L>(at).ordered(major));
            let axis = |k: usize, i: usize| L::splat(corners[k][(major + 1 + i) % 3][lane]) - origin[i];
            covers_ordered(&map3([0, 1, 2], |k| map3([0, 1, 2], |i| axis(k, i))), walk.state.shear(at))
        };
        let flat =
            |walk: &Walk, lane: usize, at: usize| Flat::of(block.primitive(lane).corners(), walk.rays.origins::<L>(at));
        each_pair::<Q, L>(walk, block, sides, [pairs, 0], covers, flat)
    }

    #[inline(always)]
    fn sixteen<Q: Query>(walk: &mut Walk, block: &Block<Self>, sides: Sides, rays: &Sixteen) -> bool {
        if rays.lanes.count_ones() <= FEW {
            let mut taken = false;
            for lane in Bits(rays.lanes) {
                let ray = Alone::new(walk, rays.at + lane);
                taken |= Self::alone::<Q>(walk, block, sides, &ray);
            }
            return taken;
        }
        let aim = Aim::new(Vec3::<f32x16>::load(&walk.rays.direction, rays.at));
        let origin = walk.rays.origins::<f32x16>(rays.at);
        for lane in (0..BLOCK).take_while(|&lane| block.id[lane] != NONE) {
            let seen = map3(block.primitive(lane).corners(), |corner| Vec3::splat(corner.into()) - origin);
            walk.state.covered.note::<f32x16>(rays.at, lane, covers(&seen, &aim));
        }
        take_covered::<Q, f32x16>(walk, block, sides, &|walk: &Walk, lane: usize, at: usize| {
            Flat::of(block.primitive(lane).corners(), walk.rays.origins(at))
        })
    }

    #[inline(always)]
    fn alone<Q: Query>(walk: &mut Walk, block: &Block<Self>, sides: Sides, ray: &Alone) -> bool {
        let Alone { order, origin, shear, .. } = ray;
        let TriangleShape { corners } = &block.shape;
        // The other way round, which changes the sign of all and so of no product.
        let axis = |k: usize, i: usize| origin[i] - f32x8::from(corners[k][order[i]]);
        let seen = map3([0, 1, 2], |k| map3([0, 1, 2], |i| axis(k, i)));
        let inside = covers_ordered(&seen, *shear);
        if !inside.any() {
            return false;
        }
        let packet = Packet::splat::<f32x8>(walk.rays, ray.i);
        let corners = columns(block).corners();
        let [a, b, c] = map3(corners, |c| c - packet.origin);
        let n = normal(corners);
        let flat = Flat::new(n, a.dot(n), a.min(b).min(c), a.max(b).max(c));
        let (t, inside) = flat.distance(packet.direction, inside, || [a, b, c]);
        let inside = inside & Lanes::gt(t, packet.t_min);
        let inside = if sides == Sides::Both { inside } else { inside & shown(sides, n.dot(packet.direction)) };
        take_eight::<Q>(walk, ray.i, t, inside, &block.id)
    }
}

/// A block against groups whose rays start at one point; most of it once for all its triangles.
#[inline(always)]
fn from_one_point<Q: Query, L: Lanes>(
    walk: &mut Walk,
    block: &Block<Triangles>,
    sides: Sides,
    met: &Met,
    (shears, major): (&Shears, usize),
) -> bool {
    let origin = Vec3::<f32x8>::splat(walk.rays.first_origin());
    let corners = columns(block).corners();
    let [a, b, c] = map3(corners, |corner| corner - origin);
    let seen = [a.ordered(major), b.ordered(major), c.ordered(major)];
    let (edges, by) = Edges::of(&seen, shears);
    let primitives = met.primitives & !by;
    if primitives == 0 {
        return false;
    }
    let (mut unsure, mut sure, mut tested) = (0u128, 0u128, 0);
    for lane in Bits(primitives) {
        walk.prefetch.step(LINES);
        let lane = lane & (BLOCK - 1);
        let [by, through] = edges.beams(lane, shears);
        let groups = met.groups[lane] & !by;
        tested |= groups & !through;
        unsure |= u128::from(groups & !through) << (16 * lane);
        sure |= u128::from(groups & through) << (16 * lane);
    }
    if unsure | sure == 0 {
        return false;
    }
    walk.state.make_shears(walk.rays, tested);
    let n = normal(corners);
    let flats = Flat::new(n, a.dot(n), a.min(b).min(c), a.max(b).max(c));
    let covers = |walk: &Walk, lane: usize, at: usize| {
        let pick = |v: &f32x8| L::splat(v.as_array()[lane]);
        covers_ordered(&map3([0, 1, 2], |k| map3([0, 1, 2], |i| pick(&seen[k][i]))), walk.state.shear(at))
    };
    each_pair::<Q, L>(walk, block, sides, [unsure, sure], covers, |_: &Walk, lane, _| flats.one::<L>(lane))
}

/// Tests pairs of a triangle and a group, sixteen bits a triangle: those of which it is not known whether the triangle covers
/// any ray, and those of which it covers all. One loop over all pairs ends once, where a loop for each triangle would end
/// when nobody expects it.
#[inline(always)]
fn each_pair<Q: Query, L: Lanes>(
    walk: &mut Walk,
    block: &Block<Triangles>,
    sides: Sides,
    [unsure, sure]: [u128; 2],
    covers: impl Fn(&Walk, usize, usize) -> L::Mask,
    flat: impl Fn(&Walk, usize, usize) -> Flat<L>,
) -> bool {
    let mut taken = false;
    for pair in Bits128(unsure) {
        let (lane, group) = ((pair / 16) & (BLOCK - 1), pair % 16);
        for at in (RAYS * group..RAYS * (group + 1)).step_by(L::WIDTH) {
            let rays = covers(walk, lane, at);
            walk.state.covered.note::<L>(at, lane, rays);
        }
        if walk.state.covered.is_full::<L>() {
            taken |= take_covered::<Q, L>(walk, block, sides, &flat);
        }
    }
    taken |= take_covered::<Q, L>(walk, block, sides, &flat);
    for pair in Bits128(sure) {
        let (lane, group) = ((pair / 16) & (BLOCK - 1), pair % 16);
        for at in (RAYS * group..RAYS * (group + 1)).step_by(L::WIDTH) {
            let flat = flat(walk, lane, at);
            taken |= take::<Q, L>(walk, (block, lane), at, &flat, sides, L::zero().le(L::zero()));
        }
    }
    taken
}

/// A triangle's corners, from the origins of packet `at`.
#[inline(always)]
fn seen<L: Lanes>(walk: &Walk, block: &Block<Triangles>, lane: usize, at: usize) -> [Vec3<L>; 3] {
    let origin = walk.rays.origins::<L>(at);
    map3(block.primitive(lane).corners(), |corner| Vec3::splat(corner.into()) - origin)
}

/// Takes the hits of what is covered.
#[inline(always)]
fn take_covered<Q: Query, L: Lanes>(
    walk: &mut Walk,
    block: &Block<Triangles>,
    sides: Sides,
    flat: &impl Fn(&Walk, usize, usize) -> Flat<L>,
) -> bool {
    let mut taken = false;
    for i in 0..walk.state.covered.take() {
        let (at, lane, rays) = walk.state.covered.get::<L>(i);
        let flat = flat(walk, lane, at);
        taken |= take::<Q, L>(walk, (block, lane), at, &flat, sides, rays);
    }
    taken
}

/// Takes the hits of a triangle that packet `at` passes through where `inside` is true.
#[inline(always)]
fn take<Q: Query, L: Lanes>(
    walk: &mut Walk,
    (block, lane): (&Block<Triangles>, usize),
    at: usize,
    flat: &Flat<L>,
    sides: Sides,
    inside: L::Mask,
) -> bool {
    let direction = Vec3::load(&walk.rays.direction, at);
    let (t, mut inside) = flat.distance(direction, inside, || seen(walk, block, lane, at));
    if sides != Sides::Both {
        inside = inside & shown(sides, flat.n.dot(direction));
    }
    let inside = inside & t.gt(L::load(&walk.rays.t_min[at..]));
    inside.any() && walk.state.take::<Q, L>(at, t, inside, block.id[lane])
}
