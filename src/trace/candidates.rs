//! The primitives that a batch of rays may meet, gathered into records that lie one after another.

use super::bounds::Bounds;
use super::tree::State;
use crate::geometry::{
    Balls, Bounded, Cones, Cuboids, Cylinders, Fractals, Planes, Primitives, Quads, Spheres, Tori, Triangles,
};
use crate::math::{LaneMask, Lanes, Vec3};
use crate::scene::Scene;

/// What is kept of a candidate until the packets come: with the terms of the origin done, or as stored.
pub trait Form {
    /// A primitive's record.
    type Of<K: Primitives>: Copy;
    /// Primitive `i` of a kind, for rays from `origin`, if they have one.
    fn record<K: Primitives>(kind: &K, i: usize, origin: Vec3<f32>) -> Self::Of<K>;
    /// As seen from a packet's origins.
    fn seen<K: Primitives, L: Lanes>(record: &Self::Of<K>, origin: Vec3<L>) -> K::Seen<L>;
}

/// For rays that share their origin: its terms are done.
#[derive(Clone, Copy, Debug)]
pub struct Shared;

impl Form for Shared {
    type Of<K: Primitives> = K::Seen<f32>;
    #[inline(always)]
    fn record<K: Primitives>(kind: &K, i: usize, origin: Vec3<f32>) -> K::Seen<f32> {
        K::seen(&kind.record(i), origin)
    }
    #[inline(always)]
    fn seen<K: Primitives, L: Lanes>(record: &K::Seen<f32>, _origin: Vec3<L>) -> K::Seen<L> {
        K::splat(record)
    }
}

/// For rays that do not: as stored.
#[derive(Clone, Copy, Debug)]
pub struct Apart;

impl Form for Apart {
    type Of<K: Primitives> = K::Record;
    #[inline(always)]
    fn record<K: Primitives>(kind: &K, i: usize, _origin: Vec3<f32>) -> K::Record {
        kind.record(i)
    }
    #[inline(always)]
    fn seen<K: Primitives, L: Lanes>(record: &K::Record, origin: Vec3<L>) -> K::Seen<L> {
        K::seen(record, origin)
    }
}

/// Candidates of one kind, in rising order of their ids.
pub type List<F, K> = Vec<(<F as Form>::Of<K>, u32)>;

/// Candidates by kind; ids rise from kind to kind.
pub struct Lists<F: Form> {
    pub planes: List<F, Planes>,
    pub spheres: List<F, Spheres>,
    pub triangles: List<F, Triangles>,
    pub quads: List<F, Quads>,
    pub cuboids: List<F, Cuboids>,
    pub cylinders: List<F, Cylinders>,
    pub cones: List<F, Cones>,
    pub tori: List<F, Tori>,
    pub fractals: List<F, Fractals>,
    /// Whether there are any after the triangles.
    pub more: bool,
}

impl<F: Form> Default for Lists<F> {
    fn default() -> Self {
        Self {
            planes: Vec::new(),
            spheres: Vec::new(),
            triangles: Vec::new(),
            quads: Vec::new(),
            cuboids: Vec::new(),
            cylinders: Vec::new(),
            cones: Vec::new(),
            tori: Vec::new(),
            fractals: Vec::new(),
            more: false,
        }
    }
}

/// Room for the candidates of a batch, kept between batches; one a thread.
#[derive(Default)]
pub struct Candidates {
    shared: Lists<Shared>,
    apart: Lists<Apart>,
    tree: Option<Box<State>>,
}

/// What it holds matters only while a batch is traced, so that a copy starts out empty.
impl Clone for Candidates {
    fn clone(&self) -> Self {
        Self::default()
    }
}

impl std::fmt::Debug for Candidates {
    fn fmt(&self, f: &mut std::fmt::Formatter) -> std::fmt::Result {
        f.debug_struct("Candidates").finish_non_exhaustive()
    }
}

/// Candidates of a batch whose rays share their origin, and of one whose rays do not.
pub enum View<'a> {
    /// Origin-only terms are done.
    Shared(&'a Lists<Shared>),
    /// As stored.
    Apart(&'a Lists<Apart>),
}

impl Candidates {
    /// What the way through a tree needs instead.
    #[inline(always)]
    pub(super) fn tree(&mut self) -> &mut State {
        self.tree.get_or_insert_default()
    }

    /// Gathers what the batch with these bounds may meet.
    #[inline(always)]
    pub fn gather<L: Lanes>(&mut self, scene: &Scene, bounds: &Bounds) -> View<'_> {
        if bounds.shared {
            self.shared.fill::<L>(scene, bounds);
            View::Shared(&self.shared)
        } else {
            self.apart.fill::<L>(scene, bounds);
            View::Apart(&self.apart)
        }
    }
}

impl<F: Form> Lists<F> {
    #[inline(always)]
    fn fill<L: Lanes>(&mut self, scene: &Scene, bounds: &Bounds) {
        let origin = bounds.origin.middle;
        self.planes.clear();
        let planes = (0..scene.planes.len()).filter(|&i| !bounds.miss_plane(&scene.planes, i));
        self.planes.extend(planes.map(|i| (F::record(&scene.planes, i, origin), i as u32)));
        self.spheres.clear();
        bounded::<F, _, L>(&mut self.spheres, &scene.spheres, scene.first.spheres, bounds);
        self.triangles.clear();
        let triangles = (0..scene.triangles.len()).filter(|&i| !bounds.miss_triangle(&scene.triangles, i));
        let first = scene.first.triangles;
        self.triangles.extend(triangles.map(|i| (F::record(&scene.triangles, i, origin), first + i as u32)));
        self.more = scene.plan.rare && self.fill_rare::<L>(scene, bounds);
    }

    /// Whether there are any.
    #[inline(never)]
    fn fill_rare<L: Lanes>(&mut self, scene: &Scene, bounds: &Bounds) -> bool {
        self.quads.clear();
        bounded::<F, _, L>(&mut self.quads, &scene.quads, scene.first.quads, bounds);
        self.cuboids.clear();
        bounded::<F, _, L>(&mut self.cuboids, &scene.cuboids, scene.first.cuboids, bounds);
        self.cylinders.clear();
        bounded::<F, _, L>(&mut self.cylinders, &scene.cylinders, scene.first.cylinders, bounds);
        self.cones.clear();
        bounded::<F, _, L>(&mut self.cones, &scene.cones, scene.first.cones, bounds);
        self.tori.clear();
        bounded::<F, _, L>(&mut self.tori, &scene.tori, scene.first.tori, bounds);
        self.fractals.clear();
        bounded::<F, _, L>(&mut self.fractals, &scene.fractals, scene.first.fractals, bounds);
        let sizes = [self.quads.len(), self.cuboids.len(), self.cylinders.len(), self.cones.len(), self.tori.len()];
        sizes.iter().any(|&len| len > 0) || !self.fractals.is_empty()
    }
}

/// Adds all of a kind whose balls the batch's cone meets.
#[inline(always)]
fn bounded<F: Form, K: Bounded, L: Lanes>(list: &mut List<F, K>, kind: &K, first: u32, bounds: &Bounds) {
    let origin = bounds.origin.middle;
    let mut add = |i: usize| list.push((F::record(kind, i, origin), first + i as u32));
    let Some(cone) = &bounds.cone else {
        (0..kind.len()).for_each(add);
        return;
    };
    let Balls { center: [x, y, z], radius, .. } = kind.balls();
    let origin = Vec3::splat(origin.into());
    let count = kind.len();
    for at in (0..count).step_by(L::WIDTH) {
        let center = Vec3::new(L::load(&x[at..]), L::load(&y[at..]), L::load(&z[at..]));
        let radius = L::load(&radius[at..]) + L::splat(bounds.spread);
        let real = u32::MAX >> (32 - (count - at).min(L::WIDTH));
        let mut met = (!cone.misses(center - origin, radius)).bits() & real;
        while met != 0 {
            add(at + met.trailing_zeros() as usize);
            met &= met - 1;
        }
    }
}
