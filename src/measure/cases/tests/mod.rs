//! That every case is sound, and what it says.

mod dials;
mod surfaces;

use super::*;
use crate::scene::compile;

/// ε: half the distance from 1 to the next `f32`.
const ROUNDOFF: f64 = 1.0 / (1u64 << 24) as f64;

const RAYS: usize = 60;

/// Every setting tried, with a seed of its own.
fn settings(generator: &Generator) -> impl Iterator<Item = (f64, u64)> {
    generator.dial.settings(7).zip(1..)
}

/// The case of that name at several settings.
fn cases(name: &str) -> impl Iterator<Item = (f64, Case)> {
    let generator = find(name).expect("a case");
    settings(generator).map(|(dial, seed)| (dial, generator.make(dial, RAYS, seed)))
}

#[test]
fn all_compile_and_have_sound_rays() {
    for generator in ALL {
        for (dial, seed) in settings(generator) {
            let Case { description, rays, subject } = generator.make(dial, RAYS, seed);
            let name = format!("{} at {dial:e}", generator.name);
            compile(&description).unwrap_or_else(|e| panic!("{name}: {e}"));
            assert_eq!((rays.len(), subject), (RAYS, generator.subject), "{name}");
            assert_eq!(description.name, generator.name);
            for ray in &rays {
                assert!(ray.origin.is_finite() && ray.direction.is_finite(), "{name}: {ray:?}");
                assert!(ray.t_min == 0.0 && ray.t_max > 0.0, "{name}: {ray:?}");
                let length = ray.direction.as_dvec3().length();
                assert!((length - 1.0).abs() <= 2.0 * ROUNDOFF, "{name}: {ray:?}, length {length}");
            }
        }
    }
}

/// To the bit, and no two seeds or settings alike.
#[test]
fn seeds_decide() {
    let bits = |case: &Case| -> Vec<[u32; 6]> {
        let of = |r: &Ray| [r.origin.to_array(), r.direction.to_array()].concat().iter().map(|x| x.to_bits()).collect();
        case.rays.iter().map(|r| Vec::<u32>::try_into(of(r)).expect("six numbers")).collect()
    };
    for generator in ALL {
        let Dial { least, most, .. } = generator.dial;
        for dial in [least, (least * most).sqrt()] {
            let one = generator.make(dial, RAYS, 5);
            let again = generator.make(dial, RAYS, 5);
            assert_eq!((bits(&one), &one.description), (bits(&again), &again.description), "{}", generator.name);
            let other = generator.make(dial, RAYS, 6);
            assert_ne!(bits(&one), bits(&other), "{}", generator.name);
            let turned = generator.make(most, RAYS, 5);
            assert_ne!((bits(&one), one.description), (bits(&turned), turned.description), "{}", generator.name);
        }
    }
}

#[test]
fn names_are_found() {
    for (i, generator) in ALL.iter().enumerate() {
        let kebab = |c: char| c.is_ascii_lowercase() || c == '-';
        assert!(generator.name.chars().all(kebab), "{}", generator.name);
        let first = ALL.iter().position(|g| g.name == generator.name);
        assert_eq!(first, Some(i), "{} is there twice", generator.name);
        assert_eq!(find(generator.name).map(|g| g.about), Some(generator.about));
    }
    assert!(find("sphere").is_none());
}

#[test]
fn dials_reach_their_ends() {
    for generator in ALL {
        let Dial { least, most, .. } = generator.dial;
        let all: Vec<f64> = generator.dial.settings(9).collect();
        assert!(least > 0.0 && all[0] == least && all[8] == most && all.is_sorted(), "{}: {all:?}", generator.name);
        let rays = |dial| generator.make(dial, 3, 0).rays;
        assert_eq!(rays(f64::NAN), rays(least));
        assert_eq!(rays(-1.0), rays(least));
        assert_eq!(rays(f64::INFINITY), rays(most));
        assert_eq!(rays(most).len(), 3);
        assert!(generator.make(least, 0, 0).rays.is_empty());
    }
    let dial = Dial { meaning: "", unit: "", least: 1.0, most: 3.0, spacing: Spacing::Linear };
    assert_eq!(dial.settings(3).collect::<Vec<_>>(), [1.0, 2.0, 3.0]);
    assert_eq!(dial.settings(1).collect::<Vec<_>>(), [1.0]);
    assert_eq!(dial.settings(0).count(), 0);
    let dial = Dial { least: 1e-2, most: 1e2, spacing: Spacing::Logarithmic, ..dial };
    assert!((dial.settings(3).nth(1).expect("three") - 1.0).abs() < 1e-12);
}
