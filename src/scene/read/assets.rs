//! Where the files that a scene names come from.

use std::path::{Path, PathBuf};

use super::{error::ReadError, source::bytes_of};

/// The files of the built-in scenes, as the scenes name them.
static BUILTIN: [(&str, &[u8]); 5] = [
    ("meshes/ball.obj", include_bytes!("../../../scenes/meshes/ball.obj")),
    ("meshes/vase.obj", include_bytes!("../../../scenes/meshes/vase.obj")),
    ("textures/brick.png", include_bytes!("../../../scenes/textures/brick.png")),
    ("textures/dusk.hdr", include_bytes!("../../../scenes/textures/dusk.hdr")),
    ("textures/globe.png", include_bytes!("../../../scenes/textures/globe.png")),
];

/// The files that belong to a scene: images and meshes.
#[derive(Clone, Debug)]
pub(in crate::scene) enum Assets {
    /// Beside the scene's file: names are relative to this folder.
    Folder(PathBuf),
    /// Within the program, for the scenes that are.
    Builtin,
}

impl Assets {
    /// Those beside a scene's file.
    pub fn beside(file: &Path) -> Self {
        Self::Folder(file.parent().unwrap_or(Path::new("")).into())
    }

    /// The path by which messages name a file.
    pub fn path(&self, name: &str) -> PathBuf {
        match self {
            Self::Folder(folder) => folder.join(name),
            Self::Builtin => Path::new("scenes").join(name),
        }
    }

    /// The whole of a file that is no longer than `limit`.
    pub fn read(&self, name: &str, limit: u64) -> Result<Vec<u8>, ReadError> {
        let path = self.path(name);
        if let Self::Folder(_) = self {
            return bytes_of(&path, limit);
        }
        match BUILTIN.iter().find(|(known, _)| *known == name) {
            Some((_, bytes)) if bytes.len() as u64 <= limit => Ok(bytes.to_vec()),
            Some(_) => Err(ReadError::too_long(&path, limit)),
            None => Err(ReadError::File { path, problem: "not among the built-in files".into() }),
        }
    }
}
