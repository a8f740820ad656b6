//! Eric Haines' Neutral File Format, as his Standard Procedural Databases use it (*A Proposal for Standard Graphics
//! Environments*, 1987; the files' own notes).
//!
//! How it becomes a [`Description`]:
//! - Lights that have no colour are √n / (2 n) of n lights strong, at any distance; so is the ambient light. Paths have
//!   five segments. `hither` and `resolution` are left to the command line.
//! - `f r g b Kd Ks Shine T ior`: Ks is the mirror's fraction and the highlight's strength, T what is transmitted, and
//!   both are added to the surface's own shading ([`Material::additive`]). A Shine of 1e5 or more, or of 0, means no
//!   highlight: the former by the format's convention; the latter since a cosine to the power of 0 is light from
//!   everywhere, while files write 0 where nothing shines.
//! - Opaque surfaces are there from outside only, or from inside only where radii are negative. Those that transmit
//!   are there from both sides, but for negative radii. All stop light from both sides: the format says what is visible,
//!   and nothing of shadows.
//! - Patches (`pp`) are there from both sides, since the order of their corners says nothing: it may oppose the
//!   normals, even within a file. Their triangles are turned to agree with the normals, which point outside.

mod tokens;

use std::{
    collections::{HashMap, TryReserveError, hash_map::Entry},
    io::{BufRead, BufReader},
    path::Path,
};

use glam::{DVec3, Vec3};

use self::tokens::Tokens;
use super::{
    error::ReadError,
    polygon,
    source::{Progress, open},
};
use crate::scene::{
    CameraDescription, Cone, Cylinder, Description, Invalid, Light, Material, Mesh, Pigment, Settings, Sides, Sky,
    Sphere, check, rules,
};

/// The largest NFF file that is read. Reading takes up to about ten times its size in memory.
pub const MAX_NFF_BYTES: u64 = 256 << 20;

/// The number of segments of a path, by the format's convention.
const DEPTH: u32 = 5;

/// From here on a Phong exponent means that there is no highlight.
const NO_HIGHLIGHT: f32 = 1e5;

/// Bytes between two reports of how far it is.
const REPORT: u64 = 1 << 20;

/// Reads a scene, telling how far it is.
pub(super) fn read(path: &Path, progress: Progress<'_>) -> Result<Description, ReadError> {
    let (file, length) = open(path, MAX_NFF_BYTES)?;
    parse(BufReader::with_capacity(1 << 16, file), path, MAX_NFF_BYTES, &mut |bytes| progress(bytes, length))
}

fn parse(
    input: impl BufRead,
    path: &Path,
    limit: u64,
    progress: &mut dyn FnMut(u64),
) -> Result<Description, ReadError> {
    let mut reader = Reader::new(Tokens::new(input, path, limit));
    let mut next = REPORT;
    progress(0);
    loop {
        reader.make_room().map_err(|_| ReadError::memory(path))?;
        if !reader.entity()? {
            break;
        }
        if reader.tokens.bytes() >= next {
            next = reader.tokens.bytes() + REPORT;
            progress(reader.tokens.bytes());
        }
    }
    progress(reader.tokens.bytes());
    let file = |problem: String| ReadError::File { path: path.into(), problem };
    let mut description = reader.finish().ok_or_else(|| file("no view (v)".into()))?;
    description.name = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
    // Every value has been checked where it was read; this makes sure that no rule was forgotten.
    check::check(&description).map_err(|invalid| file(invalid.to_string()))?;
    Ok(description)
}

/// A light, and the colour that the file may give it.
type Lamp = (Vec3, Option<Vec3>);

struct Reader<'a, R> {
    tokens: Tokens<'a, R>,
    camera: Option<CameraDescription>,
    sky: Option<Vec3>,
    lights: Vec<Lamp>,
    materials: Materials,
    spheres: Vec<Sphere>,
    cylinders: Vec<Cylinder>,
    cones: Vec<Cone>,
    /// Opaque polygons, those that transmit, and patches: what a mesh has, all its triangles have.
    meshes: [Mesh; 3],
}

impl<'a, R: BufRead> Reader<'a, R> {
    fn new(tokens: Tokens<'a, R>) -> Self {
        let meshes = [Sides::Front, Sides::Both, Sides::Both].map(|sides| Mesh { sides, ..Mesh::default() });
        Self {
            tokens,
            camera: None,
            sky: None,
            lights: Vec::new(),
            materials: Materials::default(),
            spheres: Vec::new(),
            cylinders: Vec::new(),
            cones: Vec::new(),
            meshes,
        }
    }

    /// For an entity; corners see to their own.
    fn make_room(&mut self) -> Result<(), TryReserveError> {
        self.lights.try_reserve(1)?;
        self.spheres.try_reserve(1)?;
        self.cylinders.try_reserve(1)?;
        self.cones.try_reserve(1)?;
        self.materials.all.try_reserve(1)?;
        self.materials.known.try_reserve(1)
    }

    /// Reads the next entity, unless the file ends.
    fn entity(&mut self) -> Result<bool, ReadError> {
        if self.tokens.is_end()? {
            return Ok(false);
        }
        let read = match self.tokens.word()? {
            Some("v") => Self::view,
            Some("b") => Self::background,
            Some("l") => Self::light,
            Some("f") => Self::material,
            Some("s") => Self::sphere,
            Some("c") => Self::cone,
            Some("p") => Self::polygon,
            Some("pp") => Self::patch,
            _ => return Err(self.tokens.strange("unknown entity, expected v, b, l, f, s, c, p or pp")),
        };
        self.tokens.take();
        read(self)?;
        Ok(true)
    }

    /// `v`, and its parts in any order.
    fn view(&mut self) -> Result<(), ReadError> {
        let line = self.tokens.line();
        let ([mut from, mut at, mut up], mut angle) = ([None; 3], None);
        while let Some(word @ ("from" | "at" | "up" | "angle" | "hither" | "resolution")) = self.tokens.word()? {
            self.tokens.take();
            match word {
                "from" => from = Some(self.vector(word, rules::point)?),
                "at" => at = Some(self.vector(word, rules::point)?),
                "up" => up = Some(self.vector(word, rules::direction)?),
                "angle" => {
                    let [degrees] = self.tokens.numbers(word)?;
                    self.tokens.sound(word, rules::fov(degrees))?;
                    angle = Some(degrees);
                }
                "hither" => drop(self.tokens.numbers::<1>(word)?),
                _ => drop(self.tokens.numbers::<2>(word)?),
            }
        }
        let part = |part: Option<Vec3>, name: &str| {
            part.ok_or_else(|| self.tokens.fault(line, "v", format_args!("{name} is missing")))
        };
        let [eye, look_at, up] = [part(from, "from")?, part(at, "at")?, part(up, "up")?];
        let fov = angle.ok_or_else(|| self.tokens.fault(line, "v", "angle is missing"))?;
        if eye == look_at {
            return Err(self.tokens.fault(line, "v", "at must differ from from"));
        }
        match self.camera.replace(CameraDescription { eye, look_at, up, fov }) {
            Some(_) => Err(self.tokens.fault(line, "v", "there is a view already")),
            None => Ok(()),
        }
    }

    fn background(&mut self) -> Result<(), ReadError> {
        let line = self.tokens.line();
        let color = self.vector("b", rules::color)?;
        match self.sky.replace(color) {
            Some(_) => Err(self.tokens.fault(line, "b", "there is a background already")),
            None => Ok(()),
        }
    }

    fn light(&mut self) -> Result<(), ReadError> {
        let position = self.vector("l", rules::point)?;
        let color = if self.tokens.is_number()? { Some(self.vector("l", rules::power)?) } else { None };
        self.lights.push((position, color));
        Ok(())
    }

    fn material(&mut self) -> Result<(), ReadError> {
        let line = self.tokens.line();
        let numbers = self.tokens.numbers("f")?;
        self.materials.wear(numbers).map_err(|problem| self.tokens.fault(line, "f", problem))
    }

    fn sphere(&mut self) -> Result<(), ReadError> {
        let center = self.vector("s", rules::point)?;
        let [radius] = self.tokens.numbers("s")?;
        let sides = self.materials.sides(radius < 0.0);
        let radius = radius.abs();
        self.tokens.sound("s", rules::length(radius).map_err(|problem| format!("the radius {problem}")))?;
        self.spheres.push(Sphere { center, radius, sides, material: self.materials.worn() });
        Ok(())
    }

    fn cone(&mut self) -> Result<(), ReadError> {
        let base = self.vector("c", rules::place)?;
        let [base_radius] = self.end()?;
        let apex = self.vector("c", rules::place)?;
        self.tokens.sound("c", rules::axis(base, apex).map_err(|problem| format!("the apex {problem}")))?;
        let [apex_radius] = self.end()?;
        self.tokens.sound(
            "c",
            match (base_radius, apex_radius) {
                (0.0, 0.0) => Err("the radii must not both be 0".into()),
                (a, b) if a * b < 0.0 => Err(format!("the radii must have the same sign, got {a} and {b}")),
                _ => Ok(()),
            },
        )?;
        let sides = self.materials.sides(base_radius < 0.0 || apex_radius < 0.0);
        let material = self.materials.worn();
        let (base_radius, apex_radius) = (base_radius.abs(), apex_radius.abs());
        if base_radius == apex_radius {
            self.cylinders.push(Cylinder { base, apex, radius: base_radius, caps: false, sides, material });
        } else {
            self.cones.push(Cone { base, base_radius, apex, apex_radius, caps: false, sides, material });
        }
        Ok(())
    }

    /// A radius at the end of a cone.
    fn end(&mut self) -> Result<[f32; 1], ReadError> {
        let radius = self.tokens.numbers("c")?;
        self.tokens.sound("c", rules::end_radius(radius[0].abs()).map_err(|problem| format!("a radius {problem}")))?;
        Ok(radius)
    }

    fn polygon(&mut self) -> Result<(), ReadError> {
        let mesh = usize::from(self.materials.transmits());
        self.corners("p", mesh, false)
    }

    fn patch(&mut self) -> Result<(), ReadError> {
        self.corners("pp", 2, true)
    }

    /// The corners of a polygon, with normals where it is smooth, as triangles of a mesh.
    fn corners(&mut self, key: &str, mesh: usize, smooth: bool) -> Result<(), ReadError> {
        let line = self.tokens.line();
        let count = self.tokens.number(key, "a number of corners", || "expected a number of corners".into())?;
        self.tokens.sound(
            key,
            match count {
                3..=polygon::MAX_CORNERS => Ok(()),
                _ => Err(format!("must have 3 to {} corners, got {count}", polygon::MAX_CORNERS)),
            },
        )?;
        let mesh = &mut self.meshes[mesh];
        let first = mesh.positions.len();
        let each = if smooth { 6 } else { 3 };
        for corner in 0..count {
            let mut numbers = [0.0; 6];
            for number in &mut numbers[..each] {
                let missing = || format!("expected {count} corners of {each} numbers, got {corner}");
                *number = self.tokens.number(key, "a number", missing)?;
            }
            let [x, y, z, nx, ny, nz] = numbers;
            // As they come: the number may promise more than the file holds.
            let room = mesh.positions.try_reserve(1).and_then(|()| mesh.normals.try_reserve(usize::from(smooth)));
            room.map_err(|_| self.tokens.memory())?;
            mesh.positions.push(Vec3::new(x, y, z));
            self.tokens.sound(key, rules::vertex(Vec3::new(x, y, z)))?;
            if smooth {
                let normal = Vec3::new(nx, ny, nz);
                self.tokens.sound(key, rules::direction(normal).map_err(|problem| format!("a normal {problem}")))?;
                mesh.normals.push(normal);
            }
        }
        let triangles = polygon::triangulate(&mesh.positions[first..]);
        let triangles = triangles.ok_or_else(|| self.tokens.fault(line, key, "the corners span no area"))?;
        let room =
            mesh.materials.try_reserve(triangles.len()).and_then(|()| mesh.triangles.try_reserve(triangles.len()));
        room.map_err(|_| self.tokens.memory())?;
        mesh.materials.resize(mesh.materials.len() + triangles.len(), self.materials.worn() as u32);
        // A corner takes six bytes of the file at least, so that they never are too many for 32 bits.
        for triangle in triangles {
            let corners = triangle.map(|i| first as u32 + i);
            mesh.triangles.push(if smooth { turned(mesh, corners) } else { corners });
        }
        Ok(())
    }

    fn vector(&mut self, key: &str, rule: fn(Vec3) -> Result<(), String>) -> Result<Vec3, ReadError> {
        let v = Vec3::from_array(self.tokens.numbers(key)?);
        self.tokens.sound(key, rule(v))?;
        Ok(v)
    }

    /// The scene that has been read, if there is a view.
    fn finish(self) -> Option<Description> {
        let n = self.lights.len() as f64;
        let intensity = if n > 0.0 { Vec3::splat((n.sqrt() / (2.0 * n)) as f32) } else { Vec3::ZERO };
        let light = |(position, color): Lamp| Light { position, power: color.unwrap_or(intensity) };
        Some(Description {
            camera: self.camera?,
            settings: Settings { max_depth: DEPTH, attenuation: false, ambient: intensity, ..Settings::default() },
            sky: Sky::Color(self.sky.unwrap_or_default()),
            lights: self.lights.into_iter().map(light).collect(),
            materials: self.materials.all,
            spheres: self.spheres,
            cylinders: self.cylinders,
            cones: self.cones,
            meshes: self.meshes.into_iter().filter(|mesh| !mesh.triangles.is_empty()).collect(),
            ..Description::default()
        })
    }
}

/// The corners of a patch's triangle in the order that the normals agree with.
fn turned(mesh: &Mesh, corners: [u32; 3]) -> [u32; 3] {
    let [p, q, r] = corners.map(|i| mesh.positions[i as usize].as_dvec3());
    let outside: DVec3 = corners.iter().map(|&i| mesh.normals[i as usize].as_dvec3().normalize()).sum();
    let [a, b, c] = corners;
    if (q - p).cross(r - p).dot(outside) < 0.0 { [a, c, b] } else { corners }
}

/// The materials of the file, each once.
#[derive(Default)]
struct Materials {
    all: Vec<Material>,
    /// By the bits of their numbers.
    known: HashMap<[u32; 8], usize>,
    /// How many transmit.
    bodies: usize,
    /// The material of the next object; none before the first `f`.
    worn: Option<usize>,
}

impl Materials {
    /// Puts on the material of an `f`.
    fn wear(&mut self, numbers: [f32; 8]) -> Result<(), String> {
        let name = self.known.len() + 1;
        let entry = match self.known.entry(numbers.map(f32::to_bits)) {
            Entry::Occupied(entry) => {
                self.worn = Some(*entry.get());
                return Ok(());
            }
            Entry::Vacant(entry) => entry,
        };
        let material = material(numbers, format!("f{name}"))?;
        self.bodies += usize::from(material.transmission > 0.0);
        if self.bodies > check::MAX_BODIES {
            return Err(format!("at most {} materials may transmit", check::MAX_BODIES));
        }
        self.worn = Some(*entry.insert(self.all.len()));
        self.all.push(material);
        Ok(())
    }

    /// The index of what the next object wears.
    fn worn(&mut self) -> usize {
        *self.worn.get_or_insert_with(|| {
            self.all.push(Material::default());
            self.all.len() - 1
        })
    }

    fn transmits(&self) -> bool {
        self.worn.is_some_and(|worn| self.all[worn].transmission > 0.0)
    }

    /// The sides of what is round, and perhaps to be seen from inside only.
    fn sides(&self, inside: bool) -> Sides {
        match inside {
            _ if self.transmits() => Sides::Both,
            true => Sides::Back,
            false => Sides::Front,
        }
    }
}

fn material([r, g, b, kd, ks, shine, t, ior]: [f32; 8], name: String) -> Result<Material, String> {
    rules::color(Vec3::new(r, g, b)).map_err(|problem| format!("r g b {problem}"))?;
    if !(shine >= 0.0 && shine.is_finite()) {
        return Err(format!("Shine must be finite and 0 or more, got {shine}"));
    }
    let glossy = shine > 0.0 && shine < NO_HIGHLIGHT;
    let default = Material::default();
    let material = Material {
        name,
        pigment: Pigment::Color(Vec3::new(r, g, b) * kd),
        reflectance: ks,
        transmission: t,
        // Files say 0 where nothing is transmitted.
        ior: if t > 0.0 { ior } else { 1.0 },
        additive: true,
        specular: if glossy { ks } else { 0.0 },
        shininess: if glossy { shine } else { default.shininess },
        ..default
    };
    let field = |key: String| match key.rsplit('.').next() {
        Some("color") => "r g b times Kd".into(),
        Some("reflectance") => "Ks".into(),
        Some("transmission") => "T".into(),
        field => field.unwrap_or_default().to_string(),
    };
    check::surface(&material, 0).map_err(|Invalid { key, problem }| format!("{} {problem}", field(key)))?;
    Ok(material)
}

#[cfg(test)]
#[path = "nff_tests.rs"]
mod tests;
