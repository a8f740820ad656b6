//! Every id leads back to the element of the description that it stands for.

use glam::Vec3;
use raypacket::trace::NONE;
use raypacket::{Mesh, PrimitiveKind, Sphere, compile};

use crate::common::{all_builtins, empty, white};

#[test]
fn meshes_are_told_apart_even_empty_ones() {
    let triangle = |count: usize| Mesh::new(&[Vec3::ZERO, Vec3::X, Vec3::Y], &vec![[0, 1, 2]; count]);
    let mut description = empty();
    description.materials = vec![white(0.0), white(0.1), white(0.2)];
    description.spheres = vec![Sphere::new([0.0; 3], 1.0).with_material(2); 3];
    let counts = [0, 2, 0, 0, 3, 1, 0];
    description.meshes = counts.map(triangle).to_vec();
    description.meshes[4].materials = vec![2, 0, 1];
    let scene = compile(&description).expect("a sound scene");
    let place = |id| scene.primitive(id).map(|p| (p.kind, p.index, p.triangle, p.material));
    assert_eq!(place(0), Some((PrimitiveKind::Sphere, 0, 0, 2)));
    assert_eq!(place(2), Some((PrimitiveKind::Sphere, 2, 0, 2)));
    let wanted = [(1, 0, 0), (1, 1, 0), (4, 0, 2), (4, 1, 0), (4, 2, 1), (5, 0, 0)];
    for (id, (mesh, triangle, material)) in (3..).zip(wanted) {
        assert_eq!(place(id), Some((PrimitiveKind::Mesh, mesh, triangle, material)), "{id}");
    }
    assert_eq!((place(9), place(NONE)), (None, None));
}

#[test]
fn ids_run_through_the_kinds_of_every_scene() {
    for description in all_builtins() {
        let scene = compile(&description).expect("a sound scene");
        let mut counts = vec![0; raypacket::scene::KINDS.len()];
        for id in 0..description.primitives() as u32 {
            let primitive = scene.primitive(id).expect("a primitive");
            let kind = raypacket::scene::KINDS.iter().position(|name| *name == primitive.kind.name()).expect("a kind");
            if primitive.kind != PrimitiveKind::Mesh {
                assert_eq!(primitive.index, counts[kind]);
            }
            counts[kind] += 1;
        }
        assert_eq!(counts, description.counts(), "{}", description.name);
    }
}
