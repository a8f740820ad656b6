//! Records of primitives, and how packets see them: with the terms of their origin done, or as stored.

use crate::geometry::plane::SeenPlane;
use crate::geometry::sphere::SeenSphere;
use crate::geometry::triangle::SeenTriangle;
use crate::math::{Lanes, Vec3};

/// A record that gives a primitive's terms as seen from the origins of a packet.
pub trait Seen<L: Lanes> {
    /// The terms.
    type As;
    /// As seen from `origin`.
    fn from(&self, origin: Vec3<L>) -> Self::As;
}

/// A sphere as stored: for rays that do not share their origin.
#[derive(Clone, Copy, Debug)]
pub struct SphereRecord {
    /// Its centre.
    pub center: Vec3<f32>,
    /// Its radius.
    pub radius: f32,
}

/// A triangle as stored.
#[derive(Clone, Copy, Debug)]
pub struct TriangleRecord {
    /// First corner.
    pub v0: Vec3<f32>,
    /// Second corner − first.
    pub e1: Vec3<f32>,
    /// Third corner − first.
    pub e2: Vec3<f32>,
}

/// A plane as stored.
#[derive(Clone, Copy, Debug)]
pub struct PlaneRecord {
    /// Its normal, of any length.
    pub normal: Vec3<f32>,
    /// Its offset.
    pub distance: f32,
}

impl<L: Lanes> Seen<L> for SeenPlane<f32> {
    type As = SeenPlane<L>;
    #[inline(always)]
    fn from(&self, _origin: Vec3<L>) -> SeenPlane<L> {
        self.splat()
    }
}

impl<L: Lanes> Seen<L> for SeenSphere<f32> {
    type As = SeenSphere<L>;
    #[inline(always)]
    fn from(&self, _origin: Vec3<L>) -> SeenSphere<L> {
        self.splat()
    }
}

impl<L: Lanes> Seen<L> for SeenTriangle<f32> {
    type As = SeenTriangle<L>;
    #[inline(always)]
    fn from(&self, _origin: Vec3<L>) -> SeenTriangle<L> {
        self.splat()
    }
}

impl<L: Lanes> Seen<L> for PlaneRecord {
    type As = SeenPlane<L>;
    #[inline(always)]
    fn from(&self, origin: Vec3<L>) -> SeenPlane<L> {
        SeenPlane::new(Vec3::splat(self.normal.into()), L::splat(self.distance), origin)
    }
}

impl<L: Lanes> Seen<L> for SphereRecord {
    type As = SeenSphere<L>;
    #[inline(always)]
    fn from(&self, origin: Vec3<L>) -> SeenSphere<L> {
        SeenSphere::new(Vec3::splat(self.center.into()), L::splat(self.radius), origin)
    }
}

impl<L: Lanes> Seen<L> for TriangleRecord {
    type As = SeenTriangle<L>;
    #[inline(always)]
    fn from(&self, origin: Vec3<L>) -> SeenTriangle<L> {
        let [v0, e1, e2] = [self.v0, self.e1, self.e2].map(|v| Vec3::splat(v.into()));
        SeenTriangle::new(v0, e1, e2, origin)
    }
}
