//! From what the user wrote ([`Description`]) to what is traced ([`Scene`]).
mod compile;
mod description;
mod plan;
pub use compile::{Scene, compile};
pub use description::*;
pub use plan::Plan;

/// Why a description cannot be rendered: the key at fault and what is wrong with it.
#[derive(Debug, thiserror::Error, PartialEq)]
#[error("{key}: {problem}")]
pub struct Invalid {
    /// The key, as the TOML file spells its place: `sphere[3].radius`.
    pub key: String,
    /// What is wrong, with the value.
    pub problem: String,
}

/// Says what is wrong with a description, if anything is.
///
/// # Errors
/// The first fault.
pub fn check(_description: &Description) -> Result<(), Invalid> {
    Ok(())
}
