//! The bounds that `src/geometry` documents, as numbers. ε = 2⁻²⁴.

use glam::DVec3;
use raypacket::measure::cases::Ray;
use raypacket::measure::oracle::{Shape, Truth};

use crate::common::ROUNDOFF;

/// How far across itself a ray may be moved to explain a decision, hit or miss: k ε (D + |o|), with D from its origin to the
/// farthest point of a [`ball`] around the primitive and |o| its origin's largest coordinate. k is the least that covers
/// the documented bound for primitives of any proportions:
///
/// - plane, 4 ε (|n·o| + |distance|) / |n|: |n·o| is at most √3 |o|, |distance| at most D more;
/// - sphere, 5 ε |f|; torus, 12 ε (R + r) + 4 ε |f|, where D = |f| + R + r; fractal, 4 ε |f| + 5 ε radius;
/// - triangle: hits are within a box that is larger by 32 ε along each axis;
/// - quad, 8 ε (|o − corner| + longest edge) / sin: an edge is at most 2 D;
/// - box, 3 ε t; turned, 5 ε |o − centre| + 7 ε t + 2 ε |furthest corner|: the last is at most √3 |o| + D;
/// - cylinder, 8 ε (|o − base| + length + radius) + 6 ε t: length + radius is at most √5 times the ball's radius; cone,
///   likewise 12 and 8;
/// - disc, 10 ε (|o − center| + radius) + 3 ε t, where D = |o − center| + radius.
pub fn k(shape: &Shape) -> f64 {
    let (three, five) = (3f64.sqrt(), 5f64.sqrt());
    match shape {
        Shape::Plane(_) => 8.0 * three,
        Shape::Sphere(_) | Shape::Fractal(_) => 5.0,
        Shape::Triangle(_) => 32.0 * three,
        Shape::Quad(it) => 24.0 / sine(it.u.as_dvec3(), it.v.as_dvec3()),
        Shape::Cuboid(it) if it.rotation == glam::Vec3::ZERO => 3.0,
        Shape::Cuboid(_) => 14.0,
        Shape::Cylinder(_) => 8.0 * (1.0 + five) + 6.0,
        Shape::Cone(_) => 12.0 * (1.0 + five) + 8.0,
        Shape::Torus(_) => 12.0,
        Shape::Disc(_) => 13.0,
    }
}

fn sine(u: DVec3, v: DVec3) -> f64 {
    u.cross(v).length() / (u.length() * v.length())
}

/// A ball around a primitive; a plane has none.
pub fn ball(shape: &Shape) -> Option<(DVec3, f64)> {
    let around = |points: &[DVec3], more: f32| {
        let center = points.iter().sum::<DVec3>() / points.len() as f64;
        (center, points.iter().map(|p| p.distance(center)).fold(0.0, f64::max).hypot(more.into()))
    };
    Some(match shape {
        Shape::Plane(_) => return None,
        Shape::Sphere(it) => (it.center.as_dvec3(), it.radius.into()),
        Shape::Triangle(it) => around(&it.corners.map(|c| c.as_dvec3()), 0.0),
        Shape::Quad(it) => {
            let [c, u, v] = [it.corner, it.u, it.v].map(|p| p.as_dvec3());
            around(&[c, c + u, c + v, c + u + v], 0.0)
        }
        Shape::Cuboid(it) => around(&[it.min, it.max].map(|p| p.as_dvec3()), 0.0),
        Shape::Cylinder(it) => around(&[it.base, it.apex].map(|p| p.as_dvec3()), it.radius),
        Shape::Cone(it) => around(&[it.base, it.apex].map(|p| p.as_dvec3()), it.base_radius.max(it.apex_radius)),
        Shape::Torus(it) => (it.center.as_dvec3(), f64::from(it.major_radius) + f64::from(it.minor_radius)),
        Shape::Fractal(it) => (it.center.as_dvec3(), f64::from(it.radius) * 3f64.sqrt()),
        Shape::Disc(it) => (it.center.as_dvec3(), it.radius.into()),
    })
}

/// D + |o|. A plane has no farthest point: D is the greatest distance at which an answer has it.
pub fn scale(shape: &Shape, ray: &Ray, answers: [Option<f64>; 2]) -> f64 {
    let origin = ray.origin.as_dvec3();
    let far = match ball(shape) {
        Some((center, radius)) => origin.distance(center) + radius,
        None => answers.into_iter().flatten().fold(0.0, f64::max),
    };
    far + origin.abs().max_element()
}

/// The least width of a primitive.
pub fn size(shape: &Shape) -> f64 {
    match shape {
        Shape::Plane(_) => f64::INFINITY,
        Shape::Sphere(it) => it.radius.into(),
        Shape::Triangle(it) => {
            let [a, b, c] = it.corners.map(|c| c.as_dvec3());
            let [u, v, w] = [b - a, c - a, c - b];
            u.cross(v).length() / u.length().max(v.length()).max(w.length())
        }
        Shape::Quad(it) => {
            let [u, v] = [it.u, it.v].map(|e| e.as_dvec3());
            u.cross(v).length() / u.length().max(v.length())
        }
        Shape::Cuboid(it) => (it.max.as_dvec3() - it.min.as_dvec3()).min_element(),
        Shape::Cylinder(it) => f64::from(it.radius).min(it.base.as_dvec3().distance(it.apex.as_dvec3())),
        Shape::Cone(it) => {
            f64::from(it.base_radius.max(it.apex_radius)).min(it.base.as_dvec3().distance(it.apex.as_dvec3()))
        }
        Shape::Torus(it) => it.minor_radius.into(),
        Shape::Fractal(it) => it.radius.into(),
        Shape::Disc(it) => f64::from(it.radius) - f64::from(it.inner_radius),
    }
}

/// How far a triangle's or quad's plane may be missed, more than its edges where it is thin.
pub fn plane_off(shape: &Shape, ray: &Ray) -> f64 {
    let o = ray.origin.as_dvec3();
    let off = match shape {
        Shape::Triangle(it) => {
            let [a, b, c] = it.corners.map(|c| c.as_dvec3());
            a.distance(o) + (b - a).length().max((c - b).length()).max((a - c).length())
        }
        Shape::Quad(it) => it.corner.as_dvec3().distance(o) + it.u.as_dvec3().length().max(it.v.as_dvec3().length()),
        _ => 0.0,
    };
    8.0 * ROUNDOFF * off / angle(shape)
}

/// The sine of a triangle's or quad's smallest angle; 1 for anything else.
pub fn angle(shape: &Shape) -> f64 {
    match shape {
        Shape::Triangle(it) => {
            let [a, b, c] = it.corners.map(|c| c.as_dvec3());
            let [u, v, w] = [b - a, c - b, a - c];
            sine(u, v).min(sine(v, w)).min(sine(w, u))
        }
        Shape::Quad(it) => sine(it.u.as_dvec3(), it.v.as_dvec3()),
        _ => 1.0,
    }
}

/// Cosine of incidence.
pub fn cosine(ray: &Ray, truth: &Truth) -> f64 {
    let (_, d) = ray.line();
    d.dot(truth.normal).abs()
}

/// What is documented of t's error, in world units.
pub fn error_of_t(shape: &Shape, ray: &Ray, truth: &Truth) -> f64 {
    let (o, cosine, t) = (ray.origin.as_dvec3(), cosine(ray, truth), truth.t.abs());
    let from = |p: glam::Vec3| p.as_dvec3().distance(o);
    let body = |end: glam::Vec3, other: glam::Vec3, radius: f32| {
        from(end) + end.as_dvec3().distance(other.as_dvec3()) + f64::from(radius)
    };
    let off = match shape {
        Shape::Plane(it) => {
            let n = it.normal.as_dvec3();
            4.0 * (n.dot(o).abs() + f64::from(it.distance).abs()) / n.length() + 3.0 * t
        }
        Shape::Sphere(it) => {
            let f = from(it.center);
            8.0 * t * cosine + 4.0 * f * f / f64::from(it.radius)
        }
        Shape::Triangle(_) | Shape::Quad(_) => return plane_off(shape, ray) / cosine,
        Shape::Cuboid(it) if it.rotation == glam::Vec3::ZERO => 3.0 * t * cosine,
        Shape::Cuboid(it) => {
            let center = (it.min.as_dvec3() + it.max.as_dvec3()) / 2.0;
            let corner = center.length() + it.min.as_dvec3().distance(center);
            5.0 * center.distance(o) + 7.0 * t + 2.0 * corner
        }
        Shape::Cylinder(it) => 8.0 * body(it.base, it.apex, it.radius) + 6.0 * t,
        Shape::Cone(it) => {
            let narrow = if it.base_radius < it.apex_radius { it.base } else { it.apex };
            let other = if it.base_radius < it.apex_radius { it.apex } else { it.base };
            12.0 * body(narrow, other, it.base_radius.max(it.apex_radius)) + 8.0 * t
        }
        Shape::Torus(it) => 12.0 * (f64::from(it.major_radius) + f64::from(it.minor_radius)) + 4.0 * from(it.center),
        Shape::Fractal(it) => 4.0 * from(it.center) + 5.0 * f64::from(it.radius),
        Shape::Disc(it) => 8.0 * (from(it.center) + f64::from(it.radius)),
    };
    ROUNDOFF * off / cosine
}

/// From t to the next `f32`.
pub fn ulp(t: f64) -> f64 {
    let t = (t as f32).abs();
    f64::from(t.next_up()) - f64::from(t)
}
