//! Tori at double roots.

use glam::DVec3;

use super::draw::{along, closest, empty, off, side};
use super::{Made, Pcg};
use crate::scene::{Description, Torus};

/// The radius of the tube; the greater one is 1.
const MINOR: f32 = 0.375;

/// A circle of the torus about its axis.
#[derive(Clone, Copy)]
enum Circle {
    Outer,
    Inner,
    Top,
}

/// Along tangents of the outer equator, from 3 to 8 away.
pub fn outer(dial: f64, rays: usize, rng: &mut Pcg) -> Made {
    tangents(Circle::Outer, dial, rays, rng)
}

/// Of the inner equator, from 0.1 to 0.6 away: within the hole or, along the circle, in the tube.
pub fn inner(dial: f64, rays: usize, rng: &mut Pcg) -> Made {
    tangents(Circle::Inner, dial, rays, rng)
}

/// Of the circle where the torus touches a plane across its axis, from 3 to 8 away.
pub fn top(dial: f64, rays: usize, rng: &mut Pcg) -> Made {
    tangents(Circle::Top, dial, rays, rng)
}

/// Rays along tangents at points of the circle that pass these by `dial` minor radii along the normal, on the torus's
/// side and on the other in turn.
fn tangents(circle: Circle, dial: f64, rays: usize, rng: &mut Pcg) -> Made {
    let torus = Torus { center: rng.cube(), axis: rng.unit(), major_radius: 1.0, minor_radius: MINOR, material: 0 };
    let (c, axis, minor) = (torus.center.as_dvec3(), torus.axis.as_dvec3().normalize(), f64::from(MINOR));
    let aim = |i| {
        let out = rng.across(axis);
        let (normal, away) = match circle {
            Circle::Outer => (out, [3.0, 8.0]),
            Circle::Inner => (-out, [0.1, 0.6]),
            Circle::Top => (axis * rng.sign(), [3.0, 8.0]),
        };
        let point = c + out + normal * minor;
        let passing = point - normal * (side(i) * dial * minor);
        let draw = || {
            let across = rng.across(normal);
            // Of the two points where a line touches the top, the first.
            let direction = if across.dot(out) > 0.0 { -across } else { across };
            let origin = (passing - direction * rng.between(away[0], away[1])).as_vec3();
            along(origin, direction)
        };
        closest(draw, |ray| {
            let (o, d) = ray.line();
            let nearest: DVec3 = o + d * (point - o).dot(d);
            off((point - nearest).dot(normal) * side(i) / minor, dial)
        })
    };
    let rays = (0..rays).map(aim).collect();
    (Description { tori: vec![torus], ..empty() }, rays)
}
