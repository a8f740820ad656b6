//! Wrong input: one line that names file, line and key; status 2; no file written, and no panic.

use super::{GOOD, folder, names, raypacket};
use std::fs;

/// Renders [`GOOD`] with `from` replaced by `to`; the message has to name the line of `at` and say all of `words`.
#[track_caller]
fn faulty(from: &str, to: &str, at: &str, words: &[&str]) {
    assert_eq!(GOOD.matches(from).count(), 1, "{from}");
    let text = GOOD.replace(from, to);
    let line = 1 + text[..text.find(at).expect("the fault is in the text")].matches('\n').count();
    let folder = folder();
    fs::write(folder.path().join("bad.toml"), text).unwrap();
    let place = format!("bad.toml:{line}:");
    let words: Vec<&str> = words.iter().copied().chain([&*place]).collect();
    for args in ["render bad.toml -o a.png --size 8x8", "info bad.toml", "verify good.toml bad.toml", "bad.toml"] {
        raypacket(folder.path(), args).failed(2, &words);
    }
    raypacket(folder.path(), "bench good.toml bad.toml --json a.json").failed(2, &words);
    assert_eq!(names(folder.path()), ["bad.toml", "good.toml"]);
}

#[test]
fn unknown_key() {
    faulty("fov = 60.0", "fow = 60.0", "fow", &["fow", "unknown"]);
    faulty("radius = 1.0", "radius = 1.0\ncolour = 3", "colour", &["colour", "unknown"]);
}

#[test]
fn negative_radius() {
    faulty("radius = 1.0", "radius = -1.0", "radius", &["radius", "-1"]);
    faulty("radius = 1.0", "radius = 0.0", "radius", &["radius"]);
}

#[test]
fn numbers_that_are_none() {
    faulty("radius = 1.0", "radius = nan", "radius", &["radius", "NaN"]);
    faulty("radius = 1.0", "radius = inf", "radius", &["radius", "inf"]);
    faulty("eye = [0.0,", "eye = [nan,", "eye", &["eye", "NaN"]);
}

#[test]
fn numbers_out_of_range() {
    faulty("fov = 60.0", "fov = 180.0", "fov", &["fov", "180"]);
    faulty("reflectance = 0.2", "reflectance = 1.5", "reflectance", &["reflectance", "1.5"]);
    faulty("normal = [0.0, 1.0, 0.0]", "normal = [0.0, 0.0, 0.0]", "normal", &["normal"]);
}

#[test]
fn material_that_does_not_exist() {
    faulty("radius = 1.0\nmaterial = \"red\"", "radius = 1.0\nmaterial = \"blue\"", "material = \"blue\"", &["blue"]);
}

#[test]
fn wrong_type_and_broken_toml() {
    faulty("radius = 1.0", "radius = \"big\"", "radius", &["radius"]);
    faulty("fov = 60.0", "fov = ", "fov", &["fov"]);
    faulty("[[light]]", "[[light]", "[[light]", &["light"]);
}

#[test]
fn missing_files_and_unknown_scenes() {
    let folder = folder();
    fs::write(folder.path().join("scene.xyz"), GOOD).unwrap();
    for (scene, words) in [("no.toml", &["no.toml"][..]), ("nothing", &["nothing", "classic"]), ("scene.xyz", &["xyz"])]
    {
        for command in ["render -o a.png --size 8x8", "info", "verify", "bench", "view", ""] {
            raypacket(folder.path(), &format!("{command} {scene}")).failed(2, words);
        }
    }
    raypacket(folder.path(), "bench --size 8x8 --rays no.primary").failed(2, &["no.primary"]);
    fs::write(folder.path().join("torn.primary"), [0; 33]).unwrap();
    raypacket(folder.path(), "bench --size 8x8 --rays torn.primary").failed(2, &["torn.primary"]);
    raypacket(folder.path(), "bench classic flake --rays torn.primary").failed(2, &["--rays"]);
    assert_eq!(names(folder.path()), ["good.toml", "scene.xyz", "torn.primary"]);
}

#[test]
fn a_mesh_file_that_is_not_there() {
    let mesh = "[[mesh]]\nfile = \"no.obj\"\nmaterial = \"red\"\n\n[[plane]]";
    let folder = folder();
    fs::write(folder.path().join("bad.toml"), GOOD.replace("[[plane]]", mesh)).unwrap();
    raypacket(folder.path(), "render bad.toml -o a.png --size 8x8").failed(2, &["no.obj"]);
    assert_eq!(names(folder.path()), ["bad.toml", "good.toml"]);
}

#[test]
fn outputs_that_cannot_be_written() {
    let folder = folder();
    let before = names(folder.path());
    // A size that would take minutes shows that nothing is rendered first.
    let render = |output: &str| raypacket(folder.path(), &format!("render -o {output} --size 8192x8192 --samples 64"));
    render("no/a.png").failed(2, &["no/a.png", "no folder"]);
    render("good.toml/a.png").failed(2, &["good.toml/a.png"]);
    render("/proc/a.png").failed(2, &["/proc/a.png"]);
    for wrong in ["a.jpg", "a", "a.png.gz", "good.toml"] {
        render(wrong).failed(2, &[wrong, ".png", ".exr"]);
    }
    for args in ["bench --svg no/a.svg", "contest --append no/a.jsonl"] {
        raypacket(folder.path(), args).failed(2, &["no/a."]);
    }
    raypacket(folder.path(), "bench --save-rays good.toml").failed(2, &["good.toml", "not a folder"]);
    for command in ["bench", "verify"] {
        raypacket(folder.path(), &format!("{command} --json no/a.json")).failed(2, &["no/a.json"]);
    }
    raypacket(folder.path(), "view --screenshot no/a.png").failed(2, &["no/a.png"]);
    raypacket(folder.path(), "view --screenshot a.exr").failed(2, &["a.exr", ".png"]);
    fs::create_dir(folder.path().join("dir.png")).unwrap();
    render("dir.png").failed(2, &["dir.png", "folder"]);
    fs::remove_dir(folder.path().join("dir.png")).unwrap();
    assert_eq!(names(folder.path()), before);
    assert_eq!(fs::read_to_string(folder.path().join("good.toml")).unwrap(), GOOD);
}

#[test]
fn wrong_scenes_leave_an_old_picture_alone() {
    let folder = folder();
    fs::write(folder.path().join("a.png"), "old").unwrap();
    raypacket(folder.path(), "render no.toml -o a.png").failed(2, &["no.toml"]);
    assert_eq!(fs::read_to_string(folder.path().join("a.png")).unwrap(), "old");
}

/// clap words these itself, over several lines.
#[test]
fn wrong_usage() {
    let folder = folder();
    let cases = [
        ("render", "--output"),
        ("render -o a.png --size 0x0", "1 to 16384"),
        ("render -o a.png --size 0x8", "1 to 16384"),
        ("render -o a.png --size 16385x1", "1 to 16384"),
        ("render -o a.png --size 16384x16384", "more than"),
        ("render -o a.png --size big", "1024x512"),
        ("render -o a.png --size -1x8", "1024x512"),
        ("render -o a.png --threads 0", "1..=1024"),
        ("render -o a.png --threads 1025", "1..=1024"),
        ("render -o a.png --threads -1", "1..=1024"),
        ("render -o a.png --threads many", "threads"),
        ("render -o a.png --samples 0", "1..=64"),
        ("render -o a.png --samples 65", "1..=64"),
        ("render -o a.png --samples adaptiv", "`adaptive`"),
        ("render -o a.png --samples adaptive:256", "0 to 255 display codes"),
        ("render -o a.png --samples adaptive --kernel reference", "give it a number"),
        ("render -o a.png --kernel x16", "x8"),
        ("render -o a.png --aov colour", "depth"),
        ("render -o a.png --aov depth --samples 2", "cannot be used with"),
        ("render classic flake -o a.png", "flake"),
        ("view --kernel reference", "x8"),
        ("--kernel reference", "x8"),
        ("--size 0x8", "1 to 16384"),
        ("--frames 0", "frames"),
        ("--frobnicate", "--frobnicate"),
        ("scenes classic", "classic"),
        ("bench --threads 0", "1..=1024"),
        ("bench --rays a --save-rays b", "cannot be used with"),
        ("contest --frames 0", "1..=1000"),
        ("verify --json", "json"),
    ];
    for (args, words) in cases {
        let run = raypacket(folder.path(), args);
        assert_eq!((run.status, &*run.stdout), (Some(2), ""), "{args}: {}", run.stderr);
        assert!(run.stderr.contains(words) && !run.stderr.contains("panicked"), "{args}: {}", run.stderr);
    }
    assert_eq!(names(folder.path()), ["good.toml"]);
}

#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_is_said_so() {
    let run = std::process::Command::new(env!("CARGO_BIN_EXE_raypacket"))
        .arg("scenes")
        .stdout(fs::File::options().write(true).open("/dev/full").unwrap())
        .output()
        .unwrap();
    let stderr = String::from_utf8_lossy(&run.stderr);
    assert_eq!((run.status.code(), stderr.lines().count()), (Some(1), 1), "{stderr}");
    assert!(stderr.starts_with("raypacket: standard output: "), "{stderr}");
}

/// A folder that cannot be written to is found before anything is measured.
#[test]
fn charts_into_no_folder() {
    let folder = folder();
    for args in ["chart -o no/charts", "chart --quick --output no/charts --threads 2"] {
        raypacket(folder.path(), args).failed(2, &["no/charts"]);
    }
    raypacket(folder.path(), "chart -o good.toml --quick").failed(2, &["good.toml", "file"]);
    fs::create_dir_all(folder.path().join("charts/epsilon.csv")).unwrap();
    raypacket(folder.path(), "chart --quick").failed(2, &["epsilon.csv", "is a folder"]);
    assert_eq!(names(&folder.path().join("charts")), ["epsilon.csv"]);
    assert_eq!(names(folder.path()), ["charts", "good.toml"]);
}

/// Nothing is waited for: neither for somebody who writes to a pipe, nor for what comes through one.
#[cfg(unix)]
#[test]
fn only_regular_files_are_read() {
    use std::process::{Command, Stdio};
    let folder = folder();
    for name in ["pipe", "pipe.toml", "pipe.nff"] {
        assert!(Command::new("mkfifo").arg(folder.path().join(name)).status().unwrap().success());
    }
    for args in ["bench --size 8x8 --rays", "bench --size 8x8 --against", "info", "render -o a.png"] {
        raypacket(folder.path(), &format!("{args} pipe")).failed(2, &["pipe: not a regular file"]);
    }
    for scene in ["pipe.toml", "pipe.nff"] {
        raypacket(folder.path(), &format!("info {scene}")).failed(2, &[&format!("{scene}: not a regular file")]);
    }
    // Standard input is read when it is a file.
    let info = |from: Stdio| {
        let mut command = Command::new(env!("CARGO_BIN_EXE_raypacket"));
        let output = command.args(["info", "/dev/stdin"]).stdin(from).output().unwrap();
        (output.status.code(), String::from_utf8(output.stderr).unwrap())
    };
    let file = fs::File::open(folder.path().join("good.toml")).unwrap();
    assert_eq!(info(file.into()), (Some(0), String::new()));
    assert_eq!(info(Stdio::piped()), (Some(2), "raypacket: /dev/stdin: not a regular file\n".into()));
}
