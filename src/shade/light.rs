//! One light's share of a wave: its shadow rays, and what arrives.

use super::spawn::{self, Offsets, ShadowRay};
use super::surfaces::Surfaces;
use super::wave::{Observer, Stage, Wave};
use crate::geometry::Primitives;
use crate::math::{BATCH, LaneMask, Lanes, RayBatch, Vec3, map3, powf};
use crate::scene::{Light, Scene, ShadowStart};
use crate::trace::{Bounds, Contents, Extent, Occluded, Prefetch, Scratch, Span, trace};

/// 1 / (4 π).
const PER_SPHERE: f32 = 0.25 * std::f32::consts::FRAC_1_PI;

/// A number a ray.
pub type Column = [f32; BATCH];

/// Room for one light's work on a wave, and the sums over the lights.
#[derive(Clone, Debug)]
#[repr(align(64))]
pub struct Lighting {
    rays: RayBatch,
    /// Irradiance so far.
    pub irradiance: [Column; 3],
    /// Highlights so far, still to be weighted.
    pub highlight: [Column; 3],
    /// This light's E, for a power of 1.
    arriving: Column,
    /// This light's n·l.
    cosine: Column,
}

impl Default for Lighting {
    fn default() -> Self {
        Self {
            rays: RayBatch::default(),
            irradiance: [[0.0; BATCH]; 3],
            highlight: [[0.0; BATCH]; 3],
            arriving: [0.0; BATCH],
            cosine: [0.0; BATCH],
        }
    }
}

/// Whether a query needs the bounds of its rays: for lists, and for what is in no tree.
fn bounds_wanted(scene: &Scene) -> bool {
    scene.bvh.is_none() || !scene.planes.is_empty()
}

impl Lighting {
    /// Starts a wave: ambient light only.
    pub fn start(&mut self, scene: &Scene, glossy: bool) {
        // Whole columns, as to fill a part is a call.
        self.irradiance = map3(scene.settings.ambient.to_array(), |ambient| [ambient; BATCH]);
        if glossy {
            self.highlight = [[0.0; BATCH]; 3];
        }
    }

    /// Adds light `light`; returns the number of shadow rays.
    pub fn add<L: Lanes, C: Contents>(
        &mut self,
        scene: &Scene,
        light: usize,
        wave: &Wave,
        surfaces: &Surfaces,
        scratch: &mut Scratch,
        observer: &mut impl Observer,
    ) -> u64 {
        let (count, bounds) = match scene.plan.shadows[light] {
            ShadowStart::Light => self.fire_from_light::<L, C>(scene, light, wave, surfaces),
            ShadowStart::Point => self.fire_from_points::<L, C>(scene, light, wave, surfaces),
        };
        observer.done(Stage::Fire);
        if count > 0 {
            observer.shadow(&self.rays);
            self.collect::<L, C>(scene, &scene.lights[light], bounds, wave, surfaces, scratch);
            observer.done(Stage::Light);
        }
        count
    }

    /// Makes the shadow rays, one for every hit that faces the light, from the light.
    #[inline(never)]
    fn fire_from_light<L: Lanes, C: Contents>(
        &mut self,
        scene: &Scene,
        light: usize,
        wave: &Wave,
        surfaces: &Surfaces,
    ) -> (u64, Option<Bounds>) {
        let position = scene.lights[light].position;
        self.rays.set_common_origin(position);
        let mut directions = Extent::<L>::empty();
        let offsets = Offsets::of(&scene.plan.methods);
        let wanted = bounds_wanted(scene);
        let count = self.fire::<L, C>(
            scene,
            wave,
            surfaces,
            -1.0,
            #[inline(always)]
            |point, normal, lift| spawn::shadow_from_light(&offsets, Vec3::splat(position), point, normal, lift),
            #[inline(always)]
            |_, _, ray, lit| {
                if wanted {
                    directions.include(ray.direction, lit);
                }
            },
        );
        (count, wanted.then(|| Bounds::new(Span::at(position), directions.span())))
    }

    /// Makes the same rays, from the points.
    #[inline(never)]
    fn fire_from_points<L: Lanes, C: Contents>(
        &mut self,
        scene: &Scene,
        light: usize,
        wave: &Wave,
        surfaces: &Surfaces,
    ) -> (u64, Option<Bounds>) {
        let position = Vec3::splat(scene.lights[light].position);
        self.rays.common_origin = false;
        let (mut origins, mut directions) = (Extent::<L>::empty(), Extent::<L>::empty());
        let offsets = Offsets::of(&scene.plan.methods);
        let wanted = bounds_wanted(scene);
        let count = self.fire::<L, C>(
            scene,
            wave,
            surfaces,
            1.0,
            #[inline(always)]
            |point, normal, lift| spawn::shadow_from_point(&offsets, position, point, normal, lift),
            #[inline(always)]
            |rays, at, ray, lit| {
                if wanted {
                    directions.include(ray.direction, lit);
                    origins.include(ray.origin, lit);
                }
                ray.origin.store(&mut rays.origin, at);
            },
        );
        (count, wanted.then(|| Bounds::new(origins.span(), directions.span())))
    }

    /// Makes the shadow rays by `spawn` of point, normal and lift, and hands them to `made` with packet and lanes; their
    /// number. `towards` is 1 where they run to the light and −1 where they come from it.
    #[inline(always)]
    fn fire<L: Lanes, C: Contents>(
        &mut self,
        scene: &Scene,
        wave: &Wave,
        surfaces: &Surfaces,
        towards: f32,
        spawn: impl Fn(Vec3<L>, Vec3<L>, L) -> ShadowRay<L>,
        mut made: impl FnMut(&mut RayBatch, usize, &ShadowRay<L>, L::Mask),
    ) -> u64 {
        let mut count = 0;
        self.rays.set_len(wave.rays.len);
        for at in (0..wave.rays.len).step_by(L::WIDTH) {
            let lift = L::load(&surfaces.lift[at..]);
            let hit = lift.ge(L::zero());
            if !hit.any() {
                L::splat(-1.0).store(&mut self.rays.t_max[at..]);
                continue;
            }
            let point = surfaces.seen_from::<L, C>(scene, at);
            let ray = spawn(point, surfaces.geometric_normal::<L, C>(scene, at), lift);
            let (mut lit, mut cosine) = (hit & ray.cosine.gt(L::zero()), ray.cosine);
            if C::ALL && scene.plan.smooth {
                cosine = Vec3::<L>::load(&surfaces.normal, at).dot(ray.direction) * L::splat(towards);
                // From above its own triangle a ray may run below the triangle's plane.
                let above = if scene.plan.raised { hit } else { lit };
                lit = above & cosine.gt(L::zero());
            }
            made(&mut self.rays, at, &ray, lit);
            count += u64::from(lit.bits().count_ones());
            ray.direction.store(&mut self.rays.direction, at);
            ray.t_max.select(lit, L::splat(-1.0)).store(&mut self.rays.t_max[at..]);
            if scene.settings.attenuation {
                (ray.inverse * ray.inverse * L::splat(PER_SPHERE)).store(&mut self.arriving[at..]);
            }
            cosine.store(&mut self.cosine[at..]);
        }
        count
    }

    /// Traces the shadow rays, and adds what the light does where nothing blocks them.
    #[inline(never)]
    fn collect<L: Lanes, C: Contents>(
        &mut self,
        scene: &Scene,
        light: &Light,
        bounds: Option<Bounds>,
        wave: &Wave,
        surfaces: &Surfaces,
        scratch: &mut Scratch,
    ) {
        let Self { rays, irradiance, highlight, arriving, cosine } = self;
        let power = Vec3::<L>::splat(light.power);
        trace::<Occluded, L, C>(
            scene,
            rays,
            Prefetch::NOTHING,
            || bounds,
            scratch,
            #[inline(always)]
            |at, active, found| {
                let lit = active & !found.settled;
                if !lit.any() {
                    return;
                }
                let e = if scene.settings.attenuation { L::load(&arriving[at..]) } else { L::splat(1.0) };
                let diffuse = (e * L::load(&cosine[at..])).select(lit, L::zero());
                power.mul_add(diffuse, Vec3::load(irradiance, at)).store(irradiance, at);
                let shiny = lit & L::load(&surfaces.specular[at..]).gt(L::zero());
                if surfaces.glossy && shiny.any() {
                    let mirrored =
                        spawn::mirror(Vec3::<L>::load(&wave.rays.direction, at), Vec3::load(&surfaces.normal, at));
                    let away = Vec3::load(&rays.direction, at);
                    let off = if rays.common_origin { mirrored + away } else { mirrored - away };
                    // r·l of unit vectors, which is exact where it is close to 1 and never above it.
                    let towards = off.dot(off).mul_add(L::splat(-0.5), L::splat(1.0));
                    let shiny = shiny & towards.gt(L::zero());
                    if shiny.any() {
                        let gloss = (e * powf(towards, L::load(&surfaces.shininess[at..]))).select(shiny, L::zero());
                        power.mul_add(gloss, Vec3::load(highlight, at)).store(highlight, at);
                    }
                }
            },
        );
    }
}
