//! The tables of what there is besides primitives: camera, settings, sky and lights.

use glam::Vec3;

use super::value::table;
use crate::scene::{CameraDescription, Dome, Invalid, Light, Settings, Sky, read::image::Images};

table! {
    pub(super) struct CameraFile {
        eye: Vec3 = CameraDescription::default().eye,
        look_at: Vec3 = CameraDescription::default().look_at,
        up: Vec3 = CameraDescription::default().up,
        fov: f32 = CameraDescription::default().fov,
    }
}

impl CameraFile {
    pub(super) fn describe(self) -> CameraDescription {
        let Self { eye, look_at, up, fov } = self;
        CameraDescription { eye, look_at, up, fov }
    }
}

table! {
    pub(super) struct SettingsFile {
        max_depth: u32 = Settings::default().max_depth,
        attenuation: bool = Settings::default().attenuation,
        ambient: Vec3 = Settings::default().ambient,
        tolerance: f32 = Settings::default().tolerance,
    }
}

impl SettingsFile {
    pub(super) fn describe(self) -> Settings {
        let Self { max_depth, attenuation, ambient, tolerance } = self;
        Settings { max_depth, attenuation, ambient, tolerance }
    }
}

table! {
    pub(super) struct LightFile {
        position: Vec3,
        power: Vec3,
    }
}

impl LightFile {
    pub(super) fn describe(self) -> Light {
        Light { position: self.position, power: self.power }
    }
}

table! {
    pub(super) struct SkyFile {
        color: Option<Vec3>,
        gradient: Option<[Vec3; 2]>,
        image: Option<String>,
        rotation: Option<f32>,
    }
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
            Some([below, above]) => Sky::Gradient { below, above },
            None => Sky::Color(color.unwrap_or_default()),
        })
    }
}
