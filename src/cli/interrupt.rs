//! What ends the program from outside: Ctrl-C, or another program.

use super::failure::Failure;

/// From now on SIGHUP, SIGINT and SIGTERM remove what is half written and end the program with status 128 and their number.
/// One that the caller has the program ignore, as `nohup` does, stays ignored.
#[cfg(unix)]
pub fn watch() -> Result<(), Failure> {
    use signal_hook::consts::{SIGABRT, SIGHUP, SIGINT, SIGTERM};
    use signal_hook::flag::register_conditional_shutdown;
    use signal_hook::iterator::Signals;
    use std::sync::{Arc, atomic::AtomicBool};

    let ignored = ignored();
    let signals = [SIGHUP, SIGINT, SIGTERM].into_iter().filter(|signal| ignored >> (signal - 1) & 1 == 0);
    // When memory is refused where nobody could ask before, the library of the language has said so, and would abort.
    let always = Arc::new(AtomicBool::new(true));
    let failed = |e: std::io::Error| Failure::runtime(format!("cannot watch for signals: {e}"));
    register_conditional_shutdown(SIGABRT, 1, always).map_err(failed)?;
    let mut signals = Signals::new(signals).map_err(failed)?;
    let end = move || {
        if let Some(signal) = signals.forever().next() {
            raypacket::files::abandon();
            std::process::exit(128 + signal);
        }
    };
    std::thread::Builder::new().name("signals".into()).stack_size(64 << 10).spawn(end).map(drop).map_err(failed)
}

/// Elsewhere the system ends the program as it likes.
#[cfg(not(unix))]
pub fn watch() -> Result<(), Failure> {
    Ok(())
}

/// The signals that were ignored when the program started, a bit each from the lowest on; none where the system does not say.
#[cfg(unix)]
fn ignored() -> u64 {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let mask = status.lines().find_map(|line| line.strip_prefix("SigIgn:"));
    mask.and_then(|mask| u64::from_str_radix(mask.trim(), 16).ok()).unwrap_or(0)
}
