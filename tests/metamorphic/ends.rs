//! From A to B is as from B to A.

use std::cell::Cell;

use glam::{DVec3, Vec3};
use proptest::{prelude::*, test_runner::TestRunner};
use raypacket::{
    math::Lanes,
    measure::verify::K,
    reference::Tracer,
    scene::{Description, Scene, Structure, compile, compile_with},
    trace::{Blocked, HitBatch, RayBatch, Scratch, intersect, occluded},
};
use wide::{f32x4, f32x8};

use crate::{
    common::{Pcg, ROUNDOFF},
    config,
    scenes::{Steps, items, place, scene, vector},
};

/// How many ways near one are tried, to see whether they are alike.
const NEAR: usize = 500;

/// A ray a way, from its first point to its second; open at both ends.
fn rays(ways: &[[Vec3; 2]]) -> RayBatch {
    let mut rays = RayBatch::default();
    for [from, to] in ways {
        let way = to.as_dvec3() - from.as_dvec3();
        rays.push(*from, way.normalize().as_vec3(), 0.0, way.length() as f32);
    }
    rays
}

fn blocked<L: Lanes>(scene: &Scene, ways: &[[Vec3; 2]]) -> Vec<bool> {
    let mut blocked = Blocked::default();
    occluded::<L>(scene, &rays(ways), &mut blocked, &mut Scratch::default());
    (0..ways.len()).map(|i| blocked.get(i, 1) != 0).collect()
}

/// Of the ways that meet something, two more: one that ends a little before it, and one a little behind.
fn short_and_long(scene: &Scene, ways: &[[Vec3; 2]]) -> Vec<[Vec3; 2]> {
    let mut hits = HitBatch::default();
    intersect::<f32>(scene, &rays(ways), &mut hits, &mut Scratch::default());
    let ends = ways.iter().zip(hits.t).filter(|(_, t)| t.is_finite()).flat_map(|(&[from, to], t)| {
        let direction = (to - from).normalize();
        [1.0 - 1e-4, 1.0 + 1e-4].map(|part| [from, from + direction * (t * part)])
    });
    ends.filter(|[from, to]| from != to).collect()
}

/// Whether the reference finds ways near this one that are blocked, and others that are free. Near are those whose ends
/// are off by K ε of the farthest point's distance from the world's origin.
fn at_an_edge(description: &Description, [from, to]: [Vec3; 2]) -> bool {
    let tracer = Tracer::new(description);
    let sizes = (0..description.primitives() as u32).map(|id| tracer.extent(id));
    let size = sizes.fold(from.length().max(to.length()).into(), f64::max);
    let mut rng = Pcg::new(7);
    let mut off = || DVec3::from(rng.cube()) * (K * ROUNDOFF * size * rng.pick(&[1.0, 1.0, 0.1, 1e-3]));
    let mut answers = (0..NEAR).map(|_| {
        let (from, to) = (from.as_dvec3() + off(), to.as_dvec3() + off());
        tracer.blocked(from, (to - from).normalize(), (to - from).length())
    });
    let first = answers.next();
    answers.any(|answer| Some(answer) != first)
}

fn expect_symmetric(
    items: &[crate::scenes::Item],
    ways: &[[Steps; 2]],
    seen: &Cell<[usize; 2]>,
) -> Result<(), TestCaseError> {
    let description = scene(items);
    let mut ways: Vec<_> = ways.iter().map(|way| way.map(|end| place(end) * 1.5)).filter(|[a, b]| a != b).collect();
    ways.extend(short_and_long(&compile(&description).expect("a sound scene"), &ways));
    let back: Vec<_> = ways.iter().map(|&[from, to]| [to, from]).collect();
    for structure in [Structure::None, Structure::Tree] {
        let compiled = compile_with(&description, &structure.into()).expect("a sound scene");
        let there = blocked::<f32x8>(&compiled, &ways);
        for answers in
            [blocked::<f32>(&compiled, &back), blocked::<f32x4>(&compiled, &back), blocked::<f32x8>(&compiled, &back)]
        {
            for ((way, there), back) in ways.iter().zip(&there).zip(answers) {
                prop_assert!(*there == back || at_an_edge(&description, *way), "{way:?}: {there} there, {back} back");
            }
        }
        let [all, found] = seen.get();
        seen.set([all + there.len(), found + there.iter().filter(|t| **t).count()]);
    }
    Ok(())
}

#[test]
fn occluded_there_and_back() {
    let seen = Cell::new([0; 2]);
    let ways = prop::collection::vec([vector(), vector()], 1..64);
    let mut runner = TestRunner::new(config(2000, 0xa3));
    runner.run(&(items(), ways), |(items, ways)| expect_symmetric(&items, &ways, &seen)).unwrap();
    let [all, blocked] = seen.get();
    assert!((0.1..0.9).contains(&(blocked as f64 / all as f64)), "{blocked} of {all} ways are blocked");
}
