//! The scene file as a whole. Derived it would have to name the kinds of primitive once more.

use std::{collections::BTreeMap, fmt, sync::LazyLock};

use serde::{
    Deserialize, Deserializer,
    de::{Error, MapAccess, Visitor},
};

use super::elements::{Elements, Readable, Reader};
use super::materials::MaterialFile;
use super::view::{CameraFile, LightFile, SettingsFile, SkyFile};
use crate::kinds::for_each_kind;
use crate::scene::kinds::{KINDS, each_kind};
use crate::scene::read::strict::Table;
use crate::scene::{Description, Invalid};

/// The contents of a scene file.
#[derive(Default)]
pub(super) struct SceneFile {
    pub camera: Table<CameraFile>,
    pub settings: Table<SettingsFile>,
    pub sky: Table<SkyFile>,
    pub light: Vec<Table<LightFile>>,
    pub materials: BTreeMap<String, Table<MaterialFile>>,
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
            /// Takes the value of a key, if it is one of theirs.
            fn take<'de, A: MapAccess<'de>>(&mut self, key: &str, map: &mut A) -> Result<bool, A::Error> {
                Ok(false $($(|| self.$field.take(key, map)?)*)*)
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

/// One of [`KEYS`].
struct Key(&'static str);

impl<'de> Deserialize<'de> for Key {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Known;
        impl Visitor<'_> for Known {
            type Value = Key;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("a key")
            }

            fn visit_str<E: Error>(self, key: &str) -> Result<Key, E> {
                let known = KEYS.iter().find(|known| **known == key);
                known.map(|known| Key(known)).ok_or_else(|| E::unknown_field(key, &KEYS))
            }
        }
        deserializer.deserialize_identifier(Known)
    }
}

impl<'de> Deserialize<'de> for SceneFile {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Shape;
        impl<'de> Visitor<'de> for Shape {
            type Value = SceneFile;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("a scene")
            }

            fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<SceneFile, A::Error> {
                let mut file = SceneFile::default();
                while let Some(Key(key)) = map.next_key()? {
                    match key {
                        "camera" => file.camera = map.next_value()?,
                        "settings" => file.settings = map.next_value()?,
                        "sky" => file.sky = map.next_value()?,
                        "light" => file.light = map.next_value()?,
                        "materials" => file.materials = map.next_value()?,
                        _ => {
                            file.primitives.take(key, &mut map)?;
                        }
                    }
                }
                Ok(file)
            }
        }
        deserializer.deserialize_map(Shape)
    }
}
