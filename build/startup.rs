//! Runs before anything else in the program and ends it when the CPU lacks what it was compiled for.
//!
//! A check in `main` comes too late: with link-time optimisation even the part of `std` that calls `main` is compiled for
//! `target-cpu=native`, and dies of an illegal instruction before. So `build.rs` compiles this file by itself, for
//! plain x86-64, and links the object into the program, where it is the first constructor to run. It is the one
//! place with `unsafe` in it. It shares no code with the rest, not even `core`'s, which is compiled with the rest.

#![no_std]

mod cpu;

/// What the rest is compiled for, as rustc names it, separated by commas.
const COMPILED: &[u8] = env!("RAYPACKET_TARGET_FEATURES").as_bytes();

// The lowest number runs first; `std` has 00099.
#[used]
#[unsafe(link_section = ".init_array.00001")]
static START: extern "C" fn() = check;

extern "C" fn check() {
    let mut missing = cpu::missing(COMPILED, cpu::has);
    let Some(first) = missing.next() else { return };
    say(b"raypacket: compiled for a CPU with ");
    say(first);
    for name in missing {
        say(b", ");
        say(name);
    }
    say(b", which this one lacks; build it on this machine, ");
    say(b"or for all with RUSTFLAGS=\"-C target-cpu=x86-64\"\n");
    // SAFETY: takes any number and does not return.
    unsafe { _exit(1) }
}

/// Writes to standard error; if that fails there is nobody to tell.
fn say(text: &[u8]) {
    // SAFETY: the pointer and the length are those of one slice.
    unsafe { write(2, text.as_ptr(), text.len()) };
}

unsafe extern "C" {
    fn write(file: i32, bytes: *const u8, count: usize) -> isize;
    fn _exit(status: i32) -> !;
}
