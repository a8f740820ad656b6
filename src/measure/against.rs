//! `bench --against`: the rates of a run beside those of an earlier one, row by row.
//!
//! A run is known as well as its rows lie close together: a row's rate may be off by half of its spread either way. That is
//! 2.5 % at the least where the program ran fewer than three times, as memory lies elsewhere every time. The ratio of two
//! rates may be off by both. A difference is beyond noise when 1 lies outside of what is left.

use std::collections::{HashMap, HashSet};
use std::fmt;

use super::bench::Report;
use super::plain::plain;
use super::turns::noise;

/// The least that the spread of a side counts where it has fewer than [`SEVERAL`] runs of the program.
const ONCE: f64 = 0.05;

/// So many runs of the program tell by themselves how far they lie apart.
const SEVERAL: usize = 3;

/// Rates of work that differs by more than this share are not of the same work.
const SAME_WORK: f64 = 0.01;

/// One query at one kernel.
#[derive(Clone, Debug, PartialEq)]
pub struct Row {
    /// As [`super::bench::Measured`] has it.
    pub query: String,
    /// As [`super::bench::Measured`] has it.
    pub kernel: String,
    /// Active rays.
    pub rays: u64,
    /// 10⁶ rays a second, median of the runs.
    pub mrays: f64,
    /// How far the runs lie apart, as a share of the median.
    pub spread: f64,
}

/// A run of one scene.
#[derive(Clone, Debug, PartialEq)]
pub struct Run {
    /// The scene's name.
    pub scene: String,
    /// What has to be alike for rates to be compared: names and values.
    pub setting: Vec<(&'static str, String)>,
    /// The commit and the date.
    pub built: [String; 2],
    /// By query, then by kernel.
    pub rows: Vec<Row>,
}

impl From<&Report> for Run {
    fn from(report: &Report) -> Self {
        let [width, height] = report.size;
        let setting = [
            ("CPU", plain(&report.stamp.cpu)),
            ("instruction set", report.isa.to_owned()),
            ("threads", report.threads.to_string()),
            ("size", format!("{width}x{height}")),
            ("methods", report.methods.clone()),
        ];
        let rows = report.results.iter().map(|row| Row {
            query: plain(&row.query),
            kernel: row.kernel.to_owned(),
            rays: row.rays,
            mrays: row.mrays_median,
            spread: row.spread,
        });
        Self {
            scene: plain(&report.scene),
            setting: setting.into(),
            built: [report.stamp.commit.to_owned(), report.stamp.date.clone()],
            rows: rows.collect(),
        }
    }
}

/// What is to be said of a difference.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// Faster than before, beyond noise.
    Faster,
    /// Slower than before, beyond noise.
    Slower,
    /// As far as one can tell, as fast as before.
    WithinNoise,
}

impl Verdict {
    /// In words.
    pub fn name(self) -> &'static str {
        match self {
            Self::Faster => "faster",
            Self::Slower => "slower",
            Self::WithinNoise => "within noise",
        }
    }
}

/// A row that both runs have.
#[derive(Clone, Debug, PartialEq)]
pub struct Pair {
    /// Scene, query and kernel.
    pub key: [String; 3],
    /// 10⁶ rays a second before and now.
    pub mrays: [f64; 2],
    /// The spreads before and now.
    pub spread: [f64; 2],
    /// New by old.
    pub ratio: f64,
    /// Where the ratio lies, as far as the spreads tell.
    pub range: [f64; 2],
    /// Whether 1 is outside of that.
    pub verdict: Verdict,
}

/// Two runs side by side.
#[derive(Clone, Debug, PartialEq)]
pub struct Comparison {
    /// Commit and date of the earlier run.
    pub built: [String; 2],
    /// What is not alike, a line each.
    pub warnings: Vec<String>,
    /// What both have, in the order of the later run.
    pub pairs: Vec<Pair>,
    /// What the earlier run alone has: scene, query and kernel.
    pub gone: Vec<[String; 3]>,
    /// What the later run alone has.
    pub added: Vec<[String; 3]>,
}

impl Comparison {
    /// Compares two runs of several scenes. A scene that a run has several times counts as several runs of it.
    pub fn new(old: &[Run], new: &[Run]) -> Self {
        let [before, now] = [sides(old), sides(new)];
        let [known_before, known_now] = [places(&before), places(&now)];
        let missing = |these: &[Side], others: &Places<'_>| {
            let alone = these.iter().filter(|side| !others.contains_key(&side.key));
            alone.map(|side| side.key.clone()).collect()
        };
        let mut warnings = differences(old, new);
        let mut pairs = Vec::new();
        for side in &now {
            let Some(earlier) = known_before.get(&side.key).map(|&place| &before[place]) else { continue };
            if (side.rays - earlier.rays).abs() > SAME_WORK * earlier.rays {
                let (what, [a, b]) = (side.key.join(" "), [earlier, side].map(|side| side.rays));
                warnings.push(format!("other rays: {what} had {a}, and has {b} now"));
            }
            pairs.push(pair(earlier, side));
        }
        let built = old.first().map_or_else(Default::default, |run| run.built.clone());
        Self { built, warnings, pairs, gone: missing(&before, &known_now), added: missing(&now, &known_before) }
    }
}

/// A row of all runs of one program.
struct Side {
    key: [String; 3],
    rays: f64,
    mrays: f64,
    spread: f64,
}

/// Where the row of each key is.
type Places<'a> = HashMap<&'a [String; 3], usize>;

fn places(sides: &[Side]) -> Places<'_> {
    sides.iter().enumerate().map(|(place, side)| (&side.key, place)).collect()
}

/// Puts the rows with the same scene, query and kernel together: their median, and the largest of their spreads and of the
/// spread of their medians. Rows without a rate are left out.
fn sides(runs: &[Run]) -> Vec<Side> {
    let mut keys: Vec<([String; 3], Vec<&Row>)> = Vec::new();
    let mut known: HashMap<[String; 3], usize> = HashMap::new();
    for run in runs {
        for row in run.rows.iter().filter(|row| row.mrays > 0.0) {
            let key = [&run.scene, &row.query, &row.kernel].map(String::clone);
            let place = *known.entry(key).or_insert_with_key(|key| {
                keys.push((key.clone(), Vec::new()));
                keys.len() - 1
            });
            keys[place].1.push(row);
        }
    }
    let side = |(key, rows): ([String; 3], Vec<&Row>)| {
        let mut rates: Vec<f64> = rows.iter().map(|row| row.mrays).collect();
        rates.sort_by(f64::total_cmp);
        let mrays = rates[rates.len() / 2];
        let apart = (rates[rates.len() - 1] - rates[0]) / mrays;
        let least = if rows.len() < SEVERAL { ONCE } else { 0.0 };
        let spread = rows.iter().map(|row| row.spread).fold(apart.max(least), f64::max);
        Side { key, rays: rows[0].rays as f64, mrays, spread }
    };
    keys.into_iter().map(side).collect()
}

fn pair(old: &Side, new: &Side) -> Pair {
    let ratio = new.mrays / old.mrays;
    let off = 1.0 + 0.5 * (old.spread + new.spread);
    let range = [ratio / off, ratio * off];
    let verdict = match range {
        [low, _] if low > 1.0 => Verdict::Faster,
        [_, high] if high < 1.0 => Verdict::Slower,
        _ => Verdict::WithinNoise,
    };
    Pair {
        key: new.key.clone(),
        mrays: [old.mrays, new.mrays],
        spread: [old.spread, new.spread],
        ratio,
        range,
        verdict,
    }
}

/// What is not alike in runs of the same scene, said once each.
fn differences(old: &[Run], new: &[Run]) -> Vec<String> {
    let (mut found, mut known) = (Vec::new(), HashSet::new());
    for run in new {
        for earlier in old.iter().filter(|earlier| earlier.scene == run.scene) {
            for ((name, was), (_, is)) in earlier.setting.iter().zip(&run.setting) {
                let line = || format!("other {name}: {was} before, {is} now");
                if was != is && known.insert(line()) {
                    found.push(line());
                }
            }
        }
    }
    found
}

impl fmt::Display for Comparison {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let [commit, date] = &self.built;
        write!(f, "against commit {commit} of {date}")?;
        self.warnings.iter().try_for_each(|warning| write!(f, "\nwarning: {warning}"))?;
        let wide = self.pairs.iter().map(|pair| pair.key[0].chars().count()).max().unwrap_or(0).max(5);
        write!(
            f,
            "\n{:wide$}  {:12} {:6} {:>10} {:>10} {:>8}  {:15}",
            "scene", "query", "kernel", "before", "now", "ratio", "range"
        )?;
        for Pair { key: [scene, query, kernel], mrays: [old, new], spread, ratio, range, verdict } in &self.pairs {
            let range = range.map(|end| format!("{end:.3}")).join(" to ");
            let (verdict, noise) = (verdict.name(), noise(spread[0].max(spread[1])));
            write!(
                f,
                "\n{scene:wide$}  {query:12} {kernel:6} {old:>10.2} {new:>10.2} {ratio:>8.3}  {range:15}  {verdict}{noise}"
            )?;
        }
        self.gone.iter().try_for_each(|key| write!(f, "\nonly before: {}", key.join(" ")))?;
        self.added.iter().try_for_each(|key| write!(f, "\nonly now: {}", key.join(" ")))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn run(scene: &str, rows: &[(&str, f64, f64)]) -> Run {
        let row = |&(query, mrays, spread): &(&str, f64, f64)| Row {
            query: query.into(),
            kernel: "x8".into(),
            rays: 100,
            mrays,
            spread,
        };
        Run {
            scene: scene.into(),
            setting: vec![("CPU", "A".into()), ("threads", "1".into())],
            built: ["c", "d"].map(str::to_owned),
            rows: rows.iter().map(row).collect(),
        }
    }

    fn verdicts(comparison: &Comparison) -> Vec<Verdict> {
        comparison.pairs.iter().map(|pair| pair.verdict).collect()
    }

    #[test]
    fn noise_decides() {
        use Verdict::{Faster, Slower, WithinNoise};
        let old = [run("s", &[("a", 100.0, 0.01), ("b", 100.0, 0.2), ("c", 100.0, 0.01), ("d", 100.0, 0.01)])];
        let new = [run("s", &[("a", 106.0, 0.01), ("b", 106.0, 0.01), ("c", 94.0, 0.01), ("d", 104.0, 0.01)])];
        let comparison = Comparison::new(&old, &new);
        // Once each: at least 2.5 % of either, so 5 % together.
        assert_eq!(verdicts(&comparison), [Faster, WithinNoise, Slower, WithinNoise]);
        let [low, high] = comparison.pairs[0].range;
        assert!((low - 1.06 / 1.05).abs() < 1e-12 && (high - 1.06 * 1.05).abs() < 1e-12);
        assert!(comparison.to_string().contains("within noise  noisy: spread 20 %"), "{comparison}");
        assert!(comparison.warnings.is_empty() && comparison.gone.is_empty() && comparison.added.is_empty());
    }

    #[test]
    fn several_runs_tell_more_than_one() {
        let runs = |rates: [f64; 3]| rates.map(|rate| run("s", &[("a", rate, 0.004)]));
        let [old, new] = [runs([100.0, 100.5, 99.9]), runs([102.0, 101.8, 102.2])];
        assert_eq!(verdicts(&Comparison::new(&old, &new)), [Verdict::Faster]);
        assert_eq!(verdicts(&Comparison::new(&old[..1], &new[..1])), [Verdict::WithinNoise]);
        // One binary, three times: the medians differ as much as nothing else tells.
        let wild = runs([415.0, 686.0, 500.0]);
        assert_eq!(verdicts(&Comparison::new(&wild, &runs([600.0, 600.0, 600.0]))), [Verdict::WithinNoise]);
    }

    #[test]
    fn what_is_not_alike_is_said() {
        let mut old = [run("s", &[("a", 1.0, 0.0), ("b", 1.0, 0.0)]), run("t", &[("a", 1.0, 0.0)])];
        old[0].setting[0].1 = "B".into();
        let mut new = [run("s", &[("a", 1.0, 0.0), ("c", 1.0, 0.0), ("none", 0.0, 0.0)])];
        new[0].rows[0].rays = 102;
        let comparison = Comparison::new(&old, &new);
        assert_eq!(comparison.warnings, ["other CPU: B before, A now", "other rays: s a x8 had 100, and has 102 now"]);
        assert_eq!(comparison.gone, [["s", "b", "x8"], ["t", "a", "x8"]].map(|key| key.map(str::to_owned)));
        assert_eq!(comparison.added, [["s", "c", "x8"].map(str::to_owned)]);
        let text = comparison.to_string();
        for line in ["against commit c of d", "only before: t a x8", "only now: s c x8", "warning: other CPU"] {
            assert!(text.lines().any(|l| l.starts_with(line)), "no {line:?} in {text}");
        }
    }
}
