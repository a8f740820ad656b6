//! What is left when the program is ended from outside: nothing new, and the old as it was.

use super::{folder, names};
use std::fs;
use std::path::Path;
use std::process::{Child, Command};
use std::thread::sleep;
use std::time::{Duration, Instant};

/// Starts to render a large picture, by a shell that does `first`.
fn start(folder: &Path, first: &str) -> Child {
    let program = env!("CARGO_BIN_EXE_raypacket");
    let script = format!("{first} exec '{program}' render good.toml -o a.exr --size 2048x2048");
    Command::new("sh").args(["-c", &script]).current_dir(folder).stdout(std::process::Stdio::null()).spawn().unwrap()
}

/// Waits until a part of the picture has been written, and says whether it has not ended before.
fn writes(child: &mut Child, folder: &Path) -> bool {
    let since = Instant::now();
    while child.try_wait().unwrap().is_none() {
        assert!(since.elapsed() < Duration::from_secs(300), "it takes too long");
        let begun = |name: &String| {
            let length = fs::metadata(folder.join(name)).map_or(0, |meta| meta.len());
            name.ends_with(".tmp") && length > 0
        };
        if names(folder).iter().any(begun) {
            return true;
        }
        sleep(Duration::from_millis(1));
    }
    false
}

fn send(signal: &str, child: &Child) {
    assert!(Command::new("kill").args([signal, &child.id().to_string()]).status().unwrap().success());
}

#[test]
fn a_signal_leaves_nothing_behind() {
    for (signal, status) in [("-INT", 130), ("-TERM", 143), ("-HUP", 129)] {
        let folder = folder();
        let mut caught = 0;
        // Now and then it is done too soon.
        for _ in 0..10 {
            fs::write(folder.path().join("a.exr"), "old").unwrap();
            let mut child = start(folder.path(), "");
            if writes(&mut child, folder.path()) {
                send(signal, &child);
            }
            let ended = child.wait().unwrap().code();
            assert_eq!(names(folder.path()), ["a.exr", "good.toml"], "{signal}");
            if ended == Some(status) {
                assert_eq!(fs::read(folder.path().join("a.exr")).unwrap(), b"old", "{signal}");
                caught += 1;
                break;
            }
            assert_eq!(ended, Some(0), "{signal}");
        }
        assert_eq!(caught, 1, "{signal}");
    }
}

/// As under `nohup`, or in the background of a script.
#[cfg(target_os = "linux")]
#[test]
fn an_ignored_signal_stays_ignored() {
    let folder = folder();
    let mut child = start(folder.path(), "trap '' HUP INT;");
    if writes(&mut child, folder.path()) {
        send("-HUP", &child);
        send("-INT", &child);
    }
    assert_eq!(child.wait().unwrap().code(), Some(0));
    assert_eq!(names(folder.path()), ["a.exr", "good.toml"]);
}
