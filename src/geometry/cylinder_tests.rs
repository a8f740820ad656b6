use super::super::axial_tests::{self, Body, Rng, answers};
use super::*;
use glam::{Vec3 as V, vec3};

fn compiled(body: Body) -> Cylinders {
    crate::scene::compile(&body.description()).expect("sound").cylinders
}

/// Of radius 1 about y, from 0 to 2.
const UPRIGHT: Body = Body { ends: [V::ZERO, V::new(0.0, 2.0, 0.0)], radii: [1.0; 2], caps: true, sides: Sides::Both };

fn hit(body: Body, origin: V, direction: V) -> Option<f32> {
    answers(&compiled(body), &[(origin, direction)])[0]
}

/// Upright, slanted, thin, flat, tiny, huge, and far from the world's origin.
fn bodies() -> Vec<Body> {
    [
        ([V::ZERO, vec3(0.0, 2.0, 0.0)], 1.0),
        ([vec3(0.3, -0.2, 0.5), vec3(1.1, 0.9, -0.4)], 0.7),
        ([vec3(-2.0, 0.1, 0.4), vec3(3.0, 2.0, -1.0)], 0.01),
        ([vec3(0.2, 0.1, 0.4), vec3(0.204, 0.107, 0.401)], 1.3),
        ([vec3(1e-12, 2e-12, 0.0), vec3(3e-12, -1e-12, 2e-12)], 1.5e-12),
        ([vec3(-4e11, 2e11, 1e11), vec3(3e11, -1e11, 2e11)], 2e11),
        ([vec3(600.0, -700.0, 400.0), vec3(601.0, -700.5, 400.25)], 0.5),
    ]
    .map(|(ends, radius)| Body::new(ends, [radius; 2]))
    .to_vec()
}

#[test]
fn kernel_and_reference_agree() {
    axial_tests::all_agree(bodies(), compiled);
}

#[test]
fn no_ray_slips_between_side_and_end() {
    let rng = Rng::new(2);
    for body in bodies() {
        axial_tests::no_crack(&compiled(body), body, 1e3, 1000, &rng);
    }
}

#[test]
fn rays_leave_the_surface() {
    axial_tests::no_acne_at_any_scale(&[[0.6; 2], [0.1; 2]], compiled);
}

#[test]
fn surfaces_are_the_references() {
    for body in bodies() {
        let kind = compiled(body);
        axial_tests::surfaces(body, &kind, kind.bounds(0), &Rng::new(4));
    }
}

#[test]
fn from_outside_inside_on_and_behind() {
    let open = Body { caps: false, ..UPRIGHT };
    for body in [UPRIGHT, open] {
        assert_eq!(hit(body, vec3(3.0, 1.0, 0.0), V::NEG_X), Some(2.0));
        assert_eq!(hit(body, vec3(3.0, 1.0, 0.0), V::X), None, "behind");
        assert_eq!(hit(body, vec3(0.5, 1.0, 0.0), V::X), Some(0.5), "inside");
        assert_eq!(hit(body, vec3(0.0, 1.0, 0.0), V::Z), Some(1.0), "from the axis");
        assert_eq!(hit(body, vec3(1.0, 1.0, 0.0), V::X), None, "leaving");
        assert_eq!(hit(body, vec3(1.0, 1.0, 0.0), V::NEG_X), Some(2.0), "entering");
        assert_eq!(hit(body, vec3(1.0, 1.0, 0.0), V::Z), None, "tangent from the side");
        assert_eq!(hit(body, vec3(1.0, 1.0, -3.0), V::Z), Some(3.0), "tangent");
        assert_eq!(hit(body, vec3(3.0, 2.5, 0.0), V::NEG_X), None, "above");
    }
    assert_eq!(hit(open, vec3(1.0, 3.0, 0.0), vec3(-0.8, -0.6, 0.0)), Some(2.5), "through the open end: the far side");
}

#[test]
fn parallel_rays_meet_ends_alone() {
    let open = Body { caps: false, ..UPRIGHT };
    for zero in [0.0, -0.0, 1e-20, -1e-12] {
        let down = vec3(zero, -1.0, -zero);
        assert_eq!(hit(UPRIGHT, vec3(0.3, 5.0, 0.2), down), Some(3.0));
        assert_eq!(hit(UPRIGHT, vec3(0.3, 1.5, 0.2), down), Some(1.5), "inside");
        assert_eq!(hit(UPRIGHT, vec3(0.3, 0.0, 0.2), down), None, "leaving an end");
        assert_eq!(hit(UPRIGHT, vec3(0.3, 2.0, 0.2), down), Some(2.0), "entering at an end");
        assert_eq!(hit(UPRIGHT, vec3(1.5, 5.0, 0.2), down), None);
        assert_eq!(hit(open, vec3(0.3, 5.0, 0.2), down), None);
        assert_eq!(hit(open, vec3(0.3, 1.5, 0.2), down), None);
    }
    for zero in [0.0, -0.0] {
        assert_eq!(hit(UPRIGHT, vec3(1.0, 5.0, 0.0), vec3(zero, -1.0, zero)), None, "along the side");
        assert_eq!(hit(UPRIGHT, vec3(5.0, 1.0, 0.0), vec3(-1.0, zero, zero)), Some(4.0), "across");
        assert_eq!(hit(UPRIGHT, vec3(5.0, 2.5, 0.0), vec3(-1.0, zero, zero)), None, "across, above");
        assert_eq!(hit(UPRIGHT, vec3(5.0, -0.5, 0.0), vec3(-1.0, zero, zero)), None, "across, below");
    }
}

#[test]
fn sides_that_are_not_there_are_passed_through() {
    let (origin, direction) = (vec3(3.0, 1.0, 0.0), V::NEG_X);
    for (caps, sides, expected) in [
        (true, Sides::Front, Some(2.0)),
        (true, Sides::Back, Some(4.0)),
        (false, Sides::Front, Some(2.0)),
        (false, Sides::Back, Some(4.0)),
    ] {
        assert_eq!(hit(Body { caps, sides, ..UPRIGHT }, origin, direction), expected, "{caps} {sides:?}");
    }
    let inside = |sides| hit(Body { sides, ..UPRIGHT }, V::Y, V::X);
    assert_eq!((inside(Sides::Front), inside(Sides::Back)), (None, Some(1.0)));
}

#[test]
fn rays_with_nan_hit_nothing() {
    axial_tests::nan_misses(&compiled(UPRIGHT));
    axial_tests::nan_misses(&compiled(Body { caps: false, ..UPRIGHT }));
}

#[test]
fn coordinates_of_side_and_ends() {
    let kind = compiled(UPRIGHT);
    let at = |p: V| {
        let surface = kind.surface::<f32>(0, p.into());
        let c = kind.checker(0, &surface);
        (kind.uv(0, &surface), [c.x, c.y, c.z])
    };
    // About y, T = x and B = z.
    let (uv, c) = at(vec3(0.0, 0.5, 1.0));
    assert_eq!((uv[1], c), (0.25, [0.0, 1.0, 0.5]));
    assert_eq!(at(vec3(0.5, 2.0, -0.25)), ([0.75, 0.375], [0.5, -0.25, 0.0]));
    assert_eq!(at(vec3(0.5, 0.0, -0.25)), ([0.75, 0.375], [0.5, -0.25, 0.0]));
}
