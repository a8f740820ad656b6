//! TODO.
mod isa;

pub use isa::isa;
