//! One ray against eight boxes, triangles or spheres at a time.

use crate::bvh::{Child, Kind, SphereBlock, TriangleBlock};
use crate::geometry::methods::{SphereMethod, TriangleMethod};
use crate::geometry::sphere::{self, SeenSphere};
use crate::geometry::triangle::{Aim, Flat, covers_ordered, normal, there};
use crate::math::{LaneMask, Lanes, Vec3, three};
use wide::f32x8;

use super::Walk;
use super::leaf::default_sphere;
use super::line::Line;

/// Ray `i` of the batch in every lane.
struct Ray {
    i: usize,
    origin: Vec3<f32x8>,
    direction: Vec3<f32x8>,
    t_min: f32x8,
    major: usize,
    shear: [f32x8; 2],
}

impl Ray {
    #[inline(always)]
    fn new(walk: &Walk, i: usize) -> Self {
        let direction = Vec3::<f32>::load(&walk.rays.direction, i);
        Self {
            i,
            origin: Vec3::splat(walk.rays.origins::<f32>(i).into()),
            direction: Vec3::splat(direction.into()),
            t_min: f32x8::splat(walk.rays.t_min[i]),
            major: Aim::major_of(direction),
            shear: {
                let [p, q] = walk.state.shear::<f32>(i);
                [f32x8::splat(p), f32x8::splat(q)]
            },
        }
    }
}

impl Walk<'_> {
    /// Traces ray `i` through a node and what is below, unless it is done; its [`Line`] is known.
    #[inline(never)]
    pub fn single<const ANY: bool, const RARE: bool>(&mut self, i: usize, from: Child) {
        let mut limit = self.state.t[i];
        if limit.is_nan() || limit < 0.0 {
            return;
        }
        let bvh = self.bvh;
        let line = Line::new(self.state, Vec3::<f32>::load(&self.rays.direction, i), i);
        let ray = Ray::new(self, i);
        self.state.stack.clear();
        let mut child = from;
        loop {
            let closer = match child.kind() {
                Kind::Node => {
                    let node = &bvh.nodes[child.index()];
                    let (enter, met) = line.meets(node, f32x8::splat(limit));
                    if met != 0 {
                        bvh.fetch(node, met);
                        child = self.state.stack.nearest(node, &enter.to_array(), met).child();
                        continue;
                    }
                    false
                }
                _ => self.block::<ANY, RARE>(&ray, child),
            };
            if closer {
                limit = self.state.t[i];
                if limit < 0.0 {
                    return;
                }
            }
            match self.state.stack.pop(limit) {
                Some(next) => child = next.child(),
                None => return,
            }
        }
    }

    /// The primitives of a block against one ray.
    #[inline(always)]
    fn block<const ANY: bool, const RARE: bool>(&mut self, ray: &Ray, child: Child) -> bool {
        match child.kind() {
            Kind::Triangles => self.eight_triangles::<ANY, RARE>(ray, &self.bvh.triangles[child.index()]),
            Kind::Spheres => self.eight_spheres::<ANY, RARE>(ray, &self.bvh.spheres[child.index()]),
            Kind::Others => self.others::<f32, ANY>(child.index(), ray.i..ray.i + 1),
            Kind::Node => false,
        }
    }

    /// The primitives of a block against ray `i`.
    #[inline(always)]
    pub fn block_alone<const ANY: bool, const RARE: bool>(&mut self, i: usize, child: Child) {
        let ray = Ray::new(self, i);
        self.block::<ANY, RARE>(&ray, child);
    }

    #[inline(always)]
    fn eight_triangles<const ANY: bool, const RARE: bool>(&mut self, ray: &Ray, block: &TriangleBlock) -> bool {
        if RARE && self.scene.triangles.method != TriangleMethod::Watertight {
            return self.triangles_one_by_one::<f32, ANY>(block, ray.i..ray.i + 1);
        }
        let from = ray.origin.ordered(ray.major);
        let axis = |k: usize, i: usize| f32x8::from(block.corners[k][(ray.major + 1 + i) % 3]) - from[i];
        let seen = three([0, 1, 2], |k| three([0, 1, 2], |i| axis(k, i)));
        let Some(inside) = covers_ordered(&seen, ray.shear) else { return false };
        let corners = three([0, 1, 2], |k| Vec3::load(&block.corners[k], 0));
        let seen = three(corners, |c| c - ray.origin);
        let n = normal(corners);
        let [a, b, c] = seen;
        let flat = Flat::new(n, a.dot(n), a.min(b).min(c), a.max(b).max(c));
        let (t, inside) = flat.distance(ray.direction, inside);
        let mut inside = inside & Lanes::gt(t, ray.t_min);
        if RARE && self.scene.triangles.one_sided && inside.any() {
            inside = inside & self.there(block, inside.bits(), n.dot(ray.direction));
        }
        self.take_eight::<ANY>(ray.i, t, inside, &block.id)
    }

    /// Which of the triangles whose bits are set are there for a ray that runs `along` their normals.
    #[inline(never)]
    fn there(&self, block: &TriangleBlock, bits: u32, along: f32x8) -> f32x8 {
        let sides = |lane: usize| self.scene.triangles.sides[(block.id[lane] - self.scene.first.triangles) as usize];
        let along = along.to_array();
        let there = (0..8).filter(|&lane| bits & (1 << lane) != 0 && there(sides(lane), along[lane]));
        LaneMask::from_bits(there.fold(0, |bits, lane| bits | (1 << lane)))
    }

    #[inline(always)]
    fn eight_spheres<const ANY: bool, const RARE: bool>(&mut self, ray: &Ray, block: &SphereBlock) -> bool {
        let (center, radius) = (Vec3::load(&block.center, 0), f32x8::from(block.radius));
        let side = self.sphere_side::<RARE>();
        let seen = SeenSphere::new(center, radius, side.unwrap_or_default(), SphereMethod::Stable, ray.origin);
        if side.is_none() {
            let named = self.scene.spheres.method != SphereMethod::Stable;
            return (named || sphere::passes(&seen, ray.direction))
                && self.spheres_one_by_one::<f32, ANY>(block, ray.i..ray.i + 1);
        }
        let found = default_sphere::<f32x8, RARE>(&seen, ray.direction, ray.t_min, f32x8::splat(f32::INFINITY));
        found.is_some_and(|(t, inside)| self.take_eight::<ANY>(ray.i, t, inside, &block.id))
    }

    /// Takes ray `i`'s hits of a block, where `inside` is true.
    #[inline(always)]
    fn take_eight<const ANY: bool>(&mut self, i: usize, t: f32x8, inside: f32x8, ids: &[u32; 8]) -> bool {
        let t = t.to_array();
        let mut bits = inside.bits();
        let mut taken = false;
        while bits != 0 {
            let lane = bits.trailing_zeros() as usize & 7;
            bits &= bits - 1;
            taken |= self.state.take::<f32, ANY>(i, t[lane], true, ids[lane]);
        }
        taken
    }
}
