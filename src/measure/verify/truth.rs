//! The reference's answers for a scene, and to slightly different questions.
use super::bound::{K, Neighbourhood, ROUNDS, U};
use super::displayed;
use crate::reference::{self, Camera, Hit, Tracer};
use crate::scene::Description;
use crate::trace::NONE;
use glam::{BVec3, DVec3};

/// The largest difference in a displayed channel that does not count.
const STEP: f64 = 1.0 / 255.0;

/// The reference's answers for a scene, and the means to ask for those nearby.
#[derive(Debug)]
pub struct Truth {
    /// The scene's name.
    pub name: String,
    /// Width and height in pixels.
    pub size: [usize; 2],
    camera: Camera,
    tracer: Tracer,
    hits: Vec<Option<Hit>>,
    /// As displayed.
    pixels: Vec<DVec3>,
}

impl Truth {
    /// Traces the scene with the reference, in the caller's rayon pool.
    pub fn new(scene: &Description, width: usize, height: usize) -> Self {
        Self {
            name: scene.name.clone(),
            size: [width, height],
            camera: Camera::new(&scene.camera, width as f64 / height as f64),
            tracer: Tracer::new(scene),
            hits: reference::hits(scene, width, height),
            pixels: reference::render(scene, width, height, 1).into_iter().map(displayed).collect(),
        }
    }

    pub(super) fn rays(&self) -> usize {
        self.hits.len()
    }

    pub(super) fn primitive(&self, i: usize) -> u32 {
        self.hits[i].map_or(NONE, |hit| hit.primitive)
    }

    pub(super) fn t(&self, i: usize) -> f64 {
        self.hits[i].map_or(f64::INFINITY, |hit| hit.t)
    }

    pub(super) fn pixel(&self, i: usize) -> DVec3 {
        self.pixels[i]
    }

    /// Whether a question within the bound has this hit for an answer.
    pub(super) fn explains_hit(&self, i: usize, primitive: u32, t: f32) -> bool {
        let around = self.around(i, primitive);
        let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
        let mut asked = 0;
        ROUNDS.iter().any(|&until| {
            for q in (asked..until).map(|q| around.question(q)) {
                let nearest = self.tracer.intersect(q.origin, q.direction, f64::INFINITY).map(|hit| hit.t);
                let own = self.tracer.distance(primitive, q.origin, q.direction);
                // Where two surfaces are closer together than t can tell, either may be the nearer.
                let t = match (own, nearest) {
                    (None, None) if primitive == NONE => f64::INFINITY,
                    (Some(own), Some(nearest)) if own <= nearest * (1.0 + K * U) => own,
                    _ => continue,
                };
                (low, high) = (low.min(t), high.max(t));
            }
            asked = until;
            (low * (1.0 - K * U)..=high * (1.0 + K * U)).contains(&f64::from(t))
        })
    }

    /// Whether the questions within the bound disagree about this pixel, and their answers enclose this one.
    ///
    /// `primitive` is what the questioned tracer hit first.
    pub(super) fn explains_pixel(&self, i: usize, primitive: u32, shown: DVec3) -> bool {
        let around = self.around(i, primitive);
        let wrong = differing(shown, self.pixels[i]);
        let (mut low, mut high) = (self.pixels[i], self.pixels[i]);
        let mut asked = 0;
        for until in ROUNDS {
            for q in (asked..until).map(|q| around.question(q)) {
                let color = displayed(self.tracer.radiance_rounded(q.origin, q.direction, &q.rounding));
                (low, high) = (low.min(color), high.max(color));
            }
            asked = until;
            let split = differing(low, high);
            let enclosed = (shown.cmpge(low - STEP) & shown.cmple(high + STEP)).all();
            if enclosed && split & wrong == wrong {
                return true;
            }
            // No edge in sight: further rounds only cost time.
            if !split.any() {
                return false;
            }
        }
        false
    }

    /// The neighbourhood of a pixel's ray, where the reference hit what it hit and the other tracer hit `primitive`.
    fn around(&self, i: usize, primitive: u32) -> Neighbourhood {
        let [width, height] = self.size;
        let (x, y) = ((i % width) as f64 + 0.5, (i / width) as f64 + 0.5);
        let (origin, direction) = self.camera.ray(x / width as f64, y / height as f64);
        let hit = self.hits[i]
            .map_or(0.0, |hit| (origin + hit.t * direction).length().max(self.tracer.extent(hit.primitive)));
        let scale = origin.length().max(hit).max(self.tracer.extent(primitive));
        Neighbourhood { origin, direction, scale, k: K }
    }
}

/// The displayed channels that differ so much that it counts. NaN differs from everything.
pub(super) fn differing(a: DVec3, b: DVec3) -> BVec3 {
    !(a - b).abs().cmple(DVec3::splat(STEP))
}

/// The relative error of a distance; none between two misses, and [`f64::MAX`] for what is no distance at all.
pub(super) fn relative(t: f32, truth: f64) -> f64 {
    let t = f64::from(t);
    let error = if t == truth { 0.0 } else { (t - truth).abs() / truth };
    if error.is_finite() { error } else { f64::MAX }
}
