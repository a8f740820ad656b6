//! How wrong answers are.

use glam::DVec3;
use rayon::prelude::*;

use super::truth;
use crate::measure::cases::Ray;
use crate::measure::oracle::{Shape, Truth};
use crate::scene::Scene;
use crate::shade::facing_normals;
use crate::trace::Hit;

/// Wrong decisions looked at for whether rounding excuses them, at the most; the rest counts in proportion.
const LOOKED_AT: usize = 200;

/// Of the errors of a number of rays.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Quantiles {
    /// Half are at most this.
    pub median: f64,
    /// 99.9 % are at most this.
    pub p999: f64,
    /// All are at most this.
    pub worst: f64,
}

impl Quantiles {
    /// Of any errors, in any order; 0 of none.
    pub fn of(mut errors: Vec<f64>) -> Self {
        errors.sort_by(f64::total_cmp);
        let [median, p999, worst] = [0.5, 0.999, 1.0].map(|share| percentile(&errors, share));
        Self { median, p999, worst }
    }
}

/// The least of the sorted values that a `share` of them does not exceed (nearest rank); 0 of none.
pub fn percentile(sorted: &[f64], share: f64) -> f64 {
    let rank = (share * sorted.len() as f64).ceil() as usize;
    sorted.get(rank.clamp(1, sorted.len().max(1)) - 1).copied().unwrap_or(0.0)
}

/// How far `found` is from `truth`, in steps of `f32` at the truth (2⁻²³ of its power of two; 2⁻¹⁴⁹ at the least). What
/// is rounded correctly is off by at most ½.
pub fn ulps(found: f32, truth: f64) -> f64 {
    let exponent = if truth == 0.0 { -126 } else { (truth.abs().to_bits() >> 52) as i32 - 1023 };
    let step = f64::from_bits(((exponent.clamp(-126, 127) - 23 + 1023) as u64) << 52);
    (f64::from(found) - truth).abs() / step
}

/// The errors of a method on some rays.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Errors {
    /// Rays traced.
    pub rays: usize,
    /// Rays that hit, by the method and in truth: t and normal are judged on these.
    pub hits: usize,
    /// Rays that hit where they miss in truth, or miss where they hit.
    pub wrong: usize,
    /// How many of those are more than a matter of rounding; unknown in a scene of several primitives.
    pub unexcused: Option<usize>,
    /// Of t, in [`ulps`].
    pub t: Quantiles,
    /// The angle between the normals, in degrees.
    pub normal: Quantiles,
}

impl Errors {
    /// Wrong decisions a million rays.
    pub fn wrong_per_million(&self) -> f64 {
        per_million(self.wrong, self.rays)
    }

    /// Of `answers` to `rays` in `scene`, whose primitives are `shapes`. In the caller's rayon pool.
    pub fn of(
        scene: &Scene,
        shapes: &[Shape],
        rays: &[Ray],
        truths: &[Option<Truth>],
        answers: &[Option<Hit>],
    ) -> Self {
        Self::together(vec![Self::sample(scene, shapes, rays, truths, answers)])
    }

    /// The errors before quantiles are taken, so that samples from several scenes can be put
    /// [together](Self::together).
    pub fn sample(
        scene: &Scene,
        shapes: &[Shape],
        rays: &[Ray],
        truths: &[Option<Truth>],
        answers: &[Option<Hit>],
    ) -> Sample {
        let mut sample = Sample { rays: rays.len(), ..Sample::default() };
        let mut wrong = Vec::new();
        for ((ray, truth), hit) in rays.iter().zip(truths).zip(answers) {
            match (truth, hit) {
                (Some(truth), Some(hit)) => {
                    sample.t.push(ulps(hit.t, truth.t));
                    sample.normal.push(degrees(normal(scene, ray, *hit), truth.normal));
                }
                (Some(truth), None) => wrong.push((*ray, truth.t)),
                (None, Some(hit)) => wrong.push((*ray, hit.t.into())),
                (None, None) => (),
            }
        }
        sample.wrong = wrong.len();
        sample.unexcused = match shapes {
            [shape] => Some(unexcused(shape, &wrong)),
            _ => None,
        };
        sample
    }

    /// Of all samples as if they were one.
    pub fn together(samples: Vec<Sample>) -> Self {
        let sum = |part: fn(&Sample) -> usize| samples.iter().map(part).sum();
        let (rays, wrong, unexcused) = (sum(|s| s.rays), sum(|s| s.wrong), samples.iter().map(|s| s.unexcused).sum());
        let (t, normal): (Vec<_>, Vec<_>) = samples.into_iter().map(|s| (s.t, s.normal)).unzip();
        let (t, normal) = (t.concat(), normal.concat());
        Self { rays, hits: t.len(), wrong, unexcused, t: Quantiles::of(t), normal: Quantiles::of(normal) }
    }
}

/// The errors of single rays.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Sample {
    rays: usize,
    wrong: usize,
    unexcused: Option<usize>,
    t: Vec<f64>,
    normal: Vec<f64>,
}

/// How many that is of a million.
pub fn per_million(count: usize, of: usize) -> f64 {
    count as f64 * 1e6 / of.max(1) as f64
}

/// How many of the wrong decisions, with the t of the hit that there is or should be, rounding does not excuse.
fn unexcused(shape: &Shape, wrong: &[(Ray, f64)]) -> usize {
    let stride = wrong.len().div_ceil(LOOKED_AT).max(1);
    let looked_at: Vec<_> = wrong.iter().step_by(stride).collect();
    let settled = looked_at.par_iter().filter(|(ray, t)| truth::settled(shape, ray, *t)).count();
    (settled * wrong.len()).div_ceil(looked_at.len().max(1))
}

fn normal(scene: &Scene, ray: &Ray, hit: Hit) -> DVec3 {
    let [normal, _] = facing_normals(scene, hit.primitive, ray.origin, ray.direction, hit.t);
    glam::Vec3::from(normal).as_dvec3()
}

/// The angle between two lines; that between the vectors, up to their sign, which is the ray's matter.
fn degrees(a: DVec3, b: DVec3) -> f64 {
    a.cross(b).length().atan2(a.dot(b).abs()).to_degrees()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::methods::{Choice, SphereMethod};
    use crate::measure::cases;
    use crate::measure::lab::batches;
    use crate::measure::oracle::shapes;
    use crate::scene::{CompileOptions, compile_with};

    #[test]
    fn ulps_of_known_values() {
        assert_eq!((ulps(1.0, 1.0), ulps(1.0 + f32::EPSILON, 1.0), ulps(4.0, 5.0)), (0.0, 1.0, (1 << 21) as f64));
        // Below a power of two the steps are half as wide, and the truth says which count.
        assert_eq!((ulps(1.0, 1.0 - 2f64.powi(-24)), ulps(1.0, 1.0 + 2f64.powi(-24))), (1.0, 0.5));
        assert_eq!((ulps(0.0, 0.0), ulps(f32::from_bits(3), 0.0), ulps(0.0, 2f64.powi(-149))), (0.0, 3.0, 1.0));
        assert_eq!(ulps(-2.0, -2.0 - 2f64.powi(-22)), 1.0);
        assert_eq!(ulps(f32::INFINITY, 1.0), f64::INFINITY);
        // What is rounded to nearest is off by half a step at the most.
        let mut rng = crate::measure::random::Pcg::new(3);
        for _ in 0..2000 {
            let truth = rng.between(-1.0, 1.0) * 10f64.powf(rng.between(-40.0, 38.0));
            assert!(ulps(truth as f32, truth) <= 0.5, "{truth}");
        }
    }

    #[test]
    fn percentiles_by_nearest_rank() {
        let sorted: Vec<f64> = (1..=2000).map(f64::from).collect();
        assert_eq!(
            Quantiles::of(sorted.iter().rev().copied().collect()),
            Quantiles { median: 1000.0, p999: 1998.0, worst: 2000.0 }
        );
        assert_eq!([0.0, 0.25, 1.0].map(|share| percentile(&[1.0, 2.0, 3.0, 4.0], share)), [1.0, 1.0, 4.0]);
        assert_eq!((percentile(&[], 0.5), percentile(&[7.0], 0.001)), (0.0, 7.0));
    }

    /// Answers that are put wrong are counted as what they are.
    #[test]
    fn of_answers_that_are_wrong_on_purpose() {
        let case = cases::find("sphere-far").unwrap().make(10.0, 400, 1);
        // Not by the plan, which may take a method that errs where it is not seen.
        let stable = Choice::Sphere(SphereMethod::Stable);
        let scene =
            compile_with(&case.description, &CompileOptions { methods: vec![stable], ..CompileOptions::default() })
                .unwrap();
        let shapes = shapes(&case.description);
        let truths = truth::of(&case.description, &case.rays);
        let right: Vec<_> =
            truths.iter().map(|truth| truth.map(|truth| Hit { t: truth.t as f32, primitive: 0 })).collect();
        let judge = |answers: &[Option<Hit>]| Errors::of(&scene, &shapes, &case.rays, &truths, answers);
        let errors = judge(&right);
        assert_eq!((errors.rays, errors.hits, errors.wrong), (400, truths.iter().flatten().count(), 0));
        assert!(errors.t.worst <= 0.5 && errors.t.median > 0.0 && errors.normal.worst < 0.1, "{errors:?}");
        assert!((200..400).contains(&errors.hits), "{errors:?}");

        let nothing = judge(&vec![None; 400]);
        assert_eq!((nothing.hits, nothing.wrong), (0, errors.hits));
        // Few rays are that near the silhouette.
        assert!(nothing.unexcused.unwrap() > errors.hits * 9 / 10, "{nothing:?}");
        assert_eq!(nothing.wrong_per_million(), errors.hits as f64 * 2500.0);

        let late = |hit: &Option<Hit>| hit.map(|hit| Hit { t: f32::from_bits(hit.t.to_bits() + 8), ..hit });
        let errors = judge(&right.iter().map(late).collect::<Vec<_>>());
        assert!((7.5..8.5).contains(&errors.t.median) && errors.wrong == 0, "{errors:?}");

        let traced = judge(&batches::trace(&scene, &case.rays));
        assert!(traced.t.median < 4.0 && traced.hits > 200 && traced.unexcused.unwrap() <= traced.wrong, "{traced:?}");
    }
}
