//! A virtual display, and programs that run on it with keys sent to them and their pixels looked at.
//!
//! Needs `Xvfb` and `xdotool`. Without them tests say so and pass; with RAYPACKET_REQUIRE_DISPLAY set they fail.
#![allow(dead_code, reason = "every window test compiles this, and not all use all of it")]

use std::{
    env,
    ffi::OsStr,
    fs,
    io::{BufRead, BufReader},
    process::{Child, Command, ExitStatus, Stdio},
    thread::sleep,
    time::{Duration, Instant},
};
use tempfile::TempDir;

/// Everything is waited for this long: a slow machine is no fault.
pub const PATIENCE: Duration = Duration::from_secs(60);
pub const SCREEN: (usize, usize) = (1100, 600);
pub const WINDOW: (usize, usize) = (1024, 512);

/// A rectangle of the window: columns and rows.
pub type Region = (std::ops::Range<usize>, std::ops::Range<usize>);

/// A process that does not outlive the test.
pub struct Running(pub Child);

impl Drop for Running {
    fn drop(&mut self) {
        self.0.kill().ok();
        self.0.wait().ok();
    }
}

impl Running {
    pub fn wait(&mut self) -> ExitStatus {
        until("the program's end", || self.0.try_wait().unwrap())
    }

    pub fn is_alive(&mut self) -> bool {
        self.0.try_wait().unwrap().is_none()
    }
}

/// Asks until there is an answer.
pub fn until<T>(what: &str, mut answer: impl FnMut() -> Option<T>) -> T {
    let start = Instant::now();
    loop {
        if let Some(answer) = answer() {
            return answer;
        }
        assert!(start.elapsed() < PATIENCE, "waited in vain for {what}");
        sleep(Duration::from_millis(50));
    }
}

/// A program, told of no display.
pub fn without_display(program: impl AsRef<OsStr>) -> Command {
    let mut command = Command::new(program);
    for name in ["DISPLAY", "WAYLAND_DISPLAY", "WAYLAND_SOCKET"] {
        command.env_remove(name);
    }
    command.stdin(Stdio::null());
    command
}

/// An X server without a screen. It keeps its pixels in a file, which needs no further program to look at.
pub struct Display {
    pub name: String,
    pixels: TempDir,
    _server: Running,
}

impl Display {
    /// None when the programs that it takes are not installed.
    pub fn start() -> Option<Self> {
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

    pub fn xdotool(&self, arguments: &[&str]) -> String {
        let output = Command::new("xdotool").args(arguments).env("DISPLAY", &self.name).output().unwrap();
        String::from_utf8(output.stdout).unwrap()
    }

    /// Waits for a program's window, and has the keys go to it.
    pub fn focus(&self, program: &mut Running, name: &str) -> String {
        let window = until("a window", || {
            assert!(program.is_alive(), "the program ended");
            let found = self.xdotool(&["search", "--onlyvisible", "--name", name]);
            found.lines().next().map(str::to_owned)
        });
        self.xdotool(&["windowfocus", &window]);
        window
    }

    /// A part of the window, which minifb puts in the middle of the screen: 0RGB, row by row.
    pub fn look(&self, region: &Region) -> Vec<u32> {
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
    pub fn changed(&self, region: &Region, before: &[u32], what: &str) -> Vec<u32> {
        self.settled(region, what, |now| now != before)
    }

    pub fn settled(&self, region: &Region, what: &str, good: impl Fn(&[u32]) -> bool) -> Vec<u32> {
        until(what, || {
            let now = self.look(region);
            sleep(Duration::from_millis(300));
            (good(&now) && self.look(region) == now).then_some(now)
        })
    }

    pub fn hold(&self, key: &str, time: Duration) {
        self.xdotool(&["keydown", key]);
        sleep(time);
        self.xdotool(&["keyup", key]);
    }
}

pub fn uniform(pixels: &[u32]) -> bool {
    pixels.iter().all(|pixel| *pixel == pixels[0])
}
