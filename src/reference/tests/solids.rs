//! Boxes, Menger sponges and discs.
use super::*;
use crate::reference::{cuboid, disc, fractal};
use crate::scene::{Cuboid, Disc, Fractal};
use glam::DVec2;

fn cuboid(rotation: Vec3) -> cuboid::Cuboid {
    cuboid::Cuboid::new(&Cuboid { min: vec3(-1.0, -2.0, -4.0), max: vec3(1.0, 2.0, 4.0), rotation, material: 0 })
}

fn sponge(iterations: u32) -> fractal::Fractal {
    fractal::Fractal::new(&Fractal { center: Vec3::ZERO, radius: 1.5, iterations, material: 0 })
}

#[test]
fn box_from_outside_inside_on_and_in_a_face() {
    let it = cuboid(Vec3::ZERO);
    assert_eq!(it.distance(dvec3(5.0, 1.0, 1.0), -DVec3::X), Some(4.0));
    assert_eq!(it.distance(dvec3(5.0, 1.0, 1.0), DVec3::X), None);
    assert_eq!(it.distance(dvec3(0.0, 1.0, 1.0), -DVec3::X), Some(1.0), "inside");
    assert_eq!(it.distance(dvec3(1.0, 1.0, 1.0), -DVec3::X), Some(2.0), "on a face, entering");
    assert_eq!(it.distance(dvec3(1.0, 1.0, 1.0), DVec3::X), None, "on a face, leaving");
    assert_eq!(it.distance(dvec3(1.0, 5.0, 1.0), dvec3(-0.0, -1.0, 0.0)), Some(3.0), "in a face's plane");
    assert_eq!(it.distance(dvec3(1.000_001, 5.0, 1.0), -DVec3::Y), None, "beside it");
    assert_eq!(it.project(dvec3(1.1, 0.5, 0.25)), dvec3(1.0, 0.5, 0.25));
}

#[test]
fn box_turned_about_x_then_y_then_z() {
    // x goes to y by the last turn, z to −y by the first and on to x.
    let it = cuboid(vec3(90.0, 0.0, 90.0));
    assert_eq!(it.distance(dvec3(9.0, 0.0, 0.0), -DVec3::X), Some(5.0));
    assert_eq!(it.distance(dvec3(0.0, 9.0, 0.0), -DVec3::Y), Some(8.0));
    assert_eq!(it.distance(dvec3(0.0, 0.0, 9.0), -DVec3::Z), Some(7.0));
    assert_eq!(it.normal(dvec3(4.0, 0.5, 0.5)), DVec3::X);
    let slanted = cuboid(vec3(0.0, 0.0, 45.0));
    let corner = slanted.distance(dvec3(0.0, 9.0, 0.0), -DVec3::Y).unwrap();
    assert!((corner - (9.0 - 2.0_f64.sqrt())).abs() < 1e-12, "{corner}");
}

#[test]
fn box_texture_and_checker() {
    let it = cuboid(Vec3::ZERO);
    for (point, uv, checker) in [
        (dvec3(1.0, -1.0, -2.0), [0.75, 0.25], dvec3(0.0, -1.0, -2.0)),
        (dvec3(-1.0, -1.0, -2.0), [0.25, 0.25], dvec3(0.0, -1.0, -2.0)),
        (dvec3(-0.5, 2.0, -2.0), [0.25, 0.75], dvec3(-0.5, 0.0, -2.0)),
        (dvec3(-0.5, -2.0, -2.0), [0.25, 0.25], dvec3(-0.5, 0.0, -2.0)),
        (dvec3(-0.5, -1.0, 4.0), [0.25, 0.25], dvec3(-0.5, -1.0, 0.0)),
        (dvec3(-0.5, -1.0, -4.0), [0.75, 0.25], dvec3(-0.5, -1.0, 0.0)),
    ] {
        assert_eq!((it.uv(point), it.checker(point)), (DVec2::from(uv), checker), "{point}");
    }
}

#[test]
fn sponge_bores_walls_and_inside() {
    let it = sponge(1);
    assert_eq!(it.distance(dvec3(0.2, 0.3, 4.0), -DVec3::Z), None, "through a bore");
    assert_eq!(it.distance(dvec3(1.2, 0.3, 4.0), -DVec3::Z), Some(2.5), "a wall beside it");
    assert_eq!(it.distance(dvec3(1.2, 0.3, 0.0), -DVec3::Z), Some(0.5), "out of a bore into the wall");
    assert_eq!(it.distance(dvec3(1.0, 1.0, 1.0), -DVec3::Z), Some(2.5), "three cubes in a row have no face between");
    assert_eq!(it.distance(dvec3(1.0, 1.0, 0.0), -DVec3::X), Some(0.5), "out into a bore");
    assert_eq!(it.distance(dvec3(1.5, 1.0, 1.0), DVec3::X), None, "on the surface, leaving");
    let corner = it.distance(DVec3::ONE, -DVec3::ONE.normalize()).unwrap();
    assert!((corner - 0.75_f64.sqrt()).abs() < 1e-15, "{corner}");
    assert_eq!(it.normal(dvec3(0.2, 0.5, 1.2)), -DVec3::Y, "the wall faces into the bore");
    assert!(it.uv(dvec3(0.3, 0.5, 1.2)).abs_diff_eq(DVec2::new(0.6, 0.9), 1e-15));
}

#[test]
fn sponge_is_as_dense_as_its_twenty_cubes() {
    // Rays along z at the middles of the smallest cubes: what is solid of each is 20/27 of 20/27 in all.
    let it = sponge(2);
    let mut solid = 0.0;
    for i in 0..81 {
        let at = |k: i32| (f64::from(k) + 0.5) / 3.0 - 1.5;
        let mut from = dvec3(at(i % 9), at(i / 9), 2.0);
        let mut inside = false;
        while let Some(t) = it.distance(from, -DVec3::Z) {
            // On to beyond the face, whatever rounding says.
            let step = t + 1e-9;
            solid += if inside { step } else { 0.0 };
            inside = !inside;
            from.z -= step;
        }
        assert!(!inside, "{i}");
    }
    assert!((solid / 243.0 - 400.0 / 729.0).abs() < 1e-8, "{solid}");
}

fn disc(inner_radius: f32) -> disc::Disc {
    disc::Disc::new(&Disc {
        center: vec3(1.0, 2.0, 3.0),
        normal: Vec3::Y * 4.0,
        radius: 2.5,
        inner_radius,
        material: 0,
    })
}

#[test]
fn disc_from_both_sides_hole_edges_and_in_its_plane() {
    for (x, z, whole, ring) in [
        (0.0, 0.0, true, false),
        (1.0, 0.0, true, false),
        (0.9, 1.2, true, true),
        (-1.75, 0.0, true, true),
        (-1.5, -2.0, true, true),
        (2.5, 0.0, true, true),
        (0.0, 2.6, false, false),
    ] {
        for (side, inner, hit) in [(1.0, 0.0, whole), (-1.0, 0.0, whole), (1.0, 1.25, ring), (-1.0, 1.25, ring)] {
            let it = disc(inner);
            let origin = dvec3(1.0 + x, 2.0 + 3.0 * side, 3.0 + z);
            assert_eq!(it.distance(origin, -DVec3::Y * side), hit.then_some(3.0), "{x} {z} {inner}");
            assert_eq!(it.distance(origin, DVec3::Y * side), None, "behind");
        }
    }
    let it = disc(0.0);
    assert_eq!(it.distance(dvec3(-9.0, 2.0, 3.0), DVec3::X), None, "in its plane");
    assert_eq!(it.distance(dvec3(1.5, 2.0, 3.0), DVec3::Y), None, "on it, leaving");
    assert_eq!(it.project(dvec3(1.5, 2.5, 3.0)), dvec3(1.5, 2.0, 3.0));
}

#[test]
fn disc_texture_and_checker() {
    // About y, T = x and B = z.
    let it = disc(0.5);
    for (q, uv, checker) in [
        (dvec3(0.0, 0.0, 1.5), [0.5, 0.5], dvec3(0.0, 1.5, 0.0)),
        (dvec3(2.5, 0.0, 0.0), [0.75, 1.0], dvec3(2.5, 0.0, 0.0)),
        (dvec3(-0.5, 0.0, 0.0), [0.25, 0.0], dvec3(-0.5, 0.0, 0.0)),
    ] {
        let point = dvec3(1.0, 2.0, 3.0) + q;
        assert_eq!((it.uv(point), it.checker(point)), (DVec2::from(uv), checker), "{q}");
    }
}
