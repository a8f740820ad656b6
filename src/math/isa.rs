//! The instruction set that this build was compiled for.

/// The instruction set that the kernels of this build use, for reports: `avx512+fma`, `avx2+fma`, `avx`, `sse4.1`, `sse2` …
///
/// With AVX-512 the tree's packets are 16 lanes wide ([`super::Lanes::Wider`]), all else is at most 8.
pub const fn isa() -> &'static str {
    if cfg!(all(target_feature = "avx512f", target_feature = "fma")) {
        "avx512+fma"
    } else if cfg!(all(target_feature = "avx2", target_feature = "fma")) {
        "avx2+fma"
    } else if cfg!(target_feature = "avx") {
        "avx"
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
