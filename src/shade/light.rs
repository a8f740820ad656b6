//! One light's share of a wave: its shadow rays, and what arrives.

use super::spawn;
use super::surface::Surfaces;
use super::wave::{Observer, Wave};
use crate::math::{BATCH, Blocked, LaneMask, Lanes, RayBatch, Vec3, powf};
use crate::scene::{Light, Scene, ShadowStart};
use crate::trace::{Candidates, occluded};

/// 1 / (4 π).
const PER_SPHERE: f32 = 0.25 * std::f32::consts::FRAC_1_PI;

/// Room for one light's work on a wave, and the sum over the lights.
#[derive(Clone, Debug, Default)]
pub struct Lighting {
    rays: RayBatch,
    blocked: Blocked,
    /// Irradiance so far.
    pub irradiance: Columns,
    /// Highlights so far, still to be weighted.
    pub highlight: Columns,
    /// This light's E · n·l, for a power of 1.
    diffuse: Column,
    /// This light's E, for a power of 1; only where something is glossy, as is the next.
    arriving: Column,
    /// r·l, then (r·l)^shininess.
    gloss: Column,
}

/// A number a ray.
#[derive(Clone, Debug)]
#[repr(align(64))]
pub struct Column(pub [f32; BATCH]);

/// A colour a ray.
#[derive(Clone, Debug)]
#[repr(align(64))]
pub struct Columns(pub [[f32; BATCH]; 3]);

impl Default for Column {
    fn default() -> Self {
        Self([0.0; BATCH])
    }
}

impl Default for Columns {
    fn default() -> Self {
        Self([[0.0; BATCH]; 3])
    }
}

impl Lighting {
    /// Starts a wave of `len` rays: ambient light only.
    pub fn start(&mut self, scene: &Scene, len: usize, glossy: bool) {
        for axis in 0..3 {
            self.irradiance.0[axis][..len].fill(scene.settings.ambient[axis]);
            if glossy {
                self.highlight.0[axis][..len].fill(0.0);
            }
        }
    }

    /// Adds light `light`; returns the number of shadow rays.
    #[inline(always)]
    pub fn add<L: Lanes>(
        &mut self,
        scene: &Scene,
        light: usize,
        wave: &Wave,
        surfaces: &Surfaces,
        scratch: &mut Candidates,
        observer: &mut impl Observer,
    ) -> u64 {
        let count = self.fire::<L>(scene, light, wave, surfaces);
        if count > 0 {
            observer.shadow(&self.rays);
            occluded::<L>(scene, &self.rays, &mut self.blocked, scratch);
            if surfaces.glossy {
                for at in 0..wave.rays.len {
                    self.gloss.0[at] = powf(self.gloss.0[at], surfaces.shininess[at]);
                }
            }
            self.collect::<L>(&scene.lights[light], wave.rays.len, surfaces.glossy);
        }
        count
    }

    /// Makes the shadow rays: one for every hit that faces the light.
    #[inline(always)]
    fn fire<L: Lanes>(&mut self, scene: &Scene, light: usize, wave: &Wave, surfaces: &Surfaces) -> u64 {
        let position = Vec3::splat(scene.lights[light].position);
        let start = scene.plan.shadows[light];
        let mut count = 0;
        self.rays.len = wave.rays.len;
        match start {
            ShadowStart::Light => self.rays.set_common_origin(scene.lights[light].position),
            ShadowStart::Point => self.rays.common_origin = false,
        }
        for at in (0..wave.rays.len).step_by(L::WIDTH) {
            let lift = L::load(&surfaces.lift[at..]);
            let hit = lift.ge(L::zero());
            if !hit.any() {
                L::splat(-1.0).store(&mut self.rays.t_max[at..]);
                continue;
            }
            let normal = Vec3::load(&surfaces.normal, at);
            let point = Vec3::load(&surfaces.point, at);
            let ray = match start {
                ShadowStart::Light => spawn::shadow_from_light(position, point, normal, lift),
                ShadowStart::Point => spawn::shadow_from_point(position, point, normal, lift),
            };
            let lit = hit & ray.cosine.gt(L::zero());
            count += u64::from(lit.bits().count_ones());
            if start == ShadowStart::Point {
                ray.origin.store(&mut self.rays.origin, at);
            }
            ray.direction.store(&mut self.rays.direction, at);
            ray.t_max.select(lit, L::splat(-1.0)).store(&mut self.rays.t_max[at..]);
            let e = if scene.settings.attenuation {
                ray.inverse * ray.inverse * L::splat(PER_SPHERE)
            } else {
                L::splat(1.0)
            };
            (e * ray.cosine).store(&mut self.diffuse.0[at..]);
            if surfaces.glossy {
                let mirrored = spawn::mirror(Vec3::load(&wave.rays.direction, at), normal);
                let cosine = mirrored.dot(ray.direction);
                let towards = if start == ShadowStart::Light { -cosine } else { cosine };
                e.store(&mut self.arriving.0[at..]);
                towards.store(&mut self.gloss.0[at..]);
            }
        }
        count
    }

    /// Adds what the light does where nothing blocks it.
    #[inline(always)]
    fn collect<L: Lanes>(&mut self, light: &Light, len: usize, glossy: bool) {
        let power = Vec3::<L>::splat(light.power);
        for at in (0..len).step_by(L::WIDTH) {
            let seen = !L::Mask::from_bits(self.blocked.get(at, L::WIDTH));
            let lit = L::load(&self.rays.t_max[at..]).ge(L::zero()) & seen;
            if !lit.any() {
                continue;
            }
            let diffuse = L::load(&self.diffuse.0[at..]).select(lit, L::zero());
            let sum = Vec3::load(&self.irradiance.0, at);
            power.mul_add(diffuse, sum).store(&mut self.irradiance.0, at);
            if glossy {
                let gloss = L::load(&self.gloss.0[at..]) * L::load(&self.arriving.0[at..]);
                let sum = Vec3::load(&self.highlight.0, at);
                power.mul_add(gloss.select(lit, L::zero()), sum).store(&mut self.highlight.0, at);
            }
        }
    }
}
