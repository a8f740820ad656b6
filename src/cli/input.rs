//! Scenes by name or path.

use super::failure::Failure;
use super::progress::{Progress, Spinner};
use raypacket::geometry::methods::Choice;
use raypacket::scene::{self, Description, Scene};

/// Mesh files from this length on get a bar.
const LONG: u64 = 10 << 20;

/// Reads a scene; the reader's message names file, line and key.
pub fn load(name: &str) -> Result<Description, Failure> {
    let mut bar = None;
    let mut progress = |done: u64, total: u64| {
        if done == 0 {
            bar = (total >= LONG).then(Progress::new);
        } else if let Some(bar) = &bar {
            bar.set((done as f64 / total as f64) as f32);
        }
    };
    scene::load_with_progress(name, &mut progress).map_err(Failure::input)
}

/// Reads all scenes, so that a fault in the last shows before work starts on the first.
pub fn load_all(names: &[String]) -> Result<Vec<Description>, Failure> {
    names.iter().map(|name| load(name)).collect()
}

/// Scenes of more primitives than this may take a second to build a tree of.
const MANY: usize = 500_000;

/// Compiles what [`load`] read from `name`, with methods that were asked for.
pub fn compile(name: &str, description: &Description, choices: &[Choice]) -> Result<Scene, Failure> {
    let primitives = description.primitives() - description.planes.len();
    let _spinner = (primitives > MANY).then(|| Spinner::new(format!("building the tree of {primitives} primitives")));
    scene::compile_with(description, &choices.into()).map_err(|e| Failure::input(format!("{name}: {e}")))
}

/// Says whether what [`load`] read from `name` could be compiled.
pub fn check(name: &str, description: &Description) -> Result<(), Failure> {
    scene::check(description).map_err(|e| Failure::input(format!("{name}: {e}")))
}
