//! The infinite plane p·n + distance = 0, seen from both sides.
//!
//! One method: t = −(n·o + distance) / (n·d), with the normal as the user gave it but for a power of two, so that
//! nothing is lost in normalising it (Haines, *Essential Ray Tracing Algorithms*, in Glassner 1989, §2.1).
//! The hit point's distance from the plane is at most 4 ε (|n·o| + |distance|) / |n| + 3 ε t, the latter for the rounding
//! of n·d.
//! A ray parallel to the plane, in it or not, misses it; so does one that starts on it.

use super::numbers::numbers;
use super::{Cull, Footing, LaneHits, Mapping, Never, Number, Primitives, Surface, columns, frame};
use crate::math::{LaneMask, Lanes, Vec3, map2};

/// Planes, column by column.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Planes {
    /// Normals, their greatest component from 1 to 2.
    pub normal: [Vec<f32>; 3],
    /// Offsets.
    pub distance: Vec<f32>,
    /// Indices into the scene's materials.
    pub material: Vec<u32>,
    /// The planes with unit normals, for shading.
    pub unit: Vec<UnitPlane>,
}

/// A plane with a unit normal n: n·p + offset = 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct UnitPlane {
    /// n.
    pub normal: glam::Vec3,
    /// The distance of the origin from the plane, on the side of n.
    pub offset: f32,
    /// [`frame`] of n.
    pub axes: [glam::Vec3; 2],
}

numbers! {
    /// A plane as stored.
    PlaneShape {
        /// Its normal, its greatest component from 1 to 2.
        normal: Vec3,
        /// Its offset.
        distance: T,
    }
    /// A plane as seen from the rays' origin.
    SeenPlane {
        /// The normal.
        normal: Vec3,
        /// −(n·o + distance).
        height: T,
    }
}

impl Planes {
    /// Adds a plane.
    pub fn push(&mut self, normal: glam::Vec3, distance: f32, material: u32) {
        // By a power of two, which changes no bit of any answer, so that the greatest component is from 1 to 2 and
        // nothing overflows or vanishes in a product with it.
        let exponent = f64::from(normal.abs().max_element()).log2().floor() as i32;
        let scale = 2f64.powi(-exponent);
        for axis in 0..3 {
            self.normal[axis].push((f64::from(normal[axis]) * scale) as f32);
        }
        self.distance.push((f64::from(distance) * scale) as f32);
        self.material.push(material);
        // In f64, where the square of a tiny normal does not vanish.
        let length = normal.as_dvec3().length();
        let unit = (normal.as_dvec3() / length).as_vec3();
        let offset = (f64::from(distance) / length) as f32;
        self.unit.push(UnitPlane { normal: unit, offset, axes: frame(unit) });
    }

    /// Plane `i`'s normal.
    #[inline]
    pub fn normal(&self, i: usize) -> glam::Vec3 {
        columns::at(&self.normal, i)
    }
}

impl Primitives for Planes {
    type Shape<T: Number> = PlaneShape<T>;
    type Variant = ();
    type Seen<T: Copy> = SeenPlane<T>;
    type Aim<L: Lanes> = Vec3<L>;
    type Named = Never;

    #[inline(always)]
    fn materials(&self) -> &[u32] {
        &self.material
    }
    #[inline]
    fn cull(&self) -> Cull<'_> {
        Cull::Planes(self)
    }
    #[inline(always)]
    fn shape(&self, i: usize) -> PlaneShape<f32> {
        PlaneShape { normal: self.normal(i).into(), distance: self.distance[i] }
    }
    #[inline]
    fn variant(&self, _: usize) {}
    #[inline(always)]
    fn zip<A: Number, B: Number, C: Number>(
        a: &PlaneShape<A>,
        b: &PlaneShape<B>,
        f: impl Fn(&A, &B) -> C,
    ) -> PlaneShape<C> {
        a.zip(b, f)
    }
    #[inline(always)]
    fn seen<L: Lanes>(plane: &PlaneShape<L>, (): (), origin: Vec3<L>) -> SeenPlane<L> {
        SeenPlane::new(plane.normal, plane.distance, origin)
    }
    #[inline(always)]
    fn splat_seen<L: Lanes>(seen: &SeenPlane<f32>) -> SeenPlane<L> {
        seen.map(|number| L::splat(*number))
    }
    #[inline(always)]
    fn nearest<L: Lanes>(seen: &SeenPlane<L>, (): (), d: &Vec3<L>, t_min: L, t_max: L) -> LaneHits<L> {
        nearest(seen, *d, t_min, t_max)
    }

    #[inline(always)]
    fn surface<L: Lanes>(&self, i: usize, point: Vec3<L>) -> Surface<L> {
        let normal = Vec3::splat(self.unit[i].normal);
        let height = normal.dot(point) + L::splat(self.unit[i].offset);
        Surface { point: normal.mul_add(-height, point), normal, reach: 0.0 }
    }
    #[inline(always)]
    fn footing<L: Lanes>(&self, _: usize, surface: &Surface<L>) -> Option<Footing<L>> {
        Some(Footing { point: surface.point, curvature: 0.0 })
    }
    #[inline(always)]
    fn uv<L: Lanes>(&self, i: usize, surface: &Surface<L>) -> [L; 2] {
        let Vec3 { x, y, .. } = self.checker(i, surface);
        [x, -y]
    }
    #[inline(always)]
    fn mapping<L: Lanes>(&self, _: usize, _: &Surface<L>) -> Mapping<L> {
        Mapping::endless()
    }
    #[inline(always)]
    fn checker<L: Lanes>(&self, i: usize, surface: &Surface<L>) -> Vec3<L> {
        let [t, b] = map2(self.unit[i].axes, Vec3::splat);
        Vec3::new(surface.point.dot(t), surface.point.dot(b), L::zero())
    }
}

/// The plane's distance along `direction`, inside (`t_min`, `t_max`).
#[inline(always)]
pub fn nearest<L: Lanes>(seen: &SeenPlane<L>, direction: Vec3<L>, t_min: L, t_max: L) -> LaneHits<L> {
    let t = seen.height / seen.normal.dot(direction);
    let inside = t.gt(t_min) & t.lt(t_max);
    inside.any().then_some((t, inside))
}

impl<L: Lanes> SeenPlane<L> {
    /// A plane as seen from `origin`.
    #[inline(always)]
    pub fn new(normal: Vec3<L>, distance: L, origin: Vec3<L>) -> Self {
        Self { normal, height: -(normal.dot(origin) + distance) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::vec3;

    fn hit(normal: glam::Vec3, distance: f32, origin: glam::Vec3, direction: glam::Vec3) -> Option<f32> {
        let mut planes = Planes::default();
        planes.push(normal, distance, 0);
        planes.test::<f32>(0, origin.into(), direction.into(), 0.0, f32::INFINITY).map(|(t, _)| t)
    }

    #[test]
    fn both_sides_and_any_normal_length() {
        for normal in [vec3(0.0, 1.0, 0.0), vec3(0.0, -1.0, 0.0), vec3(0.0, 1e-3, 0.0), vec3(0.0, 7.0, 0.0)] {
            assert_eq!(hit(normal, 0.0, vec3(0.0, 2.0, 0.0), vec3(0.0, -1.0, 0.0)), Some(2.0));
            assert_eq!(hit(normal, 0.0, vec3(0.0, -2.0, 0.0), vec3(0.0, 1.0, 0.0)), Some(2.0));
            assert_eq!(hit(normal, 0.0, vec3(0.0, -2.0, 0.0), vec3(0.0, -1.0, 0.0)), None);
        }
    }

    #[test]
    fn parallel_rays_and_rays_from_the_plane_miss() {
        for y in [0.0, -0.0, 1.0, -1.0] {
            for d in [vec3(1.0, 0.0, 0.0), vec3(0.0, -0.0, 1.0)] {
                assert_eq!(hit(glam::Vec3::Y, 0.0, vec3(3.0, y, 0.0), d), None, "{y} {d}");
            }
        }
        assert_eq!(hit(glam::Vec3::Y, 0.0, glam::Vec3::ZERO, vec3(0.0, 1.0, 0.0)), None);
    }

    #[test]
    fn surface_moves_the_point_onto_the_plane() {
        let mut planes = Planes::default();
        planes.push(vec3(0.0, 2.0, 0.0), -6.0, 0);
        let s = planes.surface::<f32>(0, vec3(5.0, 3.25, -1.0).into());
        assert_eq!((s.point.x, s.point.y, s.point.z), (5.0, 3.0, -1.0));
        assert_eq!(s.normal.y, 1.0);
    }
}
