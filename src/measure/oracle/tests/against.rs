//! All kinds against the `f64` reference, where rounding decides nothing.
use super::*;
use crate::reference::Tracer;
use crate::scene::{Material, Mesh};

fn described(shape: &Shape) -> Description {
    let mut scene = Description { materials: vec![Material::default()], ..Description::default() };
    match shape.clone() {
        Shape::Plane(it) => scene.planes.push(it),
        Shape::Sphere(it) => scene.spheres.push(it),
        Shape::Triangle(it) => scene.meshes.push(Mesh {
            positions: it.corners.to_vec(),
            triangles: vec![[0, 1, 2]],
            sides: it.sides,
            ..Mesh::default()
        }),
        Shape::Quad(it) => scene.quads.push(it),
        Shape::Cuboid(it) => scene.cuboids.push(it),
        Shape::Cylinder(it) => scene.cylinders.push(it),
        Shape::Cone(it) => scene.cones.push(it),
        Shape::Torus(it) => scene.tori.push(it),
        Shape::Fractal(it) => scene.fractals.push(it),
        Shape::Disc(it) => scene.discs.push(it),
    }
    scene
}

#[test]
fn the_reference_agrees() {
    let mut random = Random(51);
    (0..KINDS - 1).for_each(|kind| agrees(kind, &mut random));
}

#[test]
fn the_reference_agrees_about_discs() {
    agrees(KINDS - 1, &mut Random(53));
}

fn agrees(kind: usize, random: &mut Random) {
    let (mut hits, mut misses) = (0, 0);
    for _ in 0..240 {
        let (shape, ray) = (random.shape(kind), Ray { normalized: true, ..random.ray() });
        if !settled(&shape, &ray, 0.0, f64::INFINITY, 1e-9) {
            continue;
        }
        let direction = ray.direction.as_dvec3().normalize();
        let expected = Tracer::new(&described(&shape)).intersect(ray.origin.as_dvec3(), direction, f64::INFINITY);
        let truth = nearest(&shape, &ray, 0.0, f64::INFINITY);
        assert_eq!(truth.is_some(), expected.is_some(), "{shape:?} {ray:?} {truth:?} {expected:?}");
        let (Some(truth), Some(expected)) = (truth, expected) else {
            misses += 1;
            continue;
        };
        hits += 1;
        // The reference is off by some ε of f64 in the point, and t by that over the cosine of incidence.
        let cosine = truth.normal.dot(direction).abs();
        assert!((truth.t - expected.t).abs() * cosine < 1e-12, "{shape:?} {ray:?} {truth:?} {expected:?}");
        let turned = if truth.normal.dot(direction) > 0.0 { -truth.normal } else { truth.normal };
        assert!(turned.abs_diff_eq(expected.normal, 1e-9 / cosine), "{shape:?} {ray:?} {truth:?} {expected:?}");
    }
    assert!(hits > 8 && misses > 20, "kind {kind}: {hits} hits, {misses} misses");
}

/// Ids count as the tracer's do.
#[test]
fn shapes_come_in_the_order_of_ids() {
    let mut random = Random(52);
    let all = (0..KINDS).flat_map(|kind| [kind, kind]).map(|kind| random.shape(kind)).collect::<Vec<_>>();
    let mut scene = Description { materials: vec![Material::default()], ..Description::default() };
    for one in all.iter().map(described) {
        scene.planes.extend(one.planes);
        scene.spheres.extend(one.spheres);
        scene.meshes.extend(one.meshes);
        scene.quads.extend(one.quads);
        scene.cuboids.extend(one.cuboids);
        scene.cylinders.extend(one.cylinders);
        scene.cones.extend(one.cones);
        scene.tori.extend(one.tori);
        scene.fractals.extend(one.fractals);
        scene.discs.extend(one.discs);
    }
    let (shapes, tracer) = (shapes(&scene), Tracer::new(&scene));
    assert_eq!((shapes.len(), &shapes), (scene.primitives(), &all));
    for (id, shape) in shapes.iter().enumerate() {
        for _ in 0..12 {
            let ray = Ray { normalized: true, ..random.ray() };
            if settled(shape, &ray, 0.0, f64::INFINITY, 1e-9) {
                let direction = ray.direction.as_dvec3().normalize();
                let t = tracer.distance(id as u32, ray.origin.as_dvec3(), direction);
                assert_eq!(t.is_some(), nearest(shape, &ray, 0.0, f64::INFINITY).is_some(), "{id}");
            }
        }
    }
}
