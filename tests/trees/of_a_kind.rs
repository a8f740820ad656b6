//! Ten thousand primitives of one kind, in arrangements that are hard on a tree of it.

use glam::{Vec3, vec3};
use raypacket::scene::Description;

use crate::common::{Pcg, empty};
use crate::pair::Pair;
use crate::{rays, scenes};

/// Primitives of a scene.
const MANY: usize = 10_000;

/// How they lie.
#[derive(Clone, Copy, Debug)]
enum Arrangement {
    /// Anywhere, of several sizes.
    Spread,
    /// In dense clusters far apart.
    Clusters,
    /// Long, thin and slanted, so that their boxes are mostly empty.
    Slanted,
    /// One around the other, a hundred deep.
    Nested,
    /// A hundred at a time in the same place.
    Coincident,
}

fn scene(kind: usize, arrangement: Arrangement, rng: &mut Pcg) -> Description {
    let mut scene = empty();
    let (mut at, mut shape) = (Vec3::ZERO, Vec3::ONE);
    for i in 0..MANY {
        let size = match arrangement {
            Arrangement::Spread => {
                (at, shape) = (rng.cube(), rng.cube());
                0.05 * rng.pick(&[0.1, 0.5, 1.0])
            }
            Arrangement::Clusters => {
                at = vec3((i % 5) as f32 * 100.0, 0.0, (i % 3) as f32 * 30.0) + rng.cube();
                shape = rng.cube();
                0.05
            }
            Arrangement::Slanted => {
                at = rng.cube();
                shape = vec3(rng.pick(&[-1.0, 1.0]), rng.range(-0.05, 0.05), rng.cube().z);
                0.2
            }
            Arrangement::Nested => {
                if i % 100 == 0 {
                    (at, shape) = (rng.cube(), rng.cube());
                }
                0.002 * (i % 100 + 1) as f32
            }
            Arrangement::Coincident => {
                if i % 100 == 0 {
                    (at, shape) = (rng.cube(), rng.cube());
                }
                0.1
            }
        };
        scenes::add(&mut scene, kind, at, shape, size);
    }
    scene
}

fn run(arrangement: Arrangement) {
    for kind in 0..scenes::KINDS {
        let mut rng = Pcg::new(kind as u64);
        let mut pair = Pair::new(scene(kind, arrangement, &mut rng));
        let mut found = [0; 2];
        for batch in 0..6 {
            let mut rng = Pcg::new(batch << 8 | 0x5d);
            for rays in rays::batches(&mut pair, &mut rng) {
                let [active, hits] = pair.check(&rays, &format!("kind {kind}, {arrangement:?}, batch {batch}"));
                found = [found[0] + active, found[1] + hits];
            }
        }
        assert!(found[0] > 200 && found[1] > 10, "kind {kind}, {arrangement:?}: {} of {} rays hit", found[1], found[0]);
    }
}

#[test]
fn ten_thousand_spread() {
    run(Arrangement::Spread);
}

#[test]
fn ten_thousand_in_clusters() {
    run(Arrangement::Clusters);
}

#[test]
fn ten_thousand_slanted() {
    run(Arrangement::Slanted);
}

#[test]
fn ten_thousand_nested() {
    run(Arrangement::Nested);
}

#[test]
fn ten_thousand_coincident() {
    run(Arrangement::Coincident);
}
