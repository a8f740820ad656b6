//! The tables of what there is besides primitives: camera, settings, sky and lights.

use glam::Vec3;
use serde::Deserialize;

use super::value::Triple;
use crate::scene::{
    CameraDescription, Dome, Invalid, Light, Settings, Sky,
    read::{image::Images, strict::Exactly},
};

#[derive(Deserialize)]
#[serde(default, deny_unknown_fields)]
pub(super) struct CameraFile {
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

impl CameraFile {
    pub(super) fn describe(self) -> CameraDescription {
        let Self { eye, look_at, up, fov } = self;
        CameraDescription { eye: eye.into(), look_at: look_at.into(), up: up.into(), fov }
    }
}

#[derive(Deserialize)]
#[serde(default, deny_unknown_fields)]
pub(super) struct SettingsFile {
    max_depth: u32,
    attenuation: bool,
    ambient: Triple,
    tolerance: f32,
}

impl Default for SettingsFile {
    fn default() -> Self {
        let Settings { max_depth, attenuation, ambient, tolerance } = Settings::default();
        Self { max_depth, attenuation, ambient: ambient.into(), tolerance }
    }
}

impl SettingsFile {
    pub(super) fn describe(self) -> Settings {
        let Self { max_depth, attenuation, ambient, tolerance } = self;
        Settings { max_depth, attenuation, ambient: ambient.into(), tolerance }
    }
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct LightFile {
    position: Triple,
    power: Triple,
}

impl LightFile {
    pub(super) fn describe(self) -> Light {
        Light { position: self.position.into(), power: self.power.into() }
    }
}

#[derive(Default, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub(super) struct SkyFile {
    color: Option<Triple>,
    gradient: Option<Exactly<Triple, 2>>,
    image: Option<String>,
    rotation: Option<f32>,
}

impl SkyFile {
    pub(super) fn describe(self, images: &mut Images<'_>) -> Result<Sky, Invalid> {
        let Self { color, gradient, image, rotation } = self;
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
            let (width, height, texels) =
                images.panorama(&file).map_err(|error| invalid("image", error.to_string()))?;
            let dome = Dome { width, height, texels, rotation: rotation.unwrap_or(0.0) };
            return Ok(Sky::Dome(dome.into()));
        }
        Ok(match gradient {
            Some(Exactly([below, above])) => Sky::Gradient { below: below.into(), above: above.into() },
            None => Sky::Color(color.map(Vec3::from).unwrap_or_default()),
        })
    }
}
