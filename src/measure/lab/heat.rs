//! Errors over the screen, where textbook methods fail.

use glam::{DVec3, Vec3};

use super::errors::{Errors, ulps};
use super::{Budget, batches, truth};
use crate::geometry::Primitives;
use crate::geometry::methods::{Choice, Methods, OffsetMethod, SphereMethod, TorusMethod, TriangleMethod};
use crate::math;
use crate::measure::cases::{self, Ray};
use crate::measure::oracle::{Truth, shapes};
use crate::measure::random::Pcg;
use crate::render::Camera;
use crate::scene::{CameraDescription, Cuboid, Description, Invalid, Material, Scene, Sides, Sphere, Structure, Torus};
use crate::scene::{CompileOptions, compile_with, with_primitive};
use crate::shade::Offsets;
use crate::trace::Hit;

/// Rays that leave every pixel's surface where acne is looked for.
const SPAWNED: usize = 32;

/// A pixel of a heat map.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Cell {
    /// A miss, as it should be.
    Miss,
    /// A hit, and its error.
    Error(f64),
    /// A miss that should be a hit.
    Lost,
    /// A hit that should be a miss.
    Invented,
}

/// One method's errors over the screen.
#[derive(Clone, Debug, PartialEq)]
pub struct HeatMap {
    /// The method.
    pub method: &'static str,
    /// Row by row from the top.
    pub cells: Vec<Cell>,
    /// All of them together; nothing where acne is shown.
    pub errors: Option<Errors>,
}

/// A textbook failure.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct HeatName {
    /// In kebab case.
    pub name: &'static str,
    /// As a heading.
    pub title: &'static str,
    /// A description of the scene.
    pub about: &'static str,
}

/// All textbook failures, by name.
pub const HEATS: [HeatName; 5] = [
    HeatName { name: "sphere-far", title: "A far sphere", about: "radius 1, seen from 2000 away" },
    HeatName { name: "sphere-huge", title: "A huge sphere", about: "a planet of radius 10⁵ under an eye 1 above it" },
    HeatName { name: "mesh-far", title: "A far mesh", about: "a globe of radius 1, seen from 10,000 away" },
    HeatName { name: "torus", title: "A torus", about: "radii 1 and 0.375, seen from 12 away" },
    HeatName {
        name: "acne",
        title: "Acne",
        about: "a ball and a box 2000 in size: rays that leave a surface and meet it again",
    },
];

/// A textbook failure, by the textbook's method and by the default.
#[derive(Clone, Debug, PartialEq)]
pub struct Heat {
    /// Which.
    pub what: HeatName,
    /// Width and height.
    pub size: [usize; 2],
    /// The other methods, the default last.
    pub maps: Vec<HeatMap>,
    /// Whether errors are shares of rays that meet what they leave, 0 to 1, and not [`ulps`] of t.
    pub shares: bool,
}

/// Measures the textbook failure of that name, in the caller's rayon pool; nothing when there is none.
///
/// # Errors
/// [`Invalid`] when a scene does not compile; these do.
pub fn heat(name: &str, budget: &Budget) -> Result<Option<Heat>, Invalid> {
    let Some(what) = HEATS.into_iter().find(|h| h.name == name) else { return Ok(None) };
    let description = describe(name);
    let size = budget.heat;
    let rays = eye_rays(&description.camera, size);
    let shares = name == "acne";
    let maps: Result<_, Invalid> = if shares {
        let offset = |m: OffsetMethod| acne(&description, m, &rays);
        [OffsetMethod::None, OffsetMethod::Fixed, OffsetMethod::Derived].into_iter().map(offset).collect()
    } else {
        let truths = truth::of(&description, &rays);
        contestants(name).into_iter().map(|method| depths(&description, method, &rays, &truths)).collect()
    };
    Ok(Some(Heat { what, size, maps: maps?, shares }))
}

/// The methods that are shown, the default last.
fn contestants(name: &str) -> Vec<(&'static str, Choice)> {
    let mut all: Vec<(&'static str, Choice)> = match name {
        "mesh-far" => TriangleMethod::ALL.iter().map(|&m| (m.name(), Choice::Triangle(m))).collect(),
        "torus" => TorusMethod::ALL.iter().map(|&m| (m.name(), Choice::Torus(m))).collect(),
        _ => SphereMethod::ALL.iter().map(|&m| (m.name(), Choice::Sphere(m))).collect(),
    };
    all.rotate_left(1);
    all
}

/// The scene and its camera.
fn describe(name: &str) -> Description {
    let empty = Description { materials: vec![Material::default()], ..Description::default() };
    let look = |eye: Vec3, look_at: Vec3, fov: f32| CameraDescription { eye, look_at, up: Vec3::Y, fov };
    let sphere = |center: Vec3, radius: f32| Sphere { center, radius, sides: Sides::Both, material: 0 };
    let back = Vec3::new(0.48, 0.36, 0.8);
    match name {
        "sphere-far" => {
            let eye = back * 2000.0;
            Description { camera: look(eye, Vec3::ZERO, 0.075), spheres: vec![sphere(Vec3::ZERO, 1.0)], ..empty }
        }
        "sphere-huge" => {
            let planet = sphere(Vec3::new(0.0, -1e5, 0.0), 1e5);
            let eye = Vec3::new(0.0, 1.0, 0.0);
            Description { camera: look(eye, Vec3::new(0.3, 0.85, -1.0), 60.0), spheres: vec![planet], ..empty }
        }
        "mesh-far" => {
            let globe = cases::find("mesh-far").map(|g| g.make(1.0, 0, 3).description).unwrap_or_default();
            let corners = || globe.meshes.iter().flat_map(|m| &m.positions);
            let center = (corners().map(|p| p.as_dvec3()).sum::<DVec3>() / corners().count().max(1) as f64).as_vec3();
            Description { camera: look(center + back * 1e4, center, 0.0148), ..globe }
        }
        "torus" => {
            let axis = Vec3::new(0.3, 1.0, 0.35);
            let torus = Torus { center: Vec3::ZERO, axis, major_radius: 1.0, minor_radius: 0.375, material: 0 };
            Description { camera: look(back * 12.0, Vec3::ZERO, 12.5), tori: vec![torus], ..empty }
        }
        _ => {
            let (min, max) = (Vec3::new(300.0, -900.0, -2400.0), Vec3::new(2100.0, 700.0, -900.0));
            let cuboid = Cuboid { min, max, rotation: Vec3::new(10.0, 35.0, 5.0), material: 0 };
            let ball = sphere(Vec3::new(-1000.0, 0.0, -1500.0), 1000.0);
            let camera = look(Vec3::new(0.0, 900.0, 2600.0), Vec3::new(0.0, -50.0, -1500.0), 42.0);
            Description { camera, spheres: vec![ball], cuboids: vec![cuboid], ..empty }
        }
    }
}

/// The rays through the pixels' centres.
fn eye_rays(camera: &CameraDescription, [width, height]: [usize; 2]) -> Vec<Ray> {
    let lens = Camera::new(camera, width as f32 / height as f32);
    let ray = |i: usize| {
        let [x, y] = [i % width, i / width].map(|n| n as f32 + 0.5);
        let direction = lens.direction(x / width as f32, y / height as f32);
        Ray { origin: camera.eye, direction, t_min: 0.0, t_max: f32::INFINITY }
    };
    (0..width * height).map(ray).collect()
}

/// The errors of t.
fn depths(
    description: &Description,
    (method, choice): (&'static str, Choice),
    rays: &[Ray],
    truths: &[Option<Truth>],
) -> Result<HeatMap, Invalid> {
    let scene = compile_with(description, &CompileOptions { structure: Some(Structure::None), methods: vec![choice] })?;
    let answers = batches::trace(&scene, rays);
    let cell = |(truth, hit): (&Option<_>, &Option<Hit>)| match (truth, hit) {
        (None, None) => Cell::Miss,
        (Some(_), None) => Cell::Lost,
        (None, Some(_)) => Cell::Invented,
        (Some(Truth { t, .. }), Some(hit)) => Cell::Error(ulps(hit.t, *t)),
    };
    let cells = truths.iter().zip(&answers).map(cell).collect();
    let errors = Errors::of(&scene, &shapes(description), rays, truths, &answers);
    Ok(HeatMap { method, cells, errors: Some(errors) })
}

/// The share of rays that meet the convex thing that they leave, which is wrong whatever the ray.
fn acne(description: &Description, method: OffsetMethod, rays: &[Ray]) -> Result<HeatMap, Invalid> {
    let scene = compile_with(description, &Structure::None.into())?;
    // Each thing alone, as one may well shade the other.
    let alone = |spheres: bool| {
        let one = match spheres {
            true => Description { cuboids: vec![], ..description.clone() },
            false => Description { spheres: vec![], ..description.clone() },
        };
        compile_with(&one, &Structure::None.into())
    };
    let (ball, cuboid) = (alone(true)?, alone(false)?);
    let offsets = Offsets::of(&Methods { offset: method, ..Methods::default() });
    let mut rng = Pcg::new(23);
    let cell = |(ray, hit): (&Ray, Option<Hit>)| {
        let Some(hit) = hit else { return Cell::Miss };
        let spawned = leaving(&scene, ray, hit, &offsets, &mut rng);
        let own = if hit.primitive < scene.first.triangles { &ball } else { &cuboid };
        let met = batches::blocked(own, &spawned).into_iter().filter(|&b| b).count();
        Cell::Error(met as f64 / SPAWNED as f64)
    };
    let cells = rays.iter().zip(batches::trace(&scene, rays)).map(cell).collect();
    Ok(HeatMap { method: method.name(), cells, errors: None })
}

/// Rays in all directions above the surface, as the renderer starts them.
fn leaving(scene: &Scene, ray: &Ray, hit: Hit, offsets: &Offsets, rng: &mut Pcg) -> Vec<Ray> {
    let direction: math::Vec3<f32> = ray.direction.into();
    let p = direction.mul_add(hit.t, ray.origin.into());
    let surface = with_primitive!(scene, hit.primitive, |kind, i| kind.surface::<f32>(i, p));
    let origin = surface.normal.mul_add(offsets.lift(surface.point, surface.reach), surface.point);
    let [origin, normal] = [origin, surface.normal].map(|v| Vec3::new(v.x, v.y, v.z));
    (0..SPAWNED)
        .map(|_| {
            let away = rng.direction();
            let up = normal.as_dvec3();
            let away = if away.dot(up) < 0.0 { -away } else { away };
            Ray { origin, direction: away.as_vec3(), t_min: 0.0, t_max: f32::INFINITY }
        })
        .collect()
}
