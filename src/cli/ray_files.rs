//! `bench --save-rays`: the rays of pictures as files that `bench --rays` reads.

use super::failure::Failure;
use super::folder;
use raypacket::files::Target;
use raypacket::measure::{rays, streams::Streams};
use raypacket::scene::{Description, Scene};
use raypacket::{Camera, math::RayBatch};
use std::collections::HashSet;
use std::path::Path;

/// The files of some scenes, one for each kind of ray.
pub struct RayFiles {
    scenes: Vec<[Target; 4]>,
}

impl RayFiles {
    /// Makes the folder, and checks that the files of all scenes can be written.
    pub fn new(folder: &Path, scenes: &[Description]) -> Result<Self, Failure> {
        let names: Vec<String> = scenes.iter().map(|scene| file_name(&scene.name)).collect();
        let mut known = HashSet::new();
        if let Some(twice) = names.iter().find(|name| !known.insert(*name)) {
            return Err(Failure::input(format!("--save-rays: two scenes would write {twice}.primary")));
        }
        folder::make(folder)?;
        let target = |name: &str, kind| Target::new(&folder.join(format!("{name}.{kind}"))).map_err(Failure::input);
        let targets = |name: &String| -> Result<[Target; 4], Failure> {
            let [a, b, c, d] = Streams::KINDS.map(|kind| target(name, kind));
            Ok([a?, b?, c?, d?])
        };
        Ok(Self { scenes: names.iter().map(targets).collect::<Result<_, _>>()? })
    }

    /// Writes what there is of the rays of scene `i`, and gives a line for each file.
    pub fn save(
        &self,
        i: usize,
        description: &Description,
        scene: &Scene,
        [width, height]: [usize; 2],
    ) -> Result<Vec<String>, Failure> {
        let camera = Camera::new(&description.camera, width as f32 / height as f32);
        let streams = Streams::of(scene, &camera, width, height);
        let mut lines = Vec::new();
        for (target, batches) in self.scenes[i].iter().zip(streams.kinds()) {
            if batches.iter().all(|batch| batch.active() == 0) {
                continue;
            }
            let count = write(target, batches)?;
            lines.push(format!("saved {}: {count} rays", target.path().display()));
        }
        Ok(lines)
    }
}

fn write(target: &Target, batches: &[RayBatch]) -> Result<u64, Failure> {
    let mut count = 0;
    let written = target.write(|file| {
        count = rays::write(batches, file)?;
        Ok(())
    });
    written.map_err(Failure::runtime)?;
    Ok(count)
}

/// A scene's name as the name of a file, whatever signs it has.
fn file_name(scene: &str) -> String {
    let fit = |c: char| if c.is_alphanumeric() || "-_.".contains(c) { c } else { '_' };
    let name: String = scene.chars().map(fit).collect();
    if name.is_empty() { "scene".to_owned() } else { name }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_names_of_files() {
        assert_eq!(["balls", "a b/c", "", "é-1.2"].map(file_name), ["balls", "a_b_c", "scene", "é-1.2"]);
    }
}
