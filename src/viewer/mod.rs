//! TODO.
/// STUB.
pub struct Options {
    /// STUB.
    pub size: (usize, usize),
    /// STUB.
    pub kernel: crate::render::Kernel,
    /// STUB.
    pub frames: Option<u64>,
    /// STUB.
    pub screenshot: Option<std::path::PathBuf>,
}
/// STUB.
#[derive(Debug, thiserror::Error)]
pub enum ViewerError {
    /// STUB.
    #[error("there is no display; `raypacket render`")]
    NoDisplay,
    /// STUB.
    #[error("{0} x {1}")]
    Size(usize, usize),
}
/// STUB.
///
/// # Errors
/// STUB.
pub fn run(_d: &crate::scene::Description, _s: &crate::scene::Scene, _o: &Options) -> Result<(), ViewerError> {
    Err(ViewerError::NoDisplay)
}
