//! From what the user wrote ([`Description`]) to what is traced ([`Scene`]).
mod builtin;
mod check;
mod description;
mod read;
pub use builtin::*;
pub use check::check;
pub use description::*;
pub use read::*;

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
