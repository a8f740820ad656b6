//! A CPU ray tracer that traces SIMD packets and proves its answers against a scalar reference.
#![forbid(unsafe_code)]
#![warn(missing_docs)]

pub mod files;
pub mod geometry;
pub mod math;
pub mod measure;
pub mod reference;
pub mod render;
pub mod scene;
pub mod shade;
pub mod trace;
pub mod viewer;
