//! What happens on a CPU that lacks what the program was compiled for.
#![cfg(all(target_arch = "x86_64", target_os = "linux"))]

#[path = "../build/cpu.rs"]
mod cpu;

use std::process::Command;

fn missing(compiled: &str, has: impl Fn(&[u8]) -> bool) -> Vec<String> {
    cpu::missing(compiled.as_bytes(), has).map(|name| String::from_utf8_lossy(name).into_owned()).collect()
}

#[test]
fn lists_what_is_missing_in_order() {
    let old = |feature: &[u8]| !matches!(feature, b"avx2" | b"fma");
    assert_eq!(missing("sse2,fma,popcnt,avx2", old), ["fma", "avx2"]);
    assert_eq!(missing("sse2,popcnt", old), [""; 0]);
    assert_eq!(missing("", |_| false), [""; 0]);
    assert_eq!(missing("no such feature", cpu::has), [""; 0], "unknown ones are ignored");
}

/// Linux lists what both the CPU and itself offer, so the two must agree on every name.
#[test]
fn agrees_with_the_kernel() {
    let Ok(text) = std::fs::read_to_string("/proc/cpuinfo") else { return };
    let flags = text.lines().find(|line| line.starts_with("flags")).expect("x86 CPUs have flags");
    let same = "ssse3 fma movbe popcnt aes pclmulqdq avx f16c bmi1 bmi2 avx2 avx512f avx512dq avx512ifma avx512cd \
                avx512bw avx512vl avx512vbmi gfni vaes vpclmulqdq sse4a";
    let other = "sse3=pni sse4.1=sse4_1 sse4.2=sse4_2 sha=sha_ni lzcnt=abm avxvnni=avx_vnni avx512vbmi2=avx512_vbmi2 \
                 avx512vnni=avx512_vnni avx512bitalg=avx512_bitalg avx512vpopcntdq=avx512_vpopcntdq \
                 avx512fp16=avx512_fp16 avx512bf16=avx512_bf16";
    for name in same.split_whitespace().chain(other.split_whitespace()) {
        let (rustc, linux) = name.split_once('=').unwrap_or((name, name));
        assert_eq!(cpu::has(rustc.as_bytes()), flags.split_whitespace().any(|flag| flag == linux), "{name}");
    }
}

/// On older CPUs, as qemu's user mode emulates them; only where that is installed.
#[test]
fn an_older_cpu_is_told_so() {
    let compiled = [("avx2", cfg!(target_feature = "avx2")), ("popcnt", cfg!(target_feature = "popcnt"))];
    for (cpu, lacks) in [("qemu64", &["avx2", "popcnt"][..]), ("Nehalem", &["avx2"]), ("SandyBridge", &["avx2"])] {
        let run = Command::new("qemu-x86_64").args(["-cpu", cpu, env!("CARGO_BIN_EXE_raypacket"), "scenes"]).output();
        let Ok(run) = run else {
            eprintln!("skipped: no qemu-x86_64 here (Debian: apt-get install qemu-user)");
            return;
        };
        let stderr = String::from_utf8_lossy(&run.stderr);
        // qemu itself warns about features that it does not emulate.
        let lines: Vec<&str> = stderr.lines().filter(|line| !line.starts_with("qemu-x86_64: warning")).collect();
        let expected: Vec<&str> = compiled.iter().filter(|c| c.1 && lacks.contains(&c.0)).map(|c| c.0).collect();
        if expected.is_empty() {
            assert_eq!((run.status.code(), lines.len()), (Some(0), 0), "{cpu}: {stderr}");
        } else {
            assert_eq!((run.status.code(), lines.len()), (Some(1), 1), "{cpu}: {stderr}");
            assert!(lines[0].starts_with("raypacket: compiled for a CPU with "), "{cpu}: {stderr}");
            assert!(expected.iter().all(|name| lines[0].contains(name)), "{cpu}: {stderr}");
            assert!(run.stdout.is_empty());
        }
    }
}
