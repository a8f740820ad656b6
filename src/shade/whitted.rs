//! Whitted's algorithm over the waves of a tile: trace, light, and again with the rays that mirrors and transparent
//! media send on, compacted.

use super::around::around;
use super::light::Lighting;
use super::medium::{Deeper, MediumStack};
use super::queue::{Kind, Queue};
use super::refract::{Split, split};
use super::surfaces::{Surfaces, absorbed};
use super::wave::{Leaving, Observer, Stage, Wave};
use super::{sky, spawn};
use crate::math::{BATCH, LaneMask, Lanes, MAX_LANES, Vec3};
use crate::scene::{MIN_WEIGHT, Scene};
use crate::trace::{Bounds, Contents, Everything, Intersect, Prefetch, Scratch, trace, with_contents};

/// Rays traced, by kind.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Counts {
    /// From the eye.
    pub primary: u64,
    /// Towards lights; only where the surface faces the light.
    pub shadow: u64,
    /// From mirrors.
    pub reflection: u64,
    /// Through transparent surfaces.
    pub refraction: u64,
}

impl Counts {
    /// Of all kinds.
    pub fn total(&self) -> u64 {
        self.primary + self.shadow + self.reflection + self.refraction
    }
}

impl std::ops::Add for Counts {
    type Output = Self;
    fn add(self, o: Self) -> Self {
        Self {
            primary: self.primary + o.primary,
            shadow: self.shadow + o.shadow,
            reflection: self.reflection + o.reflection,
            refraction: self.refraction + o.refraction,
        }
    }
}

/// All that a thread needs to trace and shade a tile, kept between tiles.
#[derive(Clone, Debug)]
#[repr(align(64))]
pub struct Workspace {
    /// The eye rays, ray i for pixel i; filled by the caller and left as they are, but for the media they start in.
    pub primary: Wave,
    /// The tile's linear radiance.
    pub radiance: [[f32; BATCH]; 3],
    queue: Queue,
    surfaces: Surfaces,
    lighting: Lighting,
    scratch: Scratch,
    /// What stacks of more than four media stand on.
    deeper: Deeper,
    /// The eye of the last tile, and the media around it.
    eye: Option<(glam::Vec3, MediumStack)>,
}

impl Default for Workspace {
    fn default() -> Self {
        Self {
            primary: Wave::default(),
            radiance: [[0.0; BATCH]; 3],
            queue: Queue::default(),
            surfaces: Surfaces::default(),
            lighting: Lighting::default(),
            scratch: Scratch::default(),
            deeper: Deeper::default(),
            eye: None,
        }
    }
}

/// As many stacks of media are kept from tile to tile.
const MOST_STACKS: usize = 1 << 14;

impl Workspace {
    /// Finds the media that the eye rays start in.
    #[inline(never)]
    fn start_inside(&mut self, scene: &Scene) {
        let origin = self.primary.rays.first_origin();
        let deeper = &mut self.deeper;
        if deeper.len() > MOST_STACKS {
            (*deeper, self.eye) = (Deeper::default(), None);
        }
        let inside = match self.eye {
            Some((eye, inside)) if eye == origin => inside,
            _ => around(scene, origin, deeper),
        };
        self.eye = Some((origin, inside));
        self.primary.inside = [inside; BATCH];
    }
}

/// Traces and shades the eye rays of `work.primary`, which start at one point, and all that follows from them into
/// `work.radiance`.
///
/// A workspace goes with one scene.
pub fn trace_waves<L: Lanes>(scene: &Scene, work: &mut Workspace, observer: &mut impl Observer) -> Counts {
    if scene.plan.refracts {
        work.start_inside(scene);
    }
    with_contents!(scene, scene.plan.rich, C => follow::<L, C>(scene, work, observer))
}

/// [`trace_waves`] for a scene of such contents.
fn follow<L: Lanes, C: Contents>(scene: &Scene, work: &mut Workspace, observer: &mut impl Observer) -> Counts {
    const { assert!(L::WIDTH <= MAX_LANES, "room for a packet's lanes is as wide as the widest kernel") };
    let mut counts = Counts { primary: work.primary.rays.active() as u64, ..Counts::default() };
    let Workspace { primary, radiance, queue, surfaces, lighting, scratch, deeper, .. } = work;
    *radiance = [[0.0; BATCH]; 3];
    observer.primary(&primary.rays);
    let mut workshop = Workshop { scene, radiance, queue, surfaces, lighting, scratch, deeper };
    let (mut queued, mut depth) = (None::<Box<Wave>>, 1);
    loop {
        counts.shadow += workshop.shade::<L, C>(queued.as_deref().unwrap_or(primary), depth, observer);
        if let Some(wave) = queued.take() {
            workshop.queue.give_back(wave);
        }
        let Some((wave, at, kind)) = workshop.queue.take() else { return counts };
        match kind {
            Kind::Reflection => {
                counts.reflection += wave.rays.len as u64;
                observer.reflection(&wave.rays);
            }
            Kind::Refraction => {
                counts.refraction += wave.rays.len as u64;
                observer.refraction(&wave.rays);
            }
        }
        (queued, depth) = (Some(wave), at);
    }
}

/// The scene and the memory that a tile's waves are traced and shaded with.
struct Workshop<'a> {
    scene: &'a Scene,
    radiance: &'a mut [[f32; BATCH]; 3],
    queue: &'a mut Queue,
    surfaces: &'a mut Surfaces,
    lighting: &'a mut Lighting,
    scratch: &'a mut Scratch,
    deeper: &'a mut Deeper,
}

impl Workshop<'_> {
    /// Traces and shades a wave, and queues the rays that go on from there; the number of shadow rays.
    fn shade<L: Lanes, C: Contents>(&mut self, wave: &Wave, depth: u32, observer: &mut impl Observer) -> u64 {
        let scene = self.scene;
        let any = self.arrive::<L, C>(wave, depth);
        observer.done(Stage::Arrive);
        if !any {
            return 0;
        }
        self.lighting.start(scene, self.surfaces.glossy);
        let mut shadow = 0;
        for light in 0..scene.lights.len() {
            shadow += self.lighting.add::<L, C>(scene, light, wave, self.surfaces, self.scratch, observer);
        }
        self.leave::<L, C>(wave, depth);
        observer.done(Stage::Leave);
        shadow
    }

    /// Traces a wave; finds the surfaces of all hits and gives the sky to all misses. Whether there is any hit.
    #[inline(never)]
    fn arrive<L: Lanes, C: Contents>(&mut self, wave: &Wave, depth: u32) -> bool {
        let Self { scene, radiance, surfaces, scratch, deeper, .. } = self;
        let mut any = false;
        surfaces.start();
        trace::<Intersect, L, C>(
            scene,
            &wave.rays,
            Prefetch::NOTHING,
            || Bounds::of::<L>(&wave.rays),
            scratch,
            #[inline(always)]
            |at, active, hit| {
                if hit.found.any() {
                    any = true;
                    surfaces.find::<L, C>(scene, wave, at, hit, deeper);
                }
                let missed = active & !hit.found;
                if missed.any() {
                    let sky = sky::radiance(&scene.sky, Vec3::load(&wave.rays.direction, at));
                    let mut seen = sky * L::load(&wave.weight[at..]);
                    if C::ALL && scene.plan.absorbs {
                        seen = seen.times(endless::<L>(scene, wave, at));
                    }
                    deposit::<L>(wave, at, seen, missed, radiance, depth == 1);
                }
            },
        );
        any
    }

    /// Gives the light that the surfaces send back to their pixels, and queues the rays that go on.
    #[inline(never)]
    fn leave<L: Lanes, C: Contents>(&mut self, wave: &Wave, depth: u32) {
        let Self { scene, radiance, queue, surfaces, lighting, .. } = self;
        let last = depth == scene.plan.waves;
        // What mirrors send on is no more than what came.
        let mut next = queue.spare();
        for at in (0..wave.rays.len).step_by(L::WIDTH) {
            let lift = L::load(&surfaces.lift[at..]);
            let hit = lift.ge(L::zero());
            if !hit.any() {
                continue;
            }
            let color = Vec3::<L>::load(&surfaces.color, at);
            let mut sent = color.times(Vec3::load(&lighting.irradiance, at));
            if surfaces.glossy {
                sent = Vec3::load(&lighting.highlight, at).mul_add(L::load(&surfaces.specular[at..]), sent);
            }
            if C::ALL && scene.plan.absorbs {
                sent = sent.times(Vec3::load(&surfaces.media.tint, at));
            }
            deposit::<L>(wave, at, sent, hit, radiance, depth == 1);
            if last {
                continue;
            }
            if C::ALL && scene.plan.refracts {
                divide::<L>(scene, wave, surfaces, at, depth + 1, queue);
                continue;
            }
            let weight = L::load(&surfaces.mirror[at..]);
            let goes_on = hit & weight.gt(L::zero());
            if goes_on.any() {
                let (direction, point) = (Vec3::load(&wave.rays.direction, at), Vec3::load(&surfaces.point, at));
                let normal = Vec3::load(&surfaces.normal, at);
                let geometric = surfaces.geometric_normal::<L, C>(scene, at);
                let direction = match C::ALL && scene.plan.smooth {
                    false => spawn::mirror(direction, normal),
                    true => spawn::mirror_above(direction, normal, geometric),
                };
                let origin = geometric.mul_add(lift, point);
                let (inside, pixel) = (&wave.inside[at..], &wave.pixel[at..]);
                let leaving = Leaving { origin, direction, weight, tint: color, inside, pixel };
                next.append::<L, C>(&scene.plan, &leaving, goes_on);
            }
        }
        queue.put(depth + 1, next);
    }
}

/// Queues the reflected and the refracted rays of packet `at`.
#[inline(never)]
fn divide<L: Lanes>(scene: &Scene, wave: &Wave, surfaces: &Surfaces, at: usize, depth: u32, queue: &mut Queue) {
    let lift = L::load(&surfaces.lift[at..]);
    let hit = lift.ge(L::zero());
    let geometric = surfaces.geometric_normal::<L, Everything>(scene, at);
    let media = &surfaces.media;
    let Split { mirror, reflected, transmitted, refracted } = split(
        Vec3::load(&wave.rays.direction, at),
        Vec3::load(&surfaces.normal, at),
        scene.plan.smooth.then_some(geometric),
        L::load(&media.eta[at..]),
        [L::load(&surfaces.mirror[at..]), L::load(&media.transmission[at..])],
        L::load(&media.additive[at..]).gt(L::zero()),
    );
    let tint = Vec3::<L>::load(&media.tint, at);
    let strongest = if scene.plan.absorbs { tint.max_abs() } else { L::splat(1.0) };
    let counts = |weight: L| hit & (weight * strongest).ge(L::splat(MIN_WEIGHT));
    let point = Vec3::load(&surfaces.point, at);
    let (goes_on, pixel) = (counts(mirror), &wave.pixel[at..]);
    if goes_on.any() {
        let (origin, inside) = (geometric.mul_add(lift, point), &wave.inside[at..]);
        let leaving = Leaving { origin, direction: reflected, weight: mirror, tint, inside, pixel };
        queue.append::<L>(&scene.plan, depth, Kind::Reflection, &leaving, goes_on);
    }
    let goes_on = counts(transmitted);
    if goes_on.any() {
        let (origin, inside) = (geometric.mul_add(-lift, point), &media.inside[at..]);
        let leaving = Leaving { origin, direction: refracted, weight: transmitted, tint, inside, pixel };
        queue.append::<L>(&scene.plan, depth, Kind::Refraction, &leaving, goes_on);
    }
}

/// The tints of packet `at` after a way without an end.
#[inline(never)]
fn endless<L: Lanes>(scene: &Scene, wave: &Wave, at: usize) -> Vec3<L> {
    let mut absorption = [[0.0; MAX_LANES]; 3];
    for (lane, inside) in wave.inside[at..at + L::WIDTH].iter().enumerate() {
        let sigma = scene.media[usize::from(inside.medium())].absorption;
        (0..3).for_each(|axis| absorption[axis][lane] = sigma[axis]);
    }
    absorbed(Vec3::load(&wave.tint, at), Vec3::load(&absorption, 0), L::splat(0.5 * f32::MAX))
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
    // Many packets are runs of pixels still.
    let first = usize::from(wave.pixel[at]);
    let strays = wave.pixel[at..at + L::WIDTH]
        .iter()
        .enumerate()
        .fold(0, |strays, (lane, &pixel)| strays | u32::from(usize::from(pixel) != first + lane) << lane);
    if mask.bits() & strays == 0 && first + L::WIDTH <= BATCH {
        let old = Vec3::load(radiance, first);
        (old + rgb).select(mask, old).store(radiance, first);
        return;
    }
    let mut lanes = [[0.0; MAX_LANES]; 3];
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
