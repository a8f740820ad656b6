//! The primitives' tests alone, by method: nanoseconds for one ray and one primitive. The nearest of 16 is kept.

use std::hint::black_box;
use std::marker::PhantomData;

use criterion::{BenchmarkId, Criterion};
use glam::Vec3;
use raypacket::geometry::sphere::{self, SeenSphere};
use raypacket::geometry::triangle::{self, SeenEdges};
use raypacket::geometry::{LaneHits, Primitives, Spheres};
use raypacket::math::{BATCH, Lanes, RayBatch, Vec3 as Lane3};
use raypacket::scene::Scene;
use wide::{f32x4, f32x8};

use crate::beams::Beams;
use crate::common;
use crate::kinds::{self, Kind, PRIMITIVES, sixteen};
use crate::scenes::{Pcg, compiled};

/// One method for one kind of primitive.
trait Method {
    const NAME: &'static str;
    type Kind: Kind;
    type Seen;
    /// What a packet needs once for all primitives.
    type Aim<L: Lanes>;
    fn seen(scene: &Scene, i: usize, origin: Vec3) -> Self::Seen;
    fn aim<L: Lanes>(direction: Lane3<L>) -> Self::Aim<L>;
    fn test<L: Lanes>(seen: &Self::Seen, aim: &Self::Aim<L>, t_min: L, t_max: L) -> LaneHits<L>;
}

/// The default one.
struct Standard<K>(PhantomData<K>);

impl<K: Kind> Method for Standard<K> {
    const NAME: &'static str = K::METHOD;
    type Kind = K;
    type Seen = (<K::Stored as Primitives>::Seen<f32>, <K::Stored as Primitives>::Variant);
    type Aim<L: Lanes> = <K::Stored as Primitives>::Aim<L>;
    fn seen(scene: &Scene, i: usize, origin: Vec3) -> Self::Seen {
        let kind = K::stored(scene);
        let variant = kind.variant(i);
        (K::Stored::seen(&kind.shape(i), variant, origin.into()), variant)
    }
    #[inline(always)]
    fn aim<L: Lanes>(direction: Lane3<L>) -> Self::Aim<L> {
        K::Stored::aim(direction)
    }
    #[inline(always)]
    fn test<L: Lanes>(seen: &Self::Seen, aim: &Self::Aim<L>, t_min: L, t_max: L) -> LaneHits<L> {
        K::Stored::nearest::<L>(&K::Stored::splat_seen(&seen.0), seen.1, aim, t_min, t_max)
    }
}

/// A sphere's other methods.
macro_rules! sphere_method {
    ($type:ident, $method:ident) => {
        struct $type;
        impl Method for $type {
            const NAME: &'static str = concat!("sphere/", stringify!($method));
            type Kind = kinds::Sphere;
            type Seen = SeenSphere<f32>;
            type Aim<L: Lanes> = Lane3<L>;
            fn seen(scene: &Scene, i: usize, origin: Vec3) -> Self::Seen {
                SeenSphere::new(&scene.spheres.shape(i), origin.into())
            }
            #[inline(always)]
            fn aim<L: Lanes>(direction: Lane3<L>) -> Lane3<L> {
                direction
            }
            #[inline(always)]
            fn test<L: Lanes>(seen: &Self::Seen, aim: &Lane3<L>, t_min: L, t_max: L) -> LaneHits<L> {
                sphere::$method(&Spheres::splat_seen(seen), *aim, t_min, t_max)
            }
        }
    };
}
sphere_method!(Quadratic, quadratic);
sphere_method!(Geometric, geometric);

struct MollerTrumbore;

impl Method for MollerTrumbore {
    const NAME: &'static str = "triangle/moller_trumbore";
    type Kind = kinds::Triangle;
    type Seen = SeenEdges<f32>;
    type Aim<L: Lanes> = Lane3<L>;
    fn seen(scene: &Scene, i: usize, origin: Vec3) -> Self::Seen {
        SeenEdges::new(&scene.triangles.shape(i), origin.into())
    }
    #[inline(always)]
    fn aim<L: Lanes>(direction: Lane3<L>) -> Lane3<L> {
        direction
    }
    #[inline(always)]
    fn test<L: Lanes>(seen: &Self::Seen, aim: &Lane3<L>, t_min: L, t_max: L) -> LaneHits<L> {
        triangle::moller_trumbore(&seen.map(|number| L::splat(*number)), *aim, t_min, t_max)
    }
}

/// The nearest distance of every ray, infinite for a miss.
fn nearest<L: Lanes, M: Method>(primitives: &[M::Seen], rays: &RayBatch, to: &mut [f32; BATCH]) {
    for at in (0..BATCH).step_by(L::WIDTH) {
        let aim = M::aim(Lane3::load(&rays.direction, at));
        let mut t = L::splat(f32::INFINITY);
        for seen in primitives {
            if let Some((found, inside)) = M::test::<L>(seen, &aim, L::zero(), t) {
                t = found.select(inside, t);
            }
        }
        t.store(&mut to[at..]);
    }
}

fn width<L: Lanes, M: Method>(criterion: &mut Criterion, seen: &[M::Seen], rays: &RayBatch, expected: &[f32; BATCH]) {
    let mut t = [0.0; BATCH];
    nearest::<L, M>(seen, rays, &mut t);
    assert_eq!(t.map(f32::to_bits), expected.map(f32::to_bits), "{} {}", M::NAME, L::NAME);
    let mut group = criterion.benchmark_group("kernels");
    common::per_ray(&mut group, BenchmarkId::new(M::NAME, L::NAME), (BATCH * PRIMITIVES) as u64, || {
        nearest::<L, M>(black_box(seen), black_box(rays), &mut t);
        black_box(&mut t);
    });
}

fn method<M: Method>(criterion: &mut Criterion) {
    let mut rng = Pcg::new(5);
    let description = sixteen::<M::Kind>(&mut rng);
    let beams = Beams::new(&description, &mut rng);
    let scene = compiled(&description);
    let seen: Vec<_> = (0..PRIMITIVES).map(|i| M::seen(&scene, i, Vec3::ZERO)).collect();
    let mut expected = [0.0; BATCH];
    nearest::<f32, M>(&seen, &beams.rays, &mut expected);
    beams.confirm(M::NAME, M::Kind::OFF, &expected);
    width::<f32, M>(criterion, &seen, &beams.rays, &expected);
    width::<f32x4, M>(criterion, &seen, &beams.rays, &expected);
    width::<f32x8, M>(criterion, &seen, &beams.rays, &expected);
}

pub fn all(criterion: &mut Criterion) {
    method::<Standard<kinds::Plane>>(criterion);
    method::<Quadratic>(criterion);
    method::<Geometric>(criterion);
    method::<Standard<kinds::Sphere>>(criterion);
    method::<MollerTrumbore>(criterion);
    method::<Standard<kinds::Triangle>>(criterion);
    method::<Standard<kinds::Quad>>(criterion);
    method::<Standard<kinds::AlignedBox>>(criterion);
    method::<Standard<kinds::TurnedBox>>(criterion);
    method::<Standard<kinds::OpenCylinder>>(criterion);
    method::<Standard<kinds::CappedCylinder>>(criterion);
    method::<Standard<kinds::OpenCone>>(criterion);
    method::<Standard<kinds::CappedCone>>(criterion);
    method::<Standard<kinds::Torus>>(criterion);
    method::<Standard<kinds::Fractal>>(criterion);
    method::<Standard<kinds::Disc>>(criterion);
}
