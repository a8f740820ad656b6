//! Measuring: how fast, and how right, in the same run; [`cases`], what is hard to get right, [`oracle`], the exact truth
//! that methods are judged by, [`lab`], which judges them, and [`chart`], which draws it.

pub mod against;
mod answers;
pub mod bench;
pub mod cases;
pub mod chart;
pub mod contest;
pub mod lab;
pub mod oracle;
mod plain;
pub mod random;
pub mod rays;
pub mod stages;
pub mod stamp;
pub mod streams;
pub mod turns;
pub mod verify;
