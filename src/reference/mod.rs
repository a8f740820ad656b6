//! The scalar `f64` reference tracer: slow, plain, and the measure of everything else.
//!
//! It proves the packet tracer's answers, so it shares nothing with it but the [`Description`] and the list of its kinds'
//! names: one ray at a time, a list of primitives, textbook formulae, no acceleration structure, recursion for mirrors. A
//! fault in a packet kernel cannot hide in its own check.
//!
//! - [`Tracer`]: nearest hit ([`Tracer::intersect`]), any hit ([`Tracer::blocked`]) and Whitted shading
//!   ([`Tracer::radiance`]).
//! - [`Camera`]: the lecture's camera.
//! - [`render`] and [`hits`]: whole pictures, in the caller's rayon pool.
//!
//! All vectors are `f64`; directions have unit length, lengths are in world units, colours are linear RGB.
use crate::kinds::for_each_kind;
use crate::scene::{Description, Light, Material, Settings, Sky, Texture};
use glam::{DVec2, DVec3};
use std::fmt::Debug;
use std::sync::Arc;

mod camera;
mod cone;
mod cuboid;
mod cylinder;
mod disc;
mod fractal;
mod image;
mod plane;
mod quad;
mod shade;
mod sphere;
mod texture;
mod torus;
mod triangle;

pub use camera::Camera;
pub use image::{hits, render, render_with_progress};
pub use shade::Rounding;

/// A nearest hit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    /// Distance along the unit direction.
    pub t: f64,
    /// Primitive id; ids count through the kinds in the order of the [`Description`]'s fields.
    pub primitive: u32,
    /// Unit geometric normal, turned against the ray.
    pub normal: DVec3,
    /// Unit normal for shading, on the same side.
    pub shading_normal: DVec3,
}

/// One primitive, whatever its kind.
trait Primitive: Debug + Send + Sync {
    /// The first distance above 0 at which the ray meets the sides that are there.
    fn distance(&self, origin: DVec3, direction: DVec3) -> Option<f64>;
    /// The same for light, which is stopped from both sides, whichever is there to be seen.
    fn stops(&self, origin: DVec3, direction: DVec3) -> Option<f64> {
        self.distance(origin, direction)
    }
    /// The point of the surface nearest to a point close to it.
    fn project(&self, point: DVec3) -> DVec3;
    /// The unit geometric normal at a point close to the surface, as described or wound, or outward.
    fn normal(&self, point: DVec3) -> DVec3;
    /// The normal for shading, where it is another; on either side.
    fn shading_normal(&self, point: DVec3) -> DVec3 {
        self.normal(point)
    }
    /// From where lights are seen at a point, on the side of `towards`.
    fn seen_from(&self, point: DVec3, _towards: DVec3) -> DVec3 {
        point
    }
    /// The primitive's own size, 0 for a plane.
    fn extent(&self) -> f64;
    /// Index into the materials.
    fn material(&self) -> usize;
    /// Texture coordinates at a point of the surface.
    fn uv(&self, point: DVec3) -> DVec2;
    /// What comes at the ends of those coordinates.
    fn edges(&self, point: DVec3) -> Edges;
    /// The coordinates a checkerboard is laid in; 0 for the third where it is flat.
    fn checker(&self, point: DVec3) -> DVec3;
}

/// What comes where texture coordinates are 0 and 1.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Edge {
    /// Nothing: they go on, or around.
    None,
    /// The surface, or this part of it, ends.
    Border,
    /// All of the other coordinate comes together in a point.
    Point,
}

/// Those of u at 0 and 1, then those of v.
type Edges = [[Edge; 2]; 2];

/// On a face.
const FACE: Edges = [[Edge::Border; 2]; 2];

/// Around a body, with its lower and upper end.
fn around(lower: Edge, upper: Edge) -> Edges {
    [[Edge::None; 2], [lower, upper]]
}

/// An element of a description: a primitive, or a mesh of them.
trait Primitives {
    /// Adds what is to be traced, in the order of ids.
    fn add(&self, to: &mut Vec<Box<dyn Primitive>>);
}

/// A scene to trace, one ray at a time.
#[derive(Debug)]
pub struct Tracer {
    /// By id.
    primitives: Vec<Box<dyn Primitive>>,
    materials: Vec<Material>,
    textures: Vec<Arc<Texture>>,
    lights: Vec<Light>,
    sky: Sky,
    settings: Settings,
    /// Whether any primitive transmits.
    refracts: bool,
}

impl Tracer {
    /// Takes a scene over; numbers are widened to `f64`, nothing else happens to them.
    ///
    /// # Panics
    /// When a mesh names a vertex that does not exist ([`crate::scene::check`] finds that).
    pub fn new(scene: &Description) -> Self {
        let mut primitives: Vec<Box<dyn Primitive>> = Vec::new();
        macro_rules! add_all {
            ($($bounds:ident { $(($storage:ident: $Storage:ident, $field:ident: $Kind:ident, $module:ident))* })*) => {
                $($(scene.$field.iter().for_each(|it| it.add(&mut primitives));)*)*
            };
        }
        for_each_kind!(add_all);
        let transmits = |m: usize| scene.materials.get(m).is_some_and(|m| m.transmission > 0.0);
        Self {
            refracts: primitives.iter().any(|p| transmits(p.material())),
            primitives,
            materials: scene.materials.clone(),
            textures: scene.textures.clone(),
            lights: scene.lights.clone(),
            sky: scene.sky.clone(),
            settings: scene.settings,
        }
    }

    /// The nearest hit in (0, `t_max`); on equal distance the lower id wins.
    pub fn intersect(&self, origin: DVec3, direction: DVec3, t_max: f64) -> Option<Hit> {
        let mut nearest = None;
        let mut t_max = t_max;
        // Ids ascend, and a later primitive has to be strictly nearer: so ties go to the lower id.
        self.distances(origin, direction).for_each(|(id, t)| {
            if t < t_max {
                t_max = t;
                nearest = Some(id);
            }
        });
        nearest.map(|id: usize| {
            let (primitive, point) = (&self.primitives[id], origin + t_max * direction);
            let normal = turned(primitive.normal(point), direction);
            let shading_normal = turned(primitive.shading_normal(point), -normal);
            Hit { t: t_max, primitive: id as u32, normal, shading_normal }
        })
    }

    /// Whether anything lies in (0, `t_max`) that stops light: surfaces do from both sides, whichever are seen.
    pub fn blocked(&self, origin: DVec3, direction: DVec3, t_max: f64) -> bool {
        self.primitives.iter().filter_map(|p| p.stops(origin, direction)).any(|t| t < t_max)
    }

    /// The first distance above 0 at which the ray meets a primitive, whatever else is in the way; `None` for unknown
    /// ids.
    pub fn distance(&self, id: u32, origin: DVec3, direction: DVec3) -> Option<f64> {
        self.primitives.get(id as usize)?.distance(origin, direction)
    }

    /// The first distance above 0 at which a primitive stops light, from whichever side; `None` for unknown ids.
    pub fn stop(&self, id: u32, origin: DVec3, direction: DVec3) -> Option<f64> {
        self.primitives.get(id as usize)?.stops(origin, direction)
    }

    /// How many primitives there are.
    pub fn primitives(&self) -> usize {
        self.primitives.len()
    }

    /// A primitive's own size: a sphere's radius, a triangle's longest edge, 0 for planes and unknown ids.
    pub fn extent(&self, id: u32) -> f64 {
        self.primitives.get(id as usize).map_or(0.0, |p| p.extent())
    }

    /// Every primitive the ray hits at t > 0, with its first such t, in the order of ids.
    fn distances(&self, origin: DVec3, direction: DVec3) -> impl Iterator<Item = (usize, f64)> {
        let all = self.primitives.iter().enumerate();
        all.filter_map(move |(id, p)| p.distance(origin, direction).map(|t| (id, t)))
    }
}

/// `normal`, turned against `direction`.
fn turned(normal: DVec3, direction: DVec3) -> DVec3 {
    if normal.dot(direction) > 0.0 { -normal } else { normal }
}

/// Two axes in a surface with unit normal n: T is the projection of x, or of z where n.x is the greatest component; B =
/// T × n.
fn axes(n: DVec3) -> [DVec3; 2] {
    let [x, y, z] = n.abs().to_array();
    let across = if (y >= x && y >= z) || x < z { DVec3::X } else { DVec3::Z };
    let tangent = (across - n * n.dot(across)).normalize();
    [tangent, tangent.cross(n)]
}

/// A direction in a plane as a part of a full turn: ½ + atan2(y, x) / 2π.
fn turn(y: f64, x: f64) -> f64 {
    0.5 + y.atan2(x) / std::f64::consts::TAU
}

#[cfg(test)]
mod tests;
