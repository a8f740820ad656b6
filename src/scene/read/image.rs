//! Pictures for surfaces and for the sky.

use std::{
    path::{Path, PathBuf},
    sync::Arc,
};

use super::ReadError;
use crate::scene::Texture;

/// The textures of a scene, each file read once.
pub(super) struct Textures {
    folder: PathBuf,
    files: Vec<PathBuf>,
    /// By index.
    pub images: Vec<Arc<Texture>>,
}

impl Textures {
    /// For files named relative to `folder`.
    pub fn new(folder: &Path) -> Self {
        Self { folder: folder.into(), files: Vec::new(), images: Vec::new() }
    }

    /// The index of a file's texture.
    pub fn load(&mut self, file: &str) -> Result<usize, ReadError> {
        self.load_at(self.folder.join(file))
    }

    /// The same for a file by its whole path.
    pub fn load_at(&mut self, path: PathBuf) -> Result<usize, ReadError> {
        if let Some(index) = self.files.iter().position(|known| *known == path) {
            return Ok(index);
        }
        self.images.push(texture(&path)?.into());
        self.files.push(path);
        Ok(self.images.len() - 1)
    }
}

fn texture(path: &Path) -> Result<Texture, ReadError> {
    Err(ReadError::File { path: path.into(), problem: "textures are not supported yet".into() })
}

/// Width, height and texels of an equirectangular panorama.
pub(super) fn panorama(path: &Path) -> Result<(usize, usize, Vec<[f32; 3]>), ReadError> {
    Err(ReadError::File { path: path.into(), problem: "panoramas are not supported yet".into() })
}
