//! Triangles: t is a ratio, and every decision the sign of a polynomial.

use super::body::{Body, Crossing, Described, Line, ball_around, exact3, height};
use super::exact::{cross, dot, minus};
use super::root::Root;
use crate::scene::{Mesh, Sides};
use glam::{DVec3, Vec3};

/// A triangle by itself.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Triangle {
    /// Counter-clockwise as seen from the front.
    pub corners: [Vec3; 3],
    /// Which side is there.
    pub sides: Sides,
}

impl Described for Mesh {
    type Body = Triangle;

    /// A triangle that names a vertex that does not exist is none, as it has no area.
    fn bodies(&self) -> impl Iterator<Item = Triangle> {
        let corner = |v: u32| self.positions.get(v as usize).copied().unwrap_or(Vec3::NAN);
        self.triangles.iter().map(move |t| Triangle { corners: t.map(corner), sides: self.sides })
    }
}

impl Body for Triangle {
    /// Inside where the signs of the volumes that the ray spans with the edges do not differ: edges and corners belong to
    /// the triangle. Seen edge-on or without area, it is never hit.
    fn first(&self, line: &Line) -> Option<Crossing> {
        let [a, b, c] = self.corners.map(exact3);
        let corners = [a?, b?, c?];
        let normal = cross(&minus(&corners[1], &corners[0]), &minus(&corners[2], &corners[0]));
        let slope = dot(&normal, &line.direction);
        let there = match self.sides {
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

    fn tips(&self, _width: f64) -> Vec<DVec3> {
        self.corners.map(|c| c.as_dvec3()).to_vec()
    }

    fn ball(&self) -> Option<(DVec3, f64)> {
        Some(ball_around(&self.tips(0.0), 0.0))
    }

    fn thickness(&self) -> f64 {
        let [a, b, c] = self.corners.map(|c| c.as_dvec3());
        height(b - a, c - a)
    }
}
