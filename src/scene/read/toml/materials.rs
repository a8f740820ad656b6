//! The tables of materials, and materials by name.

use std::collections::{BTreeMap, HashMap};

use glam::Vec3;

use super::value::{Fault, table};
use crate::scene::{Invalid, Material, Pigment, Wrap, read::image::Images, rules};

/// The material of a primitive that names none, unless the file defines one of this name.
const DEFAULT_MATERIAL: &str = "default";

table! {
    pub(super) struct MaterialFile {
        color: Option<Vec3>,
        checker: Option<CheckerFile>,
        texture: Option<String>,
        texture_size: Option<f32>,
        texture_wrap: Option<String>,
        reflectance: f32 = Material::default().reflectance,
        transmission: f32 = Material::default().transmission,
        ior: f32 = Material::default().ior,
        absorption: Vec3 = Material::default().absorption,
        specular: f32 = Material::default().specular,
        shininess: f32 = Material::default().shininess,
    }
}

table! {
    struct CheckerFile {
        colors: [Vec3; 2],
        size: f32,
    }
}

fn material((name, file): (String, MaterialFile), images: &mut Images<'_>) -> Result<Material, Invalid> {
    let MaterialFile { color, checker, texture, texture_size, texture_wrap, reflectance, transmission, .. } = file;
    let invalid =
        |key: &str, problem: String| Invalid { key: format!("materials.{}.{key}", rules::key_part(&name)), problem };
    if usize::from(color.is_some()) + usize::from(checker.is_some()) + usize::from(texture.is_some()) > 1 {
        let key = if checker.is_some() { "checker" } else { "texture" };
        return Err(invalid(key, "only one of color, checker and texture".into()));
    }
    for (key, given) in [("texture_size", texture_size.is_some()), ("texture_wrap", texture_wrap.is_some())] {
        if given && texture.is_none() {
            return Err(invalid(key, "only goes with texture".into()));
        }
    }
    let pigment = match (color, checker, texture) {
        (Some(c), ..) => Pigment::Color(c),
        (_, Some(c), _) => Pigment::Checker { colors: c.colors, size: c.size },
        (.., Some(file)) => {
            let texture = images.texture(&file).map_err(|error| invalid("texture", error.to_string()))?;
            let wrap = match texture_wrap.as_deref() {
                None => Wrap::Ends,
                Some("repeat") => Wrap::Repeat,
                Some("clamp") => Wrap::Clamp,
                Some(other) => {
                    return Err(invalid("texture_wrap", format!("no {other:?}; there are repeat and clamp")));
                }
            };
            Pigment::Texture { texture, size: texture_size.unwrap_or(1.0), wrap }
        }
        _ => Pigment::Color(Vec3::splat(0.8)),
    };
    let MaterialFile { ior, absorption, specular, shininess, .. } = file;
    Ok(Material { name, pigment, reflectance, transmission, ior, absorption, additive: false, specular, shininess })
}

/// The materials: first those of the file, sorted by name, then those of mesh files and the default, where it is
/// used and not among them.
pub(super) struct Names {
    pub(super) materials: Vec<Material>,
    named: usize,
    default: Option<usize>,
    /// How often mesh files gave a name.
    repeats: HashMap<String, usize>,
}

impl Names {
    pub(super) fn new(materials: BTreeMap<String, MaterialFile>, images: &mut Images<'_>) -> Result<Self, Invalid> {
        let materials = materials.into_iter().map(|m| material(m, images)).collect::<Result<Vec<_>, _>>()?;
        Ok(Self { named: materials.len(), materials, default: None, repeats: HashMap::new() })
    }

    /// Adds the material of a mesh file; a name that is taken gets a number.
    pub(super) fn add(&mut self, material: Material) -> usize {
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

    pub(super) fn find(&mut self, name: Option<String>) -> Result<usize, Fault> {
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
