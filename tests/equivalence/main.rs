//! Every width, both queries, all batch lengths, with a tree and without: the same bits as one ray after another against
//! every primitive.

#[path = "../common/mod.rs"]
mod common;
mod oracle;
mod pictures;
mod rays;
mod scenes;

use raypacket::math::{BATCH, Lanes};
use raypacket::scene::{Description, Scene, Structure, compile_with};
use raypacket::trace::{Blocked, HitBatch, NONE, RayBatch, Scratch, intersect, occluded};
use wide::{f32x4, f32x8};

use common::Pcg;
use oracle::{Answer, Ray};
use scenes::Place;

/// Scenes a kind.
const ROUNDS: u64 = 6;

/// What stands in the answers before a query, and has to be there after it for an inactive ray.
const OLD_T: f32 = -12345.5;
const OLD_ID: u32 = 0xdead_beef;

/// A batch with its answers.
struct Case<'a> {
    /// The scene without a tree, and with one.
    scenes: &'a [Scene; 2],
    rays: RayBatch,
    expected: Vec<Answer>,
    /// Of the scene as light meets it, where that is another.
    stopped: Option<Vec<Answer>>,
    /// Says how to come back here.
    name: String,
}

impl<'a> Case<'a> {
    fn new(Scenes { seen, lit }: &'a Scenes, rays: RayBatch, name: String) -> Self {
        let of = |scene| (0..rays.len).map(|i| Answer::new(scene, &Ray::of(&rays, i))).collect();
        Self { scenes: seen, expected: of(&seen[0]), stopped: lit.as_ref().map(of), rays, name }
    }

    /// Whether light is stopped, given whether the ray has a hit; `None` for a ray that is not finite.
    fn blocked(&self, i: usize, hit: bool) -> Option<bool> {
        match self.stopped.as_ref().map(|stopped| stopped[i]) {
            // A ray is blocked exactly when `intersect` finds a hit.
            None => Some(hit),
            Some(Answer::Hit(_, id)) => Some(id != NONE),
            Some(_) => None,
        }
    }

    /// Both queries on the whole batch, and on every ray by itself.
    fn check<L: Lanes>(&self, scratch: &mut Scratch) {
        self.check_batch::<L>(&self.rays, 0, "batch", scratch);
        for i in 0..self.rays.len {
            let Ray { origin, direction, t_min, t_max } = Ray::of(&self.rays, i);
            let mut one = RayBatch::default();
            one.push(origin, direction, t_min, t_max);
            self.check_batch::<L>(&one, i, &format!("ray {i} alone"), scratch);
        }
    }

    /// The rays are those from `first` on; what comes after the last has to be left as it was.
    fn check_batch<L: Lanes>(&self, rays: &RayBatch, first: usize, what: &str, scratch: &mut Scratch) {
        let [without, with] = self.scenes;
        self.check_in::<L>(without, rays, first, what, scratch);
        self.check_in::<L>(with, rays, first, &format!("{what}, by the tree"), scratch);
    }

    fn check_in<L: Lanes>(&self, scene: &Scene, rays: &RayBatch, first: usize, what: &str, scratch: &mut Scratch) {
        let expected = &self.expected[first..first + rays.len];
        let mut hits = HitBatch { t: [OLD_T; BATCH], primitive: [OLD_ID; BATCH] };
        intersect::<L>(scene, rays, &mut hits, scratch);
        let answers = || (0..BATCH).map(|i| expected.get(i).copied().unwrap_or(Answer::Untouched)).enumerate();
        for (i, answer) in answers() {
            let found = (hits.t[i], hits.primitive[i]);
            let same = |t: f32, id| found.0.to_bits() == t.to_bits() && found.1 == id;
            let right = match answer {
                Answer::Untouched => same(OLD_T, OLD_ID),
                Answer::Broken => true,
                Answer::Hit(t, id) => same(t, id),
            };
            assert!(right, "{}, {what}: {} intersect, lane {i}: {found:?} for {answer:?}", self.name, L::NAME);
        }
        for old in [0, 0x5a3c_0ff1, u32::MAX] {
            let mut blocked = Blocked::default();
            for at in (0..BATCH).step_by(32) {
                blocked.set(at, u32::MAX, old);
            }
            occluded::<L>(scene, rays, &mut blocked, scratch);
            for (i, answer) in answers() {
                let found = blocked.get(i, 1);
                let wanted = if answer == Answer::Untouched {
                    old >> (i % 32) & 1
                } else {
                    self.blocked(first + i, hits.primitive[i] != NONE).map_or(found, u32::from)
                };
                assert!(found == wanted, "{}, {what}: {} occluded, lane {i}: {found}", self.name, L::NAME);
            }
        }
    }
}

/// A scene compiled.
struct Scenes {
    /// Without a tree and with one.
    seen: [Scene; 2],
    /// As light meets it, where that is another.
    lit: Option<Scene>,
}

impl Scenes {
    fn new(description: &Description) -> Self {
        let compiled =
            |description: &Description, s: Structure| compile_with(description, &s.into()).expect("a sound scene");
        let seen = [Structure::None, Structure::Tree].map(|s| compiled(description, s));
        Self { seen, lit: common::lit(description).map(|lit| compiled(&lit, Structure::None)) }
    }
}

fn lengths() -> impl Iterator<Item = usize> {
    (1..=33).chain([BATCH - 1, BATCH])
}

/// Runs the matrix on scenes of one kind.
fn run(kind: scenes::Kind) {
    let mut scratch = Scratch::default();
    let [mut active, mut hit] = [0, 0];
    for seed in 0..ROUNDS {
        let mut rng = Pcg::new(seed);
        let place = Place::random(&mut rng);
        let scenes = Scenes::new(&scenes::scene(kind, place, &mut rng));
        for rays in rays::Kind::all() {
            for len in lengths() {
                let name = format!("{kind:?}, seed {seed}, {rays:?}, {len} rays");
                let case = Case::new(&scenes, rays::batch(rays, len, &scenes.seen[0], place, &mut rng), name);
                case.check::<f32>(&mut scratch);
                case.check::<f32x4>(&mut scratch);
                case.check::<f32x8>(&mut scratch);
                for answer in &case.expected {
                    let Answer::Hit(_, id) = *answer else { continue };
                    active += 1;
                    hit += usize::from(id != NONE);
                    let first = kind != scenes::Kind::Coincident || id == NONE || !scenes::is_copy(id);
                    assert!(first, "{}: {id} has a copy with a lower id", case.name);
                }
            }
        }
    }
    // That the rays meet things, and miss some.
    let share = hit as f32 / active as f32;
    let wanted = if kind == scenes::Kind::Empty { 0.0..0.01 } else { 0.2..0.9 };
    assert!(active > 50_000 && wanted.contains(&share), "{share} of {active} rays hit");
}

#[test]
fn planes() {
    run(scenes::Kind::Planes);
}

#[test]
fn spheres() {
    run(scenes::Kind::Spheres);
}

#[test]
fn triangles() {
    run(scenes::Kind::Triangles);
}

#[test]
fn mixed() {
    run(scenes::Kind::Mixed);
}

#[test]
fn bodies() {
    run(scenes::Kind::Bodies);
}

#[test]
fn one_sided() {
    run(scenes::Kind::OneSided);
}

#[test]
fn nothing() {
    run(scenes::Kind::Empty);
}

#[test]
fn coincident_primitives_go_to_the_lowest_id() {
    run(scenes::Kind::Coincident);
}

/// What decides here is a few ε, in one batch of thousands: many small batches, each beside an outline.
#[test]
fn culling_beside_outlines() {
    let mut scratch = Scratch::default();
    let directions = rays::Directions::OneSided;
    for (kind, seed) in [scenes::Kind::Planes, scenes::Kind::Spheres, scenes::Kind::Triangles, scenes::Kind::Bodies]
        .into_iter()
        .flat_map(|kind| (0..600).map(move |seed| (kind, seed)))
    {
        let mut rng = Pcg::new(1000 + seed);
        let place = Place::random(&mut rng);
        let scenes = Scenes::new(&scenes::scene(kind, place, &mut rng));
        for origins in [rays::Origins::Flagged, rays::Origins::Near] {
            for len in [2, 3, 7, 16] {
                let rays = rays::Kind { origins, directions, broken: false };
                let name = format!("{kind:?}, seed {seed}, {rays:?}, {len} rays");
                let case = Case::new(&scenes, rays::batch(rays, len, &scenes.seen[0], place, &mut rng), name);
                case.check_batch::<f32x8>(&case.rays, 0, "batch", &mut scratch);
            }
        }
    }
}

/// Origins so close to each other that the square of their distance is no `f32`: still not one origin.
#[test]
fn origins_apart_by_next_to_nothing() {
    let mut description = common::empty();
    description.planes.push(common::plane(glam::Vec3::Y, 0.0));
    let scenes = Scenes::new(&description);
    let mut rays = RayBatch::default();
    for height in [0.0, 1e-25, -1e-25, 3e-25] {
        rays.push(glam::Vec3::Y * height, glam::Vec3::NEG_Y, 0.0, f32::INFINITY);
    }
    let case = Case::new(&scenes, rays, "origins 1e-25 apart".into());
    case.check::<f32>(&mut Scratch::default());
    case.check::<f32x4>(&mut Scratch::default());
    case.check::<f32x8>(&mut Scratch::default());
}
