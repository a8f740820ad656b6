//! Puts a check of the CPU in front of the program: see `build/startup.rs`.

use std::env;
use std::path::PathBuf;
use std::process::Command;

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    println!("cargo::rerun-if-changed=build");
    let var = |name: &str| env::var(name).unwrap_or_default();
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
