//! Runs the raypacket inside that was built for this CPU.
//!
//! Each is a whole program for one level of x86-64, so that every function of it, and not only a few kernels, uses what
//! the CPU has. The one that fits best goes into a file in memory and takes this process over: arguments, files, signals
//! and the exit code are its own.

#[cfg(not(all(target_os = "linux", target_arch = "x86_64")))]
compile_error!("the launcher is for Linux on x86-64; elsewhere, build raypacket itself");

use std::arch::is_x86_feature_detected as has;
use std::env;
use std::fs::File;
use std::io::{self, Write};
use std::os::fd::AsRawFd;
use std::os::unix::process::CommandExt;
use std::process::{Command, ExitCode};

use rustix::fs::{MemfdFlags, memfd_create};

/// Names a level to run instead of the best.
const CHOICE: &str = "RAYPACKET_LEVEL";

/// A level of x86-64, whether this CPU has it, and raypacket for it.
struct Level {
    name: &'static str,
    here: bool,
    program: &'static [u8],
}

/// The highest first.
fn levels() -> [Level; 3] {
    let v2 = has!("sse3") && has!("ssse3") && has!("sse4.1") && has!("sse4.2") && has!("popcnt") && has!("cmpxchg16b");
    let v3 = v2
        && (has!("avx") && has!("avx2") && has!("fma") && has!("f16c"))
        && (has!("bmi1") && has!("bmi2") && has!("lzcnt") && has!("movbe"));
    let v4 = v3 && has!("avx512f") && has!("avx512bw") && has!("avx512cd") && has!("avx512dq") && has!("avx512vl");
    macro_rules! program {
        ($level:literal) => {
            include_bytes!(concat!(env!("OUT_DIR"), "/", $level))
        };
    }
    [
        Level { name: "x86-64-v4", here: v4, program: program!("x86-64-v4") },
        Level { name: "x86-64-v3", here: v3, program: program!("x86-64-v3") },
        Level { name: "x86-64-v2", here: v2, program: program!("x86-64-v2") },
    ]
}

/// The level that was asked for, or the best that this CPU has.
fn choose(wanted: Option<&str>) -> Result<Level, String> {
    let mut levels = levels().into_iter();
    let Some(wanted) = wanted else {
        return levels
            .find(|level| level.here)
            .ok_or("this CPU is older than x86-64-v2, for which nothing is inside".into());
    };
    let names = levels_named();
    let level =
        levels.find(|level| level.name == wanted).ok_or(format!("{CHOICE}: no `{wanted}`; there are {names}"))?;
    if level.here { Ok(level) } else { Err(format!("{CHOICE}: this CPU is not {wanted}")) }
}

fn levels_named() -> String {
    levels().map(|level| level.name).join(", ")
}

/// Turns this process into `program`; comes back only when it cannot.
fn become_program(program: &[u8]) -> io::Error {
    let mut arguments = env::args_os();
    let name = arguments.next().unwrap_or("raypacket".into());
    let written = memfd_create(c"raypacket", MemfdFlags::CLOEXEC).map_err(io::Error::from).and_then(|memory| {
        let mut memory = File::from(memory);
        memory.write_all(program).map(|()| memory)
    });
    match written {
        Ok(memory) => Command::new(format!("/proc/self/fd/{}", memory.as_raw_fd())).arg0(name).args(arguments).exec(),
        Err(error) => error,
    }
}

fn main() -> ExitCode {
    let wanted = env::var(CHOICE).ok();
    let problem = match choose(wanted.as_deref()) {
        Ok(level) => format!("raypacket for {} cannot be run: {}", level.name, become_program(level.program)),
        Err(problem) => problem,
    };
    eprintln!("error: {problem}");
    ExitCode::FAILURE
}
