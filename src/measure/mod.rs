//! Measuring: how fast, and how right, in the same run; [`cases`], what is hard to get right, and [`oracle`], the exact truth
//! that methods are judged by.

pub mod bench;
pub mod cases;
pub mod oracle;
pub mod random;
pub mod rays;
mod streams;
pub mod verify;
