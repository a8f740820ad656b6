//! Pictures saved as PNG files, whole or not at all.

use std::path::{Path, PathBuf};

use super::draw::Picture;
use crate::files::{FileError, Target, write_numbered};
use crate::render::output::{encode_display, write_display};

/// Saves a picture under a name, over whatever was there.
///
/// # Errors
/// When the picture is empty or the file cannot be written; what was there before is then still there.
pub fn save(picture: &Picture, path: &Path) -> Result<(), FileError> {
    write_display(&picture.pixels, picture.width, &Target::new(path)?)
}

/// Saves a picture in a folder as the first of raypacket-001.png, raypacket-002.png … that is free; gives its path.
///
/// # Errors
/// When the picture is empty or the folder cannot be written to.
pub fn save_numbered(picture: &Picture, folder: &Path) -> Result<PathBuf, FileError> {
    let name = |number| format!("raypacket-{number:03}.png");
    write_numbered(folder, name, |to| encode_display(to, &picture.pixels, picture.width))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn picture() -> Picture {
        Picture { width: 2, height: 1, pixels: vec![0x01_02_03, 0xFF_80_00] }
    }

    #[test]
    fn a_png_holds_the_pixels() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.png");
        std::fs::write(&path, "old").unwrap();
        save(&picture(), &path).unwrap();
        assert_eq!(image::open(&path).unwrap().to_rgb8().into_raw(), [1, 2, 3, 255, 128, 0]);
        assert_eq!(std::fs::read_dir(&folder).unwrap().count(), 1);
    }

    #[test]
    fn numbers_count_up_and_nothing_is_overwritten() {
        let folder = tempfile::tempdir().unwrap();
        std::fs::write(folder.path().join("raypacket-002.png"), "mine").unwrap();
        for name in ["raypacket-001.png", "raypacket-003.png", "raypacket-004.png"] {
            assert_eq!(save_numbered(&picture(), folder.path()).unwrap(), folder.path().join(name));
        }
        assert_eq!(std::fs::read(folder.path().join("raypacket-002.png")).unwrap(), b"mine");
        assert_eq!(std::fs::read_dir(&folder).unwrap().count(), 4);
    }

    #[test]
    fn what_cannot_be_written_is_an_error() {
        let folder = tempfile::tempdir().unwrap();
        let missing = folder.path().join("missing");
        assert!(save_numbered(&picture(), &missing).is_err());
        assert!(save(&picture(), &missing.join("a.png")).is_err());
        assert!(save(&Picture::new(0, 3), &folder.path().join("a.png")).is_err());
        assert_eq!(std::fs::read_dir(&folder).unwrap().count(), 0);
    }

    #[cfg(unix)]
    #[test]
    fn others_may_read_it_as_any_file() {
        use std::os::unix::fs::PermissionsExt;
        let folder = tempfile::tempdir().unwrap();
        std::fs::write(folder.path().join("plain"), "").unwrap();
        let saved = save_numbered(&picture(), folder.path()).unwrap();
        let mode = |path: &Path| path.metadata().unwrap().permissions().mode() & 0o777;
        assert_eq!(mode(&saved), mode(&folder.path().join("plain")));
    }
}
