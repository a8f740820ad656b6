//! What the user wrote: the scene as plain data, before anything is compiled.
//!
//! Every number is the `f32` that was read, and counts as exact: the packet tracer and the `f64`
//! reference both start from these same values. Lengths are in world units, light power in watts,
//! colours are linear RGB, angles are degrees.

use std::sync::Arc;

use glam::{Vec2, Vec3};

pub use crate::geometry::Sides;

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
    /// Texture images; materials refer to them by index.
    pub textures: Vec<Arc<Texture>>,
    /// Infinite planes. Primitive ids count through the kinds in this order, from here to the fractals; those of
    /// the meshes through the triangles of all meshes.
    pub planes: Vec<Plane>,
    /// Spheres.
    pub spheres: Vec<Sphere>,
    /// Triangle meshes; a single triangle is a mesh too.
    pub meshes: Vec<Mesh>,
    /// Parallelograms.
    pub quads: Vec<Quad>,
    /// Boxes, aligned to the axes or turned.
    pub cuboids: Vec<Cuboid>,
    /// Cylinders, open or capped.
    pub cylinders: Vec<Cylinder>,
    /// Cones and frusta, open or capped.
    pub cones: Vec<Cone>,
    /// Tori.
    pub tori: Vec<Torus>,
    /// Menger sponges.
    pub fractals: Vec<Fractal>,
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

/// In a scene where anything transmits, rays that count for less than this in their pixel are not followed: 2⁻¹⁴, a
/// fifth of a displayed step in black.
pub const LEAST_WEIGHT: f32 = 1.0 / 16384.0;

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

/// What a ray that hits nothing sees: a radiance by direction.
#[derive(Clone, Debug, PartialEq)]
pub enum Sky {
    /// The same in every direction.
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
/// At (u, v): column u·width, row (1 − v)·height, so that v runs upward, repeating in both; bilinear between texel
/// centres, in linear light.
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
    /// The coordinates are two on what is flat (plane, triangle, quad, the face of a box or fractal, a cap) and
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
        /// What one repeat measures in u and v, above 0.
        size: f32,
    },
}

/// An infinite plane: the points p with p·normal + distance = 0. Seen from both sides.
///
/// With the axes T, B of its unit normal ([`crate::geometry::frame`]): (u, v) = (p·T, −p·B), and checker coordinates are
/// (p·T, p·B).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Plane {
    /// Of any length but zero; the plane is the same when normal and distance are scaled together.
    pub normal: Vec3,
    /// The plane's offset.
    pub distance: f32,
    /// Index into [`Description::materials`].
    pub material: usize,
}

/// A sphere.
///
/// With n = (p − center) / radius: u = ½ + atan2(n.x, n.z) / 2π, v = ½ + asin(n.y) / π. Checker coordinates are
/// p − center.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sphere {
    /// Its centre.
    pub center: Vec3,
    /// Above zero.
    pub radius: f32,
    /// Which side is there.
    pub sides: Sides,
    /// Index into [`Description::materials`].
    pub material: usize,
}

/// Triangles that share vertices; the front is where the corners run counter-clockwise.
///
/// With vertex normals the shading normal is interpolated, and turned to the side of the geometric one that the ray
/// sees. (u, v) is interpolated from the vertices, or are the corner's barycentric coordinates where there are none:
/// (0, 0), (1, 0), (0, 1). Checker coordinates are (p·T, p·B) with the axes of [`crate::geometry::frame`] of the
/// triangle's own normal.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Mesh {
    /// Vertex positions.
    pub positions: Vec<Vec3>,
    /// A direction of any length but zero for every vertex, or nothing.
    pub normals: Vec<Vec3>,
    /// Texture coordinates for every vertex, or nothing.
    pub uvs: Vec<Vec2>,
    /// Three vertex indices a triangle.
    pub triangles: Vec<[u32; 3]>,
    /// Which side is there.
    pub sides: Sides,
    /// A material for every triangle, as indices into [`Description::materials`], or nothing when `material` is all.
    pub materials: Vec<u32>,
    /// Index into [`Description::materials`].
    pub material: usize,
}

/// The parallelogram of the points corner + a u + b v, a and b from 0 to 1; seen from both sides. The front is where
/// u × v points.
///
/// (u, v) = (a, b). Checker coordinates are (p·T, p·B) with the axes of [`crate::geometry::frame`] of u × v.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Quad {
    /// One corner.
    pub corner: Vec3,
    /// From there to the next.
    pub u: Vec3,
    /// And to the other; not parallel to `u`.
    pub v: Vec3,
    /// Index into [`Description::materials`].
    pub material: usize,
}

/// A box, seen from outside and inside.
///
/// Turned about its centre by `rotation`: x first, then y, then z. In its own axes, with q = p − centre, every face
/// is divided into (u, v) from 0 to 1: along (−z, y) on +x, (z, y) on −x, (x, −z) on +y, (x, z) on −y, (x, y) on +z
/// and (−x, y) on −z, so that an image stands upright on the sides, as seen from outside. Checker coordinates are the
/// two of q along the face.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cuboid {
    /// The corner with the least coordinates, before it is turned.
    pub min: Vec3,
    /// The corner with the greatest; each coordinate greater than `min`'s.
    pub max: Vec3,
    /// Degrees about x, y and z.
    pub rotation: Vec3,
    /// Index into [`Description::materials`].
    pub material: usize,
}

/// A cylinder about the line from `base` to `apex`.
///
/// With the unit axis A = normalize(apex − base), its axes T, B ([`crate::geometry::frame`]) and q = p − base: on the
/// side u = ½ + atan2(q·T, q·B) / 2π and v = q·A / |apex − base|; on the caps (u, v) = ½ + (q·T, q·B) / (2 radius).
/// Checker coordinates are (q·T, q·B, q·A), on the caps only the first two.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cylinder {
    /// The middle of one end.
    pub base: Vec3,
    /// The middle of the other.
    pub apex: Vec3,
    /// Above zero.
    pub radius: f32,
    /// Whether the ends are closed.
    pub caps: bool,
    /// Which side is there.
    pub sides: Sides,
    /// Index into [`Description::materials`].
    pub material: usize,
}

/// A cone or frustum about the line from `base` to `apex`. The radii differ, and one of them may be zero.
///
/// (u, v) and checker coordinates are those of a [`Cylinder`], with the cap's own radius.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cone {
    /// The middle of one end.
    pub base: Vec3,
    /// The radius there, zero or more.
    pub base_radius: f32,
    /// The middle of the other end.
    pub apex: Vec3,
    /// The radius there, zero or more.
    pub apex_radius: f32,
    /// Whether the ends are closed.
    pub caps: bool,
    /// Which side is there.
    pub sides: Sides,
    /// Index into [`Description::materials`].
    pub material: usize,
}

/// A torus: the points at `minor_radius` from the circle of `major_radius` about `center`, across `axis`. Seen from
/// outside and inside.
///
/// With the unit axis A, its axes T, B ([`crate::geometry::frame`]), q = p − center and ρ = |q − A (q·A)|:
/// u = ½ + atan2(q·T, q·B) / 2π, v = ½ + atan2(q·A, ρ − major_radius) / 2π. Checker coordinates are
/// (q·T, q·B, q·A).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Torus {
    /// Its middle.
    pub center: Vec3,
    /// The direction of its axis, of any length but zero.
    pub axis: Vec3,
    /// From the middle to the middle of the tube; at least `minor_radius`.
    pub major_radius: f32,
    /// Of the tube, above zero.
    pub minor_radius: f32,
    /// Index into [`Description::materials`].
    pub material: usize,
}

/// A Menger sponge: a cube of which every iteration removes, from each of its 20 · 20 · … cubes, the middle third
/// of each of the three directions. Seen from outside and inside.
///
/// (u, v) and checker coordinates are those of a [`Cuboid`] as large as the whole cube, by the face's direction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fractal {
    /// The middle of the cube.
    pub center: Vec3,
    /// Half the cube's edge, above zero.
    pub radius: f32,
    /// 0 (the whole cube) to 8.
    pub iterations: u32,
    /// Index into [`Description::materials`].
    pub material: usize,
}

impl Description {
    /// The number of primitives; their ids run from 0 to one less.
    pub fn primitives(&self) -> usize {
        let triangles = self.meshes.iter().map(|m| m.triangles.len()).sum::<usize>();
        let flat = self.planes.len() + triangles + self.quads.len() + self.cuboids.len();
        let round = self.spheres.len() + self.cylinders.len() + self.cones.len() + self.tori.len();
        flat + round + self.fractals.len()
    }
}
