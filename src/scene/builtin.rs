//! The scenes that come with the program; their TOML files are in `scenes/`, to copy and edit.

use std::path::Path;

use super::read::{Assets, parse_with};
use super::{Description, Progress, ReadError, read_nff, read_obj, read_with_progress};

/// A scene that comes with the program.
#[derive(Clone, Copy, Debug)]
pub struct Builtin {
    /// Its name.
    pub name: &'static str,
    /// A line about what it shows.
    pub summary: &'static str,
    /// Its TOML text.
    pub source: &'static str,
}

macro_rules! builtin {
    ($name:literal, $summary:literal) => {
        Builtin { name: $name, summary: $summary, source: include_str!(concat!("../../scenes/", $name, ".toml")) }
    };
}

static BUILTINS: [Builtin; 11] = [
    builtin!("classic", "mirrors and coloured spheres on a checkerboard, under two coloured lights"),
    builtin!("flake", "a sphereflake: 7,381 partly mirrored spheres on a floor"),
    builtin!("hall", "spheres between two facing mirrors, twelve reflections deep"),
    builtin!("cosmos", "radii and distances from 1e-3 to 1e6: pebbles, planets and moons"),
    builtin!(
        "primitives",
        "every primitive but the disc: plane, sphere, triangle, quad, box, cylinder, cone, torus, fractal"
    ),
    builtin!("glass", "refraction and absorption: clear and coloured bodies, a vial of water, bubbles"),
    builtin!("textures", "images and checkerboards on every primitive but the disc"),
    builtin!("sky", "a panorama all around, seen directly, in mirrors and through glass"),
    builtin!("sponge", "a Menger sponge of four iterations"),
    builtin!("lattice", "a diamond crystal of 265 spheres and 460 cylinders over a mirror"),
    builtin!("vase", "coarse meshes that are shaded smoothly: a vase, and balls of clay, silver and glass"),
];

/// The built-in scenes.
pub fn builtins() -> &'static [Builtin] {
    &BUILTINS
}

/// Reads a scene by the path of its file or by its built-in name.
///
/// Text with an extension, or that leads to a file, is a path; anything else is a name.
///
/// # Errors
/// [`ReadError`] for a name that is not known, a format that is not supported, or a faulty file.
pub fn load(name_or_path: &str) -> Result<Description, ReadError> {
    load_with_progress(name_or_path, &mut |_, _| ())
}

/// As [`load`], telling how far each mesh file is.
///
/// # Errors
/// As [`load`].
pub fn load_with_progress(name_or_path: &str, progress: Progress<'_>) -> Result<Description, ReadError> {
    let path = Path::new(name_or_path);
    let extension = path.extension().map(|e| e.to_string_lossy().to_lowercase());
    match extension.as_deref() {
        Some("toml") => read_with_progress(path, progress),
        Some("obj") => read_obj(path, progress),
        Some("nff") => read_nff(path, progress),
        Some(_) if path.is_file() => {
            Err(ReadError::File { path: path.into(), problem: "a scene is a .toml, .nff or .obj file".into() })
        }
        None if path.is_file() => read_with_progress(path, progress),
        _ => match BUILTINS.iter().find(|builtin| builtin.name == name_or_path) {
            Some(builtin) => {
                let file = format!("scenes/{}.toml", builtin.name);
                parse_with(builtin.source, Path::new(&file), &Assets::Builtin, progress)
            }
            // What is there and no regular file: the reader says so.
            None if path.exists() => read_with_progress(path, progress),
            None => {
                Err(ReadError::Unknown { name: name_or_path.into(), builtins: BUILTINS.map(|b| b.name).join(", ") })
            }
        },
    }
}

#[cfg(test)]
#[path = "builtin_tests.rs"]
mod tests;
