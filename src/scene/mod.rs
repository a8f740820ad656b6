//! From what the user wrote ([`Description`]) to what is traced ([`Scene`]).
#[cfg(feature = "files")]
mod builtin;
mod check;
mod choose;
mod compile;
mod construct;
mod corners;
mod description;
mod in_tree;
mod kinds;
mod media;
mod plan;
mod poles;
mod primitive;
#[cfg(feature = "files")]
mod read;
mod refit;
mod rules;

#[cfg(feature = "files")]
pub use builtin::*;
pub use check::check;
pub(crate) use compile::with_primitive;
pub use compile::{CompileOptions, First, Scene, compile, compile_with};
pub use description::*;
pub use kinds::*;
pub use media::Medium;
pub use plan::{Plan, ShadowStart, Structure, Tested};
pub(crate) use poles::texels;
pub use primitive::{Primitive, PrimitiveKind};
#[cfg(feature = "files")]
pub use read::*;
pub use refit::RefitError;

/// Why a description cannot be rendered: the key at fault and what is wrong with it.
#[derive(Debug, thiserror::Error, PartialEq)]
#[error("{key}: {problem}")]
#[non_exhaustive]
pub struct Invalid {
    /// The key, as the TOML file spells its place: `sphere[3].radius`.
    pub key: String,
    /// The problem, with the value.
    pub problem: String,
}
