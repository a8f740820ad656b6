//! The tree gives what testing every primitive gives: the same distances, ids and shadows to the bit, at every width,
//! on scenes and rays that are hard on boxes.

mod beyond;
#[path = "../common/mod.rs"]
mod common;
mod field;
mod found;
mod of_a_kind;
mod pair;
mod pictures;
mod rays;
mod scenes;

use common::Pcg;
use pair::Pair;
use scenes::Kind;

/// Runs `batches` batches on each of `scenes` scenes of a kind; every other scene that can be is without rare kinds.
fn run(kind: Kind, scenes: u64, batches: u64) {
    let mut found = [0; 2];
    for seed in 0..scenes {
        let mut rng = Pcg::new(seed);
        let mut description = scenes::scene(kind, &mut rng);
        if seed % 2 == 1 {
            scenes::plain(&mut description);
        }
        let mut pair = Pair::new(description);
        for batch in 0..batches {
            let name = format!("{kind:?}, scene {seed}, batch {batch}");
            let mut rng = Pcg::new(seed << 32 | batch << 8 | 0xb5);
            for rays in rays::batches(&mut pair, &mut rng) {
                let [active, hits] = pair.check(&rays, &name);
                found = [found[0] + active, found[1] + hits];
            }
        }
    }
    let share = found[1] as f32 / found[0] as f32;
    println!("{kind:?}: {share} of {} rays hit", found[0]);
    let wanted = if kind == Kind::Empty { 0.0..=0.0 } else { 0.05..=0.99 };
    assert!(found[0] > 1000 && wanted.contains(&share), "{kind:?}: {share} of {} rays hit", found[0]);
}

#[test]
fn one_primitive() {
    run(Kind::Random(1), 60, 12);
}

#[test]
fn around_a_block() {
    for n in [2, 7, 8, 9] {
        run(Kind::Random(n), 40, 12);
    }
}

#[test]
fn tens() {
    run(Kind::Random(64), 30, 16);
}

#[test]
fn hundreds() {
    run(Kind::Random(500), 8, 16);
}

#[test]
fn thousands() {
    run(Kind::Random(3000), 4, 8);
}

#[test]
fn twenty_thousand() {
    run(Kind::Random(20_000), 2, 16);
}

#[test]
fn nothing() {
    run(Kind::Empty, 1, 40);
}

#[test]
fn only_planes() {
    run(Kind::Planes, 20, 20);
}

#[test]
fn far_away() {
    run(Kind::Far, 20, 20);
}

#[test]
fn identical_primitives() {
    run(Kind::Equal, 12, 20);
}

#[test]
fn on_a_line() {
    run(Kind::Collinear, 12, 20);
}

#[test]
fn in_a_plane() {
    run(Kind::Flat, 20, 20);
}

#[test]
fn nested() {
    run(Kind::Nested, 12, 20);
}

#[test]
fn huge_and_tiny() {
    run(Kind::Sizes, 20, 30);
}

#[test]
fn shared_faces() {
    run(Kind::Grid, 6, 20);
}

#[test]
fn slivers() {
    run(Kind::Slivers, 40, 30);
}

#[test]
fn quads_along_their_edges() {
    run(Kind::Quads, 60, 30);
}

#[test]
fn bodies_that_fill_their_boxes() {
    run(Kind::Inscribed, 30, 30);
}

#[test]
fn one_sided() {
    run(Kind::OneSided, 20, 20);
}

#[test]
fn exponentially_spaced() {
    run(Kind::Exponential, 20, 30);
}
