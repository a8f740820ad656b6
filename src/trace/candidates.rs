//! The primitives that a batch of rays may meet, gathered into records that lie one after another.

use super::bounds::Bounds;
use super::seen::{PlaneRecord, SphereRecord, TriangleRecord};
use crate::geometry::plane::SeenPlane;
use crate::geometry::sphere::SeenSphere;
use crate::geometry::triangle::SeenTriangle;
use crate::math::{LaneMask, Lanes, Vec3};
use crate::scene::Scene;

/// A primitive's record and its id.
pub type Record<T> = (T, u32);

/// Room for the candidates of a batch, kept between batches; one a thread.
#[derive(Clone, Debug, Default)]
pub struct Candidates {
    shared: Lists<SeenPlane<f32>, SeenSphere<f32>, SeenTriangle<f32>>,
    apart: Lists<PlaneRecord, SphereRecord, TriangleRecord>,
}

/// Candidates by kind; ids rise through planes, spheres, triangles.
#[derive(Clone, Debug)]
pub struct Lists<P, S, T> {
    /// Planes.
    pub planes: Vec<Record<P>>,
    /// Spheres.
    pub spheres: Vec<Record<S>>,
    /// Triangles.
    pub triangles: Vec<Record<T>>,
}

impl<P, S, T> Default for Lists<P, S, T> {
    fn default() -> Self {
        Self { planes: Vec::new(), spheres: Vec::new(), triangles: Vec::new() }
    }
}

/// Candidates of a batch whose rays share their origin, and of one whose rays do not.
pub enum View<'a> {
    /// Origin-only terms are done.
    Shared(&'a Lists<SeenPlane<f32>, SeenSphere<f32>, SeenTriangle<f32>>),
    /// As stored.
    Apart(&'a Lists<PlaneRecord, SphereRecord, TriangleRecord>),
}

impl Candidates {
    /// Gathers what the batch with these bounds may meet.
    #[inline(always)]
    pub fn gather<L: Lanes>(&mut self, scene: &Scene, bounds: &Bounds) -> View<'_> {
        if bounds.shared {
            let o = bounds.origin.middle;
            self.shared.fill::<L>(
                scene,
                bounds,
                |i| scene.planes.seen(i, o),
                |i| scene.spheres.seen(i, o),
                |i| scene.triangles.seen(i, o),
            );
            View::Shared(&self.shared)
        } else {
            self.apart.fill::<L>(
                scene,
                bounds,
                |i| PlaneRecord { normal: scene.planes.normal(i).into(), distance: scene.planes.distance[i] },
                |i| SphereRecord { center: scene.spheres.center(i).into(), radius: scene.spheres.radius[i] },
                |i| {
                    let [v0, e1, e2] = scene.triangles.corner_and_edges(i).map(Vec3::from);
                    TriangleRecord { v0, e1, e2 }
                },
            );
            View::Apart(&self.apart)
        }
    }
}

impl<P, S, T> Lists<P, S, T> {
    #[inline(always)]
    fn fill<L: Lanes>(
        &mut self,
        scene: &Scene,
        bounds: &Bounds,
        plane: impl Fn(usize) -> P,
        sphere: impl Fn(usize) -> S,
        triangle: impl Fn(usize) -> T,
    ) {
        self.planes.clear();
        self.spheres.clear();
        self.triangles.clear();
        let planes = (0..scene.planes.len()).filter(|&i| !bounds.miss_plane(&scene.planes, i));
        self.planes.extend(planes.map(|i| (plane(i), i as u32)));
        let first = scene.first_sphere();
        match &bounds.cone {
            Some(cone) => {
                let origin = Vec3::splat(bounds.origin.middle.into());
                let [x, y, z] = &scene.spheres.center;
                let count = scene.spheres.len();
                for at in (0..count).step_by(L::WIDTH) {
                    let center = Vec3::new(L::load(&x[at..]), L::load(&y[at..]), L::load(&z[at..]));
                    let radius = L::load(&scene.spheres.radius[at..]) + L::splat(bounds.spread);
                    let real = u32::MAX >> (32 - (count - at).min(L::WIDTH));
                    let mut met = (!cone.misses(center - origin, radius)).bits() & real;
                    while met != 0 {
                        let i = at + met.trailing_zeros() as usize;
                        self.spheres.push((sphere(i), first + i as u32));
                        met &= met - 1;
                    }
                }
            }
            None => self.spheres.extend((0..scene.spheres.len()).map(|i| (sphere(i), first + i as u32))),
        }
        let first = scene.first_triangle();
        let triangles = (0..scene.triangles.len()).filter(|&i| !bounds.miss_triangle(&scene.triangles, i));
        self.triangles.extend(triangles.map(|i| (triangle(i), first + i as u32)));
    }
}
