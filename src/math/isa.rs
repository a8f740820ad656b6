//! Which instruction set the tracing code was compiled for.

/// The instruction set that packets run on in this build, for reports: `avx2+fma`, `avx2`, `avx`, `sse4.1`,
/// `sse2`, `neon`, or `scalar`.
///
/// It is what the compiler was allowed to use, not what the CPU could do, and no wider than the packets are:
/// eight `f32` fill 256 bits, so a build for AVX-512 says `avx2+fma` too. `+fma` says that
/// multiply-add is fused, which is what two builds may differ by.
pub const fn isa() -> &'static str {
    let fma = cfg!(target_feature = "fma");
    if cfg!(target_feature = "avx2") {
        if fma { "avx2+fma" } else { "avx2" }
    } else if cfg!(target_feature = "avx") {
        if fma { "avx+fma" } else { "avx" }
    } else if cfg!(target_feature = "sse4.1") {
        "sse4.1"
    } else if cfg!(target_feature = "sse2") {
        "sse2"
    } else if cfg!(target_feature = "neon") {
        "neon"
    } else {
        "scalar"
    }
}

#[cfg(test)]
mod tests {
    #[test]
    fn names_fma_exactly_when_multiply_add_is_fused() {
        assert_eq!(super::isa().ends_with("+fma"), cfg!(all(target_arch = "x86_64", target_feature = "fma")));
        assert!(!super::isa().contains("512"));
    }
}
