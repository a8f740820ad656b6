//! Whitted's algorithm over the waves of a tile: trace, light, mirror, and again with the mirrored rays, compacted.

use super::light::Lighting;
use super::sky;
use super::spawn;
use super::surface::Surfaces;
use super::wave::{Observer, Wave};
use crate::math::{BATCH, LaneMask, Lanes, Vec3};
use crate::scene::Scene;
use crate::trace::{Bounds, Candidates, nearest_hits};

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

/// All that a thread needs to trace and shade a tile, kept between tiles.
#[derive(Clone, Debug)]
#[repr(align(64))]
pub struct Workspace {
    /// The eye rays, ray i for pixel i; filled by the caller and left as they are.
    pub primary: Wave,
    /// The tile's linear radiance.
    pub radiance: [[f32; BATCH]; 3],
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
    let Workspace { primary, radiance, waves, surfaces, lighting, candidates } = work;
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
        if !arrive::<L>(scene, wave, surfaces, radiance, candidates, depth == 1) {
            break;
        }
        lighting.start(scene, len, surfaces.glossy);
        for light in 0..scene.lights.len() {
            counts.shadow += lighting.add::<L>(scene, light, wave, surfaces, candidates, observer);
        }
        let last = depth == scene.plan.waves;
        next.rays.clear();
        leave::<L>(wave, surfaces, lighting, radiance, depth == 1, if last { None } else { Some(&mut *next) });
        counts.reflection += next.rays.len as u64;
        if next.rays.len == 0 {
            break;
        }
        observer.reflection(&next.rays);
    }
    counts
}

/// Traces a wave; finds the surfaces of all hits and gives the sky to all misses. Whether there is any hit.
#[inline(always)]
fn arrive<L: Lanes>(
    scene: &Scene,
    wave: &Wave,
    surfaces: &mut Surfaces,
    radiance: &mut [[f32; BATCH]; 3],
    candidates: &mut Candidates,
    in_order: bool,
) -> bool {
    let Some(bounds) = Bounds::of::<L>(&wave.rays) else { return false };
    let mut any = false;
    surfaces.start(wave.rays.len);
    nearest_hits::<L>(scene, &wave.rays, &bounds, candidates, |at, active, hit| {
        if hit.found.any() {
            any = true;
            surfaces.find::<L>(scene, wave, at, hit);
        }
        let missed = active & !hit.found;
        if missed.any() {
            let sky = sky::radiance(&scene.sky, Vec3::load(&wave.rays.direction, at));
            deposit(wave, at, sky * L::load(&wave.weight[at..]), missed, radiance, in_order);
        }
    });
    any
}

/// Gives the light that the surfaces send back to their pixels, and makes the mirrors' rays, packed together.
#[inline(always)]
fn leave<L: Lanes>(
    wave: &Wave,
    surfaces: &Surfaces,
    lighting: &Lighting,
    radiance: &mut [[f32; BATCH]; 3],
    in_order: bool,
    mut next: Option<&mut Wave>,
) {
    for at in (0..wave.rays.len).step_by(L::WIDTH) {
        let lift = L::load(&surfaces.lift[at..]);
        let hit = lift.ge(L::zero());
        if !hit.any() {
            continue;
        }
        let color = Vec3::<L>::load(&surfaces.color, at);
        let irradiance = Vec3::<L>::load(&lighting.irradiance, at);
        let mut sent = Vec3::new(color.x * irradiance.x, color.y * irradiance.y, color.z * irradiance.z);
        if surfaces.glossy {
            sent = Vec3::load(&lighting.highlight, at).mul_add(L::load(&surfaces.specular[at..]), sent);
        }
        deposit(wave, at, sent, hit, radiance, in_order);
        if let Some(next) = &mut next {
            let weight = L::load(&surfaces.mirror[at..]);
            let goes_on = hit & weight.gt(L::zero());
            if goes_on.any() {
                let (point, normal) = (Vec3::load(&surfaces.point, at), Vec3::load(&surfaces.normal, at));
                let (o, d) = spawn::reflected(Vec3::load(&wave.rays.direction, at), point, normal, lift);
                next.append(o, d, weight, &wave.pixel[at..at + L::WIDTH], goes_on);
            }
        }
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
    // Packing keeps the order, so a packet whose ends are a width apart is a run of pixels.
    let first = usize::from(wave.pixel[at]);
    if mask.all() && usize::from(wave.pixel[at + L::WIDTH - 1]) == first + L::WIDTH - 1 {
        (Vec3::load(radiance, first) + rgb).store(radiance, first);
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
