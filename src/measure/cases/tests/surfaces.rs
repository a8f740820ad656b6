//! Distances from surfaces, by formulas that do without those of the makers.

use glam::{DQuat, DVec3, Vec3};

use super::*;

/// |f| where f is the distance from the solid as the greatest of those from its sides; exact next to one of them.
fn distance(description: &Description, p: DVec3) -> f64 {
    let d = description;
    let revolved = |ends: [Vec3; 2], radii: [f32; 2]| {
        let [base, apex] = ends.map(|v| v.as_dvec3());
        let [r0, r1] = radii.map(f64::from);
        let (axis, length) = ((apex - base).normalize(), base.distance(apex));
        let z = (p - base).dot(axis);
        let rho = (p - base).cross(axis).length();
        let side = (rho - r0 - (r1 - r0) * z / length) / (1.0 + ((r1 - r0) / length).powi(2)).sqrt();
        side.max(-z).max(z - length)
    };
    let f = if let [s] = &d.planes[..] {
        (p.dot(s.normal.as_dvec3()) + f64::from(s.distance)) / s.normal.as_dvec3().length()
    } else if let [s] = &d.spheres[..] {
        p.distance(s.center.as_dvec3()) - f64::from(s.radius)
    } else if let [s] = &d.meshes[..] {
        let [a, b, c] = [0, 1, 2].map(|i| s.positions[i].as_dvec3());
        flat(p, a, b - a, c - a, true)
    } else if let [s] = &d.quads[..] {
        flat(p, s.corner.as_dvec3(), s.u.as_dvec3(), s.v.as_dvec3(), false)
    } else if let [s] = &d.cuboids[..] {
        let [x, y, z] = s.rotation.as_dvec3().to_array().map(f64::to_radians);
        let turn = DQuat::from_rotation_z(z) * DQuat::from_rotation_y(y) * DQuat::from_rotation_x(x);
        let [min, max] = [s.min, s.max].map(|v| v.as_dvec3());
        let q = turn.inverse() * (p - (min + max) * 0.5);
        (q.abs() - (max - min) * 0.5).max_element()
    } else if let [s] = &d.cylinders[..] {
        revolved([s.base, s.apex], [s.radius; 2])
    } else if let [s] = &d.cones[..] {
        revolved([s.base, s.apex], [s.base_radius, s.apex_radius])
    } else if let [s] = &d.discs[..] {
        let (q, n) = (p - s.center.as_dvec3(), s.normal.as_dvec3().normalize());
        let (z, rho) = (q.dot(n), q.cross(n).length());
        // From its plane; infinite beside it.
        if (f64::from(s.inner_radius)..=f64::from(s.radius)).contains(&rho) { z } else { f64::INFINITY }
    } else {
        torus(&d.tori[0], p)
    };
    f.abs()
}

/// Signed, below zero in the tube.
pub fn torus(torus: &crate::scene::Torus, p: DVec3) -> f64 {
    let q = p - torus.center.as_dvec3();
    let z = q.dot(torus.axis.as_dvec3().normalize());
    let rho = (q.length_squared() - z * z).sqrt();
    (rho - f64::from(torus.major_radius)).hypot(z) - f64::from(torus.minor_radius)
}

/// From the plane of two edges; infinite beside what they span.
fn flat(p: DVec3, corner: DVec3, u: DVec3, v: DVec3, triangle: bool) -> f64 {
    let n = u.cross(v);
    let q = p - corner;
    let (a, b) = (q.cross(v).dot(n) / n.length_squared(), u.cross(q).dot(n) / n.length_squared());
    let inside = a > 0.0 && b > 0.0 && if triangle { a + b < 1.0 } else { a < 1.0 && b < 1.0 };
    if inside { q.dot(n) / n.length() } else { f64::INFINITY }
}

#[test]
fn rays_that_leave_start_on_the_surface() {
    let leaving: Vec<_> = ALL.iter().filter(|g| g.name.ends_with("-leaving")).collect();
    assert_eq!(leaving.len(), 9);
    for generator in leaving {
        let mut apart = 0;
        for (dial, case) in cases(generator.name) {
            assert_eq!(case.description.primitives(), 1);
            for ray in &case.rays {
                let (o, d) = ray.line();
                let off = distance(&case.description, o);
                // The rounding of the point; that of the computation here is a thousandth of it.
                let bound = 3.0_f64.sqrt() * ROUNDOFF * 1.001 * o.abs().max_element();
                assert!(off <= bound, "{} at {dial:e}: {ray:?} starts {off:e} off", generator.name);
                // It does leave: a hundredth of its size on it is somewhere else.
                apart += usize::from(distance(&case.description, o + d * (0.01 * dial)) > 1e-5 * dial);
            }
        }
        assert!(apart > 6 * RAYS, "{}: {apart}", generator.name);
    }
}

/// In the void and in the material, as far as it says from the nearest face between the two.
#[test]
fn fractals_surface_is_near() {
    for (dial, case) in cases("fractal-surface") {
        let fractal = &case.description.fractals[0];
        let width = fractal::width(fractal.radius);
        let mut solid = 0;
        for ray in &case.rays {
            let (o, _) = ray.line();
            let place = (o - fractal.center.as_dvec3() + f64::from(fractal.radius)) / width;
            let cell = place.floor().as_ivec3();
            let here = is_solid(place);
            assert_eq!(here, fractal::solid(cell));
            solid += usize::from(here);
            let sides = [DVec3::X, DVec3::Y, DVec3::Z].into_iter().flat_map(|a| [a, -a]);
            let nearest = sides
                .filter(|&a| is_solid(place + a) != here)
                .map(|a| {
                    let part = (place - place.floor()).dot(a.abs());
                    if a.max_element() > 0.0 { 1.0 - part } else { part }
                })
                .fold(f64::INFINITY, f64::min);
            assert!(draw::off(nearest, dial) < 0.26, "at {dial:e}: {nearest:e} from {ray:?}");
        }
        assert_eq!(solid, RAYS / 2);
    }
}

/// By cutting the cube into thirds; `place` is in cells from its corner.
fn is_solid(place: DVec3) -> bool {
    let mut q = place / f64::from(fractal::CELLS);
    if q.min_element() < 0.0 || q.max_element() >= 1.0 {
        return false;
    }
    for _ in 0..4 {
        q *= 3.0;
        let third = q.floor();
        if third.to_array().iter().filter(|&&t| t == 1.0).count() >= 2 {
            return false;
        }
        q -= third;
    }
    true
}
