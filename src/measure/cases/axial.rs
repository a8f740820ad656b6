//! Cylinders and cones along their axis, and cones along their side.

use glam::{DVec3, Vec3};

use super::draw::{along, closest, empty, off};
use super::{Made, Pcg, Ray};
use crate::scene::{Cone, Cylinder, Description, Sides};

/// From base to apex; the radius of the base is 1.
const LENGTH: f64 = 10.0;

/// Where an open body of revolution stands, and how it narrows.
struct Body {
    base: Vec3,
    apex: Vec3,
    apex_radius: f32,
    /// The world axis it is parallel to, exactly, if any.
    aligned: Option<usize>,
}

impl Body {
    fn aligned(apex_radius: f32, rng: &mut Pcg) -> Self {
        let (k, base) = (rng.below(3), rng.cube());
        let mut apex = base;
        apex[k] += LENGTH as f32 * rng.sign() as f32;
        Self { base, apex, apex_radius, aligned: Some(k) }
    }

    fn tilted(apex_radius: f32, rng: &mut Pcg) -> Self {
        let base = rng.cube();
        let apex = (base.as_dvec3() + rng.direction() * LENGTH).as_vec3();
        Self { base, apex, apex_radius, aligned: None }
    }

    fn axis(&self) -> DVec3 {
        (self.apex.as_dvec3() - self.base.as_dvec3()).normalize()
    }

    /// Within the middle eight tenths: what is `out` from the axis.
    fn side(&self, out: DVec3, rng: &mut Pcg) -> DVec3 {
        let along = rng.between(0.1, 0.9);
        let radius = 1.0 + (f64::from(self.apex_radius) - 1.0) * along;
        self.base.as_dvec3().lerp(self.apex.as_dvec3(), along) + out * radius
    }

    fn description(&self) -> Description {
        let Self { base, apex, apex_radius, .. } = *self;
        let (sides, caps, material) = (Sides::Both, false, 0);
        if apex_radius == 1.0 {
            let cylinder = Cylinder { base, apex, radius: 1.0, caps, sides, material };
            return Description { cylinders: vec![cylinder], ..empty() };
        }
        let cone = Cone { base, base_radius: 1.0, apex, apex_radius, caps, sides, material };
        Description { cones: vec![cone], ..empty() }
    }

    /// Rays at `dial` degrees to the axis, through points of the side, which they pass from within or from without,
    /// from 1 to 20 away.
    fn near_axis(&self, dial: f64, rays: usize, rng: &mut Pcg) -> Made {
        let angle = dial.to_radians();
        let axis = self.axis();
        let aim = |i: usize| {
            let out = rng.across(axis);
            let through = self.side(out, rng);
            let draw = || {
                let direction = match self.aligned {
                    // One component may not be lost in another's rounding, nor a zero's sign.
                    Some(k) => aligned(k, angle, i.is_multiple_of(2), rng),
                    None => axis * (angle.cos() * rng.sign()) + rng.across(axis) * angle.sin(),
                };
                let origin = (through - direction * rng.between(1.0, 20.0)).as_vec3();
                along(origin, direction)
            };
            closest(draw, |ray| off(angle_between(ray, axis), angle))
        };
        let rays = (0..rays).map(aim).collect();
        (self.description(), rays)
    }
}

/// At `angle` to the axis `k`; `zero` makes another component 0 or −0.
fn aligned(k: usize, angle: f64, zero: bool, rng: &mut Pcg) -> DVec3 {
    let mut direction = DVec3::ZERO;
    direction[k] = angle.cos() * rng.sign();
    let (sin, cos) = rng.between(0.0, std::f64::consts::TAU).sin_cos();
    let across = if zero { [rng.sign(), 0.0 * rng.sign()] } else { [sin, cos] };
    let turn = rng.below(2);
    direction[(k + 1) % 3] = angle.sin() * across[turn];
    direction[(k + 2) % 3] = angle.sin() * across[1 - turn];
    direction
}

/// Between the two lines, up to a right angle.
pub fn angle_between(ray: &Ray, axis: DVec3) -> f64 {
    let (_, d) = ray.line();
    d.cross(axis).length().atan2(d.dot(axis).abs())
}

/// See [`Body::near_axis`].
pub fn cylinder(dial: f64, rays: usize, rng: &mut Pcg) -> Made {
    Body::aligned(1.0, rng).near_axis(dial, rays, rng)
}

/// A cylinder along no world axis; see [`Body::near_axis`].
pub fn tilted_cylinder(dial: f64, rays: usize, rng: &mut Pcg) -> Made {
    Body::tilted(1.0, rng).near_axis(dial, rays, rng)
}

/// A cone; see [`Body::near_axis`].
pub fn cone(dial: f64, rays: usize, rng: &mut Pcg) -> Made {
    Body::aligned(0.0, rng).near_axis(dial, rays, rng)
}

/// A cone along no world axis; see [`Body::near_axis`].
pub fn tilted_cone(dial: f64, rays: usize, rng: &mut Pcg) -> Made {
    Body::tilted(0.0, rng).near_axis(dial, rays, rng)
}

/// Rays as steep to the axis as a cone's side, but for `dial` degrees, through points of the side, from 1 to 20 away.
/// As steep as the side, a quadratic equation loses its square.
pub fn along_side(dial: f64, rays: usize, rng: &mut Pcg) -> Made {
    let body = Body::tilted(0.0, rng);
    let (axis, angle) = (body.axis(), dial.to_radians());
    let (base, apex) = (body.base.as_dvec3(), body.apex.as_dvec3());
    let slope = (1.0 / apex.distance(base)).atan();
    let aim = |_| {
        let draw = || {
            let out = rng.across(axis);
            let through = body.side(out, rng);
            let line = (apex - base - out).normalize();
            let normal = (out - line * out.dot(line)).normalize();
            let turned = line * angle.cos() + normal * (rng.sign() * angle.sin());
            let direction = turned * rng.sign();
            let origin = (through - direction * rng.between(1.0, 20.0)).as_vec3();
            along(origin, direction)
        };
        closest(draw, |ray| off((angle_between(ray, axis) - slope).abs(), angle))
    };
    let rays = (0..rays).map(aim).collect();
    (body.description(), rays)
}
