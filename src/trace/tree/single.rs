//! One ray against eight boxes, triangles or spheres at a time.

use crate::bvh::{Kind, SphereBlock, TriangleBlock};
use crate::geometry::triangle::{Aim, covers};
use crate::geometry::{Primitives, Sides, sphere};
use crate::math::{LaneMask, NONE, Vec3};
use wide::f32x8;

use super::Walk;
use super::beam::Beam;

impl Walk<'_> {
    /// Traces ray `i`, unless it is done.
    #[inline(never)]
    pub fn single<const ANY: bool, const RARE: bool>(&mut self, i: usize) {
        if self.state.t[i].is_nan() || self.state.t[i] < 0.0 {
            return;
        }
        let bvh = self.bvh;
        let origin: glam::Vec3 = self.rays.origins::<f32>(i).into();
        let direction: glam::Vec3 = Vec3::<f32>::load(&self.rays.direction, i).into();
        let beam = Beam::new([origin; 2], [direction; 2], bvh);
        let (from, to) = (Vec3::<f32x8>::splat(origin), Vec3::<f32x8>::splat(direction));
        let across = self.state.aim::<f32>(self.rays, i).across().map(|v| Vec3::splat(v.into()));
        let aim = Aim::of(to, across);
        let mut limit = self.state.t[i] + beam.slack;
        self.state.stack.start(bvh.root);
        while let Some((enter, child)) = self.state.stack.pop() {
            if enter > limit {
                continue;
            }
            let at = child.index();
            let closer = match child.kind() {
                Kind::Node => {
                    let node = &bvh.nodes[at];
                    let (enter, met) = beam.children(node, f32x8::splat(limit));
                    self.state.stack.push(node, &enter.to_array(), met);
                    continue;
                }
                Kind::Triangles => self.eight_triangles::<ANY, RARE>(i, &bvh.triangles[at], from, &aim),
                Kind::Spheres => self.eight_spheres::<ANY, RARE>(i, &bvh.spheres[at], from, to),
                Kind::Others => self.others::<f32, ANY>(at, i..i + 1),
            };
            if closer {
                limit = self.state.t[i] + beam.slack;
                if limit < 0.0 {
                    return;
                }
            }
        }
    }

    #[inline(always)]
    fn eight_triangles<const ANY: bool, const RARE: bool>(
        &mut self,
        i: usize,
        block: &TriangleBlock,
        from: Vec3<f32x8>,
        aim: &Aim<f32x8>,
    ) -> bool {
        let seen = block.corners.map(|c| Vec3::load(&c, 0) - from);
        let Some(inside) = covers(&seen, aim) else { return false };
        let mut taken = false;
        let mut bits = inside.bits();
        while bits != 0 {
            let lane = bits.trailing_zeros() as usize & 7;
            bits &= bits - 1;
            let id = block.id[lane];
            if id == NONE {
                break;
            }
            let corners = block.corners.map(|c| glam::Vec3::new(c[0][lane], c[1][lane], c[2][lane]));
            let origin = self.rays.origins::<f32>(i);
            let seen = corners.map(|c| Vec3::<f32>::from(c) - origin);
            taken |= self.triangle::<f32, ANY, RARE>(i, corners, &seen, true, id);
        }
        taken
    }

    #[inline(always)]
    fn eight_spheres<const ANY: bool, const RARE: bool>(
        &mut self,
        i: usize,
        block: &SphereBlock,
        from: Vec3<f32x8>,
        to: Vec3<f32x8>,
    ) -> bool {
        let seen = sphere::SeenSphere::new(Vec3::load(&block.center, 0), f32x8::from(block.radius), Sides::Both, from);
        if RARE {
            // Each may have another side: they are tested one by one where a ray passes through any.
            let any = sphere::passes(&seen, to);
            return any && self.each_sphere::<ANY>(i, block);
        }
        let (t_min, far) = (f32x8::splat(self.rays.t_min[i]), f32x8::splat(f32::INFINITY));
        let Some((t, inside)) = sphere::stable(&seen, to, t_min, far) else { return false };
        let t = t.to_array();
        let mut bits = inside.bits();
        let mut taken = false;
        while bits != 0 {
            let lane = bits.trailing_zeros() as usize & 7;
            bits &= bits - 1;
            taken |= self.state.take::<f32, ANY>(i, t[lane], true, block.id[lane]);
        }
        taken
    }

    #[inline(never)]
    fn each_sphere<const ANY: bool>(&mut self, i: usize, block: &SphereBlock) -> bool {
        let spheres = &self.scene.spheres;
        let mut taken = false;
        for id in block.id.into_iter().take_while(|&id| id != NONE) {
            let record = spheres.record((id - self.scene.first.spheres) as usize);
            taken |= self.packets::<crate::geometry::Spheres, f32, ANY, true>(&record, i..i + 1, id);
        }
        taken
    }
}
