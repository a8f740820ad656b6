//! The radiance along rays.
use super::*;
use crate::scene::{Light, Sky};

fn lamp(position: Vec3) -> Light {
    Light { position, power: vec3(400.0, 200.0, 100.0) }
}

fn see(scene: &Description, origin: DVec3, direction: DVec3) -> DVec3 {
    Tracer::new(scene).radiance(origin, direction.normalize())
}

/// The irradiance of [`lamp`] at a distance.
fn irradiance(distance: f64) -> DVec3 {
    dvec3(400.0, 200.0, 100.0) / (4.0 * PI * distance * distance)
}

#[test]
fn sky_and_ambient() {
    let mut scene = planes(&[floor(0.0)]);
    scene.sky = Sky::Color(vec3(0.125, 0.25, 0.5));
    scene.settings.ambient = vec3(1.0, 2.0, 0.5);
    assert_eq!(see(&scene, DVec3::Y, DVec3::Y), dvec3(0.125, 0.25, 0.5));
    assert_eq!(see(&scene, DVec3::Y, -DVec3::Y), dvec3(0.5, 0.5, 0.5));
}

#[test]
fn light_falls_off_or_not_and_with_the_cosine() {
    let mut scene = planes(&[floor(0.0)]);
    scene.lights = vec![lamp(vec3(3.0, 4.0, 0.0))];
    let base = dvec3(0.5, 0.25, 1.0);
    let down = |scene: &Description| see(scene, DVec3::Y, -DVec3::Y);
    assert_near(down(&scene), irradiance(5.0) * base * 0.8);
    scene.settings.attenuation = false;
    assert_near(down(&scene), dvec3(400.0, 200.0, 100.0) * base * 0.8);
    scene.lights[0].position.y = -4.0;
    assert_eq!(down(&scene), DVec3::ZERO, "from below, the upper side stays dark");
}

#[test]
fn highlight_is_white_and_points_along_the_mirrored_ray() {
    let mut scene = planes(&[floor(0.0)]);
    scene.lights = vec![lamp(vec3(0.0, 2.0, 0.0))];
    scene.materials[0].specular = 0.5;
    scene.materials[0].shininess = 2.0;
    let seen = see(&scene, dvec3(1.0, 1.0, 0.0), dvec3(-1.0, -1.0, 0.0));
    // r·l is the cosine of 45 degrees, so (r·l)² is one half.
    assert_near(seen, irradiance(2.0) * (dvec3(0.5, 0.25, 1.0) + DVec3::splat(0.25)));
}

#[test]
fn shadows_from_what_lies_between_only() {
    let mut scene = planes(&[floor(0.0)]);
    scene.lights = vec![lamp(vec3(0.0, 4.0, 0.0))];
    let below = |scene: &Description| see(scene, dvec3(1.0, 1.0, 0.0), dvec3(-1.0, -1.0, 0.0)).length();
    let lit = below(&scene);
    assert!(lit > 0.0);
    for (center, radius, shadow) in
        [(vec3(0.0, 2.0, 0.0), 0.1, true), (vec3(0.0, 6.0, 0.0), 0.5, false), (vec3(0.0, -3.0, 0.0), 1.0, false)]
    {
        scene.spheres = vec![sphere(center, radius)];
        assert_eq!(below(&scene), if shadow { 0.0 } else { lit }, "{center}");
    }
}

#[test]
fn a_surface_through_the_light_does_not_block_it() {
    let mut scene = planes(&[floor(0.0), floor(4.0)]);
    scene.lights = vec![lamp(vec3(1.0, 4.0, 2.0))];
    assert!(see(&scene, DVec3::Y, dvec3(0.3, -1.0, 0.1)).x > 0.0);
}

/// Neither acne nor a lost shadow, whatever the scale and wherever the scene lies.
#[test]
fn lit_and_shadowed_sides_at_every_scale() {
    for scale in [1e-3_f32, 1.0, 1e3, 1e6] {
        for shift in [0.0, 3.0, -50.0] {
            let at = |v: Vec3| (v + shift * vec3(0.7, 0.0, 0.2)) * scale;
            let mut scene = planes(&[floor(0.0)]);
            scene.spheres = vec![sphere(at(Vec3::Y), scale)];
            scene.lights = vec![lamp(at(vec3(0.0, 20.0, 0.0)))];
            scene.settings.attenuation = false;
            for i in 1..100 {
                let eye = at(vec3(8.0, 6.0, 0.0)).as_dvec3();
                let side = |x: f32, y: f32| see(&scene, eye, at(vec3(x, y, 0.0)).as_dvec3() - eye).x;
                let angle = i as f32 / 100.0 * 1.5;
                assert!(side(angle.sin(), 1.0 + angle.cos()) > 0.0, "acne at {scale} {shift} {angle}");
                let x = i as f32 * 0.01;
                assert!(side(1.2 + x, 0.0) > 0.0, "acne on the floor at {scale} {shift} {x}");
            }
            assert_eq!(side_shadow(&scene, at(vec3(0.9, 0.0, 0.0))), 0.0, "shadow at {scale} {shift}");
        }
    }
}

/// The floor under the sphere, seen from just above it.
fn side_shadow(scene: &Description, target: Vec3) -> f64 {
    let target = target.as_dvec3();
    let eye = target + DVec3::Y * 1e-3 * f64::from(scene.spheres[0].radius);
    see(scene, eye, -DVec3::Y).x
}

#[test]
fn mirrors_stop_at_the_depth() {
    // Between two mirrors, every further segment adds ambient light, halved once more.
    let mut scene = planes(&[floor(0.0), floor(2.0)]);
    scene.materials[0].reflectance = 0.5;
    scene.materials[0].pigment = Pigment::Color(Vec3::ONE);
    scene.settings.ambient = Vec3::ONE;
    for (depth, expected) in [(1, 0.5), (2, 0.75), (3, 0.875), (6, 1.0 - 1.0 / 64.0)] {
        scene.settings.max_depth = depth;
        assert_near(see(&scene, DVec3::Y, -DVec3::Y), DVec3::splat(expected));
    }
}

#[test]
fn a_mirror_shows_the_sky_along_the_reflected_ray() {
    let mut scene = planes(&[floor(0.0)]);
    scene.materials[0].reflectance = 1.0;
    scene.sky = Sky::Color(vec3(0.5, 0.75, 1.0));
    assert_near(see(&scene, DVec3::Y, dvec3(1.0, -1.0, 0.0)), dvec3(0.5, 0.75, 1.0));
    scene.materials.push(Material { reflectance: 0.0, ..material() });
    scene.spheres = vec![Sphere { center: vec3(4.0, 3.0, 0.0), radius: 0.1, sides: Sides::Both, material: 1 }];
    assert_eq!(see(&scene, DVec3::Y, dvec3(1.0, -1.0, 0.0)), DVec3::ZERO, "the unlit sphere, seen in the mirror");
}

fn checkered(scene: Description, size: f32) -> Description {
    let pigment = Pigment::Checker { colors: [Vec3::X, Vec3::Y], size };
    let materials = vec![Material { pigment, ..material() }];
    let mut scene = Description { materials, ..scene };
    scene.settings.ambient = Vec3::ONE;
    scene
}

#[test]
fn checker_on_a_plane_and_on_negative_coordinates() {
    let scene = checkered(planes(&[floor(0.0)]), 2.0);
    // With n = Y: T = X and B = T × n = Z.
    for (x, z, even) in
        [(1.0, 1.0, true), (3.0, 1.0, false), (-1.0, 1.0, false), (-1.0, -1.0, true), (-3.0, -1.0, false)]
    {
        let expected = if even { DVec3::X } else { DVec3::Y };
        assert_eq!(see(&scene, dvec3(x, 1.0, z), -DVec3::Y), expected, "{x} {z}");
        assert_eq!(see(&scene, dvec3(x, -1.0, z), DVec3::Y), expected, "{x} {z} from below");
    }
}

#[test]
fn checker_axes_by_the_largest_component() {
    let axes = |normal: Vec3| {
        // n = ±X takes A = Z, n = ±Z takes A = X: B is T × n.
        let scene = checkered(planes(&[Plane { normal, distance: 0.0, material: 0 }]), 1.0);
        let n = normal.as_dvec3();
        move |point: DVec3| see(&scene, point + n, -n) == DVec3::X
    };
    assert!(axes(Vec3::X)(dvec3(0.0, 0.5, 0.5)) && !axes(Vec3::X)(dvec3(0.0, 0.5, -0.5)));
    assert!(!axes(Vec3::Z)(dvec3(0.5, 0.5, 0.0)), "B = X × Z = −Y, so ⌊−½⌋ is odd");
    assert!(axes(-Vec3::Z)(dvec3(0.5, 0.5, 0.0)), "B = X × −Z = Y");
}

#[test]
fn checker_on_a_triangle_follows_its_winding() {
    let corners = [vec3(-9.0, -9.0, 0.0), vec3(9.0, -9.0, 0.0), vec3(0.0, 9.0, 0.0)];
    let seen = |corners, z: f64| see(&checkered(triangle(corners), 1.0), dvec3(0.5, 0.5, z), dvec3(0.0, 0.0, -z));
    assert_eq!(seen(corners, 1.0), DVec3::Y);
    assert_eq!(seen(corners, -1.0), DVec3::Y, "the side it is seen from does not matter");
    let [a, b, c] = corners;
    assert_eq!(seen([a, c, b], 1.0), DVec3::X, "the winding does");
}

#[test]
fn checker_in_a_sphere_is_solid() {
    let scene = checkered(spheres(&[sphere(vec3(10.0, 0.0, 0.0), 2.0)]), 1.0);
    let from = |x: f64, y: f64, z: f64| {
        let out = dvec3(x, y, z).normalize();
        see(&scene, dvec3(10.0, 0.0, 0.0) + 5.0 * out, -out)
    };
    // 2 / √3 = 1.15: the eight diagonal points lie in cells 1 or −2.
    assert_eq!(from(1.0, 1.0, 1.0), DVec3::Y);
    assert_eq!(from(-1.0, 1.0, 1.0), DVec3::X);
    assert_eq!(from(-1.0, -1.0, 1.0), DVec3::Y);
    assert_eq!(from(-1.0, -1.0, -1.0), DVec3::X);
}

#[test]
fn a_lift_rises_above_small_blockers() {
    let mut scene = planes(&[floor(0.0)]);
    scene.spheres = vec![sphere(vec3(1.0, 0.002, 0.0), 0.001)];
    scene.lights = vec![lamp(vec3(1.0, 4.0, 0.0))];
    let seen = |lift: f64| {
        let rounding = Rounding { lift, ..Rounding::FINE };
        let (origin, direction) = (dvec3(0.0, 1.0, 0.0), dvec3(1.0, -1.0, 0.0).normalize());
        Tracer::new(&scene).radiance_rounded(origin, direction, &rounding).x
    };
    assert_eq!((seen(Rounding::FINE.lift), seen(1e-4)), (0.0, 0.0));
    assert!(seen(0.01) > 0.0);
}

#[test]
fn a_shift_moves_what_a_mirror_shows_but_not_what_the_eye_sees() {
    let mut scene = checkered(planes(&[floor(0.0)]), 1.0);
    let seen = |scene: &Description, y: f64, shift: DVec3| {
        let rounding = Rounding { shift, ..Rounding::FINE };
        Tracer::new(scene).radiance_rounded(dvec3(0.01, y, 0.5), -DVec3::Y, &rounding)
    };
    let shift = -0.1 * DVec3::X;
    assert_eq!(seen(&scene, 1.0, shift), DVec3::X);
    // The same board, now seen from below in a mirror further down.
    scene.planes.push(Plane { material: 1, ..floor(-1.0) });
    scene.materials.push(Material { reflectance: 1.0, ..material() });
    assert_eq!(seen(&scene, -0.5, DVec3::ZERO), DVec3::X);
    assert_eq!(seen(&scene, -0.5, shift), DVec3::Y);
}
