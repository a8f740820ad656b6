//! Surfaces that are only there on one side, against the reference: what a ray passes through, what it meets then, and
//! that light is stopped by either side.

use glam::{Vec3, vec3};
use raypacket::reference::Tracer;
use raypacket::scene::{Description, Mesh, Sides};
use raypacket::trace::Probe;

use crate::common::{Pcg, ROUNDOFF, compiled, empty, lit, sphere};

const ALL_SIDES: [Sides; 3] = [Sides::Both, Sides::Front, Sides::Back];

/// Where the thing with sides is.
const CENTER: Vec3 = Vec3::new(0.25, -0.5, 1.125);

/// The radius of the shell around everything, about [`CENTER`]: what is behind.
const SHELL: f32 = 20.0;

/// The shell, seen from both sides; its id is 0.
fn shell() -> Description {
    let mut scene = empty();
    scene.spheres.push(sphere(CENTER, SHELL));
    scene
}

/// An octahedron |x| + |y| + |z| = 1 about [`CENTER`]; its front is outside, or where `inward` inside.
fn octahedron(sides: Sides, inward: bool) -> Mesh {
    let mut mesh = Mesh { sides, ..Mesh::default() };
    for i in 0..8 {
        let sign = |bit: u32| if i >> bit & 1 == 1 { -1.0 } else { 1.0 };
        let [x, y, z] = [Vec3::X * sign(0), Vec3::Y * sign(1), Vec3::Z * sign(2)].map(|v| v + CENTER);
        let first = mesh.positions.len() as u32;
        mesh.positions.extend([x, y, z]);
        let outward = sign(0) * sign(1) * sign(2) > 0.0;
        mesh.triangles.push(if outward != inward {
            [first, first + 1, first + 2]
        } else {
            [first, first + 2, first + 1]
        });
    }
    mesh
}

/// What a ray meets first.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Met {
    /// The thing, where the ray comes from outside.
    Outside,
    /// The thing, where the ray comes from inside.
    Inside,
    Shell,
}

/// What a ray meets that starts outside, or inside, where these sides are there.
fn expected(from_inside: bool, outside: bool, inside: bool) -> Met {
    match (from_inside, outside, inside) {
        (false, true, _) => Met::Outside,
        (_, _, true) => Met::Inside,
        _ => Met::Shell,
    }
}

/// Shoots rays through the thing from outside and from inside; `clear` says whether a point of its surface, from
/// [`CENTER`], is clear of what rounding decides.
fn check(scene: &Description, outside: bool, inside: bool, clear: impl Fn(Vec3) -> bool) {
    let (compiled, tracer, mut probe) = (compiled(scene), Tracer::new(scene), Probe::default());
    let whole = Tracer::new(&lit(scene).unwrap_or_else(|| scene.clone()));
    let mut rng = Pcg::new(12);
    let mut counts = [0; 2];
    for i in 0..4000 {
        let from_inside = i % 2 == 1;
        let direction = rng.unit();
        let within = CENTER + rng.cube() * 0.3;
        let origin = if from_inside { within } else { within - direction * rng.range(2.0, 15.0) };
        let (o, d) = (origin.as_dvec3(), direction.as_dvec3());
        let along = |t: f64| (o + d * t - CENTER.as_dvec3()).as_vec3();
        // All that the ray passes, there or not: the reference's own distances.
        let passed = (1..scene.primitives() as u32).filter_map(|id| whole.distance(id, o, d));
        if !passed.clone().all(|t| clear(along(t))) {
            continue;
        }
        counts[usize::from(from_inside)] += 1;
        let truth = tracer.intersect(o, d, f64::INFINITY).expect("the shell at least");
        let met = match truth.primitive {
            0 => Met::Shell,
            _ if d.dot(along(truth.t).as_dvec3()) < 0.0 => Met::Outside,
            _ => Met::Inside,
        };
        assert_eq!(met, expected(from_inside, outside, inside), "the reference: {origin} {direction}");
        let hit = probe.intersect(&compiled, origin, direction).expect("the shell at least");
        assert_eq!(hit.primitive, truth.primitive, "{origin} {direction}");
        let size = o.length() + truth.t + f64::from(if hit.primitive == 0 { SHELL } else { 1.0 });
        let bound = 16.0 * ROUNDOFF * size / truth.normal.dot(d).abs();
        assert!((f64::from(hit.t) - truth.t).abs() <= bound, "{} not {}: {origin} {direction}", hit.t, truth.t);
        let stop = whole.intersect(o, d, f64::INFINITY).expect("the shell at least").t;
        for share in [0.5, 0.999, 1.001, 2.0] {
            let t_max = (stop * share) as f32;
            let blocked = probe.occluded(&compiled, origin, direction, t_max);
            assert_eq!(blocked, share > 1.0, "up to {t_max}: {origin} {direction}");
            assert_eq!(blocked, tracer.blocked(o, d, f64::from(t_max)), "the reference");
        }
    }
    assert!(counts.iter().all(|&n| n > 1000), "{counts:?}");
}

#[test]
fn spheres() {
    for sides in ALL_SIDES {
        let mut scene = shell();
        scene.spheres.push(raypacket::scene::Sphere { sides, ..sphere(CENTER, 1.0) });
        check(&scene, sides != Sides::Back, sides != Sides::Front, |_| true);
    }
}

#[test]
fn meshes_of_either_winding() {
    for sides in ALL_SIDES {
        for inward in [false, true] {
            let mut scene = shell();
            scene.meshes.push(octahedron(sides, inward));
            let [front, back] = [sides != Sides::Back, sides != Sides::Front];
            let [outside, inside] = if inward { [back, front] } else { [front, back] };
            // The edges are where a coordinate is 0.
            check(&scene, outside, inside, |p| p.abs().min_element() > 0.02);
        }
    }
}

/// One behind the other: a ray passes through all the sides that are not there, up to the first that is.
#[test]
fn through_many() {
    let mut scene = empty();
    for i in 0..9 {
        let z = -f32::from(i as u8);
        let corners = [vec3(-4.0, -3.0, z), vec3(4.0, -3.0, z), vec3(0.0, 5.0, z)];
        // From the front but for the last.
        let sides = if i == 8 { Sides::Front } else { Sides::Back };
        scene.meshes.push(Mesh { sides, ..crate::common::mesh(&[corners]) });
    }
    let (compiled, mut probe) = (compiled(&scene), Probe::default());
    let hit = probe.intersect(&compiled, vec3(0.1, 0.2, 3.0), Vec3::NEG_Z).unwrap();
    assert_eq!((hit.t, hit.primitive), (11.0, 8));
    assert!(!probe.occluded(&compiled, vec3(0.1, 0.2, 3.0), Vec3::NEG_Z, 3.0));
    assert!(probe.occluded(&compiled, vec3(0.1, 0.2, 3.0), Vec3::NEG_Z, 3.5), "light by the first");
    let hit = probe.intersect(&compiled, vec3(0.1, 0.2, -20.0), Vec3::Z).unwrap();
    assert_eq!((hit.t, hit.primitive), (13.0, 7), "through the last one's back");
}
