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
#[error("no display; try raypacket render")]
pub struct ViewerError;
/// STUB.
///
/// # Errors
/// STUB.
pub fn run(_d: &crate::scene::Description, _s: &crate::scene::Scene, _o: &Options) -> Result<(), ViewerError> {
    Err(ViewerError)
}
