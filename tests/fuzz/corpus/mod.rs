//! Sound files that have every key and command of their format, and what damages them.

mod nff;
mod obj;
mod radiance;
mod toml;

use std::io::Cursor;

use image::{ImageFormat, RgbImage};

pub use self::{
    nff::NFF,
    obj::{MTL, OBJ},
    radiance::RADIANCE,
    toml::TOML,
};
use crate::watch::Memory;

/// What is damaged.
pub struct Format {
    pub name: &'static str,
    /// The file that is read.
    pub scene: &'static str,
    /// The damaged file: that one, or one that it refers to.
    pub mutated: &'static str,
    /// Files that are sound.
    pub seeds: fn() -> Vec<Vec<u8>>,
    /// Words of the format, with `|` between.
    pub tokens: &'static str,
    /// What may be taken: to read, what the limits of [`raypacket::scene`] say of memory.
    pub memory: Memory,
}

pub const FORMATS: [&Format; 5] = [&TOML, &NFF, &OBJ, &MTL, &RADIANCE];

/// What the scenes refer to, by its place beside them.
pub fn files() -> Vec<(&'static str, Vec<u8>)> {
    let mut png = Vec::new();
    let pixels = (0..48).map(|i| i * 5).collect();
    let image = RgbImage::from_raw(4, 4, pixels).expect("4 × 4 × 3 bytes");
    image.write_to(&mut Cursor::new(&mut png), ImageFormat::Png).expect("memory");
    vec![
        ("textures/brick.png", png.clone()),
        ("textures/globe.png", png.clone()),
        ("a b.png", png),
        ("textures/dusk.hdr", radiance::RUNS.into()),
        ("sky.hdr", radiance::RUNS.into()),
        ("skies.toml", b"sky.image = 'sky.hdr'\nsphere = [{ center = [0, 1, 0], radius = 1 }]\n".into()),
        ("meshes/vase.obj", obj::SEEDS[0].into()),
        ("meshes/ball.obj", obj::SEEDS[0].into()),
        ("mesh.obj", obj::SEEDS[0].into()),
        ("clothed.obj", obj::SEEDS[1].into()),
        ("scene.mtl", obj::MATERIALS.into()),
    ]
}

fn texts(texts: &[&str]) -> Vec<Vec<u8>> {
    texts.iter().map(|text| text.as_bytes().into()).collect()
}

/// Numbers that are as large or small as may be, or a little more, or that only some readers take for numbers.
pub const NUMBERS: &str = "\
    0|-0|0.0|1|-1|2|3|8|9|64|65|180|179.99999|0.01|0.5|1e999|-1e999|1e-999|nan|-nan|inf|+inf|-inf|infinity|\
    3.4028235e38|3.5e38|1e38|1e-45|1e-46|1.1754944e-38|1e12|-1e12|1.0000001e12|1e18|-1e18|1.1e18|1e-12|9e-13|\
    1e6|1e5|16777217|0.99999994|1.0000001|65535|65536|65537|2147483647|2147483648|-2147483648|4294967294|\
    4294967295|4294967296|9223372036854775807|-9223372036854775808|18446744073709551615|18446744073709551616|\
    340282366920938463463374607431768211456|0x7fffffff|0o17|0b1|1_000|1e|1.|.5|+1|--1|1e+|1,5|1f||\
    0.00000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000001|\
    123456789012345678901234567890123456789012345678901234567890123456789012345678901234567890123456789012345678901";

/// What is no text, or only looks like it.
pub const ODD: &[&[u8]] = &[
    b"\0",
    b"\xff",
    b"\xc0\x80",
    b"\xed\xa0\x80",
    b"\xf4\x90\x80\x80",
    b"\xe2\x80",
    b"\xef\xbb\xbf",
    b"\xe2\x80\xa8",
    b"\x1b[2J",
    b"\r",
    b"\r\n",
    b"\x0b",
    b"\x0c",
    b"\x85",
    b"\xc2\xa0",
    b"\xf0\x9f\xa6\x80",
    b"\x7f",
    b"\t",
];
