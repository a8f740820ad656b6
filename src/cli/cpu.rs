//! Whether this CPU has what the program was compiled for.
//!
//! `.cargo/config.toml` compiles for the CPU at hand, so a copy of the binary may land on one that lacks some
//! of it, and would die there of an illegal instruction. `is_x86_feature_detected!` cannot help: for
//! what is enabled at compile time it says yes without looking. So this asks CPUID itself.

/// What the program was compiled for, as rustc names it, separated by commas; `build.rs` knows.
const COMPILED: &str = env!("RAYPACKET_TARGET_FEATURES");

/// One line about what this CPU lacks, if anything.
// Not inlined, so that no code compiled for more than this CPU has runs before it.
#[inline(never)]
pub fn complaint() -> Option<String> {
    let missing = missing(COMPILED, has);
    (!missing.is_empty()).then(|| {
        format!(
            "this program was compiled for a CPU with {}, which this one lacks; build it on this machine, \
             or for any with RUSTFLAGS=\"-C target-cpu=x86-64\"",
            missing.join(", ")
        )
    })
}

/// The compiled features that the CPU does not have, in the order given.
fn missing(compiled: &str, has: impl Fn(&str) -> bool) -> Vec<&str> {
    compiled.split(',').filter(|feature| !feature.is_empty() && !has(feature)).collect()
}

#[cfg(not(target_arch = "x86_64"))]
fn has(_feature: &str) -> bool {
    true
}

#[cfg(target_arch = "x86_64")]
use x86_64::has;

#[cfg(target_arch = "x86_64")]
mod x86_64 {
    use std::arch::x86_64::{__cpuid, __cpuid_count};

    /// Which registers the operating system has to save for a feature to be of use.
    #[derive(Clone, Copy, PartialEq)]
    enum State {
        /// Those it always saves.
        Base,
        /// The 256-bit registers.
        Avx,
        /// The 512-bit registers.
        Avx512,
    }

    /// Where CPUID says whether a feature is there.
    #[derive(Clone, Copy)]
    struct Place {
        leaf: u32,
        subleaf: u32,
        /// 0 to 3: eax, ebx, ecx, edx.
        register: usize,
        bit: u32,
        state: State,
    }

    /// Whether the CPU and the operating system offer a feature, by rustc's name; true for unknown ones.
    pub fn has(feature: &str) -> bool {
        place(feature).is_none_or(|place| {
            let there = register(place.leaf, place.subleaf, place.register) >> place.bit & 1 == 1;
            there && saved(place.state)
        })
    }

    /// Every feature that the compiler may use on its own, or that crates take on trust because
    /// `is_x86_feature_detected!` does. Others, such as rdseed or xsaves, are used by nothing here.
    fn place(feature: &str) -> Option<Place> {
        use State::{Avx, Avx512, Base};
        let (leaf, subleaf, register, bit, state) = match feature {
            "sse3" => (1, 0, 2, 0, Base),
            "pclmulqdq" => (1, 0, 2, 1, Base),
            "ssse3" => (1, 0, 2, 9, Base),
            "fma" => (1, 0, 2, 12, Avx),
            "sse4.1" => (1, 0, 2, 19, Base),
            "sse4.2" => (1, 0, 2, 20, Base),
            "movbe" => (1, 0, 2, 22, Base),
            "popcnt" => (1, 0, 2, 23, Base),
            "aes" => (1, 0, 2, 25, Base),
            "avx" => (1, 0, 2, 28, Avx),
            "f16c" => (1, 0, 2, 29, Avx),
            "bmi1" => (7, 0, 1, 3, Base),
            "avx2" => (7, 0, 1, 5, Avx),
            "bmi2" => (7, 0, 1, 8, Base),
            "avx512f" => (7, 0, 1, 16, Avx512),
            "avx512dq" => (7, 0, 1, 17, Avx512),
            "avx512ifma" => (7, 0, 1, 21, Avx512),
            "avx512cd" => (7, 0, 1, 28, Avx512),
            "sha" => (7, 0, 1, 29, Base),
            "avx512bw" => (7, 0, 1, 30, Avx512),
            "avx512vl" => (7, 0, 1, 31, Avx512),
            "avx512vbmi" => (7, 0, 2, 1, Avx512),
            "avx512vbmi2" => (7, 0, 2, 6, Avx512),
            "gfni" => (7, 0, 2, 8, Base),
            "vaes" => (7, 0, 2, 9, Avx),
            "vpclmulqdq" => (7, 0, 2, 10, Avx),
            "avx512vnni" => (7, 0, 2, 11, Avx512),
            "avx512bitalg" => (7, 0, 2, 12, Avx512),
            "avx512vpopcntdq" => (7, 0, 2, 14, Avx512),
            "avx512fp16" => (7, 0, 3, 23, Avx512),
            "avxvnni" => (7, 1, 0, 4, Avx),
            "avx512bf16" => (7, 1, 0, 5, Avx512),
            "lzcnt" => (0x8000_0001, 0, 2, 5, Base),
            "sse4a" => (0x8000_0001, 0, 2, 6, Base),
            _ => return None,
        };
        Some(Place { leaf, subleaf, register, bit, state })
    }

    /// A register of a leaf; 0 when the CPU does not know the leaf, as CPUID would answer with another one's.
    fn register(leaf: u32, subleaf: u32, register: usize) -> u32 {
        if __cpuid(leaf & 0x8000_0000).eax < leaf {
            return 0;
        }
        let r = __cpuid_count(leaf, subleaf);
        match register {
            0 => r.eax,
            1 => r.ebx,
            2 => r.ecx,
            _ => r.edx,
        }
    }

    /// Whether the operating system saves these registers when it switches threads.
    ///
    /// XGETBV would say so, but needs `unsafe`. CPUID leaf 13 tells the same: ebx of subleaf 0 is the size
    /// of the area that the *enabled* registers are saved to, and subleaf i says where the part of the i-th kind
    /// ends (2: upper halves of ymm, 7: zmm16 to zmm31).
    fn saved(state: State) -> bool {
        let kind = match state {
            State::Base => return true,
            State::Avx => 2,
            State::Avx512 => 7,
        };
        let os_uses_xsave = register(1, 0, 2) >> 27 & 1 == 1;
        let end = register(13, kind, 0) + register(13, kind, 1);
        os_uses_xsave && end > 0 && register(13, 0, 1) >= end
    }

    #[cfg(test)]
    mod tests {
        use super::*;

        /// Linux lists what both the CPU and itself offer, so the two must agree on every name.
        #[cfg(target_os = "linux")]
        #[test]
        fn agrees_with_the_kernel() {
            let Ok(text) = std::fs::read_to_string("/proc/cpuinfo") else { return };
            let flags = text.lines().find(|l| l.starts_with("flags")).expect("x86 CPUs have flags");
            let listed = |name: &str| flags.split_whitespace().any(|f| f == name);
            let names = [
                ("sse3", "pni"),
                ("ssse3", "ssse3"),
                ("sse4.1", "sse4_1"),
                ("sse4.2", "sse4_2"),
                ("fma", "fma"),
                ("movbe", "movbe"),
                ("popcnt", "popcnt"),
                ("aes", "aes"),
                ("pclmulqdq", "pclmulqdq"),
                ("avx", "avx"),
                ("f16c", "f16c"),
                ("bmi1", "bmi1"),
                ("bmi2", "bmi2"),
                ("avx2", "avx2"),
                ("avx512f", "avx512f"),
                ("avx512dq", "avx512dq"),
                ("avx512ifma", "avx512ifma"),
                ("avx512cd", "avx512cd"),
                ("sha", "sha_ni"),
                ("avx512bw", "avx512bw"),
                ("avx512vl", "avx512vl"),
                ("avx512vbmi", "avx512vbmi"),
                ("avx512vbmi2", "avx512_vbmi2"),
                ("gfni", "gfni"),
                ("vaes", "vaes"),
                ("vpclmulqdq", "vpclmulqdq"),
                ("avx512vnni", "avx512_vnni"),
                ("avx512bitalg", "avx512_bitalg"),
                ("avx512vpopcntdq", "avx512_vpopcntdq"),
                ("avx512fp16", "avx512_fp16"),
                ("avxvnni", "avx_vnni"),
                ("avx512bf16", "avx512_bf16"),
                ("lzcnt", "abm"),
                ("sse4a", "sse4a"),
            ];
            for (rustc, linux) in names {
                assert!(place(rustc).is_some(), "{rustc}");
                assert_eq!(has(rustc), listed(linux), "{rustc}");
            }
            assert!(has("no such feature"));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lists_what_is_missing_in_order() {
        let old = |feature: &str| !matches!(feature, "avx2" | "fma");
        assert_eq!(missing("sse2,fma,popcnt,avx2", old), ["fma", "avx2"]);
        assert_eq!(missing("sse2,popcnt", old), [""; 0]);
        assert_eq!(missing("", |_| false), [""; 0]);
    }

    #[test]
    fn the_machine_that_runs_the_tests_can_run_the_program() {
        assert_eq!(complaint(), None);
    }
}
