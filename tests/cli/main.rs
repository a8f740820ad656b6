//! The command line as its users meet it: status, messages, files.

mod contest;
mod errors;
#[cfg(unix)]
mod interrupt;
mod measures;
mod pictures;
mod runs;

use assert_cmd::cargo::cargo_bin_cmd;
use std::fs;
use std::path::Path;
use tempfile::TempDir;

/// What a run of `raypacket` left behind.
struct Run {
    status: Option<i32>,
    stdout: String,
    stderr: String,
}

impl Run {
    /// Asserts status 0 and silence on standard error.
    #[track_caller]
    fn good(self) -> Self {
        assert_eq!((self.status, &*self.stderr), (Some(0), ""), "{}", self.stdout);
        self
    }

    /// Asserts that it failed with `status`, one line on standard error that says all of `words`, and no other output.
    #[track_caller]
    fn failed(self, status: i32, words: &[&str]) {
        assert_eq!((self.status, &*self.stdout), (Some(status), ""), "{}", self.stderr);
        assert!(self.stderr.starts_with("raypacket: "), "{}", self.stderr);
        assert!(self.stderr.ends_with('\n') && self.stderr.lines().count() == 1, "{}", self.stderr);
        for word in words {
            assert!(self.stderr.contains(word), "no {word:?} in {}", self.stderr);
        }
    }
}

/// Runs `raypacket` in a folder, with arguments separated by spaces and without a display.
fn raypacket(folder: &Path, args: &str) -> Run {
    let mut command = cargo_bin_cmd!("raypacket");
    command.current_dir(folder).args(args.split_whitespace()).env_remove("DISPLAY").env_remove("WAYLAND_DISPLAY");
    let output = command.output().expect("the program runs");
    let text = |bytes| String::from_utf8(bytes).expect("UTF-8");
    Run { status: output.status.code(), stdout: text(output.stdout), stderr: text(output.stderr) }
}

/// A folder of one's own, with a small scene `good.toml` in it.
fn folder() -> TempDir {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("good.toml"), GOOD).unwrap();
    folder
}

/// The names of the files in a folder.
fn names(folder: &Path) -> Vec<String> {
    let mut names: Vec<String> =
        fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
    names.sort();
    names
}

/// A scene with a line for each kind of fault to be put into.
const GOOD: &str = r#"[camera]
eye = [0.0, 1.0, 5.0]
look_at = [0.0, 1.0, 0.0]
fov = 60.0

[[light]]
position = [3.0, 5.0, 2.0]
power = [400.0, 400.0, 400.0]

[materials.red]
color = [0.8, 0.1, 0.1]
reflectance = 0.2

[[plane]]
normal = [0.0, 1.0, 0.0]
distance = 0.0
material = "red"

[[sphere]]
center = [0.0, 1.0, 0.0]
radius = 1.0
material = "red"
"#;

/// Adds `many.toml` to a folder: [`GOOD`] and 200 more spheres, which are worth a tree.
fn add_many(folder: &Path) {
    let ball = |i: usize| {
        let [x, z] = [i % 20, i / 20].map(|i| i as f32 * 0.3 - 3.0);
        format!("[[sphere]]\ncenter = [{x:?}, 2.5, {z:?}]\nradius = 0.1\nmaterial = \"red\"\n")
    };
    fs::write(folder.join("many.toml"), GOOD.to_owned() + &(0..200).map(ball).collect::<String>()).unwrap();
}

#[test]
fn scenes_lists_the_built_in_ones() {
    let folder = folder();
    let run = raypacket(folder.path(), "scenes").good();
    for scene in raypacket::scene::builtins() {
        let line = run.stdout.lines().find(|line| line.split_whitespace().next() == Some(scene.name));
        assert!(line.is_some_and(|line| line.contains(scene.summary)), "{}: {}", scene.name, run.stdout);
    }
}

#[test]
fn info_tells_what_a_scene_holds() {
    let folder = folder();
    let run = raypacket(folder.path(), "info good.toml").good();
    let primitives = "\nprimitives  2: 1 plane, 1 sphere\n";
    for words in ["good", primitives, "1: red", "sky         color [0, 0, 0]\n", "eye [0, 1, 5]", "\nplan\n  "] {
        assert!(run.stdout.contains(words), "no {words:?} in {}", run.stdout);
    }
    assert!(raypacket(folder.path(), "info").good().stdout.contains("classic"));
    assert!(!run.stdout.contains("textures"), "it has none: {}", run.stdout);
    assert!(run.stdout.contains("\n  shadows     1 stream a wave"), "{}", run.stdout);
    let many: String = (10..23).map(|i| format!("[materials.m{i}]\n")).collect();
    fs::write(folder.path().join("many.toml"), many).unwrap();
    let run = raypacket(folder.path(), "info many.toml").good();
    assert!(run.stdout.contains("\nmaterials   13: m10, m11, m12, "), "{}", run.stdout);
    assert!(run.stdout.contains(", m21 and 1 more\n"), "{}", run.stdout);
    let run = raypacket(folder.path(), "info textures").good();
    assert!(run.stdout.contains("\ntextures    2: 512 x 256, 256 x 256\n"), "{}", run.stdout);
}

#[test]
fn info_tells_what_the_tree_is_like() {
    let folder = folder();
    add_many(folder.path());
    let text = raypacket(folder.path(), "info many.toml").good().stdout;
    let line = |key: &str| text.lines().find_map(|line| line.strip_prefix(key)).unwrap_or_else(|| panic!("{text}"));
    let (tree, build) = (line("  tree "), line("  build "));
    for words in [" nodes with ", " blocks: ", " bytes a primitive, depth ", "SAH cost "] {
        assert!(tree.contains(words), "no {words:?} in {tree}");
    }
    // The number before the words.
    let number = |line: &str, words: &str| -> f64 {
        let before = line.split(words).next().and_then(|before| before.split_whitespace().last());
        before.and_then(|n| n.parse().ok()).unwrap_or_else(|| panic!("no number before {words:?} in {line}"))
    };
    assert!(number(build, " ms with ") >= 0.0);
    let (bytes, each) = (number(build, " bytes"), number(tree, " bytes a primitive"));
    assert!(bytes > 200.0 * 20.0 && (bytes / 201.0 - each).abs() <= 0.5, "{tree}\n{build}");
    let without = raypacket(folder.path(), "info good.toml").good().stdout;
    assert!(!without.contains("\n  tree ") && !without.contains("\n  build "), "{without}");
}

/// Compiling a scene with a tree computes in parallel, and must not start the pool before `--threads` does.
#[test]
fn threads_are_started_before_a_tree_is_built() {
    let folder = folder();
    add_many(folder.path());
    for (threads, words) in [(1, ", 1 thread, "), (3, ", 3 threads, ")] {
        let run = raypacket(folder.path(), &format!("render many.toml --threads {threads} --size 9x5 -o a.png")).good();
        assert!(run.stdout.contains(words), "{}", run.stdout);
    }
    fs::remove_file(folder.path().join("a.png")).unwrap();
    raypacket(folder.path(), "view many.toml --threads 1").failed(1, &["display"]);
    for command in ["render -o a.png", "bench", "view", ""] {
        raypacket(folder.path(), &format!("{command} --threads 2 no.toml")).failed(2, &["no.toml"]);
    }
    raypacket(folder.path(), "render many.toml -o no/a.png --threads 2").failed(2, &["no/a.png"]);
    assert_eq!(names(folder.path()), ["good.toml", "many.toml"]);
}

#[test]
fn help_and_version() {
    let folder = folder();
    assert!(raypacket(folder.path(), "--version").good().stdout.starts_with("raypacket "));
    let help = raypacket(folder.path(), "--help").good().stdout;
    for command in ["view", "render", "bench", "contest", "verify", "chart", "info", "scenes"] {
        assert!(help.lines().any(|line| line.trim_start().starts_with(command)), "no {command} in {help}");
        raypacket(folder.path(), &format!("{command} --help")).good();
    }
}

#[test]
fn without_a_display_the_viewer_names_render() {
    let folder = folder();
    for args in ["", "classic", "view", "view good.toml", "--size 64x32 --kernel x4 --threads 1 good.toml"] {
        raypacket(folder.path(), args).failed(1, &["display", "render"]);
    }
    raypacket(folder.path(), "--frames 2 --screenshot a.png").failed(1, &["display"]);
    assert_eq!(names(folder.path()), ["good.toml"]);
}

/// `raypacket scenes | head -1`, with a head that is gone already.
#[cfg(unix)]
#[test]
fn a_reader_that_has_seen_enough_is_no_error() {
    for args in [&["scenes"][..], &["info"], &["--help"], &["bench", "--size", "8x8", "--json", "-"]] {
        let (reader, writer) = std::io::pipe().unwrap();
        drop(reader);
        let mut command = std::process::Command::new(env!("CARGO_BIN_EXE_raypacket"));
        let run = command.args(args).stdout(writer).stderr(std::process::Stdio::piped()).output().unwrap();
        assert_eq!((run.status.code(), &*String::from_utf8_lossy(&run.stderr)), (Some(0), ""), "{args:?}");
    }
}
