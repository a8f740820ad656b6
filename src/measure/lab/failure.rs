//! How methods fail as a case's dial is turned.

use super::errors::Errors;
use super::method::{Method, methods};
use super::{Budget, batches, truth};
use crate::measure::cases::{self, Generator, Ray, Subject};
use crate::measure::oracle::shapes;
use crate::scene::{CompileOptions, Invalid, Structure, compile_with};

/// Poses of the primitive at every setting, so that no curve hangs on one.
const POSES: usize = 4;

/// One method along a dial.
#[derive(Clone, Debug, PartialEq)]
pub struct Curve {
    /// The method.
    pub method: Method,
    /// Setting and errors there, in the dial's order.
    pub points: Vec<(f64, Errors)>,
}

/// All methods along one case's dial.
#[derive(Clone, Debug)]
pub struct CaseFailure {
    /// The case.
    pub case: &'static Generator,
    /// By method, the default first.
    pub curves: Vec<Curve>,
}

/// Turns the dials of all cases of single primitives whose subject is `wanted`, in the caller's rayon pool. At every
/// setting all methods get the same rays, from four poses of the primitive.
///
/// # Errors
/// [`Invalid`] when a case does not compile; they do.
pub fn failures(
    wanted: impl Fn(Subject) -> bool,
    budget: &Budget,
    progress: &dyn Fn(f32),
) -> Result<Vec<CaseFailure>, Invalid> {
    let alone = |subject| !matches!(subject, Subject::All | Subject::Refraction | Subject::Shadow);
    let cases: Vec<&Generator> = cases::ALL.iter().filter(|g| alone(g.subject) && wanted(g.subject)).collect();
    let measure = |(i, case): (usize, &&'static Generator)| {
        let share = |part: f32| progress((i as f32 + part) / cases.len() as f32);
        turn(case, budget, &share)
    };
    cases.iter().enumerate().map(measure).collect()
}

fn turn(case: &'static Generator, budget: &Budget, progress: &dyn Fn(f32)) -> Result<CaseFailure, Invalid> {
    let mut curves: Vec<Curve> =
        methods(case.subject).into_iter().map(|method| Curve { method, points: Vec::new() }).collect();
    for (k, dial) in case.dial.settings(budget.settings).enumerate() {
        for (curve, errors) in curves.iter_mut().zip(at(case, dial, budget.rays)?) {
            curve.points.push((dial, errors));
        }
        progress((k + 1) as f32 / budget.settings as f32);
    }
    Ok(CaseFailure { case, curves })
}

/// The errors of all methods at one setting, over all poses.
fn at(case: &Generator, dial: f64, rays: usize) -> Result<Vec<Errors>, Invalid> {
    let mut samples = vec![Vec::new(); methods(case.subject).len()];
    for pose in 0..POSES {
        let made = case.make(dial, rays.div_ceil(POSES), 1 + pose as u64);
        let rays: Vec<Ray> = made.rays;
        let truths = truth::of(&made.description, &rays);
        let shapes = shapes(&made.description);
        for (method, samples) in methods(case.subject).iter().zip(&mut samples) {
            let scene = compile_with(
                &made.description,
                &CompileOptions { structure: Some(Structure::None), methods: method.choices().to_vec() },
            )?;
            samples.push(Errors::sample(&scene, &shapes, &rays, &truths, &batches::trace(&scene, &rays)));
        }
    }
    Ok(samples.into_iter().map(Errors::together).collect())
}
