//! The scene file format: TOML to [`Description`].

mod early;
pub(in crate::scene) mod elements;
mod file;
mod materials;
mod need;
pub(in crate::scene) mod value;
mod view;

use std::path::Path;

use toml::de::DeTable;

use self::{elements::Reader, file::SceneFile, materials::Names, value::Misfit};
use super::{assets::Assets, error::ReadError, image::Images, obj::Budget, place, source::Progress};
use crate::scene::{Description, Invalid, check};

/// The most tables of a file without a header, as [`tables`] counts: more than the shortest primitives that fit into it.
/// A table takes about 1500 bytes of memory, and two bytes are enough to make one: `a.a.a`.
const MAX_TABLES: usize = 1 << 20;

pub(super) fn parse(
    text: &str,
    file: &Path,
    assets: &Assets,
    progress: Progress<'_>,
) -> Result<Description, ReadError> {
    let tables = tables(text);
    if tables > MAX_TABLES {
        return Err(ReadError::File { path: file.into(), problem: format!("more than {MAX_TABLES} tables") });
    }
    match early::fault(text) {
        Some((part, early::Fault::Syntax(error))) => return Err(syntax(part, file, &error)),
        Some((part, early::Fault::Shape(misfit))) => return Err(shape(part, file, &misfit)),
        None => {}
    }
    Vec::<u8>::new().try_reserve_exact(need::bytes(text, tables)).map_err(|_| ReadError::memory(file))?;
    let table = DeTable::parse(text).map_err(|error| syntax(text, file, &error))?;
    let scene = SceneFile::read(table.into_inner()).map_err(|misfit| shape(text, file, &misfit))?;
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
fn shape(text: &str, file: &Path, Misfit { span, missing, problem }: &Misfit) -> ReadError {
    let line = place::line_at(text.as_bytes(), span.start);
    let key = place::key_at(text, span).unwrap_or_else(|| "scene".into());
    match missing {
        Some(missing) => ReadError::at(file, line, format_args!("{key}.{missing}"), problem),
        None => ReadError::at(file, line, key, problem),
    }
}

fn describe(scene: SceneFile, name: String, assets: &Assets, progress: Progress<'_>) -> Result<Description, Invalid> {
    let mut images = Images::new(assets);
    let names = Names::new(scene.materials, &mut images)?;
    let mut description = Description {
        name,
        camera: scene.camera.map(|camera| camera.describe()).unwrap_or_default(),
        settings: scene.settings.map(|settings| settings.describe()).unwrap_or_default(),
        sky: scene.sky.map(|sky| sky.describe(&mut images)).transpose()?.unwrap_or_default(),
        lights: scene.light.into_iter().map(|light| light.describe()).collect(),
        ..Description::default()
    };
    let mut reader = Reader { names, images, assets, budget: Budget::default(), progress };
    scene.primitives.describe(&mut reader, &mut description)?;
    description.materials = reader.names.materials;
    description.textures = reader.images.textures;
    Ok(description)
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
