//! An interval that starts one ulp before a hit has the same hit: `t_min` chooses among hits and moves none.

use raypacket::math::NONE;

use crate::common::Pcg;
use crate::pair::Pair;
use crate::rays::batches;
use crate::scenes::{Kind, scene};

#[test]
fn a_hit_is_found_again_from_just_before_it() {
    let mut hits = 0;
    let kinds = [Kind::Random(1), Kind::Random(40), Kind::Far, Kind::Flat, Kind::Quads, Kind::Inscribed, Kind::Sizes];
    for (k, kind) in kinds.into_iter().enumerate() {
        for seed in 0..40 {
            let mut rng = Pcg::new(seed << 8 | k as u64);
            let mut pair = Pair::new(scene(kind, &mut rng));
            for _ in 0..3 {
                let [mut rays, _] = batches(&mut pair, &mut rng);
                let first = pair.hits(&rays);
                for i in 0..rays.len {
                    if rays.t_max[i] < 0.0 || first.primitive[i] == NONE {
                        rays.t_max[i] = -1.0;
                        continue;
                    }
                    rays.t_min[i] = first.t[i].next_down();
                    hits += 1;
                }
                let again = pair.hits(&rays);
                for i in (0..rays.len).filter(|&i| rays.t_max[i] >= 0.0) {
                    let of = |hits: &raypacket::math::HitBatch| (hits.t[i].to_bits(), hits.primitive[i]);
                    let kind_of = pair.without.primitive(first.primitive[i]);
                    assert_eq!(of(&again), of(&first), "{kind:?} {seed}: {kind_of:?} at {}", first.t[i]);
                }
                pair.check(&rays, "from just before");
            }
        }
    }
    assert!(hits > 20_000, "{hits}");
}
