//! Settled and unsettled hits, by clearances known by hand.
use super::*;

const W: f64 = 1.0 / 1024.0;

fn decided(shape: &Shape, origin: Vec3, direction: Vec3) -> bool {
    settled(shape, &Ray::new(origin, direction), 0.0, f64::INFINITY, W)
}

/// From twice the width inside to twice outside of a silhouette. What is nearer than `W` must be undecided; what is farther
/// than the samples' circle must not.
#[test]
fn silhouettes() {
    let round = sphere(Vec3::ZERO, 1.0);
    let ring = torus(2.0, 1.0);
    let quad = Shape::Quad(Quad { corner: vec3(-1.0, -1.0, 0.0), u: Vec3::X * 2.0, v: Vec3::Y * 2.0, material: 0 });
    let small = sphere(Vec3::ZERO, 2.0 * W as f32);
    silhouettes_at(&[(round, 1.0), (ring.clone(), 3.0), (ring, 1.0), (quad, 1.0), (small, 2.0 * W as f32)]);
}

#[test]
fn silhouettes_of_discs() {
    let disc = Shape::Disc(Disc { center: Vec3::ZERO, normal: Vec3::Z, radius: 3.0, inner_radius: 1.0, material: 0 });
    silhouettes_at(&[(disc.clone(), 3.0), (disc, 1.0)]);
}

/// Of shapes about z, so far from it.
fn silhouettes_at(shapes: &[(Shape, f32)]) {
    let down = -Vec3::Z;
    for &(ref shape, edge) in shapes {
        for angle in 0..7 {
            let angle = angle as f32;
            // A quad's silhouette is met across it, at any height.
            let around = match shape {
                Shape::Quad(_) => vec3(edge, 0.9 * (angle / 3.5 - 1.0), 5.0),
                _ => vec3(edge * angle.cos(), edge * angle.sin(), 5.0),
            };
            let across = match shape {
                Shape::Quad(_) => Vec3::X,
                _ => vec3(angle.cos(), angle.sin(), 0.0),
            };
            for clearance in [-1.9f32, -1.1, -0.98, -0.5, 0.0, 0.5, 0.98, 1.1, 1.9] {
                let origin = around + across * (clearance * W as f32);
                assert_eq!(decided(shape, origin, down), clearance.abs() > 1.05, "{clearance} {around} {shape:?}");
            }
        }
    }
}

/// The ends of the interval, and what is thin or pointed enough to slip between the samples.
#[test]
fn ends_corners_and_slivers() {
    let floor = Shape::Plane(Plane { normal: Vec3::Y, distance: 0.0, material: 0 });
    for (t_max, expected) in
        [(1.0 - 2.0 * W, true), (1.0 - 0.9 * W, false), (1.0 + 0.9 * W, false), (1.0 + 2.0 * W, true)]
    {
        // A direction of length 2 passes W in half the t.
        for (speed, normalized) in [(1.0, false), (2.0, false), (2.0, true)] {
            let ray = Ray { origin: Vec3::Y, direction: Vec3::NEG_Y * speed, normalized };
            let end = if normalized { t_max } else { t_max / f64::from(speed) };
            assert_eq!(settled(&floor, &ray, 0.0, end, W), expected, "{t_max} {ray:?}");
        }
    }
    // A needle's tip and a needle's middle, half a width beside the ray: no sample meets them.
    let w = W as f32;
    let needle = |tip: Vec3| {
        Shape::Triangle(Triangle {
            corners: [tip, tip + vec3(3.0, 0.01 * w, 0.0), tip + vec3(3.0, -0.01 * w, 0.0)],
            sides: Sides::Both,
        })
    };
    let fan = |tip: Vec3| {
        Shape::Triangle(Triangle {
            corners: [tip, tip + vec3(3.0, 0.4, 0.0), tip + vec3(3.0, -0.4, 0.0)],
            sides: Sides::Both,
        })
    };
    for slip in [fan(vec3(0.9 * w, 0.0, 0.0)), needle(vec3(0.9 * w, 0.0, 0.0)), needle(vec3(-1.5, 0.5 * w, 0.0))] {
        assert!(ahead(&slip, Vec3::Z, -Vec3::Z).is_none());
        assert!(!decided(&slip, Vec3::Z, -Vec3::Z), "{slip:?}");
    }
    assert!(decided(&fan(vec3(1.1 * w, 0.0, 0.0)), Vec3::Z, -Vec3::Z));
    let thread = |y: f32| {
        let (base, apex) = (vec3(-1.0, y, 0.0), vec3(1.0, y, 0.0));
        Shape::Cylinder(Cylinder { base, apex, radius: 0.01 * w, caps: true, sides: Sides::Both, material: 0 })
    };
    assert!(!decided(&thread(0.5 * w), Vec3::Z, -Vec3::Z) && decided(&thread(3.0), Vec3::Z, -Vec3::Z));
    let pin = |x: f32| {
        let (base, apex, sides) = (vec3(x + 3.0, 0.0, 0.0), vec3(x, 0.0, 0.0), Sides::Both);
        Shape::Cone(Cone { base, apex, base_radius: 0.3, apex_radius: 0.0, caps: false, sides, material: 0 })
    };
    assert!(!decided(&pin(0.9 * w), Vec3::Z, -Vec3::Z) && decided(&pin(1.1 * w), Vec3::Z, -Vec3::Z));
    // What is round and pierced is no corner, unless hole or end are less than the width.
    let (base, apex, caps, sides) = (Vec3::Z, Vec3::ZERO, false, Sides::Both);
    let frustum = Cone { base, apex, base_radius: 0.2, apex_radius: 0.1, caps, sides, material: 0 };
    let horn = torus(1.0, 1.0);
    let through = |x: f32| (vec3(x, 0.0, 5.0), -Vec3::Z);
    for (shape, closed) in [(Shape::Cone(frustum), false), (torus(2.0, 1.0), false), (horn, true)] {
        let [(middle, down), (beside, _)] = [0.0, 0.05].map(through);
        assert_eq!(decided(&shape, middle, down), !closed, "{shape:?}");
        assert!(decided(&shape, beside, down), "{shape:?}");
    }
    assert!(!settled(&floor, &Ray::new(Vec3::Y, Vec3::NEG_Y), 0.0, 9.0, f64::NAN));
    let corner = |x: f32| {
        // Seen along z, a corner of 90° at (x, 0).
        let half = Vec3::splat(1.0);
        let center = vec3(x + 2f32.sqrt(), 0.0, 0.0);
        Shape::Cuboid(Cuboid { min: center - half, max: center + half, rotation: vec3(0.0, 0.0, 45.0), material: 0 })
    };
    assert!(!decided(&corner(0.9 * w), 5.0 * Vec3::Z, -Vec3::Z) && decided(&corner(1.2 * w), 5.0 * Vec3::Z, -Vec3::Z));
}

/// All t of rays nearby: on a slope of 45° they differ by the width to either side; where a ray nearby passes something
/// in front, by much more.
#[test]
fn the_range_of_t() {
    let slope = Shape::Plane(Plane { normal: vec3(0.0, 1.0, 1.0), distance: 0.0, material: 0 });
    let Answers::Hit { low, high } = around(&slope, &Ray::new(Vec3::Z, -Vec3::Z), 0.0, 9.0, W) else { panic!("a hit") };
    assert!(
        (0.99 * W..1.05 * W).contains(&(1.0 - low)) && (0.99 * W..1.05 * W).contains(&(high - 1.0)),
        "{low} {high}"
    );
    let ray = Ray::new(vec3(-5.0, 0.0, 1.0 + 0.5 * W as f32), vec3(1.0, 0.0, -0.01));
    let Answers::Hit { low, high } = around(&torus(2.0, 1.0), &ray, 0.0, 99.0, W) else { panic!("a hit") };
    assert!(high - low < 1.0, "{low} {high}");
    let grazing = Ray::new(vec3(-5.0, 0.0, 1.0 + 0.5 * W as f32 + 0.0), vec3(1.0, 0.0, -0.0));
    assert_eq!(around(&torus(2.0, 1.0), &grazing, 0.0, 99.0, W), Answers::Mixed);
}

/// Whatever the answer nearby, the ray's own is one of them.
#[test]
fn the_rays_own_answer_is_among_them() {
    let mut random = Random(41);
    for i in 0..300 {
        let (shape, ray) = (random.shape(i % KINDS), random.ray());
        let truth = nearest(&shape, &ray, 0.0, 1e9);
        match around(&shape, &ray, 0.0, 1e9, 1e-4) {
            Answers::Hit { low, high } => {
                let truth = truth.expect("all hit");
                assert!((low..=high).contains(&truth.t));
            }
            Answers::Miss => assert_eq!(truth, None, "{shape:?} {ray:?}"),
            Answers::Mixed => {}
        }
    }
}

/// A hole and a ring that are thin enough to slip between the samples.
#[test]
fn discs_with_small_holes_and_thin_rings() {
    let w = W as f32;
    let disc = |radius: f32, inner_radius: f32| {
        Shape::Disc(Disc { center: Vec3::ZERO, normal: Vec3::Z, radius, inner_radius, material: 0 })
    };
    let beside = |x: f32| vec3(x, 0.0, 1.0);
    assert!(!decided(&disc(1.0, 0.01 * w), beside(0.5 * w), -Vec3::Z), "the hole is near");
    assert!(decided(&disc(1.0, 0.01 * w), beside(1.5 * w), -Vec3::Z), "the hole is far");
    assert!(decided(&disc(1.0, 0.0), beside(0.5 * w), -Vec3::Z), "no hole");
    assert!(!decided(&disc(1.0, 1.0 - 0.01 * w), beside(1.0 - 0.5 * w), -Vec3::Z), "the ring is near");
    assert!(decided(&disc(1.0, 0.01 * w), beside(1.0 + 1.5 * w), -Vec3::Z), "all is far");
}
