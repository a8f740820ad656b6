//! The mathematics of a packet: [`Lanes`] (1, 4, 8 or 16 numbers at once), [`Vec3`] over them, rays and hits in
//! structure-of-arrays batches, and a few scalar functions with stated errors.

pub mod angle;
mod batch;
mod isa;
mod lanes;
mod power;
pub mod roots;
mod srgb;
mod vec3;

pub use batch::{BATCH, Blocked, HitBatch, NONE, RayBatch};
pub use isa::{cpu_isa, isa, slower_than_cpu};
pub use lanes::{LaneMask, Lanes, MAX_LANES};
pub use power::{exp2, powf};
pub use srgb::linear_of_bytes;
pub use vec3::{Vec3, inverse_root};

/// [`array::map`] of two, always inlined: the library's own is a call where the numbers are wide or a crate is compiled
/// in several units.
#[inline(always)]
pub(crate) fn map2<T, U>([a, b]: [T; 2], mut of: impl FnMut(T) -> U) -> [U; 2] {
    [of(a), of(b)]
}

/// [`map2`] of three.
#[inline(always)]
pub(crate) fn map3<T, U>([a, b, c]: [T; 3], mut of: impl FnMut(T) -> U) -> [U; 3] {
    [of(a), of(b), of(c)]
}
