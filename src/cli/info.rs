//! `raypacket info`: what a scene holds and how it will be traced.

use super::args::DEFAULT_SCENE;
use super::{Failure, input, print};
use raypacket::scene::{Description, Plan, one_line};
use std::fmt;

#[derive(clap::Args)]
pub struct Args {
    /// A scene file (.toml) or a built-in scene
    #[arg(default_value = DEFAULT_SCENE)]
    scene: String,
}

pub fn run(args: &Args) -> Result<(), Failure> {
    let description = input::load(&args.scene)?;
    let scene = input::compile(&args.scene, &description)?;
    print::line(Summary(&description, &scene.plan))
}

/// A scene in a few lines.
struct Summary<'a>(&'a Description, &'a Plan);

impl fmt::Display for Summary<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self(scene, plan) = self;
        let triangles: usize = scene.meshes.iter().map(|m| m.triangles.len()).sum();
        let (camera, settings) = (&scene.camera, &scene.settings);
        let fall_off = if settings.attenuation { "power / (4 pi r^2)" } else { "power at any distance" };
        writeln!(f, "scene       {}", one_line(&scene.name))?;
        writeln!(
            f,
            "primitives  {}: {}, {}, {} in {}",
            scene.primitives(),
            count(scene.planes.len(), "plane"),
            count(scene.spheres.len(), "sphere"),
            count(triangles, "triangle"),
            if scene.meshes.len() == 1 { "1 mesh".into() } else { format!("{} meshes", scene.meshes.len()) },
        )?;
        writeln!(f, "lights      {}, irradiance = {fall_off}", scene.lights.len())?;
        let materials: Vec<String> = scene.materials.iter().map(|m| one_line(&m.name)).collect();
        writeln!(f, "materials   {}: {}", materials.len(), materials.join(", "))?;
        writeln!(f, "max depth   {}", settings.max_depth)?;
        writeln!(
            f,
            "camera      eye {}, look at {}, up {}, fov {} degrees",
            camera.eye, camera.look_at, camera.up, camera.fov
        )?;
        writeln!(f, "plan")?;
        let plan = plan.to_string();
        let lines: Vec<String> = plan.lines().map(|line| format!("  {line}")).collect();
        f.write_str(&lines.join("\n"))
    }
}

fn count(n: usize, noun: &str) -> String {
    format!("{n} {noun}{}", if n == 1 { "" } else { "s" })
}
