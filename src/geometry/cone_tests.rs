use super::super::axial_tests::{self, Body, Rng, answers};
use super::*;
use glam::{Vec3 as V, vec3};

fn compiled(body: Body) -> Cones {
    crate::scene::compile(&body.description()).expect("sound").cones
}

/// A tip at (0, 1, 0) over a disc of radius 1 in y = 0.
const UPRIGHT: Body = Body { ends: [V::ZERO, V::Y], radii: [1.0, 0.0], caps: true, sides: Sides::Both };

fn hit(body: Body, origin: V, direction: V) -> Option<f32> {
    answers(&compiled(body), &[(origin, direction)])[0]
}

/// Cones and frusta, upright, upside down, slanted, thin, flat, nearly cylinders, tiny, huge, and far from the origin.
fn bodies() -> Vec<Body> {
    [
        ([V::ZERO, V::Y], [1.0, 0.0]),
        ([V::ZERO, V::Y], [0.0, 1.0]),
        ([vec3(0.0, -1.0, 0.0), V::Y], [1.0, 0.5]),
        ([vec3(0.3, -0.2, 0.5), vec3(1.1, 0.9, -0.4)], [0.2, 0.7]),
        ([vec3(0.3, -0.2, 0.5), vec3(1.1, 0.9, -0.4)], [0.8, 0.0]),
        ([vec3(0.3, -0.2, 0.5), vec3(1.1, 0.9, -0.4)], [0.8, 0.799_999]),
        ([vec3(-2.0, 0.1, 0.4), vec3(3.0, 2.0, -1.0)], [0.01, 0.0]),
        ([vec3(0.2, 0.1, 0.4), vec3(0.204, 0.107, 0.401)], [1.3, 0.0]),
        ([vec3(0.2, 0.1, 0.4), vec3(0.204, 0.107, 0.401)], [0.4, 1.3]),
        ([vec3(0.25, 0.125, 0.5), vec3(0.25, 0.125, 0.500_001)], [1.3, 0.0]),
        ([vec3(1e-12, 2e-12, 0.0), vec3(3e-12, -1e-12, 2e-12)], [1.5e-12, 0.0]),
        ([vec3(-4e11, 2e11, 1e11), vec3(3e11, -1e11, 2e11)], [0.0, 2e11]),
        ([vec3(600.0, -700.0, 400.0), vec3(601.0, -700.5, 400.25)], [0.5, 0.1]),
    ]
    .map(|(ends, radii)| Body::new(ends, radii))
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
    axial_tests::no_acne_at_any_scale(&[[0.6, 0.2], [0.0, 0.5], [0.5, 0.0]], compiled);
}

#[test]
fn surfaces_are_the_references() {
    for body in bodies() {
        let kind = compiled(body);
        axial_tests::surfaces(body, &kind, kind.bounds(0), &Rng::new(4));
    }
}

/// That a distance is found, and right within the bound for rays this close: 8 ε of it.
#[track_caller]
fn is(found: Option<f32>, t: f32, what: &str) {
    let close = |found: f32| (found - t).abs() <= 4.0 * f32::EPSILON * t;
    assert!(found.is_some_and(close), "{what}: {found:?} for {t}");
}

#[test]
fn from_outside_inside_on_and_behind() {
    let open = Body { caps: false, ..UPRIGHT };
    for body in [UPRIGHT, open] {
        is(hit(body, vec3(3.0, 0.5, 0.0), V::NEG_X), 2.5, "its outside");
        assert_eq!(hit(body, vec3(3.0, 0.5, 0.0), V::X), None, "behind");
        is(hit(body, vec3(0.0, 0.5, 0.0), V::Z), 0.5, "from the axis");
        assert_eq!(hit(body, vec3(0.5, 0.5, 0.0), V::X), None, "leaving");
        is(hit(body, vec3(0.5, 0.5, 0.0), V::NEG_X), 1.0, "entering");
        assert_eq!(hit(body, vec3(3.0, 1.5, 0.0), V::NEG_X), None, "the mirror image beyond the tip is not there");
        is(hit(body, vec3(0.25, 5.0, 0.0), V::NEG_Y), 4.25, "along the axis");
    }
    is(hit(open, vec3(0.25, -1.0, 0.0), V::Y), 1.75, "through the open end");
    is(hit(UPRIGHT, vec3(0.25, -1.0, 0.0), V::Y), 1.0, "the closed end");
}

#[test]
fn through_the_tip_and_from_it() {
    for tip in [V::Y, V::ZERO] {
        let down = if tip == V::Y { V::NEG_Y } else { V::Y };
        let ends = [tip + down, tip];
        for body in [Body { ends, ..UPRIGHT }, Body { ends, caps: false, ..UPRIGHT }] {
            assert_eq!(hit(body, tip - down * 2.0, down), Some(2.0), "at the tip along the axis");
            assert_eq!(hit(body, tip + V::X * 2.0, V::NEG_X), Some(2.0), "at the tip across");
            assert_eq!(hit(body, tip, down), body.caps.then_some(1.0), "from the tip");
            for away in [-down, V::X, V::Z, vec3(0.6, 0.0, -0.8), (V::X - down).normalize()] {
                assert_eq!(hit(body, tip, away), None, "from the tip away: {away}");
            }
        }
    }
}

#[test]
fn along_the_slant() {
    // Down a line parallel to the side at −x: in through the side at +x, never near the other.
    let slant = vec3(-1.0, -1.0, 0.0).normalize();
    let t = hit(UPRIGHT, vec3(1.5, 1.0, 0.0), slant).unwrap();
    assert!((f64::from(t) - 0.75 * 2f64.sqrt()).abs() < 1e-6, "{t}");
    // From 1e4 away, at a point 1e-2 from the tip.
    let (o, to) = (glam::dvec3(7e3, 7e3, 0.0), glam::dvec3(1e-2, 0.99, 0.0));
    let t = f64::from(hit(UPRIGHT, o.as_vec3(), (to - o).normalize().as_vec3()).unwrap());
    assert!((t - (to - o).length()).abs() < 1e4 * 16.0 * 6e-8, "{t}");
}

#[test]
fn sides_that_are_not_there_are_passed_through() {
    let (origin, direction) = (vec3(3.0, 0.5, 0.0), V::NEG_X);
    for caps in [true, false] {
        is(hit(Body { caps, sides: Sides::Front, ..UPRIGHT }, origin, direction), 2.5, "its outside");
        is(hit(Body { caps, sides: Sides::Back, ..UPRIGHT }, origin, direction), 3.5, "its inside");
    }
    let through = |sides| hit(Body { caps: false, sides, ..UPRIGHT }, vec3(0.25, -1.0, 0.0), V::Y);
    assert_eq!(through(Sides::Front), None);
    is(through(Sides::Back), 1.75, "its inside");
}

#[test]
fn rays_with_nan_hit_nothing() {
    for body in bodies() {
        axial_tests::nan_misses(&compiled(body));
        axial_tests::nan_misses(&compiled(Body { caps: false, ..body }));
    }
}

#[test]
fn coordinates_of_side_and_ends() {
    for (ends, radii) in [([V::ZERO, V::Y], [1.0, 0.5]), ([V::ZERO, V::Y], [0.5, 1.0])] {
        let kind = compiled(Body { ends, radii, ..UPRIGHT });
        let at = |p: V| {
            let surface = kind.surface::<f32>(0, p.into());
            let c = kind.checker(0, &surface);
            (kind.uv(0, &surface), [c.x, c.y, c.z])
        };
        // About y, T = x and B = z.
        let (uv, [x, y, z]) = at(vec3(0.0, 0.5, 0.75));
        let near = |a: f32, b: f32| (a - b).abs() < 1e-6;
        assert!(near(uv[1], 0.5) && near(x, 0.0) && near(y, 0.75) && near(z, 0.5), "{uv:?} {x} {y} {z}");
        for (height, radius) in [0.0, 1.0].into_iter().zip(radii) {
            let (uv, c) = at(vec3(0.25, height, -0.125));
            assert_eq!((uv, c), ([0.5 + 0.125 / radius, 0.5 - 0.0625 / radius], [0.25, -0.125, 0.0]));
        }
    }
}
