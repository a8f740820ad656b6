//! The machine that a measurement ran on.

use std::fmt;

use crate::math::isa;

/// The machine and the build, for captions.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Machine {
    /// The processor's model, as it calls itself; the architecture where it does not say.
    pub cpu: String,
    /// The instruction set this build uses.
    pub isa: &'static str,
    /// Threads of the pool that rendered frames; all else is timed on one.
    pub threads: usize,
    /// The commit this was built from, `unknown` without git and in development builds.
    pub commit: &'static str,
    /// Whether the compiler optimised as in a release.
    pub optimised: bool,
}

impl Machine {
    /// This one, with the threads of the caller's pool.
    pub fn this() -> Self {
        // Linux alone has it; elsewhere, or where it cannot be read, the architecture has to do.
        let info = std::fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
        Self {
            cpu: model(&info).unwrap_or_else(|| format!("unknown CPU ({})", std::env::consts::ARCH)),
            isa: isa(),
            threads: rayon::current_num_threads(),
            commit: option_env!("RAYPACKET_COMMIT").unwrap_or("unknown"),
            optimised: !cfg!(debug_assertions),
        }
    }
}

/// The model's name in the text of `/proc/cpuinfo`.
fn model(info: &str) -> Option<String> {
    let (_, name) = info.lines().filter_map(|l| l.split_once(':')).find(|(key, _)| key.trim() == "model name")?;
    // One line of words, whatever the file has.
    let name: Vec<_> = name.split_whitespace().collect();
    (!name.is_empty()).then(|| name.join(" "))
}

impl fmt::Display for Machine {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let Self { cpu, isa, threads, commit, optimised } = self;
        let plural = if *threads == 1 { "thread" } else { "threads" };
        write!(f, "{cpu} · {isa} · {threads} {plural} · commit {commit}")?;
        if *optimised { Ok(()) } else { write!(f, " · development build, not for its speed") }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_model_is_found_or_not() {
        let info = "processor\t: 0\nmodel\t\t: 7\nmodel name\t: A  CPU: @ 2 GHz\nmodel name\t: B\n";
        assert_eq!(model(info).as_deref(), Some("A CPU: @ 2 GHz"));
        assert_eq!((model(""), model("model name :  \n"), model("model name")), (None, None, None));
    }

    #[test]
    fn this_machine_has_a_name_and_threads() {
        let machine = Machine::this();
        assert!(!machine.cpu.is_empty() && machine.threads > 0 && !machine.commit.is_empty());
        assert!(machine.to_string().contains(machine.isa));
    }
}
