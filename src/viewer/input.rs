//! From key events to what they ask for.
//!
//! The window library tells which keys are down at the moment of asking, which misses a key that went down and up
//! again in between; here every event counts, so that a short tap is never lost, however slow the frames.

use super::controls::Moves;
use crate::render::Kernel;
use minifb::{InputCallback, Key};
use std::sync::mpsc;

/// The lines that H shows.
pub const HELP: [&str; 9] = [
    "W A S D     move; with shift, faster",
    "Q E         down, up",
    "arrows      turn; or drag the mouse",
    "+ -         field of view",
    "1 4 8       kernel",
    "R           back to the start",
    "P           save the 3D view as PNG",
    "H           these keys",
    "Esc         quit",
];

/// One event of the keyboard.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Event {
    /// A key went down (or repeats), or up.
    Key(Key, bool),
    /// A character was typed, whatever keys that takes on the user's keyboard.
    Character(char),
}

/// Something to do once.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Action {
    /// Trace at another width.
    Kernel(Kernel),
    /// Back to the scene's camera.
    Reset,
    /// Save a picture.
    Save,
    /// Show or hide the keys.
    Help,
    /// End the program.
    Quit,
}

/// Passes the window's events on.
pub struct Listener(pub mpsc::Sender<Event>);

impl InputCallback for Listener {
    fn add_char(&mut self, character: u32) {
        if let Some(character) = char::from_u32(character) {
            self.0.send(Event::Character(character)).ok();
        }
    }

    fn set_key_state(&mut self, key: Key, down: bool) {
        self.0.send(Event::Key(key, down)).ok();
    }
}

/// The keyboard between two looks at it.
#[derive(Clone, Debug, Default)]
pub struct Keys {
    held: Vec<Key>,
    tapped: Vec<Key>,
    typed: Vec<char>,
}

impl Keys {
    /// Takes in what has happened since the last call.
    pub fn update(&mut self, events: impl IntoIterator<Item = Event>) {
        self.tapped.clear();
        self.typed.clear();
        for event in events {
            match event {
                Event::Key(key, true) if !self.held.contains(&key) => {
                    self.held.push(key);
                    self.tapped.push(key);
                }
                Event::Key(_, true) => {} // the keyboard's repetition
                Event::Key(key, false) => self.held.retain(|&held| held != key),
                Event::Character(character) => self.typed.push(character),
            }
        }
    }

    /// Lets go of every key: when the window loses the focus, it is not told of their release.
    pub fn release(&mut self) {
        self.held.clear();
    }

    /// Whether a key is down or was, since the last update.
    fn down(&self, keys: &[Key]) -> bool {
        keys.iter().any(|key| self.held.contains(key) || self.tapped.contains(key))
    }

    /// Where to move.
    pub fn moves(&self) -> Moves {
        let axis = |plus: &[Key], minus: &[Key]| f64::from(self.down(plus)) - f64::from(self.down(minus));
        let widen = axis(&[Key::Equal, Key::NumPadPlus], &[Key::Minus, Key::NumPadMinus]);
        // Where + or − is no key of its own that the window library knows, the character still comes through.
        let typed = f64::from(self.typed.contains(&'+')) - f64::from(self.typed.contains(&'-'));
        Moves {
            forward: axis(&[Key::W], &[Key::S]),
            right: axis(&[Key::D], &[Key::A]),
            up: axis(&[Key::E], &[Key::Q]),
            turn: axis(&[Key::Right], &[Key::Left]),
            tilt: axis(&[Key::Up], &[Key::Down]),
            widen: if widen == 0.0 { typed } else { widen },
            fast: self.down(&[Key::LeftShift, Key::RightShift]),
        }
    }

    /// The actions to take, in the order they were asked for.
    pub fn actions(&self) -> Vec<Action> {
        let keys = self.tapped.iter().filter_map(|key| match key {
            Key::Key1 | Key::NumPad1 => Some(Action::Kernel(Kernel::X1)),
            Key::Key4 | Key::NumPad4 => Some(Action::Kernel(Kernel::X4)),
            Key::Key8 | Key::NumPad8 => Some(Action::Kernel(Kernel::X8)),
            Key::R => Some(Action::Reset),
            Key::P => Some(Action::Save),
            Key::H => Some(Action::Help),
            Key::Escape => Some(Action::Quit),
            _ => None,
        });
        // Digits that need shift arrive as characters only; coming both ways does no harm.
        let characters = self.typed.iter().filter_map(|character| match character {
            '1' => Some(Action::Kernel(Kernel::X1)),
            '4' => Some(Action::Kernel(Kernel::X4)),
            '8' => Some(Action::Kernel(Kernel::X8)),
            _ => None,
        });
        keys.chain(characters).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn after(events: &[Event]) -> Keys {
        let mut keys = Keys::default();
        keys.update(events.iter().copied());
        keys
    }

    #[test]
    fn a_held_key_moves_until_released() {
        let mut keys = after(&[Event::Key(Key::W, true), Event::Key(Key::LeftShift, true)]);
        for _ in 0..3 {
            assert_eq!(keys.moves(), Moves { forward: 1.0, fast: true, ..Moves::default() });
            keys.update([]);
        }
        keys.update([Event::Key(Key::W, false), Event::Key(Key::LeftShift, false)]);
        assert_eq!(keys.moves(), Moves::default());
    }

    #[test]
    fn a_tap_between_two_looks_counts_once() {
        let mut keys = after(&[Event::Key(Key::Left, true), Event::Key(Key::Left, false)]);
        assert_eq!(keys.moves().turn, -1.0);
        keys.update([]);
        assert_eq!(keys.moves(), Moves::default());
    }

    #[test]
    fn a_held_key_acts_once() {
        let mut keys = after(&[Event::Key(Key::P, true), Event::Key(Key::P, true)]);
        assert_eq!(keys.actions(), [Action::Save]);
        keys.update([Event::Key(Key::P, true)]);
        assert_eq!(keys.actions(), []);
        keys.update([Event::Key(Key::P, false), Event::Key(Key::P, true)]);
        assert_eq!(keys.actions(), [Action::Save]);
    }

    #[test]
    fn opposite_keys_cancel_and_focus_loss_releases() {
        let mut keys = after(&[Event::Key(Key::A, true), Event::Key(Key::D, true), Event::Key(Key::E, true)]);
        assert_eq!(keys.moves(), Moves { up: 1.0, ..Moves::default() });
        keys.release();
        keys.update([]);
        assert_eq!(keys.moves(), Moves::default());
    }

    #[test]
    fn characters_stand_in_for_keys() {
        assert_eq!(after(&[Event::Character('+')]).moves().widen, 1.0);
        assert_eq!(after(&[Event::Key(Key::Minus, true), Event::Character('-')]).moves().widen, -1.0);
        assert_eq!(after(&[Event::Character('4')]).actions(), [Action::Kernel(Kernel::X4)]);
    }

    #[test]
    fn every_action_has_its_key() {
        let keys = [Key::Key1, Key::Key4, Key::Key8, Key::R, Key::H, Key::Escape];
        let events: Vec<_> = keys.into_iter().map(|key| Event::Key(key, true)).collect();
        let [x1, x4, x8] = Kernel::ALL.map(Action::Kernel);
        assert_eq!(after(&events).actions(), [x1, x4, x8, Action::Reset, Action::Help, Action::Quit]);
    }
}
