//! From what the user wrote ([`Description`]) to what is traced ([`Scene`]).
mod description;
pub use description::*;

/// A compiled scene: SoA arrays, ready to trace.
#[derive(Debug)]
pub struct Scene {}

/// Why a description cannot be rendered: the key at fault and what is wrong with it.
#[derive(Debug, thiserror::Error, PartialEq)]
#[error("{key}: {problem}")]
pub struct Invalid {
    /// The key, as the TOML file spells its place: `sphere[3].radius`.
    pub key: String,
    /// What is wrong, with the value.
    pub problem: String,
}

/// Compiles a description into SoA arrays.
///
/// # Errors
/// [`Invalid`] when [`check`] finds fault with it.
pub fn compile(description: &Description) -> Result<Scene, Invalid> {
    check(description)?;
    todo!()
}

/// Says what is wrong with a description, if anything is.
///
/// # Errors
/// The first fault.
pub fn check(_description: &Description) -> Result<(), Invalid> {
    todo!()
}
