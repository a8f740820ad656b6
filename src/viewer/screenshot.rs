//! Pictures saved as PNG files, whole or not at all.

use super::draw::Picture;
use image::{ExtendedColorType, ImageEncoder, codecs::png::PngEncoder};
use std::{
    io::{self, BufWriter, Write},
    path::{Path, PathBuf},
};
use tempfile::NamedTempFile;

/// Saves a picture under a name, over whatever was there.
///
/// # Errors
/// When the picture is empty or the file cannot be written; what was there before is then still there.
pub fn save(picture: &Picture, path: &Path) -> io::Result<()> {
    // Path::parent of a bare name is "", which names no folder.
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
    written(picture, folder)?.persist(path)?;
    Ok(())
}

/// Saves a picture in a folder as the first of raypacket-001.png, raypacket-002.png … that is free; gives its path.
///
/// # Errors
/// When the picture is empty or the folder cannot be written to.
pub fn save_numbered(picture: &Picture, folder: &Path) -> io::Result<PathBuf> {
    let mut file = written(picture, folder)?;
    for number in 1..=u32::MAX {
        let path = folder.join(format!("raypacket-{number:03}.png"));
        match file.persist_noclobber(&path) {
            Ok(_) => return Ok(path),
            Err(taken) if taken.error.kind() == io::ErrorKind::AlreadyExists => file = taken.file,
            Err(failed) => return Err(failed.error),
        }
    }
    Err(io::ErrorKind::AlreadyExists.into())
}

/// A temporary file in the folder that holds the finished PNG.
fn written(picture: &Picture, folder: &Path) -> io::Result<NamedTempFile> {
    if picture.pixels.is_empty() {
        return Err(io::Error::new(io::ErrorKind::InvalidInput, "the picture is empty"));
    }
    let mut builder = tempfile::Builder::new();
    builder.prefix(".raypacket-").suffix(".png");
    // Temporary files are for their owner only; a picture gets what the user's umask says, as any other file.
    #[cfg(unix)]
    builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
    let file = builder.tempfile_in(folder)?;
    let bytes: Vec<u8> = picture.pixels.iter().flat_map(|pixel| pixel.to_be_bytes().into_iter().skip(1)).collect();
    let mut writer = BufWriter::new(&file);
    PngEncoder::new(&mut writer)
        .write_image(&bytes, picture.width as u32, picture.height as u32, ExtendedColorType::Rgb8)
        .map_err(|error| match error {
            image::ImageError::IoError(error) => error,
            other => io::Error::other(other),
        })?;
    writer.flush()?;
    drop(writer);
    Ok(file)
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
