//! Flat faces: planes, triangles and parallelograms by Cramer's rule, boxes by their corners, sponges by all cubes.
use super::rational::{Rational3, assert_rounded, at, cross, dot, rational, rational3, sub};
use super::*;
use dashu_ratio::RBig;

/// t and both coordinates where the ray meets corner + a u + b v; `None` in parallel.
fn cramer(ray: &Ray, corner: &Rational3, u: &Rational3, v: &Rational3) -> Option<[RBig; 3]> {
    // t d − a u − b v = corner − o
    let (d, right) = (rational3(ray.direction), sub(corner, &rational3(ray.origin)));
    let det = |a: &Rational3, b: &Rational3, c: &Rational3| dot(a, &cross(b, c));
    let whole = det(&d, u, v);
    if whole == RBig::ZERO {
        return None;
    }
    Some([det(&right, u, v) / &whole, -det(&d, &right, v) / &whole, -det(&d, u, &right) / &whole])
}

#[test]
fn triangles_and_quads_by_cramers_rule() {
    let mut random = Random(21);
    let (zero, one) = (RBig::ZERO, RBig::ONE);
    let mut hits = [0, 0];
    for i in 0..2000 {
        // Corners and rays on a coarse grid meet edges and corners often.
        let coarse = |v: Vec3| if i % 2 == 0 { (v * 4.0).round() } else { v };
        let corners = [random.vector(), random.vector(), random.vector()].map(coarse);
        let origin = coarse(random.vector() * 3.0);
        let ray = Ray::new(origin, coarse(random.vector()) - origin);
        let quad = Quad { corner: corners[0], u: corners[1], v: corners[2], material: 0 };
        let sides = Sides::Both;
        let [a, b, c] = corners.map(rational3);
        let cases = [
            (Shape::Triangle(Triangle { corners, sides }), sub(&b, &a), sub(&c, &a), true),
            (Shape::Quad(quad), b, c, false),
        ];
        for (k, (shape, u, v, triangle)) in cases.into_iter().enumerate() {
            let expected = cramer(&ray, &a, &u, &v).filter(|[t, x, y]| {
                let inside = *x >= zero && *y >= zero && if triangle { x + y <= one } else { *x <= one && *y <= one };
                inside && *t > zero
            });
            let truth = nearest(&shape, &ray, 0.0, f64::INFINITY);
            assert_eq!(truth.is_some(), expected.is_some(), "{shape:?} {ray:?}");
            if let (Some(truth), Some([t, ..])) = (truth, expected) {
                assert_rounded(truth.t, &t);
                let normal = DVec3::from_array(cross(&u, &v).map(|c| c.to_f64().value())).normalize();
                assert!(normal.abs_diff_eq(truth.normal, 1e-15), "{normal} {truth:?}");
                hits[k] += 1;
            }
        }
    }
    assert!(hits[0] > 100 && hits[1] > 100, "{hits:?}");
}

/// t by Cramer's rule with two edges in the plane, and the distance from the middle by Pythagoras.
#[test]
fn discs_by_their_planes() {
    let mut random = Random(24);
    let mut hits = [0, 0];
    for i in 0..2000 {
        // Centres, normals and rays on a coarse grid meet the rims often.
        let coarse = |v: Vec3| if i % 2 == 0 { (v * 4.0).round() } else { v };
        let [center, normal] = [random.vector(), random.vector()].map(coarse);
        let (u, v) = (vec3(normal.y, -normal.x, 0.0), vec3(0.0, normal.z, -normal.y));
        let origin = coarse(random.vector() * 3.0);
        let ray = Ray::new(origin, coarse(random.vector()) - origin);
        let (radius, inner_radius) = (1.5 + random.below(6) as f32, [0.0, 0.5, 1.0][random.below(3) as usize]);
        // The edges span nothing where the normal lies in y = 0.
        if normal.y == 0.0 {
            continue;
        }
        let squares = [inner_radius, radius].map(|r| RBig::from((r * r * 4.0) as i64) / RBig::from(4));
        let expected = cramer(&ray, &rational3(center), &rational3(u), &rational3(v)).map(|[t, ..]| t).filter(|t| {
            let q = sub(&at(&ray, t), &rational3(center));
            let out = dot(&q, &q);
            *t > RBig::ZERO && squares[0] <= out && out <= squares[1]
        });
        let shape = Shape::Disc(Disc { center, normal, radius, inner_radius, material: 0 });
        let truth = nearest(&shape, &ray, 0.0, f64::INFINITY);
        assert_eq!(truth.is_some(), expected.is_some(), "{shape:?} {ray:?}");
        if let (Some(truth), Some(t)) = (truth, expected) {
            assert_rounded(truth.t, &t);
            assert!(truth.normal.abs_diff_eq(normal.as_dvec3().normalize(), 1e-15), "{truth:?}");
            hits[i % 2] += 1;
        }
    }
    assert!(hits[0] > 100 && hits[1] > 100, "{hits:?}");
}

/// The front is where the corners run counter-clockwise.
#[test]
fn triangles_have_sides() {
    let corners = [Vec3::ZERO, Vec3::X, Vec3::Y];
    for (sides, from_above, from_below) in
        [(Sides::Both, true, true), (Sides::Front, true, false), (Sides::Back, false, true)]
    {
        let shape = Shape::Triangle(Triangle { corners, sides });
        let hit = |z: f32| ahead(&shape, vec3(0.25, 0.25, z), vec3(0.0, 0.0, -z)).is_some();
        assert_eq!((hit(1.0), hit(-1.0)), (from_above, from_below), "{sides:?}");
    }
}

/// The hit is the first of the places where the ray crosses a face's plane and is in the closed box.
#[test]
fn boxes_by_all_their_planes() {
    let mut random = Random(22);
    let mut hits = 0;
    for i in 0..1000 {
        let coarse = |v: Vec3| if i % 2 == 0 { (v * 2.0).round() } else { v };
        let (a, b) = (coarse(random.vector()), coarse(random.vector()));
        let (min, max) = (a.min(b) - 0.5, a.max(b) + 0.5);
        let shape = Shape::Cuboid(Cuboid { min, max, rotation: Vec3::ZERO, material: 0 });
        let origin = coarse(random.vector() * 3.0) + 0.5;
        let ray = Ray::new(origin, coarse(random.vector()) + 0.5 - origin);
        let (low, high, o, d) = (rational3(min), rational3(max), rational3(origin), rational3(ray.direction));
        let inside = |p: &Rational3| (0..3).all(|axis| low[axis] <= p[axis] && p[axis] <= high[axis]);
        let planes = (0..3).filter(|axis| d[*axis] != RBig::ZERO);
        let crossings = planes.flat_map(|axis| [&low, &high].map(|corner| (&corner[axis] - &o[axis]) / &d[axis]));
        let expected = crossings.filter(|t| *t > RBig::ZERO && inside(&at(&ray, t))).min();
        let truth = nearest(&shape, &ray, 0.0, f64::INFINITY);
        assert_eq!(truth.is_some(), expected.is_some(), "{shape:?} {ray:?}");
        let (Some(truth), Some(t)) = (truth, expected) else { continue };
        hits += 1;
        assert_rounded(truth.t, &t);
        let axis = truth.normal.abs().max_position();
        assert_eq!(truth.normal.abs(), DVec3::AXES[axis]);
        let face = if truth.normal[axis] > 0.0 { &high } else { &low };
        assert_eq!(at(&ray, &t)[axis], face[axis], "{shape:?} {ray:?} {truth:?}");
    }
    assert!(hits > 300, "{hits}");
}

/// The least corners of the smallest cubes, from the whole cube's, and their edge.
fn cubes(iterations: u32) -> Vec<[i64; 3]> {
    if iterations == 0 {
        return vec![[0; 3]];
    }
    let size = 3i64.pow(iterations - 1);
    let kept = |cell: &[i64; 3]| cell.iter().filter(|c| **c == 1).count() < 2;
    let parts = (0..27).map(|i| [i % 3, i / 3 % 3, i / 9]).filter(kept);
    let inner = cubes(iterations - 1);
    parts.flat_map(|part| inner.iter().map(move |c| [0, 1, 2].map(|i| part[i] * size + c[i]))).collect()
}

/// Where a ray is in a closed cube.
fn through(o: &Rational3, d: &Rational3, low: [i64; 3]) -> Option<[RBig; 2]> {
    let (mut enter, mut exit) = (rational(-1e9), rational(1e9));
    for axis in 0..3 {
        let faces = [low[axis], low[axis] + 1].map(|plane| RBig::from(plane) - &o[axis]);
        if d[axis] == RBig::ZERO {
            if faces[0] > RBig::ZERO || faces[1] < RBig::ZERO {
                return None;
            }
            continue;
        }
        let mut t = faces.map(|face| face / &d[axis]);
        t.sort();
        let [first, last] = t;
        (enter, exit) = (enter.max(first), exit.min(last));
    }
    (enter <= exit).then_some([enter, exit])
}

/// The first end of a stretch within touching cubes, after `t_min`.
fn first_boundary(o: &Rational3, d: &Rational3, cubes: &[[i64; 3]], t_min: &RBig) -> Option<RBig> {
    let mut stretches = cubes.iter().filter_map(|low| through(o, d, *low)).collect::<Vec<_>>();
    stretches.sort();
    let mut joined: Vec<[RBig; 2]> = Vec::new();
    for [enter, exit] in stretches {
        match joined.last_mut() {
            Some([_, end]) if enter <= *end => *end = exit.max(end.clone()),
            _ => joined.push([enter, exit]),
        }
    }
    joined.into_iter().flatten().find(|t| t > t_min)
}

#[test]
fn sponges_by_all_their_cubes() {
    let mut random = Random(23);
    for iterations in 0..=2 {
        let (all, n) = (cubes(iterations), 3f32.powi(iterations as i32));
        // In units of half a cell, about a centre off the origin, so that the planes are whole numbers.
        let center = vec3(3.0, -5.0, 7.0);
        let shape = Shape::Fractal(Fractal { center, radius: n, iterations, material: 0 });
        let mut hits = 0;
        for i in 0..600 {
            // On the grid rays pass edges and corners, glide in planes, start on faces.
            let coarse = |v: Vec3| if i % 3 > 0 { v.round() } else { v };
            let o = coarse(random.vector() * n * if i % 4 == 0 { 0.9 } else { 2.0 });
            let mut d = coarse(random.vector() * n * 0.8) - o;
            if i % 5 == 0 {
                d[random.below(3) as usize] = -0.0;
            }
            let t_min = if i % 7 == 0 { 0.25 } else { 0.0 };
            let origin = o + center;
            if d == Vec3::ZERO {
                continue;
            }
            let half = |v: Vec3, shift: f32| rational3(v).map(|c| (c + rational(shift)) / RBig::from(2));
            let from = rational3(origin);
            let middle = rational3(center);
            let from = [0, 1, 2].map(|axis| (&from[axis] - &middle[axis] + rational(n)) / RBig::from(2));
            let expected = first_boundary(&from, &half(d, 0.0), &all, &rational(t_min));
            let truth = nearest(&shape, &Ray::new(origin, d), t_min, f64::INFINITY);
            assert_eq!(truth.is_some(), expected.is_some(), "{iterations}: {origin} {d} {truth:?}");
            let (Some(truth), Some(t)) = (truth, expected) else { continue };
            assert_rounded(truth.t, &t);
            hits += 1;
            assert_face(&all, &from, &half(d, 0.0), &t, truth.normal);
        }
        assert!(hits > 200, "{iterations}: {hits}");
    }
}

/// Where a face is, one of the cells beside it is solid and the other is not; the normal points to the latter. Only where
/// the ray touches nothing but an edge or a corner of a face in question may the cells be any of those around.
fn assert_face(all: &[[i64; 3]], o: &Rational3, d: &Rational3, t: &RBig, normal: DVec3) {
    let point: [RBig; 3] = [0, 1, 2].map(|i| &o[i] + t * &d[i]);
    let axis = normal.abs().max_position();
    assert_eq!(normal.abs(), DVec3::AXES[axis]);
    // The cells that touch the point.
    let touching =
        all.iter().filter(|low| (0..3).all(|i| RBig::from(low[i]) <= point[i] && point[i] <= RBig::from(low[i] + 1)));
    let plane = point[axis].clone();
    let separated = touching.filter(|low| {
        let side = if normal[axis] > 0.0 { 1 } else { 0 };
        let mut beside = **low;
        beside[axis] += if side == 1 { 1 } else { -1 };
        RBig::from(low[axis] + side) == plane && !all.contains(&beside)
    });
    assert!(separated.count() > 0, "no face of normal {normal} at {:?}", point.map(|c| c.to_f64().value()));
}
