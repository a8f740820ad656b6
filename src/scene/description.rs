//! What the user wrote: the scene as plain data, before anything is compiled.
//!
//! Every number is the `f32` that was read, and counts as exact: the packet tracer and the `f64`
//! reference both start from these same values. Lengths are in world units, light power in watts,
//! colours are linear RGB, angles are degrees.

use glam::Vec3;

/// A whole scene. Made by a reader, a built-in, or by hand; [`crate::scene::check`] says whether it is sound.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Description {
    /// A short name for messages: the built-in's name or the file's stem.
    pub name: String,
    /// Where the scene is looked at from.
    pub camera: CameraDescription,
    /// Depth, light fall-off, ambient light.
    pub settings: Settings,
    /// What a ray that hits nothing sees.
    pub sky: Sky,
    /// Point lights.
    pub lights: Vec<Light>,
    /// Materials; primitives refer to them by index.
    pub materials: Vec<Material>,
    /// Infinite planes. Primitive ids count planes first, then spheres, then the triangles of all meshes in order.
    pub planes: Vec<Plane>,
    /// Spheres.
    pub spheres: Vec<Sphere>,
    /// Triangle meshes.
    pub meshes: Vec<Mesh>,
}

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

/// Settings that concern the scene as a whole.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Settings {
    /// The number of segments a path may have; the eye ray is 1. 1 to 64.
    pub max_depth: u32,
    /// Whether irradiance falls off as power / (4 π r²); otherwise it is the power at any distance.
    pub attenuation: bool,
    /// Light that reaches every point from everywhere, as irradiance.
    pub ambient: Vec3,
}

impl Default for Settings {
    fn default() -> Self {
        Self { max_depth: 6, attenuation: true, ambient: Vec3::ZERO }
    }
}

/// What a ray that hits nothing sees.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Sky {
    /// The same radiance in every direction; black unless given.
    pub color: Vec3,
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
#[derive(Clone, Debug, PartialEq)]
pub struct Material {
    /// The name the scene file gives it.
    pub name: String,
    /// Diffuse colour, or a pattern of two.
    pub pigment: Pigment,
    /// Mirror fraction ρ, 0 to 1: the surface shows (1 − ρ) of its own shading and ρ of its reflection.
    pub reflectance: f32,
    /// Strength of the Phong highlight, 0 for none.
    pub specular: f32,
    /// Phong exponent, above 0.
    pub shininess: f32,
}

/// Where a material's diffuse colour comes from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Pigment {
    /// One colour everywhere.
    Color(Vec3),
    /// A checkerboard.
    ///
    /// On a plane or triangle it lies in the surface: cell (⌊p·T / size⌋, ⌊p·B / size⌋) of the hit point p with
    /// the axes of [`crate::geometry::frame`]. In a sphere it is solid: the three floors of (p − center) / size.
    /// An even sum takes the first colour.
    Checker {
        /// The two colours.
        colors: [Vec3; 2],
        /// Edge length of a cell, world units.
        size: f32,
    },
}

/// An infinite plane: the points p with p·normal + distance = 0. Seen from both sides.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Plane {
    /// Of any length but zero; the plane is the same when normal and distance are scaled together.
    pub normal: Vec3,
    /// The plane's offset.
    pub distance: f32,
    /// Index into [`Description::materials`].
    pub material: usize,
}

/// A sphere, seen from outside and inside.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sphere {
    /// Its centre.
    pub center: Vec3,
    /// Above zero.
    pub radius: f32,
    /// Index into [`Description::materials`].
    pub material: usize,
}

/// Triangles that share vertices. Seen from both sides.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Mesh {
    /// Vertex positions.
    pub positions: Vec<Vec3>,
    /// Three vertex indices a triangle.
    pub triangles: Vec<[u32; 3]>,
    /// Index into [`Description::materials`].
    pub material: usize,
}

impl Description {
    /// The number of primitives; their ids run from 0 to one less.
    pub fn primitives(&self) -> usize {
        self.planes.len() + self.spheres.len() + self.meshes.iter().map(|m| m.triangles.len()).sum::<usize>()
    }
}
