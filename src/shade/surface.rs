//! Where the rays of a wave arrived: point, normal and material, packet by packet.

use super::spawn;
use super::texture;
use super::wave::Wave;
use crate::geometry::{Primitives, Surface};
use crate::math::{BATCH, LaneMask, Lanes, Vec3};
use crate::scene::{Pigment, Scene, with_primitive};
use crate::trace::Nearest;

/// The surfaces that a wave's rays hit, column by column.
#[derive(Clone, Debug)]
#[repr(align(64))]
pub struct Surfaces {
    /// Hit points, on the surface.
    pub point: [[f32; BATCH]; 3],
    /// Unit normals, turned against the rays.
    pub normal: [[f32; BATCH]; 3],
    /// How far from the surface spawned rays start; below zero where nothing was hit.
    pub lift: [f32; BATCH],
    /// Diffuse colour times the ray's weight and what the mirror leaves of it.
    pub color: [[f32; BATCH]; 3],
    /// Weight of the mirror's ray.
    pub mirror: [f32; BATCH],
    /// Highlight strength, weighted as `color`; written only where the plan has highlights, as is the next.
    pub specular: [f32; BATCH],
    /// Phong exponent.
    pub shininess: [f32; BATCH],
    /// Whether any hit of the wave so far has a highlight.
    pub glossy: bool,
}

impl Default for Surfaces {
    fn default() -> Self {
        Self {
            point: [[0.0; BATCH]; 3],
            normal: [[0.0; BATCH]; 3],
            lift: [-1.0; BATCH],
            color: [[0.0; BATCH]; 3],
            mirror: [0.0; BATCH],
            specular: [0.0; BATCH],
            shininess: [1.0; BATCH],
            glossy: false,
        }
    }
}

/// A packet's shading data while its primitives are gone through.
#[derive(Clone, Copy)]
struct Gathered<L> {
    point: Vec3<L>,
    normal: Vec3<L>,
    reach: L,
    color: Vec3<L>,
    mirror: L,
    specular: L,
    shininess: L,
    glossy: bool,
}

impl Surfaces {
    /// Starts a wave: nothing hit yet.
    pub fn start(&mut self, len: usize) {
        self.glossy = false;
        // Packets without an active ray are passed over later on; the last may be beyond the end.
        self.lift[..len.next_multiple_of(8)].fill(-1.0);
    }

    /// Finds the surfaces of packet `at`, which hit `hit` wherever `hit.found`.
    ///
    /// Neighbouring rays mostly hit the same primitive, so each primitive in the packet is looked at once, for all
    /// lanes, and selected where it was hit.
    #[inline(always)]
    pub fn find<L: Lanes>(&mut self, scene: &Scene, wave: &Wave, at: usize, hit: &Nearest<L>) {
        let direction = Vec3::<L>::load(&wave.rays.direction, at);
        let p = direction.mul_add(hit.t, wave.rays.origins(at));
        let mut ids = [0; 8];
        hit.primitive.store_ids(&mut ids);
        let first = ids[hit.found.bits().trailing_zeros() as usize];
        let mut g = gather(scene, first, p);
        let mut left = hit.found.bits() & !L::id_mask(&ids, first).bits();
        while left != 0 {
            let id = ids[left.trailing_zeros() as usize];
            let same = L::id_mask(&ids, id);
            g = gather(scene, id, p).select(same, g);
            left &= !same.bits();
        }
        let normal = (-g.normal).select(g.normal.dot(direction).gt(L::zero()), g.normal);
        g.point.store(&mut self.point, at);
        normal.store(&mut self.normal, at);
        spawn::lift(g.point, g.reach).select(hit.found, L::splat(-1.0)).store(&mut self.lift[at..]);
        let weight = L::load(&wave.weight[at..]);
        let own = weight * (L::splat(1.0) - g.mirror);
        (g.color * own).store(&mut self.color, at);
        (weight * g.mirror).store(&mut self.mirror[at..]);
        if scene.plan.highlights {
            self.glossy |= g.glossy;
            (g.specular * own).store(&mut self.specular[at..]);
            g.shininess.store(&mut self.shininess[at..]);
        }
    }
}

impl<L: Lanes> Gathered<L> {
    #[inline(always)]
    fn select(self, mask: L::Mask, other: Self) -> Self {
        Self {
            point: self.point.select(mask, other.point),
            normal: self.normal.select(mask, other.normal),
            reach: self.reach.select(mask, other.reach),
            color: self.color.select(mask, other.color),
            mirror: self.mirror.select(mask, other.mirror),
            specular: self.specular.select(mask, other.specular),
            shininess: self.shininess.select(mask, other.shininess),
            glossy: self.glossy | other.glossy,
        }
    }
}

/// Primitive `id`'s surface and material at the points `p`.
#[inline(always)]
fn gather<L: Lanes>(scene: &Scene, id: u32, p: Vec3<L>) -> Gathered<L> {
    let (surface, material) = surface(scene, id, p);
    let m = &scene.materials[material as usize];
    let color = match m.pigment {
        Pigment::Color(color) => Vec3::splat(color),
        Pigment::Checker { colors, size } => {
            let odd = odd_cell(scene, id, &surface, 1.0 / size);
            Vec3::splat(colors[1]).select(odd, Vec3::splat(colors[0]))
        }
        Pigment::Texture { texture, size } => {
            let [u, v] = with_primitive!(scene, id, |kind, i| kind.uv(i, &surface));
            let per_size = L::splat(1.0 / size);
            texture::sample(&scene.textures[texture], u * per_size, v * per_size)
        }
    };
    Gathered {
        point: surface.point,
        normal: surface.normal,
        reach: L::splat(surface.reach),
        color,
        mirror: L::splat(m.reflectance),
        specular: L::splat(m.specular),
        shininess: L::splat(m.shininess),
        glossy: m.specular > 0.0,
    }
}

/// Primitive `id`'s surface near the points `p`, and its material.
#[inline(always)]
pub fn surface<L: Lanes>(scene: &Scene, id: u32, p: Vec3<L>) -> (Surface<L>, u32) {
    with_primitive!(scene, id, |kind, i| (kind.surface(i, p), kind.material(i)))
}

/// Where the checkerboard shows its second colour; see [`Pigment::Checker`].
#[inline(always)]
fn odd_cell<L: Lanes>(scene: &Scene, id: u32, surface: &Surface<L>, per_size: f32) -> L::Mask {
    let q = with_primitive!(scene, id, |kind, i| kind.checker(i, surface)) * L::splat(per_size);
    let half = (q.x.floor() + q.y.floor() + q.z.floor()) * L::splat(0.5);
    !half.floor().eq(half)
}

/// The unit normal where one ray hit a primitive, turned against the ray; zero for a ray that hit nothing.
pub(crate) fn facing_normal(scene: &Scene, id: u32, origin: glam::Vec3, direction: glam::Vec3, t: f32) -> [f32; 3] {
    if id == crate::math::NONE {
        return [0.0; 3];
    }
    let (surface, _) = surface::<f32>(scene, id, (origin + direction * t).into());
    let normal = glam::Vec3::from(surface.normal);
    (if normal.dot(direction) > 0.0 { -normal } else { normal }).to_array()
}
