//! Whitted shading in waves: all rays of a tile are traced, shaded and reflected together.
//!
//! A point's light is Σ E (color · n·l + specular · (r·l)^shininess) over the lights it sees, with
//! E = power / (4 π r²), and ambient · color; a mirror of fraction ρ shows (1 − ρ) of that and ρ of what it
//! reflects (Whitted, *An Improved Illumination Model for Shaded Display*, 1980). What a transparent medium reflects and
//! transmits is in [`crate::scene::Material`]; it casts a full shadow, as in Whitted's paper.
//!
//! Where a mesh has vertex normals, shading is that of a curved surface, but shadows are those of flat triangles: a
//! triangle that is turned away from a light is dark where the curved surface would not be, in steps. So lights are seen
//! from a surface that the vertices' tangent planes make ([`crate::geometry::Triangles::smooth`]), and are faced where the
//! interpolated normal faces them.

mod around;
mod interaction;
mod light;
mod medium;
mod path;
mod queue;
mod refract;
mod sky;
mod spawn;
mod surface;
mod surfaces;
mod texture;
mod wave;
mod whitted;

pub use interaction::SurfaceInteraction;
pub use path::{Segment, SegmentKind, path};
#[cfg(feature = "lab")]
pub(crate) use spawn::Offsets;
pub(crate) use surface::facing_normals;
pub use wave::{Observer, Stage};
pub use whitted::{Counts, Workspace, trace_waves};
