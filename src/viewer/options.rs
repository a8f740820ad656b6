//! How to open the window, and why it may not open.

use crate::files::FileError;
use crate::render::Kernel;
use std::path::PathBuf;

/// The longest side of a window; what window systems count sizes with ends not far above.
pub const MAX_SIDE: usize = 16_384;

/// How to open the window.
#[derive(Clone, Debug, PartialEq)]
pub struct Options {
    /// Width and height at the start; the left half is the 3D view, the right half the slice. 1 to [`MAX_SIDE`].
    pub size: (usize, usize),
    /// The width to trace at first.
    pub kernel: Kernel,
    /// Show so many frames of the scene's camera, each of them finished, and quit; input is ignored.
    pub frames: Option<u64>,
    /// Save the whole window's picture, both halves, as PNG after the last of `frames` (1 if not given). The same
    /// options give the same picture each time: in place of speeds it shows the rays of a frame.
    pub screenshot: Option<PathBuf>,
}

impl Default for Options {
    fn default() -> Self {
        Self { size: (1024, 512), kernel: Kernel::default(), frames: None, screenshot: None }
    }
}

impl Options {
    /// Whether such a window is possible.
    pub(super) fn check(&self) -> Result<(), ViewerError> {
        let (width, height) = self.size;
        let possible = 1..=MAX_SIDE;
        if possible.contains(&width) && possible.contains(&height) {
            Ok(())
        } else {
            Err(ViewerError::Size(width, height))
        }
    }

    /// The number of frames to show before quitting; None to go on until the user quits.
    pub(super) fn script(&self) -> Option<u64> {
        self.frames.or(self.screenshot.as_ref().map(|_| 1)).map(|frames| frames.max(1))
    }
}

/// Why the window could not be opened, or not go on.
#[derive(Debug, thiserror::Error)]
pub enum ViewerError {
    /// There is no display to open a window on; the reason.
    #[error("there is no display to open a window on ({0}); `raypacket render` writes a picture without one")]
    NoDisplay(String),
    /// A side of 0 or beyond [`MAX_SIDE`].
    #[error("a window of {0} x {1} pixels is not possible: each side may be 1 to {MAX_SIDE}")]
    Size(usize, usize),
    /// The window stopped working.
    #[error("the window failed: {0}")]
    Window(String),
    /// The window was closed before all of [`Options::frames`] were shown.
    #[error("the window was closed before the last frame")]
    Closed,
    /// The screenshot could not be written.
    #[error(transparent)]
    Screenshot(#[from] FileError),
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn impossible_sizes_are_errors() {
        for size in [(0, 512), (512, 0), (MAX_SIDE + 1, 1), (1, usize::MAX)] {
            let options = Options { size, ..Options::default() };
            assert!(matches!(options.check(), Err(ViewerError::Size(..))), "{size:?}");
        }
        assert!(Options::default().check().is_ok());
    }

    #[test]
    fn the_message_names_render() {
        assert!(ViewerError::NoDisplay("reason".to_owned()).to_string().contains("`raypacket render`"));
    }

    #[test]
    fn a_screenshot_alone_is_of_one_frame() {
        let options = Options { screenshot: Some("a.png".into()), ..Options::default() };
        assert_eq!(options.script(), Some(1));
        assert_eq!(Options { frames: Some(3), ..options }.script(), Some(3));
        assert_eq!(Options::default().script(), None);
    }
}
