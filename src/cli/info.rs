//! `raypacket info`: what a scene holds and how it will be traced.

use super::args::{DEFAULT_SCENE, Methods, count};
use super::failure::Failure;
use super::plan::PlanText;
use super::{input, print};
use raypacket::math::{isa, slower_than_cpu};
use raypacket::scene::{Description, KINDS, Scene, Sky, one_line};
use std::fmt;

#[derive(clap::Args)]
pub struct Args {
    /// A scene file (.toml, .nff, .obj) or a built-in scene
    #[arg(default_value = DEFAULT_SCENE)]
    scene: String,
    #[command(flatten)]
    methods: Methods,
}

pub fn run(args: &Args) -> Result<(), Failure> {
    let description = input::load(&args.scene)?;
    let scene = input::compile(&args.scene, &description, &args.methods.choices)?;
    print::line(Summary(&description, &scene))
}

/// A scene in a few lines.
struct Summary<'a>(&'a Description, &'a Scene);

impl fmt::Display for Summary<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self(scene, compiled) = self;
        let (camera, settings) = (&scene.camera, &scene.settings);
        let fall_off = if settings.attenuation { "power / (4 pi r^2)" } else { "power at any distance" };
        writeln!(f, "scene       {}", one_line(&scene.name))?;
        writeln!(f, "primitives  {}", list(scene.primitives(), &kinds(scene)))?;
        writeln!(f, "lights      {}, irradiance = {fall_off}", scene.lights.len())?;
        let materials: Vec<String> = scene.materials.iter().map(|m| one_line(&m.name)).collect();
        writeln!(f, "materials   {}", list(materials.len(), &materials))?;
        if !scene.textures.is_empty() {
            let textures: Vec<String> = scene.textures.iter().map(|t| format!("{} x {}", t.width, t.height)).collect();
            writeln!(f, "textures    {}", list(textures.len(), &textures))?;
        }
        writeln!(f, "sky         {}", sky(&scene.sky))?;
        writeln!(f, "max depth   {}", settings.max_depth)?;
        writeln!(
            f,
            "camera      eye {}, look at {}, up {}, fov {} degrees",
            camera.eye, camera.look_at, camera.up, camera.fov
        )?;
        writeln!(f, "build       {}, {}", isa(), slower_than_cpu().unwrap_or("as good as the CPU has".to_owned()))?;
        f.write_str("plan")?;
        for line in PlanText(&compiled.plan).to_string().lines() {
            write!(f, "\n  {line}")?;
            if line.starts_with("structure") {
                tree(compiled, f)?;
            }
        }
        Ok(())
    }
}

/// Writes the tree's statistics, below the reason that there is one.
fn tree(scene: &Scene, f: &mut fmt::Formatter<'_>) -> fmt::Result {
    let Some(bvh) = &scene.bvh else { return Ok(()) };
    let (stats, ms) = (bvh.stats(), scene.build_time.as_secs_f64() * 1e3);
    write!(f, "\n  tree        {stats}")?;
    let threads = count(rayon::current_num_threads());
    write!(f, "\n  build       {ms:.1} ms with {threads}, {} bytes", stats.bytes)
}

/// The numbers of primitives by kind, of those that there are.
fn kinds(scene: &Description) -> Vec<String> {
    let count = |n: usize, one: &str, many: &str| format!("{n} {}", if n == 1 { one } else { many });
    let kinds = KINDS.iter().zip(scene.counts()).filter(|(_, n)| *n > 0);
    let kinds = kinds.map(|(kind, n)| match kind.one {
        "triangle" => {
            let meshes = count(scene.meshes.len(), "mesh", "meshes");
            format!("{} in {meshes}", count(n, kind.one, kind.many))
        }
        _ => count(n, kind.one, kind.many),
    });
    kinds.collect()
}

fn sky(sky: &Sky) -> String {
    match sky {
        Sky::Color(color) => format!("color {color}"),
        Sky::Gradient { below, above } => format!("gradient from {below} below to {above} above"),
        Sky::Dome(dome) => format!("image {} x {}, turned {} degrees", dome.width, dome.height, dome.rotation),
    }
}

/// How many, and what; of many only the first.
fn list(n: usize, items: &[String]) -> String {
    const MOST: usize = 12;
    let shown = items[..items.len().min(MOST)].join(", ");
    match items.len() {
        0 => n.to_string(),
        all if all > MOST => format!("{n}: {shown} and {} more", all - MOST),
        _ => format!("{n}: {shown}"),
    }
}
