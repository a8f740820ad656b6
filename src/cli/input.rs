//! Scenes by name or path.

use super::Failure;
use raypacket::scene::{self, Description, Scene};

/// Reads a scene; the reader's message names file, line and key.
pub fn load(name: &str) -> Result<Description, Failure> {
    scene::load(name).map_err(Failure::input)
}

/// Reads all scenes, so that a fault in the last shows before work starts on the first.
pub fn load_all(names: &[String]) -> Result<Vec<Description>, Failure> {
    names.iter().map(|name| load(name)).collect()
}

/// Compiles what [`load`] read from `name`.
pub fn compile(name: &str, description: &Description) -> Result<Scene, Failure> {
    scene::compile(description).map_err(|e| Failure::input(format!("{name}: {e}")))
}

/// Says whether what [`load`] read from `name` could be compiled.
pub fn check(name: &str, description: &Description) -> Result<(), Failure> {
    scene::check(description).map_err(|e| Failure::input(format!("{name}: {e}")))
}
