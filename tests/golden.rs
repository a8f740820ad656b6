//! The built-in scenes' pictures, as they were when somebody last looked at them.
//!
//! - `tests/golden/NAME.png`, 96 × 48: at most 0.5 % of the pixels may differ by more than 2/255. A build with FMA and
//!   one without, or a change that only rounds differently, stay within that; a change that is seen does not.
//! - `tests/golden/hashes.txt`: FNV-1a of the film's very bits, a line a scene and kind of build (`fma`, `plain`).
//!   Any change to any bit shows.
//!
//! When a change is meant, look at the pictures, then bless them on both builds, the native one last as its pictures
//! are those that stay:
//!
//! ```text
//! RUSTFLAGS='-C target-cpu=x86-64' CARGO_TARGET_DIR=target/x86-64 RAYPACKET_BLESS=1 cargo test --test golden
//! RAYPACKET_BLESS=1 cargo test --test golden
//! git diff --stat tests/golden
//! ```

mod common;

use std::collections::BTreeMap;
use std::fs;
use std::path::PathBuf;

use common::{all_builtins, film_bits, picture};
use raypacket::render::{Film, Kernel, tone_map};
use raypacket::scene::Description;

const SIZE: [usize; 2] = [96, 48];

/// The two ways to round that [`raypacket::math::Lanes::mul_add`] has.
const BUILD: &str = if cfg!(any(target_feature = "fma", target_arch = "aarch64")) { "fma" } else { "plain" };

fn golden(file: &str) -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("tests/golden").join(file)
}

fn blessing() -> bool {
    std::env::var_os("RAYPACKET_BLESS").is_some_and(|v| v == "1")
}

fn film(scene: &Description) -> Film {
    picture(scene, Kernel::X8, SIZE[0], SIZE[1])
}

/// FNV-1a, 64 bits, over the little-endian bytes.
fn fnv1a(words: &[u32]) -> u64 {
    let bytes = words.iter().flat_map(|w| w.to_le_bytes());
    bytes.fold(0xcbf2_9ce4_8422_2325, |hash, byte| (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3))
}

/// Hash by scene and build.
fn stored_hashes() -> BTreeMap<String, String> {
    let text = fs::read_to_string(golden("hashes.txt")).unwrap_or_default();
    let line = |line: &str| line.rsplit_once(' ').map(|(key, hash)| (key.to_owned(), hash.to_owned()));
    text.lines().filter_map(line).collect()
}

/// The authors' test vectors for "" and "chongo was here!".
#[test]
fn fnv1a_is_fnv1a() {
    let words: Vec<u32> = b"chongo was here!".chunks(4).map(|c| u32::from_le_bytes(c.try_into().unwrap())).collect();
    assert_eq!([fnv1a(&[]), fnv1a(&words)], [0xcbf2_9ce4_8422_2325, 0x858e_2fa3_2a55_e61d]);
}

#[test]
fn films_are_the_same_to_the_bit() {
    let mut stored = stored_hashes();
    let mut changed = Vec::new();
    for scene in all_builtins() {
        let hash = format!("{:016x}", fnv1a(&film_bits(&film(&scene))));
        let old = stored.insert(format!("{} {BUILD}", scene.name), hash.clone());
        if old.as_ref() != Some(&hash) {
            changed.push(format!("{}: {hash}, was {}", scene.name, old.as_deref().unwrap_or("not there")));
        }
    }
    if blessing() {
        let lines: String = stored.iter().map(|(key, hash)| format!("{key} {hash}\n")).collect();
        fs::write(golden("hashes.txt"), lines).expect("the hashes are written");
    } else {
        assert!(changed.is_empty(), "{BUILD} build: {changed:#?}; if that is meant, see the top of tests/golden.rs");
    }
}

#[test]
fn pictures_look_the_same() {
    for scene in all_builtins() {
        let film = film(&scene);
        let bytes: Vec<u8> = film.pixels.iter().flat_map(|&p| tone_map(p).to_be_bytes()[1..].to_vec()).collect();
        let path = golden(&format!("{}.png", scene.name));
        let [width, height] = SIZE.map(|side| side as u32);
        if blessing() {
            image::save_buffer(&path, &bytes, width, height, image::ColorType::Rgb8).expect("the picture is written");
            continue;
        }
        let stored = image::open(&path).unwrap_or_else(|e| panic!("{}: {e}", path.display())).into_rgb8();
        assert_eq!(stored.dimensions(), (width, height), "{}", path.display());
        let differ = |(a, b): &(&[u8], &[u8])| a.iter().zip(*b).any(|(a, b)| a.abs_diff(*b) > 2);
        let count = bytes.chunks(3).zip(stored.as_raw().chunks(3)).filter(differ).count();
        println!("{} {BUILD}: {count} pixels differ by more than 2/255", scene.name);
        assert!(count * 200 <= SIZE[0] * SIZE[1], "{}: {count} pixels differ by more than 2/255", scene.name);
    }
}
