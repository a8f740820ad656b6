//! Single rays on which tree and brute force once differed, as the brute force was wrong.

use glam::{Vec3, vec3};
use raypacket::math::RayBatch;
use raypacket::scene::{Cuboid, Description, Quad};
use raypacket::trace::NONE;

use crate::common::{Pcg, empty, mesh, sphere};
use crate::pair::Pair;

/// Checks the ray, and gives its distance and id.
fn trace(description: Description, origin: Vec3, direction: Vec3) -> (f32, u32) {
    let mut pair = Pair::new(description);
    let mut one = RayBatch::default();
    one.push(origin, direction, 0.0, f32::INFINITY);
    let hits = pair.hits(&one);
    pair.check(&one, "a ray that was found");
    (hits.t[0], hits.primitive[0])
}

fn triangle(corners: [Vec3; 3]) -> Description {
    let mut scene = empty();
    scene.meshes.push(mesh(&[corners]));
    scene
}

/// Seen edge-on, all three edge functions are 0 everywhere in the plane.
#[test]
fn beside_a_triangle_in_its_plane() {
    let corners = [vec3(0.0, 0.3, 0.0), vec3(0.1, 0.3, 0.0), vec3(0.1, 0.4, 0.0)];
    let (_, id) = trace(triangle(corners), vec3(0.2, 0.5, 0.0), vec3(-7.79546e-9, -1.0, 5.17242e-9));
    assert_eq!(id, NONE, "it passes 0.1 beside the triangle");
}

/// All corners are one point after rounding, and the edge functions 0 for any ray.
#[test]
fn a_triangle_smaller_than_the_rounding_of_its_distance() {
    let corners = [vec3(1.6e-11, -7e-11, -1.1e-11), vec3(-7.9e-11, -5.7e-11, 7.2e-11), vec3(-6e-11, 6e-11, 1.2e-10)];
    let mut rng = Pcg::new(0);
    for _ in 0..100 {
        let (origin, direction) = (rng.unit(), rng.unit());
        let past = origin.cross(direction).length();
        let (t, id) = trace(triangle(corners), origin, direction);
        assert!(id == NONE || past < 1e-5, "{origin} {direction}: {t}, though the ray passes {past} beside it");
    }
}

#[test]
fn a_triangle_without_area() {
    let [a, b] = [vec3(-0.809_227, 0.309_904_58, -0.523_078_3), vec3(-0.426_568_98, -0.342_247_78, -1.177_501_8)];
    let origin = vec3(-0.785_474_54, -0.442_153_8, -2.461_352_3);
    let (_, id) = trace(triangle([a, b, b]), origin, vec3(-0.382_658, 0.652_152_36, 0.654_423_5));
    assert_eq!(id, NONE);
}

/// From a quad's corner in its plane: the test's distance is far off, and comes to lie before the sphere only within
/// the quad's box.
#[test]
fn a_hit_that_the_box_brings_before_another() {
    let v = vec3(-0.028_762_301, -0.297_729_5, -0.221_006_2);
    let mut scene = empty();
    scene.spheres.push(sphere(Vec3::ZERO, 0.4));
    let u = vec3(-0.092_170_2, 0.237_701_33, -0.308_225_15);
    scene.quads.push(Quad { corner: vec3(0.0, 0.0, -0.0), u, v, material: 0 });
    trace(scene, v, vec3(-0.077_337_615, -0.800_551, -0.594_253_3));
}

/// Where a batch says that its rays start at one point, only ray 0's is read, by the boxes of rare kinds as well.
#[test]
fn one_origin_before_boxes() {
    let mut scene = empty();
    let cuboid = Cuboid { min: Vec3::NEG_ONE, max: Vec3::ONE, rotation: Vec3::ZERO, material: 0 };
    scene.cuboids.push(cuboid);
    let mut pair = Pair::new(scene);
    let mut rays = RayBatch::default();
    for _ in 0..20 {
        rays.push(vec3(0.5, 0.25, 3.0), Vec3::NEG_Z, 0.0, f32::INFINITY);
    }
    assert!(rays.common_origin);
    (0..3).for_each(|axis| rays.origin[axis][1..].fill(50.0));
    assert_eq!(pair.hits(&rays).t[..20], [2.0; 20]);
    pair.check(&rays, "one origin before a box");
}
