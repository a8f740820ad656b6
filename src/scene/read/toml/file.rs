//! The scene file as a whole, with an array or several for each kind of primitive.

use std::{collections::BTreeMap, sync::LazyLock};

use toml::de::DeTable;

use super::elements::{Elements, Readable, Reader};
use super::materials::MaterialFile;
use super::value::{Misfit, Parsed, Value};
use super::view::{CameraFile, LightFile, SettingsFile, SkyFile};
use crate::kinds::for_each_kind;
use crate::scene::kinds::{KINDS, each_kind};
use crate::scene::{Description, Invalid};

/// The contents of a scene file.
#[derive(Default)]
pub(super) struct SceneFile {
    pub camera: Option<CameraFile>,
    pub settings: Option<SettingsFile>,
    pub sky: Option<SkyFile>,
    pub light: Vec<LightFile>,
    pub materials: BTreeMap<String, MaterialFile>,
    pub primitives: Primitives,
}

/// All arrays of primitives, from the list of kinds.
macro_rules! primitives {
    ($($group:ident { $(($storage:ident: $Storage:ident, $field:ident: $Kind:ident, $module:ident))* })*) => {
        /// The primitives of a scene file.
        #[derive(Default)]
        pub(super) struct Primitives {
            $($($field: <crate::scene::$Kind as Readable>::Elements,)*)*
        }

        impl Primitives {
            /// Takes the value of a key, and gives it back if that is none of theirs.
            fn take<'i>(&mut self, key: &str, value: Parsed<'i>) -> Result<Option<Parsed<'i>>, Misfit> {
                $($(let Some(value) = self.$field.take(key, value)? else { return Ok(None) };)*)*
                Ok(Some(value))
            }

            /// Puts them into the description.
            pub(super) fn describe(self, reader: &mut Reader<'_>, into: &mut Description) -> Result<(), Invalid> {
                $($(into.$field = self.$field.describe(reader)?;)*)*
                Ok(())
            }
        }
    };
}
for_each_kind! { primitives }

/// All keys, as messages list them: every kind's own, then those of its other arrays.
static KEYS: LazyLock<Vec<&str>> = LazyLock::new(|| {
    let mut keys = vec!["camera", "settings", "sky", "light", "materials"];
    keys.extend(KINDS.iter().map(|kind| kind.one));
    for key in each_kind!(|K| <K as Readable>::Elements::keys()).concat() {
        if !keys.contains(&key) {
            keys.push(key);
        }
    }
    keys
});

impl SceneFile {
    /// Reads the whole of it.
    pub(super) fn read(table: DeTable<'_>) -> Result<Self, Misfit> {
        let mut file = Self::default();
        for (key, value) in table {
            match key.get_ref().as_ref() {
                "camera" => file.camera = Value::read(value)?,
                "settings" => file.settings = Value::read(value)?,
                "sky" => file.sky = Value::read(value)?,
                "light" => file.light = Value::read(value)?,
                "materials" => file.materials = Value::read(value)?,
                name => {
                    if file.primitives.take(name, value)?.is_some() {
                        return Err(Misfit::unknown(key.span(), &KEYS));
                    }
                }
            }
        }
        Ok(file)
    }
}
