//! The tables of single primitives.

use glam::{Vec2, Vec3};
use serde::Deserialize;

use super::{Fault, Triple, materials::Names};
use crate::scene::{
    Cone, Cuboid, Cylinder, Fractal, Mesh, Plane, Quad, Sides, Sphere, Torus, check, read::strict::Exactly,
};

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct PlaneFile {
    normal: Triple,
    distance: f32,
    material: Option<String>,
}

impl PlaneFile {
    pub(super) fn describe(self, names: &mut Names) -> Result<Plane, Fault> {
        Ok(Plane { normal: self.normal.into(), distance: self.distance, material: names.find(self.material)? })
    }
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct SphereFile {
    center: Triple,
    radius: f32,
    material: Option<String>,
}

impl SphereFile {
    pub(super) fn describe(self, names: &mut Names) -> Result<Sphere, Fault> {
        let material = names.find(self.material)?;
        Ok(Sphere { center: self.center.into(), radius: self.radius, sides: Sides::Both, material })
    }
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct TriangleFile {
    vertices: Exactly<Triple, 3>,
    normals: Option<Exactly<Triple, 3>>,
    uvs: Option<Exactly<Exactly<f32, 2>, 3>>,
    material: Option<String>,
}

impl TriangleFile {
    /// A mesh of one.
    pub(super) fn describe(self, names: &mut Names) -> Result<Mesh, Fault> {
        let corners = self.vertices.0.map(Vec3::from);
        check::triangle(corners).map_err(|problem| Fault("vertices", problem))?;
        Ok(Mesh {
            positions: corners.into(),
            normals: self.normals.map(|n| n.0.map(Vec3::from).into()).unwrap_or_default(),
            uvs: self.uvs.map(|uvs| uvs.0.map(|uv| Vec2::from(uv.0)).into()).unwrap_or_default(),
            triangles: vec![[0, 1, 2]],
            material: names.find(self.material)?,
            ..Mesh::default()
        })
    }
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct QuadFile {
    corner: Triple,
    u: Triple,
    v: Triple,
    material: Option<String>,
}

impl QuadFile {
    pub(super) fn describe(self, names: &mut Names) -> Result<Quad, Fault> {
        let material = names.find(self.material)?;
        Ok(Quad { corner: self.corner.into(), u: self.u.into(), v: self.v.into(), material })
    }
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct BoxFile {
    min: Triple,
    max: Triple,
    rotation: Option<Triple>,
    material: Option<String>,
}

impl BoxFile {
    pub(super) fn describe(self, names: &mut Names) -> Result<Cuboid, Fault> {
        let rotation = self.rotation.map(Vec3::from).unwrap_or_default();
        Ok(Cuboid { min: self.min.into(), max: self.max.into(), rotation, material: names.find(self.material)? })
    }
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct CylinderFile {
    base: Triple,
    apex: Triple,
    radius: f32,
    #[serde(default)]
    caps: bool,
    material: Option<String>,
}

impl CylinderFile {
    pub(super) fn describe(self, names: &mut Names) -> Result<Cylinder, Fault> {
        let material = names.find(self.material)?;
        let (base, apex) = (self.base.into(), self.apex.into());
        Ok(Cylinder { base, apex, radius: self.radius, caps: self.caps, sides: Sides::Both, material })
    }
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct ConeFile {
    base: Triple,
    base_radius: f32,
    apex: Triple,
    apex_radius: f32,
    #[serde(default)]
    caps: bool,
    material: Option<String>,
}

impl ConeFile {
    pub(super) fn describe(self, names: &mut Names) -> Result<Cone, Fault> {
        Ok(Cone {
            base: self.base.into(),
            base_radius: self.base_radius,
            apex: self.apex.into(),
            apex_radius: self.apex_radius,
            caps: self.caps,
            sides: Sides::Both,
            material: names.find(self.material)?,
        })
    }
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct TorusFile {
    center: Triple,
    axis: Triple,
    major_radius: f32,
    minor_radius: f32,
    material: Option<String>,
}

impl TorusFile {
    pub(super) fn describe(self, names: &mut Names) -> Result<Torus, Fault> {
        Ok(Torus {
            center: self.center.into(),
            axis: self.axis.into(),
            major_radius: self.major_radius,
            minor_radius: self.minor_radius,
            material: names.find(self.material)?,
        })
    }
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct FractalFile {
    center: Triple,
    radius: f32,
    iterations: u32,
    material: Option<String>,
}

impl FractalFile {
    pub(super) fn describe(self, names: &mut Names) -> Result<Fractal, Fault> {
        let material = names.find(self.material)?;
        Ok(Fractal { center: self.center.into(), radius: self.radius, iterations: self.iterations, material })
    }
}
