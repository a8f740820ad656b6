//! The instruction set that this build was compiled for, and the one that the CPU has.

/// Features of a CPU that the kernels gain from.
#[derive(Clone, Copy)]
struct Features {
    avx512f: bool,
    avx2: bool,
    fma: bool,
    avx: bool,
    sse41: bool,
    sse2: bool,
    neon: bool,
}

impl Features {
    /// Those that this build uses.
    const COMPILED: Self = Self {
        avx512f: cfg!(target_feature = "avx512f"),
        avx2: cfg!(target_feature = "avx2"),
        fma: cfg!(target_feature = "fma"),
        avx: cfg!(target_feature = "avx"),
        sse41: cfg!(target_feature = "sse4.1"),
        sse2: cfg!(target_feature = "sse2"),
        neon: cfg!(target_feature = "neon"),
    };

    /// Those that the CPU has.
    #[cfg(target_arch = "x86_64")]
    fn of_cpu() -> Self {
        use std::arch::is_x86_feature_detected as has;
        Self {
            avx512f: has!("avx512f"),
            avx2: has!("avx2"),
            fma: has!("fma"),
            avx: has!("avx"),
            sse41: has!("sse4.1"),
            sse2: has!("sse2"),
            neon: false,
        }
    }

    /// Those that the CPU has, as far as is known.
    #[cfg(not(target_arch = "x86_64"))]
    fn of_cpu() -> Self {
        Self::COMPILED
    }

    /// How much the kernels gain from them: the higher, the faster.
    const fn level(self) -> usize {
        match self {
            Self { avx512f: true, fma: true, .. } => 6,
            Self { avx2: true, fma: true, .. } => 5,
            Self { avx: true, .. } => 4,
            Self { sse41: true, .. } => 3,
            Self { sse2: true, .. } => 2,
            Self { neon: true, .. } => 1,
            _ => 0,
        }
    }
}

/// The names of [`Features::level`].
const NAMES: [&str; 7] = ["scalar", "neon", "sse2", "sse4.1", "avx", "avx2+fma", "avx512+fma"];

/// The instruction set that the kernels of this build use, for reports: `avx512+fma`, `avx2+fma`, `avx`, `sse4.1`, `sse2` …
///
/// With AVX-512 the tree's packets are 16 lanes wide ([`super::Lanes::Wider`]), all else is at most 8.
pub const fn isa() -> &'static str {
    NAMES[Features::COMPILED.level()]
}

/// The instruction set that a build for this CPU would use.
pub fn cpu_isa() -> &'static str {
    NAMES[Features::of_cpu().level()]
}

/// When the CPU has a better instruction set than this build uses: one line that says so, and what it is worth.
///
/// The factor is that of a build for plain x86-64 against one for a CPU with AVX-512 on the scene `classic`: primary rays
/// 2.3, shadow rays 2.2, frames 2.3.
pub fn slower_than_cpu() -> Option<String> {
    advice(Features::COMPILED.level(), Features::of_cpu().level())
}

fn advice(compiled: usize, cpu: usize) -> Option<String> {
    let gain = match () {
        _ if compiled >= cpu => return None,
        _ if cpu >= 5 && compiled < 5 => "up to 2.3 times as fast",
        _ => "faster",
    };
    let [compiled, cpu] = [NAMES[compiled], NAMES[cpu]];
    Some(format!(
        "this program was built for {compiled}, and the CPU has {cpu}: built with RUSTFLAGS=\"-C target-cpu=native\" it is {gain}"
    ))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn advice_is_given_where_it_helps() {
        assert_eq!(advice(5, 5), None);
        assert_eq!(advice(6, 5), None);
        let text = advice(2, 6).unwrap();
        assert!(
            text.contains("built for sse2") && text.contains("avx512+fma") && text.ends_with("up to 2.3 times as fast")
        );
        assert!(advice(5, 6).unwrap().ends_with("faster"));
    }

    /// A build that runs here uses no more than the CPU has.
    #[test]
    fn the_cpu_has_what_is_compiled() {
        assert!(Features::of_cpu().level() >= Features::COMPILED.level());
    }
}
