//! What this build was compiled for.

/// The instruction set that the kernels of this build use, for reports: `avx2+fma`, `avx`, `sse4.1`, `sse2` …
///
/// Vectors are at most 256 bits wide, whatever else the processor has.
pub const fn isa() -> &'static str {
    if cfg!(all(target_feature = "avx2", target_feature = "fma")) {
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
