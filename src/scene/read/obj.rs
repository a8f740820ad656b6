//! Wavefront OBJ: positions, texture coordinates, normals, faces, and the materials of MTL files.
//!
//! Groups and objects are one mesh, with the faces in the order of the file. Polygons may be concave
//! ([`polygon::triangulate`](super::polygon::triangulate)); what has no area stays, as a fan that no ray hits. Lines,
//! points, curves, smoothing groups and whatever else is not known are ignored. The names of materials run to the end
//! of the line; without any `mtllib` they mean nothing.

mod alone;
mod budget;
mod corners;
mod mtl;
mod numbers;

use std::{
    collections::{HashMap, TryReserveError},
    io::Read,
    path::Path,
};

use glam::{Vec2, Vec3};

pub(in crate::scene) use self::alone::alone;
pub(super) use self::budget::Budget;
pub use self::budget::MAX_OBJ_BYTES;
use self::{
    budget::MAX_TRIANGLES,
    corners::{Columns, NONE, Triple, Vertices},
    mtl::Library,
    numbers::numbers,
};
use super::{assets::Assets, error::ReadError, image::Images, lines::Lines, polygon, source::Progress};
use crate::scene::{Material, Mesh, rules};

/// The most materials of a file.
const MAX_MATERIALS: usize = 1 << 16;

/// The contents of a file.
pub(in crate::scene) struct Model {
    /// Its `materials` are indices into those below; the number of them stands for no material.
    pub mesh: Mesh,
    /// The materials that faces have.
    pub materials: Vec<Material>,
    /// Whether there are faces without a material.
    pub bare: bool,
}

impl Model {
    /// The mesh, with its materials where `add` puts them, and `default` where it has none.
    pub fn merge(self, default: usize, add: impl FnMut(Material) -> usize) -> Mesh {
        let mut mesh = self.mesh;
        let mut places: Vec<usize> = self.materials.into_iter().map(add).collect();
        places.push(default);
        match (&mesh.materials[..], &places[..]) {
            ([], _) => mesh.material = default,
            (_, &[only, _]) if !self.bare => {
                mesh.material = only;
                mesh.materials = Vec::new();
            }
            _ => mesh.materials.iter_mut().for_each(|m| *m = places[*m as usize] as u32),
        }
        mesh
    }
}

/// Reads a file; what it takes is taken off the budget. Materials are only read when there is a place for textures.
pub(super) fn read(
    assets: &Assets,
    file: &str,
    images: Option<&mut Images<'_>>,
    budget: &mut Budget,
    progress: Progress<'_>,
) -> Result<Model, ReadError> {
    let path = assets.path(file);
    match assets {
        Assets::Folder(_) => read_path(&path, images, budget, progress),
        Assets::Builtin => {
            let bytes = assets.read(file, budget.bytes)?;
            let size = (budget.bytes, bytes.len() as u64);
            read_lines(Lines::new(&bytes[..], &path, size, progress), &path, images, budget)
        }
    }
}

fn read_path(
    path: &Path,
    images: Option<&mut Images<'_>>,
    budget: &mut Budget,
    progress: Progress<'_>,
) -> Result<Model, ReadError> {
    read_lines(Lines::open(path, budget.bytes, progress)?, path, images, budget)
}

fn read_lines<R: Read>(
    mut lines: Lines<'_, R>,
    path: &Path,
    images: Option<&mut Images<'_>>,
    budget: &mut Budget,
) -> Result<Model, ReadError> {
    let mut reader = Reader::new(path, images.is_some(), budget.triangles);
    while let Some((number, line)) = lines.next()? {
        reader.make_room(line.len()).map_err(|_| ReadError::memory(path))?;
        reader.statement(&line, number).map_err(|(key, problem)| ReadError::at(path, number, key, problem))?;
    }
    budget.bytes -= lines.done();
    drop(lines);
    budget.triangles -= reader.triangles.len();
    reader.model(images, budget)
}

/// Key and problem.
type Fault = (&'static str, String);

/// The kinds of indices of a corner, in their order.
const KINDS: [&str; 3] = ["vertex", "texture coordinate", "normal"];

struct Reader<'a> {
    path: &'a Path,
    columns: Columns,
    vertices: Vertices,
    triangles: Vec<[u32; 3]>,
    most_triangles: usize,
    /// Polygons with a corner that came later: the first triangle and the number of them.
    late: Vec<(usize, usize)>,
    /// A face may name what comes later, so the largest index of each kind waits for the end, with its line.
    largest: [(u64, usize); 3],
    /// The face at hand.
    face: Vec<Triple>,
    corners: Vec<u32>,
    groups: Option<Groups>,
}

/// Which faces have which material.
#[derive(Default)]
struct Groups {
    libraries: Vec<(String, usize)>,
    /// The materials' names, each with the first line that uses it.
    names: Vec<(String, usize)>,
    known: HashMap<String, u32>,
    current: u32,
    /// By triangle, from the first `usemtl` on: an index into the names, or [`NONE`].
    triangles: Vec<u32>,
}

impl<'a> Reader<'a> {
    fn new(path: &'a Path, materials: bool, most_triangles: usize) -> Self {
        Self {
            path,
            columns: Columns::default(),
            vertices: Vertices::default(),
            triangles: Vec::new(),
            most_triangles,
            late: Vec::new(),
            largest: [(0, 0); 3],
            face: Vec::new(),
            corners: Vec::new(),
            groups: materials.then(|| Groups { current: NONE, ..Groups::default() }),
        }
    }

    /// For all that a line of so many bytes may add.
    fn make_room(&mut self, length: usize) -> Result<(), TryReserveError> {
        let Columns { positions, uvs, normals } = &mut self.columns;
        positions.try_reserve(1)?;
        uvs.try_reserve(1)?;
        normals.try_reserve(1)?;
        // A corner takes two bytes.
        let corners = length / 2 + 1;
        self.triangles.try_reserve(corners)?;
        self.vertices.make_room(corners)?;
        self.groups.as_mut().map_or(Ok(()), |groups| {
            let missing = self.triangles.len().saturating_sub(groups.triangles.len());
            groups.triangles.try_reserve(if groups.names.is_empty() { 0 } else { missing + corners })
        })
    }

    fn statement(&mut self, line: &str, number: usize) -> Result<(), Fault> {
        let line = line.strip_prefix('\u{feff}').unwrap_or(line).trim_ascii();
        let (key, rest) = line.split_once(|c: char| c.is_ascii_whitespace()).unwrap_or((line, ""));
        let words = rest.split('#').next().unwrap_or_default().split_ascii_whitespace();
        match key.split('#').next().unwrap_or_default() {
            "v" => self.columns.positions.push(position(words).map_err(|problem| ("v", problem))?),
            "vt" => self.columns.uvs.push(uv(words).map_err(|problem| ("vt", problem))?),
            "vn" => self.columns.normals.push(normal(words).map_err(|problem| ("vn", problem))?),
            "f" => self.face(words, number).map_err(|problem| ("f", problem))?,
            "usemtl" => self.group(rest.trim_ascii(), number).map_err(|problem| ("usemtl", problem))?,
            "mtllib" => self.libraries(rest.trim_ascii(), number),
            _ => {}
        }
        Ok(())
    }

    /// Three or more of `v`, `v/vt`, `v//vn`, `v/vt/vn`.
    fn face<'w>(&mut self, words: impl Iterator<Item = &'w str>, line: usize) -> Result<(), String> {
        self.face.clear();
        for word in words {
            let corner = self.corner(word, line)?;
            self.face.push(corner);
            if self.face.len() > polygon::MAX_CORNERS {
                return Err(format!("a face has at most {} vertices", polygon::MAX_CORNERS));
            }
        }
        let count = self.face.len();
        if count < 3 {
            return Err(format!("a face needs 3 vertices, got {count}"));
        }
        if self.triangles.len() + count - 2 > self.most_triangles {
            return Err(format!("mesh files have at most {MAX_TRIANGLES} triangles together"));
        }
        self.vertices.of_face(&self.face, &mut self.triangles, &mut self.corners);
        let first = self.triangles.len();
        self.triangles.extend((2..count).map(|i| [self.corners[0], self.corners[i - 1], self.corners[i]]));
        if let Some(groups) = &mut self.groups
            && !groups.names.is_empty()
        {
            groups.triangles.resize(first, NONE);
            groups.triangles.resize(self.triangles.len(), groups.current);
        }
        if count > 3 {
            let known = self.face.iter().all(|[v, ..]| (*v as usize) < self.columns.positions.len());
            if known { self.divide(first, count - 2) } else { self.late.push((first, count - 2)) }
        }
        Ok(())
    }

    /// Puts the right triangles in the place of a fan.
    fn divide(&mut self, first: usize, count: usize) {
        let fan = &mut self.triangles[first..first + count];
        let corners: Vec<u32> = fan[0][..2].iter().copied().chain(fan.iter().map(|t| t[2])).collect();
        let points: Vec<Vec3> = corners.iter().map(|c| self.columns.positions[self.vertices.position(*c)]).collect();
        if let Some(triangles) = polygon::triangulate(&points) {
            fan.iter_mut().zip(triangles).for_each(|(t, new)| *t = new.map(|i| corners[i as usize]));
        }
    }

    fn corner(&mut self, word: &str, line: usize) -> Result<Triple, String> {
        let counts = [self.columns.positions.len(), self.columns.uvs.len(), self.columns.normals.len()];
        let mut parts = word.split('/');
        let mut triple = [NONE; 3];
        for (kind, name) in KINDS.into_iter().enumerate() {
            let part = parts.next().unwrap_or_default();
            if part.is_empty() && kind > 0 {
                continue;
            }
            let index: i64 = part.parse().map_err(|_| format!("not a {name} index: {word}"))?;
            let count = counts[kind] as u64;
            // Negative indices count back from the latest.
            let absolute = match index {
                0 => None,
                1.. => Some(index as u64),
                _ => count.checked_sub(index.unsigned_abs()).map(|i| i + 1),
            };
            // No file has so many that the last value could be meant.
            let absolute = absolute.filter(|a| *a < u64::from(NONE));
            let absolute = absolute.ok_or_else(|| format!("{name} {index} of {count} does not exist"))?;
            triple[kind] = (absolute - 1) as u32;
            self.largest[kind] = self.largest[kind].max((absolute, line));
        }
        if parts.next().is_some() { Err(format!("not a vertex index: {word}")) } else { Ok(triple) }
    }

    fn group(&mut self, name: &str, line: usize) -> Result<(), String> {
        let Some(groups) = &mut self.groups else { return Ok(()) };
        if let Some(known) = groups.known.get(name) {
            groups.current = *known;
            return Ok(());
        }
        if groups.names.len() == MAX_MATERIALS {
            return Err(format!("more than {MAX_MATERIALS} materials"));
        }
        groups.current = groups.names.len() as u32;
        groups.known.insert(name.into(), groups.current);
        groups.names.push((name.into(), line));
        Ok(())
    }

    fn libraries(&mut self, names: &str, line: usize) {
        let Some(groups) = &mut self.groups else { return };
        // Several files, or one with spaces in its name.
        let one = self.path.with_file_name(names).is_file();
        let words = names.split_ascii_whitespace().take_while(|word| !word.starts_with('#'));
        let files: Vec<&str> = if one { vec![names] } else { words.collect() };
        groups.libraries.extend(files.into_iter().map(|file| (file.to_owned(), line)));
    }

    fn model(mut self, images: Option<&mut Images<'_>>, budget: &mut Budget) -> Result<Model, ReadError> {
        let counts = [self.columns.positions.len(), self.columns.uvs.len(), self.columns.normals.len()];
        for ((name, count), (index, line)) in KINDS.into_iter().zip(counts).zip(self.largest) {
            if index > count as u64 {
                return Err(ReadError::at(
                    self.path,
                    line,
                    "f",
                    format_args!("{name} {index} of {count} does not exist"),
                ));
            }
        }
        if self.triangles.is_empty() {
            return Err(ReadError::File { path: self.path.into(), problem: "no faces".into() });
        }
        for (first, count) in std::mem::take(&mut self.late) {
            self.divide(first, count);
        }
        let (materials, by_triangle, bare) = match (self.groups, images) {
            (Some(groups), Some(images)) => groups.materials(self.path, images, budget)?,
            _ => (Vec::new(), Vec::new(), true),
        };
        self.vertices.room_for_mesh(&self.columns).map_err(|_| ReadError::memory(self.path))?;
        let mesh = self.vertices.mesh(self.columns, self.triangles);
        Ok(Model { mesh: Mesh { materials: by_triangle, ..mesh }, materials, bare })
    }
}

impl Groups {
    /// The materials that triangles have, the triangles' indices into them, and whether some have none.
    fn materials(
        mut self,
        path: &Path,
        images: &mut Images<'_>,
        budget: &mut Budget,
    ) -> Result<(Vec<Material>, Vec<u32>, bool), ReadError> {
        let mut library = Library::default();
        for (file, line) in &self.libraries {
            let file = path.with_file_name(file);
            library.read(&file, budget).map_err(|error| match error {
                ReadError::At { .. } => error,
                _ => ReadError::at(path, *line, "mtllib", error),
            })?;
        }
        // Names alone mean nothing.
        if self.libraries.is_empty() {
            return Ok((Vec::new(), Vec::new(), true));
        }
        let mut used = vec![false; self.names.len()];
        self.triangles.iter().filter(|g| **g != NONE).for_each(|g| used[*g as usize] = true);
        let folder = path.parent().unwrap_or(Path::new(""));
        let mut materials = Vec::new();
        let mut places = vec![0; self.names.len()];
        for (group, (name, line)) in self.names.iter().enumerate().filter(|(group, _)| used[*group]) {
            let Some(material) = library.material(name, folder, images)? else {
                return Err(ReadError::at(path, *line, "usemtl", format_args!("no material {name:?}")));
            };
            places[group] = materials.len() as u32;
            materials.push(material);
        }
        let none = materials.len() as u32;
        let mut bare = self.triangles.is_empty();
        for group in &mut self.triangles {
            bare |= *group == NONE;
            *group = places.get(*group as usize).copied().unwrap_or(none);
        }
        Ok((materials, self.triangles, bare))
    }
}

/// x y z, and perhaps a weight or a colour (three, or four with alpha), of which only the weight counts.
fn position<'w>(words: impl Iterator<Item = &'w str>) -> Result<Vec3, String> {
    let position = match numbers::<4>(words)? {
        ([x, y, z, _], 3 | 6 | 7) => Vec3::new(x, y, z),
        ([x, y, z, w], 4) => Vec3::new(x, y, z) / w,
        (_, count) => return Err(format!("expected 3 numbers, got {count}")),
    };
    rules::vertex(position)?;
    Ok(position)
}

/// u, and perhaps v and w, of which w does not count.
fn uv<'w>(words: impl Iterator<Item = &'w str>) -> Result<Vec2, String> {
    match numbers::<2>(words)? {
        (uv, 1..=3) if uv.iter().all(|x| x.is_finite()) => Ok(uv.into()),
        ([u, v], 1..=3) => Err(format!("must be finite, got [{u}, {v}]")),
        (_, count) => Err(format!("expected 2 numbers, got {count}")),
    }
}

fn normal<'w>(words: impl Iterator<Item = &'w str>) -> Result<Vec3, String> {
    match numbers::<3>(words)? {
        (n, 3) if n.iter().all(|x| x.is_finite()) => Ok(Vec3::from(n).as_dvec3().normalize_or_zero().as_vec3()),
        ([x, y, z], 3) => Err(format!("must be finite, got [{x}, {y}, {z}]")),
        (_, count) => Err(format!("expected 3 numbers, got {count}")),
    }
}

#[cfg(test)]
#[path = "obj_tests.rs"]
mod tests;
