//! How much memory the readers take for short files that stand for much.

use std::fs;
use std::path::Path;

use image::{ExtendedColorType, ImageFormat};
use peak_alloc::PeakAlloc;
use raypacket::scene::load;

#[global_allocator]
static HEAP: PeakAlloc = PeakAlloc;

/// The most bytes that are taken at once beyond those taken before.
fn most<T>(run: impl FnOnce() -> T) -> (usize, T) {
    let before = HEAP.current_usage();
    HEAP.reset_peak_usage();
    let done = run();
    (HEAP.peak_usage() - before, done)
}

fn png(width: u32, height: u32, color: ExtendedColorType) -> Vec<u8> {
    let bytes = vec![0; width as usize * height as usize * usize::from(color.bits_per_pixel() / 8)];
    let mut to = std::io::Cursor::new(Vec::new());
    image::write_buffer_with_format(&mut to, &bytes, width, height, color, ImageFormat::Png).unwrap();
    to.into_inner()
}

fn chunk(name: &[u8; 4], data: &[u8]) -> Vec<u8> {
    let body = [name, data].concat();
    let shift = |crc: u32, _| (crc >> 1) ^ ((crc & 1) * 0xedb8_8320);
    let crc = !body.iter().fold(!0u32, |crc, byte| (0..8).fold(crc ^ u32::from(*byte), shift));
    [&(data.len() as u32).to_be_bytes()[..], &body, &crc.to_be_bytes()].concat()
}

/// What the chunks of a name hold together.
fn held(png: &[u8], name: &[u8; 4]) -> Vec<u8> {
    let (mut rest, mut held) = (&png[8..], Vec::new());
    while let Some((length, after)) = rest.split_first_chunk() {
        let length = u32::from_be_bytes(*length) as usize;
        if after.starts_with(name) {
            held.extend(&after[4..4 + length]);
        }
        rest = &after[length + 8..];
    }
    held
}

/// A test alone, as the heap is the whole program's.
#[test]
fn short_pictures_take_little() {
    let folder = tempfile::tempdir().unwrap();
    let read = |picture: &[u8]| {
        fs::write(folder.path().join("a.png"), picture).unwrap();
        let scene = folder.path().join("s.toml");
        fs::write(&scene, "materials.a.texture = 'a.png'").unwrap();
        let load = |scene: &Path| load(scene.to_str().unwrap()).expect("a sound scene").textures[0].texels.len();
        most(|| load(&scene))
    };
    let bound = |file: usize, pixels: usize| 3 * pixels + 4 * file + (2 << 20);

    // A colour profile of 64 MiB, compressed to less than a hundredth.
    let profile = held(&png(8192, 8192, ExtendedColorType::L8), b"IDAT");
    let mut one = png(1, 1, ExtendedColorType::L8);
    one.splice(33..33, chunk(b"iCCP", &[b"p\0\0", &profile[..]].concat()));
    assert!(one.len() < 640 << 10, "{}", one.len());
    let (taken, pixels) = read(&one);
    assert_eq!(pixels, 1);
    assert!(taken < bound(one.len(), 1), "{taken} bytes for a pixel with a profile");

    // 16 bits of four channels, of which three bytes a pixel stay.
    let wide = png(2048, 2048, ExtendedColorType::Rgba16);
    let (taken, pixels) = read(&wide);
    assert_eq!(pixels, 1 << 22);
    assert!(taken < bound(wide.len(), pixels), "{taken} bytes for {pixels} pixels");

    // What promises more pixels than it can hold gets none.
    let mut short = png(8192, 8192, ExtendedColorType::Rgba16);
    short.truncate(2000);
    fs::write(folder.path().join("a.png"), &short).unwrap();
    let scene = folder.path().join("s.toml");
    let (taken, refused) = most(|| load(scene.to_str().unwrap()).unwrap_err().to_string());
    assert!(taken < bound(short.len(), 0) && refused.ends_with("ends too early"), "{taken}: {refused}");
}
