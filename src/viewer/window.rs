//! The window's side: shows finished frames, asks for the next one, listens to keys and mouse.

use super::{
    draw::Picture,
    frame::{Frame, Request},
    input::{Action, Listener},
    options::{Options, ViewerError},
    overlay::{Meter, Overlay},
    screenshot,
    session::{Mouse, Session},
};
use crate::scene::Description;
use minifb::{MouseButton, MouseMode, ScaleMode, Window, WindowOptions};
use std::{
    path::Path,
    sync::mpsc::{self, Receiver, RecvTimeoutError, Sender},
    time::{Duration, Instant},
};

/// Input is looked at this often, however long a frame takes.
const POLL: Duration = Duration::from_millis(12);
/// A longer gap, as when the computer slept, does not throw the camera across the scene.
const LONGEST_STEP: Duration = Duration::from_millis(200);

/// The two ends that join the window to the painter: one request is under way at a time, and the frame that it goes
/// with brings memory to paint on.
pub struct Link {
    /// Asks for a frame.
    pub requests: Sender<(Request, Frame)>,
    /// Brings it.
    pub frames: Receiver<Frame>,
}

/// Opens the window and shows frames until the user quits, or `options.frames` have been shown.
pub fn show(description: &Description, options: &Options, link: &Link) -> Result<(), ViewerError> {
    let mut window = open(description, options)?;
    match options.script() {
        Some(frames) => script(&mut window, description, options, link, frames),
        None => interact(&mut window, description, options, link),
    }
}

fn open(description: &Description, options: &Options) -> Result<Window, ViewerError> {
    display_is_named()?;
    // An exactly fitting picture is given each time, so nothing is left to scale for the library.
    let window_options = WindowOptions { resize: true, scale_mode: ScaleMode::UpperLeft, ..WindowOptions::default() };
    // A title cannot hold a NUL.
    let title = format!("raypacket - {}", description.name.replace('\0', " "));
    let mut window = Window::new(&title, options.size.0, options.size.1, window_options)
        .map_err(|error| ViewerError::NoDisplay(error.to_string()))?;
    // The wait for the next frame sets the pace; the library's own would come on top of it.
    window.set_target_fps(0);
    Ok(window)
}

/// Looks before the window libraries do, for a clearer message than theirs.
fn display_is_named() -> Result<(), ViewerError> {
    let named = |name: &str| std::env::var_os(name).is_some_and(|value| !value.is_empty());
    let needed = cfg!(unix) && !cfg!(target_os = "macos");
    let wayland = ["WAYLAND_DISPLAY", "WAYLAND_SOCKET"].into_iter().any(named);
    if !needed || named("DISPLAY") || (cfg!(feature = "wayland") && wayland) {
        return Ok(());
    }
    let reason = match (cfg!(feature = "wayland"), wayland) {
        (true, _) => "neither DISPLAY nor WAYLAND_DISPLAY is set",
        (false, false) => "DISPLAY is not set",
        (false, true) => "DISPLAY is not set: on Wayland, start XWayland or build with `--features wayland`",
    };
    Err(ViewerError::NoDisplay(reason.to_owned()))
}

/// Shows a picture, and has the window take in its events.
fn present(window: &mut Window, picture: &Picture) -> Result<(), ViewerError> {
    if picture.pixels.is_empty() {
        window.update();
        return Ok(());
    }
    let shown = window.update_with_buffer(&picture.pixels, picture.width, picture.height);
    shown.map_err(|error| ViewerError::Window(error.to_string()))
}

/// Shows exactly so many finished frames of the scene's camera at the size asked for, whatever happens to the window,
/// and saves the last one. Nothing in the picture depends on time.
fn script(
    window: &mut Window,
    description: &Description,
    options: &Options,
    link: &Link,
    frames: u64,
) -> Result<(), ViewerError> {
    let mut session = Session::new(description, options.kernel);
    let mut picture = Picture::new(options.size.0, options.size.1);
    let mut frame = Frame::default();
    for _ in 0..frames {
        // A painter that has stopped says why itself.
        if link.requests.send((session.request(options.size), frame)).is_err() {
            return Ok(());
        }
        frame = loop {
            match link.frames.recv_timeout(POLL) {
                Ok(frame) => break frame,
                Err(RecvTimeoutError::Timeout) => present(window, &picture)?,
                Err(RecvTimeoutError::Disconnected) => return Ok(()),
            }
            if !window.is_open() {
                return Err(ViewerError::Closed);
            }
        };
        frame.compose(&mut picture);
        overlay(description, &frame).draw(&mut picture);
        present(window, &picture)?;
    }
    let Some(path) = &options.screenshot else { return Ok(()) };
    Ok(screenshot::save(&picture, path)?)
}

fn overlay<'a>(description: &'a Description, frame: &Frame) -> Overlay<'a> {
    Overlay {
        scene: &description.name,
        kernel: frame.kernel,
        threads: frame.threads,
        counts: (frame.threads > 0).then_some(frame.counts),
        ..Overlay::default()
    }
}

/// Shows frame after frame until the user quits.
fn interact(window: &mut Window, description: &Description, options: &Options, link: &Link) -> Result<(), ViewerError> {
    let mut session = Session::new(description, options.kernel);
    let (listener, events) = mpsc::channel();
    window.set_input_callback(Box::new(Listener(listener)));
    let (mut frame, mut spare) = (Frame { kernel: options.kernel, ..Frame::default() }, Frame::default());
    let (mut picture, mut meter) = (Picture::default(), Meter::default());
    let (mut last_step, mut last_frame, mut active) = (Instant::now(), Instant::now(), false);
    if link.requests.send((session.request(window.get_size()), spare)).is_err() {
        return Ok(());
    }
    while window.is_open() {
        match link.frames.recv_timeout(POLL) {
            Ok(finished) => {
                spare = std::mem::replace(&mut frame, finished);
                // The next frame is traced while this one is shown.
                if link.requests.send((session.request(window.get_size()), spare)).is_err() {
                    return Ok(());
                }
                meter.frame(&frame.counts, frame.tracing, last_frame.elapsed());
                last_frame = Instant::now();
            }
            Err(RecvTimeoutError::Timeout) => {}
            Err(RecvTimeoutError::Disconnected) => return Ok(()),
        }
        let (width, height) = window.get_size();
        picture.resize(width, height);
        picture.fill(0);
        frame.compose(&mut picture);
        let message = session.message();
        let (rates, help) = (meter.rates(), session.help);
        Overlay { rates, message, help, ..overlay(description, &frame) }.draw(&mut picture);
        present(window, &picture)?;

        if std::mem::replace(&mut active, window.is_active()) && !active {
            session.release();
        }
        let seconds = last_step.elapsed().min(LONGEST_STEP).as_secs_f64();
        last_step = Instant::now();
        for action in session.step(events.try_iter(), mouse(window), height, seconds) {
            match action {
                Action::Quit => return Ok(()),
                Action::Save => session.tell(save(&frame.view)),
                _ => {}
            }
        }
    }
    Ok(())
}

fn mouse(window: &Window) -> Mouse {
    Mouse { position: window.get_mouse_pos(MouseMode::Pass), down: window.get_mouse_down(MouseButton::Left) }
}

/// Saves the 3D view in the current folder; gives back what to tell.
fn save(view: &Picture) -> String {
    if view.pixels.is_empty() {
        return "nothing to save yet".to_owned();
    }
    match screenshot::save_numbered(view, Path::new("")) {
        Ok(path) => format!("saved {}", path.display()),
        Err(error) => format!("not saved: {}", error.problem),
    }
}
