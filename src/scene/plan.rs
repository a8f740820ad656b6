//! What a scene needs of the tracer, decided once when it is compiled.

use std::fmt;

use super::{Description, Pigment};

/// What the tracer will do for a scene, each with its reason; what is absent costs nothing.
#[derive(Clone, Debug, PartialEq)]
pub struct Plan {
    /// The numbers of planes, spheres and triangles.
    pub primitives: [usize; 3],
    /// How many segments a path may have: 1 where nothing reflects, else the scene's `max_depth`.
    pub waves: u32,
    /// Whether any material has a highlight, so that the Phong term is evaluated.
    pub highlights: bool,
    /// Whether any material has a checkerboard.
    pub checkers: bool,
    lights: usize,
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
            checkers: count(&|m| matches!(m.pigment, Pigment::Checker { .. })) > 0,
            lights: description.lights.len(),
            mirrors,
            materials: used.iter().filter(|u| **u).count(),
        }
    }
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
            writeln!(f, "planes      {planes}: unbounded, tested by every packet")?;
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
        match self.lights {
            0 => writeln!(f, "shadows     none: there is no light")?,
            n => writeln!(
                f,
                "shadows     {n} streams a wave: one a light, fired from it so that its rays share their origin"
            )?,
        }
        writeln!(
            f,
            "highlights  {}",
            if self.highlights { "yes: a material is specular" } else { "no: no material is specular" }
        )?;
        write!(f, "checkers    {}", if self.checkers { "yes: a material has them" } else { "no: no material has them" })
    }
}
