//! Planes, triangles and parallelograms: t is a ratio, and every decision the sign of a polynomial.

use super::exact::{Exact, along, cross, dot, minus, times};
use super::root::Root;
use super::{Crossing, Line, Triangle, exact3};
use crate::scene::{Plane, Quad, Sides};

/// p·n + D = 0. A ray that runs in parallel hits nothing, not even from within.
pub fn plane(plane: &Plane, line: &Line) -> Option<Crossing> {
    let normal = exact3(plane.normal)?;
    let height = dot(&normal, &line.origin) + Exact::from_f32(plane.distance)?;
    let t = Root::ratio(-&height, dot(&normal, &line.direction))?;
    line.span.contains(&t).then(|| Crossing { t: t.value(), normal })
}

/// Inside where the signs of the volumes that the ray spans with the edges do not differ: edges and corners belong to
/// the triangle. Seen edge-on or without area, it is never hit.
pub fn triangle(triangle: &Triangle, line: &Line) -> Option<Crossing> {
    let [a, b, c] = triangle.corners.map(exact3);
    let corners = [a?, b?, c?];
    let normal = cross(&minus(&corners[1], &corners[0]), &minus(&corners[2], &corners[0]));
    let slope = dot(&normal, &line.direction);
    let there = match triangle.sides {
        Sides::Both => true,
        Sides::Front => slope.sign().is_lt(),
        Sides::Back => slope.sign().is_gt(),
    };
    let [a, b, c] = corners.map(|corner| minus(&corner, &line.origin));
    let volumes = [(&a, &b), (&b, &c), (&c, &a)].map(|(p, q)| dot(&cross(p, q), &line.direction).sign());
    let inside = volumes.iter().all(|v| v.is_ge()) || volumes.iter().all(|v| v.is_le());
    if !inside || !there {
        return None;
    }
    let t = Root::ratio(dot(&normal, &a), slope)?;
    line.span.contains(&t).then(|| Crossing { t: t.value(), normal })
}

/// corner + a u + b v, a and b from 0 to 1, both included.
pub fn quad(quad: &Quad, line: &Line) -> Option<Crossing> {
    let (corner, u, v) = (exact3(quad.corner)?, exact3(quad.u)?, exact3(quad.v)?);
    let normal = cross(&u, &v);
    let from_corner = minus(&line.origin, &corner);
    let (height, slope) = (-dot(&normal, &from_corner), dot(&normal, &line.direction));
    // The point from the corner, times the slope.
    let point = along(&times(&slope, &from_corner), &height, &line.direction);
    // a = (point × v)·n / n², b = (u × point)·n / n²
    let whole = &slope * dot(&normal, &normal);
    let share = |part: Exact| {
        let (part, whole) = if slope.sign().is_lt() { (-&part, -&whole) } else { (part, whole.clone()) };
        part.sign().is_ge() && part <= whole
    };
    let inside = share(dot(&cross(&point, &v), &normal)) && share(dot(&cross(&u, &point), &normal));
    let t = Root::ratio(height, slope)?;
    (inside && line.span.contains(&t)).then(|| Crossing { t: t.value(), normal })
}
