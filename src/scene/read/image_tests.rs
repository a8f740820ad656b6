use super::*;
use crate::scene::{Description, Pigment, Sky, Wrap, read};
use image::{ColorType, ExtendedColorType};
use std::fs;

#[path = "../../../examples/pictures/art.rs"]
mod art;

fn encoded(bytes: &[u8], width: u32, height: u32, color: impl Into<ExtendedColorType>, format: ImageFormat) -> Vec<u8> {
    let mut to = Cursor::new(Vec::new());
    image::write_buffer_with_format(&mut to, bytes, width, height, color, format).unwrap();
    to.into_inner()
}

fn png(bytes: &[u8], width: u32, height: u32, color: ColorType) -> Vec<u8> {
    encoded(bytes, width, height, color, ImageFormat::Png)
}

/// A smooth picture.
fn slope(width: u32, height: u32) -> Vec<u8> {
    (0..width * height).flat_map(|i| [i % width * 7, i / width * 9, 90].map(|c| c as u8)).collect()
}

fn exr(texels: &[[f32; 3]], width: u32) -> Vec<u8> {
    let bytes = bytemuck::cast_slice(texels);
    encoded(bytes, width, texels.len() as u32 / width, ExtendedColorType::Rgb32F, ImageFormat::OpenExr)
}

fn texture(bytes: &[u8]) -> Result<Texture, String> {
    Images::new(&Assets::Builtin).rgb8(bytes)
}

fn panorama(bytes: &[u8]) -> Result<Panorama, String> {
    Images::new(&Assets::Builtin).linear(bytes)
}

/// Reads a scene with a folder of files beside it.
fn scene(text: &str, files: &[(&str, &[u8])]) -> Result<Description, String> {
    let folder = tempfile::tempdir().unwrap();
    files.iter().for_each(|(name, bytes)| fs::write(folder.path().join(name), bytes).unwrap());
    let file = folder.path().join("s.toml");
    fs::write(&file, text).unwrap();
    let place = format!("{}/", folder.path().display());
    read(&file).map_err(|error| error.to_string().replace(&place, ""))
}

#[test]
fn every_kind_of_pixel_becomes_rgb_of_8_bits() {
    let of = |bytes: &[u8], color| {
        let t = texture(&png(bytes, 2, 1, color)).unwrap();
        assert_eq!((t.width, t.height), (2, 1));
        t.texels
    };
    assert_eq!(of(&[1, 2, 3, 4, 5, 6], ColorType::Rgb8), [[1, 2, 3], [4, 5, 6]]);
    assert_eq!(of(&[1, 2, 3, 0, 4, 5, 6, 128], ColorType::Rgba8), [[1, 2, 3], [4, 5, 6]], "alpha is dropped");
    assert_eq!(of(&[7, 200], ColorType::L8), [[7; 3], [200; 3]]);
    assert_eq!(of(&[7, 0, 200, 9], ColorType::La8), [[7; 3], [200; 3]]);
    let wide = |values: &[u16]| bytemuck::cast_slice::<u16, u8>(values).to_vec();
    // 257 of the 65535 steps are one of the 255.
    assert_eq!(
        of(&wide(&[0, 257 * 100, 257 * 100 + 120, 257 * 100 + 140, 65535, 1]), ColorType::Rgb16),
        [[0, 100, 100], [101, 255, 0]]
    );
    assert_eq!(of(&wide(&[257 * 9, 65535]), ColorType::L16), [[9; 3], [255; 3]]);
}

/// A PNG whose rows, each with its filter before it, are not compressed.
fn by_hand(size: [u8; 2], [depth, color, interlaced]: [u8; 3], palette: &[u8], rows: &[u8]) -> Vec<u8> {
    let mut png = b"\x89PNG\r\n\x1a\n".to_vec();
    let mut chunk = |name: &[u8; 4], data: &[u8]| {
        let body = [name, data].concat();
        let crc = !body.iter().fold(!0u32, |crc, byte| {
            (0..8).fold(crc ^ u32::from(*byte), |crc, _| (crc >> 1) ^ ((crc & 1) * 0xedb8_8320))
        });
        png.extend((data.len() as u32).to_be_bytes());
        png.extend(body);
        png.extend(crc.to_be_bytes());
    };
    chunk(b"IHDR", &[0, 0, 0, size[0], 0, 0, 0, size[1], depth, color, 0, 0, interlaced]);
    if !palette.is_empty() {
        chunk(b"PLTE", palette);
    }
    let length = rows.len() as u16;
    let stored = [&[0x78, 1, 1], &length.to_le_bytes()[..], &(!length).to_le_bytes(), rows, &[0; 4]].concat();
    chunk(b"IDAT", &stored);
    chunk(b"IEND", b"");
    png
}

#[test]
fn few_bits_and_palettes_become_rgb() {
    let of = |png: Vec<u8>| texture(&png).unwrap().texels;
    let grey = |values: [u8; 4]| values.map(|v| [v; 3]);
    assert_eq!(of(by_hand([4, 1], [1, 0, 0], b"", &[0, 0b1011_0000])), grey([255, 0, 255, 255]));
    assert_eq!(of(by_hand([4, 1], [2, 0, 0], b"", &[0, 0b0001_1011])), grey([0, 85, 170, 255]));
    assert_eq!(
        of(by_hand([4, 1], [2, 3, 0], &[9, 8, 7, 1, 2, 3], &[0, 0b0001_0100])),
        [[9, 8, 7], [1, 2, 3], [1, 2, 3], [9, 8, 7]]
    );
    assert_eq!(of(by_hand([1, 1], [16, 4, 0], b"", &[0, 0x12, 0xff, 0, 0])), [[0x13; 3]], "rounded");
    assert_eq!(of(by_hand([1, 1], [16, 6, 0], b"", &[0, 1, 1, 2, 2, 3, 3, 9, 9])), [[1, 2, 3]]);
    let short = texture(&by_hand([1, 2], [8, 0, 0], b"", &[0, 1])).unwrap_err();
    assert!(short.contains("not have enough data"), "{short}");
}

/// The seven passes of Adam7, each with its first column and row and its steps.
#[test]
fn interlaced_pictures_are_put_together() {
    let passes = [[0, 0, 8, 8], [4, 0, 8, 8], [0, 4, 4, 8], [2, 0, 4, 4], [0, 2, 2, 4], [1, 0, 2, 2], [0, 1, 1, 2]];
    for [width, height] in [[8, 8], [11, 5], [1, 1], [3, 17]] {
        let value = |x: usize, y: usize| (y * width + x) as u8;
        let mut rows = Vec::new();
        for [x, y, dx, dy] in passes {
            for y in (y..height).step_by(dy).filter(|_| x < width) {
                rows.push(0);
                rows.extend((x..width).step_by(dx).map(|x| value(x, y)));
            }
        }
        let found = texture(&by_hand([width as u8, height as u8], [8, 0, 1], b"", &rows)).unwrap();
        let expected: Vec<[u8; 3]> = (0..width * height).map(|i| [i as u8; 3]).collect();
        assert_eq!(found.texels, expected, "{width} × {height}");
    }
}

/// What is counted is what is read: a file, whatever the number of its spellings.
#[cfg(unix)]
#[test]
fn a_file_is_one_texture_however_it_is_spelled() {
    let folder = tempfile::tempdir().unwrap();
    ["a", "b"].iter().for_each(|name| fs::create_dir(folder.path().join(name)).unwrap());
    let one = png(&[1, 2, 3], 1, 1, ColorType::Rgb8);
    fs::write(folder.path().join("one.png"), &one).unwrap();
    std::os::unix::fs::symlink("../one.png", folder.path().join("a/link")).unwrap();
    let assets = Assets::Folder(folder.path().into());
    for count in [500, 1000] {
        let mut images = Images::new(&assets);
        for i in 0..count {
            let way: String = (0..10).map(|bit| if i >> bit & 1 == 1 { "a/../" } else { "b/../" }).collect();
            assert_eq!(images.texture(&format!("{way}one.png")).unwrap(), 0);
            assert_eq!(images.texture_at(folder.path().join(format!("{way}a/link"))).unwrap(), 0);
        }
        let taken = [MAX_IMAGE_BYTES - images.bytes_left, MAX_IMAGE_PIXELS - images.pixels_left];
        assert_eq!((taken, images.textures.len()), ([one.len() as u64, 1], 1), "{count}");
    }
}

#[test]
fn jpeg_is_read_as_nearly_as_it_keeps() {
    let bytes = slope(24, 16);
    let t = texture(&encoded(&bytes, 24, 16, ColorType::Rgb8, ImageFormat::Jpeg)).unwrap();
    assert_eq!((t.width, t.height), (24, 16));
    let off = t.texels.as_flattened().iter().zip(&bytes).map(|(a, b)| a.abs_diff(*b)).max();
    assert!(off < Some(40), "{off:?}");
    let grey = encoded(&[77; 64], 8, 8, ColorType::L8, ImageFormat::Jpeg);
    assert!(texture(&grey).unwrap().texels.iter().flatten().all(|c| c.abs_diff(77) < 4));
}

#[test]
fn panoramas_are_linear() {
    let (.., bytes) = panorama(&png(&[0, 128, 255], 1, 1, ColorType::Rgb8)).unwrap();
    assert_eq!(bytes, [[0.0, linear_of_bytes()[128], 1.0]]);
    assert_eq!(panorama(b"#?RADIANCE\n\n-Y 1 +X 1\n\x80\x40\x00\x82").unwrap(), (1, 1, vec![[2.0, 1.0, 0.0]]));
}

#[test]
fn a_scene_finds_its_images_beside_itself() {
    let text = "sky.image = 'sky.hdr'\nsky.rotation = 30\nmaterials.a.texture = 'a.png'\nmaterials.b.texture = 'a.png'\n\
                materials.b.texture_size = 2.5\nmaterials.c.texture = 'c'\nmaterials.c.texture_wrap = 'clamp'\n\
                materials.d.texture = 'c'\nmaterials.d.texture_wrap = 'repeat'\n";
    let one = png(&[1, 2, 3], 1, 1, ColorType::Rgb8);
    let other = encoded(&[0; 3], 1, 1, ColorType::Rgb8, ImageFormat::Jpeg);
    let files: [(&str, &[u8]); 3] =
        [("sky.hdr", b"#?RGBE\n\n-Y 1 +X 1\n\x80\x40\x00\x82"), ("a.png", &one), ("c", &other)];
    let d = scene(text, &files).unwrap();
    let pigments: Vec<_> = d.materials.iter().map(|m| m.pigment).collect();
    let texture = |texture, size, wrap| Pigment::Texture { texture, size, wrap };
    let ends = Wrap::Ends;
    let expected =
        [texture(0, 1.0, ends), texture(0, 2.5, ends), texture(1, 1.0, Wrap::Clamp), texture(1, 1.0, Wrap::Repeat)];
    assert_eq!(pigments, expected, "one file, one texture");
    assert_eq!((d.textures.len(), &d.textures[0].texels[..]), (2, &[[1, 2, 3]][..]));
    let Sky::Dome(dome) = d.sky else { panic!("a dome") };
    assert_eq!((dome.width, dome.height, dome.rotation, &dome.texels[..]), (1, 1, 30.0, &[[2.0, 1.0, 0.0]][..]));
}

#[test]
fn a_texture_wraps_in_no_other_way() {
    let one = png(&[1, 2, 3], 1, 1, ColorType::Rgb8);
    let error = scene("materials.a.texture = 'a.png'\nmaterials.a.texture_wrap = 'mirror'\n", &[("a.png", &one)]);
    assert!(error.unwrap_err().ends_with(":2: materials.a.texture_wrap: no \"mirror\"; there are repeat and clamp"));
}

#[test]
fn every_fault_is_a_line_with_the_place_and_the_file() {
    let bad = exr(&[[1.0; 3]], 1);
    let wide = png(&vec![0; 16_385], 16_385, 1, ColorType::L8);
    let files: [(&str, &[u8]); 4] = [
        ("bad.exr", &bad),
        ("wide.png", &wide),
        ("huge.hdr", b"#?RADIANCE\n\n-Y 16384 +X 16384\n"),
        ("text", b"hello"),
    ];
    for (text, message) in [
        ("\nmaterials.x.texture = 'text'", "s.toml:2: materials.x.texture: text: neither PNG nor JPEG"),
        ("materials.x.texture = 'bad.exr'", "s.toml:1: materials.x.texture: bad.exr: neither PNG nor JPEG"),
        ("materials.x.texture = 'none'", "s.toml:1: materials.x.texture: none: No such file or directory (os error 2)"),
        ("materials.x.texture = '../'", "s.toml:1: materials.x.texture: ../: not a regular file"),
        (
            "materials.x.texture = 'wide.png'",
            "s.toml:1: materials.x.texture: wide.png: 16385 × 1: at most 16384 pixels a side",
        ),
        ("sky.image = 'text'", "s.toml:1: sky.image: text: neither Radiance, PNG nor JPEG"),
        ("sky.image = 'bad.exr'", "s.toml:1: sky.image: bad.exr: neither Radiance, PNG nor JPEG"),
        (
            "sky.image = 'huge.hdr'",
            "s.toml:1: sky.image: huge.hdr: 16384 × 16384: at most 67108864 pixels in all images, 67108864 left",
        ),
    ] {
        assert_eq!(scene(text, &files).unwrap_err(), message);
    }
}

#[cfg(unix)]
#[test]
fn a_pipe_is_refused_and_not_waited_for() {
    let folder = tempfile::tempdir().unwrap();
    let pipe = folder.path().join("pipe");
    assert!(std::process::Command::new("mkfifo").arg(&pipe).status().unwrap().success());
    let assets = Assets::Folder(folder.path().into());
    let mut images = Images::new(&assets);
    let refused = format!("{}: not a regular file", pipe.display());
    assert_eq!(images.texture("pipe").unwrap_err().to_string(), refused);
    assert_eq!(images.panorama("pipe").unwrap_err().to_string(), refused);
    assert!(images.panorama("/dev/zero").unwrap_err().to_string().ends_with("not a regular file"));
}

#[test]
fn what_an_image_takes_is_taken_off_for_the_next() {
    let assets = Assets::Builtin;
    let mut images = Images::new(&assets);
    images.pixels_left = 5;
    let small = png(&[0; 12], 2, 2, ColorType::Rgb8);
    images.rgb8(&small).unwrap();
    assert_eq!(images.rgb8(&small).unwrap_err(), "2 × 2: at most 67108864 pixels in all images, 1 left");
    images.bytes_left = 10;
    assert!(images.texture("textures/brick.png").unwrap_err().to_string().ends_with("brick.png: longer than 10 bytes"));
}

#[test]
fn a_great_size_in_a_short_file_is_refused_at_once() {
    let mut jpeg = encoded(&slope(8, 8), 8, 8, ColorType::Rgb8, ImageFormat::Jpeg);
    let frame = jpeg.windows(2).position(|w| w == [0xff, 0xc0]).unwrap();
    jpeg[frame + 5..frame + 9].copy_from_slice(&[0x40, 0, 0x40, 0]);
    let message = texture(&jpeg).unwrap_err();
    assert_eq!(message, "16384 × 16384: at most 67108864 pixels in all images, 67108864 left");
    assert_eq!(panorama(b"#?RGBE\n\n-Y 1 +X 16385\n").unwrap_err(), "16385 × 1: at most 16384 pixels a side");
    assert_eq!(panorama(b"#?RGBE\n\n-Y 0 +X 5\n").unwrap_err(), "no pixels: 5 × 0");
    assert_eq!(panorama(b"#?RGBE\n\n-Y 8192 +X 8192\n").unwrap_err(), "ends too early");
}

#[test]
fn no_damage_to_a_file_makes_it_panic() {
    let floats: Vec<[f32; 3]> = (0..96).map(|i| [i as f32 / 9.0, 2.0, 0.25]).collect();
    let mut runs = b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 2 +X 300\n".to_vec();
    for _ in 0..2 {
        runs.extend([9, 8, 7, 130, 1, 1, 1, 42, 1, 1, 1, 1]);
        runs.extend([5, 5, 5, 5]);
    }
    let mut pixels = Vec::new();
    let hdr: Vec<image::Rgb<f32>> = floats.iter().copied().map(image::Rgb).collect();
    image::codecs::hdr::HdrEncoder::new(&mut pixels).encode(&hdr, 12, 8).unwrap();
    let sound = [
        png(&slope(9, 7), 9, 7, ColorType::Rgb8),
        encoded(&slope(16, 9), 16, 9, ColorType::Rgb8, ImageFormat::Jpeg),
        pixels,
        runs,
    ];
    let mut state = 1u64;
    let mut random = |below: usize| {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 33) as usize % below
    };
    for file in &sound {
        panorama(file).unwrap();
        for _ in 0..800 {
            let mut bytes = file.clone();
            for _ in 0..=random(3) {
                let at = random(bytes.len());
                match random(5) {
                    0 => bytes.truncate(at.max(1)),
                    1 => bytes[at] ^= 1 << random(8),
                    2 => bytes[at] = [0, 1, 127, 128, 255][random(5)],
                    3 => bytes.insert(at, random(256) as u8),
                    _ => drop(bytes.remove(at)),
                }
                if bytes.is_empty() {
                    break;
                }
            }
            if let Ok((width, height, texels)) = panorama(&bytes) {
                assert!(texels.len() == width * height && texels.len() as u64 <= MAX_IMAGE_PIXELS);
            }
        }
    }
}

#[test]
fn the_built_in_images_are_what_their_generator_makes() {
    let assets = Assets::Builtin;
    let mut images = Images::new(&assets);
    for (name, width, made) in [("textures/brick.png", 256, art::brick()), ("textures/globe.png", 512, art::globe())] {
        let index = images.texture(name).unwrap();
        let texture = &images.textures[index];
        assert_eq!((texture.width, texture.texels.len()), (width, made.len()));
        // A byte may be rounded otherwise where sines are.
        let close = |(a, b): (&[u8; 3], &[u8; 3])| (0..3).all(|k| a[k].abs_diff(b[k]) <= 1);
        assert!(texture.texels.iter().zip(&made).all(close), "{name}: run `cargo run --example pictures`");
    }
    let (width, height, texels) = images.panorama("textures/dusk.hdr").unwrap();
    assert_eq!((width, height), (256, 128));
    for (read, made) in texels.iter().zip(art::dusk()) {
        // Eight bits for the greatest channel.
        let step = made.iter().copied().fold(0.0, f32::max) / 100.0;
        assert!((0..3).all(|k| (read[k] - made[k]).abs() <= step), "{read:?}, not {made:?}");
    }
    assert_eq!(
        images.texture("textures/none.png").unwrap_err().to_string(),
        "scenes/textures/none.png: not among the built-in files"
    );
}
