//! A light behind something lights nothing, however close to the surface that something is.

use glam::{Vec3, vec3};
use raypacket::scene::Description;
use raypacket::shade::{SegmentKind, path};

use crate::common::{Pcg, compiled, empty, light, mesh, plane, sphere};
use crate::{SCALES, upward};

const RAYS: usize = 1000;

/// That every shadow ray is blocked, for eye rays that `look` gives; some have to be fired.
fn all_dark(description: &Description, name: &str, look: impl Fn(&mut Pcg) -> (Vec3, Vec3)) {
    let scene = compiled(description);
    let mut rng = Pcg::new(11);
    let mut shadows = 0;
    for _ in 0..RAYS {
        let (eye, to) = look(&mut rng);
        for s in path(&scene, eye, (to - eye).normalize()) {
            assert_ne!(s.kind, SegmentKind::Shadow { blocked: false }, "{name}: from {eye} to {to}: {s:?}");
            shadows += usize::from(s.kind != SegmentKind::Primary);
        }
    }
    assert!(shadows > RAYS / 10, "{name}: {shadows} shadow rays");
}

/// From within a sphere, with lights outside: next to it, near and far.
#[test]
fn a_sphere_keeps_light_out() {
    for scale in SCALES {
        for distance in [1.01, 1.5, 100.0, 1e6] {
            let mut scene = empty();
            let center = vec3(1.0, -2.0, 0.5) * scale;
            scene.spheres.push(sphere(center, scale));
            for _ in 0..3 {
                scene.lights.push(light(center + Pcg::new(5).unit() * (distance * scale)));
            }
            all_dark(&scene, &format!("sphere of {scale}, light at {distance}"), |rng| {
                let eye = center + rng.unit() * (scale * rng.range(0.0, 0.99));
                (eye, eye + rng.unit() * scale)
            });
        }
    }
}

/// A sphere within another that is a little larger.
#[test]
fn a_shell_shades_its_core() {
    for scale in SCALES {
        for gap in [1e-4, 1e-2, 1.0] {
            for distance in [0.1, 10.0, 1e6] {
                let outer = scale * (1.0 + gap);
                let mut scene = empty();
                let center = vec3(-1.0, 1.0, 0.5) * scale;
                scene.spheres = vec![sphere(center, scale), sphere(center, outer)];
                let mut rng = Pcg::new(9);
                scene.lights = (0..4).map(|_| light(center + rng.unit() * (outer + distance * scale))).collect();
                all_dark(&scene, &format!("core of {scale}, gap {gap}, light at {distance}"), |rng| {
                    let normal = rng.unit();
                    let to = center + normal * scale;
                    (to + normal * (gap * scale / 2.0), to)
                });
            }
        }
    }
}

/// Flat things under a plane or under a larger triangle, at a gap of a hundredth to twice their size.
#[test]
fn a_roof_shades_what_is_below() {
    for scale in SCALES {
        for gap in [0.01, 0.3, 2.0] {
            for distance in [0.5, 10.0, 300.0] {
                for kinds in 0..4 {
                    let name = format!("floor of {scale}, roof at {gap}, light at {distance}, kinds {kinds}");
                    let (below, above) = (kinds % 2 == 0, kinds / 2 == 0);
                    roof(&name, scale, gap * scale, distance * scale, below, above);
                }
            }
        }
    }
}

/// A floor at height 0 and a roof at `gap`, planes or triangles, and a light `distance` above that.
fn roof(name: &str, scale: f32, gap: f32, distance: f32, floor_is_plane: bool, roof_is_plane: bool) {
    let corners = [vec3(-1.0, 0.0, -1.0), vec3(1.0, 0.0, -1.0), vec3(0.0, 0.0, 1.0)];
    let mut scene = empty();
    // Tilted and turned, so that nothing is exact by chance.
    let tilt = glam::Quat::from_axis_angle(vec3(0.3, 0.2, -0.9).normalize(), 0.7);
    let up = tilt * Vec3::Y;
    if floor_is_plane {
        scene.planes.push(plane(up, 0.0));
    } else {
        scene.meshes.push(mesh(&[corners.map(|c| tilt * c * scale)]));
    }
    if roof_is_plane {
        scene.planes.push(plane(up, -gap));
    } else {
        scene.meshes.push(mesh(&[corners.map(|c| tilt * (c * (8.0 * scale) + Vec3::Y * gap))]));
    }
    scene.lights = vec![light(up * (gap + distance))];
    all_dark(&scene, name, |rng| {
        let to = tilt * vec3(rng.range(-0.2, 0.2), 0.0, rng.range(-0.4, 0.2)) * scale;
        (to + upward(up, rng) * (gap * 0.5), to)
    });
}

/// A sun above a plane above a plane.
#[test]
fn a_far_light_does_not_pass_a_thin_gap() {
    for (gap, distance) in [(0.1, 1e6), (1.0, 1e6), (1.0, 1e8)] {
        let mut scene = empty();
        scene.planes = vec![plane(Vec3::Y, 0.0), plane(Vec3::Y, -gap)];
        scene.lights = vec![light(Vec3::Y * distance)];
        all_dark(&scene, &format!("gap {gap}, light at {distance}"), |rng| {
            let to = vec3(rng.range(-1.0, 1.0), 0.0, rng.range(-1.0, 1.0));
            (to + upward(Vec3::Y, rng) * (gap * 0.5), to)
        });
    }
}
