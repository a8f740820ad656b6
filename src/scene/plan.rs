//! What a scene needs of the tracer, decided once when it is compiled.

use std::fmt;

use glam::Vec3;

use super::choose::{self, Chosen};
use super::{Description, Sides};
use crate::bvh::Aabb;
use crate::geometry::methods::{
    Choice, Methods, NormalizeMethod, OffsetMethod, SphereMethod, TorusMethod, TriangleMethod,
};

/// Where a light's shadow rays start.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ShadowStart {
    /// At the light: all rays share their origin, which is faster.
    Light,
    /// At the shaded point: for a light so far from something small that rays from there would miss it.
    Point,
}

/// The greatest distance of a light from a primitive, in sizes of the primitive (a sphere's radius, a triangle's least
/// height), for shadow rays to start at the light: a ray that comes from D away is off by 12 ε D ([`crate::shade`]),
/// here less than 1/1000 of the size. Likewise from the eye, in distances from there to what it looks at.
const FARTHEST: f32 = 1024.0;

/// How rays find what they may meet.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Structure {
    /// Every batch looks at all there is.
    None,
    /// By a tree of boxes ([`crate::bvh`]); planes apart.
    Tree,
}

/// From which weight on a tree is faster: a sphere counts once, all else with bounds four times (measured). Lists are
/// good at spheres, whose balls are culled a packet's width at a time.
const TREE_FROM: usize = 128;

/// What the tracer will do for a scene, each with its reason; what is absent costs nothing.
#[derive(Clone, Debug, PartialEq)]
pub struct Plan {
    /// The numbers of primitives by kind, in the order of their ids.
    pub primitives: [usize; 9],
    /// How rays find what they may meet.
    pub structure: Structure,
    /// Whether there is more than planes, spheres and triangles that are seen from both sides.
    pub rare: bool,
    /// Whether any triangle has vertex normals.
    pub smooth: bool,
    /// Whether anything is rare, smooth or transmits: all that a plain scene is traced and shaded without.
    pub rich: bool,
    /// How many segments a path may have: 1 where nothing reflects or transmits, else the scene's `max_depth`.
    pub waves: u32,
    /// Whether anything transmits.
    pub refracts: bool,
    /// Whether any of that absorbs.
    pub absorbs: bool,
    /// Whether any material has a highlight, so that the Phong term is evaluated.
    pub highlights: bool,
    /// Where each light's shadow rays start.
    pub shadows: Vec<ShadowStart>,
    /// What primitives are tested by, vectors normalised and rays moved off surfaces.
    pub methods: Methods,
    /// Why spheres are tested as they are.
    why: String,
    mirrors: usize,
    glasses: usize,
    materials: usize,
}

impl Plan {
    /// The plan for a description, with a structure and methods of the caller's choice. `boxes` are around all from the
    /// quads on.
    pub(super) fn of(
        description: &Description,
        boxes: &[Aabb],
        structure: Option<Structure>,
        choices: &[Choice],
    ) -> Self {
        let used = used_materials(description);
        let count = |has: &dyn Fn(&super::Material) -> bool| {
            description.materials.iter().zip(&used).filter(|(m, u)| **u && has(m)).count()
        };
        let triangles = description.meshes.iter().map(|m| m.triangles.len()).sum();
        let primitives = [
            description.planes.len(),
            description.spheres.len(),
            triangles,
            description.quads.len(),
            description.cuboids.len(),
            description.cylinders.len(),
            description.cones.len(),
            description.tori.len(),
            description.fractals.len(),
        ];
        let one_sided = description.spheres.iter().any(|s| s.sides != Sides::Both)
            || description.meshes.iter().any(|m| m.sides != Sides::Both);
        let mirrors = count(&|m| m.reflectance > 0.0);
        let glasses = count(&|m| m.transmission > 0.0);
        let weight = primitives[1] + 4 * primitives[2..].iter().sum::<usize>();
        // Whoever compares structures wants the same bits of both.
        let asked = structure.is_some();
        let structure = structure.unwrap_or(if weight < TREE_FROM { Structure::None } else { Structure::Tree });
        let chosen = match asked {
            true => Chosen { method: SphereMethod::Stable, reason: "with a structure that was asked for".to_owned() },
            false => choose::sphere(description, boxes, structure),
        };
        let planned = Methods { sphere: chosen.method, ..Methods::default() };
        let methods = choices.iter().fold(planned, |methods, &choice| methods.with(choice));
        // What tests triangles, and spheres in trees, otherwise than by default is with the rare things.
        let rare = one_sided
            || primitives[3..].iter().any(|n| *n > 0)
            || methods.triangle != TriangleMethod::default()
            || match methods.sphere {
                SphereMethod::Stable => false,
                SphereMethod::Quadratic => structure == Structure::Tree,
                SphereMethod::Geometric | SphereMethod::Double => true,
            };
        Self {
            primitives,
            structure,
            rare,
            rich: rare || glasses > 0 || description.meshes.iter().any(|m| !m.normals.is_empty()),
            smooth: description.meshes.iter().any(|m| !m.normals.is_empty()),
            waves: if mirrors + glasses == 0 { 1 } else { description.settings.max_depth },
            refracts: glasses > 0,
            absorbs: count(&|m| m.transmission > 0.0 && m.absorption != Vec3::ZERO) > 0,
            highlights: count(&|m| m.specular > 0.0) > 0,
            methods,
            why: if methods.sphere == chosen.method { chosen.reason } else { "as asked for".to_owned() },
            shadows: description.lights.iter().map(|l| shadow_start(description, l.position)).collect(),
            mirrors,
            glasses,
            materials: used.iter().filter(|u| **u).count(),
        }
    }
}

/// Where the shadow rays of a light at `position` start.
fn shadow_start(description: &Description, position: Vec3) -> ShadowStart {
    let distance = |p: Vec3| (p.as_dvec3() - position.as_dvec3()).length();
    let near = |p: Vec3, size: f64| distance(p) <= f64::from(FARTHEST) * size;
    let camera = &description.camera;
    let view = (camera.look_at.as_dvec3() - camera.eye.as_dvec3()).length();
    let spheres = description.spheres.iter().all(|s| near(s.center, f64::from(s.radius)));
    let flat = |corner: Vec3, u: Vec3, v: Vec3| {
        let [e1, e2] = [u, v].map(|e| e.as_dvec3());
        let least_height = e1.cross(e2).length() / e1.length().max(e2.length()).max((e2 - e1).length());
        // A triangle without area casts no shadow.
        let nothing = least_height.is_nan() || least_height == 0.0;
        nothing || [corner, corner + u, corner + v].iter().all(|&p| near(p, least_height))
    };
    let meshes = description.meshes.iter().all(|mesh| {
        mesh.triangles.iter().all(|corners| {
            let [a, b, c] = corners.map(|i| mesh.positions[i as usize]);
            flat(a, b - a, c - a)
        })
    });
    let quads = description.quads.iter().all(|q| flat(q.corner, q.u, q.v) && flat(q.corner + q.u + q.v, -q.u, -q.v));
    // A body counts by its least size, of a fractal its smallest cubes.
    let cuboids = description.cuboids.iter().all(|c| {
        let size = f64::from((c.max - c.min).min_element());
        near(c.min, size) && near(c.max, size)
    });
    let cylinders = description.cylinders.iter().all(|c| {
        let size = f64::from(c.radius).min(c.base.as_dvec3().distance(c.apex.as_dvec3()));
        near(c.base, size) && near(c.apex, size)
    });
    let cones = description.cones.iter().all(|c| {
        let length = c.base.as_dvec3().distance(c.apex.as_dvec3());
        let size = f64::from(c.base_radius.max(c.apex_radius)).min(length);
        near(c.base, size) && near(c.apex, size)
    });
    let tori = description.tori.iter().all(|t| near(t.center, f64::from(t.minor_radius)));
    let fractals =
        description.fractals.iter().all(|f| near(f.center, f64::from(f.radius) / 3f64.powi(f.iterations as i32)));
    let bodies = cuboids && cylinders && cones && tori && fractals;
    let all = spheres && meshes && quads && bodies && near(camera.eye, view);
    if all { ShadowStart::Light } else { ShadowStart::Point }
}

/// Which materials some primitive wears.
fn used_materials(description: &Description) -> Vec<bool> {
    let mut used = vec![false; description.materials.len()];
    let mut wear = |m: usize| {
        if let Some(used) = used.get_mut(m) {
            *used = true;
        }
    };
    description.planes.iter().for_each(|p| wear(p.material));
    description.spheres.iter().for_each(|p| wear(p.material));
    for mesh in &description.meshes {
        match mesh.materials.is_empty() {
            true => wear(mesh.material),
            false => mesh.materials.iter().for_each(|&m| wear(m as usize)),
        }
    }
    description.quads.iter().for_each(|p| wear(p.material));
    description.cuboids.iter().for_each(|p| wear(p.material));
    description.cylinders.iter().for_each(|p| wear(p.material));
    description.cones.iter().for_each(|p| wear(p.material));
    description.tori.iter().for_each(|p| wear(p.material));
    description.fractals.iter().for_each(|p| wear(p.material));
    used
}

impl fmt::Display for Plan {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let sphere = match self.methods.sphere {
            SphereMethod::Stable => {
                format!("method `stable`, right from inside, on and far from a sphere: {}", self.why)
            }
            other => format!("method `{}`: {}", other.name(), self.why),
        };
        let triangle = match self.methods.triangle {
            TriangleMethod::Watertight => {
                "method `watertight`: no ray slips between triangles that share an edge or corner".to_owned()
            }
            other => format!("method `{}`, as asked for", other.name()),
        };
        let torus = match self.methods.torus {
            TorusMethod::MonotoneNewton => {
                "method `monotone_newton`, which loses no root, single or double, near or far".to_owned()
            }
            other => format!("method `{}`, as asked for", other.name()),
        };
        let methods = [
            ("planes", "unbounded; left out where no ray of a batch turns to it"),
            ("spheres", &sphere),
            ("triangles", &triangle),
            ("quads", "method `moller_trumbore`, as nothing shares their edges"),
            ("boxes", "method `slabs`: no ray slips through an edge or corner"),
            ("cylinders", "method `stable`; a closed one is an endless one within a slab, without cracks"),
            ("cones", "method `stable`, in the cone's own product, so that its tip and slant do not cancel"),
            ("tori", &torus),
            ("fractals", "method `sphere_trace`, in steps that end on the grid's planes"),
        ];
        for ((kind, method), count) in methods.into_iter().zip(self.primitives).filter(|(_, count)| *count > 0) {
            writeln!(f, "{kind:<11} {count}: {method}")?;
        }
        match self.structure {
            Structure::None => writeln!(
                f,
                "structure   none: every batch of rays tests all that its bounds do not rule out; a tree pays from \
                 {TREE_FROM} spheres or {} others on",
                TREE_FROM / 4
            )?,
            Structure::Tree => writeln!(
                f,
                "structure   tree, as {TREE_FROM} spheres or {} others pay for one: groups of rays that run together \
                 descend behind a beam around them, others in packets of sixteen",
                TREE_FROM / 4
            )?,
        }
        match (self.waves, self.mirrors, self.glasses) {
            (_, 0, 0) => writeln!(f, "waves       1: nothing reflects")?,
            (waves, n, 0) => {
                writeln!(f, "waves       {waves}: {n} of {} materials reflect; max_depth", self.materials)?
            }
            (waves, n, k) => {
                let materials = self.materials;
                writeln!(f, "waves       {waves}: of {materials} materials {n} reflect and {k} transmit; max_depth")?;
                let by = if self.absorbs { "absorption by channel" } else { "none absorbs" };
                writeln!(
                    f,
                    "bodies      a ray keeps those it is in; {by}; what counts for less than 2^-14 is dropped"
                )?;
            }
        }
        if self.smooth {
            writeln!(f, "normals     interpolated where a mesh has them")?;
        }
        let from_light = self.shadows.iter().filter(|s| **s == ShadowStart::Light).count();
        let from_point = self.shadows.len() - from_light;
        let streams = |n: usize| if n == 1 { "1 stream".to_owned() } else { format!("{n} streams") };
        if from_light > 0 {
            let streams = streams(from_light);
            writeln!(f, "shadows     {streams} a wave from lights, so that their rays share an origin")?;
        }
        if from_point > 0 {
            let streams = streams(from_point);
            writeln!(
                f,
                "shadows     {streams} a wave towards lights over {FARTHEST} sizes from a primitive, or from \
                 what is seen: too far to aim at it from there"
            )?;
        }
        let Methods { normalize, offset, .. } = self.methods;
        if normalize != NormalizeMethod::default() {
            writeln!(f, "unit        method `{}`, as asked for", normalize.name())?;
        }
        if offset != OffsetMethod::default() {
            writeln!(f, "offset      method `{}`, as asked for", offset.name())?;
        }
        if self.shadows.is_empty() {
            writeln!(f, "shadows     none: there is no light")?;
        }
        write!(
            f,
            "highlights  {}",
            if self.highlights { "yes: a material is specular" } else { "no: no material is specular" }
        )
    }
}
