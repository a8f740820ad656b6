//! Folders that a command writes several files to.

use super::failure::Failure;
use std::fs;
use std::path::Path;

/// Makes the folder when it is not there.
pub fn make(folder: &Path) -> Result<(), Failure> {
    if !folder.exists() {
        fs::create_dir(folder).map_err(|e| Failure::input(format!("{}: cannot be made: {e}", folder.display())))?;
    } else if !folder.is_dir() {
        return Err(Failure::input(format!("{}: is a file, not a folder", folder.display())));
    }
    Ok(())
}
