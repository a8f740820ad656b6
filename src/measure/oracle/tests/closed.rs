//! Cases known by hand: whole numbers, tangents by construction, far and huge shapes, and what is no question at all.
use super::rational::{assert_rounded, rational};
use super::*;
use dashu_ratio::RBig;
use glam::dvec3;

fn cylinder(caps: bool) -> Shape {
    let (base, apex, sides) = (Vec3::ZERO, vec3(6.0, 8.0, 0.0), Sides::Both);
    Shape::Cylinder(Cylinder { base, apex, radius: 5.0, caps, sides, material: 0 })
}

fn cone(caps: bool) -> Shape {
    let (base, apex, sides) = (Vec3::ZERO, vec3(0.0, 0.0, 4.0), Sides::Both);
    Shape::Cone(Cone { base, apex, base_radius: 3.0, apex_radius: 0.0, caps, sides, material: 0 })
}

fn cuboid(min: Vec3, max: Vec3, rotation: Vec3) -> Shape {
    Shape::Cuboid(Cuboid { min, max, rotation, material: 0 })
}

fn close(a: DVec3, b: DVec3) -> bool {
    a.abs_diff_eq(b, 2f64.powi(-50))
}

/// Shape, origin, direction, all t.
type Whole = (Shape, Vec3, Vec3, Vec<f64>);

fn whole() -> Vec<Whole> {
    let floor = Shape::Plane(Plane { normal: vec3(0.0, 3.0, 4.0), distance: -10.0, material: 0 });
    let triangle = Triangle { corners: [Vec3::ZERO, Vec3::X, Vec3::Y], sides: Sides::Both };
    let quad = Quad { corner: Vec3::ZERO, u: Vec3::X, v: Vec3::Y, material: 0 };
    let sponge = |iterations| Fractal { center: Vec3::ZERO, radius: 4.5, iterations, material: 0 };
    let down = vec3(0.25, 0.25, 3.0);
    vec![
        (floor, vec3(7.0, 0.0, 0.0), vec3(0.0, 0.3e1, 0.4e1), vec![0.4]),
        (sphere(Vec3::ZERO, 5.0), vec3(3.0, 0.0, -10.0), Vec3::Z, vec![6.0, 14.0]),
        (sphere(Vec3::ZERO, 5.0), vec3(0.0, -15.0, 0.0), vec3(0.0, 4.0, 3.0), vec![]),
        (sphere(Vec3::ZERO, 12.0), vec3(0.0, -15.0, 0.0), vec3(0.0, 20.0, 0.0), vec![0.15, 1.35]),
        (sphere(vec3(1.0, 2.0, 3.0), 7.0), vec3(1.0, 2.0, 3.0), vec3(2.0, 3.0, 6.0), vec![1.0]),
        (Shape::Triangle(triangle), down, vec3(0.0, 0.0, -2.0), vec![1.5]),
        (Shape::Quad(quad), down, vec3(0.0, 0.0, -2.0), vec![1.5]),
        (cuboid(-Vec3::ONE, Vec3::ONE, Vec3::ZERO), vec3(-4.0, -0.5, 0.0), vec3(2.0, 0.25, 0.0), vec![1.5, 2.5]),
        // Twice a quarter turn: half the sizes 1, 2, 3 become 2, 3, 1.
        (
            cuboid(Vec3::ZERO, vec3(2.0, 4.0, 6.0), vec3(90.0, 0.0, 90.0)),
            vec3(11.0, 2.0, 3.0),
            -Vec3::X,
            vec![7.0, 13.0],
        ),
        (cylinder(false), vec3(-13.0, 16.0, 0.0), vec3(4.0, -3.0, 0.0), vec![3.0, 5.0]),
        (cylinder(false), vec3(-3.0, -4.0, 0.0), vec3(3.0, 4.0, 0.0), vec![]),
        (cylinder(true), vec3(-3.0, -4.0, 0.0), vec3(3.0, 4.0, 0.0), vec![1.0, 3.0]),
        (cone(false), vec3(-10.0, 0.0, 2.0), Vec3::X, vec![8.5, 11.5]),
        // Parallel to the slant on the other side.
        (cone(false), vec3(2.0, 0.0, -4.0), vec3(-1.5, 0.0, 2.0), vec![8.0 / 3.0]),
        (cone(true), vec3(2.0, 0.0, -4.0), vec3(-1.5, 0.0, 2.0), vec![2.0, 8.0 / 3.0]),
        (torus(2.0, 1.0), vec3(2.0, 0.0, -5.0), Vec3::Z, vec![4.0, 6.0]),
        (torus(2.0, 1.0), vec3(0.0, -5.0, 0.0), vec3(0.0, 0.5, 0.0), vec![4.0, 8.0, 12.0, 16.0]),
        // Cells of edge 1: through the great bore, through a solid part, through small bores and the great one.
        (Shape::Fractal(sponge(2)), vec3(0.0, 0.0, -6.0), Vec3::Z, vec![]),
        (Shape::Fractal(sponge(2)), vec3(2.0, 2.0, -6.0), Vec3::Z, vec![1.5, 10.5]),
        (Shape::Fractal(sponge(2)), vec3(-6.0, -3.0, 2.0), Vec3::X, vec![1.5, 2.5, 3.5, 5.5, 6.5, 8.5, 9.5, 10.5]),
    ]
}

/// All of them one after the other, by the interval's beginning; the interval is open at both ends.
#[test]
fn whole_numbers() {
    in_turn(whole());
}

#[test]
fn discs_in_whole_numbers() {
    // Across (3, 4, 0), with its rim 5 and that of its hole 2.5 away.
    let ring = Disc { center: Vec3::ZERO, normal: vec3(3.0, 4.0, 0.0), radius: 5.0, inner_radius: 2.5, material: 0 };
    in_turn(vec![
        (Shape::Disc(ring), vec3(2.0, 11.0, 0.0), vec3(-3.0, -4.0, 0.0), vec![2.0]),
        (Shape::Disc(ring), vec3(2.0, 1.5, 1.5), vec3(0.0, -3.0, 0.0), vec![1.0]),
        (Shape::Disc(ring), vec3(6.0, 8.0, 2.5), vec3(-3.0, -4.0, 0.0), vec![2.0]),
        (Shape::Disc(ring), vec3(6.0, 8.0, 2.25), vec3(-3.0, -4.0, 0.0), vec![]),
        (Shape::Disc(ring), vec3(-4.0, 3.0, -9.0), vec3(0.0, 0.0, 1.0), vec![]),
    ]);
}

fn in_turn(cases: Vec<Whole>) {
    for (shape, origin, direction, expected) in cases {
        let ray = Ray::new(origin, direction);
        let mut found = Vec::new();
        let mut t_min = 0.0;
        while let Some(truth) = nearest(&shape, &ray, t_min, f64::INFINITY) {
            assert_eq!(nearest(&shape, &ray, t_min, truth.t.next_up()).map(|again| again.t), Some(truth.t));
            found.push(truth.t);
            t_min = truth.t;
            // A t that is no f64 is found again from below.
            if expected.contains(&t_min) && (t_min * 4.0).fract() == 0.0 {
                assert_eq!(nearest(&shape, &ray, 0.0, found[0]), None, "{shape:?}");
            } else {
                t_min = t_min.next_up();
            }
        }
        assert_eq!(found, expected, "{shape:?} from {origin} along {direction}");
    }
}

#[test]
fn normals() {
    let up = DVec3::Z;
    let cases = [
        (sphere(Vec3::ZERO, 5.0), vec3(3.0, 0.0, -10.0), Vec3::Z, dvec3(0.6, 0.0, -0.8)),
        (cylinder(false), vec3(-13.0, 16.0, 0.0), vec3(4.0, -3.0, 0.0), dvec3(-0.8, 0.6, 0.0)),
        (cylinder(true), vec3(-3.0, -4.0, 0.0), vec3(3.0, 4.0, 0.0), dvec3(-0.6, -0.8, 0.0)),
        (cylinder(true), vec3(9.0, 12.0, 0.0), vec3(-3.0, -4.0, 0.0), dvec3(0.6, 0.8, 0.0)),
        (cone(false), vec3(-10.0, 0.0, 2.0), Vec3::X, dvec3(-0.8, 0.0, 0.6)),
        (cone(true), vec3(1.0, 0.0, -2.0), Vec3::Z, -up),
        (cone(true), vec3(0.0, 0.0, 10.0), -Vec3::Z, up),
        (torus(2.0, 1.0), vec3(2.0, 0.0, -5.0), Vec3::Z, -up),
        (torus(2.0, 1.0), vec3(0.0, 0.0, 0.0), Vec3::X, -DVec3::X),
        (torus(5.0, 2.5), vec3(6.5, 0.0, 9.0), -Vec3::Z, dvec3(0.6, 0.0, 0.8)),
    ];
    for (shape, origin, direction, normal) in cases {
        let (_, found) = ahead(&shape, origin, direction).expect("a hit");
        assert!(close(found, normal), "{found} is not {normal}: {shape:?}");
    }
}

/// A ray that touches hits, at one t only; one that is one f32 aside misses.
#[test]
fn tangents() {
    let tangents = [
        (sphere(Vec3::ZERO, 5.0), vec3(5.0, 0.0, -10.0), Vec3::Z, Vec3::X, 10.0),
        (sphere(vec3(3e7, 0.0, 1e12), 1.0), vec3(3e7, 1.0, 0.0), Vec3::Z, Vec3::Y, f64::from(1e12f32)),
        (torus(2.0, 1.0), vec3(3.0, 0.0, -5.0), Vec3::Z, Vec3::X, 5.0),
        (torus(2.0, 1.0), vec3(1.0, 0.0, -5.0), Vec3::Z, -Vec3::X, 5.0),
        (torus(2.0, 1.0), vec3(0.0, 1.0, -5.0), Vec3::Z, -Vec3::Y, 5.0),
        (cylinder(false), vec3(3.0, 4.0, 5.0), vec3(-4.0, 3.0, 0.0), Vec3::Z, 0.0),
        (cuboid(-Vec3::ONE, Vec3::ONE, Vec3::ZERO), vec3(0.0, 2.0, 0.0), vec3(1.0, -1.0, 0.0), Vec3::Y, 1.0),
    ];
    for (shape, origin, direction, aside, t) in tangents {
        let ray = Ray::new(origin, direction);
        let hit = nearest(&shape, &ray, -1.0, f64::INFINITY).unwrap_or_else(|| panic!("{shape:?} is missed"));
        assert_eq!(hit.t, t, "{shape:?}");
        assert_eq!(nearest(&shape, &ray, t, f64::INFINITY), None, "{shape:?} is touched once");
        let axis = aside.abs().max_position();
        let mut beside = ray;
        let x = beside.origin[axis];
        beside.origin[axis] = if aside[axis] > 0.0 { x.next_up() } else { x.next_down() };
        assert_eq!(nearest(&shape, &beside, -1.0, f64::INFINITY), None, "{shape:?} is not missed");
    }
}

/// Two double roots; one between two single ones; the fourfold root in the middle of a torus without a hole.
#[test]
fn double_roots_of_tori() {
    let shape = torus(2.0, 1.0);
    let all = |shape: &Shape, ray: Ray| {
        let mut found: Vec<f64> = Vec::new();
        while let Some(truth) = nearest(shape, &ray, found.last().copied().unwrap_or(-1e9), 1e9) {
            found.push(truth.t);
        }
        found
    };
    assert_eq!(all(&shape, Ray::new(vec3(-5.0, 0.0, 1.0), Vec3::X)), [3.0, 7.0]);
    let lid = nearest(&shape, &Ray::new(vec3(-5.0, 0.0, 1.0), Vec3::X), 0.0, 9.0).map(|truth| truth.normal);
    assert!(lid.is_some_and(|normal| close(normal, DVec3::Z)));
    let ray = Ray::new(vec3(1.0, -5.0, 0.0), Vec3::Y);
    let first = nearest(&shape, &ray, 0.0, 1e9).expect("the outer side");
    assert_eq!(first.t, 5.0 - 8f64.sqrt());
    let inner = nearest(&shape, &ray, 3.0, 1e9).expect("the inner side, touched from within");
    assert!(inner.t == 5.0 && close(inner.normal, -DVec3::X));
    let horn = torus(1.0, 1.0);
    assert_eq!(all(&horn, Ray::new(vec3(0.0, 0.0, -5.0), Vec3::Z)), [5.0]);
    assert_eq!(ahead(&horn, vec3(0.0, 0.0, -5.0), Vec3::Z), Some((5.0, DVec3::Z)));
    assert_eq!(all(&horn, Ray::new(vec3(-5.0, 0.0, 0.0), Vec3::X)), [3.0, 5.0, 7.0]);
}

/// A distance that f64 cannot even express: 1 above a sphere as large as 10¹⁸.
#[test]
fn far_and_huge_spheres() {
    let radius = 1e18f32;
    assert_eq!(ahead(&sphere(vec3(0.0, -radius, 0.0), radius), Vec3::Y, -Vec3::Y), Some((1.0, DVec3::Y)));
    let far = ahead(&sphere(vec3(0.0, 0.0, radius), 1.0), Vec3::ZERO, Vec3::Z).expect("straight ahead");
    assert_rounded(far.0, &(rational(radius) - RBig::ONE));
    assert_eq!(ahead(&sphere(vec3(0.0, 0.0, 1e18), 1e-12), vec3(1e-12f32.next_up(), 0.0, 0.0), Vec3::Z), None);
    assert!(ahead(&sphere(vec3(0.0, 0.0, 1e18), 1e-12), vec3(1e-12, 0.0, 0.0), Vec3::Z).is_some());
}

#[test]
fn sides_of_what_is_round() {
    let (base, apex, material) = (Vec3::ZERO, vec3(0.0, 0.0, 4.0), 0);
    for (sides, from_outside, from_inside) in
        [(Sides::Both, Some(4.0), Some(1.0)), (Sides::Front, Some(4.0), None), (Sides::Back, Some(6.0), Some(1.0))]
    {
        let (radius, caps) = (1.0, true);
        for shape in [
            Shape::Sphere(Sphere { center: vec3(0.0, 0.0, 2.0), radius, sides, material }),
            Shape::Cylinder(Cylinder { base, apex, radius, caps, sides, material }),
            Shape::Cone(Cone { base, apex, base_radius: 0.5, apex_radius: 1.5, caps, sides, material }),
        ] {
            let t = |x: f32| ahead(&shape, vec3(x, 0.0, 2.0), Vec3::X).map(|hit| hit.0);
            assert_eq!((t(-5.0), t(0.0)), (from_outside, from_inside), "{shape:?}");
        }
        let tangent = Shape::Sphere(Sphere { center: vec3(0.0, 0.0, 2.0), radius, sides, material });
        assert!(ahead(&tangent, vec3(-5.0, 1.0, 2.0), Vec3::X).is_some(), "a tangent is of both sides");
    }
}

/// The ray in the side of a cylinder or cone meets only the rims of caps; one through the tip the tip.
#[test]
fn rays_in_the_side() {
    for (shape, rim) in [(cylinder(false), None), (cylinder(true), Some(1.0))] {
        assert_eq!(ahead(&shape, vec3(-7.0, -1.0, 0.0), vec3(3.0, 4.0, 0.0)).map(|hit| hit.0), rim);
    }
    for (shape, rim) in [(cone(false), None), (cone(true), Some(1.0))] {
        assert_eq!(ahead(&shape, vec3(6.0, 0.0, -4.0), vec3(-3.0, 0.0, 4.0)).map(|hit| hit.0), rim);
    }
    assert_eq!(ahead(&cone(false), vec3(-2.0, 0.0, 4.0), Vec3::X).map(|hit| hit.0), Some(2.0));
}

/// On a face of the box a ray glides to its border; turned by 45° its edge is at √2.
#[test]
fn boxes_at_their_faces_and_turned() {
    let shape = cuboid(-Vec3::ONE, Vec3::ONE, Vec3::ZERO);
    assert_eq!(ahead(&shape, vec3(-3.0, 1.0, 0.0), Vec3::X), Some((2.0, -DVec3::X)));
    assert_eq!(ahead(&shape, vec3(-3.0, 1.0f32.next_up(), 0.0), Vec3::X), None);
    let turned = cuboid(-Vec3::ONE, Vec3::ONE, vec3(0.0, 0.0, 45.0));
    let (t, normal) = ahead(&turned, vec3(0.25, 5.0, 0.0), -Vec3::Y).expect("near the edge");
    assert_rounded(t, &(rational(5.25) - sqrt2()));
    assert!(close(normal, dvec3(0.5f64.sqrt(), 0.5f64.sqrt(), 0.0)));
    let edge = cuboid(-Vec3::ONE, Vec3::ONE, vec3(0.0, 0.0, -315.0));
    assert_eq!(ahead(&edge, vec3(0.25, 5.0, 0.0), -Vec3::Y), Some((t, normal)), "a full turn changes nothing");
}

/// √2 to 2⁻¹⁰⁰ by Newton's method.
fn sqrt2() -> RBig {
    (0..8).fold(rational(1.5), |x, _| (&x + RBig::from(2) / &x) / RBig::from(2))
}

#[test]
fn t_counts_along_the_direction_or_in_world_units() {
    let (origin, direction) = (vec3(-9.0, -12.0, 0.0), vec3(3.0, 4.0, 0.0));
    for (shape, t) in [(sphere(Vec3::ZERO, 5.0), 2.0), (cylinder(true), 3.0)] {
        let ray = Ray::new(origin, direction);
        let world = Ray { normalized: true, ..ray };
        assert_eq!(nearest(&shape, &ray, 0.0, t + 0.5).map(|truth| truth.t), Some(t));
        assert_eq!(nearest(&shape, &world, 0.0, 5.0 * t + 0.5).map(|truth| truth.t), Some(5.0 * t));
        assert_eq!(nearest(&shape, &world, 0.0, 5.0 * t), None);
        assert!(nearest(&shape, &world, 5.0 * t, 99.0).is_none_or(|truth| truth.t > 5.0 * t));
    }
}

/// Every kind, with a zero of either sign in the direction.
#[test]
fn signed_zeros_are_zeros() {
    let mut random = Random(31);
    for i in 0..200 {
        let (shape, mut ray) = (random.shape(i % KINDS), random.ray());
        ray.direction[i / KINDS % 3] = 0.0;
        let plus = nearest(&shape, &ray, 0.0, 1e9);
        ray.direction[i / KINDS % 3] = -0.0;
        assert_eq!(nearest(&shape, &ray, -0.0, 1e9), plus, "{shape:?} {ray:?}");
    }
}

#[test]
fn what_is_no_question_is_missed() {
    let mut random = Random(32);
    for kind in 0..KINDS {
        let shape = std::iter::repeat_with(|| random.shape(kind))
            .find(|shape| ahead(shape, vec3(0.1, 3.0, 0.2), vec3(0.01, -1.0, 0.02)).is_some());
        let shape = shape.expect("one in the way");
        let ray = Ray::new(vec3(0.1, 3.0, 0.2), vec3(0.01, -1.0, 0.02));
        for bad in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
            for axis in 0..3 {
                let (mut moved, mut turned) = (ray, ray);
                moved.origin[axis] = bad;
                turned.direction[axis] = bad;
                assert!([moved, turned].iter().all(|ray| nearest(&shape, ray, 0.0, 1e9).is_none()));
                assert_eq!(around(&shape, &moved, 0.0, 1e9, 1e-6), Answers::Miss);
            }
        }
        let still = Ray { direction: Vec3::ZERO, ..ray };
        assert_eq!(nearest(&shape, &still, 0.0, 1e9), None);
        let intervals = [[f64::NAN, 9.0], [0.0, f64::NAN], [9.0, 0.0], [0.0, -1.0], [2.0, 2.0]];
        assert!(intervals.iter().all(|[t_min, t_max]| nearest(&shape, &ray, *t_min, *t_max).is_none()));
        assert!(nearest(&shape, &ray, f64::NEG_INFINITY, f64::INFINITY).is_some());
    }
    let broken = [sphere(vec3(f32::NAN, 0.0, 0.0), 1.0), sphere(Vec3::ZERO, f32::INFINITY), torus(1.0, f32::NAN)];
    assert!(broken.iter().all(|shape| ahead(shape, vec3(0.0, 0.0, 9.0), -Vec3::Z).is_none()));
    let nothing = [
        Shape::Plane(Plane { normal: Vec3::ZERO, distance: 0.0, material: 0 }),
        Shape::Triangle(Triangle { corners: [Vec3::X, Vec3::X * 2.0, Vec3::X * 3.0], sides: Sides::Both }),
        Shape::Torus(Torus { center: Vec3::ZERO, axis: Vec3::ZERO, major_radius: 2.0, minor_radius: 1.0, material: 0 }),
    ];
    assert!(nothing.iter().all(|shape| ahead(shape, vec3(2.0, 0.0, 9.0), -Vec3::Z).is_none()));
}

/// The greatest and least numbers that f32 has, in every place: whatever the answer, there is one, and soon.
#[test]
fn extreme_numbers_are_answered() {
    let mut random = Random(33);
    let extreme = |random: &mut Random| {
        let powers = [0.0, 1e-45, -1e-38, 1.0, -1e12, 1e18, f32::MAX, f32::MIN];
        Vec3::from_array([0; 3].map(|_| powers[random.below(8) as usize]))
    };
    for i in 0..500 {
        let mut v = || extreme(&mut random);
        let (a, b, c, ray, size) = (v(), v(), v(), Ray::new(v(), v()), v());
        let (radius, sides, material) = (size.x, Sides::Both, 0);
        let shape = match i % 7 {
            0 => sphere(a, radius),
            1 => Shape::Triangle(Triangle { corners: [a, b, c], sides }),
            2 => Shape::Cuboid(Cuboid { min: a, max: b, rotation: c, material }),
            3 => Shape::Cone(Cone {
                base: a,
                apex: b,
                base_radius: radius,
                apex_radius: size.y,
                caps: true,
                sides,
                material,
            }),
            4 => Shape::Torus(Torus { center: a, axis: b, major_radius: radius, minor_radius: size.y, material }),
            5 => Shape::Disc(Disc { center: a, normal: b, radius, inner_radius: size.y, material }),
            _ => Shape::Fractal(Fractal { center: a, radius, iterations: 9, material }),
        };
        let truth = nearest(&shape, &ray, 0.0, f64::INFINITY);
        assert!(truth.is_none_or(|truth| truth.t > 0.0 && truth.normal.is_normalized()), "{shape:?} {ray:?} {truth:?}");
    }
}
