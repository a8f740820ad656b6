//! One scene, compiled without a tree and with one, and what a query says about both.

use glam::Vec3;
use raypacket::bvh::Aabb;
use raypacket::math::{BATCH, Lanes};
use raypacket::scene::{Description, Scene, Structure, compile_with};
use raypacket::trace::{Blocked, HitBatch, NONE, RayBatch, Scratch, intersect, occluded};
use wide::{f32x4, f32x8};

use crate::common::{empty, lit};

pub struct Pair {
    pub description: Description,
    pub without: Scene,
    pub with: Scene,
    /// As light meets it, where that is another, without a tree.
    lit: Option<Scene>,
    /// The boxes of all primitives that have one.
    pub boxes: Vec<Aabb>,
    /// The box around those, or a unit cube.
    pub bounds: Aabb,
    scratch: Scratch,
}

/// What the two queries say about a batch.
struct Answers {
    hits: HitBatch,
    blocked: Blocked,
}

/// What stands in the answers before a query, and has to stay for inactive rays.
const OLD: (f32, u32) = (-12345.5, 0xdead_beef);

impl Answers {
    fn new<L: Lanes>(scene: &Scene, rays: &RayBatch, scratch: &mut Scratch) -> Self {
        let mut hits = HitBatch { t: [OLD.0; BATCH], primitive: [OLD.1; BATCH] };
        intersect::<L>(scene, rays, &mut hits, scratch);
        let mut blocked = Blocked::default();
        for at in (0..BATCH).step_by(32) {
            blocked.set(at, u32::MAX, 0x5a3c_0ff1);
        }
        occluded::<L>(scene, rays, &mut blocked, scratch);
        Self { hits, blocked }
    }

    fn of(&self, i: usize) -> (u32, u32, u32) {
        (self.hits.t[i].to_bits(), self.hits.primitive[i], self.blocked.get(i, 1))
    }
}

impl Pair {
    pub fn new(description: Description) -> Self {
        let compiled =
            |s: Structure| compile_with(&description, &s.into()).unwrap_or_else(|e| panic!("a sound scene: {e}"));
        let [without, with] = [Structure::None, Structure::Tree].map(compiled);
        assert!(without.bvh.is_none() && with.bvh.is_some());
        let lit = lit(&description).map(|d| compile_with(&d, &Structure::None.into()).expect("a sound scene"));
        let spheres = description.spheres.iter().map(|s| Aabb { min: s.center - s.radius, max: s.center + s.radius });
        let triangles = (0..with.triangles.material.len()).map(|i| with.triangles.corners(i));
        let triangles = triangles.map(|corners| corners.into_iter().fold(Aabb::EMPTY, Aabb::extend));
        let boxes: Vec<_> = spheres.chain(triangles).chain(with.boxes.iter().copied()).collect();
        let bounds = boxes.iter().copied().reduce(Aabb::union);
        let bounds = bounds.unwrap_or(Aabb { min: Vec3::NEG_ONE, max: Vec3::ONE });
        Self { description, without, with, lit, boxes, bounds, scratch: Scratch::default() }
    }

    /// The nearest hits without the tree.
    pub fn hits(&mut self, rays: &RayBatch) -> HitBatch {
        Answers::new::<f32x8>(&self.without, rays, &mut self.scratch).hits
    }

    /// Compares the tree's answers at every width to those without; the numbers of active rays and of hits.
    pub fn check(&mut self, rays: &RayBatch, name: &str) -> [usize; 2] {
        let wanted = Answers::new::<f32x8>(&self.without, rays, &mut self.scratch);
        let x1 = Answers::new::<f32>(&self.with, rays, &mut self.scratch);
        let x4 = Answers::new::<f32x4>(&self.with, rays, &mut self.scratch);
        let x8 = Answers::new::<f32x8>(&self.with, rays, &mut self.scratch);
        let lit = self.lit.as_ref().map(|lit| Answers::new::<f32x8>(lit, rays, &mut self.scratch));
        let mut counts = [0; 2];
        for i in 0..BATCH {
            for (width, found) in [("x1", &x1), ("x4", &x4), ("x8", &x8)] {
                if found.of(i) != wanted.of(i) {
                    let report = self.report(rays, i, wanted.of(i), found.of(i));
                    panic!("{name}: {width}, ray {i} of {}\n{report}", rays.len);
                }
            }
            let (_, id, blocked) = wanted.of(i);
            if i < rays.len && rays.t_max[i] >= 0.0 {
                let hit = id != NONE;
                let stopped = lit.as_ref().map_or(id, |lit| lit.of(i).1) != NONE;
                assert!(stopped == (blocked == 1), "{name}: ray {i} is blocked exactly when light meets anything");
                counts = [counts[0] + 1, counts[1] + usize::from(hit)];
            }
        }
        counts
    }

    /// All that it takes to see the fault again.
    fn report(&self, rays: &RayBatch, i: usize, wanted: (u32, u32, u32), found: (u32, u32, u32)) -> String {
        let [origin, direction] = ray(rays, i);
        let exact = |v: Vec3| format!("{v:?} = bits {:#010x?}", v.to_array().map(f32::to_bits)).replace('\n', "");
        let answer = |(t, id, blocked): (u32, u32, u32)| {
            format!("t {} ({t:#010x}) id {id} blocked {blocked}", f32::from_bits(t))
        };
        let (t_min, t_max) = (rays.t_min[i], rays.t_max[i]);
        let mut text = format!(
            "  origin    {}\n  direction {}\n  t_min {t_min:?} ({:#010x}), t_max {t_max:?} ({:#010x})\n  without: \
             {}\n  with:    {}\n",
            exact(origin),
            exact(direction),
            t_min.to_bits(),
            t_max.to_bits(),
            answer(wanted),
            answer(found)
        );
        text += &format!("  the batch says that it has one origin: {}\n", rays.common_origin);
        let mut alone = RayBatch::default();
        alone.push(origin, direction, t_min, t_max);
        let differ = |description: &Description| {
            let compiled = |s: Structure| compile_with(description, &s.into()).expect("a part of a sound scene");
            let [without, with] = [Structure::None, Structure::Tree].map(compiled);
            let mut scratch = Scratch::default();
            let wanted = Answers::new::<f32x8>(&without, &alone, &mut scratch).of(0);
            let found = [
                Answers::new::<f32>(&with, &alone, &mut scratch).of(0),
                Answers::new::<f32x4>(&with, &alone, &mut scratch).of(0),
                Answers::new::<f32x8>(&with, &alone, &mut scratch).of(0),
            ];
            found.iter().any(|f| *f != wanted)
        };
        text += &format!("  the ray alone differs too: {}\n", differ(&self.description));
        let mut part = empty();
        for id in [wanted.1, found.1] {
            keep(&self.description, id, &mut part);
        }
        text += &format!("  and with nothing but the primitives that were hit: {}\n", differ(&part));
        text + &format!("  those are {:?}\n", (&part.planes, &part.spheres, &part.meshes, &part.quads, &part.cuboids))
            + &format!("  {:?}", (&part.cylinders, &part.cones, &part.tori, &part.fractals, &part.discs))
    }
}

/// Origin and direction of ray `i`.
fn ray(rays: &RayBatch, i: usize) -> [Vec3; 2] {
    let at = |columns: &[[f32; BATCH]; 3], i: usize| Vec3::from_array([0, 1, 2].map(|axis| columns[axis][i]));
    [at(&rays.origin, if rays.common_origin { 0 } else { i }), at(&rays.direction, i)]
}

/// Adds primitive `id` of one description to another.
fn keep(from: &Description, id: u32, to: &mut Description) {
    let mut i = id as usize;
    macro_rules! kind {
        ($field:ident) => {
            if let Some(&primitive) = from.$field.get(i) {
                to.$field.push(primitive);
                return;
            }
            i = i.wrapping_sub(from.$field.len());
        };
    }
    kind!(planes);
    kind!(spheres);
    for mesh in &from.meshes {
        if let Some(corners) = mesh.triangles.get(i) {
            let mut one = crate::common::mesh(&[corners.map(|c| mesh.positions[c as usize])]);
            one.sides = mesh.sides;
            to.meshes.push(one);
            return;
        }
        i = i.wrapping_sub(mesh.triangles.len());
    }
    kind!(quads);
    kind!(cuboids);
    kind!(cylinders);
    kind!(cones);
    kind!(tori);
    kind!(fractals);
    kind!(discs);
    let _ = i;
}
