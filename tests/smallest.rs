//! The smallest ray tracer, from outside: `examples/smallest.rs` on a virtual display.
//!
//! Needs `Xvfb` and `xdotool`. Without them these tests say so and pass; with RAYPACKET_REQUIRE_DISPLAY set they fail.
#![cfg(target_os = "linux")]

#[path = "common/display.rs"]
mod display;

use display::{Display, Region, Running, uniform, without_display};
use std::{collections::HashSet, env, process::Command, time::Duration};

const VIEW: Region = (0..512, 0..512);
const SLICE: Region = (512..1024, 0..512);

/// The example, told of no display. Cargo builds examples before it runs tests, and puts them beside the folder of the
/// test programs; a test asked for alone, as in `cargo test --test smallest`, finds it once it has been built.
fn smallest(arguments: &[&str]) -> Command {
    let test = env::current_exe().unwrap();
    let program = test.ancestors().nth(2).unwrap().join("examples/smallest");
    assert!(program.is_file(), "{} is not there: run `cargo build --example smallest`", program.display());
    let mut command = without_display(program);
    command.args(arguments);
    command
}

#[test]
fn it_closes_after_the_frames_asked_for_and_prints_nothing() {
    let Some(display) = Display::start() else { return };
    let output = smallest(&["3"]).env("DISPLAY", &display.name).output().unwrap();
    assert_eq!(output.status.code(), Some(0));
    assert_eq!((output.stdout, output.stderr), (vec![], vec![]));
}

#[test]
fn it_draws_both_views_and_obeys_the_keys() {
    let Some(display) = Display::start() else { return };
    let mut program = Running(smallest(&[]).env("DISPLAY", &display.name).spawn().unwrap());
    display.focus(&mut program, "smallest");
    let mut view = display.settled(&VIEW, "the first frame", |now| !uniform(now));
    let mut slice = display.look(&SLICE);

    // A shaded picture has many colours; the slice one for each kind of line, and the ground.
    let colors = |pixels: &[u32]| pixels.iter().copied().collect::<HashSet<_>>();
    assert!(colors(&view).len() > 1000);
    assert_eq!(colors(&slice).len(), 7, "{:06x?}", colors(&slice));

    for key in ["w", "s", "a", "d", "q", "e", "Left", "Right", "Up", "Down", "equal", "minus", "KP_Add", "KP_Subtract"]
    {
        display.hold(key, Duration::from_millis(200));
        view = display.changed(&VIEW, &view, &format!("a new view after {key}"));
        // One frame shows both.
        let before = std::mem::replace(&mut slice, display.look(&SLICE));
        assert!(slice != before, "the same slice after {key}");
    }
    display.xdotool(&["keydown", "Escape"]);
    assert_eq!(program.wait().code(), Some(0));
}

#[test]
fn without_a_display_it_says_so_in_one_line_and_fails() {
    for variables in [&[][..], &[("DISPLAY", "")], &[("DISPLAY", ":4242"), ("WAYLAND_DISPLAY", "nowhere")]] {
        let output = smallest(&["3"]).envs(variables.iter().copied()).output().unwrap();
        let message = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(1), "{variables:?}: {message}");
        assert!(message.contains("no display") && message.lines().count() == 1, "{message}");
        assert!(output.stdout.is_empty());
    }
}
