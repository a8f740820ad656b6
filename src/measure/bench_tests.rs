//! That a report is only valid when its answers are right.

use super::*;
use crate::math::HitBatch;
use crate::measure::answers::Answers;
use crate::scene::{compile, load, parse};

type Spoil<'a> = &'a dyn Fn(Kernel, &mut Answers);

fn options() -> Options {
    Options { size: [64, 32], rays: None, budget: Duration::ZERO }
}

/// A scene with mirrors and lights, so that three kinds of rays have answers.
fn classic() -> (Description, Scene) {
    let description = load("classic").expect("built in");
    let scene = compile(&description).expect("a sound scene");
    (description, scene)
}

fn valid(description: &Description, scene: &Scene, spoil: Spoil) -> bool {
    run_spoiled(description, scene, &options(), spoil).expect("a report").valid
}

/// Does something to the nearest hits.
fn nearest(answers: &mut Answers, change: impl Fn(&mut HitBatch)) {
    if let Answers::Nearest(hits) = answers {
        hits.iter_mut().for_each(change);
    }
}

#[test]
fn one_bit_of_one_kernel_makes_it_invalid() {
    let (description, scene) = classic();
    assert!(valid(&description, &scene, &|_, _| ()));
    for wrong in Kernel::ALL {
        assert!(!valid(&description, &scene, &|kernel, answers| if kernel == wrong {
            nearest(answers, |hits| hits.t[0] = hits.t[0].next_up());
        }));
        assert!(!valid(&description, &scene, &|kernel, answers| match answers {
            Answers::Any(blocked) if kernel == wrong => {
                let old = blocked[0].get(0, 1);
                blocked[0].set(0, 1, 1 - old);
            }
            _ => (),
        }));
    }
}

/// What all kernels have in common only the reference can tell: a distance off by 10⁻⁵, another primitive, a shadow.
#[test]
fn what_all_kernels_get_wrong_makes_it_invalid() {
    let (description, scene) = classic();
    let spoils: [Spoil; 4] = [
        &|_, answers| nearest(answers, |hits| hits.t.iter_mut().for_each(|t| *t *= 1.00001)),
        &|_, answers| nearest(answers, |hits| hits.primitive.iter_mut().for_each(|id| *id = (*id).min(4) + 1)),
        &|_, answers| nearest(answers, |hits| hits.primitive.fill(crate::math::NONE)),
        &|_, answers| {
            if let Answers::Any(blocked) = answers {
                blocked.iter_mut().for_each(|b| (0..256).step_by(32).for_each(|at| b.set(at, u32::MAX, u32::MAX)));
            }
        },
    ];
    for (i, spoil) in spoils.into_iter().enumerate() {
        assert!(!valid(&description, &scene, spoil), "{i}");
    }
}

/// The scene that is timed is the one that is judged.
#[test]
fn another_scene_makes_it_invalid() {
    let (description, _) = classic();
    let mut other = description.clone();
    other.spheres[0].radius *= 1.01;
    let scene = compile(&other).expect("a sound scene");
    assert!(!valid(&description, &scene, &|_, _| ()));
    assert!(!agrees_with_reference(&description, &scene));
}

/// Rays from a file are compared with the reference, whatever the camera sees.
#[test]
fn rays_of_a_file_are_judged() {
    let ball = |radius: f32| {
        let text = format!(
            "camera = {{ eye = [0, 0, 90], look_at = [0, 0, 100] }}\nmaterials.a.color = [1, 1, 1]\n\
             sphere = [{{ center = [0, 0, 0], radius = {radius}, material = \"a\" }}]"
        );
        parse(&text, "s.toml".as_ref()).expect("a sound scene")
    };
    let folder = tempfile::tempdir().expect("a folder");
    for (name, t_max) in [("a.rays", f32::INFINITY), ("a.shadow", 2.0005)] {
        let path = folder.path().join(name);
        let ray = [0.0, 0.0, 3.0, 0.5, 0.0, 0.0, -1.0, t_max];
        std::fs::write(&path, ray.map(f32::to_le_bytes).as_flattened().repeat(300)).expect("written");
        let options = Options { rays: Some(path), ..options() };
        for (radius, valid) in [(1.0, true), (0.999, false)] {
            let scene = compile(&ball(radius)).expect("a sound scene");
            assert_eq!(run(&ball(1.0), &scene, &options).expect("a report").valid, valid, "{name}, {radius}");
        }
    }
}

/// A ray that passes a sphere by 3 · 10⁻⁹ is taken for a tangent: that is within the bound, at the tangent's distance only.
#[test]
fn a_tangent_is_explained() {
    use crate::measure::verify::sample::{Answer, agrees};
    let text = "materials.a.color = [1, 1, 1]\ncamera = { eye = [0, 1, 5], look_at = [0, 1, 0] }\n\
                sphere = [{ center = [0, 1, 0], radius = 1, material = \"a\" }]";
    let tracer = Tracer::new(&parse(text, "s.toml".as_ref()).expect("a sound scene"));
    let mut rays = RayBatch::default();
    let direction = glam::Vec3::new(-0.197_989_91, 0.028_284_26, -0.979_795_93);
    rays.push(glam::Vec3::new(0.0, 1.0, 5.0), direction, 0.0, f32::INFINITY);
    let judged = |t: f32, id: u32| agrees(&tracer, std::slice::from_ref(&rays), |_, _| Answer::Nearest(t, id));
    assert!(tracer.intersect(rays.first_origin().as_dvec3(), direction.as_dvec3().normalize(), 99.0).is_none());
    assert!(judged(4.898_979, 0) && !judged(4.9, 0) && !judged(4.8, 0) && !judged(f32::NAN, 0));
    assert!(judged(f32::INFINITY, crate::math::NONE));
}
