//! A plain walk, one ray after the other through the boxes, beside groups and packets: those are sixteen rays wide at every
//! width, so that to compare the widths is partly to compare code with itself.

use super::batch::answer;
use super::beams::{Ends, far_apart};
use super::state::State;
use super::walk::Walk;
use crate::bvh::Places;
use crate::geometry::{Primitives, Sides};
use crate::math::{BATCH, RayBatch};
use crate::measure::random::Pcg;
use crate::scene::{Description, Scene, Structure, compile_with, load};
use crate::trace::prefetch::Prefetch;
use crate::trace::query::{Intersect, Occluded, Query};
use wide::{f32x4, f32x8, f32x16};

/// Leaves the answers in `state`: no beam, no packet, no group.
fn plain<Q: Query>(scene: &Scene, rays: &RayBatch, state: &mut State) {
    let bvh = scene.bvh.as_ref().expect("a tree");
    state.start::<f32>(rays);
    let mut walk = Walk { scene, bvh, places: Places::of(bvh), rays, prefetch: Prefetch::NOTHING, state };
    walk.state.lines.prepare(rays, bvh, 0..rays.len);
    for i in 0..rays.len {
        walk.single::<Q>(i, bvh.root);
    }
}

/// The bits of all answers.
fn bits(state: &State, rays: &RayBatch) -> Vec<(u32, u32)> {
    (0..rays.len).map(|i| (state.t[i].to_bits(), state.id[i])).collect()
}

fn check<Q: Query>(scene: &Scene, rays: &RayBatch, name: &str) {
    let bvh = scene.bvh.as_ref().expect("a tree");
    let (mut one, mut many) = (Box::<State>::default(), Box::<State>::default());
    plain::<Q>(scene, rays, &mut one);
    let wanted = bits(&one, rays);
    let mut agrees = |width: &str, answer: &dyn Fn(&mut State)| {
        answer(&mut many);
        let found = bits(&many, rays);
        let same = |i: &usize| {
            let ([t, u], [id, other]) = ([wanted[*i].0, found[*i].0], [wanted[*i].1, found[*i].1]);
            // An inactive ray's NaN is any.
            (t == u || f32::from_bits(t).is_nan() && f32::from_bits(u).is_nan()) && id == other
        };
        let wrong = (0..rays.len).find(|i| !same(i));
        assert_eq!(wrong, None, "{name}, {width}: {:?} {:?}", wrong.map(|i| found[i]), wrong.map(|i| wanted[i]));
    };
    let none = || None;
    agrees("x1", &|state| answer::<Q, f32>(scene, bvh, rays, Prefetch::NOTHING, none, state));
    agrees("x4", &|state| answer::<Q, f32x4>(scene, bvh, rays, Prefetch::NOTHING, none, state));
    agrees("x8", &|state| answer::<Q, f32x8>(scene, bvh, rays, Prefetch::NOTHING, none, state));
    agrees("x16", &|state| answer::<Q, f32x16>(scene, bvh, rays, Prefetch::NOTHING, none, state));
}

/// Rays about a scene: `spread` is how far apart directions and origins of sixteen in a row are.
fn batch(scene: &Scene, len: usize, spread: f32, rng: &mut Pcg) -> RayBatch {
    let bounds = scene.bvh.as_ref().expect("a tree").bounds;
    let (middle, size) = (0.5 * (bounds.min + bounds.max), (bounds.max - bounds.min).max_element());
    let mut rays = RayBatch::default();
    let (mut from, mut to) = (middle, middle);
    for i in 0..len {
        if i % 16 == 0 {
            (from, to) = (middle + rng.cube() * size, middle + rng.cube() * 0.4 * size);
        }
        let origin = from + rng.cube() * spread * size;
        let direction = (to + rng.cube() * spread * size - origin).normalize();
        match rng.below(12) {
            0 => rays.push_inactive(),
            1 => rays.push(origin, direction, 0.0, rng.range(0.0, size)),
            2 => rays.push(origin, direction, rng.range(0.0, size), f32::INFINITY),
            _ => rays.push(origin, direction, 0.0, f32::INFINITY),
        }
    }
    rays
}

/// Built-in scenes by a tree, without their planes, which no tree holds; every other time with sides that are not there.
fn scenes() -> Vec<Description> {
    let names = ["flake", "lattice", "primitives", "glass", "sponge", "textures"];
    let mut scenes: Vec<Description> = names.iter().map(|name| load(name).expect("built in")).collect();
    for (i, scene) in scenes.iter_mut().enumerate() {
        scene.planes.clear();
        if i % 2 == 1 {
            scene.spheres.iter_mut().step_by(2).for_each(|it| it.sides = Sides::Back);
            scene.cylinders.iter_mut().step_by(2).for_each(|it| it.sides = Sides::Front);
            scene.meshes.iter_mut().for_each(|it| it.sides = Sides::Front);
        }
    }
    scenes
}

#[test]
fn packets_and_groups_find_what_a_plain_walk_finds() {
    let mut rng = Pcg::new(16);
    let [mut apart, mut together] = [0, 0];
    for description in scenes() {
        let scene = compile_with(&description, &Structure::Tree.into()).expect("a sound scene");
        assert!(scene.planes.is_empty());
        let bvh = scene.bvh.as_ref().expect("a tree");
        for round in 0..60 {
            let len = [BATCH, 1, 17, 100, 255][round % 5];
            let rays = batch(&scene, len, [1.0, 0.1, 1e-4][round % 3], &mut rng);
            let name = format!("{}, round {round}", description.name);
            check::<Intersect>(&scene, &rays, &name);
            check::<Occluded>(&scene, &rays, &name);
            let mut state = Box::<State>::default();
            state.start::<f32x8>(&rays);
            let [narrow, wide] = Ends::of(&rays, &state).narrow(bvh, far_apart(rays.common_origin, false));
            apart += wide.count_ones();
            together += narrow.count_ones();
        }
    }
    assert!(apart > 500 && together > 200, "the cases are there: {apart} {together}");
}
