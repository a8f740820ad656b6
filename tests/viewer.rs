//! The window, from outside: the real program on a virtual display, with keys sent to it and its pixels looked at.
//!
//! Needs `Xvfb` and `xdotool`. Without them these tests say so and pass; with RAYPACKET_REQUIRE_DISPLAY set they fail.
#![cfg(target_os = "linux")]

use std::{
    env,
    ffi::OsStr,
    fs,
    io::{BufRead, BufReader, Read},
    path::Path,
    process::{Child, Command, ExitStatus, Stdio},
    thread::sleep,
    time::{Duration, Instant},
};
use tempfile::TempDir;

/// Everything is waited for this long: a slow machine is no fault.
const PATIENCE: Duration = Duration::from_secs(60);
const SCREEN: (usize, usize) = (1100, 600);
const WINDOW: (usize, usize) = (1024, 512);

/// A rectangle of the window: columns and rows.
type Region = (std::ops::Range<usize>, std::ops::Range<usize>);
/// The 3D view below the overlay and above the messages.
const VIEW: Region = (0..512, 280..470);
/// The slice below its legend and above its scale.
const SLICE: Region = (512..1024, 40..470);
/// The overlay's first line, which names the kernel; nothing in it changes with time.
const TITLE: Region = (0..150, 4..24);
/// Where the keys are shown.
const HELP: Region = (0..200, 110..250);

/// A process that does not outlive the test.
struct Running(Child);

impl Drop for Running {
    fn drop(&mut self) {
        self.0.kill().ok();
        self.0.wait().ok();
    }
}

impl Running {
    fn wait(&mut self) -> ExitStatus {
        until("the program's end", || self.0.try_wait().unwrap())
    }

    fn is_alive(&mut self) -> bool {
        self.0.try_wait().unwrap().is_none()
    }
}

/// Asks until there is an answer.
fn until<T>(what: &str, mut answer: impl FnMut() -> Option<T>) -> T {
    let start = Instant::now();
    loop {
        if let Some(answer) = answer() {
            return answer;
        }
        assert!(start.elapsed() < PATIENCE, "waited in vain for {what}");
        sleep(Duration::from_millis(50));
    }
}

/// The program, told of no display.
fn raypacket(arguments: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_raypacket"));
    for name in ["DISPLAY", "WAYLAND_DISPLAY", "WAYLAND_SOCKET"] {
        command.env_remove(name);
    }
    command.args(arguments).stdin(Stdio::null());
    command
}

/// An X server without a screen. It keeps its pixels in a file, which needs no further program to look at.
struct Display {
    name: String,
    pixels: TempDir,
    _server: Running,
}

impl Display {
    /// None when the programs that it takes are not installed.
    fn start() -> Option<Self> {
        let found = |name: &str| env::split_paths(&env::var_os("PATH")?).map(|p| p.join(name)).find(|p| p.is_file());
        for name in ["Xvfb", "xdotool"] {
            if found(name).is_none() {
                assert!(env::var_os("RAYPACKET_REQUIRE_DISPLAY").is_none(), "{name} is not in PATH");
                eprintln!("SKIPPED: {name} is not in PATH, so the window is not tested");
                return None;
            }
        }
        let pixels = tempfile::tempdir().unwrap();
        let mut command = Command::new("Xvfb");
        command.args(["-displayfd", "1", "-screen", "0", &format!("{}x{}x24", SCREEN.0, SCREEN.1)]);
        // Without -noreset the server starts anew, and refuses connections for a moment, whenever its last client goes.
        command.args(["-noreset", "-nolisten", "tcp", "-fbdir"]).arg(pixels.path());
        command.stdin(Stdio::null()).stdout(Stdio::piped()).stderr(Stdio::null());
        let mut server = Running(command.spawn().unwrap());
        let mut number = String::new();
        BufReader::new(server.0.stdout.take().unwrap()).read_line(&mut number).unwrap();
        assert!(!number.trim().is_empty(), "Xvfb did not start");
        Some(Self { name: format!(":{}", number.trim()), pixels, _server: server })
    }

    fn xdotool(&self, arguments: &[&str]) -> String {
        let output = Command::new("xdotool").args(arguments).env("DISPLAY", &self.name).output().unwrap();
        String::from_utf8(output.stdout).unwrap()
    }

    /// A part of the window, which minifb puts in the middle of the screen: 0RGB, row by row.
    fn look(&self, region: &Region) -> Vec<u32> {
        let file = fs::read(self.pixels.path().join("Xvfb_screen0")).unwrap();
        // The file is an X window dump: a header of big-endian words, a palette, rows of little-endian pixels.
        let word = |i: usize| u32::from_be_bytes(file[4 * i..4 * i + 4].try_into().unwrap()) as usize;
        let (header, row_bytes, palette) = (word(0), word(12), word(19));
        assert_eq!((word(4), word(5), word(11)), (SCREEN.0, SCREEN.1, 32));
        let data = &file[header + 12 * palette..];
        let (left, top) = ((SCREEN.0 - WINDOW.0) / 2, (SCREEN.1 - WINDOW.1) / 2);
        let row = |y: usize| {
            let pixel = move |x: usize| (y + top) * row_bytes + 4 * (x + left);
            region.0.clone().map(pixel).map(|i| u32::from_le_bytes(data[i..i + 4].try_into().unwrap()) & 0xFF_FF_FF)
        };
        region.1.clone().flat_map(row).collect()
    }

    /// Waits until a part of the window has come to rest, and differs from what it was before.
    fn changed(&self, region: &Region, before: &[u32], what: &str) -> Vec<u32> {
        self.settled(region, what, |now| now != before)
    }

    fn settled(&self, region: &Region, what: &str, good: impl Fn(&[u32]) -> bool) -> Vec<u32> {
        until(what, || {
            let now = self.look(region);
            sleep(Duration::from_millis(300));
            (good(&now) && self.look(region) == now).then_some(now)
        })
    }

    fn hold(&self, key: &str, time: Duration) {
        self.xdotool(&["keydown", key]);
        sleep(time);
        self.xdotool(&["keyup", key]);
    }
}

fn uniform(pixels: &[u32]) -> bool {
    pixels.iter().all(|pixel| *pixel == pixels[0])
}

/// `raypacket view classic` with its window open, in the focus and showing its first frame.
fn open(display: &Display, folder: &Path) -> (Running, String) {
    let mut command = raypacket(&["view", "classic"]);
    let mut program = Running(command.env("DISPLAY", &display.name).current_dir(folder).spawn().unwrap());
    let window = until("a window", || {
        assert!(program.is_alive(), "the program ended");
        let found = display.xdotool(&["search", "--onlyvisible", "--name", "raypacket"]);
        found.lines().next().map(str::to_owned)
    });
    display.xdotool(&["windowfocus", &window]);
    display.xdotool(&["mousemove", "--window", &window, "300", "300"]);
    display.settled(&VIEW, "the first frame", |now| !uniform(now));
    (program, window)
}

#[test]
fn frames_and_screenshot_end_with_a_picture_of_both_halves() {
    let Some(display) = Display::start() else { return };
    let folder = tempfile::tempdir().unwrap();
    let shoot = |name: &str| {
        let path = folder.path().join(name);
        let mut command = raypacket(&["view", "classic", "--frames", "3", "--screenshot"]);
        let mut program = Running(command.arg(&path).env("DISPLAY", &display.name).spawn().unwrap());
        assert_eq!(program.wait().code(), Some(0));
        image::open(&path).unwrap().to_rgb8()
    };
    let picture = shoot("a.png");
    assert_eq!(picture.dimensions(), (WINDOW.0 as u32, WINDOW.1 as u32));
    for (columns, rows) in [VIEW, SLICE] {
        let first = picture.get_pixel(columns.start as u32, rows.start as u32);
        let differs = |x: usize| rows.clone().any(|y| picture.get_pixel(x as u32, y as u32) != first);
        assert!(columns.clone().any(differs), "{columns:?} shows one colour");
    }
    assert_eq!(shoot("b.png"), picture, "the same command gives the same picture");
    assert_eq!(fs::read_dir(&folder).unwrap().count(), 2, "no temporary file stays");
}

#[test]
fn keys_and_mouse_change_what_is_seen() {
    let Some(display) = Display::start() else { return };
    let folder = tempfile::tempdir().unwrap();
    let (mut program, _) = open(&display, folder.path());
    let (home, home_slice) = (display.look(&VIEW), display.look(&SLICE));
    assert!(!uniform(&home_slice));

    for keys in [&["w", "Left"][..], &["e", "d", "Down"], &["plus"], &["KP_Subtract"]] {
        for key in keys {
            display.hold(key, Duration::from_millis(300));
        }
        display.changed(&VIEW, &home, &format!("a new view after {keys:?}"));
        display.changed(&SLICE, &home_slice, &format!("a new slice after {keys:?}"));
        display.xdotool(&["key", "r"]);
        display.settled(&VIEW, "the view after a reset", |now| now == home);
        display.settled(&SLICE, "the slice after a reset", |now| now == home_slice);
    }

    display.xdotool(&["mousedown", "1"]);
    sleep(Duration::from_millis(200));
    display.xdotool(&["mousemove_relative", "60", "20"]);
    sleep(Duration::from_millis(200));
    display.xdotool(&["mouseup", "1"]);
    display.changed(&VIEW, &home, "a new view after a drag");
    display.xdotool(&["key", "r"]);
    display.settled(&VIEW, "the view after a reset", |now| now == home);

    display.xdotool(&["key", "Escape"]);
    assert_eq!(program.wait().code(), Some(0));
}

#[test]
fn kernels_help_and_saving() {
    let Some(display) = Display::start() else { return };
    let folder = tempfile::tempdir().unwrap();
    let (mut program, _) = open(&display, folder.path());
    let (home, title, no_help) = (display.look(&VIEW), display.look(&TITLE), display.look(&HELP));

    let mut titles = vec![title.clone()];
    for key in ["4", "1"] {
        display.xdotool(&["key", key]);
        titles.push(display.settled(&TITLE, "another kernel", |now| titles.iter().all(|title| now != title)));
        assert!(display.look(&VIEW) == home, "every kernel gives the same picture");
    }
    display.xdotool(&["key", "8"]);
    display.settled(&TITLE, "the first kernel", |now| now == title);

    display.xdotool(&["key", "h"]);
    display.changed(&HELP, &no_help, "the keys");
    display.xdotool(&["key", "h"]);
    display.settled(&HELP, "the keys to go", |now| now == no_help);

    fs::write(folder.path().join("raypacket-001.png"), "mine").unwrap();
    display.xdotool(&["key", "p"]);
    let path = folder.path().join("raypacket-002.png");
    until("a saved picture", || path.is_file().then_some(()));
    let saved = image::open(&path).unwrap().to_rgb8();
    assert_eq!(saved.dimensions(), (WINDOW.0 as u32 / 2, WINDOW.1 as u32));
    let pixel = |(x, y): (usize, usize)| {
        let [r, g, b] = saved.get_pixel(x as u32, y as u32).0;
        u32::from_be_bytes([0, r, g, b])
    };
    let places = VIEW.1.flat_map(|y| VIEW.0.map(move |x| (x, y)));
    assert!(places.map(pixel).eq(home), "what is saved is what is seen");
    assert_eq!(fs::read(folder.path().join("raypacket-001.png")).unwrap(), b"mine");

    // A folder that is gone cannot be written to, not even by root.
    folder.close().unwrap();
    display.xdotool(&["key", "p"]);
    sleep(Duration::from_millis(500));
    assert!(program.is_alive());
    display.xdotool(&["key", "Escape"]);
    assert_eq!(program.wait().code(), Some(0));
}

#[test]
fn any_size_will_do() {
    let Some(display) = Display::start() else { return };
    let folder = tempfile::tempdir().unwrap();
    let (mut program, window) = open(&display, folder.path());
    let home = display.look(&VIEW);
    for (width, height) in [("1", "1"), ("2", "500"), ("333", "77"), ("3000", "40")] {
        display.xdotool(&["windowsize", &window, width, height]);
        sleep(Duration::from_millis(300));
        assert!(program.is_alive(), "{width} x {height}");
    }
    display.xdotool(&["windowsize", &window, "1024", "512"]);
    display.settled(&VIEW, "the first picture at the first size", |now| now == home);
    display.xdotool(&["key", "Escape"]);
    assert_eq!(program.wait().code(), Some(0));
}

#[test]
fn without_a_display_it_names_render_and_fails() {
    let nowhere: [&[(&str, &str)]; 4] =
        [&[], &[("DISPLAY", "")], &[("DISPLAY", ":4242")], &[("DISPLAY", ":4242"), ("WAYLAND_DISPLAY", "nowhere")]];
    for variables in nowhere {
        let mut command = raypacket(&["view", "classic"]);
        command.envs(variables.iter().map(|(name, value)| (OsStr::new(name), OsStr::new(value))));
        let mut program = Running(command.stderr(Stdio::piped()).spawn().unwrap());
        assert_eq!(program.wait().code(), Some(1), "{variables:?}");
        let mut message = String::new();
        program.0.stderr.take().unwrap().read_to_string(&mut message).unwrap();
        assert!(message.contains("no display") && message.contains("raypacket render"), "{message}");
        assert_eq!(message.lines().count(), 1, "{message}");
    }
}
