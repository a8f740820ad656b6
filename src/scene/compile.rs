//! From a [`Description`] to the arrays that are traced.

use super::{Description, Invalid, Light, Material, Plan, Settings, Sky, check};
use crate::geometry::{Planes, Spheres, Triangles};

/// A compiled scene: SoA arrays, ready to trace.
///
/// Primitive ids run through planes, then spheres, then triangles.
#[derive(Clone, Debug)]
pub struct Scene {
    /// Planes, ids from 0.
    pub planes: Planes,
    /// Spheres, ids from [`Scene::first_sphere`].
    pub spheres: Spheres,
    /// Triangles, ids from [`Scene::first_triangle`].
    pub triangles: Triangles,
    /// Materials, by index.
    pub materials: Vec<Material>,
    /// Point lights.
    pub lights: Vec<Light>,
    /// What a ray that hits nothing sees.
    pub sky: Sky,
    /// Depth, light fall-off, ambient light.
    pub settings: Settings,
    /// What the scene needs, and why.
    pub plan: Plan,
}

impl Scene {
    /// The first sphere's id.
    pub fn first_sphere(&self) -> u32 {
        self.planes.len() as u32
    }

    /// The first triangle's id.
    pub fn first_triangle(&self) -> u32 {
        (self.planes.len() + self.spheres.len()) as u32
    }
}

/// Compiles a description into SoA arrays.
///
/// # Errors
/// [`Invalid`] when [`check`] finds fault with it.
pub fn compile(description: &Description) -> Result<Scene, Invalid> {
    check(description)?;
    let mut planes = Planes::default();
    for p in &description.planes {
        planes.push(p.normal, p.distance, p.material as u32);
    }
    let mut spheres = Spheres::default();
    for s in &description.spheres {
        spheres.push(s.center, s.radius, s.material as u32);
    }
    let mut triangles = Triangles::default();
    for mesh in &description.meshes {
        for corners in &mesh.triangles {
            triangles.push(corners.map(|i| mesh.positions[i as usize]), mesh.material as u32);
        }
    }
    Ok(Scene {
        planes,
        spheres,
        triangles,
        materials: description.materials.clone(),
        lights: description.lights.clone(),
        sky: description.sky,
        settings: description.settings,
        plan: Plan::of(description),
    })
}
