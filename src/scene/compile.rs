//! From a [`Description`] to the arrays that are traced.

use std::sync::Arc;
use std::time::{Duration, Instant};

use glam::Vec3;

use super::plan::Structure;
use super::{Description, Invalid, Light, Material, Mesh, Plan, Settings, Sky, Texture, check};
use crate::bvh::{self, Aabb, BLOCK, BlockList, Blocks, Bvh, Class, Source};
use crate::geometry::methods::Choice;
use crate::geometry::{
    Bounded, Cones, Cuboids, Cylinders, Fractals, Planes, Primitives, Quads, Spheres, Tori, Triangles, Variant,
};
use crate::kinds::for_each_kind;

/// A compiled scene: SoA arrays, ready to trace.
///
/// Primitive ids run through the kinds in the order of the fields, from planes to fractals.
#[derive(Clone, Debug)]
pub struct Scene {
    /// Planes, ids from 0.
    pub planes: Planes,
    /// Spheres.
    pub spheres: Spheres,
    /// Triangles.
    pub triangles: Triangles,
    /// Quads.
    pub quads: Quads,
    /// Boxes.
    pub cuboids: Cuboids,
    /// Cylinders.
    pub cylinders: Cylinders,
    /// Cones.
    pub cones: Cones,
    /// Tori.
    pub tori: Tori,
    /// Fractals.
    pub fractals: Fractals,
    /// The first id of every kind.
    pub first: First,
    /// Boxes around all from the quads on, in the order of their ids: hits count only within these, widened by 32 ε of
    /// their farthest corner's distance.
    pub boxes: Vec<Aabb>,
    /// The tree of all but the planes, where the plan asks for one.
    pub bvh: Option<Bvh>,
    /// How long it took to build that tree; 0 without one.
    pub build_time: Duration,
    /// Materials, by index.
    pub materials: Vec<Material>,
    /// Transparent bodies by number; 0 is what is around them all.
    pub bodies: Vec<Body>,
    /// The number of the body that a material makes, by its index; 0 for one that is not transparent.
    pub body_of: Vec<u16>,
    /// Texture images, by index.
    pub textures: Vec<Arc<Texture>>,
    /// Point lights.
    pub lights: Vec<Light>,
    /// What a ray that hits nothing sees.
    pub sky: Sky,
    /// Depth, light fall-off, ambient light.
    pub settings: Settings,
    /// What the scene needs, and why.
    pub plan: Plan,
}

/// What a transparent body is filled with.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Body {
    /// Index of refraction.
    pub ior: f32,
    /// Absorption a world unit, by channel.
    pub absorption: Vec3,
}

/// The first id of every kind of primitive; that of planes is 0.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct First {
    /// Of the planes.
    pub planes: u32,
    /// Of the spheres.
    pub spheres: u32,
    /// Of the triangles.
    pub triangles: u32,
    /// Of the quads.
    pub quads: u32,
    /// Of the boxes.
    pub cuboids: u32,
    /// Of the cylinders.
    pub cylinders: u32,
    /// Of the cones.
    pub cones: u32,
    /// Of the tori.
    pub tori: u32,
    /// Of the fractals.
    pub fractals: u32,
}

/// Evaluates an expression for the primitive with an id, whatever its kind:
/// `with_primitive!(scene, id, |kind, i| kind.material(i))`, where `kind` is [`Primitives`] and `i` counts within it.
macro_rules! with_primitive {
    ($scene:expr, $id:expr, |$kind:ident, $i:ident| $body:expr) => {{
        let (scene, id): (&$crate::scene::Scene, u32) = ($scene, $id);
        let first = &scene.first;
        macro_rules! on {
            ($field:ident, $from:expr) => {{
                let ($kind, $i) = (&scene.$field, (id - $from) as usize);
                $body
            }};
        }
        if id < first.spheres {
            on!(planes, 0)
        } else if id < first.triangles {
            on!(spheres, first.spheres)
        } else if id < first.quads {
            on!(triangles, first.triangles)
        } else if id < first.cuboids {
            on!(quads, first.quads)
        } else if id < first.cylinders {
            on!(cuboids, first.cuboids)
        } else if id < first.cones {
            on!(cylinders, first.cylinders)
        } else if id < first.tori {
            on!(cones, first.cones)
        } else if id < first.fractals {
            on!(tori, first.tori)
        } else {
            on!(fractals, first.fractals)
        }
    }};
}
pub(crate) use with_primitive;

/// Compiles a description into SoA arrays, for rays that start at the eye, at lights and on surfaces: where the plan has a
/// cheaper method for spheres, it vouches for no others. [`compile_with`] can ask for the stable one.
///
/// # Errors
/// [`Invalid`] when [`check`] finds fault with it.
pub fn compile(description: &Description) -> Result<Scene, Invalid> {
    compile_as(description, None)
}

/// The same, with a structure of the caller's choice instead of the plan's; then spheres are tested by the stable method, so
/// that every structure gives the same bits.
///
/// # Errors
/// [`Invalid`] when [`check`] finds fault with it.
pub fn compile_as(description: &Description, structure: Option<Structure>) -> Result<Scene, Invalid> {
    compile_with(description, structure, &[])
}

/// The same, with methods of the caller's choice, too, of which the last of a kind counts.
///
/// # Errors
/// [`Invalid`] when [`check`] finds fault with it.
pub fn compile_with(
    description: &Description,
    structure: Option<Structure>,
    choices: &[Choice],
) -> Result<Scene, Invalid> {
    check(description)?;
    let mut planes = Planes::default();
    for p in &description.planes {
        planes.push(p.normal, p.distance, p.material as u32);
    }
    let mut spheres = Spheres::default();
    for s in &description.spheres {
        spheres.push(s.center, s.radius, s.sides, s.material as u32);
    }
    let mut triangles = Triangles::default();
    description.meshes.iter().for_each(|mesh| add_mesh(&mut triangles, mesh));
    let mut quads = Quads::default();
    for q in &description.quads {
        quads.push(q.corner, q.u, q.v, q.material as u32);
    }
    let mut cuboids = Cuboids::default();
    for c in &description.cuboids {
        cuboids.push(c.min, c.max, c.rotation, c.material as u32);
    }
    let mut cylinders = Cylinders::default();
    for c in &description.cylinders {
        cylinders.push(c.base, c.apex, c.radius, c.caps, c.sides, c.material as u32);
    }
    let mut cones = Cones::default();
    for c in &description.cones {
        let radii = [c.base_radius, c.apex_radius];
        cones.push([c.base, c.apex], radii, c.caps, c.sides, c.material as u32);
    }
    let mut tori = Tori::default();
    for t in &description.tori {
        tori.push(t.center, t.axis, t.major_radius, t.minor_radius, t.material as u32);
    }
    let mut fractals = Fractals::default();
    for f in &description.fractals {
        fractals.push(f.center, f.radius, f.iterations, f.material as u32);
    }
    let mut first = First { spheres: planes.len() as u32, ..First::default() };
    first.triangles = first.spheres + spheres.len() as u32;
    first.quads = first.triangles + triangles.len() as u32;
    first.cuboids = first.quads + quads.len() as u32;
    first.cylinders = first.cuboids + cuboids.len() as u32;
    first.cones = first.cylinders + cylinders.len() as u32;
    first.tori = first.cones + cones.len() as u32;
    first.fractals = first.tori + tori.len() as u32;
    let boxes = (0..quads.len())
        .map(|i| quads.bounds(i))
        .chain((0..cuboids.len()).map(|i| cuboids.bounds(i)))
        .chain((0..cylinders.len()).map(|i| cylinders.bounds(i)))
        .chain((0..cones.len()).map(|i| cones.bounds(i)))
        .chain((0..tori.len()).map(|i| tori.bounds(i)))
        .chain((0..fractals.len()).map(|i| fractals.bounds(i)))
        .map(|[min, max]| Aabb { min, max })
        .collect::<Vec<_>>();
    let plan = Plan::of(description, &boxes, structure, choices);
    spheres.method = plan.methods.sphere;
    spheres.steps = plan.methods.normalize.steps();
    triangles.method = plan.methods.triangle;
    tori.method = plan.methods.torus;
    let mut bodies = vec![Body { ior: 1.0, absorption: Vec3::ZERO }];
    let body = |m: &Material| {
        if m.transmission <= 0.0 {
            return 0;
        }
        bodies.push(Body { ior: m.ior, absorption: m.absorption });
        (bodies.len() - 1) as u16
    };
    let body_of = description.materials.iter().map(body).collect();
    let mut scene = Scene {
        planes,
        spheres,
        triangles,
        quads,
        cuboids,
        cylinders,
        cones,
        tori,
        fractals,
        first,
        boxes,
        bvh: None,
        build_time: Duration::ZERO,
        materials: description.materials.clone(),
        bodies,
        body_of,
        textures: description.textures.clone(),
        lights: description.lights.clone(),
        sky: description.sky.clone(),
        settings: description.settings,
        plan,
    };
    if scene.plan.structure == Structure::Tree {
        let started = Instant::now();
        scene.bvh = Some(Bvh::build(&InTree(&scene)));
        scene.build_time = started.elapsed();
    }
    Ok(scene)
}

/// All of a scene's primitives that have bounds, for the tree.
struct InTree<'a>(&'a Scene);

macro_rules! source {
    (unbounded { $($unbounded:tt)* } bounded { $(($field:ident: $Storage:ident, $($rest:tt)*))* }) => {
        impl Source for InTree<'_> {
            fn len(&self) -> usize {
                0 $(+ self.0.$field.len())*
            }
            fn bounds(&self, i: usize) -> Aabb {
                let mut i = i;
                $(
                    if i < self.0.$field.len() {
                        let [min, max] = self.0.$field.around(i);
                        return Aabb { min, max };
                    }
                    i -= self.0.$field.len();
                )*
                unreachable!("{i} beyond the last primitive")
            }
            fn pieces(&self, i: usize, mut show: impl FnMut(Aabb)) {
                let mut i = i;
                $(
                    if i < self.0.$field.len() {
                        let kind = &self.0.$field;
                        let n = kind.pieces(i);
                        return (0..n).map(|k| kind.piece(i, k, n)).for_each(|[min, max]| show(Aabb { min, max }));
                    }
                    i -= self.0.$field.len();
                )*
                unreachable!("{i} beyond the last primitive")
            }
            fn cut(&self) -> bool {
                false $(|| (0..self.0.$field.len()).any(|i| self.0.$field.pieces(i) > 1))*
            }
            fn class(&self, i: usize) -> Class {
                let mut i = i;
                $(
                    if i < self.0.$field.len() {
                        return Class::new(bvh::Kind::$Storage, self.0.$field.variant(i).code());
                    }
                    i -= self.0.$field.len();
                )*
                unreachable!("{i} beyond the last primitive")
            }
            fn id(&self, i: usize) -> u32 {
                self.0.first.spheres + i as u32
            }
            fn blocks(&self, ids: &[Vec<[u32; BLOCK]>]) -> Blocks {
                let mut ids = ids.iter();
                let mut next = || ids.next().map_or(&[][..], |ids| &ids[..]);
                Blocks { $($field: BlockList::of(&self.0.$field, self.0.first.$field, next()),)* }
            }
        }
    };
}
for_each_kind!(source);

/// Adds a mesh's triangles, and to those what its vertices have.
fn add_mesh(triangles: &mut Triangles, mesh: &Mesh) {
    let [normals, uvs] = [triangles.normals.values.len(), triangles.uvs.values.len()].map(|n| n as u32);
    triangles.normals.values.extend(&mesh.normals);
    triangles.uvs.values.extend(&mesh.uvs);
    for (k, corners) in mesh.triangles.iter().enumerate() {
        let i = triangles.len();
        let material = mesh.materials.get(k).copied().unwrap_or(mesh.material as u32);
        triangles.push(corners.map(|c| mesh.positions[c as usize]), mesh.sides, material);
        if !mesh.normals.is_empty() {
            triangles.normals.set(i, corners.map(|c| c + normals));
        }
        if !mesh.uvs.is_empty() {
            triangles.uvs.set(i, corners.map(|c| c + uvs));
        }
    }
}
