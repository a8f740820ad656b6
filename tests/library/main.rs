//! The library as its users meet it: names from the crate's root, rays and pictures in memory of their own.

#[path = "../common/mod.rs"]
mod common;

mod boxes;
mod buffer;
mod construct;
mod primitives;
mod rays;
mod refit;
mod surface;
