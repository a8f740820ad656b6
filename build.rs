//! Hands the instruction sets that the program is compiled for to `src/cli/cpu.rs`, which compares them with
//! the CPU that it runs on.

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    // Cargo reruns this whenever the rustflags change, as they are part of the build's fingerprint.
    let features = std::env::var("CARGO_CFG_TARGET_FEATURE").unwrap_or_default();
    println!("cargo::rustc-env=RAYPACKET_TARGET_FEATURES={features}");
}
