//! The scene as the user wrote it: plain data, before anything is compiled.
//!
//! Every number is the `f32` that was read, and counts as exact: the packet tracer and the `f64`
//! reference both start from these same values. Lengths are in world units, light power in watts,
//! colours are linear RGB, angles are degrees.

use std::sync::Arc;

use glam::Vec3;

pub use crate::geometry::Sides;
use crate::kinds::for_each_kind;

/// The description, with a list of each kind of primitive.
macro_rules! description {
    ($($group:ident { $(($storage:ident: $Storage:ident, $field:ident: $Kind:ident, $module:ident))* })*) => {
        /// A whole scene. Made by a reader, a built-in, or by hand; [`crate::scene::check`] says whether it is sound.
        ///
        /// Primitive ids count through the kinds in the order of the fields, from planes to discs; those of the
        /// meshes through the triangles of all meshes.
        #[derive(Clone, Debug, Default, PartialEq)]
        pub struct Description {
            /// A short name for messages: the built-in's name or the file's stem.
            pub name: String,
            /// Where the scene is looked at from.
            pub camera: CameraDescription,
            /// Depth, light fall-off, ambient light.
            pub settings: Settings,
            /// The radiance along rays that hit nothing.
            pub sky: Sky,
            /// Point lights.
            pub lights: Vec<Light>,
            /// Materials; primitives refer to them by index.
            pub materials: Vec<Material>,
            /// Texture images; materials refer to them by index.
            pub textures: Vec<Arc<Texture>>,
            $($(
                #[doc = concat!("Each a [`", stringify!($Kind), "`](crate::scene::", stringify!($Kind), ").")]
                pub $field: Vec<crate::scene::$Kind>,
            )*)*
        }
    };
}
for_each_kind! { description }

/// The lecture's camera: eye E, view direction V towards `look_at`, field of view through the screen's distance d.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CameraDescription {
    /// The eye E.
    pub eye: Vec3,
    /// A point straight ahead; V = normalize(look_at − eye).
    pub look_at: Vec3,
    /// Roughly upward; need not be perpendicular to V, and may even be parallel to it.
    pub up: Vec3,
    /// Vertical field of view in degrees, above 0 and below 180; d = 1 / tan(fov / 2).
    pub fov: f32,
}

impl Default for CameraDescription {
    fn default() -> Self {
        Self { eye: Vec3::new(0.0, 1.0, 5.0), look_at: Vec3::new(0.0, 1.0, 0.0), up: Vec3::Y, fov: 60.0 }
    }
}

/// In a scene where anything transmits, rays that count for less than this in their pixel are not followed: 2⁻¹⁴, a
/// fifth of a displayed step in black.
pub const MIN_WEIGHT: f32 = 1.0 / 16384.0;

/// Settings that concern the scene as a whole.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Settings {
    /// The number of segments a path may have; the eye ray is 1. 1 to 64.
    pub max_depth: u32,
    /// Whether irradiance falls off as power / (4 π r²); otherwise it is the power at any distance.
    pub attenuation: bool,
    /// Light that reaches every point from everywhere, as irradiance.
    pub ambient: Vec3,
    /// How far a silhouette may be off for a cheaper method's sake, in pixels of a picture of 512 rows; not below 0. So
    /// much of a pixel may change where it is averaged over; where it is one ray, the whole of it. So by default it is 0:
    /// no pixel changes, and no shadow is wrong.
    pub tolerance: f32,
}

impl Default for Settings {
    fn default() -> Self {
        Self { max_depth: 6, attenuation: true, ambient: Vec3::ZERO, tolerance: 0.0 }
    }
}

/// The radiance along rays that hit nothing, by direction.
#[derive(Clone, Debug, PartialEq)]
pub enum Sky {
    /// One radiance for every direction.
    Color(Vec3),
    /// From one below to one above: (1 − s) below + s above with s = (d.y + 1) / 2 for the unit direction d.
    Gradient {
        /// Straight down.
        below: Vec3,
        /// Straight up.
        above: Vec3,
    },
    /// An image all around.
    Dome(Arc<Dome>),
}

impl Default for Sky {
    /// Black.
    fn default() -> Self {
        Self::Color(Vec3::ZERO)
    }
}

/// An equirectangular panorama in linear radiance.
///
/// Direction d sees column u·width, u = ½ + (atan2(d.x, −d.z) + rotation) / 2π (repeating), and row v·height,
/// v = acos(d.y) / π: −z is in the middle, +x to its right, +y at the top. Bilinear between texel centres; across the
/// poles the border row counts on.
#[derive(Clone, Debug, PartialEq)]
pub struct Dome {
    /// Pixels across, at least 1.
    pub width: usize,
    /// Pixels down, at least 1.
    pub height: usize,
    /// Linear RGB, row by row from the top; `width` × `height` of them.
    pub texels: Vec<[f32; 3]>,
    /// Degrees; turns what is seen to the left.
    pub rotation: f32,
}

/// An image for surfaces, with 8 bits a channel on the sRGB curve.
///
/// At (u, v): column u·width, row (1 − v)·height, so that v runs upward; bilinear between texel
/// centres, in linear light. [`Wrap`] says what is beyond its borders.
#[derive(Clone, Debug, PartialEq)]
pub struct Texture {
    /// Pixels across, at least 1.
    pub width: usize,
    /// Pixels down, at least 1.
    pub height: usize,
    /// sRGB, row by row from the top; `width` × `height` of them.
    pub texels: Vec<[u8; 3]>,
}

/// A point light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Light {
    /// Where it is.
    pub position: Vec3,
    /// Power by colour channel, watts.
    pub power: Vec3,
}

/// How a surface answers light.
///
/// At a hit the ray sees own · (its own shading) + mirror · (what it reflects) + refracted · (what is seen through it):
///
/// | | own | mirror | refracted |
/// |---|---|---|---|
/// | in general | 1 − ρ − τ | ρ + τ F | τ (1 − F) |
/// | [`Material::additive`] | 1 | ρ | τ |
///
/// with ρ = `reflectance`, τ = `transmission` and F the Fresnel reflectance of an unpolarised ray at a dielectric. Where
/// a ray is reflected totally, F = 1, and an additive material reflects τ as well.
#[derive(Clone, Debug, PartialEq)]
pub struct Material {
    /// The name the scene file gives it.
    pub name: String,
    /// Diffuse colour, or where it comes from.
    pub pigment: Pigment,
    /// Mirror fraction ρ, 0 to 1.
    pub reflectance: f32,
    /// Transmitted fraction τ, 0 to 1; ρ + τ is at most 1 unless the material is additive. Such a surface bounds a
    /// body: its front, where the normal points, is outside.
    pub transmission: f32,
    /// Index of refraction of the body, 0.1 to 10; 1 where the ray goes straight on.
    pub ior: f32,
    /// Absorption σ of the body by channel: what travels s through it is multiplied by e^(−σ s) (Beer and Lambert).
    pub absorption: Vec3,
    /// Constant fractions that add up as they may, as in NFF.
    pub additive: bool,
    /// Strength of the Phong highlight, 0 for none.
    pub specular: f32,
    /// Phong exponent, above 0.
    pub shininess: f32,
}

impl Default for Material {
    fn default() -> Self {
        Self {
            name: "default".into(),
            pigment: Pigment::Color(Vec3::splat(0.8)),
            reflectance: 0.0,
            transmission: 0.0,
            ior: 1.5,
            absorption: Vec3::ZERO,
            additive: false,
            specular: 0.0,
            shininess: 50.0,
        }
    }
}

/// Where a material's diffuse colour comes from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Pigment {
    /// One colour everywhere.
    Color(Vec3),
    /// A checkerboard: an even sum of the floors of the hit point's coordinates, divided by `size`, takes the first
    /// colour.
    ///
    /// The coordinates are two on what is flat (plane, triangle, quad, disc, the face of a box or fractal, a cap) and
    /// three in what is curved. Each primitive's type says which.
    Checker {
        /// The two colours.
        colors: [Vec3; 2],
        /// Edge length of a cell, world units.
        size: f32,
    },
    /// A texture, at (u, v) / `size` of the hit point. Each primitive's type says what its u and v are.
    Texture {
        /// Index into [`Description::textures`].
        texture: usize,
        /// The length of one repeat in u and v, above 0.
        size: f32,
        /// What it shows beyond its borders.
        wrap: Wrap,
    },
}

/// What a texture shows beyond its borders.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Wrap {
    /// It repeats where a primitive's coordinates go on: on a plane, with vertices' (u, v), around a body in u and around
    /// a torus in both. Where they end, at 0 and 1 on all else, it is not mixed with what a repeat would show there: the
    /// texels that lie within by half or more go on. An end that is a single point has one colour, to which that of
    /// the last half texel changes: the mean of the texels around it.
    #[default]
    Ends,
    /// It repeats.
    Repeat,
    /// There is one of it, from 0 to `size`, and its border goes on.
    Clamp,
}
