//! Timed runs in turn, and what they say: the median, the best and the spread.

use std::ops::RangeInclusive;
use std::time::{Duration, Instant};

use super::lab::percentile;

/// Timed runs of each contestant: as many as fit the budget, within these bounds.
const RUNS: RangeInclusive<usize> = 3..=31;

/// A spread above this makes a figure noisy.
pub const NOISY: f64 = 0.1;

/// Lets contestants 0 to `count` − 1 run in turn until the budget is spent, so that a drift of the machine hits all alike;
/// the times of each, in seconds. The first turn warms up and is not timed.
pub fn take_turns(count: usize, budget: Duration, mut run: impl FnMut(usize)) -> Vec<Vec<f64>> {
    let mut times = vec![Vec::new(); count];
    (0..count).for_each(&mut run);
    let start = Instant::now();
    let mut turns = 0;
    while turns < *RUNS.end() && (turns < *RUNS.start() || start.elapsed() < budget) {
        for (contestant, times) in times.iter_mut().enumerate() {
            let start = Instant::now();
            run(contestant);
            times.push(start.elapsed().as_secs_f64());
        }
        turns += 1;
    }
    times
}

/// What the runs of one contestant took.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Times {
    /// The median run, in seconds, above 0.
    pub median: f64,
    /// The best run, in seconds, above 0.
    pub best: f64,
    /// How far the runs lie apart, as a share of the median: from the time that one in ten does not exceed to that which
    /// nine in ten do not. Of fewer than ten runs it is from the best to the worst.
    pub spread: f64,
    /// How many there were.
    pub runs: usize,
}

impl Times {
    /// Of times in any order, at least one.
    pub fn of(mut times: Vec<f64>) -> Self {
        times.iter_mut().for_each(|time| *time = time.max(1e-9));
        times.sort_by(f64::total_cmp);
        let [best, low, high] = [0.0, 0.1, 0.9].map(|share| percentile(&times, share));
        let median = times.get(times.len() / 2).copied().unwrap_or(best);
        let spread = if median > 0.0 { (high - low) / median } else { 0.0 };
        Self { median, best, spread, runs: times.len() }
    }
}

/// What is to be said beside a figure with this spread; nothing when it is not noisy.
pub fn noise(spread: f64) -> String {
    if spread > NOISY { format!("  noisy: spread {:.0} %", 100.0 * spread) } else { String::new() }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn times_by_hand() {
        let times = Times::of(vec![3.0, 2.0, 2.5]);
        assert_eq!(times, Times { median: 2.5, best: 2.0, spread: 0.4, runs: 3 });
        // One slow run in ten is no spread.
        let times = Times::of((0..20).map(|i| if i < 2 { 50.0 } else { 1.0 }).collect());
        assert_eq!(times, Times { median: 1.0, best: 1.0, spread: 0.0, runs: 20 });
        assert_eq!((noise(0.1), noise(0.136)), (String::new(), "  noisy: spread 14 %".into()));
    }

    #[test]
    fn all_take_turns() {
        let mut order = Vec::new();
        let times = take_turns(2, Duration::ZERO, |i| order.push(i));
        assert_eq!(order, [0, 1, 0, 1, 0, 1, 0, 1]);
        assert_eq!(times.iter().map(Vec::len).collect::<Vec<_>>(), [3, 3]);
    }
}
