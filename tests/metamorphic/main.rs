//! What must not change an answer: where a scene is, how it is turned, how large it is, which end of a way is the first,
//! and the company of a ray. Scenes of all kinds of primitives, by proptest, which shortens what fails.
//!
//! | | same as | how near |
//! |---|---|---|
//! | moved, by what is exact | the scene at its place | [the bound](raypacket::measure::verify#the-error-bound) of the farther |
//! | turned by right angles, or by any | the scene as it was | the bound |
//! | mirrored | the scene as it was | the bound |
//! | in another order | the scene as it was | distances to the bit |
//! | larger by any factor | the scene as it was | the bound |
//! | a way, back | the way there | unless ways within the bound disagree |
//! | beside any other rays, even broken ones | the ray alone | to the bit |
//!
//! `robustness/symmetry` has what is exact for planes and spheres: mirrors, powers of two, another order. `equivalence` has lengths of
//! batches, and both queries against testing every primitive.

#[path = "../common/mod.rs"]
mod common;
mod company;
mod ends;
mod map;
mod scenes;

use glam::{DMat3, DVec3, EulerRot, Vec3};
use map::Map;
use proptest::{prelude::*, test_runner::RngSeed};
use raypacket::{
    measure::verify::{Answers, Truth, judge},
    render::{Camera, Film, Kernel, PrimaryHits, primary_hits, render},
    scene::{Description, compile},
};
use scenes::{Item, scene, vector};

/// Small pictures: what counts is many scenes.
const SIZE: [usize; 2] = [24, 18];

/// The same cases in every run.
fn config(cases: u32, seed: u64) -> ProptestConfig {
    ProptestConfig { cases, failure_persistence: None, rng_seed: RngSeed::Fixed(seed), ..ProptestConfig::default() }
}

fn camera(description: &Description) -> Camera {
    Camera::new(&description.camera, SIZE[0] as f32 / SIZE[1] as f32)
}

/// A picture by one kernel.
struct Picture {
    hits: PrimaryHits,
    film: Film,
}

impl Picture {
    fn new(description: &Description, camera: &Camera, kernel: Kernel) -> Self {
        let compiled = compile(description).expect("a sound scene");
        let mut film = Film::new(SIZE[0], SIZE[1]);
        render(&compiled, camera, kernel, 1, &mut film, &|_| ());
        Self { hits: primary_hits(&compiled, camera, kernel, SIZE[0], SIZE[1]), film }
    }

    /// As if lengths were divided by `scale`.
    fn shrunk(mut self, scale: f64) -> Self {
        self.hits.t.iter_mut().for_each(|t| *t = (f64::from(*t) / scale) as f32);
        self
    }

    fn answers(&self) -> Answers<'_> {
        Answers { t: &self.hits.t, primitive: &self.hits.primitive, pixels: &self.film.pixels }
    }
}

fn truth(description: &Description) -> Truth {
    Truth::new(description, SIZE[0], SIZE[1])
}

/// Whether the bound explains what every kernel sees of a scene, `scale` times as large, by the answers of another.
fn expect(truth: &Truth, description: &Description, camera: &Camera, scale: f64) -> Result<(), TestCaseError> {
    let picture = |kernel| (kernel, Picture::new(description, camera, kernel).shrunk(scale));
    let pictures = Kernel::ALL.map(picture);
    let answers: Vec<_> = pictures.iter().map(|(kernel, picture)| (*kernel, picture.answers())).collect();
    let report = judge(truth, &answers);
    prop_assert!(report.pass, "{report:?}");
    Ok(())
}

/// Whether the mapped scene looks as the reference sees the scene itself.
fn expect_same(description: &Description, map: &Map) -> Result<(), TestCaseError> {
    expect(&truth(description), &map.description(description), &map.camera(&camera(description)), map.scale)
}

proptest! {
    #![proptest_config(config(160, 0xa1))]

    /// A scene beside the world's origin and far from there are judged by the same answers: those of the reference far
    /// away, where the bound is wider.
    #[test]
    fn moved(items in scenes::items(), by in vector()) {
        let by = Vec3::from_array(by.map(|x| f32::from(x) / 4.0));
        prop_assume!(by.length() > 12.0);
        let map = Map { by: by.as_dvec3(), ..Map::default() };
        let (near, camera) = (scene(&items), camera(&scene(&items)));
        let far = map.description(&near);
        expect(&truth(&far), &near, &camera, 1.0)?;
        expect(&truth(&far), &far, &map.camera(&camera), 1.0)?;
    }

    /// By right angles about the axes: coordinates change places and signs, and none is rounded.
    #[test]
    fn turned_by_right_angles(items in scenes::items(), turns in [0..4u8, 0..4u8, 0..4u8]) {
        expect_same(&scene(&items), &Map { turn: map::right_angles(turns), ..Map::default() })?;
    }

    /// At a plane of two axes, after right angles.
    #[test]
    fn mirrored(items in scenes::items(), axis in 0..3_usize, turns in [0..4u8, 0..4u8, 0..4u8]) {
        let mut mirror = DVec3::ONE;
        mirror[axis] = -1.0;
        let turn = DMat3::from_diagonal(mirror) * map::right_angles(turns);
        expect_same(&scene(&items), &Map { turn, ..Map::default() })?;
    }

    /// Which of two is hit at equal distance may differ, how far away it is may not.
    #[test]
    fn in_another_order(
        (items, others) in scenes::items().prop_flat_map(|items| (Just(items.clone()), Just(items).prop_shuffle())),
    ) {
        let camera = camera(&scene(&items));
        for kernel in Kernel::ALL {
            let distances = |items: &[Item]| {
                let hits = Picture::new(&scene(items), &camera, kernel).hits;
                hits.t.iter().map(|t| t.to_bits()).collect::<Vec<_>>()
            };
            prop_assert!(distances(&items) == distances(&others), "{kernel:?}");
        }
    }

    /// By any angles. The image's coordinates are rounded, which is one more of the roundings that the bound counts.
    #[test]
    fn turned(mut items in scenes::items(), angles in [-3.2..3.2, -1.5..1.5, -3.2..3.2_f64]) {
        items.retain(Item::turns);
        let [z, y, x] = angles;
        let turn = DMat3::from_euler(EulerRot::ZYX, z, y, x);
        expect_same(&scene(&items), &Map { turn, ..Map::default() })?;
    }

    /// By any factor, with the numbers rounded in the same way.
    #[test]
    fn scaled(items in scenes::items(), power in -9.0..9.0_f64) {
        expect_same(&scene(&items), &Map { scale: 10.0_f64.powf(power / 3.0), ..Map::default() })?;
    }
}

/// That the scenes of the properties are seen: their rays hit something, and miss something.
#[test]
fn scenes_are_seen() {
    use proptest::{strategy::ValueTree, test_runner::TestRunner};
    let mut runner = TestRunner::new(config(1, 0xa2));
    let mut hit = 0;
    for _ in 0..48 {
        let items = scenes::items().new_tree(&mut runner).expect("a scene").current();
        let description = scene(&items);
        let picture = Picture::new(&description, &camera(&description), Kernel::X8);
        hit += picture.hits.t.iter().filter(|t| t.is_finite()).count();
    }
    let share = hit as f64 / (48 * SIZE[0] * SIZE[1]) as f64;
    assert!((0.2..0.95).contains(&share), "{share} of the rays hit");
}
