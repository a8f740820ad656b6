//! The arrays of primitives: elements of the scene file, and how they become the description's.

use super::materials::Names;
pub(in crate::scene) use super::value::{Fault, table};
use super::value::{Misfit, Parsed, Value};
use crate::scene::read::{assets::Assets, image::Images, obj, source::Progress};
use crate::scene::{Invalid, Material};

/// The table of one element of an array of primitives.
pub(crate) trait Element: Value {
    /// The kind of primitive that it becomes.
    type Kind;
    /// The key of its array.
    const KEY: &'static str;

    /// Makes it that.
    fn describe(self, reader: &mut Reader<'_>) -> Result<Self::Kind, Fault>;
}

/// A kind of primitive that a scene file may hold.
pub(crate) trait Readable: Sized {
    /// The arrays of the scene file that it is read from.
    type Elements: Elements<Kind = Self>;
}

/// One array of the scene file, or several one after the other, that become primitives of one kind.
pub(crate) trait Elements: Default {
    /// The kind of primitive that they become.
    type Kind;

    /// Their keys.
    fn keys() -> Vec<&'static str>;
    /// Takes the value of a key, and gives it back if that is none of theirs.
    fn take<'i>(&mut self, key: &str, value: Parsed<'i>) -> Result<Option<Parsed<'i>>, Misfit>;
    /// Makes them that, in the order that materials which the file does not define get their numbers in.
    fn describe(self, reader: &mut Reader<'_>) -> Result<Vec<Self::Kind>, Invalid>;
}

/// An array of tables.
pub(crate) struct Array<E>(Vec<E>);

impl<E> Default for Array<E> {
    fn default() -> Self {
        Self(Vec::new())
    }
}

impl<E: Element> Elements for Array<E> {
    type Kind = E::Kind;

    fn keys() -> Vec<&'static str> {
        vec![E::KEY]
    }
    fn take<'i>(&mut self, key: &str, value: Parsed<'i>) -> Result<Option<Parsed<'i>>, Misfit> {
        if key != E::KEY {
            return Ok(Some(value));
        }
        self.0 = Vec::read(value)?;
        Ok(None)
    }
    fn describe(self, reader: &mut Reader<'_>) -> Result<Vec<E::Kind>, Invalid> {
        let one = |(i, element): (usize, E)| {
            let invalid = |Fault(key, problem)| Invalid { key: format!("{}[{i}].{key}", E::KEY), problem };
            element.describe(reader).map_err(invalid)
        };
        self.0.into_iter().enumerate().map(one).collect()
    }
}

impl<A: Elements, B: Elements<Kind = A::Kind>> Elements for (A, B) {
    type Kind = A::Kind;

    fn keys() -> Vec<&'static str> {
        [A::keys(), B::keys()].concat()
    }
    fn take<'i>(&mut self, key: &str, value: Parsed<'i>) -> Result<Option<Parsed<'i>>, Misfit> {
        match self.0.take(key, value)? {
            Some(value) => self.1.take(key, value),
            None => Ok(None),
        }
    }
    fn describe(self, reader: &mut Reader<'_>) -> Result<Vec<A::Kind>, Invalid> {
        let mut all = self.0.describe(reader)?;
        all.extend(self.1.describe(reader)?);
        Ok(all)
    }
}

/// The materials and files that elements refer to.
pub(crate) struct Reader<'a> {
    pub(super) names: Names,
    pub(super) images: Images<'a>,
    pub(super) assets: &'a Assets,
    pub(super) budget: obj::Budget,
    pub(super) progress: Progress<'a>,
}

impl Reader<'_> {
    /// The material of a name, or the default.
    pub(in crate::scene) fn material(&mut self, name: Option<String>) -> Result<usize, Fault> {
        self.names.find(name)
    }

    /// Adds the material of a mesh file; a name that is taken gets a number.
    pub(in crate::scene) fn add(&mut self, material: Material) -> usize {
        self.names.add(material)
    }

    /// A mesh file, with its materials or without.
    pub(in crate::scene) fn model(&mut self, file: &str, materials: bool) -> Result<obj::Model, String> {
        let images = materials.then_some(&mut self.images);
        obj::read(self.assets, file, images, &mut self.budget, self.progress).map_err(|error| error.to_string())
    }
}
