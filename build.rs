//! Tells the program its commit, and puts a check of the CPU in front of it: see `build/startup.rs`.

use std::env;
use std::path::{Path, PathBuf};
use std::process::Command;

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    println!("cargo::rerun-if-changed=build");
    let var = |name: &str| env::var(name).unwrap_or_default();
    println!("cargo::rustc-env=RAYPACKET_COMMIT={}", commit().unwrap_or("unknown".into()));
    // The way to run code before `main`, and the table of features, are those of Linux on x86-64.
    if var("CARGO_CFG_TARGET_OS") != "linux" || var("CARGO_CFG_TARGET_ARCH") != "x86_64" {
        return;
    }
    let object = PathBuf::from(var("OUT_DIR")).join("startup.o");
    let compiled = Command::new(var("RUSTC"))
        .args(["build/startup.rs", "--crate-name=startup", "--crate-type=lib", "--emit=obj", "--edition=2024"])
        .arg(format!("--target={}", var("TARGET")))
        // None of the rustflags reach this; what matters is the plain CPU, and that no panic needs `core`.
        .args(["-Ctarget-cpu=x86-64", "-Copt-level=2", "-Ccodegen-units=1", "-Cpanic=abort", "-Coverflow-checks=off"])
        .args(["-Cdebug-assertions=off", "-o"])
        .arg(&object)
        .env("RAYPACKET_TARGET_FEATURES", var("CARGO_CFG_TARGET_FEATURE"))
        .status();
    match compiled {
        Ok(status) if status.success() => println!("cargo::rustc-link-arg-bins={}", object.display()),
        // The program is fine without, on the CPU it is compiled for.
        _ => println!("cargo::warning=build/startup.rs did not compile: the program will not check its CPU"),
    }
}

/// The commit that is built, with a `+` when files differ from it; nothing without git, or where the sources are only
/// part of someone else's repository. Nothing in a development build either, all of which every commit would make old.
fn commit() -> Option<String> {
    if env::var("PROFILE").ok()? != "release" {
        return None;
    }
    let git = |args: &[&str]| {
        let output = Command::new("git").args(args).output().ok()?;
        let text = String::from_utf8(output.stdout).ok()?;
        output.status.success().then(|| text.trim().to_owned())
    };
    if !git(&["rev-parse", "--show-prefix"])?.is_empty() {
        return None;
    }
    println!("cargo::rerun-if-changed=src");
    if let Some(log) = git(&["rev-parse", "--git-path", "logs/HEAD"]).filter(|log| Path::new(log).exists()) {
        println!("cargo::rerun-if-changed={log}");
    }
    let changed = if git(&["status", "--porcelain", "--untracked-files=no"])?.is_empty() { "" } else { "+" };
    Some(git(&["rev-parse", "--short=10", "HEAD"])? + changed)
}
