//! The window's state from frame to frame, apart from the window itself: camera, keys, kernel, messages.

use super::{
    controls::Controls,
    frame::Request,
    input::{Action, Event, Keys},
    map::Map,
};
use crate::{render::Kernel, scene::Description};

/// A message stays this many seconds.
const MESSAGE_TIME: f64 = 4.0;

/// The mouse as it is now.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Mouse {
    /// Where, in pixels; None when not known.
    pub position: Option<(f32, f32)>,
    /// Whether the left button is down.
    pub down: bool,
}

/// The state that input changes.
#[derive(Clone, Debug)]
pub struct Session {
    controls: Controls,
    keys: Keys,
    map: Map,
    kernel: Kernel,
    grip: Option<(f32, f32)>,
    message: Option<(String, f64)>,
    /// Whether the keys are shown.
    pub help: bool,
}

impl Session {
    /// Starts at the scene's camera.
    pub fn new(description: &Description, kernel: Kernel) -> Self {
        Self {
            controls: Controls::new(&description.camera),
            keys: Keys::default(),
            map: Map::new(description),
            kernel,
            grip: None,
            message: None,
            help: false,
        }
    }

    /// Takes in what happened in the last `seconds` and moves on by them. Gives back what the session cannot do
    /// itself: [`Action::Save`] and [`Action::Quit`].
    pub fn step(
        &mut self,
        events: impl IntoIterator<Item = Event>,
        mouse: Mouse,
        height: usize,
        seconds: f64,
    ) -> Vec<Action> {
        self.keys.update(events);
        self.controls.step(&self.keys.moves(), seconds);
        self.drag(mouse, height);
        if let Some((_, left)) = &mut self.message {
            *left -= seconds;
        }
        self.message.take_if(|(_, left)| *left <= 0.0);
        let mut actions = self.keys.actions();
        actions.retain(|action| match *action {
            Action::Kernel(kernel) => {
                self.kernel = kernel;
                false
            }
            Action::Reset => {
                self.controls.reset();
                false
            }
            Action::Help => {
                self.help = !self.help;
                false
            }
            Action::Save | Action::Quit => true,
        });
        actions
    }

    fn drag(&mut self, mouse: Mouse, height: usize) {
        let grip = mouse.position.filter(|_| mouse.down);
        if let (Some(from), Some(to)) = (self.grip, grip) {
            let per_height = |pixels: f32| f64::from(pixels) / height.max(1) as f64;
            self.controls.drag(per_height(to.0 - from.0), per_height(to.1 - from.1));
        }
        self.grip = grip;
    }

    /// The window has lost the focus.
    pub fn release(&mut self) {
        self.keys.release();
    }

    /// Shows a message for a while.
    pub fn tell(&mut self, message: String) {
        self.message = Some((message, MESSAGE_TIME));
    }

    /// The message to show.
    pub fn message(&self) -> Option<&str> {
        self.message.as_ref().map(|(text, _)| text.as_str())
    }

    /// The request for the next frame in a window of this size.
    pub fn request(&mut self, size: (usize, usize)) -> Request {
        let camera = self.controls.camera();
        self.map.follow(camera.eye);
        Request { camera, kernel: self.kernel, size, map: self.map }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use minifb::Key;

    fn session() -> Session {
        Session::new(&Description::default(), Kernel::X8)
    }

    fn tap(key: Key) -> [Event; 2] {
        [Event::Key(key, true), Event::Key(key, false)]
    }

    #[test]
    fn a_session_starts_at_the_scene_and_returns_to_it() {
        let mut session = session();
        let start = session.request((9, 9));
        assert_eq!(start.camera, Description::default().camera);
        session.step(tap(Key::W), Mouse::default(), 9, 0.1);
        assert_ne!(session.request((9, 9)).camera, start.camera);
        session.step(tap(Key::R), Mouse::default(), 9, 0.1);
        assert_eq!(session.request((9, 9)), start);
    }

    #[test]
    fn kernels_and_help_are_its_own_and_the_rest_is_handed_back() {
        let mut session = session();
        let events = [Key::Key1, Key::H, Key::P, Key::Escape].into_iter().flat_map(tap);
        assert_eq!(session.step(events, Mouse::default(), 9, 0.01), [Action::Save, Action::Quit]);
        assert!(session.help);
        assert_eq!(session.request((9, 9)).kernel, Kernel::X1);
        session.step(tap(Key::H), Mouse::default(), 9, 0.01);
        assert!(!session.help);
    }

    #[test]
    fn dragging_turns_only_while_the_button_is_down() {
        let mut session = session();
        let start = session.request((9, 9)).camera;
        let at = |x: f32, down: bool| Mouse { position: Some((x, 50.0)), down };
        for mouse in [at(10.0, false), at(90.0, false), at(20.0, true), at(20.0, false), at(70.0, true)] {
            session.step([], mouse, 100, 0.01);
            assert_eq!(session.request((9, 9)).camera, start);
        }
        session.step([], at(80.0, true), 100, 0.01);
        let turned = session.request((9, 9)).camera;
        assert!(turned.look_at.x > start.look_at.x && turned.eye == start.eye);
        session.step([], Mouse { position: None, down: true }, 0, 0.01);
    }

    #[test]
    fn messages_pass() {
        let mut session = session();
        session.tell("saved".to_owned());
        session.step([], Mouse::default(), 9, MESSAGE_TIME / 2.0);
        assert_eq!(session.message(), Some("saved"));
        session.step([], Mouse::default(), 9, MESSAGE_TIME);
        assert_eq!(session.message(), None);
    }
}
