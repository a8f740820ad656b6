//! Damaged scene files: whatever their bytes, reading, compiling and tracing them ends, without a panic, in little
//! memory, with a scene or with one line that says what is wrong.
//!
//! Input n of a format depends on nothing but n. It is in the folder of the format, below `CARGO_TARGET_TMPDIR`, while it
//! is read, and stays there when it fails. Two variables of the environment change what is run:
//!
//! | | |
//! |---|---|
//! | `RAYPACKET_FUZZ_INPUTS=250000` | how many inputs of each format |
//! | `RAYPACKET_FUZZ_FIRST=1234` | from which on, as to repeat one |

#[path = "../common/mod.rs"]
mod common;
mod corpus;
mod lines;
mod mutate;
#[cfg(unix)]
mod special;
mod subject;
mod watch;

use std::{
    env, fs,
    path::{Path, PathBuf},
    time::Instant,
};

use common::Pcg;
use corpus::{Format, files};
use mutate::Mutator;
use watch::Watch;

/// Inputs of each format, when nothing else is asked for.
const INPUTS: u64 = 4_000;

fn variable(name: &str) -> Option<u64> {
    Some(env::var(name).ok()?.parse().unwrap_or_else(|_| panic!("{name} must be a number")))
}

/// An empty folder for a test, with what its files may refer to.
fn folder(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("fuzz").join(name);
    let _ = fs::remove_dir_all(&folder);
    for inner in ["textures", "meshes"] {
        fs::create_dir_all(folder.join(inner)).unwrap();
    }
    for (file, content) in files() {
        fs::write(folder.join(file), content).unwrap();
    }
    folder
}

/// Input n of a format.
fn input(mutator: &Mutator, n: u64) -> Vec<u8> {
    mutator.input(&mut Pcg::new(n))
}

fn fuzz(format: &Format) {
    let watch = Watch::new(format.name);
    let folder = folder(format.name);
    let mutator = Mutator::new(format);
    for seed in mutator.seeds() {
        fs::write(folder.join(format.mutated), seed).unwrap();
        let seen = subject::run(&folder.join(format.scene), || ());
        assert!(seen.is_ok(), "{seen:?}: {}", String::from_utf8_lossy(seed));
    }
    let first = variable("RAYPACKET_FUZZ_FIRST").unwrap_or(0);
    let inputs = variable("RAYPACKET_FUZZ_INPUTS").unwrap_or(INPUTS);
    let (mut sound, mut hits) = (0, 0);
    let started = Instant::now();
    for n in first..first + inputs {
        let bytes = input(&mutator, n);
        let file = folder.join(format.mutated);
        // A new file each time: what is put in an old one's place is brought to the disk at once by some systems.
        fs::remove_file(&file).unwrap();
        fs::write(&file, &bytes).unwrap();
        let ran = watch.over(n, &file, &bytes, format.memory, |read| subject::run(&folder.join(format.scene), read));
        if let Ok(found) = ran {
            sound += 1;
            hits += found;
        }
    }
    let [reading, all] = watch.most();
    println!(
        "{}: {inputs} inputs in {:.1} s, {sound} of them sound, {hits} hits; at most {reading:.1} bytes a byte to read, \
         {all:.1} in all, beyond {} and {} KiB; the slowest, {}, took {:.2} s",
        format.name,
        started.elapsed().as_secs_f64(),
        watch::CONSTANT[0] >> 10,
        watch::CONSTANT[1] >> 10,
        watch.slowest().1,
        watch.slowest().0,
    );
    if inputs >= 1000 {
        let share = sound as f64 / inputs as f64;
        assert!((0.05..0.95).contains(&share), "{}: {sound} of {inputs} are sound", format.name);
        assert!(hits > sound, "{}: {hits} hits", format.name);
    }
}

#[test]
fn toml() {
    fuzz(&corpus::TOML);
}

#[test]
fn nff() {
    fuzz(&corpus::NFF);
}

#[test]
fn obj() {
    fuzz(&corpus::OBJ);
}

#[test]
fn mtl() {
    fuzz(&corpus::MTL);
}

#[test]
fn radiance() {
    fuzz(&corpus::RADIANCE);
}

/// What a failure prints can be made again.
#[test]
fn an_input_depends_on_its_number_alone() {
    // What it takes would count for another test's input.
    let _alone = watch::alone();
    for format in corpus::FORMATS {
        let [a, b] = [Mutator::new(format), Mutator::new(format)];
        let later: Vec<_> = (0..40).map(|n| input(&a, n)).collect();
        assert!((0..40).rev().all(|n| input(&b, n) == later[n as usize]), "{}", format.name);
        assert!(later.iter().any(|i| *i != later[0]));
    }
}
