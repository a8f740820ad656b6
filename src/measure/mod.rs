//! Measuring: how fast, and how right, in the same run; and [`oracle`], the exact truth that methods are judged by.

pub mod bench;
pub mod oracle;
pub mod rays;
mod streams;
pub mod verify;
