//! The waves of a tile: trace, light, mirror, and again with the mirrored rays, compacted.

use super::light::Lighting;
use super::spawn;
use super::surface::Surfaces;
use crate::math::{BATCH, HitBatch, LaneMask, Lanes, RayBatch, Vec3};
use crate::scene::Scene;
use crate::trace::{Candidates, intersect};

/// Rays traced, by kind.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Counts {
    /// From the eye.
    pub primary: u64,
    /// Towards lights; only where the surface faces the light.
    pub shadow: u64,
    /// From mirrors.
    pub reflection: u64,
}

impl Counts {
    /// Of all kinds.
    pub fn total(&self) -> u64 {
        self.primary + self.shadow + self.reflection
    }
}

impl std::ops::Add for Counts {
    type Output = Self;
    fn add(self, o: Self) -> Self {
        Self {
            primary: self.primary + o.primary,
            shadow: self.shadow + o.shadow,
            reflection: self.reflection + o.reflection,
        }
    }
}

/// Rays on their way, and what they are worth.
#[derive(Clone, Debug)]
#[repr(align(64))]
pub struct Wave {
    /// The rays.
    pub rays: RayBatch,
    /// What a ray's radiance counts for in its pixel.
    pub weight: [f32; BATCH],
    /// The pixel of the tile.
    pub pixel: [u8; BATCH],
}

impl Default for Wave {
    /// No rays, but weight 1 and pixel i for ray i, as eye rays have them.
    fn default() -> Self {
        Self { rays: RayBatch::default(), weight: [1.0; BATCH], pixel: std::array::from_fn(|i| i as u8) }
    }
}

/// Watches the rays of a tile go by; `()` does not, at no cost.
pub trait Observer {
    /// The eye rays.
    fn primary(&mut self, _rays: &RayBatch) {}
    /// One light's shadow rays, from the light.
    fn shadow(&mut self, _rays: &RayBatch) {}
    /// A wave of mirrored rays.
    fn reflection(&mut self, _rays: &RayBatch) {}
}

impl Observer for () {}

/// All that a thread needs to trace and shade a tile, kept between tiles.
#[derive(Clone, Debug)]
#[repr(align(64))]
pub struct Workspace {
    /// The eye rays, ray i for pixel i; filled by the caller and left as they are.
    pub primary: Wave,
    /// The tile's linear radiance.
    pub radiance: [[f32; BATCH]; 3],
    /// The hits of the latest wave.
    pub hits: HitBatch,
    waves: [Wave; 2],
    surfaces: Surfaces,
    lighting: Lighting,
    candidates: Candidates,
}

impl Default for Workspace {
    fn default() -> Self {
        Self {
            primary: Wave::default(),
            radiance: [[0.0; BATCH]; 3],
            hits: HitBatch::default(),
            waves: [Wave::default(), Wave::default()],
            surfaces: Surfaces::default(),
            lighting: Lighting::default(),
            candidates: Candidates::default(),
        }
    }
}

/// Traces and shades the eye rays of `work.primary` and all that follows from them into `work.radiance`.
pub fn trace_waves<L: Lanes>(scene: &Scene, work: &mut Workspace, observer: &mut impl Observer) -> Counts {
    let mut counts = Counts { primary: work.primary.rays.active() as u64, ..Counts::default() };
    let Workspace { primary, radiance, hits, waves, surfaces, lighting, candidates } = work;
    for axis in radiance.iter_mut() {
        axis[..primary.rays.len].fill(0.0);
    }
    let [even, odd] = waves;
    observer.primary(&primary.rays);
    for depth in 1..=scene.plan.waves {
        let (wave, next): (&Wave, &mut Wave) = match depth {
            1 => (primary, &mut *odd),
            d if d % 2 == 0 => (odd, &mut *even),
            _ => (even, &mut *odd),
        };
        let len = wave.rays.len;
        intersect::<L>(scene, &wave.rays, hits, candidates);
        let any = arrive::<L>(scene, wave, hits, surfaces, radiance, depth == 1);
        if !any {
            break;
        }
        lighting.start(scene, len, surfaces.glossy);
        for light in &scene.lights {
            counts.shadow += lighting.add::<L>(scene, light, wave, surfaces, candidates, observer);
        }
        settle::<L>(wave, surfaces, lighting, radiance, depth == 1);
        if depth == scene.plan.waves {
            break;
        }
        reflect::<L>(wave, surfaces, next);
        counts.reflection += next.rays.len as u64;
        if next.rays.len == 0 {
            break;
        }
        observer.reflection(&next.rays);
    }
    counts
}

/// Finds the surfaces of all hits and gives the sky to all misses; whether there is any hit.
fn arrive<L: Lanes>(
    scene: &Scene,
    wave: &Wave,
    hits: &HitBatch,
    surfaces: &mut Surfaces,
    radiance: &mut [[f32; BATCH]; 3],
    in_order: bool,
) -> bool {
    let sky = Vec3::<L>::splat(scene.sky.color);
    let mut any = false;
    surfaces.glossy = false;
    for at in (0..wave.rays.len).step_by(L::WIDTH) {
        let active = L::load(&wave.rays.t_max[at..]).ge(L::zero());
        let hit = active & L::load(&hits.t[at..]).lt(L::splat(f32::INFINITY));
        any |= hit.any();
        surfaces.find::<L>(scene, wave, hits, at, hit);
        let missed = active & !hit;
        if missed.any() {
            deposit(wave, at, sky * L::load(&wave.weight[at..]), missed, radiance, in_order);
        }
    }
    any
}

/// Gives the light that the surfaces send back to their pixels.
fn settle<L: Lanes>(
    wave: &Wave,
    surfaces: &Surfaces,
    lighting: &Lighting,
    radiance: &mut [[f32; BATCH]; 3],
    in_order: bool,
) {
    for at in (0..wave.rays.len).step_by(L::WIDTH) {
        let hit = L::load(&surfaces.lift[at..]).ge(L::zero());
        if !hit.any() {
            continue;
        }
        let color = Vec3::<L>::load(&surfaces.color, at);
        let irradiance = Vec3::<L>::load(&lighting.irradiance.0, at);
        let mut sent = Vec3::new(color.x * irradiance.x, color.y * irradiance.y, color.z * irradiance.z);
        if surfaces.glossy {
            sent = Vec3::load(&lighting.highlight.0, at).mul_add(L::load(&surfaces.specular[at..]), sent);
        }
        deposit(wave, at, sent, hit, radiance, in_order);
    }
}

/// Adds a packet's radiance to its pixels; `in_order` says that ray i belongs to pixel i.
#[inline(always)]
fn deposit<L: Lanes>(
    wave: &Wave,
    at: usize,
    rgb: Vec3<L>,
    mask: L::Mask,
    radiance: &mut [[f32; BATCH]; 3],
    in_order: bool,
) {
    if in_order {
        let old = Vec3::load(radiance, at);
        (old + rgb).select(mask, old).store(radiance, at);
        return;
    }
    let mut lanes = [[0.0; 8]; 3];
    rgb.store(&mut lanes, 0);
    let mut left = mask.bits();
    while left != 0 {
        let lane = left.trailing_zeros() as usize;
        let pixel = usize::from(wave.pixel[at + lane]);
        for axis in 0..3 {
            radiance[axis][pixel] += lanes[axis][lane];
        }
        left &= left - 1;
    }
}

/// Makes the mirrors' rays, packed together.
fn reflect<L: Lanes>(wave: &Wave, surfaces: &Surfaces, next: &mut Wave) {
    next.rays.clear();
    for at in (0..wave.rays.len).step_by(L::WIDTH) {
        let lift = L::load(&surfaces.lift[at..]);
        let weight = L::load(&surfaces.mirror[at..]);
        let goes_on = lift.ge(L::zero()) & weight.gt(L::zero());
        let mut left = goes_on.bits();
        if left == 0 {
            continue;
        }
        let (point, normal) = (Vec3::load(&surfaces.point, at), Vec3::load(&surfaces.normal, at));
        let (origin, direction) = spawn::reflected(Vec3::load(&wave.rays.direction, at), point, normal, lift);
        let (mut o, mut d, mut w) = ([[0.0; 8]; 3], [[0.0; 8]; 3], [0.0; 8]);
        origin.store(&mut o, 0);
        direction.store(&mut d, 0);
        weight.store(&mut w);
        while left != 0 {
            let lane = left.trailing_zeros() as usize;
            let to = next.rays.len;
            next.weight[to] = w[lane];
            next.pixel[to] = wave.pixel[at + lane];
            let one = |c: &[[f32; 8]; 3]| glam::Vec3::new(c[0][lane], c[1][lane], c[2][lane]);
            next.rays.push(one(&o), one(&d), 0.0, f32::INFINITY);
            left &= left - 1;
        }
    }
}
