//! The tracer's plan for a scene, decided once when it is compiled.

use std::cell::Cell;

use glam::Vec3;

use super::choose::{self, Chosen};
use super::kinds::{KINDS, Kind, KindName, each_kind};
use super::{CompileOptions, Description, Light, Material, Sides};
use crate::bvh::Aabb;
use crate::geometry::methods::{Methods, SphereMethod, TerminatorMethod, TriangleMethod};

/// Where a light's shadow rays start.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ShadowStart {
    /// At the light: all rays share their origin, which is faster.
    Light,
    /// At the shaded point: for a light so far from something small that rays from there would miss it.
    Point,
}

/// How rays find what they may meet.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Structure {
    /// Every batch looks at all there is.
    None,
    /// By a tree of boxes ([`crate::bvh`]); planes apart.
    Tree,
}

/// The work that the tracer does for a scene; what is absent costs nothing.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Plan {
    /// The numbers of primitives by kind, in the order of [`KINDS`].
    pub primitives: [usize; KINDS.len()],
    /// How rays find what they may meet.
    pub structure: Structure,
    /// Whether there is more than planes, spheres and triangles that are seen from both sides.
    pub rare: bool,
    /// Whether any triangle has vertex normals.
    pub smooth: bool,
    /// Whether shadow rays start on the surface that the tangent planes of vertices make: where there are vertex normals
    /// and no other method was asked for.
    pub raised: bool,
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
    /// The methods by which primitives are tested, vectors normalised and rays moved off surfaces.
    pub methods: Methods,
    /// Why spheres are tested as they are.
    pub why: String,
    /// How many materials some primitive wears.
    pub materials: usize,
    /// How many of those reflect.
    pub mirrors: usize,
    /// How many of them transmit.
    pub glasses: usize,
}

/// How the primitives of a kind are tested.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct Tested<'a> {
    /// The kind.
    pub kind: KindName,
    /// How many primitives there are.
    pub count: usize,
    /// The name of the method, where it is not the default.
    pub method: Option<&'static str>,
    /// Why by that method, where the scene decides it.
    pub reason: Option<&'a str>,
}

impl Plan {
    /// The greatest distance of a light from a primitive, in sizes of the primitive (a sphere's radius, a triangle's least
    /// height), for shadow rays to start at the light: a ray that comes from D away is off by 12 ε D ([`crate::shade`]),
    /// here less than 1/1000 of the size. Likewise from the eye, in distances from there to what it looks at.
    pub const FARTHEST: f32 = 1024.0;

    /// From which weight on a tree is faster: a sphere counts once, all else with bounds four times (measured). Lists are
    /// good at spheres, whose balls are culled a packet's width at a time.
    pub const TREE_FROM: usize = 128;

    /// The plan for a description, with a structure and methods of the caller's choice. `boxes` are around all from the
    /// quads on.
    pub(super) fn of(description: &Description, boxes: &[Aabb], options: &CompileOptions) -> Self {
        let primitives = description.counts();
        let structure = options.structure.unwrap_or_else(|| structure(&primitives));
        let chosen = match options.structure {
            // Whoever compares structures wants the same bits of both.
            Some(_) => Chosen::stable("with a structure that was asked for"),
            None => choose::sphere(description, boxes, structure),
        };
        let planned = Methods { sphere: chosen.method, ..Methods::default() };
        let methods = options.methods.iter().fold(planned, |methods, &choice| methods.with(choice));
        let used = used_materials(description);
        let count = |has: &dyn Fn(&Material) -> bool| used.iter().filter(|m| has(m)).count();
        let [mirrors, glasses] = [count(&|m| m.reflectance > 0.0), count(&|m| m.transmission > 0.0)];
        let rare = rare(description, &methods);
        let smooth = description.meshes.iter().any(|m| !m.normals.is_empty());
        Self {
            primitives,
            structure,
            rare,
            smooth,
            raised: smooth && methods.terminator == TerminatorMethod::TangentPlanes,
            rich: rare || smooth || glasses > 0,
            waves: if mirrors + glasses == 0 { 1 } else { description.settings.max_depth },
            refracts: glasses > 0,
            absorbs: count(&|m| m.transmission > 0.0 && m.absorption != Vec3::ZERO) > 0,
            highlights: count(&|m| m.specular > 0.0) > 0,
            shadows: shadow_starts(description),
            methods,
            why: if methods.sphere == chosen.method { chosen.reason } else { "as asked for".to_owned() },
            materials: used.len(),
            mirrors,
            glasses,
        }
    }

    /// How the kinds of primitive are tested, in the order of [`KINDS`].
    pub fn tested(&self) -> [Tested<'_>; KINDS.len()] {
        let mut counts = self.primitives.into_iter();
        each_kind!(|K| Tested {
            kind: K::NAME,
            count: counts.next().unwrap_or_default(),
            method: K::other_method(&self.methods),
            reason: K::reason(self),
        })
    }
}

/// How rays find so many primitives by kind.
fn structure(primitives: &[usize; KINDS.len()]) -> Structure {
    let weight = each_kind!(|K| K::WEIGHT).iter().zip(primitives).map(|(weight, count)| weight * count).sum::<usize>();
    if weight < Plan::TREE_FROM { Structure::None } else { Structure::Tree }
}

/// [`Plan::rare`]. What is tested as no plan chooses is with the rare things.
fn rare(description: &Description, methods: &Methods) -> bool {
    each_kind!(description, |all| is_rare(all)).contains(&true)
        || methods.triangle != TriangleMethod::default()
        || !matches!(methods.sphere, SphereMethod::Stable | SphereMethod::Quadratic)
}

/// Whether a kind's elements are more than kernels for plain scenes know.
fn is_rare<K: Kind>(all: &[K]) -> bool {
    all.iter().any(|element| !K::PLAIN || element.sides() != Sides::Both)
}

/// Up to so many questions, every light is held against every primitive.
const MANY: usize = 1 << 26;

/// Where the shadow rays of each light start.
///
/// Time is about linear in lights and primitives together. A light that the smallest primitive would be near to anywhere in
/// the box around them all is near to each. Where that is not so, and lights times primitives are more than [`MANY`], the
/// rays start at the point, which is always right.
fn shadow_starts(description: &Description) -> Vec<ShadowStart> {
    let camera = &description.camera;
    let view = (camera.look_at.as_dvec3() - camera.eye.as_dvec3()).length();
    let extent = Cell::new((Aabb::EMPTY, f64::INFINITY));
    let add = |p: Vec3, size: f64| {
        let (around, least) = extent.get();
        extent.set((around.extend(p), least.min(size)));
        true
    };
    let _ = each_kind!(description, |all| all.iter().all(|element| element.near(&add)));
    let (around, least) = extent.get();
    let few = description.lights.len().saturating_mul(description.primitives()) <= MANY;
    let start = |light: &Light| {
        let position = light.position.as_dvec3();
        let near = |p: Vec3, size: f64| (p.as_dvec3() - position).length() <= f64::from(Plan::FARTHEST) * size;
        let each = || !each_kind!(description, |all| all.iter().all(|element| element.near(&near))).contains(&false);
        let all = choose::farthest(&around, position) <= f64::from(Plan::FARTHEST) * least;
        if near(camera.eye, view) && (all || few && each()) { ShadowStart::Light } else { ShadowStart::Point }
    };
    description.lights.iter().map(start).collect()
}

/// The materials that some primitive wears.
fn used_materials(description: &Description) -> Vec<&Material> {
    let mut used = vec![false; description.materials.len()];
    let mut wear = |m: usize| {
        if let Some(used) = used.get_mut(m) {
            *used = true;
        }
    };
    each_kind!(description, |all| all.iter().for_each(|element| element.materials(&mut wear)));
    description.materials.iter().zip(used).filter_map(|(material, used)| used.then_some(material)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Sphere;

    /// Lights at so many places, and spheres at so many.
    fn scene(lights: [f32; 2], spheres: [f32; 2], count: usize) -> Description {
        let at = |[from, to]: [f32; 2], i: usize| Vec3::X * if i.is_multiple_of(2) { from } else { to };
        let sphere = |i| Sphere { center: at(spheres, i), radius: 1.0, sides: Sides::Both, material: 0 };
        let light = |i| Light { position: at(lights, i), power: Vec3::ONE };
        let mut description = Description {
            lights: (0..count).map(light).collect(),
            spheres: (0..count).map(sphere).collect(),
            ..Description::default()
        };
        // Of the eye only what it looks at counts.
        description.camera.look_at = Vec3::Z * 1e9;
        description
    }

    /// From 1024 sizes on a light is far: from the farther of the spheres, if not from the nearer.
    #[test]
    fn far_lights_start_at_the_point() {
        use ShadowStart::{Light, Point};
        for (spheres, expected) in [([0.0, 0.0], [Light, Point]), ([2000.0, 900.0], [Point, Light])] {
            let starts = shadow_starts(&scene([0.0, 1100.0], spheres, 10));
            assert_eq!(starts[..2], expected, "{spheres:?}");
        }
        assert_eq!(shadow_starts(&scene([0.0, 1e6], [0.0, 0.0], 1)), [Light]);
    }

    /// One by one, these would be 2³⁴ questions. Where the box around all does not answer them, the point is right.
    #[test]
    fn many_lights_and_spheres_take_linear_time() {
        use ShadowStart::{Light, Point};
        let count = 1 << 17;
        assert_eq!(shadow_starts(&scene([0.0, 1100.0], [0.0, 0.0], count))[..2], [Light, Point]);
        let mut sizes = scene([500.0, 0.0], [0.0, 600.0], count);
        assert_eq!(shadow_starts(&sizes)[..2], [Light, Light]);
        sizes.spheres[0].radius = 0.5;
        // Near to each, but not to the smallest wherever it were.
        assert_eq!(shadow_starts(&sizes)[..2], [Light, Point]);
    }
}
