//! Paints the pictures of the built-in scenes: `cargo run --example pictures` writes them to `scenes/textures/`.
mod art;

use image::{ExtendedColorType, ImageEncoder, Rgb, codecs::hdr::HdrEncoder, codecs::png};
use std::{error::Error, fs, fs::File, path::Path};

fn main() -> Result<(), Box<dyn Error>> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes/textures");
    fs::create_dir_all(&folder)?;
    for (name, texels, width) in [("brick.png", art::brick(), 256), ("globe.png", art::globe(), 512)] {
        let file = File::create(folder.join(name))?;
        let encoder = png::PngEncoder::new_with_quality(file, png::CompressionType::Best, png::FilterType::Adaptive);
        let height = (texels.len() / width) as u32;
        encoder.write_image(texels.as_flattened(), width as u32, height, ExtendedColorType::Rgb8)?;
    }
    let dusk: Vec<Rgb<f32>> = art::dusk().into_iter().map(Rgb).collect();
    HdrEncoder::new(File::create(folder.join("dusk.hdr"))?).encode(&dusk, 256, dusk.len() / 256)?;
    Ok(())
}
