//! Builds raypacket once for every level of x86-64 that the launcher offers.

use std::env;
use std::path::{Path, PathBuf};
use std::process::Command;

/// As in `src/main.rs`.
const LEVELS: [&str; 3] = ["x86-64-v2", "x86-64-v3", "x86-64-v4"];

fn main() {
    for file in ["build.rs", "../Cargo.toml", "../Cargo.lock", "../build.rs", "../build", "../src", "../scenes"] {
        println!("cargo::rerun-if-changed={file}");
    }
    let features = env::var("CARGO_CFG_TARGET_FEATURE").unwrap_or_default();
    if features.split(',').any(|feature| feature == "sse3") {
        println!("cargo::error=the launcher has to run on every CPU: build it with RUSTFLAGS='-C target-cpu=x86-64'");
        return;
    }
    let out = PathBuf::from(env::var_os("OUT_DIR").unwrap_or_default());
    for level in LEVELS {
        if let Err(problem) = build(level, &out) {
            println!("cargo::error=raypacket for {level}: {problem}");
            return;
        }
    }
}

/// Leaves the program as `OUT_DIR/<level>/raypacket`.
fn build(level: &str, out: &Path) -> Result<(), String> {
    let target = out.join("target").join(level);
    let status = Command::new(env::var_os("CARGO").unwrap_or("cargo".into()))
        .args([
            "build",
            "--release",
            "--package",
            "raypacket",
            "--bin",
            "raypacket",
            "--manifest-path",
            "../Cargo.toml",
        ])
        .arg("--target-dir")
        .arg(&target)
        .env_remove("CARGO_ENCODED_RUSTFLAGS")
        .env("RUSTFLAGS", format!("-C target-cpu={level}"))
        .env("CARGO_PROFILE_RELEASE_STRIP", "symbols")
        .status()
        .map_err(|error| error.to_string())?;
    if !status.success() {
        return Err("cargo build failed; its messages are above".into());
    }
    let place = out.join(level);
    std::fs::copy(target.join("release/raypacket"), &place).map_err(|error| format!("{}: {error}", place.display()))?;
    Ok(())
}
