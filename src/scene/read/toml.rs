//! The scene file format: TOML to [`Description`].

use std::{
    collections::{BTreeMap, HashMap},
    path::Path,
};

use glam::{Vec2, Vec3};
use serde::Deserialize;
use toml::de::{DeTable, Deserializer};

use super::{
    Progress, ReadError,
    assets::Assets,
    image::Images,
    obj, place,
    strict::{Exactly, Table},
};
use crate::scene::{
    CameraDescription, Cone, Cuboid, Cylinder, Description, Dome, Fractal, Invalid, Light, Material, Mesh, Pigment,
    Plane, Quad, Settings, Sides, Sky, Sphere, Torus, check,
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
    triangle: Vec<Table<TriangleFile>>,
    quad: Vec<Table<QuadFile>>,
    r#box: Vec<Table<BoxFile>>,
    cylinder: Vec<Table<CylinderFile>>,
    cone: Vec<Table<ConeFile>>,
    torus: Vec<Table<TorusFile>>,
    fractal: Vec<Table<FractalFile>>,
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

#[derive(Default, Deserialize)]
#[serde(default, deny_unknown_fields)]
struct SkyFile {
    color: Option<Triple>,
    gradient: Option<Exactly<Triple, 2>>,
    image: Option<String>,
    rotation: Option<f32>,
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
    texture: Option<String>,
    texture_size: Option<f32>,
    reflectance: f32,
    transmission: f32,
    ior: f32,
    absorption: Triple,
    specular: f32,
    shininess: f32,
}

impl Default for MaterialFile {
    fn default() -> Self {
        let Material { reflectance, transmission, ior, absorption, specular, shininess, .. } = Material::default();
        Self {
            color: None,
            checker: None,
            texture: None,
            texture_size: None,
            reflectance,
            transmission,
            ior,
            absorption: absorption.into(),
            specular,
            shininess,
        }
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
struct TriangleFile {
    vertices: Exactly<Triple, 3>,
    normals: Option<Exactly<Triple, 3>>,
    uvs: Option<Exactly<Exactly<f32, 2>, 3>>,
    material: Option<String>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct QuadFile {
    corner: Triple,
    u: Triple,
    v: Triple,
    material: Option<String>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct BoxFile {
    min: Triple,
    max: Triple,
    rotation: Option<Triple>,
    material: Option<String>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct CylinderFile {
    base: Triple,
    apex: Triple,
    radius: f32,
    #[serde(default)]
    caps: bool,
    material: Option<String>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct ConeFile {
    base: Triple,
    base_radius: f32,
    apex: Triple,
    apex_radius: f32,
    #[serde(default)]
    caps: bool,
    material: Option<String>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct TorusFile {
    center: Triple,
    axis: Triple,
    major_radius: f32,
    minor_radius: f32,
    material: Option<String>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct FractalFile {
    center: Triple,
    radius: f32,
    iterations: u32,
    material: Option<String>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct MeshFile {
    file: String,
    scale: Option<f32>,
    rotation: Option<Triple>,
    translation: Option<Triple>,
    material: Option<String>,
}

pub(super) fn parse(
    text: &str,
    file: &Path,
    assets: &Assets,
    progress: Progress<'_>,
) -> Result<Description, ReadError> {
    let table = DeTable::parse(text).map_err(|error| syntax(text, file, &error))?;
    let table = Deserializer::from(table);
    let scene = SceneFile::deserialize(table).map_err(|error| shape(text, file, &error))?;
    let name = file.file_stem().unwrap_or_default().to_string_lossy().into_owned();
    describe(scene, name, assets, progress)
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

fn describe(scene: SceneFile, name: String, assets: &Assets, progress: Progress<'_>) -> Result<Description, Invalid> {
    let Table(CameraFile { eye, look_at, up, fov }) = scene.camera;
    let Table(SettingsFile { max_depth, attenuation, ambient }) = scene.settings;
    let lights = scene.light.into_iter().map(|Table(l)| Light { position: l.position.into(), power: l.power.into() });
    let mut images = Images::new(assets);
    let mut names = Names::new(scene.materials, &mut images)?;
    let mut description = Description {
        name,
        camera: CameraDescription { eye: eye.into(), look_at: look_at.into(), up: up.into(), fov },
        settings: Settings { max_depth, attenuation, ambient: ambient.into() },
        sky: sky(scene.sky.0, &mut images)?,
        lights: lights.collect(),
        ..Description::default()
    };
    description.planes = each("plane", scene.plane, |p| {
        Ok(Plane { normal: p.normal.into(), distance: p.distance, material: names.find(p.material)? })
    })?;
    description.spheres = each("sphere", scene.sphere, |s| {
        let material = names.find(s.material)?;
        Ok(Sphere { center: s.center.into(), radius: s.radius, sides: Sides::Both, material })
    })?;
    let mut budget = obj::Budget::default();
    description.meshes = each("mesh", scene.mesh, |m| {
        let material = m.material.map(|name| names.find(Some(name))).transpose()?;
        // Materials that count for nothing need not be there.
        let wanted = if material.is_none() { Some(&mut images) } else { None };
        let mut model =
            obj::read(assets, &m.file, wanted, &mut budget, progress).map_err(|e| Fault("file", e.to_string()))?;
        place_mesh(&mut model.mesh, m.scale, m.rotation, m.translation)?;
        if let Some(material) = material {
            return Ok(Mesh { material, ..model.mesh });
        }
        let default = if model.bare { names.find(None)? } else { 0 };
        let file = Path::new(&m.file).file_name().unwrap_or_default().to_string_lossy();
        Ok(model.merge(default, |m| names.add(Material { name: format!("{file}:{}", m.name), ..m })))
    })?;
    let triangles = each("triangle", scene.triangle, |t| {
        let corners = t.vertices.0.map(Vec3::from);
        check::triangle(corners).map_err(|problem| Fault("vertices", problem))?;
        Ok(Mesh {
            positions: corners.into(),
            normals: t.normals.map(|n| n.0.map(Vec3::from).into()).unwrap_or_default(),
            uvs: t.uvs.map(|uvs| uvs.0.map(|uv| Vec2::from(uv.0)).into()).unwrap_or_default(),
            triangles: vec![[0, 1, 2]],
            material: names.find(t.material)?,
            ..Mesh::default()
        })
    })?;
    description.meshes.extend(triangles);
    description.quads = each("quad", scene.quad, |q| {
        Ok(Quad { corner: q.corner.into(), u: q.u.into(), v: q.v.into(), material: names.find(q.material)? })
    })?;
    description.cuboids = each("box", scene.r#box, |b| {
        let rotation = b.rotation.map(Vec3::from).unwrap_or_default();
        Ok(Cuboid { min: b.min.into(), max: b.max.into(), rotation, material: names.find(b.material)? })
    })?;
    description.cylinders = each("cylinder", scene.cylinder, |c| {
        let material = names.find(c.material)?;
        let (base, apex) = (c.base.into(), c.apex.into());
        Ok(Cylinder { base, apex, radius: c.radius, caps: c.caps, sides: Sides::Both, material })
    })?;
    description.cones = each("cone", scene.cone, |c| {
        Ok(Cone {
            base: c.base.into(),
            base_radius: c.base_radius,
            apex: c.apex.into(),
            apex_radius: c.apex_radius,
            caps: c.caps,
            sides: Sides::Both,
            material: names.find(c.material)?,
        })
    })?;
    description.tori = each("torus", scene.torus, |t| {
        Ok(Torus {
            center: t.center.into(),
            axis: t.axis.into(),
            major_radius: t.major_radius,
            minor_radius: t.minor_radius,
            material: names.find(t.material)?,
        })
    })?;
    description.fractals = each("fractal", scene.fractal, |f| {
        let material = names.find(f.material)?;
        Ok(Fractal { center: f.center.into(), radius: f.radius, iterations: f.iterations, material })
    })?;
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

fn sky(file: SkyFile, images: &mut Images<'_>) -> Result<Sky, Invalid> {
    let SkyFile { color, gradient, image, rotation } = file;
    let given = usize::from(color.is_some()) + usize::from(gradient.is_some()) + usize::from(image.is_some());
    let invalid = |key: &str, problem: String| Invalid { key: format!("sky.{key}"), problem };
    if given > 1 {
        let key = if image.is_some() { "image" } else { "gradient" };
        return Err(invalid(key, "only one of color, gradient and image".into()));
    }
    if rotation.is_some() && image.is_none() {
        return Err(invalid("rotation", "only goes with image".into()));
    }
    if let Some(file) = image {
        let (width, height, texels) = images.panorama(&file).map_err(|error| invalid("image", error.to_string()))?;
        let dome = Dome { width, height, texels, rotation: rotation.unwrap_or(0.0) };
        return Ok(Sky::Dome(dome.into()));
    }
    Ok(match gradient {
        Some(Exactly([below, above])) => Sky::Gradient { below: below.into(), above: above.into() },
        None => Sky::Color(color.map(Vec3::from).unwrap_or_default()),
    })
}

/// Scales, then turns about x, y and z, then moves.
fn place_mesh(
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

fn material((name, Table(file)): (String, Table<MaterialFile>), images: &mut Images<'_>) -> Result<Material, Invalid> {
    let MaterialFile { color, checker, texture, texture_size, reflectance, transmission, .. } = file;
    let invalid =
        |key: &str, problem: String| Invalid { key: format!("materials.{}.{key}", check::key_part(&name)), problem };
    if usize::from(color.is_some()) + usize::from(checker.is_some()) + usize::from(texture.is_some()) > 1 {
        let key = if checker.is_some() { "checker" } else { "texture" };
        return Err(invalid(key, "only one of color, checker and texture".into()));
    }
    if texture_size.is_some() && texture.is_none() {
        return Err(invalid("texture_size", "only goes with texture".into()));
    }
    let pigment = match (color, checker, texture) {
        (Some(c), ..) => Pigment::Color(c.into()),
        (_, Some(Table(c)), _) => Pigment::Checker { colors: c.colors.0.map(Vec3::from), size: c.size },
        (.., Some(file)) => {
            let texture = images.texture(&file).map_err(|error| invalid("texture", error.to_string()))?;
            Pigment::Texture { texture, size: texture_size.unwrap_or(1.0) }
        }
        _ => Pigment::Color(Vec3::splat(0.8)),
    };
    let MaterialFile { ior, absorption, specular, shininess, .. } = file;
    let absorption = absorption.into();
    Ok(Material { name, pigment, reflectance, transmission, ior, absorption, additive: false, specular, shininess })
}

/// The materials: first those of the file, sorted by name, then those of mesh files and the default, where it is
/// used and not among them.
struct Names {
    materials: Vec<Material>,
    named: usize,
    default: Option<usize>,
    /// How often mesh files gave a name.
    repeats: HashMap<String, usize>,
}

impl Names {
    fn new(materials: BTreeMap<String, Table<MaterialFile>>, images: &mut Images<'_>) -> Result<Self, Invalid> {
        let materials = materials.into_iter().map(|m| material(m, images)).collect::<Result<Vec<_>, _>>()?;
        Ok(Self { named: materials.len(), materials, default: None, repeats: HashMap::new() })
    }

    /// Adds the material of a mesh file; a name that is taken gets a number.
    fn add(&mut self, material: Material) -> usize {
        let Material { name: wanted, .. } = &material;
        let name = loop {
            let repeats = self.repeats.entry(wanted.clone()).or_insert(0);
            *repeats += 1;
            let name = if *repeats == 1 { wanted.clone() } else { format!("{wanted}#{repeats}") };
            let named = self.materials[..self.named].binary_search_by(|m| m.name.cmp(&name)).is_ok();
            if !named && (name == *wanted || !self.repeats.contains_key(&name)) {
                break name;
            }
        };
        self.materials.push(Material { name, ..material });
        self.materials.len() - 1
    }

    fn find(&mut self, name: Option<String>) -> Result<usize, Fault> {
        let wanted = name.as_deref().unwrap_or(DEFAULT_MATERIAL);
        match self.materials[..self.named].binary_search_by(|m| m.name.as_str().cmp(wanted)) {
            Ok(index) => Ok(index),
            Err(_) if wanted == DEFAULT_MATERIAL => {
                let materials = &mut self.materials;
                Ok(*self.default.get_or_insert_with(|| {
                    materials.push(Material { name: wanted.into(), ..Material::default() });
                    materials.len() - 1
                }))
            }
            Err(_) => Err(Fault("material", self.missing(wanted))),
        }
    }

    fn missing(&self, wanted: &str) -> String {
        let near = self.materials[..self.named].iter().map(|m| (edits(&m.name, wanted), &m.name)).min();
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
