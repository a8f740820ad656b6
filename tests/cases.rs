//! The hard cases through the public queries: every width, with a tree and without, both queries give one answer.

use raypacket::math::Lanes;
use raypacket::measure::cases::{ALL, Case, Generator, Ray, Subject, find};
use raypacket::scene::{Description, Scene, Structure, compile, compile_with};
use raypacket::trace::{BATCH, Blocked, Hit, HitBatch, NONE, RayBatch, Scratch, intersect, intersect_one, occluded};
use wide::{f32x4, f32x8};

/// Rays a setting: more than a batch, and no multiple of a packet.
const RAYS: usize = BATCH + 37;

/// Settings of every dial.
const SETTINGS: usize = 9;

/// One way to the answers, which all have to agree: t to the bit, and the primitive.
fn traced<L: Lanes>(scene: &Scene, rays: &[Ray], name: &str) -> Vec<(u32, u32)> {
    let mut scratch = Scratch::default();
    let mut answers = Vec::new();
    for rays in rays.chunks(BATCH) {
        let mut batch = RayBatch::default();
        rays.iter().for_each(|r| batch.push(r.origin, r.direction, r.t_min, r.t_max));
        let mut hits = HitBatch { t: [f32::NAN; BATCH], primitive: [0xdead_beef; BATCH] };
        intersect::<L>(scene, &batch, &mut hits, &mut scratch);
        let mut blocked = Blocked::default();
        occluded::<L>(scene, &batch, &mut blocked, &mut scratch);
        for (i, ray) in rays.iter().enumerate() {
            let (t, id) = (hits.t[i], hits.primitive[i]);
            let sound = if id == NONE { t == f32::INFINITY } else { t > ray.t_min && t < ray.t_max };
            assert!(sound, "{name}, {}: t = {t}, id {id} for {ray:?}", L::NAME);
            assert_eq!(blocked.get(i, 1) == 1, id != NONE, "{name}, {}: occluded and intersect, {ray:?}", L::NAME);
            answers.push((t.to_bits(), id));
        }
    }
    answers
}

/// Traces a case every way, and returns the hits.
fn agree(case: &Case, name: &str) -> Vec<Option<Hit>> {
    let [list, tree] = [Structure::None, Structure::Tree]
        .map(|s| compile_with(&case.description, &s.into()).unwrap_or_else(|e| panic!("{name}: {e}")));
    let wanted = traced::<f32>(&list, &case.rays, name);
    let others = [
        ("x4", traced::<f32x4>(&list, &case.rays, name)),
        ("x8", traced::<f32x8>(&list, &case.rays, name)),
        ("x1 by the tree", traced::<f32>(&tree, &case.rays, name)),
        ("x4 by the tree", traced::<f32x4>(&tree, &case.rays, name)),
        ("x8 by the tree", traced::<f32x8>(&tree, &case.rays, name)),
    ];
    for (way, answers) in others {
        for ((ray, found), wanted) in case.rays.iter().zip(&answers).zip(&wanted) {
            assert_eq!(found, wanted, "{name}, {way}: {ray:?}");
        }
    }
    let hit = |(t, primitive): (u32, u32)| Hit { t: f32::from_bits(t), primitive };
    wanted.into_iter().map(|answer| (answer.1 != NONE).then(|| hit(answer))).collect()
}

fn check(all: impl Iterator<Item = &'static Generator>) {
    for generator in all {
        let mut hits = 0;
        for (dial, seed) in generator.dial.settings(SETTINGS).zip(0..) {
            let case = generator.make(dial, RAYS, seed);
            let found = agree(&case, &format!("{} at {dial:e}", generator.name));
            hits += found.iter().flatten().count();
        }
        // Shadow rays end where the surface is; of the others a good part meets something.
        let least = if generator.subject == Subject::Shadow { 0 } else { RAYS * SETTINGS / 8 };
        assert!(hits >= least, "{}: {hits} hits", generator.name);
    }
}

#[test]
fn flat_and_spherical() {
    use Subject::{Cuboid, Disc, Plane, Quad, Shadow, Sphere, Triangle};
    check(ALL.iter().filter(|g| matches!(g.subject, Plane | Sphere | Triangle | Quad | Disc | Cuboid | Shadow)));
}

#[test]
fn bodies() {
    use Subject::{Cone, Cylinder, Fractal, Torus};
    check(ALL.iter().filter(|g| matches!(g.subject, Cylinder | Cone | Torus | Fractal)));
}

#[test]
fn scenes() {
    check(ALL.iter().filter(|g| matches!(g.subject, Subject::All | Subject::Refraction)));
}

/// The subject is what is there, and nothing else.
#[test]
fn the_subject_is_alone() {
    let kinds = |d: &Description| {
        let triangles = d.meshes.iter().map(|m| m.triangles.len()).sum();
        let flat = [d.planes.len(), d.spheres.len(), triangles, d.quads.len(), d.cuboids.len()];
        let round = [d.cylinders.len(), d.cones.len(), d.tori.len(), d.fractals.len(), d.discs.len()];
        [&flat[..], &round[..]].concat()
    };
    for generator in ALL {
        let there = kinds(&generator.make(generator.dial.least, 0, 0).description);
        let count = there.iter().filter(|&&n| n > 0).count();
        let at = match generator.subject {
            Subject::Plane => 0,
            Subject::Sphere => 1,
            Subject::Triangle => 2,
            Subject::Quad => 3,
            Subject::Cuboid => 4,
            Subject::Cylinder => 5,
            Subject::Cone => 6,
            Subject::Torus => 7,
            Subject::Fractal => 8,
            Subject::Disc => 9,
            Subject::All => {
                assert_eq!(count, 10);
                continue;
            }
            Subject::Refraction | Subject::Shadow => {
                assert_eq!(count, 1);
                continue;
            }
        };
        assert!(there[at] > 0 && count == 1, "{}: {there:?}", generator.name);
    }
}

/// A point that rays leave is one that a ray from outside arrives at: the kernels take it for the surface too.
#[test]
fn what_leaves_is_met_from_outside() {
    for generator in ALL.iter().filter(|g| g.name.ends_with("-leaving")) {
        for (dial, seed) in generator.dial.settings(SETTINGS).zip(0..) {
            let case = generator.make(dial, RAYS, seed);
            let scene = compile(&case.description).expect("a sound scene");
            // Even rays go to where the normal points.
            let mut near = 0;
            let outward = case.rays.iter().step_by(2);
            for ray in outward.clone() {
                let back = (0.01 * dial) as f32;
                let eye = ray.origin + ray.direction * back;
                let Some(hit) = intersect_one(&scene, eye, -ray.direction) else { continue };
                near += usize::from((hit.t / back - 1.0).abs() < 0.01);
            }
            // Flat ones may meet another part, or none.
            let all = outward.len();
            assert!(near > all * 9 / 10, "{} at {dial:e}: {near} of {all}", generator.name);
        }
    }
}

/// Rays whose answer is known from how they were made: watertight edges, tangents, slivers.
#[test]
fn known_answers() {
    let hits = |name: &str, dial: f64| {
        let case = find(name).expect("a case").make(dial, RAYS, 3);
        agree(&case, name).iter().flatten().count()
    };
    for dial in find("triangle-edge").expect("a case").dial.settings(SETTINGS) {
        assert_eq!(hits("triangle-edge", dial), RAYS, "between two triangles, {dial:e}");
    }
    for dial in find("triangle-vertex").expect("a case").dial.settings(SETTINGS) {
        assert_eq!(hits("triangle-vertex", dial), RAYS, "beside a vertex, {dial:e}");
    }
    for dial in [1e-3, 1e-2, 0.1, 1.0] {
        assert_eq!(hits("sphere-tangent", dial), RAYS.div_ceil(2), "tangents at {dial:e}");
        assert_eq!(hits("triangle-sliver", dial), RAYS.div_ceil(2), "a sliver of {dial:e}");
    }
    for dial in [1e-3, 0.1, 10.0, 90.0] {
        assert_eq!(hits("plane-grazing", dial), RAYS.div_ceil(2), "a plane at {dial:e} degrees");
    }
    for dial in find("sphere-inside").expect("a case").dial.settings(SETTINGS) {
        assert_eq!(hits("sphere-inside", dial), RAYS, "from inside, {dial:e}");
    }
}

/// A box's face belongs to it: a ray in its plane or within it sees the box, one beside it does not, by a single step of
/// `f32`.
#[test]
fn in_the_plane_of_a_face() {
    for seed in 0..20 {
        let case = find("box-face").expect("a case").make(1.0, RAYS, seed);
        let hits = agree(&case, "box-face");
        for (i, (ray, hit)) in case.rays.iter().zip(hits).enumerate() {
            assert_eq!(hit.is_some(), i % 3 != 1, "seed {seed}: {ray:?}: {hit:?} in {:?}", case.description.cuboids[0]);
        }
    }
}
