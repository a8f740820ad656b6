use super::*;
use crate::scene::{Cone, Cuboid, Cylinder, Disc, Fractal, Mesh, Plane, Quad, Sides, Sphere, Torus};
use glam::{DVec2, DVec3, Vec3, Vec3Swizzles};
use std::f64::consts::TAU;

/// All of the test's bodies, in pixels of a pane of 2000².
const SEEN: Section = Section { y: 0.0, center: DVec2::ZERO, radius: 15.0, pixel: 0.01 };

/// Numbers from −1 to 1, the same each time (Marsaglia 2003).
struct Dice(u64);

impl Dice {
    fn roll(&mut self) -> f32 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 40) as f32 / (1 << 23) as f32 - 1.0
    }

    fn between(&mut self, low: f32, high: f32) -> f32 {
        low + (high - low) * (self.roll() + 1.0) / 2.0
    }

    fn vector(&mut self) -> Vec3 {
        Vec3::new(self.roll(), self.roll(), self.roll())
    }

    fn flat(&mut self, reach: f64) -> DVec2 {
        DVec2::new(self.roll().into(), self.roll().into()) * reach
    }
}

fn all(description: &Description, section: &Section) -> Vec<Cut> {
    let mut all = Vec::new();
    cuts(description, section, |cut| all.push(cut));
    all
}

/// With circles as polygons.
fn segments(description: &Description, section: &Section) -> Vec<[DVec2; 2]> {
    let pieces = |cut| match cut {
        Cut::Segment(from, to) => vec![[from, to]],
        Cut::Circle { center, radius } => {
            let at = |i: u32| center + DVec2::from_angle(TAU * f64::from(i % 500) / 500.0) * radius;
            (0..500).map(|i| [at(i), at(i + 1)]).collect()
        }
        Cut::Line { .. } => panic!("a line"),
    };
    all(description, section).into_iter().flat_map(pieces).collect()
}

fn of_cuboid(cuboid: Cuboid) -> Description {
    Description { cuboids: vec![cuboid], ..Description::default() }
}

fn of_cylinder(base: Vec3, apex: Vec3, radius: f32, caps: bool) -> Description {
    let cylinder = Cylinder { base, apex, radius, caps, sides: Sides::Both, material: 0 };
    Description { cylinders: vec![cylinder], ..Description::default() }
}

fn of_cone(base: Vec3, base_radius: f32, apex: Vec3, apex_radius: f32, caps: bool) -> Description {
    let cone = Cone { base, base_radius, apex, apex_radius, caps, sides: Sides::Both, material: 0 };
    Description { cones: vec![cone], ..Description::default() }
}

fn of_torus(center: Vec3, axis: Vec3, major_radius: f32, minor_radius: f32) -> Description {
    let torus = Torus { center, axis, major_radius, minor_radius, material: 0 };
    Description { tori: vec![torus], ..Description::default() }
}

fn of_fractal(center: Vec3, radius: f32, iterations: u32) -> Description {
    Description { fractals: vec![Fractal { center, radius, iterations, material: 0 }], ..Description::default() }
}

fn of_disc(center: Vec3, normal: Vec3, radius: f32, inner_radius: f32) -> Description {
    Description { discs: vec![Disc { center, normal, radius, inner_radius, material: 0 }], ..Description::default() }
}

/// The distance to the side of a body of revolution, negative inside, and the least distance within its ends.
fn side_distance(ends: [Vec3; 2], radii: [f32; 2], p: DVec3) -> [f64; 2] {
    let [base, apex] = ends.map(|v| v.as_dvec3());
    let (axis, length) = ((apex - base).normalize(), (apex - base).length());
    let (along, grow) = ((p - base).dot(axis), f64::from(radii[1] - radii[0]) / length);
    let radius = f64::from(radii[0]) + grow * along;
    let side = ((p - base).cross(axis).length() - radius) / (1.0 + grow * grow).sqrt();
    [side, along.min(length - along)]
}

fn torus_distance(torus: &Torus, p: DVec3) -> f64 {
    let (q, axis) = (p - torus.center.as_dvec3(), torus.axis.as_dvec3().normalize());
    let around = q.cross(axis).length() - f64::from(torus.major_radius);
    around.hypot(q.dot(axis)) - f64::from(torus.minor_radius)
}

/// Turned back axis by axis.
fn cuboid_distance(cuboid: &Cuboid, p: DVec3) -> f64 {
    let (min, max) = (cuboid.min.as_dvec3(), cuboid.max.as_dvec3());
    let mut q = p - (min + max) / 2.0;
    for (axis, degrees) in [(DVec3::Z, cuboid.rotation.z), (DVec3::Y, cuboid.rotation.y), (DVec3::X, cuboid.rotation.x)]
    {
        q = glam::DQuat::from_axis_angle(axis, -f64::from(degrees).to_radians()) * q;
    }
    (q.abs() - (max - min) / 2.0).max_element()
}

/// Whether the outlines are where the body begins and ends: they are on its surface at both ends of every segment and
/// within half a pixel of it between, and a line from one point of the slice to another crosses them an odd number of
/// times just when one of the two is inside. Gives back how many points were inside.
fn check_outline(description: &Description, section: &Section, distance: impl Fn(DVec3) -> f64) -> usize {
    let distance = |p: DVec2| distance(DVec3::new(p.x, section.y, p.y));
    let outline = segments(description, section);
    // Where an outline runs across its axis of symmetry, √ε of the body is what rounding leaves.
    for [from, to] in &outline {
        for p in [from, to] {
            assert!(distance(*p).abs() < 1e-6, "{p} is {} off: {description:?}", distance(*p));
        }
        let off = distance((from + to) / 2.0).abs();
        assert!(off < section.pixel / 2.0, "{from} to {to} is {off} off: {description:?}");
    }
    let (mut dice, mut inside) = (Dice(7), 0);
    for _ in 0..100 {
        // Well within the circle that is seen.
        let [p, q] = [(); 2].map(|()| section.center + dice.flat(section.radius * 0.6));
        if distance(p).abs().min(distance(q).abs()) < section.pixel {
            continue;
        }
        let left = |p: DVec2, q: DVec2, r: DVec2| (q - p).perp_dot(r - p) > 0.0;
        let crossed = |[a, b]: &&[DVec2; 2]| left(p, q, *a) != left(p, q, *b) && left(*a, *b, p) != left(*a, *b, q);
        let odd = outline.iter().filter(crossed).count() % 2 == 1;
        assert_eq!(odd, (distance(p) < 0.0) != (distance(q) < 0.0), "{p} to {q}: {description:?}");
        inside += usize::from(distance(p) < 0.0);
    }
    inside
}

#[test]
fn spheres_give_circles() {
    let cut = |y: f32, radius: f32| {
        let sphere = Sphere { center: Vec3::new(2.0, y, 3.0), radius, sides: Sides::Both, material: 0 };
        all(&Description { spheres: vec![sphere], ..Description::default() }, &Section { y: 1.0, ..SEEN })
    };
    let center = DVec2::new(2.0, 3.0);
    assert_eq!(cut(1.0, 2.0), [Cut::Circle { center, radius: 2.0 }]);
    assert_eq!(cut(4.0, 5.0), [Cut::Circle { center, radius: 4.0 }]);
    assert_eq!(cut(3.0, 2.0), [Cut::Circle { center, radius: 0.0 }]);
    assert_eq!(cut(3.1, 2.0), []);
}

#[test]
fn planes_give_lines_unless_parallel() {
    let cut = |normal: Vec3, distance: f32, y: f64| {
        let planes = vec![Plane { normal, distance, material: 0 }];
        all(&Description { planes, ..Description::default() }, &Section { y, ..SEEN })
    };
    assert_eq!(cut(Vec3::Y * 3.0, 1.0, 0.5), []);
    // 2x + 2y − 6 = 0 at y = 1: x = 2, of any z.
    let [Cut::Line { point, direction }] = cut(Vec3::new(2.0, 2.0, 0.0), -6.0, 1.0)[..] else { panic!() };
    assert!(point.distance(DVec2::new(2.0, 0.0)) < 1e-12 && direction.x == 0.0 && direction.y != 0.0);
}

#[test]
fn a_mesh_with_a_bad_index_is_no_panic() {
    let mesh = Mesh { positions: vec![Vec3::ZERO], triangles: vec![[0, 1, 2]], ..Mesh::default() };
    assert_eq!(all(&Description { meshes: vec![mesh], ..Description::default() }, &SEEN), []);
}

#[test]
fn quads_give_segments() {
    let quad = |v: Vec3, y: f32| {
        let quad = Quad { corner: Vec3::new(1.0, y, 2.0), u: Vec3::X * 4.0, v, material: 0 };
        segments(&Description { quads: vec![quad], ..Description::default() }, &SEEN)
    };
    let (left, right) = (DVec2::new(1.0, 2.0), DVec2::new(5.0, 2.0));
    assert!([vec![[left, right]], vec![[right, left]]].contains(&quad(Vec3::Y * 2.0, -1.0)));
    assert_eq!(quad(Vec3::Y * 2.0, -1.0), quad(Vec3::Y * 2.0, -2.0), "an edge on the slice, from below");
    assert!(quad(Vec3::Y * 2.0, 0.0).is_empty(), "from above");
    assert!(quad(Vec3::Y * 2.0, 1.0).is_empty() && quad(Vec3::Z, 0.0).is_empty());
}

#[test]
fn boxes_give_polygons() {
    let cuboid =
        |rotation: Vec3| Cuboid { min: Vec3::new(1.0, -1.0, 2.0), max: Vec3::splat(3.0), rotation, material: 0 };
    let outline = segments(&of_cuboid(cuboid(Vec3::ZERO)), &SEEN);
    assert_eq!(outline.len(), 4);
    for corner in [(1.0, 2.0), (3.0, 2.0), (1.0, 3.0), (3.0, 3.0)] {
        assert_eq!(outline.iter().flatten().filter(|p| **p == corner.into()).count(), 2, "{corner:?}");
    }
    // About x, its y edge of 4 comes to lie along z: z from 0.5 to 4.5 around 2.5, y from 0.5 to 1.5.
    let turned = of_cuboid(cuboid(Vec3::X * 90.0));
    assert!(segments(&turned, &SEEN).is_empty());
    let outline = segments(&turned, &Section { y: 1.0, ..SEEN });
    let far = |corner: DVec2| outline.iter().flatten().map(|p| p.distance(corner)).fold(f64::INFINITY, f64::min);
    assert!(far(DVec2::new(1.0, 0.5)) < 1e-12 && far(DVec2::new(3.0, 4.5)) < 1e-12, "{outline:?}");
}

#[test]
fn turned_boxes_are_cut_where_they_are() {
    let (mut dice, mut inside) = (Dice(1), 0);
    for _ in 0..200 {
        let min = dice.vector() * 4.0 - Vec3::splat(3.0);
        let max = min + Vec3::splat(3.0) + dice.vector() * 2.9;
        let cuboid = Cuboid { min, max, rotation: dice.vector() * 400.0, material: 0 };
        inside += check_outline(&of_cuboid(cuboid), &SEEN, |p| cuboid_distance(&cuboid, p));
    }
    assert!(inside > 100);
}

#[test]
fn upright_bodies_give_circles() {
    let (base, apex) = (Vec3::new(1.0, -1.0, 2.0), Vec3::new(1.0, 3.0, 2.0));
    let center = DVec2::new(1.0, 2.0);
    for caps in [false, true] {
        for (base, apex) in [(base, apex), (apex, base)] {
            let cylinder = of_cylinder(base, apex, 2.0, caps);
            assert_eq!(all(&cylinder, &SEEN), [Cut::Circle { center, radius: 2.0 }]);
            assert_eq!(all(&cylinder, &Section { y: 3.1, ..SEEN }), []);
        }
        let cone = of_cone(base, 2.0, apex, 0.0, caps);
        assert_eq!(all(&cone, &SEEN), [Cut::Circle { center, radius: 1.5 }]);
        assert_eq!(all(&cone, &Section { y: 3.0, ..SEEN }), [Cut::Circle { center, radius: 0.0 }]);
        assert_eq!(all(&cone, &Section { y: -1.1, ..SEEN }), []);
    }
    let torus = of_torus(Vec3::new(1.0, 3.0, 2.0), Vec3::Y * -7.0, 9.0, 5.0);
    let rings = [Cut::Circle { center, radius: 13.0 }, Cut::Circle { center, radius: 5.0 }];
    assert_eq!(all(&torus, &SEEN), rings);
    assert_eq!(all(&torus, &Section { y: 8.5, ..SEEN }), []);
}

#[test]
fn lying_bodies_give_lines() {
    let ends = (Vec3::new(-3.0, 0.6, 1.0), Vec3::new(2.0, 0.6, 1.0));
    let open = segments(&of_cylinder(ends.0, ends.1, 1.0, false), &SEEN);
    for [from, to] in &open {
        assert!((from.y - to.y).abs() < 1e-12 && ((from.y - 1.0).abs() - 0.8).abs() < 1e-6, "{from} {to}");
    }
    let length: f64 = open.iter().map(|[from, to]| from.distance(*to)).sum();
    assert!((length - 10.0).abs() < 1e-6, "{length}");
    let capped = segments(&of_cylinder(ends.0, ends.1, 1.0, true), &SEEN);
    let [cap, other] = capped[open.len()..] else { panic!("two caps") };
    for ([from, to], x) in [(cap, -3.0), (other, 2.0)] {
        assert!((from.x - x).abs() < 1e-6 && (to.x - x).abs() < 1e-6 && (from.distance(to) - 1.6).abs() < 1e-6);
    }
    assert!(segments(&of_cylinder(ends.0, ends.1, 0.5, true), &SEEN).is_empty());
}

#[test]
fn capped_bodies_are_cut_where_they_are() {
    let (mut dice, mut inside) = (Dice(2), 0);
    for i in 0..300 {
        let ends = [dice.vector() * 4.0, dice.vector() * 4.0];
        let radii = [[dice.between(0.1, 3.0); 2], [dice.between(0.1, 3.0), 0.0], [dice.between(0.0, 3.0), 3.1]][i % 3];
        let description = match i % 3 {
            0 => of_cylinder(ends[0], ends[1], radii[0], true),
            _ => of_cone(ends[0], radii[0], ends[1], radii[1], true),
        };
        inside += check_outline(&description, &SEEN, |p| {
            let [side, within] = side_distance(ends, radii, p);
            side.max(-within)
        });
    }
    assert!(inside > 100);
}

#[test]
fn open_bodies_have_no_caps() {
    let mut dice = Dice(3);
    let mut caps = 0;
    for _ in 0..200 {
        let ends = [dice.vector() * 4.0, dice.vector() * 4.0];
        let radii = [dice.between(0.1, 3.0), dice.between(0.0, 3.0)];
        let of = |caps| segments(&of_cone(ends[0], radii[0], ends[1], radii[1], caps), &SEEN);
        let (open, capped) = (of(false), of(true));
        assert_eq!(open, capped[..open.len()]);
        for p in open.iter().flatten() {
            let [side, within] = side_distance(ends, radii, DVec3::new(p.x, 0.0, p.y));
            assert!(side.abs() < 1e-6 && within > -1e-9, "{side} {within}");
        }
        for [from, to] in &capped[open.len()..] {
            let [side, within] = side_distance(ends, radii, DVec3::new(from.x + to.x, 0.0, from.y + to.y) / 2.0);
            assert!(side < 0.0 && within.abs() < 1e-9);
        }
        caps += capped.len() - open.len();
    }
    assert!(caps > 20);
}

#[test]
fn tori_are_cut_where_they_are() {
    let (mut dice, mut inside) = (Dice(4), 0);
    for i in 0..300 {
        let major = dice.between(0.5, 4.0);
        let minor = if i % 5 == 0 { major } else { major * dice.between(0.05, 1.0) };
        // Hardly tilted, and lying, as well.
        let axis = dice.vector() * [Vec3::ONE, Vec3::new(1e-6, 1.0, 1e-6), Vec3::new(1.0, 0.0, 1.0)][i % 3];
        let description = of_torus(dice.vector() * 4.0, axis, major, minor);
        inside += check_outline(&description, &SEEN, |p| torus_distance(&description.tori[0], p));
    }
    assert!(inside > 100);
}

#[test]
fn a_torus_about_to_part_is_drawn_sharply() {
    // With its axis lying or slanting: the slice touches the tube from inside at `height`, where the outline crosses
    // itself. Nearer to the middle it passes by in two bends.
    for axis in [Vec3::X, Vec3::new(1.0, 0.5, 0.2), Vec3::new(1.0, -2.0, 0.0)] {
        let description = of_torus(Vec3::ZERO, axis, 3.0, 1.0);
        let unit = axis.as_dvec3().normalize();
        let (level, along) = (unit.xz().length(), unit.xz().normalize());
        let height = level * 3.0 - 1.0;
        for below in [0.0, -1e-4, 1e-4, -1e-3, 1e-3, -0.01, 0.01] {
            let section = Section { y: height - below, ..SEEN };
            let distance = |p: DVec3| torus_distance(&description.tori[0], p);
            check_outline(&description, &section, distance);
            if below > 0.0 {
                let at = |w: f64| along * (-unit.y * 3.0) + along.perp() * w;
                let inside = |w: f64| distance(DVec3::new(at(w).x, section.y, at(w).y)) < 0.0;
                assert!(!inside(0.0) && inside(1.0));
                let halve = |(low, high): (f64, f64), _| {
                    let middle = (low + high) / 2.0;
                    if inside(middle) { (low, middle) } else { (middle, high) }
                };
                let bend = at((0..50).fold((0.0, 1.0), halve).0);
                let outline = segments(&description, &section);
                assert!(outline.iter().any(|[from, to]| from.distance(bend).min(to.distance(bend)) < 1e-6));
            }
        }
    }
}

#[test]
fn what_is_huge_is_as_sharp() {
    let mut dice = Dice(5);
    for i in 0..60 {
        // A surface close to the origin, of a body of 1e5 pixels: its own axis is far away.
        let (axis, side) = (dice.vector().normalize(), dice.vector());
        let out = (side - axis * side.dot(axis)).normalize();
        let (radius, offset) = (1000.0, dice.vector() * 2.0);
        let section = Section { radius: 5.0, ..SEEN };
        if i % 2 == 0 {
            let ends = [offset - out * radius - axis * 2000.0, offset - out * radius + axis * 2000.0];
            check_outline(&of_cylinder(ends[0], ends[1], radius, true), &section, |p| {
                let [side, within] = side_distance(ends, [radius; 2], p);
                side.max(-within)
            });
        } else {
            let description = of_torus(offset - out * 4.0 * radius, axis, 3.0 * radius, radius);
            check_outline(&description, &section, |p| torus_distance(&description.tori[0], p));
        }
    }
}

/// The definition, cube by cube.
fn in_sponge(fractal: &Fractal, p: DVec3) -> bool {
    let mut q = (p - fractal.center.as_dvec3()) / f64::from(fractal.radius);
    if q.abs().max_element() > 1.0 {
        return false;
    }
    (0..fractal.iterations).all(|_| {
        let middles = q.abs().cmplt(DVec3::splat(1.0 / 3.0));
        q = (q - (q * 1.5).round().clamp(-DVec3::ONE, DVec3::ONE) / 1.5) * 3.0;
        middles.bitmask().count_ones() < 2
    })
}

#[test]
fn sponges_are_cut_where_they_are() {
    let (mut dice, mut inside) = (Dice(6), 0);
    for i in 0..60 {
        let description = of_fractal(dice.vector() * 3.0, dice.between(1.0, 6.0), i % 5);
        let fractal = description.fractals[0];
        let outline = segments(&description, &SEEN);
        assert!(outline.iter().all(|[from, to]| from.x == to.x || from.y == to.y));
        for _ in 0..100 {
            let p = dice.flat(9.0);
            // A slanting line outward.
            let q = DVec2::new(31.4, 27.1);
            let left = |p: DVec2, q: DVec2, r: DVec2| (q - p).perp_dot(r - p) > 0.0;
            let crossed = |[a, b]: &&[DVec2; 2]| left(p, q, *a) != left(p, q, *b) && left(*a, *b, p) != left(*a, *b, q);
            let odd = outline.iter().filter(crossed).count() % 2 == 1;
            assert_eq!(odd, in_sponge(&fractal, DVec3::new(p.x, 0.0, p.y)), "{p} {fractal:?}");
            inside += usize::from(odd);
        }
    }
    assert!(inside > 300);
}

#[test]
fn sponges_have_the_lines_of_their_iterations() {
    let count = |y: f64, iterations, pixel| {
        let section = Section { y, pixel, ..SEEN };
        segments(&of_fractal(Vec3::ZERO, 1.0, iterations), &section).len()
    };
    assert_eq!(count(0.5, 0, 0.001), 4);
    assert_eq!((count(0.5, 1, 0.001), count(0.0, 1, 0.001)), (8, 16), "one hole, four corners");
    assert_eq!(count(0.9, 2, 0.001), 4 + 4 * 9);
    assert_eq!(count(0.9, 8, 2.0 / 27.0 / 3.0), count(0.9, 3, 1e-3), "cells of three pixels");
    assert_eq!(count(0.9, 8, 1.0), 4, "cells of less");
    assert_eq!((count(1.0, 0, 0.1), count(-1.0, 0, 0.1), count(1.01, 0, 0.1)), (4, 0, 0));
}

#[test]
fn what_is_not_seen_is_not_drawn() {
    let near = Section { radius: 1.0, center: DVec2::new(50.0, 0.0), ..SEEN };
    let cuboid = Cuboid { min: Vec3::NEG_ONE, max: Vec3::ONE, rotation: Vec3::ZERO, material: 0 };
    for description in [
        of_cuboid(cuboid),
        of_cylinder(-Vec3::ONE, Vec3::ONE, 1.0, true),
        of_cone(-Vec3::ONE, 1.0, Vec3::ONE, 0.0, true),
        of_torus(Vec3::ZERO, Vec3::ONE, 2.0, 1.0),
        of_fractal(Vec3::ZERO, 1.0, 8),
        of_disc(Vec3::ZERO, Vec3::ONE, 2.0, 1.0),
    ] {
        assert!(!all(&description, &SEEN).is_empty());
        for section in [near, Section { y: 9.0, ..SEEN }] {
            assert_eq!(all(&description, &section), []);
        }
    }
    // Two rows of cells, of all the 6561.
    let section = Section { radius: 0.4, center: DVec2::new(1e6, 0.0), pixel: 0.01, y: 1e6 };
    assert!((1..100).contains(&all(&of_fractal(Vec3::ZERO, 1e6, 8), &section).len()));
}

#[test]
fn extremes_are_numbers() {
    let wild = [0.0, 1e-45, 1e-12, 1.0, -1e12, 1e18, f32::MAX, f32::INFINITY, f32::NAN];
    let mut sections: Vec<Section> = [0.0, 1e-300, 1.0, 1e300, f64::INFINITY, f64::NAN]
        .map(|radius| Section { radius, pixel: radius / 100.0, ..SEEN })
        .into();
    sections.push(Section { y: f64::NAN, center: DVec2::NAN, ..SEEN });
    for a in wild {
        for b in wild {
            for c in wild {
                let (p, q) = (Vec3::new(a, b, -c), Vec3::new(-b, c, a));
                let sides = [of_cylinder(p, q, c.abs(), true), of_cone(p, a.abs(), q, b.abs(), true)];
                let cuboid = of_cuboid(Cuboid { min: p, max: q, rotation: Vec3::splat(c), material: 0 });
                let quads = vec![Quad { corner: p, u: q, v: q.zxy(), material: 0 }];
                let [open, cone] = sides;
                let disc = of_disc(p, q, a.abs(), b.abs());
                let rest = [of_torus(p, q, a.abs(), b.abs()), of_fractal(p, c.abs(), 8), disc];
                for description in
                    rest.into_iter().chain([open, cone, cuboid, Description { quads, ..Description::default() }])
                {
                    for section in &sections {
                        let cuts = all(&description, section);
                        assert!(cuts.len() < 10_000, "{}", cuts.len());
                    }
                }
            }
        }
    }
}
