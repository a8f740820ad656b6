//! Which bodies a ray is in: however many there are in each other, and wherever edges and faces lie.

use glam::{Vec3, vec3};
use raypacket::Cuboid;
use raypacket::measure::verify::verify;
use raypacket::render::Kernel;
use raypacket::scene::{CameraDescription, Description, Material, Sky};

use crate::common::{empty, picture, sphere};

/// A scene of clear glass that absorbs, under a gradient.
fn scene(absorption: f32) -> Description {
    let mut scene = empty();
    scene.camera = CameraDescription { eye: vec3(0.3, 0.2, 4.0), look_at: Vec3::ZERO, up: Vec3::Y, fov: 40.0 };
    scene.materials =
        vec![Material { transmission: 1.0, ior: 1.5, absorption: Vec3::splat(absorption), ..Material::default() }];
    scene.sky = Sky::Gradient { below: vec3(1.0, 0.2, 0.0), above: vec3(0.0, 0.3, 1.0) };
    scene.settings.max_depth = 64;
    scene
}

/// Shells of one glass within each other are one ball, but for the rays' slight shift at each.
#[test]
fn any_number_of_shells_is_one_ball() {
    let draw = |shells: usize| {
        let mut scene = scene(0.1);
        scene.spheres = (0..shells).map(|i| sphere(Vec3::ZERO, 1.2 - 0.9 * i as f32 / shells as f32)).collect();
        if shells < 12 {
            assert!(verify(&scene, &Kernel::ALL, 24, 24).pass, "{shells}");
        }
        picture(&scene, Kernel::X8, 48, 48).pixels
    };
    let one = draw(1);
    for shells in [2, 4, 5, 6, 12] {
        // The more surfaces, the sooner what is reflected within ends at the depth of 64, next to the rim.
        let many = draw(shells);
        let off = many.iter().zip(&one).filter(|(a, b)| Vec3::from(**a).distance(Vec3::from(**b)) > 1e-3);
        let off = off.count();
        assert!(off < 5 * shells, "{shells}: {off} of 2304");
    }
}

/// Balls that overlap at one place, more than four of them: all is light, and the reference agrees.
#[test]
fn many_overlapping_balls() {
    let mut scene = scene(0.0);
    scene.sky = Sky::Color(Vec3::ONE);
    let place = |i: usize| glam::Vec2::from_angle(i as f32).extend(0.0) * 0.5;
    scene.spheres = (0..11).map(|i| sphere(place(i), 1.0)).collect();
    let film = picture(&scene, Kernel::X8, 64, 64);
    // Some rays are caught by total reflection: one in a hundred.
    let dark = film.pixels.iter().filter(|p| p[0] < 0.99).count();
    assert!(dark < 80, "{dark}");
    assert!(verify(&scene, &Kernel::ALL, 32, 32).pass);
}

/// Whether an eye outside of all bodies, that looks away from them along (−1, −3, −2), sees the sky undimmed.
fn sees_the_sky(boxes: &[[Vec3; 2]], eye: Vec3) -> bool {
    let mut scene = scene(3.0);
    scene.sky = Sky::Color(Vec3::splat(0.5));
    scene.cuboids = boxes.iter().map(|&[min, max]| Cuboid { min, max, rotation: Vec3::ZERO, material: 0 }).collect();
    scene.camera = CameraDescription { eye, look_at: eye - vec3(1.0, 3.0, 2.0), up: Vec3::X, fov: 10.0 };
    let seen = picture(&scene, Kernel::X8, 8, 8).pixels.iter().all(|&pixel| pixel == [0.5; 3]);
    assert!(verify(&scene, &[Kernel::X8], 4, 4).pass);
    seen
}

/// Edges and corners exactly on the ray that asks, as round numbers bring about: of such boxes a third was wrong, when one
/// ray alone was asked.
#[test]
fn edges_and_corners_on_the_way_change_no_side() {
    for i in 0..8 * 27 {
        let sign = |bit: usize| if i >> bit & 1 == 1 { 1.0 } else { -1.0 };
        let eye = vec3((i / 8 % 3) as f32, (i / 24 % 3) as f32, (i / 72) as f32);
        let corner = eye + vec3(1.0, 3.0, 2.0);
        let other = corner + vec3(sign(0), sign(1), sign(2)) * vec3(0.5, 1.0, 1.5);
        let boxes = [[corner.min(other), corner.max(other)]];
        assert!(sees_the_sky(&boxes, eye), "{boxes:?} from {eye}");
    }
}

/// Where the faces of two boxes coincide, the one hides the other from a ray that goes from hit to hit.
#[test]
fn faces_that_coincide_hide_none_of_each_other() {
    for axis in [Vec3::X, Vec3::Y, Vec3::Z] {
        let boxes = [[Vec3::ZERO, Vec3::ONE], [axis, Vec3::ONE + axis]];
        let middle = Vec3::splat(0.5) + axis * 0.5;
        assert!(sees_the_sky(&boxes, middle - vec3(1.0, 3.0, 2.0) * 2.0), "{axis}");
    }
}
