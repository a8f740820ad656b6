//! `raypacket render`: files that other programs can read, the same whatever makes them.

use super::{folder, names, raypacket};
use image::DynamicImage;
use std::fs;
use std::path::Path;

/// Renders with `args` into `file` and gives back its bytes.
#[track_caller]
fn render(folder: &Path, file: &str, args: &str) -> Vec<u8> {
    raypacket(folder, &format!("render -o {file} {args}")).good();
    fs::read(folder.join(file)).unwrap()
}

#[test]
fn png_and_exr_hold_the_picture() {
    let folder = folder();
    render(folder.path(), "a.png", "good.toml --size 33x17");
    render(folder.path(), "a.EXR", "good.toml --size 33x17 --samples 2");
    let png = image::open(folder.path().join("a.png")).unwrap();
    assert!(matches!(png, DynamicImage::ImageRgb8(_)));
    assert_eq!((png.width(), png.height()), (33, 17));
    let exr = image::open(folder.path().join("a.EXR")).unwrap();
    assert!(matches!(exr, DynamicImage::ImageRgb32F(_)));
    assert_eq!((exr.width(), exr.height()), (33, 17));
    let different: std::collections::HashSet<_> = png.into_rgb8().pixels().map(|p| p.0).collect();
    assert!(different.len() > 10, "there is something to see");
    assert_eq!(names(folder.path()), ["a.EXR", "a.png", "good.toml"], "and no temporary file is left");
}

#[test]
fn a_single_pixel_and_a_single_row() {
    let folder = folder();
    for size in ["1x1", "1x9", "9x1"] {
        render(folder.path(), "a.png", &format!("--size {size}"));
        let picture = image::open(folder.path().join("a.png")).unwrap();
        assert_eq!(format!("{}x{}", picture.width(), picture.height()), size);
    }
}

#[test]
fn kernel_and_threads_change_no_byte() {
    let folder = folder();
    for (file, scene) in [("a.png", "good.toml"), ("a.exr", "classic")] {
        let picture = |args: &str| render(folder.path(), file, &format!("{scene} --size 61x35 {args}"));
        let first = picture("");
        let others = ["", "--kernel x1", "--kernel x4", "--kernel x8", "--threads 1", "--threads 3 --kernel x4"];
        for args in others {
            assert!(picture(args) == first, "{scene} {args}");
        }
    }
}

#[test]
fn the_reference_makes_nearly_the_same_picture() {
    let folder = folder();
    render(folder.path(), "a.exr", "good.toml --size 32x16");
    render(folder.path(), "b.exr", "good.toml --size 32x16 --kernel reference");
    let open = |name: &str| image::open(folder.path().join(name)).unwrap().into_rgb32f().into_raw();
    let (a, b) = (open("a.exr"), open("b.exr"));
    let differ = a.iter().zip(&b).filter(|(a, b)| (*a - *b).abs() > 1e-3 * b.abs().max(1.0)).count();
    assert!(differ * 50 < a.len(), "{differ} of {} values differ", a.len());
}

#[test]
fn every_aov_in_both_formats() {
    let folder = folder();
    for aov in ["depth", "normal", "primitive"] {
        let mut pictures = Vec::new();
        for kernel in ["x1", "x4", "x8", "reference"] {
            let args = format!("good.toml --size 32x16 --aov {aov} --kernel {kernel}");
            render(folder.path(), "a.png", &args);
            pictures.push(render(folder.path(), "a.exr", &args));
            for file in ["a.png", "a.exr"] {
                let picture = image::open(folder.path().join(file)).unwrap();
                assert_eq!((picture.width(), picture.height()), (32, 16));
            }
        }
        assert!(pictures[0] == pictures[1] && pictures[1] == pictures[2], "{aov}");
    }
}

#[test]
fn aovs_say_what_is_seen() {
    let folder = folder();
    let open = |aov: &str| {
        render(folder.path(), "a.exr", &format!("good.toml --size 33x33 --aov {aov}"));
        image::open(folder.path().join("a.exr")).unwrap().into_rgb32f()
    };
    // The eye looks straight at the sphere, id 1, from 5; the floor, id 0, lies below, and nothing above.
    let (middle, below, above) = ((16, 16), (16, 32), (16, 0));
    let depth = open("depth");
    let at = |picture: &image::Rgb32FImage, (x, y)| picture.get_pixel(x, y).0;
    assert!((at(&depth, middle)[0] - 4.0).abs() < 1e-3);
    assert!(at(&depth, below)[0].is_finite());
    assert_eq!(at(&depth, above), [f32::INFINITY; 3]);
    let primitive = open("primitive");
    assert_eq!([middle, below, above].map(|p| at(&primitive, p)[0]), [1.0, 0.0, -1.0]);
    let normal = open("normal");
    assert!(at(&normal, middle)[2] > 0.999);
    assert!(at(&normal, below)[1] > 0.999);
    assert_eq!(at(&normal, above), [0.0; 3]);
}

#[cfg(unix)]
#[test]
fn an_old_picture_is_replaced_and_links_are_followed() {
    let folder = folder();
    let (real, link) = (folder.path().join("real.png"), folder.path().join("link.png"));
    fs::write(&real, "old").unwrap();
    std::os::unix::fs::symlink("real.png", &link).unwrap();
    render(folder.path(), "link.png", "--size 8x8");
    assert!(fs::symlink_metadata(&link).unwrap().is_symlink());
    assert_eq!(image::open(&real).unwrap().width(), 8);
}
