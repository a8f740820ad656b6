//! The window, from outside: the real program on a virtual display, with keys sent to it and its pixels looked at.
//!
//! Needs `Xvfb` and `xdotool`. Without them these tests say so and pass; with RAYPACKET_REQUIRE_DISPLAY set they fail.
#![cfg(target_os = "linux")]

#[path = "common/display.rs"]
mod display;

use display::{Display, Region, Running, WINDOW, uniform, until, without_display};
use std::{
    ffi::OsStr,
    fs,
    io::Read,
    path::Path,
    process::{Command, Stdio},
    thread::sleep,
    time::Duration,
};

/// The 3D view below the overlay and above the messages.
const VIEW: Region = (0..512, 280..470);
/// The slice below its legend and above its scale.
const SLICE: Region = (512..1024, 40..470);
/// The overlay's first line, which names the kernel; nothing in it changes with time.
const TITLE: Region = (0..150, 4..24);
/// Where the keys are shown.
const HELP: Region = (0..200, 110..250);

/// The program, told of no display.
fn raypacket(arguments: &[&str]) -> Command {
    let mut command = without_display(env!("CARGO_BIN_EXE_raypacket"));
    command.args(arguments);
    command
}

/// `raypacket view classic` with its window open, in the focus and showing its first frame.
fn open(display: &Display, folder: &Path) -> (Running, String) {
    let mut command = raypacket(&["view", "classic"]);
    let mut program = Running(command.env("DISPLAY", &display.name).current_dir(folder).spawn().unwrap());
    let window = display.focus(&mut program, "raypacket");
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
