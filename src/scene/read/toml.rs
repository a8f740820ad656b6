//! The scene file format: TOML to [`Description`].

use std::{collections::BTreeMap, path::Path};

use glam::Vec3;
use serde::Deserialize;
use toml::de::{DeTable, Deserializer};

use super::{
    MAX_OBJ_BYTES, ReadError, obj, place,
    strict::{Exactly, Table},
};
use crate::scene::{
    CameraDescription, Description, Invalid, Light, Material, Mesh, Pigment, Plane, Settings, Sky, Sphere, check,
};

/// The material of a primitive that names none, unless the file defines one of this name.
const DEFAULT_MATERIAL: &str = "default";

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
    mesh: Vec<Table<MeshFile>>,
}

#[derive(Deserialize)]
#[serde(default, deny_unknown_fields)]
struct CameraFile {
    eye: Triple,
    look_at: Triple,
    up: Triple,
    fov: f32,
}

impl Default for CameraFile {
    fn default() -> Self {
        let CameraDescription { eye, look_at, up, fov } = CameraDescription::default();
        Self { eye: eye.into(), look_at: look_at.into(), up: up.into(), fov }
    }
}

#[derive(Deserialize)]
#[serde(default, deny_unknown_fields)]
struct SettingsFile {
    max_depth: u32,
    attenuation: bool,
    ambient: Triple,
}

impl Default for SettingsFile {
    fn default() -> Self {
        let Settings { max_depth, attenuation, ambient } = Settings::default();
        Self { max_depth, attenuation, ambient: ambient.into() }
    }
}

#[derive(Deserialize)]
#[serde(default, deny_unknown_fields)]
struct SkyFile {
    color: Triple,
}

impl Default for SkyFile {
    fn default() -> Self {
        Self { color: Sky::default().color.into() }
    }
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct LightFile {
    position: Triple,
    power: Triple,
}

#[derive(Deserialize)]
#[serde(default, deny_unknown_fields)]
struct MaterialFile {
    color: Option<Triple>,
    checker: Option<Table<CheckerFile>>,
    reflectance: f32,
    specular: f32,
    shininess: f32,
}

impl Default for MaterialFile {
    fn default() -> Self {
        Self { color: None, checker: None, reflectance: 0.0, specular: 0.0, shininess: 50.0 }
    }
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct CheckerFile {
    colors: Exactly<Triple, 2>,
    size: f32,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct PlaneFile {
    normal: Triple,
    distance: f32,
    material: Option<String>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct SphereFile {
    center: Triple,
    radius: f32,
    material: Option<String>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct MeshFile {
    file: String,
    material: Option<String>,
}

pub(super) fn parse(text: &str, file: &Path) -> Result<Description, ReadError> {
    let table = DeTable::parse(text).map_err(|error| syntax(text, file, &error))?;
    let table = Deserializer::from(table);
    let scene = SceneFile::deserialize(table).map_err(|error| shape(text, file, &error))?;
    let name = file.file_stem().unwrap_or_default().to_string_lossy().into_owned();
    describe(scene, name, file.parent().unwrap_or(Path::new("")))
        .and_then(|description| check(&description).map(|()| description))
        .map_err(|Invalid { key, problem }| ReadError::at(file, place::line_of(text, &key), key, problem))
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

fn describe(scene: SceneFile, name: String, folder: &Path) -> Result<Description, Invalid> {
    let Table(CameraFile { eye, look_at, up, fov }) = scene.camera;
    let Table(SettingsFile { max_depth, attenuation, ambient }) = scene.settings;
    let lights = scene.light.into_iter().map(|Table(l)| Light { position: l.position.into(), power: l.power.into() });
    let used = (scene.plane.iter().map(|t| &t.0.material))
        .chain(scene.sphere.iter().map(|t| &t.0.material))
        .chain(scene.mesh.iter().map(|t| &t.0.material));
    let default_is_used = used.map(|name| name.as_deref().unwrap_or(DEFAULT_MATERIAL)).any(|n| n == DEFAULT_MATERIAL);
    let names = Names::new(scene.materials, default_is_used)?;

    let mut planes = Vec::with_capacity(scene.plane.len());
    for (i, Table(p)) in scene.plane.into_iter().enumerate() {
        let material = names.find(p.material.as_deref(), || format!("plane[{i}].material"))?;
        planes.push(Plane { normal: p.normal.into(), distance: p.distance, material });
    }
    let mut spheres = Vec::with_capacity(scene.sphere.len());
    for (i, Table(s)) in scene.sphere.into_iter().enumerate() {
        let material = names.find(s.material.as_deref(), || format!("sphere[{i}].material"))?;
        spheres.push(Sphere { center: s.center.into(), radius: s.radius, material });
    }
    let mut meshes = Vec::with_capacity(scene.mesh.len());
    let mut budget = MAX_OBJ_BYTES;
    for (i, Table(m)) in scene.mesh.into_iter().enumerate() {
        let material = names.find(m.material.as_deref(), || format!("mesh[{i}].material"))?;
        let mesh = obj::read(&folder.join(&m.file), &mut budget)
            .map_err(|error| Invalid { key: format!("mesh[{i}].file"), problem: error.to_string() })?;
        meshes.push(Mesh { material, ..mesh });
    }
    Ok(Description {
        name,
        camera: CameraDescription { eye: eye.into(), look_at: look_at.into(), up: up.into(), fov },
        settings: Settings { max_depth, attenuation, ambient: ambient.into() },
        sky: Sky { color: scene.sky.0.color.into() },
        lights: lights.collect(),
        materials: names.0,
        planes,
        spheres,
        meshes,
    })
}

fn material((name, Table(file)): (String, Table<MaterialFile>)) -> Result<Material, Invalid> {
    let MaterialFile { color, checker, reflectance, specular, shininess } = file;
    let pigment = match (color, checker) {
        (Some(_), Some(_)) => {
            let key = format!("materials.{}.checker", check::key_part(&name));
            return Err(Invalid { key, problem: "either color or checker, not both".into() });
        }
        (None, Some(Table(c))) => Pigment::Checker { colors: c.colors.0.map(Vec3::from), size: c.size },
        (Some(c), None) => Pigment::Color(c.into()),
        (None, None) => Pigment::Color(Vec3::splat(0.8)),
    };
    Ok(Material { name, pigment, reflectance, specular, shininess })
}

/// The materials, sorted by name.
struct Names(Vec<Material>);

impl Names {
    fn new(mut materials: BTreeMap<String, Table<MaterialFile>>, default_is_used: bool) -> Result<Self, Invalid> {
        if default_is_used {
            materials.entry(DEFAULT_MATERIAL.into()).or_default();
        }
        materials.into_iter().map(material).collect::<Result<_, _>>().map(Self)
    }

    fn find(&self, name: Option<&str>, key: impl FnOnce() -> String) -> Result<usize, Invalid> {
        let wanted = name.unwrap_or(DEFAULT_MATERIAL);
        let found = self.0.binary_search_by(|m| m.name.as_str().cmp(wanted));
        found.map_err(|_| Invalid { key: key(), problem: self.missing(wanted) })
    }

    fn missing(&self, wanted: &str) -> String {
        let near = self.0.iter().map(|m| (edits(&m.name, wanted), &m.name)).min();
        match near.filter(|(edits, _)| *edits <= 2) {
            Some((_, name)) => format!("no material {wanted:?}, did you mean {name:?}?"),
            None => format!("no material {wanted:?}"),
        }
    }
}

/// How many letters differ between two names: replaced, added or left out.
fn edits(a: &str, b: &str) -> usize {
    const LONG: usize = 64;
    // The caller only minds two letters, each up to four bytes.
    if a.len() > LONG || a.len().abs_diff(b.len()) > 8 {
        return usize::MAX;
    }
    let b: Vec<char> = b.chars().collect();
    let mut row: Vec<usize> = (0..=b.len()).collect();
    for (i, x) in a.chars().enumerate() {
        let mut diagonal = row[0];
        row[0] = i + 1;
        for (j, y) in b.iter().enumerate() {
            let replaced = diagonal + usize::from(x != *y);
            diagonal = row[j + 1];
            row[j + 1] = replaced.min(row[j] + 1).min(diagonal + 1);
        }
    }
    row[b.len()]
}
