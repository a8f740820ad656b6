//! The table of a mesh file, and where it goes.

use std::path::Path;

use glam::Vec3;
use serde::Deserialize;

use super::{Fault, Triple, materials::Names};
use crate::scene::{
    Material, Mesh, check,
    read::{Progress, assets::Assets, image::Images, obj},
};

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct MeshFile {
    file: String,
    scale: Option<f32>,
    rotation: Option<Triple>,
    translation: Option<Triple>,
    material: Option<String>,
}

impl MeshFile {
    pub(super) fn describe(
        self,
        assets: &Assets,
        names: &mut Names,
        images: &mut Images<'_>,
        budget: &mut obj::Budget,
        progress: Progress<'_>,
    ) -> Result<Mesh, Fault> {
        let material = self.material.map(|name| names.find(Some(name))).transpose()?;
        // Materials that count for nothing need not be there.
        let wanted = if material.is_none() { Some(images) } else { None };
        let mut model =
            obj::read(assets, &self.file, wanted, budget, progress).map_err(|e| Fault("file", e.to_string()))?;
        place(&mut model.mesh, self.scale, self.rotation, self.translation)?;
        if let Some(material) = material {
            return Ok(Mesh { material, ..model.mesh });
        }
        let default = if model.bare { names.find(None)? } else { 0 };
        let file = Path::new(&self.file).file_name().unwrap_or_default().to_string_lossy();
        Ok(model.merge(default, |m| names.add(Material { name: format!("{file}:{}", m.name), ..m })))
    }
}

/// Scales, then turns about x, y and z, then moves.
fn place(
    mesh: &mut Mesh,
    scale: Option<f32>,
    rotation: Option<Triple>,
    translation: Option<Triple>,
) -> Result<(), Fault> {
    let scale = f64::from(scale.unwrap_or(1.0));
    if !(scale > 0.0 && scale.is_finite()) {
        return Err(Fault("scale", format!("must be above 0 and finite, got {scale}")));
    }
    let degrees = rotation.map(Vec3::from).unwrap_or_default();
    if !degrees.is_finite() {
        return Err(Fault("rotation", "must be finite".into()));
    }
    let [x, y, z] = degrees.as_dvec3().to_array().map(f64::to_radians);
    let turn = glam::DMat3::from_rotation_z(z) * glam::DMat3::from_rotation_y(y) * glam::DMat3::from_rotation_x(x);
    let to = translation.map(Vec3::from).unwrap_or_default().as_dvec3();
    for p in &mut mesh.positions {
        *p = (turn * (p.as_dvec3() * scale) + to).as_vec3();
        check::vertex(*p).map_err(|problem| Fault("translation", format!("a vertex {problem}")))?;
    }
    for n in &mut mesh.normals {
        *n = (turn * n.as_dvec3()).as_vec3();
    }
    Ok(())
}
