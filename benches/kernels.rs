//! The primitives' tests alone, by method and width: nanoseconds for one ray and one primitive.
//!
//! 256 rays from one point against 16 primitives of a kind, the nearest kept: all of it in the first-level cache.

mod common;
#[path = "../tests/common/mod.rs"]
mod scenes;

use std::hint::black_box;

use criterion::{BenchmarkId, Criterion, criterion_group, criterion_main};
use glam::{DVec3, Vec3, vec3};
use raypacket::geometry::sphere::{self, SeenSphere};
use raypacket::geometry::triangle::{self, SeenEdges};
use raypacket::geometry::{Nearest, Planes, Primitives, Quads, Spheres, Triangles};
use raypacket::math::{BATCH, Lanes, RayBatch, Vec3 as Lane3};
use raypacket::reference::Tracer;
use raypacket::scene::{self, Description, Scene};
use scenes::{Pcg, ROUNDOFF, compiled, empty, mesh};
use wide::{f32x4, f32x8};

const PRIMITIVES: usize = 16;

/// One method for one kind of primitive.
trait Test {
    const NAME: &'static str;
    type Seen;
    /// All primitives, as the origin sees them.
    fn seen(scene: &Scene, origin: Vec3) -> Vec<Self::Seen>;
    /// What a packet needs once for all of them.
    type Aim<L: Lanes>;
    fn aim<L: Lanes>(direction: Lane3<L>) -> Self::Aim<L>;
    fn test<L: Lanes>(seen: &Self::Seen, aim: &Self::Aim<L>, t_min: L, t_max: L) -> Nearest<L>;
    fn scene(rng: &mut Pcg) -> Description;
    /// The largest error of t that the method may have in that scene, seen from the origin.
    const TOLERANCE: f64;
}

/// A kind's default method.
macro_rules! default_test {
    ($type:ident, $name:literal, $field:ident: $kind:ty, $tolerance:expr, $rng:ident => $make:expr) => {
        struct $type;
        impl Test for $type {
            const NAME: &'static str = $name;
            type Seen = <$kind as Primitives>::Seen<f32>;
            type Aim<L: Lanes> = <$kind as Primitives>::Aim<L>;
            const TOLERANCE: f64 = $tolerance;
            fn seen(scene: &Scene, origin: Vec3) -> Vec<Self::Seen> {
                (0..PRIMITIVES).map(|i| <$kind>::seen(&scene.$field.record(i), origin.into())).collect()
            }
            #[inline(always)]
            fn aim<L: Lanes>(direction: Lane3<L>) -> Self::Aim<L> {
                <$kind>::aim(direction)
            }
            #[inline(always)]
            fn test<L: Lanes>(seen: &Self::Seen, aim: &Self::Aim<L>, t_min: L, t_max: L) -> Nearest<L> {
                <$kind>::nearest::<L, false>(&<$kind>::splat(seen), aim, t_min, t_max)
            }
            fn scene($rng: &mut Pcg) -> Description {
                let mut scene = empty();
                for _ in 0..PRIMITIVES {
                    $make(&mut scene, $rng);
                }
                scene
            }
        }
    };
}

/// A sphere's other methods.
macro_rules! sphere_test {
    ($type:ident, $method:ident) => {
        struct $type;
        impl Test for $type {
            const NAME: &'static str = concat!("sphere/", stringify!($method));
            type Seen = SeenSphere<f32>;
            type Aim<L: Lanes> = Lane3<L>;
            const TOLERANCE: f64 = Stable::TOLERANCE;
            fn seen(scene: &Scene, origin: Vec3) -> Vec<Self::Seen> {
                Stable::seen(scene, origin)
            }
            #[inline(always)]
            fn aim<L: Lanes>(direction: Lane3<L>) -> Lane3<L> {
                direction
            }
            #[inline(always)]
            fn test<L: Lanes>(seen: &Self::Seen, aim: &Lane3<L>, t_min: L, t_max: L) -> Nearest<L> {
                sphere::$method(&Spheres::splat(seen), *aim, t_min, t_max)
            }
            fn scene(rng: &mut Pcg) -> Description {
                Stable::scene(rng)
            }
        }
    };
}
sphere_test!(Quadratic, quadratic);
sphere_test!(Geometric, geometric);

// The discriminant is off by 8 ε |f|² at the most, with |f| < 8; its root, next to the outline, by the root of that:
// 0.0056.
default_test!(Stable, "sphere/stable", spheres: Spheres, 0.0056, rng => |scene: &mut Description, rng: &mut Pcg| {
    scene.spheres.push(scenes::sphere(ahead(rng), rng.range(0.2, 0.9)));
});

// t < 16, off by 4 ε of it for the height, and by 4 ε / (n·d) for the slope, which is above 0.4.
default_test!(Plane, "plane", planes: Planes, 16.0 * ROUNDOFF * (4.0 + 4.0 / 0.4), rng => |scene: &mut Description, rng: &mut Pcg| {
    let normal = vec3(rng.range(-0.3, 0.3), rng.range(-0.3, 0.3), 1.0);
    scene.planes.push(scenes::plane(normal, rng.range(3.0, 6.0)));
});

// 8 ε (|o − a| + edge) / sin of the smallest angle, by the cosine of the incidence: below 8 ε · 12 / (0.2 · 0.2).
default_test!(Watertight, "triangle/watertight", triangles: Triangles, 8.0 * ROUNDOFF * 12.0 / 0.04, rng => |scene: &mut Description, rng: &mut Pcg| {
    // Close to equilateral, and turned towards the origin more or less.
    let around = [vec3(0.0, 1.0, 0.0), vec3(0.87, -0.5, 0.0), vec3(-0.87, -0.5, 0.0)];
    let center = ahead(rng);
    scene.meshes.push(mesh(&[around.map(|corner| center + corner + 0.3 * rng.cube())]));
});

struct MollerTrumbore;

impl Test for MollerTrumbore {
    const NAME: &'static str = "triangle/moller_trumbore";
    type Seen = SeenEdges<f32>;
    type Aim<L: Lanes> = Lane3<L>;
    const TOLERANCE: f64 = Watertight::TOLERANCE;
    fn seen(scene: &Scene, origin: Vec3) -> Vec<Self::Seen> {
        (0..PRIMITIVES).map(|i| SeenEdges::new(&scene.triangles.record(i), origin.into())).collect()
    }
    #[inline(always)]
    fn aim<L: Lanes>(direction: Lane3<L>) -> Lane3<L> {
        direction
    }
    #[inline(always)]
    fn test<L: Lanes>(seen: &Self::Seen, aim: &Lane3<L>, t_min: L, t_max: L) -> Nearest<L> {
        triangle::moller_trumbore(&seen.splat(), *aim, t_min, t_max)
    }
    fn scene(rng: &mut Pcg) -> Description {
        Watertight::scene(rng)
    }
}

// As for triangles.
default_test!(Quad, "quad", quads: Quads, Watertight::TOLERANCE, rng => |scene: &mut Description, rng: &mut Pcg| {
    let [u, v] = [Vec3::X, Vec3::Y].map(|e| e + 0.3 * rng.cube());
    scene.quads.push(scene::Quad { corner: ahead(rng), u, v, material: 0 });
});

/// 4 to 7 before the origin, along −z.
fn ahead(rng: &mut Pcg) -> Vec3 {
    vec3(rng.range(-2.0, 2.0), rng.range(-2.0, 2.0), rng.range(-6.0, -4.0))
}

/// The nearest distance of every ray, infinite for a miss.
fn nearest<L: Lanes, T: Test>(primitives: &[T::Seen], rays: &RayBatch, to: &mut [f32; BATCH]) {
    for at in (0..BATCH).step_by(L::WIDTH) {
        let aim = T::aim(Lane3::load(&rays.direction, at));
        let mut t = L::splat(f32::INFINITY);
        for seen in primitives {
            if let Some((found, inside)) = T::test::<L>(seen, &aim, L::zero(), t) {
                t = found.select(inside, t);
            }
        }
        t.store(&mut to[at..]);
    }
}

fn width<L: Lanes, T: Test>(criterion: &mut Criterion, seen: &[T::Seen], rays: &RayBatch, expected: &[f32; BATCH]) {
    let mut t = [0.0; BATCH];
    nearest::<L, T>(seen, rays, &mut t);
    assert_eq!(t.map(f32::to_bits), expected.map(f32::to_bits), "{} {}", T::NAME, L::NAME);
    let mut group = criterion.benchmark_group("kernels");
    common::per_ray(&mut group, BenchmarkId::new(T::NAME, L::NAME), (BATCH * PRIMITIVES) as u64, || {
        nearest::<L, T>(black_box(seen), black_box(rays), &mut t);
        black_box(&mut t);
    });
}

fn method<T: Test>(criterion: &mut Criterion) {
    let mut rng = Pcg::new(5);
    let description = T::scene(&mut rng);
    let seen = T::seen(&compiled(&description), Vec3::ZERO);
    let mut rays = RayBatch::default();
    for _ in 0..BATCH {
        let direction = vec3(rng.range(-0.5, 0.5), rng.range(-0.5, 0.5), -1.0).normalize();
        rays.push(Vec3::ZERO, direction, 0.0, f32::INFINITY);
    }
    let mut expected = [0.0; BATCH];
    nearest::<f32, T>(&seen, &rays, &mut expected);
    confirm::<T>(&description, &rays, &expected);
    width::<f32, T>(criterion, &seen, &rays, &expected);
    width::<f32x4, T>(criterion, &seen, &rays, &expected);
    width::<f32x8, T>(criterion, &seen, &rays, &expected);
}

/// Against the `f64` reference: the same rays hit, and at the same distance within the method's error.
fn confirm<T: Test>(description: &Description, rays: &RayBatch, found: &[f32; BATCH]) {
    let tracer = Tracer::new(description);
    let mut hits = 0;
    for (i, &t) in found.iter().enumerate() {
        let direction = DVec3::from_array([0, 1, 2].map(|axis| f64::from(rays.direction[axis][i])));
        let exact = tracer.intersect(DVec3::ZERO, direction.normalize(), f64::INFINITY).map(|hit| hit.t);
        let same = exact.map_or(t == f32::INFINITY, |exact| (f64::from(t) - exact).abs() <= T::TOLERANCE);
        assert!(same, "{}: ray {i} has {t} for {exact:?}", T::NAME);
        hits += usize::from(exact.is_some());
    }
    assert!(hits > BATCH / 3, "{}: {hits} hits", T::NAME);
}

fn kernels(criterion: &mut Criterion) {
    method::<Quadratic>(criterion);
    method::<Geometric>(criterion);
    method::<Stable>(criterion);
    method::<Plane>(criterion);
    method::<MollerTrumbore>(criterion);
    method::<Watertight>(criterion);
    method::<Quad>(criterion);
}

criterion_group! { name = benches; config = common::short(); targets = kernels }
criterion_main!(benches);
