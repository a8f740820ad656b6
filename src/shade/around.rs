//! Which transparent media a point is in.

use glam::Vec3;

use super::medium::{Deeper, MediumStack};
use super::surface::surface;
use crate::geometry::Primitives;
use crate::math::Vec3 as Lane3;
use crate::scene::{Scene, with_primitive};

/// Where the rays go that are asked: along no axis, diagonal or symmetry that scenes are likely to have.
const DIRECTIONS: [[f32; 3]; 7] = [
    [0.267_261_24, 0.801_783_7, 0.534_522_5],
    [-0.536_821_4, 0.290_613_7, -0.792_069_5],
    [0.734_102_9, -0.641_873_1, 0.221_570_3],
    [-0.143_720_7, -0.931_652_2, 0.333_717_4],
    [0.861_309_6, 0.116_047_3, -0.494_650_8],
    [-0.812_264_1, 0.557_391_2, 0.171_943_6],
    [0.318_466_5, -0.240_157_8, -0.917_010_1],
];

/// The most crossings with one primitive that are counted.
const MOST: usize = 64;

/// The media around a point: those that a ray from there leaves without having entered them.
///
/// An edge or a corner that a ray runs through counts twice or not at all, so that two rays must agree. Each primitive is
/// asked by itself, so that surfaces that coincide hide none of each other. Media whose bounds the point is outside of are
/// passed over: for most eyes that is all.
pub fn around(scene: &Scene, point: Vec3, deeper: &mut Deeper) -> MediumStack {
    let near: Vec<bool> = scene
        .media
        .iter()
        .map(|medium| medium.bounds.min.cmple(point).all() && medium.bounds.max.cmpge(point).all())
        .collect();
    if !near.contains(&true) {
        return MediumStack::default();
    }
    let mut answers: Vec<(Vec<u16>, Vec<u16>)> = Vec::new();
    for direction in DIRECTIONS {
        let left = left(scene, &near, point, direction.into());
        let mut sorted = left.clone();
        sorted.sort_unstable();
        let same = answers.iter().position(|(_, other)| *other == sorted);
        answers.push((left, sorted));
        if let Some(same) = same {
            answers.swap(0, same);
            break;
        }
    }
    // The innermost is left first.
    answers[0].0.iter().rev().fold(MediumStack::default(), |stack, &medium| stack.enter(medium, deeper))
}

/// Of the media that are `near`, those that a ray leaves without having entered them, in that order.
fn left(scene: &Scene, near: &[bool], point: Vec3, direction: Vec3) -> Vec<u16> {
    let mut crossings = Vec::new();
    let (origin, along) = (Lane3::<f32>::from(point), Lane3::<f32>::from(direction));
    for id in scene.ids() {
        let medium = scene.medium(id);
        if !near[usize::from(medium)] {
            continue;
        }
        let mut t = 0.0;
        for _ in 0..MOST {
            let hit = with_primitive!(scene, id, |kind, i| kind.test::<f32>(i, origin, along, t, f32::INFINITY));
            let Some((next, true)) = hit else { break };
            t = next;
            let (surface, _) = surface::<f32>(scene, id, along.mul_add(t, origin));
            crossings.push((t, medium, Vec3::from(surface.normal).dot(direction) > 0.0));
        }
    }
    crossings.sort_by(|a, b| a.0.total_cmp(&b.0));
    let (mut entered, mut left) = (Vec::new(), Vec::new());
    for (_, medium, leaves) in crossings {
        match (leaves, entered.iter().rposition(|&m| m == medium)) {
            (false, _) => entered.push(medium),
            (true, Some(at)) => drop(entered.remove(at)),
            (true, None) => left.push(medium),
        }
    }
    left
}
