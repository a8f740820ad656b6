//! The short constructors fill in what their structs mean.

use glam::Vec3;
use raypacket::{
    Camera, CameraDescription, Cone, Cuboid, Cylinder, Description, Disc, Fractal, Light, Material, Mesh, Pigment,
    Plane, Quad, Sphere, Torus, check, compile, scene,
};

#[test]
fn a_scene_of_every_kind_is_sound() {
    let mut description = Description {
        camera: CameraDescription::new([0.0, 0.0, 9.0], Vec3::ZERO),
        lights: vec![Light::new([0.0, 9.0, 0.0], [100.0; 3])],
        planes: vec![Plane::new(Vec3::Y, 1.0)],
        spheres: vec![Sphere::new([0.0; 3], 1.0)],
        meshes: vec![
            Mesh::new(&[[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]], &[[0, 1, 2]])
                .with_normals(&[Vec3::Z; 3])
                .with_uvs(&[[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]]),
        ],
        quads: vec![Quad::new([0.0; 3], Vec3::X, Vec3::Y)],
        cuboids: vec![Cuboid::new([0.0; 3], [1.0; 3])],
        cylinders: vec![Cylinder::new([0.0; 3], Vec3::Y, 0.5)],
        cones: vec![Cone::new([0.0; 3], 0.5, Vec3::Y, 0.0)],
        tori: vec![Torus::new([0.0; 3], Vec3::Y, 1.0, 0.25)],
        fractals: vec![Fractal::new([0.0; 3], 1.0, 2)],
        discs: vec![Disc::new([0.0; 3], Vec3::Y, 1.0)],
        ..Description::default()
    };
    let [matt, mirror, glass] = [Material::diffuse([0.1, 0.2, 0.3]), Material::mirror(0.5), Material::glass(1.5)]
        .map(|material| description.add_material(material));
    assert_eq!([matt, mirror, glass], [0, 1, 2]);
    description.tori[0] = description.tori[0].with_material(mirror);
    description.spheres[0] = description.spheres[0].with_material(glass);
    assert_eq!(check(&description), Ok(()));
    assert_eq!(description.counts(), [1; scene::KINDS.len()]);
    let compiled = compile(&description).expect("a sound scene");
    assert_eq!((compiled.plan.mirrors, compiled.plan.glasses, compiled.plan.materials), (1, 1, 3));
    assert_eq!(compiled.materials[0].pigment, Pigment::Color(Vec3::new(0.1, 0.2, 0.3)));
    description.spheres[0] = description.spheres[0].with_material(3);
    let fault = compile(&description).expect_err("no such material");
    assert_eq!(fault.key, "sphere[0].material");
}

#[test]
fn a_camera_without_a_description_is_the_same() {
    let description = CameraDescription { fov: 40.0, ..CameraDescription::new([1.0, 2.0, 3.0], [0.0, 1.0, 0.0]) };
    assert_eq!(Camera::new(&description, 1.5), Camera::look_at([1.0, 2.0, 3.0], [0.0, 1.0, 0.0], 40.0, 1.5));
}
