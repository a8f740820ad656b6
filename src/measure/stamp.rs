//! On what, from what and when a measurement was made.

use std::time::{SystemTime, UNIX_EPOCH};

use serde::Serialize;

use super::lab::Machine;

/// What stands beside every figure that is kept.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Stamp {
    /// The processor's model, as it calls itself.
    pub cpu: String,
    /// The version of this crate.
    pub version: &'static str,
    /// The commit this was built from, `unknown` without git and in development builds.
    pub commit: &'static str,
    /// Date and time in UTC, as ISO 8601 writes them.
    pub date: String,
}

impl Stamp {
    /// Of this machine, this build and this second.
    pub fn now() -> Self {
        let Machine { cpu, commit, .. } = Machine::this();
        let seconds = SystemTime::now().duration_since(UNIX_EPOCH).map_or(0, |since| since.as_secs());
        Self { cpu, version: env!("CARGO_PKG_VERSION"), commit, date: utc(seconds) }
    }
}

/// Seconds since 1970 as a date and time.
///
/// The years here begin in March, so that the day which some of them have more is their last; 400 of them, an era, have
/// 146,097 days (Hinnant, *chrono-Compatible Low-Level Date Algorithms*, 2013).
fn utc(seconds: u64) -> String {
    let (days, second) = (seconds / 86_400 + 719_468, seconds % 86_400);
    let (era, day) = (days / 146_097, days % 146_097);
    let year = (day - day / 1460 + day / 36_524 - day / 146_096) / 365;
    let day = day - (365 * year + year / 4 - year / 100);
    let month = (5 * day + 2) / 153;
    let day = day - (153 * month + 2) / 5 + 1;
    let (month, next) = if month < 10 { (month + 3, 0) } else { (month - 9, 1) };
    let year = 400 * era + year + next;
    let [hour, minute, second] = [second / 3600, second / 60 % 60, second % 60];
    format!("{year:04}-{month:02}-{day:02}T{hour:02}:{minute:02}:{second:02}Z")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn dates_that_are_known() {
        for (seconds, date) in [
            (0, "1970-01-01T00:00:00Z"),
            (951_782_399, "2000-02-28T23:59:59Z"),
            (951_782_400, "2000-02-29T00:00:00Z"),
            (951_868_800, "2000-03-01T00:00:00Z"),
            (1_709_164_800, "2024-02-29T00:00:00Z"),
            (1_735_689_599, "2024-12-31T23:59:59Z"),
            (4_107_542_400, "2100-03-01T00:00:00Z"),
        ] {
            assert_eq!(utc(seconds), date);
        }
    }
}
