//! Radiance pictures, the one format of pictures whose reader is the library's own.

use super::Format;

pub const RADIANCE: Format = Format {
    name: "radiance",
    scene: "skies.toml",
    mutated: "sky.hdr",
    seeds: || vec![RUNS.into(), PLAIN.into(), OLD_RUNS.into()],
    tokens: TOKENS,
    // A row of 4 bytes may be 16,384 pixels wide, of 12 bytes each: to 64 million pixels in all.
    memory: |bytes| [50_000 * bytes.len(), 50_000 * bytes.len()],
};

const TOKENS: &str = "FORMAT=32-bit_rle_rgbe\n|#?RADIANCE\n|-Y |+X |\n\n|\x02\x02\x00\x08|\x01\x01\x01\x04";

pub const RUNS: &[u8] = b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\nEXPOSURE=1\n\n-Y 2 +X 8\n\
    \x02\x02\x00\x08\x88\x40\x04\x01\x02\x03\x04\x84\x09\x88\x20\x88\x81\
    \x02\x02\x00\x08\x88\x10\x88\x20\x88\x30\x08\x7f\x80\x81\x82\x83\x84\x85\x86";

const PLAIN: &[u8] = b"#?RGBE\n\n-Y 2 +X 2\n\x10\x20\x30\x80\x40\x50\x60\x81\x01\x00\x00\x01\xff\xff\xff\x9d";

const OLD_RUNS: &[u8] = b"#?RADIANCE\n\n-Y 2 +X 6\n\x10\x20\x30\x80\x01\x01\x01\x05\x01\x02\x03\x70\x01\x01\x01\x02\
    \x09\x09\x09\x82\x01\x01\x01\x02";
