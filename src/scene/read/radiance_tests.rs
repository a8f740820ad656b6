use super::*;
use image::{Rgb, codecs::hdr::HdrEncoder};

fn read(text: &str, data: &[u8]) -> Result<(usize, usize, Vec<[f32; 3]>), String> {
    decode(&[text.as_bytes(), data].concat(), |_, _| Ok(()))
}

#[test]
fn what_another_program_writes_is_read_as_it_reads_it() {
    let colors = |n: usize| {
        (0..n).map(|i| Rgb([(i * i % 97) as f32, (i / 10) as f32 * 1e-3, if i % 50 < 40 { 8.0 } else { 0.0 }]))
    };
    for width in [1, 7, 8, 100, 300] {
        let pixels: Vec<Rgb<f32>> = colors(width * 5).collect();
        let mut bytes = Vec::new();
        HdrEncoder::new(&mut bytes).encode(&pixels, width, 5).unwrap();
        let theirs = image::load_from_memory_with_format(&bytes, image::ImageFormat::Hdr).unwrap().into_rgb32f();
        let (w, h, texels) = decode(&bytes, |_, _| Ok(())).unwrap();
        assert_eq!((w, h), (width, 5));
        assert_eq!(texels.as_flattened(), &theirs.as_raw()[..]);
    }
}

#[test]
fn numbers_from_the_least_to_the_greatest() {
    assert_eq!(linear([255, 128, 0, 0]), [0.0; 3]);
    assert_eq!(linear([128, 64, 1, 129]), [1.0, 0.5, 1.0 / 128.0]);
    assert_eq!(linear([255; 4]).map(|c| c.is_finite()), [true; 3]);
    assert_eq!(linear([1, 0, 0, 1]), [2f32.powi(-127) / 256.0, 0.0, 0.0]);
}

#[test]
fn headers_and_the_three_ways_to_store_a_row() {
    let plain = [1, 2, 3, 136, 4, 5, 6, 136];
    let texels = vec![[1.0, 2.0, 3.0], [4.0, 5.0, 6.0]];
    for header in
        ["#?RGBE\n\n-Y 1 +X 2\n", "#?RADIANCE\r\n# x\r\nFORMAT= 32-bit_rle_rgbe \r\nEXPOSURE=3\r\n\r\n-Y 1 +X 2\r\n"]
    {
        assert_eq!(read(header, &plain), Ok((2, 1, texels.clone())));
    }
    let old = [7, 7, 7, 136, 1, 1, 1, 3, 1, 1, 1, 1, 9, 0, 0, 136, 1, 1, 1, 1];
    let (.., row) = read("#?RGBE\n\n-Y 1 +X 262\n", &old).unwrap();
    assert_eq!(row[..260], [[7.0; 3]; 260]);
    assert_eq!(row[260..], [[9.0, 0.0, 0.0]; 2]);
    let new = [2, 2, 0, 9, 137, 4, 9, 1, 2, 3, 4, 5, 6, 7, 8, 9, 130, 1, 135, 2, 137, 136];
    let (.., row) = read("#?RGBE\n\n-Y 1 +X 9\n", &new).unwrap();
    assert_eq!((row[0], row[1], row[2], row[8]), ([4.0, 1.0, 1.0], [4.0, 2.0, 1.0], [4.0, 3.0, 2.0], [4.0, 9.0, 2.0]));
}

#[test]
fn faults() {
    let head = "#?RGBE\n\n-Y 1 +X 9\n";
    let zero_runs = [[9, 9, 9, 9].as_slice(), &[1, 1, 1, 0].repeat(50)].concat();
    for (text, data, problem) in [
        ("#?RGBE\n", &[][..], "ends too early"),
        ("#?RGBE\n\n", &[], "ends too early"),
        ("#?RGBE\n\n+X 9 -Y 1\n", &[], "the size must be -Y height +X width, got +X 9 -Y 1"),
        ("#?RGBE\n\n-Y 1 +X 99999999999\n", &[], "not a size: 99999999999"),
        ("#?RGBE\nFORMAT=32-bit_rle_xyze\n\n-Y 1 +X 1\n", &[1; 4], "only FORMAT=32-bit_rle_rgbe can be read"),
        (&format!("#?RGBE\n{}", "x\n".repeat(1001)), &[], "the header is longer than 1000 lines"),
        (head, &[2, 2, 0, 8, 0], "a row is not as wide as the picture"),
        (head, &[2, 2, 0, 9, 138, 1], "a run is longer than its row"),
        (head, &[2, 2, 0, 9, 9, 1, 2], "ends too early"),
        (head, &[1, 1, 1, 4], "a row starts with a run"),
        (head, &[5, 5, 5, 5, 1, 1, 1, 9], "a run is longer than its row"),
        (head, &[5, 5, 5, 5, 1, 1, 1, 0, 1, 1, 1, 0, 1, 1, 1, 1], "a run is longer than its row"),
        (head, &zero_runs, "ends too early"),
        (head, &[5, 5, 5, 5], "ends too early"),
    ] {
        assert_eq!(read(text, data).unwrap_err(), problem, "{text:?} {data:?}");
    }
}
