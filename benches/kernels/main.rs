//! Each kind of primitive by itself, by width: its test alone ([`methods`]), and both queries on a scene of it
//! ([`queries`]).
//!
//! A scene is 16 primitives of one kind ([`kinds`]), or 10,000 in a tree; the rays are 256 from one point outside
//! ([`beams`]). All of the former is in the first-level cache.
//!
//! This prints the medians in nanoseconds, a line for x1, x4 and x8; a filter may follow `--quiet`:
//!
//! ```sh
//! cargo bench --bench kernels -- --quiet | awk '$1 ~ "/" { id = $1 } { for (i = 1; i < NF; i++) if ($i == "time:") {
//!     t = $(i + 3) * ($(i + 4) == "ps" ? 0.001 : $(i + 4) == "ns" ? 1 : 1000)
//!     n = split(id, part, "/"); name = substr(id, 1, length(id) - length(part[n]) - 1)
//!     if (part[n] == "x1") printf "%-34s", name
//!     printf "%9.2f%s", t, part[n] == "x8" ? "\n" : "" } }'
//! ```

mod beams;
#[path = "../common/mod.rs"]
mod common;
mod kinds;
mod methods;
mod queries;
#[path = "../../tests/common/mod.rs"]
mod scenes;

use criterion::{criterion_group, criterion_main};

criterion_group! { name = benches; config = common::short(); targets = methods::all, queries::all }
criterion_main!(benches);
