//! Curved shapes: the implicit function changes its sign within the rounding of t, and nowhere before.
use super::rational::{
    Rational3, assert_rounded, at, dot, interpolated, rational, rational3, rootless, rounds_to, sub,
};
use super::*;
use dashu_ratio::RBig;

type Function = Box<dyn Fn(&Rational3) -> RBig>;

/// Below 0 inside of a sphere, torus, or endless cylinder or double cone: a polynomial in the point, and its degree.
fn implicit(shape: &Shape) -> (Function, usize) {
    let frustum = |base: Vec3, apex: Vec3, radii: [f32; 2]| {
        let (base, w) = (rational3(base), sub(&rational3(apex), &rational3(base)));
        let [r0, r1] = radii.map(rational);
        let f = move |p: &Rational3| {
            let q = sub(p, &base);
            let share = dot(&q, &w) / dot(&w, &w);
            let foot = [0, 1, 2].map(|i| &q[i] - &share * &w[i]);
            let radius = &r0 + (&r1 - &r0) * share;
            dot(&foot, &foot) - &radius * &radius
        };
        (Box::new(f) as Function, 2)
    };
    match *shape {
        Shape::Sphere(it) => {
            let (center, radius) = (rational3(it.center), rational(it.radius));
            let f = move |p: &Rational3| {
                let q = sub(p, &center);
                dot(&q, &q) - &radius * &radius
            };
            (Box::new(f), 2)
        }
        Shape::Torus(it) => {
            let (center, axis) = (rational3(it.center), rational3(it.axis));
            let [major, minor] = [it.major_radius, it.minor_radius].map(rational);
            let f = move |p: &Rational3| {
                let q = sub(p, &center);
                let height2 = dot(&q, &axis) * dot(&q, &axis) / dot(&axis, &axis);
                let sum = dot(&q, &q) + &major * &major - &minor * &minor;
                &sum * &sum - RBig::from(4) * &major * &major * (dot(&q, &q) - height2)
            };
            (Box::new(f), 4)
        }
        Shape::Cylinder(it) => frustum(it.base, it.apex, [it.radius; 2]),
        Shape::Cone(it) => frustum(it.base, it.apex, [it.base_radius, it.apex_radius]),
        _ => unreachable!("only curved shapes are asked for"),
    }
}

/// Base, apex, radii and caps.
fn ends(shape: &Shape) -> Option<(Rational3, Rational3, [RBig; 2], bool)> {
    let (base, apex, radii, caps) = match *shape {
        Shape::Cylinder(it) => (it.base, it.apex, [it.radius; 2], it.caps),
        Shape::Cone(it) => (it.base, it.apex, [it.base_radius, it.apex_radius], it.caps),
        _ => return None,
    };
    Some((rational3(base), rational3(apex), radii.map(rational), caps))
}

/// Where the ray is between the ends, and its hits of them.
fn between_ends(shape: &Shape, ray: &Ray, range: [RBig; 2]) -> ([RBig; 2], Vec<RBig>) {
    let Some((base, apex, radii, caps)) = ends(shape) else { return (range, Vec::new()) };
    let (axis, d) = (sub(&apex, &base), rational3(ray.direction));
    let mut crossings = [(&base, &radii[0]), (&apex, &radii[1])].map(|(end, radius)| {
        let t = dot(&sub(end, &rational3(ray.origin)), &axis) / dot(&d, &axis);
        let q = sub(&at(ray, &t), end);
        let hit = caps && dot(&q, &q) <= radius * radius && range[0] < t && t < range[1];
        (t, hit)
    });
    let hits = crossings.iter().filter(|(_, hit)| *hit).map(|(t, _)| t.clone()).collect();
    crossings.sort();
    let [(low, _), (high, _)] = crossings;
    let [start, end] = range;
    ([start.max(low), end.min(high)], hits)
}

/// Both sides are there: one that is not is tested in [`against`].
fn seen_from_both_sides(shape: Shape) -> Shape {
    let sides = Sides::Both;
    match shape {
        Shape::Sphere(it) => Shape::Sphere(Sphere { sides, ..it }),
        Shape::Cylinder(it) => Shape::Cylinder(Cylinder { sides, ..it }),
        Shape::Cone(it) => Shape::Cone(Cone { sides, ..it }),
        other => other,
    }
}

fn check(shape: &Shape, ray: &Ray) -> bool {
    let (f, degree) = implicit(shape);
    let along = |t: &RBig| f(&at(ray, t));
    let polynomial = interpolated(along, degree);
    let truth = nearest(shape, ray, 0.0, 1e6);
    let end = truth.map_or(rational(1e6), |truth| rounds_to(truth.t)[0].clone());
    let (inside, ends) = between_ends(shape, ray, [RBig::ZERO, end]);
    assert!(ends.is_empty(), "the end at {} was passed over: {shape:?} {ray:?}", ends[0].to_f64().value());
    assert!(rootless(&polynomial, &inside[0], &inside[1]), "there is a root before {truth:?}: {shape:?} {ray:?}");
    let Some(truth) = truth else { return false };
    let range = rounds_to(truth.t);
    let (_, ends) = between_ends(shape, ray, range.clone());
    if let Some(end) = ends.first() {
        assert_rounded(truth.t, end);
    } else {
        let signs = range.each_ref().map(|t| along(t) > RBig::ZERO);
        assert_ne!(signs[0], signs[1], "no root at {truth:?}: {shape:?} {ray:?}");
        // The gradient at the root by differences in every direction, a millionth of a millionth aside.
        let point = at(ray, &bisected(along, range));
        let step = rational(1e-12);
        let gradient = [0, 1, 2].map(|axis| {
            let aside = |sign: i32| {
                let mut p = point.clone();
                p[axis] += RBig::from(sign) * &step;
                f(&p)
            };
            ((aside(1) - aside(-1)) / (RBig::from(2) * &step)).to_f64().value()
        });
        let normal = DVec3::from_array(gradient).normalize();
        assert!(normal.abs_diff_eq(truth.normal, 1e-11), "{normal} is not {truth:?}: {shape:?} {ray:?}");
    }
    true
}

/// A root between two places with unlike signs, to 2⁻⁵⁰ of their distance.
fn bisected(f: impl Fn(&RBig) -> RBig, [mut low, mut high]: [RBig; 2]) -> RBig {
    let rises = f(&high) > RBig::ZERO;
    for _ in 0..50 {
        let middle = (&low + &high) / RBig::from(2);
        if (f(&middle) > RBig::ZERO) == rises { high = middle } else { low = middle }
    }
    high
}

#[test]
fn curved_shapes_are_hit_where_their_equations_say_and_nowhere_before() {
    let mut random = Random(11);
    for kind in [1, 6, 7, 8] {
        let hits = (0..200).filter(|_| check(&seen_from_both_sides(random.shape(kind)), &random.ray())).count();
        assert!((40..180).contains(&hits), "kind {kind}: {hits} of 200 hit");
    }
}

/// From a thousand to a million sizes away, and of a thousandth to a millionth of the distance from the world's origin.
#[test]
fn far_away_too() {
    let mut random = Random(12);
    for kind in [1, 6, 7, 8] {
        let hits = (0..120).filter(|_| {
            let (shape, mut ray) = (seen_from_both_sides(random.shape(kind)), random.ray());
            let away = 10f32.powf(4.0 + random.next());
            ray.origin += random.vector() * away;
            ray.direction = (random.vector() * 0.5 - ray.origin).normalize();
            check(&shape, &ray)
        });
        let hits = hits.count();
        assert!((12..115).contains(&hits), "kind {kind}: {hits} of 120 hit");
    }
}

/// Thin tori, wide tori, and rays that graze: the lines through a point of the tube across its normal, rounded to f32.
#[test]
fn grazed_tori() {
    let mut random = Random(13);
    for i in 0..160 {
        let shape = torus(1.0, [0.5, 1e-3, 1.0, 0.999][i % 4]);
        let Shape::Torus(it) = shape else { unreachable!() };
        let around = Vec3::from_array([random.next(), random.next(), 0.0]).normalize_or(Vec3::X);
        let outward = (around * random.next() + Vec3::Z * random.next()).normalize_or(Vec3::Z);
        let point = around * it.major_radius + outward * it.minor_radius;
        let direction = outward.cross(random.vector()).normalize_or(Vec3::X);
        check(&shape, &Ray::new(point - direction * 3.0, direction));
    }
}
