//! Rays that leave a surface as the shading lets them: none meets what it left, none leaks through.

use glam::Vec3;
use rayon::prelude::*;
use raypacket::measure::cases::{Ray, find};
use raypacket::measure::oracle::{self, Shape, Truth, nearest, shapes};
use raypacket::scene::{Description, Fractal, Scene};

use crate::common::{Pcg, ROUNDOFF, empty, part_of};
use crate::{at, compiled, surface, trace};

/// Rays of one primitive: one pose, one size.
const POSE: usize = 512;

/// Sizes, in world units: 10⁻⁸ to 10⁸.
const SIZES: i32 = 17;

/// Least |cos θ| of a ray that leaves: flatter ones are a matter of the normal's rounding.
const STEEP: f32 = 0.01;

/// What came of the rays of a kind.
#[derive(Clone, Copy, Debug, Default)]
struct Count {
    /// Rays that left to the side of the normal, and those that met what they left.
    out: usize,
    met: usize,
    /// Rays that went to the other side, and those that leaked: out of a body, or back to a flat thing.
    inward: usize,
    leaked: usize,
}

impl Count {
    fn plus(self, other: Self) -> Self {
        Self {
            out: self.out + other.out,
            met: self.met + other.met,
            inward: self.inward + other.inward,
            leaked: self.leaked + other.leaked,
        }
    }
}

/// A ray off the surface.
struct Spawned {
    ray: Ray,
    /// What it left.
    point: Vec3,
    normal: Vec3,
    lift: f32,
    outward: bool,
}

/// One primitive of a kind, and eye rays that look at it from outside: from 0.1 to 10 sizes away.
fn pose(kind: &str, size: f64, seed: u64) -> (Description, Vec<Ray>) {
    let mut rng = Pcg::new(seed);
    let mut back = |(to, direction): (Vec3, Vec3)| {
        let origin = to + direction * (size * 10f64.powf(rng.between(-1.0, 1.0))) as f32;
        Ray { origin, direction: -direction, t_min: 0.0, t_max: f32::INFINITY }
    };
    if kind == "fractal" {
        let mut rng = Pcg::new(!seed);
        let (center, radius, iterations) = (rng.cube() * (2.0 * size) as f32, size as f32, 1 + rng.below(4) as u32);
        let description =
            Description { fractals: vec![Fractal { center, radius, iterations, material: 0 }], ..empty() };
        let mut target = |_| (center + rng.cube() * (0.95 * radius), rng.unit());
        // From outside the cube.
        let rays = (0..POSE).map(&mut target).map(|(to, d)| back((to + d * (3.5 * radius), d))).collect();
        return (description, rays);
    }
    let case = find(&format!("{kind}-leaving")).expect("a case").make(size, 2 * POSE, seed);
    let outward = case.rays.iter().step_by(2).map(|ray| back((ray.origin, ray.direction))).collect();
    (case.description, outward)
}

/// Rays off where the eye rays hit, by the lift of secondary rays: ε (8 reach + 9 M), M the point's largest coordinate.
fn spawn(scene: &Scene, shape: &Shape, eyes: &[Ray], rng: &mut Pcg) -> Vec<Spawned> {
    let mut spawned = Vec::with_capacity(eyes.len());
    for (eye, found) in eyes.iter().zip(trace(scene, eyes)) {
        let Some((t, id)) = found else { continue };
        let surface = surface(scene, shape, id, at(eye, t));
        let (point, mut normal) = (Vec3::from(surface.point), Vec3::from(surface.normal));
        if normal.dot(eye.direction) > 0.0 {
            // Met from inside, or so flatly that rounding decides the side.
            if !is_flat(shape) {
                continue;
            }
            normal = -normal;
        }
        let lift = ROUNDOFF as f32 * (8.0 * surface.reach + 9.0 * point.abs().max_element());
        let outward = rng.chance(0.5);
        let side = if outward { normal } else { -normal };
        let direction = loop {
            let d = rng.unit();
            let cosine = d.dot(side);
            if cosine.abs() >= STEEP {
                break d * cosine.signum();
            }
        };
        let ray = Ray { origin: point + side * lift, direction, t_min: 0.0, t_max: f32::INFINITY };
        spawned.push(Spawned { ray, point, normal, lift, outward });
    }
    spawned
}

fn is_flat(shape: &Shape) -> bool {
    matches!(shape, Shape::Plane(_) | Shape::Triangle(_) | Shape::Quad(_) | Shape::Disc(_))
}

/// Whether a hit at `t` of a ray that left outward is one of what it left.
fn meets_itself(scene: &Scene, shape: &Shape, spawned: &Spawned, t: f32) -> bool {
    let cosine = spawned.ray.direction.dot(spawned.normal);
    match shape {
        // The surface bends towards the ray by no more than a circle of the hole's radius, of which this is half the
        // chord.
        Shape::Torus(it) => t < (it.major_radius - it.minor_radius) * cosine,
        // The ray leaves the plane of its face for good.
        Shape::Fractal(_) => {
            let hit = surface(scene, shape, 0, at(&spawned.ray, t));
            let apart = Vec3::from(hit.point) - spawned.point;
            Vec3::from(hit.normal).dot(spawned.normal).abs() > 0.5
                && apart.dot(spawned.normal).abs() < 4.0 * spawned.lift
        }
        _ => true,
    }
}

/// Whether a ray into a body ends at its far side, and one to the other side of something flat at nothing.
///
/// Within rounding of an edge the point may be beside the face around the corner, and the ray starts out there: it enters
/// by that face, which is nearer than a lift. It leaks when the truth has it enter and the tracer does not.
fn goes_through(scene: &Scene, shape: &Shape, spawned: &Spawned, found: Option<f32>) -> bool {
    if is_flat(shape) {
        return found.is_none();
    }
    let (ray, Some(t)) = (&spawned.ray, found) else { return false };
    let normal = Vec3::from(surface(scene, shape, 0, at(ray, t)).normal);
    // Next to an edge the surface found may be the wrong face: the truth tells whether the body ends there.
    let truth = || nearest(shape, &oracle::Ray::new(ray.origin, ray.direction), 0.0, f64::INFINITY);
    let ends = |truth: Truth| {
        let off = (truth.t - f64::from(t)).abs();
        let (lift, cosine) = (f64::from(spawned.lift), truth.normal.dot(ray.direction.as_dvec3()));
        off < lift && (cosine > 0.0 || -cosine * truth.t < lift)
    };
    normal.dot(ray.direction) > 0.0 || truth().is_some_and(ends)
}

fn count(kind: &str, size: f64, seed: u64) -> Count {
    let (description, eyes) = pose(kind, size, seed);
    let scene = compiled(&description);
    let shape = &shapes(&description)[0];
    let mut rng = Pcg::new(seed);
    let spawned = spawn(&scene, shape, &eyes, &mut rng);
    let rays: Vec<_> = spawned.iter().map(|s| s.ray).collect();
    let mut count = Count::default();
    for (spawned, found) in spawned.iter().zip(trace(&scene, &rays)) {
        let t = found.map(|(t, _)| t);
        let wrong = if spawned.outward {
            let met = t.is_some_and(|t| meets_itself(&scene, shape, spawned, t));
            count.out += 1;
            count.met += usize::from(met);
            met
        } else {
            let leaked = !goes_through(&scene, shape, spawned, t);
            count.inward += 1;
            count.leaked += usize::from(leaked);
            leaked
        };
        if wrong && count.met + count.leaked == 1 {
            let Spawned { ray, point, normal, .. } = spawned;
            println!("{kind} of {size:e}, seed {seed}: {ray:?} from {point} with normal {normal}: {t:?} of {shape:?}");
            println!(
                "  in truth {:?}",
                nearest(shape, &oracle::Ray::new(ray.origin, ray.direction), 0.0, f64::INFINITY)
            );
        }
    }
    count
}

/// About so many eye rays at every kind, and a ray off each hit.
fn check(rays: usize) {
    println!("| kind | rays that leave | meet what they left | rays to the other side | leak |");
    println!("|---|---|---|---|---|");
    let mut wrong = 0;
    for kind in ["plane", "sphere", "triangle", "quad", "box", "cylinder", "cone", "torus", "fractal", "disc"] {
        let poses = (rays.div_ceil(POSE) as u64).next_multiple_of(SIZES as u64);
        let of = |seed: u64| count(kind, 10f64.powi((seed % SIZES as u64) as i32 - SIZES / 2), seed);
        let all = (0..poses).into_par_iter().map(of).reduce(Count::default, Count::plus);
        println!("| {kind} | {} | {} | {} | {} |", all.out, all.met, all.inward, all.leaked);
        wrong += all.met + all.leaked;
        assert!(all.out + all.inward > rays / 2, "{kind}: the eye rays see nothing");
    }
    assert_eq!(wrong, 0);
}

#[test]
fn nothing_meets_what_it_left() {
    check(100_000);
}

/// The same with ten million eye rays a kind: minutes, on one thread of a development build, too.
#[test]
#[ignore = "takes minutes; for a release build"]
fn nothing_meets_what_it_left_in_full() {
    check(part_of(10_000_000));
}
