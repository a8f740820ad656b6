//! The materials of OBJ files.
//!
//! | MTL | [`Material`] |
//! |---|---|
//! | `Kd` | colour, linear; 0.8 without it |
//! | `map_Kd` | texture in place of the colour; `Kd` does not tint it, and options (`-s`, `-o`, `-clamp` …) are skipped |
//! | `Ks` | specular: the mean of the three; 0 without it and where `illum` is 0 or 1, which have no highlight |
//! | `Ns` | shininess, clamped to 1 to 10⁶ |
//! | `d`, else 1 − `Tr` | transmission: 1 − d |
//! | `Ni` | ior, clamped to 0.1 to 10; 1, straight on, without it |
//! | `illum` 3, 5 or 8 | reflectance: the mean of `Ks`, at most 1 − transmission |
//!
//! Reflection at glass (`illum` 4, 6, 7, 9) is what transmission brings with it. Everything else is ignored.

use std::{
    collections::{HashMap, HashSet},
    io::Read,
    path::{Path, PathBuf},
    rc::Rc,
};

use glam::Vec3;

use super::{budget::Budget, numbers::numbers};
use crate::files::Identity;
use crate::scene::{
    Material, Pigment, Wrap,
    read::{error::ReadError, image::Images, lines::Lines, source::Source},
    rules,
};

/// The materials of all libraries of an OBJ file. Where several have the same name, the first counts.
#[derive(Default)]
pub(super) struct Library {
    entries: HashMap<String, Entry>,
    /// The files that they are from, however they were spelled.
    files: HashSet<Identity>,
}

/// A material as its file gives it.
#[derive(Clone)]
struct Entry {
    file: Rc<Path>,
    diffuse: Option<Vec3>,
    specular: Option<Vec3>,
    shininess: Option<f32>,
    dissolve: Option<f32>,
    transparency: Option<f32>,
    ior: Option<f32>,
    model: Option<u32>,
    /// The file's name and the line that gives it.
    texture: Option<(String, usize)>,
}

impl Library {
    /// Adds the materials of a file, unless it has been read. An error is of the file as a whole ([`ReadError::Io`], [`ReadError::File`]) or
    /// of one of its lines.
    pub fn read(&mut self, path: &Path, budget: &mut Budget) -> Result<(), ReadError> {
        let source = Source::open(path)?;
        if !self.files.insert(source.identity.clone()) {
            return Ok(());
        }
        let (file, length) = source.within(budget.bytes)?;
        let mut ignore = |_, _| ();
        let lines = Lines::new(file, path, (budget.bytes, length), &mut ignore);
        budget.bytes -= self.read_lines(lines, path)?;
        Ok(())
    }

    /// Says how many bytes it read.
    pub(super) fn read_lines<R: Read>(&mut self, mut lines: Lines<'_, R>, path: &Path) -> Result<u64, ReadError> {
        let file: Rc<Path> = path.into();
        let mut current: Option<(String, Entry)> = None;
        while let Some((number, line)) = lines.next()? {
            let line = line.trim();
            let (key, rest) = line.split_once(|c: char| c.is_ascii_whitespace()).unwrap_or((line, ""));
            if key == "newmtl" {
                self.add(current.take());
                current = Some((rest.trim().into(), Entry::new(file.clone())));
            } else if let Some((_, entry)) = &mut current {
                entry.set(key, rest.trim(), number).map_err(|problem| ReadError::at(path, number, key, problem))?;
            }
        }
        self.add(current);
        Ok(lines.done())
    }

    fn add(&mut self, named: Option<(String, Entry)>) {
        if let Some((name, entry)) = named {
            self.entries.entry(name).or_insert(entry);
        }
    }

    /// The material of a name, if there is one. Its texture is looked for beside its file, then in `folder`.
    pub fn material(&self, name: &str, folder: &Path, images: &mut Images<'_>) -> Result<Option<Material>, ReadError> {
        self.entries.get(name).map(|entry| entry.material(name, folder, images)).transpose()
    }
}

impl Entry {
    fn new(file: Rc<Path>) -> Self {
        Self {
            file,
            diffuse: None,
            specular: None,
            shininess: None,
            dissolve: None,
            transparency: None,
            ior: None,
            model: None,
            texture: None,
        }
    }

    fn set(&mut self, key: &str, rest: &str, line: usize) -> Result<(), String> {
        if key.eq_ignore_ascii_case("map_Kd") {
            let file = without_options(rest);
            if file.is_empty() {
                return Err("expected a file".into());
            }
            self.texture = Some((file.into(), line));
            return Ok(());
        }
        let rest = rest.split('#').next().unwrap_or_default();
        match key {
            "Kd" => self.diffuse = Some(color(rest)?),
            "Ks" => self.specular = Some(color(rest)?),
            "Ns" => self.shininess = Some(number(rest)?),
            "Ni" => self.ior = Some(number(rest)?),
            "d" => self.dissolve = Some(number(rest.strip_prefix("-halo").unwrap_or(rest))?),
            "Tr" => self.transparency = Some(number(rest)?),
            "illum" => {
                let word = rest.trim();
                self.model = Some(word.parse().map_err(|_| format!("not a whole number: {word}"))?);
            }
            _ => {}
        }
        Ok(())
    }

    fn material(&self, name: &str, folder: &Path, images: &mut Images<'_>) -> Result<Material, ReadError> {
        let opaque = self.dissolve.or(self.transparency.map(|t| 1.0 - t)).unwrap_or(1.0).clamp(0.0, 1.0);
        let transmission = 1.0 - opaque;
        let shine = self.specular.map_or(0.0, |ks| ks.element_sum() / 3.0);
        let plain = Material::default();
        Ok(Material {
            name: name.into(),
            pigment: match &self.texture {
                None => self.diffuse.map_or(plain.pigment, Pigment::Color),
                Some((file, line)) => Pigment::Texture {
                    texture: images
                        .texture_at(self.find(file, folder))
                        .map_err(|error| ReadError::at(&self.file, *line, "map_Kd", error))?,
                    size: 1.0,
                    wrap: Wrap::default(),
                },
            },
            reflectance: if matches!(self.model, Some(3 | 5 | 8)) { shine.min(1.0 - transmission) } else { 0.0 },
            transmission,
            ior: self.ior.unwrap_or(1.0).clamp(0.1, 10.0),
            specular: if matches!(self.model, Some(0 | 1)) { 0.0 } else { shine },
            shininess: self.shininess.map_or(plain.shininess, |ns| ns.clamp(1.0, 1e6)),
            ..plain
        })
    }

    /// Where a texture is: beside the material's file or in `folder`, with Windows' separators or the system's own.
    fn find(&self, file: &str, folder: &Path) -> PathBuf {
        let beside = self.file.parent().unwrap_or(Path::new(""));
        let slashes = file.replace('\\', "/");
        let places = [beside, folder].into_iter().flat_map(|f| [f.join(file), f.join(&slashes)]);
        places.into_iter().find(|p| p.is_file()).unwrap_or_else(|| beside.join(&slashes))
    }
}

fn number(rest: &str) -> Result<f32, String> {
    match numbers::<1>(rest.split_ascii_whitespace())? {
        ([x], 1) if x.is_finite() => Ok(x),
        ([x], 1) => Err(format!("must be finite, got {x}")),
        (_, count) => Err(format!("expected a number, got {count}")),
    }
}

/// One number, or three.
fn color(rest: &str) -> Result<Vec3, String> {
    let color = match numbers::<3>(rest.split_ascii_whitespace())? {
        ([x, ..], 1) => Vec3::splat(x),
        (rgb, 3) => Vec3::from(rgb),
        (_, count) => return Err(format!("expected 3 numbers, got {count}")),
    };
    rules::color(color)?;
    Ok(color)
}

/// The name of a file, which may hold spaces, after the options that may stand before it.
fn without_options(mut rest: &str) -> &str {
    let word = |text: &str| text.find(|c: char| c.is_ascii_whitespace()).unwrap_or(text.len());
    loop {
        let (least, most) = match &rest[..word(rest)] {
            "-o" | "-s" | "-t" => (1, 3),
            "-mm" => (2, 2),
            "-blendu" | "-blendv" | "-bm" | "-boost" | "-cc" | "-clamp" | "-imfchan" | "-texres" | "-type" => (1, 1),
            _ => return rest,
        };
        rest = rest[word(rest)..].trim_start();
        for i in 0..most {
            let end = word(rest);
            if i < least || rest[..end].parse::<f32>().is_ok() {
                rest = rest[end..].trim_start();
            }
        }
    }
}
