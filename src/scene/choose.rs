//! The cheapest method whose error a scene's tolerance allows.
//!
//! Only for spheres is there a cheaper method that a bound can vouch for. Triangles stay watertight, as a leak is wrong
//! at any tolerance; a torus's other methods lose roots; estimates of 1/√ differ from processor to processor; and an
//! offset that is not derived is wrong in some scene of any size.

use glam::DVec3;

use super::{Description, Sides, Structure};
use crate::bvh::Aabb;
use crate::geometry::methods::SphereMethod;

/// ε, the unit roundoff.
const ROUNDOFF: f64 = 0.5 * f32::EPSILON as f64;

/// The rows of a picture that a method has to be good enough for: the window's.
const ROWS: f64 = 512.0;

/// A choice, and why.
#[derive(Clone, Debug, PartialEq)]
pub struct Chosen {
    /// The method.
    pub method: SphereMethod,
    /// Its reason, for a person.
    pub reason: String,
}

impl Chosen {
    /// The default.
    pub fn stable(reason: &str) -> Self {
        Self { method: SphereMethod::Stable, reason: reason.to_owned() }
    }
}

/// How to test the spheres of a scene.
///
/// By `quadratic`, b² − c is off by at most 21 ε D² for a ray that starts D from the centre (5 ε D² of c, 7 of b², 8 of a
/// direction too long or short by 4 ε, 1 of the difference): the answer for a sphere whose radius is off by
/// δ = 10.5 ε D² / r. That must not be seen: nowhere in the scene larger than `tolerance` pixels of a picture of 512 rows
/// there where it is nearest to the eye. D is at most the distance to the farthest thing, as rays start at the eye, at
/// lights and on surfaces.
pub(super) fn sphere(description: &Description, boxes: &[Aabb], structure: Structure) -> Chosen {
    let stable = Chosen::stable;
    match () {
        _ if description.spheres.is_empty() => return stable("there is none"),
        _ if structure == Structure::Tree => return stable("the tree tests blocks of them by it"),
        _ if description.spheres.iter().any(|s| s.sides != Sides::Both) => return stable("it knows their sides apart"),
        _ if !description.planes.is_empty() => {
            return stable("a plane has no end, and from far enough out on it `quadratic` loses any sphere");
        }
        _ => (),
    }
    let all = everything(description, boxes);
    let eye = description.camera.eye.as_dvec3();
    let least = all.iter().map(|bounds| distance(bounds, eye)).fold(f64::INFINITY, f64::min);
    let pixel = 2.0 * (f64::from(description.camera.fov).to_radians() / 2.0).tan() / ROWS * least;
    let starts = description.lights.iter().map(|l| l.position).chain([description.camera.eye]);
    let around = all.iter().copied().chain(starts.map(|p| Aabb { min: p, max: p })).reduce(Aabb::union);
    let Some(around) = around else { return stable("there is none") };
    let worst = description.spheres.iter().map(|s| {
        let far = farthest(&around, s.center.as_dvec3());
        10.5 * ROUNDOFF * far * far / f64::from(s.radius)
    });
    let worst = worst.fold(0.0, f64::max);
    let share = worst / pixel;
    let tolerance = f64::from(description.settings.tolerance);
    if share <= tolerance {
        let reason = format!("no silhouette is off by more than {share:.1e} pixels, where {tolerance:.1e} are allowed");
        return Chosen { method: SphereMethod::Quadratic, reason };
    }
    stable(&format!("`quadratic` may be off by {share:.1e} pixels, where {tolerance:.1e} are allowed"))
}

/// Boxes around all primitives.
fn everything(description: &Description, boxes: &[Aabb]) -> Vec<Aabb> {
    let spheres = description.spheres.iter().map(|s| Aabb { min: s.center - s.radius, max: s.center + s.radius });
    let meshes = description.meshes.iter().map(|m| m.positions.iter().copied().fold(Aabb::EMPTY, Aabb::extend));
    spheres.chain(meshes).chain(boxes.iter().copied()).collect()
}

/// How far a point is from a box; 0 within.
fn distance(bounds: &Aabb, from: DVec3) -> f64 {
    (bounds.min.as_dvec3() - from).max(from - bounds.max.as_dvec3()).max(DVec3::ZERO).length()
}

/// How far the farthest point of a box is.
pub(super) fn farthest(bounds: &Aabb, from: DVec3) -> f64 {
    (from - bounds.min.as_dvec3()).abs().max((bounds.max.as_dvec3() - from).abs()).length()
}

#[cfg(test)]
mod tests {
    use super::super::{Material, Sphere, compile, compile_with, load};
    use super::*;
    use crate::geometry::methods::OffsetMethod;
    use glam::Vec3;

    /// A difference that a display cannot show, of a pixel that is averaged.
    const TOLERANCE: f32 = 1.0 / 255.0;

    /// Two spheres before the eye.
    fn pair(radius: f32, away: f32) -> Description {
        let sphere =
            |x: f32| Sphere { center: Vec3::new(x * away, 0.0, -away), radius, sides: Sides::Both, material: 0 };
        let mut description = Description {
            materials: vec![Material::default()],
            spheres: vec![sphere(-0.1), sphere(0.1)],
            ..Description::default()
        };
        description.settings.tolerance = TOLERANCE;
        description.camera.eye = Vec3::ZERO;
        description.camera.look_at = Vec3::NEG_Z;
        description
    }

    fn chosen(description: &Description) -> SphereMethod {
        compile(description).expect("a sound scene").plan.methods.sphere
    }

    #[test]
    fn near_spheres_may_be_cheap_and_far_ones_not() {
        assert_eq!(chosen(&pair(1.0, 5.0)), SphereMethod::Quadratic);
        assert_eq!(chosen(&pair(1.0, 500.0)), SphereMethod::Stable);
        assert_eq!(chosen(&pair(100.0, 500.0)), SphereMethod::Quadratic, "it is the proportion that counts");
        let mut strict = pair(1.0, 5.0);
        strict.settings.tolerance = 1e-6;
        assert_eq!(chosen(&strict), SphereMethod::Stable);
        strict.settings.tolerance = 0.0;
        assert_eq!(chosen(&strict), SphereMethod::Stable);
        let mut loose = pair(1.0, 500.0);
        loose.settings.tolerance = 10.0;
        assert_eq!(chosen(&loose), SphereMethod::Quadratic);
    }

    #[test]
    fn cosmos_pays_for_the_stable_method() {
        let mut cosmos = load("cosmos").expect("built in");
        assert_eq!(chosen(&cosmos), SphereMethod::Stable);
        cosmos.settings.tolerance = TOLERANCE;
        assert_eq!(chosen(&cosmos), SphereMethod::Stable);
        // Not for a rule of its own: the planet's size is reason enough, without the other planes and sides.
        let mut planet = cosmos.clone();
        planet.planes.clear();
        assert_eq!(chosen(&planet), SphereMethod::Stable);
    }

    #[test]
    fn without_an_end_nothing_is_proven() {
        let mut classic = load("classic").expect("built in");
        classic.settings.tolerance = 1.0;
        assert_eq!(chosen(&classic), SphereMethod::Stable);
        // The spheres alone are near enough for that much, but not for less.
        classic.planes.clear();
        assert_eq!(chosen(&classic), SphereMethod::Quadratic);
        classic.settings.tolerance = TOLERANCE;
        assert_eq!(chosen(&classic), SphereMethod::Stable);
    }

    #[test]
    fn what_is_asked_for_goes_before_what_is_planned() {
        let description = pair(1.0, 5.0);
        let plan = |choice: &str| {
            let choices: &[_] = &[choice.parse().expect("a method")];
            compile_with(&description, &choices.into()).expect("a sound scene").plan
        };
        assert_eq!(plan("sphere=double").methods.sphere, SphereMethod::Double);
        assert_eq!(plan("sphere=double").why, "as asked for");
        assert_eq!(plan("offset=none").methods.offset, OffsetMethod::None);
    }
}
