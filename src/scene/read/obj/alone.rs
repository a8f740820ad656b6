//! An OBJ file alone as a scene.

use std::path::Path;

use glam::{DVec3, Vec3};

use super::{budget::Budget, read_path};
use crate::scene::{
    CameraDescription, Description, Light, Material, Mesh, Pigment, Plane, Settings, Sky, check,
    read::{assets::Assets, error::ReadError, image::Images, source::Progress},
};

/// How far the camera is from the middle, in diagonals of the bounding box.
const AWAY: f64 = 1.15;

/// Reads a mesh and puts it on a checkered floor, before a sky, in the light of one lamp, with the camera in front of
/// it and a little above and to the right.
///
/// The lamp's irradiance is the same at any distance, so that nothing depends on the mesh's size.
pub(in crate::scene) fn alone(path: &Path, progress: Progress<'_>) -> Result<Description, ReadError> {
    let fault = |problem: String| ReadError::File { path: path.into(), problem };
    let assets = Assets::beside(path);
    let mut images = Images::new(&assets);
    let model = read_path(path, Some(&mut images), &mut Budget::default(), progress)?;
    let mut materials = vec![floor_material()];
    if model.bare {
        materials.push(Material::default());
    }
    let mesh = model.merge(1, |material| {
        materials.push(material);
        materials.len() - 1
    });
    let (low, high) = bounds(&mesh);
    let (middle, diagonal) = ((low + high) / 2.0, (high - low).length());
    if diagonal == 0.0 {
        return Err(fault("all vertices are at one place".into()));
    }
    materials[0].pigment = checker(diagonal);
    let at = |x: f64, y: f64, z: f64| (middle + DVec3::new(x, y, z) * diagonal).as_vec3();
    let eye = (middle + DVec3::new(0.35, 0.45, 0.9).normalize() * (AWAY * diagonal)).as_vec3();
    // A little below, lest a flat underside lies in it: by much less than is seen, and by more than rounding.
    let floor = low.y - (diagonal / 1024.0).max(low.y.abs() * f64::from(8.0 * f32::EPSILON));
    let description = Description {
        name: path.file_stem().unwrap_or_default().to_string_lossy().into_owned(),
        camera: CameraDescription { eye, look_at: middle.as_vec3(), up: Vec3::Y, fov: 45.0 },
        settings: Settings { attenuation: false, ambient: Vec3::splat(0.2), ..Settings::default() },
        sky: Sky::Gradient { below: Vec3::new(0.75, 0.8, 0.85), above: Vec3::new(0.2, 0.4, 0.75) },
        lights: vec![Light { position: at(0.6, 1.5, 0.8), power: Vec3::splat(0.9) }],
        planes: vec![Plane { normal: Vec3::Y, distance: -floor as f32, material: 0 }],
        meshes: vec![mesh],
        materials,
        textures: images.textures,
        ..Description::default()
    };
    check(&description).map_err(|invalid| fault(invalid.to_string()))?;
    Ok(description)
}

/// The bounding box of what the triangles use.
fn bounds(mesh: &Mesh) -> (DVec3, DVec3) {
    let corners = mesh.triangles.as_flattened().iter().map(|v| mesh.positions[*v as usize]);
    let (low, high) = corners.fold((Vec3::INFINITY, Vec3::NEG_INFINITY), |(low, high), p| (low.min(p), high.max(p)));
    (low.as_dvec3(), high.as_dvec3())
}

fn floor_material() -> Material {
    Material { name: "floor".into(), ..Material::default() }
}

/// Cells of about a tenth of the mesh: 1, 2 or 5 times a power of ten.
fn checker(diagonal: f64) -> Pigment {
    let size = diagonal / 10.0;
    let power = 10.0_f64.powf(size.log10().floor());
    let round = [1.0, 2.0, 5.0, 10.0].into_iter().rfind(|r| r * power <= size * 1.25).unwrap_or(1.0);
    // The least is that of a mesh of denormal size.
    Pigment::Checker {
        colors: [Vec3::splat(0.6), Vec3::splat(0.3)],
        size: ((round * power) as f32).max(f32::MIN_POSITIVE),
    }
}
