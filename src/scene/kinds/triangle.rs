//! Triangles: meshes of them, from files, and single ones.

use glam::{Vec2, Vec3};

use super::{Kind, KindName, triangle_near};
use crate::bvh::Aabb;
use crate::geometry::methods::{Methods, TriangleMethod};
use crate::geometry::{Primitives, Triangles};
use crate::scene::rules::{At, direction, require, vertex};
use crate::scene::{Invalid, Sides};

/// Triangles that share vertices; the front is where the corners run counter-clockwise.
///
/// With vertex normals the shading normal is interpolated between their unit vectors, and turned to the side of the
/// geometric one that the ray sees. Lights are then seen from the surface that the vertices' tangent planes make, and not
/// from the triangle. (u, v) is interpolated from the vertices, or are the corner's barycentric coordinates where there are none:
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
    /// A material for every triangle, as indices into [`Description::materials`](crate::scene::Description::materials),
    /// or nothing when `material` is all.
    pub materials: Vec<u32>,
    /// Index into [`Description::materials`](crate::scene::Description::materials).
    pub material: usize,
}

impl Kind for Mesh {
    const NAME: KindName = KindName {
        one: "triangle",
        many: "triangles",
        method: "method `watertight`: no ray slips between triangles that share an edge or corner",
    };
    const KEY: &'static str = "mesh";
    const PLAIN: bool = true;
    type Storage = Triangles;

    fn check(&self, at: &At) -> Result<(), Invalid> {
        self.check_vertices(at)?;
        self.check_triangles(at)?;
        at.material(self.material)?;
        self.materials
            .iter()
            .enumerate()
            .try_for_each(|(k, &m)| at.material_of(format_args!("materials[{k}]"), m as usize))
    }
    fn materials(&self, wear: &mut impl FnMut(usize)) {
        match self.materials.is_empty() {
            true => wear(self.material),
            false => self.materials.iter().for_each(|&m| wear(m as usize)),
        }
    }
    fn near(&self, near: &impl Fn(Vec3, f64) -> bool) -> bool {
        self.triangles.iter().all(|corners| {
            let [a, b, c] = corners.map(|i| self.positions[i as usize]);
            triangle_near(a, b - a, c - a, near)
        })
    }
    fn sides(&self) -> Sides {
        self.sides
    }
    fn count(&self) -> usize {
        self.triangles.len()
    }

    /// Adds its triangles, and to those what its vertices have.
    fn store(&self, to: &mut Triangles) {
        let [normals, uvs] = [to.normals.values.len(), to.uvs.values.len()].map(|n| n as u32);
        // In f64, where no square overflows or vanishes.
        to.normals.values.extend(self.normals.iter().map(|n| n.as_dvec3().normalize().as_vec3()));
        to.uvs.values.extend(&self.uvs);
        for (k, corners) in self.triangles.iter().enumerate() {
            let i = to.len();
            let material = self.materials.get(k).copied().unwrap_or(self.material as u32);
            to.push(corners.map(|c| self.positions[c as usize]), self.sides, material);
            if !self.normals.is_empty() {
                to.normals.set(i, corners.map(|c| c + normals));
            }
            if !self.uvs.is_empty() {
                to.uvs.set(i, corners.map(|c| c + uvs));
            }
        }
    }
    fn set_methods(to: &mut Triangles, methods: &Methods) {
        to.method = methods.triangle;
    }
    fn bounds(_: &Triangles, _: usize) -> Option<Aabb> {
        None
    }

    fn other_method(methods: &Methods) -> Option<&'static str> {
        (methods.triangle != TriangleMethod::default()).then(|| methods.triangle.name())
    }
}

impl Mesh {
    fn check_vertices(&self, at: &At) -> Result<(), Invalid> {
        for (i, p) in self.positions.iter().enumerate() {
            at.rule(format_args!("positions[{i}]"), vertex(*p))?;
        }
        let known = self.positions.len();
        for (columns, name) in [(self.normals.len(), "normals"), (self.uvs.len(), "uvs")] {
            at.rule(name, require([0, known].contains(&columns), || format!("{columns} for {known} vertices")))?;
        }
        for (i, n) in self.normals.iter().enumerate() {
            at.rule(format_args!("normals[{i}]"), direction(*n))?;
        }
        for (i, uv) in self.uvs.iter().enumerate() {
            let finite = require(uv.is_finite(), || format!("must be finite, got [{}, {}]", uv.x, uv.y));
            at.rule(format_args!("uvs[{i}]"), finite)?;
        }
        Ok(())
    }

    fn check_triangles(&self, at: &At) -> Result<(), Invalid> {
        let [materials, triangles] = [self.materials.len(), self.triangles.len()];
        let fit = [0, triangles].contains(&materials);
        at.rule("materials", require(fit, || format!("{materials} for {triangles} triangles")))?;
        let known = self.positions.len();
        for (i, corners) in self.triangles.iter().enumerate() {
            for &corner in corners {
                let exists = (corner as usize) < known;
                let verdict = require(exists, || format!("vertex {corner} of {known} does not exist"));
                at.rule(format_args!("triangles[{i}]"), verdict)?;
            }
        }
        Ok(())
    }
}

/// How a scene file holds it.
#[cfg(feature = "files")]
mod table {
    use std::path::Path;

    use glam::{Vec2, Vec3};

    use super::{Kind, Mesh};
    use crate::scene::Material;
    use crate::scene::read::toml::elements::{Array, Element, Fault, Readable, Reader, table};
    use crate::scene::rules::{area, vertex};

    table! {
        /// The table of a mesh file, and where it goes.
        pub(crate) struct MeshFile {
            file: String,
            scale: Option<f32>,
            rotation: Option<Vec3>,
            translation: Option<Vec3>,
            material: Option<String>,
        }
    }

    impl Element for MeshFile {
        type Kind = Mesh;
        const KEY: &'static str = Mesh::KEY;

        fn describe(self, reader: &mut Reader<'_>) -> Result<Mesh, Fault> {
            let material = self.material.map(|name| reader.material(Some(name))).transpose()?;
            // Materials that count for nothing need not be there.
            let mut model = reader.model(&self.file, material.is_none()).map_err(|problem| Fault("file", problem))?;
            put(&mut model.mesh, self.scale, self.rotation, self.translation)?;
            if let Some(material) = material {
                return Ok(Mesh { material, ..model.mesh });
            }
            let default = if model.bare { reader.material(None)? } else { 0 };
            let file = Path::new(&self.file).file_name().unwrap_or_default().to_string_lossy();
            Ok(model.merge(default, |m| reader.add(Material { name: format!("{file}:{}", m.name), ..m })))
        }
    }

    /// Scales, then turns about x, y and z, then moves.
    fn put(
        mesh: &mut Mesh,
        scale: Option<f32>,
        rotation: Option<Vec3>,
        translation: Option<Vec3>,
    ) -> Result<(), Fault> {
        let scale = f64::from(scale.unwrap_or(1.0));
        if !(scale > 0.0 && scale.is_finite()) {
            return Err(Fault("scale", format!("must be above 0 and finite, got {scale}")));
        }
        let degrees = rotation.unwrap_or_default();
        if !degrees.is_finite() {
            return Err(Fault("rotation", "must be finite".into()));
        }
        let [x, y, z] = degrees.as_dvec3().to_array().map(f64::to_radians);
        let turn = glam::DMat3::from_rotation_z(z) * glam::DMat3::from_rotation_y(y) * glam::DMat3::from_rotation_x(x);
        let to = translation.unwrap_or_default().as_dvec3();
        for p in &mut mesh.positions {
            *p = (turn * (p.as_dvec3() * scale) + to).as_vec3();
            vertex(*p).map_err(|problem| Fault("translation", format!("a vertex {problem}")))?;
        }
        for n in &mut mesh.normals {
            *n = (turn * n.as_dvec3()).as_vec3();
        }
        Ok(())
    }

    table! {
        /// The table of a single triangle.
        pub(crate) struct TriangleFile {
            vertices: [Vec3; 3],
            normals: Option<[Vec3; 3]>,
            uvs: Option<[Vec2; 3]>,
            material: Option<String>,
        }
    }

    impl Element for TriangleFile {
        type Kind = Mesh;
        const KEY: &'static str = Mesh::NAME.one;

        /// A mesh of one.
        fn describe(self, reader: &mut Reader<'_>) -> Result<Mesh, Fault> {
            let corners = self.vertices;
            let [a, b, c] = corners;
            corners
                .into_iter()
                .try_for_each(vertex)
                .and_then(|()| area(b - a, c - a))
                .map_err(|problem| Fault("vertices", problem))?;
            Ok(Mesh {
                positions: corners.into(),
                normals: self.normals.map(Vec::from).unwrap_or_default(),
                uvs: self.uvs.map(Vec::from).unwrap_or_default(),
                triangles: vec![[0, 1, 2]],
                material: reader.material(self.material)?,
                ..Mesh::default()
            })
        }
    }

    impl Readable for Mesh {
        type Elements = (Array<MeshFile>, Array<TriangleFile>);
    }
}
