//! `raypacket render`: a picture into a file.

use super::args::{DEFAULT_SCENE, Methods, Size, Threads, count};
use super::failure::Failure;
use super::progress::Progress;
use super::{input, print};
use clap::builder::{PossibleValuesParser, TypedValueParser};
use raypacket::files::Target;
use raypacket::reference;
use raypacket::render::output::{Aov, Format, write_aov, write_film};
use raypacket::render::{ALIKE, Camera, Film, Kernel, PrimaryHits, Samples, primary_hits, render_samples};
use raypacket::scene::{Description, Scene};
use raypacket::trace::NONE;
use std::path::PathBuf;
use std::time::Instant;

#[derive(clap::Args)]
pub struct Args {
    /// A scene file (.toml, .nff, .obj) or a built-in scene
    #[arg(default_value = DEFAULT_SCENE)]
    scene: String,
    /// The picture: FILE.png (8-bit sRGB) or FILE.exr (linear 32-bit floats)
    #[arg(short, long, value_name = "FILE")]
    output: PathBuf,
    /// The picture's width and height in pixels
    #[arg(long, allow_hyphen_values = true, value_name = "WxH", default_value = "1024x512")]
    size: Size,
    /// N x N rays a pixel on a regular grid, 1 to 64, or adaptive: 4 x 4 where neighbours differ by more than 5 of 255
    /// display codes, or adaptive:CODES, and 4 elsewhere
    #[arg(long, allow_negative_numbers = true, value_name = "N|adaptive[:CODES]", default_value = "1", value_parser = samples)]
    samples: Samples,
    /// How many rays are traced at once, or the slow scalar tracer that all else is checked against
    #[arg(long, default_value = "x8", value_parser = tracer())]
    kernel: Tracer,
    #[command(flatten)]
    methods: Methods,
    #[command(flatten)]
    threads: Threads,
    /// Write what the rays through the pixels' centres hit, instead of colours
    #[arg(long, value_parser = aov(), conflicts_with = "samples")]
    aov: Option<Aov>,
}

/// Who makes the picture.
#[derive(Clone, Copy, PartialEq)]
enum Tracer {
    Packets(Kernel),
    Reference,
}

fn samples(text: &str) -> Result<Samples, String> {
    match text.parse() {
        Ok(n @ 1..=64) => Ok(Samples::Grid(n)),
        _ if text == "adaptive" => Ok(Samples::Adaptive(ALIKE)),
        _ => match text.strip_prefix("adaptive:").map(str::parse) {
            None => Err("not in 1..=64, and not `adaptive`".into()),
            Some(Ok(codes)) => Ok(Samples::Adaptive(codes)),
            Some(Err(_)) => Err("after `adaptive:` come 0 to 255 display codes".into()),
        },
    }
}

impl Tracer {
    fn name(self) -> &'static str {
        match self {
            Self::Packets(kernel) => kernel.name(),
            Self::Reference => "reference",
        }
    }
}

fn tracer() -> impl TypedValueParser<Value = Tracer> {
    let all = [Kernel::X1, Kernel::X4, Kernel::X8].map(Tracer::Packets).into_iter().chain([Tracer::Reference]);
    let all: Vec<Tracer> = all.collect();
    PossibleValuesParser::new(all.iter().map(|t| t.name()).collect::<Vec<_>>()).map(move |name| {
        let found = all.iter().find(|t| t.name() == name);
        *found.expect("clap lets only the names of tracers through")
    })
}

fn aov() -> impl TypedValueParser<Value = Aov> {
    PossibleValuesParser::new(Aov::ALL.map(Aov::name)).map(|name| {
        let found = Aov::ALL.into_iter().find(|a| a.name() == name);
        found.expect("clap lets only the names of AOVs through")
    })
}

pub fn run(args: &Args) -> Result<(), Failure> {
    // Whatever may be wrong comes first: a long render whose picture cannot be saved helps nobody.
    let Some(format) = Format::of(&args.output) else {
        return Err(Failure::input(format!("{}: a picture is a .png or .exr file", args.output.display())));
    };
    if args.kernel == Tracer::Reference && matches!(args.samples, Samples::Adaptive(_)) {
        return Err(Failure::input("--samples adaptive: the reference traces all rays; give it a number"));
    }
    let threads = args.threads.start();
    let description = input::load(&args.scene)?;
    let target = Target::new(&args.output).map_err(Failure::input)?;
    let threads = threads?;
    let scene = input::compile(&args.scene, &description, &args.methods.choices)?;

    let started = Instant::now();
    let picture = match args.aov {
        None => Picture::Film(film(args, &description, &scene)),
        Some(aov) => Picture::Hits(aov, hits(args, &description, &scene)),
    };
    let seconds = started.elapsed().as_secs_f64();
    let saved = match &picture {
        Picture::Film(film) => write_film(film, format, &target),
        Picture::Hits(aov, hits) => write_aov(hits, *aov, args.size.width, format, &target),
    };
    saved.map_err(Failure::runtime)?;
    print::line(format_args!(
        "{}: {}, {} pixels, kernel {}, {}, {seconds:.3} s",
        args.output.display(),
        description.name,
        args.size,
        args.kernel.name(),
        count(threads),
    ))
}

enum Picture {
    Film(Film),
    Hits(Aov, PrimaryHits),
}

fn film(args: &Args, description: &Description, scene: &Scene) -> Film {
    let Size { width, height } = args.size;
    let mut film = Film::new(width, height);
    match args.kernel {
        Tracer::Packets(kernel) => {
            let camera = Camera::new(&description.camera, args.size.aspect());
            let progress = Progress::new();
            let set = |share| progress.set(share);
            render_samples(scene, &camera, kernel, args.samples, &mut film, &set);
        }
        Tracer::Reference => {
            let Samples::Grid(samples) = args.samples else { return film };
            let progress = Progress::new();
            let set = |share| progress.set(share);
            let radiance = reference::render_with_progress(description, width, height, samples, &set);
            film.pixels = radiance.into_iter().map(|rgb| rgb.as_vec3().to_array()).collect();
        }
    }
    film
}

fn hits(args: &Args, description: &Description, scene: &Scene) -> PrimaryHits {
    let Size { width, height } = args.size;
    match args.kernel {
        Tracer::Packets(kernel) => {
            let camera = Camera::new(&description.camera, args.size.aspect());
            primary_hits(scene, &camera, kernel, width, height)
        }
        Tracer::Reference => {
            let hits = reference::hits(description, width, height);
            let camera = reference::Camera::new(&description.camera, width as f64 / height as f64);
            let ray = |x: f64, y: f64| camera.ray(x / width as f64, y / height as f64).1;
            let view = ray(width as f64 / 2.0, height as f64 / 2.0);
            let along = |i: usize| view.dot(ray((i % width) as f64 + 0.5, (i / width) as f64 + 0.5));
            let normals = |normal: fn(&reference::Hit) -> glam::DVec3| {
                hits.iter().map(|h| h.map_or([0.0; 3], |h| normal(&h).as_vec3().to_array())).collect()
            };
            let depth = |i: usize| hits[i].map_or(f64::INFINITY, |h| h.t);
            PrimaryHits {
                t: (0..hits.len()).map(|i| depth(i) as f32).collect(),
                z: (0..hits.len()).map(|i| (depth(i) * along(i)) as f32).collect(),
                primitive: hits.iter().map(|h| h.map_or(NONE, |h| h.primitive)).collect(),
                normal: normals(|h| h.normal),
                shading_normal: normals(|h| h.shading_normal),
            }
        }
    }
}
