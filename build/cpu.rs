//! What a CPU offers, by rustc's names for it.
//!
//! `is_x86_feature_detected!` is of no use for this: for what is enabled at compile time it says yes without looking.
//! Uses `core` only, and of that only what is compiled into the user, as `startup.rs` cannot link to `core`.

use core::arch::asm;
use core::arch::x86_64::{__cpuid, __cpuid_count};

/// Which registers the operating system has to save for a feature to be of use.
#[derive(Clone, Copy, PartialEq)]
enum State {
    /// Those it always saves.
    Base,
    /// The 256-bit registers.
    Avx,
    /// The 512-bit registers and the masks.
    Avx512,
}

/// The features of a list separated by commas that are not there, in the order given.
pub fn missing(compiled: &[u8], has: impl Fn(&[u8]) -> bool) -> impl Iterator<Item = &[u8]> {
    compiled.split(|&byte| byte == b',').filter(move |feature| !feature.is_empty() && !has(feature))
}

/// Whether this CPU and its operating system offer a feature; true for those that are not in the table.
pub fn has(feature: &[u8]) -> bool {
    let Some((leaf, subleaf, register, bit, state)) = place(feature) else { return true };
    self::register(leaf, subleaf, register) >> bit & 1 == 1 && saved(state)
}

/// Where CPUID tells: leaf, subleaf, register (0 to 3: eax, ebx, ecx, edx) and bit.
///
/// The table holds what the compiler may use on its own and what crates take on trust because
/// `is_x86_feature_detected!` does. Others, such as rdseed or xsaves, are used by nothing here.
fn place(feature: &[u8]) -> Option<(u32, u32, u32, u32, State)> {
    use State::{Avx, Avx512, Base};
    Some(match feature {
        b"sse3" => (1, 0, 2, 0, Base),
        b"pclmulqdq" => (1, 0, 2, 1, Base),
        b"ssse3" => (1, 0, 2, 9, Base),
        b"fma" => (1, 0, 2, 12, Avx),
        b"sse4.1" => (1, 0, 2, 19, Base),
        b"sse4.2" => (1, 0, 2, 20, Base),
        b"movbe" => (1, 0, 2, 22, Base),
        b"popcnt" => (1, 0, 2, 23, Base),
        b"aes" => (1, 0, 2, 25, Base),
        b"avx" => (1, 0, 2, 28, Avx),
        b"f16c" => (1, 0, 2, 29, Avx),
        b"bmi1" => (7, 0, 1, 3, Base),
        b"avx2" => (7, 0, 1, 5, Avx),
        b"bmi2" => (7, 0, 1, 8, Base),
        b"avx512f" => (7, 0, 1, 16, Avx512),
        b"avx512dq" => (7, 0, 1, 17, Avx512),
        b"avx512ifma" => (7, 0, 1, 21, Avx512),
        b"avx512cd" => (7, 0, 1, 28, Avx512),
        b"sha" => (7, 0, 1, 29, Base),
        b"avx512bw" => (7, 0, 1, 30, Avx512),
        b"avx512vl" => (7, 0, 1, 31, Avx512),
        b"avx512vbmi" => (7, 0, 2, 1, Avx512),
        b"avx512vbmi2" => (7, 0, 2, 6, Avx512),
        b"gfni" => (7, 0, 2, 8, Base),
        b"vaes" => (7, 0, 2, 9, Avx),
        b"vpclmulqdq" => (7, 0, 2, 10, Avx),
        b"avx512vnni" => (7, 0, 2, 11, Avx512),
        b"avx512bitalg" => (7, 0, 2, 12, Avx512),
        b"avx512vpopcntdq" => (7, 0, 2, 14, Avx512),
        b"avx512fp16" => (7, 0, 3, 23, Avx512),
        b"avxvnni" => (7, 1, 0, 4, Avx),
        b"avx512bf16" => (7, 1, 0, 5, Avx512),
        b"lzcnt" => (0x8000_0001, 0, 2, 5, Base),
        b"sse4a" => (0x8000_0001, 0, 2, 6, Base),
        _ => return None,
    })
}

/// A register of a leaf; 0 when the CPU does not know the leaf, as CPUID would answer with another one's.
fn register(leaf: u32, subleaf: u32, register: u32) -> u32 {
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
fn saved(state: State) -> bool {
    // Bits of the register XCR0: 1 xmm, 2 ymm, 5 to 7 masks and zmm.
    let wanted = match state {
        State::Base => return true,
        State::Avx => 0b0000_0110,
        State::Avx512 => 0b1110_0110,
    };
    let has_xgetbv = register(1, 0, 2) >> 27 & 1 == 1;
    has_xgetbv && xcr0() & wanted == wanted
}

/// The lower half of XCR0. Only where CPUID says that the operating system uses XSAVE.
fn xcr0() -> u32 {
    let low: u32;
    // SAFETY: reads a register; `saved` made sure that the instruction exists. Not `_xgetbv`, which is compiled
    // for CPUs that have it and could be called for by nobody else.
    unsafe { asm!("xgetbv", in("ecx") 0, out("eax") low, out("edx") _, options(nomem, nostack, preserves_flags)) };
    low
}
