//! Where the rays of a wave arrived: point, normal and material, packet by packet.

use super::medium::{Deeper, MediumStack, Passage};
use super::spawn::{self, Offsets};
use super::surface::{smooth, start};
use super::texture;
use super::wave::Wave;
use crate::geometry::{Mapping, Primitives, Surface};
use crate::math::{BATCH, LaneMask, Lanes, MAX_LANES, Vec3, exp2, map2};
use crate::scene::{Material, Pigment, Scene, Wrap, with_primitive};
use crate::trace::{Contents, Nearest};

/// The surfaces that a wave's rays hit, column by column.
#[derive(Clone, Debug)]
#[repr(align(64))]
pub struct Surfaces {
    /// Hit points, on the surface.
    pub point: [[f32; BATCH]; 3],
    /// Unit normals for shading, turned against the rays.
    pub normal: [[f32; BATCH]; 3],
    /// Unit normals of the surfaces themselves, turned against the rays; written only where the plan has interpolated
    /// normals, and else the same as `normal`.
    pub geometric: [[f32; BATCH]; 3],
    /// From where lights are seen; written only where the plan says that it is not the point.
    pub raised: [[f32; BATCH]; 3],
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
    /// The media for refraction; written only where the plan refracts.
    pub media: Transmissions,
}

/// The transparent side of the surfaces that a wave's rays hit.
#[derive(Clone, Debug)]
pub struct Transmissions {
    /// Weight of what is transmitted.
    pub transmission: [f32; BATCH],
    /// Above 0 where the material's fractions are constant.
    pub additive: [f32; BATCH],
    /// Index of refraction before the surface, divided by the one behind it.
    pub eta: [f32; BATCH],
    /// The media that refracted rays are in.
    pub inside: [MediumStack; BATCH],
    /// The share of the rays that absorption has left where they arrived; written only where the plan absorbs.
    pub tint: [[f32; BATCH]; 3],
}

impl Default for Transmissions {
    fn default() -> Self {
        Self {
            transmission: [0.0; BATCH],
            additive: [0.0; BATCH],
            eta: [1.0; BATCH],
            inside: [MediumStack::default(); BATCH],
            tint: [[1.0; BATCH]; 3],
        }
    }
}

impl Default for Surfaces {
    fn default() -> Self {
        Self {
            point: [[0.0; BATCH]; 3],
            normal: [[0.0; BATCH]; 3],
            geometric: [[0.0; BATCH]; 3],
            raised: [[0.0; BATCH]; 3],
            lift: [-1.0; BATCH],
            color: [[0.0; BATCH]; 3],
            mirror: [0.0; BATCH],
            specular: [0.0; BATCH],
            shininess: [1.0; BATCH],
            glossy: false,
            media: Transmissions::default(),
        }
    }
}

/// A packet's shading data while its primitives are gone through.
#[derive(Clone, Copy)]
struct Gathered<L> {
    point: Vec3<L>,
    normal: Vec3<L>,
    reach: L,
    /// What stands for the largest coordinate in the lift.
    coordinate: L,
    color: Vec3<L>,
    own: L,
    mirror: L,
    specular: L,
    shininess: L,
    glossy: bool,
    /// Of account only in a rich scene, as are the next, and `own`.
    transmission: L,
    additive: L,
}

impl Surfaces {
    /// Starts a wave: nothing hit yet.
    pub fn start(&mut self) {
        self.glossy = false;
        // Packets without an active ray are passed over later on.
        self.lift = [-1.0; BATCH];
    }

    /// Finds the surfaces of packet `at`, which hit `hit` wherever `hit.found`.
    ///
    /// Neighbouring rays mostly hit the same primitive, so each primitive in the packet is looked at once, for all
    /// lanes, and selected where it was hit.
    #[inline(always)]
    pub fn find<L: Lanes, C: Contents>(
        &mut self,
        scene: &Scene,
        wave: &Wave,
        at: usize,
        hit: &Nearest<L>,
        deeper: &mut Deeper,
    ) {
        let direction = Vec3::<L>::load(&wave.rays.direction, at);
        let p = direction.mul_add(hit.t, wave.rays.origins(at));
        let mut ids = [0; MAX_LANES];
        hit.primitive.store_ids(&mut ids);
        let first = ids[hit.found.bits().trailing_zeros() as usize];
        let mut g = gather::<L, C>(scene, first, p);
        let mut left = hit.found.bits() & !hit.primitive.is_id(first).bits();
        while left != 0 {
            let id = ids[left.trailing_zeros() as usize];
            let same = hit.primitive.is_id(id);
            g = gather::<L, C>(scene, id, p).select(same, g);
            left &= !same.bits();
        }
        let behind = g.normal.dot(direction).gt(L::zero());
        g.point.store(&mut self.point, at);
        (-g.normal).select(behind, g.normal).store(&mut self.normal, at);
        if C::ALL && scene.plan.smooth {
            self.smooth::<L>(scene, at, &ids, hit.found.bits());
        }
        let offsets = Offsets::of(&scene.plan.methods);
        let lift = match C::ALL && scene.plan.refracts {
            false => offsets.lift(g.point, g.reach),
            true => offsets.lift_by(g.coordinate, g.reach),
        };
        lift.select(hit.found, L::splat(-1.0)).store(&mut self.lift[at..]);
        let weight = L::load(&wave.weight[at..]);
        let own = weight * if C::ALL { g.own } else { L::splat(1.0) - g.mirror };
        (g.color * own).store(&mut self.color, at);
        (weight * g.mirror).store(&mut self.mirror[at..]);
        if scene.plan.highlights {
            self.glossy |= g.glossy;
            (g.specular * own).store(&mut self.specular[at..]);
            g.shininess.store(&mut self.shininess[at..]);
        }
        if C::ALL && scene.plan.refracts {
            (weight * g.transmission).store(&mut self.media.transmission[at..]);
            g.additive.store(&mut self.media.additive[at..]);
            self.media.pass::<L>(scene, wave, at, hit, !behind, deeper);
        }
    }

    /// Interpolates the normals of packet `at`, whose rays hit these ids where the bits say so, and finds from where they
    /// see lights.
    #[inline(never)]
    fn smooth<L: Lanes>(&mut self, scene: &Scene, at: usize, ids: &[u32; MAX_LANES], found: u32) {
        let (point, own) = (Vec3::<L>::load(&self.point, at), Vec3::<L>::load(&self.normal, at));
        own.store(&mut self.geometric, at);
        let (mut normal, mut raised, mut left) = (own, point, found);
        while left != 0 {
            let id = ids[left.trailing_zeros() as usize];
            let same = L::id_mask(ids, id);
            left &= !same.bits();
            let surface = Surface { point, normal: own, reach: 0.0 };
            if let Some([smooth, rise]) = smooth(scene, id, &surface) {
                normal = smooth.select(same, normal);
                raised = spawn::raise(point, rise, own).select(same, raised);
            }
        }
        normal.store(&mut self.normal, at);
        raised.store(&mut self.raised, at);
    }

    /// From where packet `at` sees lights.
    #[inline(always)]
    pub fn seen_from<L: Lanes, C: Contents>(&self, scene: &Scene, at: usize) -> Vec3<L> {
        Vec3::load(if C::ALL && scene.plan.raised { &self.raised } else { &self.point }, at)
    }

    /// The unit normals of the surfaces themselves for packet `at`, turned against the rays.
    #[inline(always)]
    pub fn geometric_normal<L: Lanes, C: Contents>(&self, scene: &Scene, at: usize) -> Vec3<L> {
        Vec3::load(if C::ALL && scene.plan.smooth { &self.geometric } else { &self.normal }, at)
    }
}

impl Transmissions {
    /// Finds what lies before and behind the surfaces of packet `at`, and what absorption leaves of the rays up to
    /// there. Rays that pass through the same side of the same primitive from the same media are looked at once.
    #[inline(always)]
    fn pass<L: Lanes>(
        &mut self,
        scene: &Scene,
        wave: &Wave,
        at: usize,
        hit: &Nearest<L>,
        front: L::Mask,
        deeper: &mut Deeper,
    ) {
        let mut ids = [0; MAX_LANES];
        hit.primitive.store_ids(&mut ids);
        let before = &wave.inside[at..at + L::WIDTH];
        let front = front.bits();
        let (mut eta, mut absorption) = (L::splat(1.0), Vec3::splat(glam::Vec3::ZERO));
        let mut left = hit.found.bits();
        while left != 0 {
            let lane = left.trailing_zeros() as usize;
            let is_front = front >> lane & 1 == 1;
            let side = if is_front { front } else { !front };
            let same = left & side & hit.primitive.is_id(ids[lane]).bits() & alike(before, before[lane]);
            let medium = scene.medium(ids[lane]);
            let passage = Passage::new(scene, before[lane], medium, is_front, deeper);
            let lanes = L::Mask::from_bits(same);
            eta = L::splat(passage.eta).select(lanes, eta);
            absorption = Vec3::splat(scene.media[usize::from(passage.from)].absorption).select(lanes, absorption);
            for (lane, inside) in self.inside[at..at + L::WIDTH].iter_mut().enumerate() {
                *inside = if same >> lane & 1 == 1 { passage.inside } else { *inside };
            }
            left &= !same;
        }
        eta.store(&mut self.eta[at..]);
        if scene.plan.absorbs {
            let tint = Vec3::load(&wave.tint, at);
            absorbed(tint, absorption, hit.t).store(&mut self.tint, at);
        }
    }
}

/// Which of a packet's rays are in the media `these`, as bits.
#[inline(always)]
fn alike(inside: &[MediumStack], these: MediumStack) -> u32 {
    inside.iter().enumerate().fold(0, |bits, (lane, &inside)| bits | u32::from(inside == these) << lane)
}

/// A tint after a way `t` through something of the given absorption: e^(−σ t) of it.
#[inline(always)]
pub fn absorbed<L: Lanes>(tint: Vec3<L>, absorption: Vec3<L>, t: L) -> Vec3<L> {
    let per_unit = t * L::splat(-std::f32::consts::LOG2_E);
    let through = |tint: L, sigma: L| tint * exp2(sigma * per_unit);
    Vec3::new(through(tint.x, absorption.x), through(tint.y, absorption.y), through(tint.z, absorption.z))
}

impl<L: Lanes> Gathered<L> {
    #[inline(always)]
    fn select(self, mask: L::Mask, other: Self) -> Self {
        Self {
            point: self.point.select(mask, other.point),
            normal: self.normal.select(mask, other.normal),
            reach: self.reach.select(mask, other.reach),
            coordinate: self.coordinate.select(mask, other.coordinate),
            color: self.color.select(mask, other.color),
            own: self.own.select(mask, other.own),
            mirror: self.mirror.select(mask, other.mirror),
            specular: self.specular.select(mask, other.specular),
            shininess: self.shininess.select(mask, other.shininess),
            glossy: self.glossy | other.glossy,
            transmission: self.transmission.select(mask, other.transmission),
            additive: self.additive.select(mask, other.additive),
        }
    }
}

/// Primitive `id`'s surface and material at the points `p`.
#[inline(always)]
fn gather<L: Lanes, C: Contents>(scene: &Scene, id: u32, p: Vec3<L>) -> Gathered<L> {
    let Painted { surface, material: m, color } = painted::<L, C>(scene, id, p);
    let (point, coordinate) = match C::ALL && scene.plan.refracts {
        false => (surface.point, L::zero()),
        true => start(scene, id, &surface, m.transmission > 0.0),
    };
    Gathered {
        point,
        coordinate,
        normal: surface.normal,
        reach: L::splat(surface.reach),
        color,
        own: L::splat(if m.additive { 1.0 } else { 1.0 - m.reflectance - m.transmission }),
        mirror: L::splat(m.reflectance),
        specular: L::splat(m.specular),
        shininess: L::splat(m.shininess),
        glossy: m.specular > 0.0,
        transmission: L::splat(m.transmission),
        additive: L::splat(f32::from(u8::from(m.additive))),
    }
}

/// A surface, what it is made of, and its colour.
struct Painted<'a, L> {
    surface: Surface<L>,
    material: &'a Material,
    color: Vec3<L>,
}

/// Primitive `id` near the points `p`; a plane, sphere or triangle unless the scene may hold more.
#[inline(always)]
fn painted<L: Lanes, C: Contents>(scene: &Scene, id: u32, p: Vec3<L>) -> Painted<'_, L> {
    let first = &scene.first;
    if C::ALL && id >= first.quads {
        // Taken apart, so that nothing has to lie in memory for the others.
        let Painted { surface, material, color } = rare_painted(scene, id, p);
        Painted { surface, material, color }
    } else if id >= first.triangles {
        paint(scene, &scene.triangles, (id - first.triangles) as usize, p)
    } else if id >= first.spheres {
        paint(scene, &scene.spheres, (id - first.spheres) as usize, p)
    } else {
        paint(scene, &scene.planes, id as usize, p)
    }
}

/// [`painted`] for any kind; apart, so as not to weigh on planes, spheres and triangles.
#[inline(never)]
fn rare_painted<L: Lanes>(scene: &Scene, id: u32, p: Vec3<L>) -> Painted<'_, L> {
    with_primitive!(scene, id, |kind, i| paint(scene, kind, i, p))
}

/// Primitive `i` of a kind near the points `p`.
#[inline(always)]
fn paint<'a, K: Primitives, L: Lanes>(scene: &'a Scene, kind: &K, i: usize, p: Vec3<L>) -> Painted<'a, L> {
    let surface = kind.surface(i, p);
    let material = &scene.materials[kind.material(i) as usize];
    let color = match material.pigment {
        Pigment::Color(color) => Vec3::splat(color),
        Pigment::Checker { colors, size } => {
            let odd = odd_cell(kind.checker(i, &surface) * L::splat(1.0 / size));
            Vec3::splat(colors[1]).select(odd, Vec3::splat(colors[0]))
        }
        Pigment::Texture { texture, size, wrap } => textured(scene, kind, i, surface, texture, 1.0 / size, wrap),
    };
    Painted { surface, material, color }
}

/// Where the checkerboard shows its second colour, for places in cells; see [`Pigment::Checker`].
#[inline(always)]
fn odd_cell<L: Lanes>(q: Vec3<L>) -> L::Mask {
    let half = (q.x.floor() + q.y.floor() + q.z.floor()) * L::splat(0.5);
    !half.floor().eq(half)
}

/// The colour of a texture that has so many repeats from 0 to 1.
#[inline(never)]
fn textured<K: Primitives, L: Lanes>(
    scene: &Scene,
    kind: &K,
    i: usize,
    surface: Surface<L>,
    texture: usize,
    repeats: f32,
    wrap: Wrap,
) -> Vec3<L> {
    let uv = map2(kind.uv(i, &surface), |x| x * L::splat(repeats));
    let texture = &scene.textures[texture];
    match wrap {
        Wrap::Repeat => texture::sample(texture, uv, &Mapping::endless(), repeats),
        Wrap::Clamp => texture::sample(texture, uv, &Mapping::face(), 1.0),
        Wrap::Ends => {
            let mapping = kind.mapping(i, &surface);
            let color = texture::sample(texture, uv, &mapping, repeats);
            let poles = &scene.poles[kind.material(i) as usize];
            texture::at_poles(color, poles, uv[1], &mapping, repeats, texture.height)
        }
    }
}
