//! Wavefront OBJ: positions and faces.
//!
//! tobj does the reading of numbers and the fans of polygons, but its errors know no lines, it lets NaN pass, makes
//! triangles of `l` records, and computes with texture and normal indices unchecked. So it is only ever given `v`
//! and `f` records that a first pass has found sound and stripped to what is used.

use std::{fmt::Write, path::Path};

use glam::Vec3;

use super::{ReadError, assets::Assets};
use crate::scene::{Mesh, check};

/// Reads the mesh of a file, with material 0: the faces in the order of the file, polygons as fans, groups and
/// objects as one. The file's length is taken off `budget`, which it must not exceed.
pub(super) fn read(assets: &Assets, file: &str, budget: &mut u64) -> Result<Mesh, ReadError> {
    let bytes = assets.read(file, *budget)?;
    *budget -= bytes.len() as u64;
    parse(&bytes, &assets.path(file))
}

fn parse(bytes: &[u8], path: &Path) -> Result<Mesh, ReadError> {
    let file = |problem: String| ReadError::File { path: path.into(), problem };
    let records = records(bytes).map_err(|(line, key, problem)| ReadError::at(path, line, key, problem))?;
    let options = tobj::LoadOptions { triangulate: true, ..Default::default() };
    let no_materials = |_: &Path| Ok(Default::default());
    let (models, _) =
        tobj::load_obj_buf(&mut records.as_bytes(), &options, no_materials).map_err(|error| file(error.to_string()))?;
    let mesh = models.into_iter().next().map(|model| model.mesh).filter(|mesh| !mesh.indices.is_empty());
    let mesh = mesh.ok_or_else(|| file("no faces".into()))?;
    Ok(Mesh {
        positions: mesh.positions.as_chunks().0.iter().copied().map(Vec3::from_array).collect(),
        triangles: mesh.indices.as_chunks().0.to_vec(),
        ..Mesh::default()
    })
}

/// Line, key and problem.
type Fault = (usize, &'static str, String);

/// The `v` and `f` records of the file, sound, with indices from 1 and nothing that is not used.
fn records(bytes: &[u8]) -> Result<String, Fault> {
    let mut kept = String::with_capacity(bytes.len());
    let mut count = 0;
    // A face may name a vertex that comes later, so the largest index waits for the end.
    let mut largest = (0, 0);
    for (i, line) in bytes.split(|b| *b == b'\n').enumerate() {
        let line = String::from_utf8_lossy(line);
        let mut words = line.split('#').next().unwrap_or_default().split_whitespace();
        match words.next() {
            Some("v") => {
                vertex(words, &mut kept).map_err(|problem| (i + 1, "v", problem))?;
                count += 1;
            }
            Some("f") => {
                let index = face(words, count, &mut kept).map_err(|problem| (i + 1, "f", problem))?;
                largest = largest.max((index, i + 1));
            }
            _ => {}
        }
    }
    let (index, line) = largest;
    if index > count { Err((line, "f", format!("vertex {index} of {count} does not exist"))) } else { Ok(kept) }
}

/// A vertex: x y z, and perhaps a weight or a colour (three, or four with alpha), of which only the weight counts.
fn vertex<'a>(words: impl Iterator<Item = &'a str>, kept: &mut String) -> Result<(), String> {
    let words: Vec<&str> = words.take(8).collect();
    let numbers: Vec<f32> =
        words.iter().map(|w| w.parse().map_err(|_| format!("not a number: {w}"))).collect::<Result<_, _>>()?;
    let (position, used) = match numbers[..] {
        [x, y, z] | [x, y, z, _, _, _] | [x, y, z, _, _, _, _] => (Vec3::new(x, y, z), 3),
        [x, y, z, w] => (Vec3::new(x, y, z) / w, 4),
        _ => return Err(format!("expected 3 numbers, got {}", numbers.len())),
    };
    check::vertex(position)?;
    kept.push('v');
    words[..used].iter().for_each(|word| {
        kept.push(' ');
        kept.push_str(word);
    });
    kept.push('\n');
    Ok(())
}

/// A face: three or more of `v`, `v/vt`, `v//vn`, `v/vt/vn`. Gives the largest vertex index, from 1.
fn face<'a>(words: impl Iterator<Item = &'a str>, count: usize, kept: &mut String) -> Result<usize, String> {
    kept.push('f');
    let mut largest = 0;
    let mut corners = 0;
    for word in words {
        let index: isize =
            word.split('/').next().unwrap_or_default().parse().map_err(|_| format!("not a vertex index: {word}"))?;
        // Negative indices count back from the latest vertex.
        let absolute = match index {
            1.. => Some(index as usize),
            0 => None,
            _ => count.checked_sub(index.unsigned_abs()).map(|i| i + 1),
        };
        let absolute = absolute.ok_or_else(|| format!("vertex {index} of {count} does not exist"))?;
        largest = largest.max(absolute);
        corners += 1;
        let _ = write!(kept, " {absolute}");
    }
    kept.push('\n');
    if corners < 3 { Err(format!("a face needs 3 vertices, got {corners}")) } else { Ok(largest) }
}

#[cfg(test)]
#[path = "obj_tests.rs"]
mod tests;
