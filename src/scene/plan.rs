//! What a scene needs of the tracer, decided once when it is compiled.

use std::fmt;

use glam::Vec3;

use super::Description;

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

/// What the tracer will do for a scene, each with its reason; what is absent costs nothing.
#[derive(Clone, Debug, PartialEq)]
pub struct Plan {
    /// The numbers of planes, spheres and triangles.
    pub primitives: [usize; 3],
    /// How many segments a path may have: 1 where nothing reflects, else the scene's `max_depth`.
    pub waves: u32,
    /// Whether any material has a highlight, so that the Phong term is evaluated.
    pub highlights: bool,
    /// Where each light's shadow rays start.
    pub shadows: Vec<ShadowStart>,
    mirrors: usize,
    materials: usize,
}

impl Plan {
    /// The plan for a description.
    pub fn of(description: &Description) -> Self {
        let used = used_materials(description);
        let count = |has: &dyn Fn(&super::Material) -> bool| {
            description.materials.iter().zip(&used).filter(|(m, u)| **u && has(m)).count()
        };
        let triangles = description.meshes.iter().map(|m| m.triangles.len()).sum();
        let mirrors = count(&|m| m.reflectance > 0.0);
        Self {
            primitives: [description.planes.len(), description.spheres.len(), triangles],
            waves: if mirrors == 0 { 1 } else { description.settings.max_depth },
            highlights: count(&|m| m.specular > 0.0) > 0,
            shadows: description.lights.iter().map(|l| shadow_start(description, l.position)).collect(),
            mirrors,
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
    let meshes = description.meshes.iter().all(|mesh| {
        mesh.triangles.iter().all(|corners| {
            let [a, b, c] = corners.map(|i| mesh.positions[i as usize]);
            let [u, v] = [b - a, c - a].map(|e| e.as_dvec3());
            let least_height = u.cross(v).length() / u.length().max(v.length()).max((v - u).length());
            // A triangle without area casts no shadow.
            least_height.is_nan() || least_height == 0.0 || [a, b, c].iter().all(|&p| near(p, least_height))
        })
    });
    if spheres && meshes && near(camera.eye, view) { ShadowStart::Light } else { ShadowStart::Point }
}

/// Which materials some primitive wears.
fn used_materials(description: &Description) -> Vec<bool> {
    let mut used = vec![false; description.materials.len()];
    let planes = description.planes.iter().map(|p| p.material);
    let spheres = description.spheres.iter().map(|s| s.material);
    let meshes = description.meshes.iter().map(|m| m.material);
    for m in planes.chain(spheres).chain(meshes) {
        if let Some(used) = used.get_mut(m) {
            *used = true;
        }
    }
    used
}

impl fmt::Display for Plan {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let [planes, spheres, triangles] = self.primitives;
        if planes > 0 {
            writeln!(f, "planes      {planes}: unbounded; left out where no ray of a batch turns to it")?;
        }
        if spheres > 0 {
            writeln!(f, "spheres     {spheres}: method `stable`, right from inside, on and far from a sphere")?;
        }
        if triangles > 0 {
            writeln!(f, "triangles   {triangles}: method `moller_trumbore`, seen from both sides")?;
        }
        writeln!(
            f,
            "structure   none: every batch of rays tests all that its origin ball and direction cone may meet"
        )?;
        match (self.waves, self.mirrors) {
            (_, 0) => writeln!(f, "waves       1: nothing reflects")?,
            (waves, n) => writeln!(f, "waves       {waves}: {n} of {} materials reflect; max_depth", self.materials)?,
        }
        let from_light = self.shadows.iter().filter(|s| **s == ShadowStart::Light).count();
        let from_point = self.shadows.len() - from_light;
        if from_light > 0 {
            writeln!(f, "shadows     {from_light} streams a wave from lights, so that their rays share an origin")?;
        }
        if from_point > 0 {
            writeln!(
                f,
                "shadows     {from_point} streams a wave towards lights over {FARTHEST} sizes from a primitive, or from \
                 what is seen: too far to aim at it from there"
            )?;
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
