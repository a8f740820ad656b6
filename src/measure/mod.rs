//! Measuring: how fast, and how right, in the same run.

pub mod bench;
pub mod rays;
mod streams;
pub mod verify;
