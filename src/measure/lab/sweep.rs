//! The epsilon sweep: how far off a surface rays should start, at every scale of the scene.

use std::f64::consts::TAU;

use glam::{DVec3, Vec3};
use rayon::prelude::*;

use super::Budget;
use super::batches;
use super::errors::per_million;
use crate::geometry::Primitives;
use crate::geometry::methods::{Methods, OffsetMethod};
use crate::math;
use crate::measure::cases::Ray;
use crate::measure::random::Pcg;
use crate::scene::{Cuboid, Cylinder, Description, Invalid, Material, Mesh, Plane, Scene, Sides, Sphere, Structure};
use crate::scene::{compile_with, with_primitive};
use crate::shade::Offsets;
use crate::trace::Hit;

/// Scales of the scene, as powers of ten.
const SCALES: std::ops::RangeInclusive<i32> = -6..=6;

/// Fixed epsilons, as powers of ten.
const FIXED: std::ops::RangeInclusive<i32> = -7..=-2;

/// Gaps between a surface and its occluder, as powers of ten in sizes of the scene.
pub const GAPS: [f64; 2] = [-5.0, -1.0];

/// Gaps tried.
const GAP_COUNT: usize = 9;

/// How far off rays start.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Offset {
    /// By one of the program's methods.
    Method(OffsetMethod),
    /// By so many world units.
    Fixed(f32),
}

impl Offset {
    fn offsets(self) -> Offsets {
        match self {
            Self::Method(offset) => Offsets::of(&Methods { offset, ..Methods::default() }),
            Self::Fixed(epsilon) => Offsets::fixed(epsilon),
        }
    }
}

/// One offset at every scale.
#[derive(Clone, Debug, PartialEq)]
pub struct OffsetCurve {
    /// How far off rays start.
    pub offset: Offset,
    /// Rays a million that meet the convex thing that they leave, by scale.
    pub acne: Vec<f64>,
    /// Rays a million that start beyond what is close by, or pass through it, by scale.
    pub leaks: Vec<f64>,
}

/// The findings of the sweep.
#[derive(Clone, Debug, PartialEq)]
pub struct Sweep {
    /// Sizes of the scene, world units.
    pub scales: Vec<f64>,
    /// By offset: the derived one, other methods, fixed ones from the least on.
    pub curves: Vec<OffsetCurve>,
    /// Rays spawned for every offset and scale: for acne, and for leaks.
    pub rays: [usize; 2],
}

/// Spawns rays from the hits of eye rays in scenes of all scales, in the caller's rayon pool.
///
/// Acne is counted on what is convex: a sphere, a plane, a triangle, a box and a closed cylinder, each alone, so that
/// whatever a ray meets that leaves it is wrong. Leaks are counted with an occluder between 10⁻⁵ and 10⁻¹ of the scene's
/// size away from the surface, which every ray has to meet: a greater sphere around a sphere, a plane beside a plane.
/// Things lie within 4 sizes of the world's origin.
///
/// # Errors
/// [`Invalid`] when a scene does not compile; these do.
pub fn sweep(budget: &Budget, progress: &(dyn Fn(f32) + Sync)) -> Result<Sweep, Invalid> {
    let methods = [OffsetMethod::Derived, OffsetMethod::None, OffsetMethod::Scaled].map(Offset::Method);
    let fixed = FIXED.map(|power| Offset::Fixed(10f32.powi(power)));
    let offsets: Vec<Offset> = methods.into_iter().chain(fixed).collect();
    let scales: Vec<f64> = SCALES.map(|power| 10f64.powi(power)).collect();
    let each = |(k, scale): (usize, &f64)| {
        let found = at_scale(*scale, &offsets, budget.spawned);
        progress((k + 1) as f32 / scales.len() as f32);
        found
    };
    let found: Vec<Vec<[Count; 2]>> = scales.par_iter().enumerate().map(each).collect::<Result<_, _>>()?;
    let curve = |(i, &offset): (usize, &Offset)| OffsetCurve {
        offset,
        acne: found.iter().map(|counts| counts[i][0].rate()).collect(),
        leaks: found.iter().map(|counts| counts[i][1].rate()).collect(),
    };
    let rays = [0, 1].map(|kind| found.iter().flatten().map(|counts| counts[kind].all).min().unwrap_or(0));
    Ok(Sweep { curves: offsets.iter().enumerate().map(curve).collect(), scales, rays })
}

/// So many wrong rays of all.
#[derive(Clone, Copy, Debug, Default)]
struct Count {
    wrong: usize,
    all: usize,
}

impl Count {
    /// Wrong ones a million.
    fn rate(&self) -> f64 {
        per_million(self.wrong, self.all)
    }

    /// Adds rays, of which those that are blocked, or those that are not, are wrong.
    fn add(&mut self, scene: &Scene, rays: &[Ray], wrong: bool) {
        self.wrong += batches::blocked(scene, rays).into_iter().filter(|&blocked| blocked == wrong).count();
        self.all += rays.len();
    }
}

/// Acne and leaks, by offset.
fn at_scale(scale: f64, offsets: &[Offset], spawned: usize) -> Result<Vec<[Count; 2]>, Invalid> {
    let mut rng = Pcg::new(17);
    let center = rng.direction() * (3.0 * scale);
    let convex = things(center, scale, &mut rng);
    let share = spawned.div_ceil(2 * convex.len());
    let mut acne = vec![Count::default(); offsets.len()];
    for description in &convex {
        let scene = compile_with(description, &Structure::None.into())?;
        let departures = departures(&scene, center, scale, share, &mut rng);
        for (offset, count) in offsets.iter().zip(&mut acne) {
            count.add(&scene, &spawn(&departures, *offset), true);
        }
    }
    let mut leaks = vec![Count::default(); offsets.len()];
    let share = spawned.div_ceil(2 * 2 * GAP_COUNT);
    for description in &convex[..2] {
        let scene = compile_with(description, &Structure::None.into())?;
        for k in 0..GAP_COUNT {
            let power = GAPS[0] + (GAPS[1] - GAPS[0]) * k as f64 / (GAP_COUNT - 1) as f64;
            let departures = departures(&scene, center, scale, share, &mut rng);
            // On which side of a plane an occluder lies is the eye's: those of one side at a time.
            let (front, back): (Vec<Departure>, Vec<Departure>) = departures.into_iter().partition(|d| d.front);
            for (side, departures) in [(1.0, front), (-1.0, back)] {
                let occluder = beyond(description, 10f64.powf(power) * scale * side);
                let occluder = compile_with(&occluder, &Structure::None.into())?;
                for (offset, count) in offsets.iter().zip(&mut leaks) {
                    count.add(&occluder, &spawn(&departures, *offset), false);
                }
            }
        }
    }
    Ok(acne.into_iter().zip(leaks).map(|(acne, leaks)| [acne, leaks]).collect())
}

/// A sphere, a plane, a triangle, a box and a cylinder of size `scale` at `center`, each in a scene of its own.
fn things(center: DVec3, scale: f64, rng: &mut Pcg) -> Vec<Description> {
    let empty = || Description { materials: vec![Material::default()], ..Description::default() };
    let at = |v: DVec3| (center + v * scale).as_vec3();
    let (normal, axis) = (rng.unit(), rng.direction());
    let distance = -(normal.as_dvec3().dot(center)) as f32;
    let (a, b) = rng.direction().any_orthonormal_pair();
    let corners = [a, -a * 0.5 + b * 0.87, -a * 0.5 - b * 0.87];
    let mesh = Mesh { positions: corners.map(at).to_vec(), triangles: vec![[0, 1, 2]], ..Mesh::default() };
    let (min, max) = (at(DVec3::splat(-0.6)), at(DVec3::splat(0.6)));
    let cylinder = Cylinder {
        base: at(-axis * 0.7),
        apex: at(axis * 0.7),
        radius: (0.6 * scale) as f32,
        caps: true,
        sides: Sides::Both,
        material: 0,
    };
    let sphere = Sphere { center: at(DVec3::ZERO), radius: scale as f32, sides: Sides::Both, material: 0 };
    vec![
        Description { spheres: vec![sphere], ..empty() },
        Description { planes: vec![Plane { normal, distance, material: 0 }], ..empty() },
        Description { meshes: vec![mesh], ..empty() },
        Description {
            cuboids: vec![Cuboid { min, max, rotation: Vec3::new(20.0, 30.0, 40.0), material: 0 }],
            ..empty()
        },
        Description { cylinders: vec![cylinder], ..empty() },
    ]
}

/// The occluder at a distance from a sphere or plane, on the side of its front where that is above zero.
fn beyond(description: &Description, gap: f64) -> Description {
    let mut occluder = description.clone();
    for sphere in &mut occluder.spheres {
        sphere.radius = (f64::from(sphere.radius) + gap) as f32;
    }
    for plane in &mut occluder.planes {
        plane.distance = (f64::from(plane.distance) - gap * plane.normal.as_dvec3().length()) as f32;
    }
    occluder
}

/// Where a ray leaves a surface, and which way.
struct Departure {
    point: math::Vec3<f32>,
    normal: math::Vec3<f32>,
    reach: f32,
    direction: Vec3,
    front: bool,
}

impl Departure {
    /// The ray as the renderer makes it.
    fn ray(&self, offsets: &Offsets) -> Ray {
        let origin = self.normal.mul_add(offsets.lift(self.point, self.reach), self.point);
        let origin = Vec3::new(origin.x, origin.y, origin.z);
        Ray { origin, direction: self.direction, t_min: 0.0, t_max: f32::INFINITY }
    }
}

fn spawn(departures: &[Departure], offset: Offset) -> Vec<Ray> {
    departures.iter().map(|d| d.ray(&offset.offsets())).collect()
}

/// Departures in all directions above the surface, from where eye rays from 4 to 8 sizes away hit it.
fn departures(scene: &Scene, center: DVec3, scale: f64, count: usize, rng: &mut Pcg) -> Vec<Departure> {
    let mut found = Vec::new();
    // A thing's silhouette is at least a tenth of the disc that is aimed at.
    for _ in 0..100 {
        let rays: Vec<Ray> = (0..count).map(|_| towards(center, scale, rng)).collect();
        let hits = batches::trace(scene, &rays);
        let hits = rays.iter().zip(hits).filter_map(|(ray, hit)| Some(departure(scene, ray, hit?, rng)));
        found.extend(hits);
        if found.len() >= count {
            break;
        }
    }
    found.truncate(count);
    found
}

fn towards(center: DVec3, scale: f64, rng: &mut Pcg) -> Ray {
    let back = rng.direction();
    let origin = (center + back * (scale * rng.between(4.0, 8.0))).as_vec3();
    let (a, b) = back.any_orthonormal_pair();
    let (sin, cos) = rng.between(0.0, TAU).sin_cos();
    let target = center + (a * cos + b * sin) * (scale * rng.between(0.0, 1.0).sqrt());
    let direction = (target - origin.as_dvec3()).normalize().as_vec3();
    Ray { origin, direction, t_min: 0.0, t_max: f32::INFINITY }
}

fn departure(scene: &Scene, ray: &Ray, hit: Hit, rng: &mut Pcg) -> Departure {
    let direction: math::Vec3<f32> = ray.direction.into();
    let p = direction.mul_add(hit.t, ray.origin.into());
    let surface = with_primitive!(scene, hit.primitive, |kind, i| kind.surface::<f32>(i, p));
    let front = surface.normal.dot(direction) <= 0.0;
    let normal = if front { surface.normal } else { -surface.normal };
    let up = Vec3::new(normal.x, normal.y, normal.z).as_dvec3();
    let mut away = rng.direction();
    if away.dot(up) < 0.0 {
        away = -away;
    }
    // Nearly level, it is a matter of rounding on which side of the horizon a ray is.
    if away.dot(up) < 1e-3 {
        away = up;
    }
    let direction = away.normalize().as_vec3();
    Departure { point: surface.point, normal, reach: surface.reach, direction, front }
}
