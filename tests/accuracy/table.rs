//! The hard cases, by subject.

use rayon::prelude::*;
use raypacket::measure::cases::{ALL, Generator, Subject};
use raypacket::measure::oracle::{Shape, shapes};

use crate::common::part_of;
use crate::judge::{Judge, Verdict};
use crate::{compiled, trace};

/// Settings of every dial.
const SETTINGS: usize = 9;

/// The condition under which t is within 8 ulps: the thing is not smaller than a ten thousandth of how far away it is, and
/// (D + |o|) / (t cos θ) is at most 4 (for triangles and quads also over
/// the sine of the smallest angle): the ray does not graze, nor start much nearer than the thing is large or the
/// world's origin is far.
const DISTANCE: f64 = 1e4;
const CONDITION: f64 = 4.0;

/// What is measured of a subject.
#[derive(Clone, Debug, Default)]
struct Row {
    rays: usize,
    hits: usize,
    differ: usize,
    wrong: usize,
    needs: f64,
    ulps: Vec<f64>,
    share: f64,
    degrees: f64,
    /// By kind of primitive, under the condition.
    worst: [f64; 10],
}

const SUBJECTS: [&str; 13] = [
    "plane", "sphere", "triangle", "quad", "box", "cylinder", "cone", "torus", "fractal", "disc", "scene", "glass",
    "shadow",
];

fn kind(shape: &Shape) -> usize {
    match shape {
        Shape::Plane(_) => 0,
        Shape::Sphere(_) => 1,
        Shape::Triangle(_) => 2,
        Shape::Quad(_) => 3,
        Shape::Cuboid(_) => 4,
        Shape::Cylinder(_) => 5,
        Shape::Cone(_) => 6,
        Shape::Torus(_) => 7,
        Shape::Fractal(_) => 8,
        Shape::Disc(_) => 9,
    }
}

impl Row {
    fn count(&mut self, verdict: &Verdict, hit_kind: Option<usize>) {
        self.rays += 1;
        self.differ += usize::from(verdict.differs);
        self.wrong += usize::from(verdict.wrong);
        self.needs = self.needs.max(verdict.needs);
        let (Some(hit), Some(kind)) = (verdict.hit, hit_kind) else { return };
        self.hits += 1;
        if hit.condition <= CONDITION && hit.distance <= DISTANCE {
            self.ulps.push(hit.ulps);
            self.share = self.share.max(hit.share);
            self.degrees = self.degrees.max(hit.degrees);
            self.worst[kind] = self.worst[kind].max(hit.ulps);
        }
    }

    fn merge(mut self, other: Self) -> Self {
        self.rays += other.rays;
        self.hits += other.hits;
        self.differ += other.differ;
        self.wrong += other.wrong;
        self.needs = self.needs.max(other.needs);
        self.ulps.extend(other.ulps);
        self.share = self.share.max(other.share);
        self.degrees = self.degrees.max(other.degrees);
        self.worst = std::array::from_fn(|i| self.worst[i].max(other.worst[i]));
        self
    }

    fn print(&mut self, name: &str) {
        self.ulps.sort_by(f64::total_cmp);
        let at = |part: f64| {
            let last = self.ulps.len().saturating_sub(1) as f64;
            self.ulps.get((last * part).round() as usize).copied().unwrap_or(f64::NAN)
        };
        let Self { rays, hits, differ, wrong, needs, share, degrees, .. } = self;
        let errors = match self.ulps.len() {
            0 => "0 | – | – | –".to_owned(),
            n => format!("{n} | {:.2} / {:.2} / {:.2} | {share:.2} | {degrees:.1e}", at(0.5), at(0.999), at(1.0)),
        };
        let needs = if *needs > 0.0 { format!("{needs}") } else { "–".to_owned() };
        println!("| {name} | {rays} | {hits} | {differ} | {wrong} | {needs} | {errors} |");
    }
}

/// A generator's rays.
fn judged(generator: &Generator, rays: usize, look_closer: bool) -> Row {
    let mut row = Row::default();
    // The oracle takes long for these.
    let rays = if matches!(generator.subject, Subject::Torus | Subject::All) { rays.div_ceil(3) } else { rays };
    for (dial, seed) in generator.dial.settings(SETTINGS).zip(100..) {
        let case = generator.make(dial, rays, seed);
        let scene = compiled(&case.description);
        let shapes = shapes(&case.description);
        let mut shown = 0;
        for (ray, found) in case.rays.iter().zip(trace(&scene, &case.rays)) {
            let verdict = Judge::new(&scene, &shapes, ray, found).verdict(look_closer);
            // The first few tell enough.
            if verdict.wrong && shown < 2 {
                shown += 1;
                println!(
                    "{} at {dial:e}: {ray:?}: {found:?}, needs {}, {:?}",
                    generator.name, verdict.needs, verdict.hit
                );
                if shapes.len() == 1 {
                    println!("  of {:?}", shapes[0]);
                }
            }
            row.count(&verdict, found.map(|(_, id)| kind(&shapes[id])));
        }
    }
    row
}

fn check(rays: usize, look_closer: bool) {
    let rows: Vec<_> =
        ALL.par_iter().map(|generator| (generator.subject as usize, judged(generator, rays, look_closer))).collect();
    println!(
        "| subject | rays | hits | differ | wrong | needs | plain hits | ulps: median / 99.9 % / worst | of bound | normal, ° |"
    );
    println!("|---|---|---|---|---|---|---|---|---|---|");
    let mut all = Row::default();
    for (subject, name) in SUBJECTS.into_iter().enumerate() {
        let of = rows.iter().filter(|(s, _)| *s == subject).map(|(_, row)| row.clone());
        let mut row = of.fold(Row::default(), Row::merge);
        row.print(name);
        all = all.merge(row);
    }
    println!("worst ulps of plain hits by kind: {:.2?}", all.worst);
    assert_eq!(all.wrong, 0, "answers that are right for no ray nearby");
    assert!(all.share <= 1.0, "t is off by {} documented bounds", all.share);
    for kind in [0, 1, 2, 4, 5] {
        assert!(all.worst[kind] <= 8.0, "{}: {} ulps", SUBJECTS[kind], all.worst[kind]);
    }
}

#[test]
fn hard_cases() {
    check(60, false);
}

/// The table of `docs/accuracy.md`.
#[test]
#[ignore = "takes minutes; for a release build"]
fn hard_cases_in_full() {
    check(part_of(1000), true);
}
