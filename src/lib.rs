//! A CPU ray tracer that traces SIMD packets and checks its answers against a scalar reference.
//!
//! # The way of a ray
//!
//! ```text
//! TOML, NFF, OBJ ──read──▶ Description ──scene::compile──▶ Scene: SoA arrays and a Plan
//!                             │                            │ a tile of 16 × 16 eye rays      render
//!                             │                            ▼
//!                             │                ┌──▶ intersect: the nearest hits              trace
//!                             │                │    occluded: a shadow ray a hit and light   trace
//!                             │     next wave  │           ▼
//!                             │                └─── light; mirrors' and glass's rays, compacted  shade
//!                             │                            ▼
//!                             │                          Film ──▶ window, PNG, EXR           render, viewer
//!                             ▼
//!                reference: the same picture, one ray at a time in f64 ──▶ measure::verify compares
//! ```
//!
//! ```
//! use raypacket::{measure::verify::verify, render::{Camera, Film, Kernel, render}, scene};
//!
//! let description = scene::parse(r#"
//!     camera = { eye = [0, 0, 3], look_at = [0, 0, 0] }
//!     sky.color = [0.1, 0.2, 0.3]
//!     light = [{ position = [0, 0, 3], power = [50.265, 50.265, 50.265] }] # 4 π 2²: an irradiance of 1, 2 away
//!     materials.red.color = [0.8, 0.0, 0.0]
//!     sphere = [{ center = [0, 0, 0], radius = 1, material = "red" }]
//! "#, "red.toml".as_ref())?;
//! let compiled = scene::compile(&description)?;
//! let mut film = Film::new(65, 65);
//! render(&compiled, &Camera::new(&description.camera, 1.0), Kernel::X8, 1, &mut film, &|_| ());
//!
//! assert_eq!(film.pixels[0], [0.1, 0.2, 0.3]); // the corner shows the sky
//! let [r, g, b] = film.pixels[65 * 65 / 2]; // the middle faces the light
//! assert!((r - 0.8).abs() < 1e-4 && g == 0.0 && b == 0.0);
//! assert!(verify(&description, &Kernel::ALL, 65, 65).pass); // and the reference says so too
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # The names
//!
//! What short programs need stands at the root, and where it belongs in the modules as well: a scene from code is a
//! [`Description`] of [`Mesh`]es, [`Sphere`]s and so on, which [`compile()`] makes a [`Scene`]; [`intersect_rays`] and
//! [`occluded_rays`] answer many [`Ray`]s, [`Probe`] one; [`Scene::primitive`] and [`Scene::surface`] tell what a [`Hit`]
//! means; [`Scene::refit`] follows what moves; [`render_into`] makes a picture; [`BoxTree`] finds geometry of other kinds.
//! `docs/library.md` has a short program for each.
//!
//! # The house
//!
//! Imports run downward in this list, and within a folder never in a circle; `tests/house.rs` sees to it.
//! [`reference`](mod@reference) alone stands apart: it may import the [`scene::Description`], what that holds and the list
//! of the kinds, and nothing else.
//!
//! - `portable/`, a package of its own: this program for three levels of x86-64 in one, which runs the one for its CPU
//! - [`viewer`]: the window: 3D view, 2D slice, controls, overlay
//! - [`measure`]: rays a second, and how right they are; the hard cases, the laboratory and its charts
//! - [`render`](mod@render): camera, tiles, film, tone mapping, picture files
//! - [`shade`]: lights, materials, mirrors, glass, textures and sky, in waves
//! - [`trace`]: the two queries over a compiled scene, for a batch of rays, a stream or a slice of them
//! - [`scene`]: what the user wrote, a file a kind of primitive, its readers and rules, the built-in scenes, `compile`,
//!   the plan
//! - [`bvh`]: the acceleration structure: build, layout and refit; [`BoxTree`] over boxes of the caller's own
//! - [`geometry`]: a file a kind of primitive: storage, tests by named [`geometry::methods`], surface
//! - [`math`]: [`Lanes`](math::Lanes) and vectors over them, batches of rays and hits
//! - [`reference`](mod@reference): the scalar tracer that the others are checked against
//! - [`files`]: writing files whole or not at all, and opening those that are read
//! - `kinds`: the list of the kinds of primitive, from which all that is done kind by kind is made
//!
//! # The rules
//!
//! - **Two queries, no more**: [`trace::intersect()`], the nearest hit, and [`trace::occluded()`], any hit. A
//!   primitive states its test once, for both.
//! - **One kernel text for all widths**: generic over [`math::Lanes`]. In one build x1, x4 and x8 give the same bits,
//!   in hits and pictures; so do any number of threads and any order of the tiles.
//! - **The reference shares nothing but the description**, so that no fault of a kernel hides in its own check.
//! - **At equal distance the lowest primitive id wins.** Ids count through the kinds in the order of
//!   [`scene::Scene`]'s fields: planes, spheres, triangles, quads and so on.
//! - **The tree loses no hit.** Where the plan has one ([`bvh`]), answers for rays of finite numbers, none beyond
//!   2⁶⁸, are those of testing everything, to the bit: its boxes are wider than what rounding can do, and hits count
//!   only within a box of the primitive's own, but for spheres, cylinders and cones, whose tests err like a slightly moved ray. On every width
//!   a beam or a ray is tested against eight boxes at a time, or a box against sixteen beams or
//!   rays.
//! - **A kind of primitive is stated once**: a row in `src/kinds.rs`, and a file in each of `scene/kinds`, `geometry`,
//!   `viewer/outline`, `reference` and `measure/oracle`. Where a part is left out, it does not compile. Every kind has
//!   blocks of eight in the tree: one ray is tested against eight primitives, or a packet against each, by one text.
//! - **[`math::Lanes::mul_add`] is fused on every width or on none**: fused in a build with FMA instructions, two
//!   roundings in a build without. So two builds may differ, each within the bounds that
//!   [`measure::verify`] checks.
//! - **One place says where secondary rays start and end**: `shade/spawn.rs`, by a bound on the rounding, not by an
//!   epsilon that somebody chose; fixed ones are there to be compared with. Shadow rays start at the light, or at the
//!   point when the light is too far from something small ([`scene::ShadowStart`]).
#![forbid(unsafe_code)]
#![warn(missing_docs)]

pub use {glam, rayon, wide};

// What short programs need, by short names: `use raypacket::{…}` suffices. All of it is documented where it lives.
pub use bvh::{Aabb, BoxTree};
pub use math::{isa, slower_than_cpu};
pub use render::{Camera, Cancelled, Counts, Film, Kernel, render, render_into, tone_map};
pub use scene::{
    CameraDescription, CompileOptions, Cone, Cuboid, Cylinder, Description, Disc, Dome, Fractal, Invalid, Light,
    Material, Mesh, Pigment, Plan, Plane, Primitive, PrimitiveKind, Quad, RefitError, Scene, Settings, ShadowStart,
    Sides, Sky, Sphere, Structure, Texture, Torus, check, compile, compile_with,
};
pub use shade::SurfaceInteraction;
pub use trace::{
    Hit, Probe, Ray, intersect_one, intersect_rays, occluded_one, occluded_rays, par_intersect_rays, par_occluded_rays,
};

pub mod bvh;
#[cfg(feature = "files")]
pub mod files;
pub mod geometry;
mod kinds;
pub mod math;
#[cfg(feature = "lab")]
pub mod measure;
pub mod reference;
pub mod render;
pub mod scene;
pub mod shade;
pub mod trace;
#[cfg(feature = "viewer")]
pub mod viewer;

/// The examples of the library's page, which are compiled and run as those of this documentation are.
#[cfg(doctest)]
#[doc = include_str!("../docs/library.md")]
struct LibraryPage;
