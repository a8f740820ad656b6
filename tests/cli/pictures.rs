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
    for aov in ["depth", "depth_z", "normal", "geometric_normal", "primitive"] {
        let mut pictures = Vec::new();
        for kernel in ["x1", "x4", "x8", "reference"] {
            let args = format!("good.toml --size 32x16 --aov {aov} --kernel {kernel}");
            render(folder.path(), "a.png", &args);
            pictures.push(render(folder.path(), "a.exr", &args));
            let picture = image::open(folder.path().join("a.png")).unwrap();
            assert_eq!((picture.width(), picture.height()), (32, 16));
            assert_eq!(channels(&folder.path().join("a.exr"))[0].1.len(), 32 * 16);
        }
        assert!(pictures[0] == pictures[1] && pictures[1] == pictures[2], "{aov}");
    }
}

/// The channels of an EXR file, by name.
fn channels(path: &Path) -> Vec<(String, Vec<f32>)> {
    let layer = exr::prelude::read_first_flat_layer_from_file(path).unwrap().layer_data;
    let list = layer.channel_data.list.into_iter();
    list.map(|c| (c.name.to_string(), c.sample_data.values_as_f32().collect())).collect()
}

#[test]
fn aovs_say_what_is_seen() {
    let folder = folder();
    let open = |aov: &str, names: &[&str]| {
        render(folder.path(), "a.exr", &format!("good.toml --size 33x33 --aov {aov}"));
        let channels = channels(&folder.path().join("a.exr"));
        assert_eq!(channels.iter().map(|c| c.0.as_str()).collect::<Vec<_>>(), names, "{aov}");
        move |channel: usize, [x, y]: [usize; 2]| channels[channel].1[y * 33 + x]
    };
    // The eye looks straight at the sphere, id 1, from 5; the floor, id 0, lies below, and nothing above.
    let (middle, below, above) = ([16, 16], [16, 32], [16, 0]);
    let (depth, z) = (open("depth", &["Z"]), open("depth_z", &["Z"]));
    assert!((depth(0, middle) - 4.0).abs() < 1e-3 && (z(0, middle) - 4.0).abs() < 1e-3);
    assert_eq!([depth(0, above), z(0, above)], [f32::INFINITY; 2]);
    // Below the middle by 16 of the 16.5 pixels to the edge, where the tangent is that of half the field of view.
    let tangent = 16.0 / 16.5 * 30.0f32.to_radians().tan();
    let ratio = depth(0, below) / z(0, below);
    assert!((ratio - tangent.hypot(1.0)).abs() < 1e-5, "{ratio}");
    let primitive = open("primitive", &["B", "G", "R"]);
    assert_eq!([middle, below, above].map(|p| primitive(0, p)), [1.0, 0.0, -1.0]);
    for aov in ["normal", "geometric_normal"] {
        let normal = open(aov, &["N.X", "N.Y", "N.Z"]);
        assert!(normal(2, middle) > 0.999);
        assert!(normal(1, below) > 0.999);
        assert_eq!([0, 1, 2].map(|axis| normal(axis, above)), [0.0; 3]);
    }
}

/// A triangle across the view whose vertices all have a normal that leans.
#[test]
fn normals_are_those_for_shading_and_the_surfaces_own() {
    let folder = folder();
    let scene = "camera = { eye = [0, 0, 3], look_at = [0, 0, 0] }\n[[triangle]]\nvertices = [[-9, -9, 0], [9, -9, 0], \
                 [0, 9, 0]]\nnormals = [[3, 0, 4], [3, 0, 4], [3, 0, 4]]\n";
    fs::write(folder.path().join("leaning.toml"), scene).unwrap();
    for (aov, expected) in [("normal", [0.6, 0.0, 0.8]), ("geometric_normal", [0.0, 0.0, 1.0])] {
        for kernel in ["x1", "x8", "reference"] {
            render(folder.path(), "a.exr", &format!("leaning.toml --size 3x3 --aov {aov} --kernel {kernel}"));
            let channels = channels(&folder.path().join("a.exr"));
            let middle = [0, 1, 2].map(|axis: usize| channels[axis].1[4]);
            assert!((0..3).all(|axis| (middle[axis] - expected[axis]).abs() < 1e-6), "{aov} {kernel}: {middle:?}");
        }
    }
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
