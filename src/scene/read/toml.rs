//! The scene file format: TOML to [`Description`].

mod materials;
mod mesh;
mod primitives;
mod view;

use std::{collections::BTreeMap, path::Path};

use glam::Vec3;
use serde::Deserialize;
use toml::de::{DeTable, Deserializer};

use self::{
    materials::{MaterialFile, Names},
    mesh::MeshFile,
    primitives::{
        BoxFile, ConeFile, CylinderFile, FractalFile, PlaneFile, QuadFile, SphereFile, TorusFile, TriangleFile,
    },
    view::{CameraFile, LightFile, SettingsFile, SkyFile},
};
use super::{
    Progress, ReadError,
    assets::Assets,
    image::Images,
    obj, place,
    strict::{Exactly, Table},
};
use crate::scene::{Description, Invalid, check};

/// The most tables of a file without a header, as [`tables`] counts: more than the shortest primitives that fit into it.
/// A table takes about 1500 bytes of memory, and two bytes are enough to make one: `a.a.a`.
const MAX_TABLES: usize = 1 << 20;

type Triple = Exactly<f32, 3>;

impl From<Triple> for Vec3 {
    fn from(triple: Triple) -> Self {
        triple.0.into()
    }
}

impl From<Vec3> for Triple {
    fn from(v: Vec3) -> Self {
        Exactly(v.into())
    }
}

#[derive(Default, Deserialize)]
#[serde(default, deny_unknown_fields)]
struct SceneFile {
    camera: Table<CameraFile>,
    settings: Table<SettingsFile>,
    sky: Table<SkyFile>,
    light: Vec<Table<LightFile>>,
    materials: BTreeMap<String, Table<MaterialFile>>,
    plane: Vec<Table<PlaneFile>>,
    sphere: Vec<Table<SphereFile>>,
    triangle: Vec<Table<TriangleFile>>,
    quad: Vec<Table<QuadFile>>,
    r#box: Vec<Table<BoxFile>>,
    cylinder: Vec<Table<CylinderFile>>,
    cone: Vec<Table<ConeFile>>,
    torus: Vec<Table<TorusFile>>,
    fractal: Vec<Table<FractalFile>>,
    mesh: Vec<Table<MeshFile>>,
}

pub(super) fn parse(
    text: &str,
    file: &Path,
    assets: &Assets,
    progress: Progress<'_>,
) -> Result<Description, ReadError> {
    if tables(text) > MAX_TABLES {
        return Err(ReadError::File { path: file.into(), problem: format!("more than {MAX_TABLES} tables") });
    }
    let table = DeTable::parse(text).map_err(|error| syntax(text, file, &error))?;
    let table = Deserializer::from(table);
    let scene = SceneFile::deserialize(table).map_err(|error| shape(text, file, &error))?;
    let name = file.file_stem().unwrap_or_default().to_string_lossy().into_owned();
    describe(scene, name, assets, progress)
        .and_then(|description| check(&description).map(|()| description))
        .map_err(|Invalid { key, problem }| ReadError::at(file, place::line_of(text, &key), key, problem))
}

/// How many tables in braces or before dots the text makes: at least half of them, and more where comments and strings
/// look like tables.
fn tables(text: &str) -> usize {
    let (mut tables, mut dots) = (0, 0);
    for byte in text.bytes() {
        match byte {
            b'\n' | b'=' | b',' | b'[' => dots = 0,
            b'{' => (tables, dots) = (tables + 1, 0),
            b'.' => {
                // The first may be a number's.
                tables += usize::from(dots > 0);
                dots += 1;
            }
            _ => {}
        }
    }
    tables
}

/// A fault in the text as TOML.
fn syntax(text: &str, file: &Path, error: &toml::de::Error) -> ReadError {
    let (line, key) = place::quote(text.as_bytes(), error.span().map_or(0, |span| span.start));
    ReadError::at(file, line, key, format_args!("invalid TOML: {}", error.message()))
}

/// A key that is unknown or missing, or a value of the wrong type.
fn shape(text: &str, file: &Path, error: &toml::de::Error) -> ReadError {
    let span = error.span().unwrap_or(0..0);
    let line = place::line_at(text.as_bytes(), span.start);
    let key = place::key_at(text, &span).unwrap_or_else(|| "scene".into());
    let message = error.message();
    if let Some(missing) = message.strip_prefix("missing field `").and_then(|rest| rest.strip_suffix('`')) {
        return ReadError::at(file, line, format_args!("{key}.{missing}"), "missing");
    }
    if let Some((_, expected)) = message.strip_prefix("unknown field `").and_then(|rest| rest.split_once("`, ")) {
        return ReadError::at(file, line, key, format_args!("unknown key, {expected}"));
    }
    // Rust's type names mean nothing to who writes a scene.
    let words = [("f32", "a number"), ("u32", "a whole number"), ("a sequence", "an array"), ("a map", "a table")];
    let words = words.map(|(rust, plain)| (format!("expected {rust}"), format!("expected {plain}")));
    let problem =
        words.iter().find_map(|(rust, plain)| Some(format!("{}{plain}", message.strip_suffix(rust.as_str())?)));
    ReadError::at(file, line, key, problem.as_deref().unwrap_or(message))
}

fn describe(scene: SceneFile, name: String, assets: &Assets, progress: Progress<'_>) -> Result<Description, Invalid> {
    let mut images = Images::new(assets);
    let mut names = Names::new(scene.materials, &mut images)?;
    let mut description = Description {
        name,
        camera: scene.camera.0.describe(),
        settings: scene.settings.0.describe(),
        sky: scene.sky.0.describe(&mut images)?,
        lights: scene.light.into_iter().map(|Table(light)| light.describe()).collect(),
        ..Description::default()
    };
    // In this order the materials that the file does not define get their numbers.
    description.planes = each("plane", scene.plane, |p| p.describe(&mut names))?;
    description.spheres = each("sphere", scene.sphere, |s| s.describe(&mut names))?;
    let mut budget = obj::Budget::default();
    description.meshes =
        each("mesh", scene.mesh, |m| m.describe(assets, &mut names, &mut images, &mut budget, progress))?;
    description.meshes.extend(each("triangle", scene.triangle, |t| t.describe(&mut names))?);
    description.quads = each("quad", scene.quad, |q| q.describe(&mut names))?;
    description.cuboids = each("box", scene.r#box, |b| b.describe(&mut names))?;
    description.cylinders = each("cylinder", scene.cylinder, |c| c.describe(&mut names))?;
    description.cones = each("cone", scene.cone, |c| c.describe(&mut names))?;
    description.tori = each("torus", scene.torus, |t| t.describe(&mut names))?;
    description.fractals = each("fractal", scene.fractal, |f| f.describe(&mut names))?;
    description.materials = names.materials;
    description.textures = images.textures;
    Ok(description)
}

/// What is wrong with a key of an element.
struct Fault(&'static str, String);

/// Turns the elements of the array `name` into primitives.
fn each<F, P>(
    name: &str,
    elements: Vec<Table<F>>,
    mut primitive: impl FnMut(F) -> Result<P, Fault>,
) -> Result<Vec<P>, Invalid> {
    let one = |(i, Table(element))| {
        primitive(element).map_err(|Fault(key, problem)| Invalid { key: format!("{name}[{i}].{key}"), problem })
    };
    elements.into_iter().enumerate().map(one).collect()
}

#[cfg(test)]
mod tests {
    use super::{MAX_TABLES, tables};
    use crate::scene::MAX_TOML_BYTES;

    #[test]
    fn numbers_and_arrays_are_no_tables() {
        assert_eq!(tables("sphere=[{center=[.5,0.,-1.5],radius=1.0},{ center = [1.25, 0, [[2.5]]] }]"), 2);
        assert_eq!(tables("[a.b.c]\n x = [\n 1.5,\n 2.5\n]\n[[c]]\ny.z = 0"), 1);
        assert_eq!(tables("a . b.c.d = 1\n{x.y={z=3.5}}"), 4);
    }

    #[test]
    fn the_shortest_primitives_fit() {
        let shortest = "{center=[0,0,0],radius=1},";
        assert_eq!(tables(shortest), 1);
        assert!(MAX_TOML_BYTES as usize / shortest.len() < MAX_TABLES);
    }
}
