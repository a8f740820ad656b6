//! Scenes that are hard on boxes.

use glam::{Vec3, vec3};
use raypacket::scene::{Cone, Cuboid, Cylinder, Description, Disc, Fractal, Quad, Sides, Torus};

use crate::common::{Pcg, empty, mesh, plane, sphere};

/// What a scene is like.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// So many primitives of all kinds.
    Random(usize),
    Empty,
    Planes,
    /// Far from the world's origin.
    Far,
    /// Every primitive hundreds of times.
    Equal,
    /// On a line along an axis or a diagonal.
    Collinear,
    /// In one plane across an axis.
    Flat,
    /// One around the other.
    Nested,
    /// Sizes from 1e-6 to 1e6.
    Sizes,
    /// Boxes that share their faces, and quads, triangles and discs in these.
    Grid,
    /// Needles.
    Slivers,
    /// Long and thin, and beside each other.
    Quads,
    /// Bodies that touch the faces of boxes around them.
    Inscribed,
    OneSided,
    /// At powers of two, as large as these, or all of a size.
    Exponential,
}

/// A random scene.
pub fn scene(kind: Kind, rng: &mut Pcg) -> Description {
    let mut scene = empty();
    match kind {
        Kind::Random(n) => {
            let (at, scale) = (rng.pick(&[0.0, 1.0, 30.0]), rng.pick(&[1.0, 1.0, 0.01, 1000.0]));
            let at = rng.cube() * at;
            random(&mut scene, n, at, scale, rng);
            if n > 2 && rng.chance(0.3) {
                scene.planes.push(plane(rng.unit(), rng.range(0.5, 1.0)));
            }
        }
        Kind::Empty => {}
        Kind::Planes => (0..9).for_each(|_| scene.planes.push(plane(rng.unit(), rng.range(-1.0, 1.0)))),
        Kind::Far => {
            let scale = rng.pick(&[0.1, 1.0, 30.0]);
            random(&mut scene, 100, vec3(148_376.0, 1234.0, -223_423.0), scale, rng);
        }
        Kind::Equal => equal(&mut scene, rng),
        Kind::Collinear => {
            let along = rng.pick(&[Vec3::X, Vec3::NEG_Z, Vec3::ONE, vec3(1.0, 1e-3, 0.0)]);
            let shape = rng.cube();
            for i in 0..150 {
                any(&mut scene, along * (i as f32 * 0.5), shape, 0.3, rng);
            }
        }
        Kind::Flat => flat(&mut scene, rng),
        Kind::Nested => {
            let (at, shape) = (rng.cube(), rng.cube());
            for i in 1..60 {
                for _ in 0..4 {
                    any(&mut scene, at, shape, i as f32 * 0.1, rng);
                }
            }
        }
        Kind::Sizes => {
            for _ in 0..150 {
                let size = 10f32.powf(rng.range(-6.0, 6.0));
                let apart = rng.pick(&[0.0, 1.0, size, 1e3, 1e6]);
                let (at, shape) = (rng.cube() * apart, rng.cube());
                any(&mut scene, at, shape, size, rng);
            }
        }
        Kind::Grid => grid(&mut scene, rng),
        Kind::Slivers => slivers(&mut scene, rng),
        Kind::Quads => quads(&mut scene, rng),
        Kind::Inscribed => inscribed(&mut scene, rng),
        Kind::OneSided => {
            random(&mut scene, 80, Vec3::ZERO, 1.0, rng);
            sides(&mut scene, rng);
        }
        Kind::Exponential => exponential(&mut scene, rng),
    }
    scene
}

/// Leaves only what is not rare, if there is any.
pub fn plain(scene: &mut Description) {
    if scene.spheres.is_empty() && scene.meshes.is_empty() {
        return;
    }
    let Description { planes, spheres, meshes, .. } = std::mem::take(scene);
    *scene = Description { planes, spheres, meshes, ..empty() };
    scene.spheres.iter_mut().for_each(|s| s.sides = Sides::Both);
    scene.meshes.iter_mut().for_each(|m| m.sides = Sides::Both);
}

/// `n` of all kinds, as small as to leave room between them.
fn random(scene: &mut Description, n: usize, at: Vec3, scale: f32, rng: &mut Pcg) {
    let room = scale / (n as f32).cbrt();
    for _ in 0..n {
        let (at, shape) = (at + rng.cube() * scale, rng.cube());
        let size = room * rng.pick(&[0.02, 0.3, 0.6, 1.0]);
        any(scene, at, shape, size, rng);
    }
}

/// Adds a primitive of any kind; the same `shape` makes the same one.
fn any(scene: &mut Description, at: Vec3, shape: Vec3, size: f32, rng: &mut Pcg) {
    add(scene, rng.below(KINDS), at, shape, size);
}

/// How many kinds [`add`] knows; triangles count twice.
pub const KINDS: usize = 10;

/// Adds a primitive of a kind.
pub fn add(scene: &mut Description, kind: usize, at: Vec3, shape: Vec3, size: f32) {
    let material = 0;
    let axis = (shape + vec3(0.1, 0.0, 0.2)).normalize_or(Vec3::Y);
    let across = axis.any_orthonormal_vector();
    let share = shape.abs().max(Vec3::splat(0.05));
    let [base, apex] = [at - axis * (size * share.x), at + axis * (size * share.x)];
    let sides = Sides::Both;
    let caps = shape.y > 0.0;
    match kind {
        0 => scene.spheres.push(sphere(at, size)),
        1 | 2 => scene.meshes.push(mesh(&[[at - across * size, at + axis * (size * share.y), at + across * size]])),
        3 => scene.quads.push(Quad { corner: at, u: axis * size, v: across * (size * share.z), material }),
        4 => {
            // Thicker than the rounding of where it is.
            let half = (share * size).max(at.abs() * 1e-5);
            let rotation = if shape.z > 0.0 { shape * 180.0 } else { Vec3::ZERO };
            scene.cuboids.push(Cuboid { min: at - half, max: at + half, rotation, material });
        }
        5 => {
            let apex = if base == apex { at + axis * (size + at.length() * 1e-5) } else { apex };
            scene.cylinders.push(Cylinder { base, apex, radius: size * share.y, caps, sides, material });
        }
        6 => {
            let apex = if base == apex { at + axis * (size + at.length() * 1e-5) } else { apex };
            let (base_radius, apex_radius) = (size * share.y, if shape.x > 0.0 { 0.0 } else { size * share.y * 0.4 });
            scene.cones.push(Cone { base, apex, base_radius, apex_radius, caps, sides, material });
        }
        7 => scene.tori.push(Torus {
            center: at,
            axis,
            major_radius: size * 0.7,
            minor_radius: size * 0.7 * share.z,
            material,
        }),
        8 => {
            let iterations = (shape.z * 2.0 + 2.0) as u32;
            scene.fractals.push(Fractal { center: at, radius: size, iterations, material });
        }
        _ => {
            let inner_radius = if shape.y > 0.0 { 0.0 } else { size * share.y.min(0.99) };
            scene.discs.push(Disc { center: at, normal: axis, radius: size, inner_radius, material });
        }
    }
}

fn equal(scene: &mut Description, rng: &mut Pcg) {
    for _ in 0..3 {
        let (apart, shape) = (rng.pick(&[0.0, 1.0, 1.0]), rng.cube());
        let at = rng.cube() * apart;
        for kind in 0..KINDS {
            if rng.chance(0.6) {
                (0..100).for_each(|_| add(scene, kind, at, shape, 0.4));
            }
        }
    }
    (0..100).for_each(|_| add(scene, 0, Vec3::ZERO, Vec3::ONE, 0.4));
}

fn flat(scene: &mut Description, rng: &mut Pcg) {
    let axis = rng.below(3);
    let height = rng.pick(&[0.0, 1.0, 0.3]);
    let put = |v: Vec3, h: f32| {
        let mut v = v.to_array();
        v[axis] = h;
        Vec3::from_array(v)
    };
    for i in 0..150 {
        let at = put(rng.cube(), height);
        let (u, v) = (put(rng.cube(), 0.0) * 0.3, put(rng.cube(), 0.0) * 0.3);
        match i % 4 {
            0 if u.cross(v).length() > 1e-4 => scene.quads.push(Quad { corner: at, u, v, material: 0 }),
            3 => {
                let (normal, radius) = (Vec3::AXES[axis], u.length().max(0.01));
                let inner_radius = radius * rng.pick(&[0.0, 0.5]);
                scene.discs.push(Disc { center: at, normal, radius, inner_radius, material: 0 });
            }
            1 if i % 5 == 0 => scene.spheres.push(sphere(at, 0.1)),
            _ => scene.meshes.push(mesh(&[[at, put(at + u, height), put(at + v, height)]])),
        }
    }
}

fn grid(scene: &mut Description, rng: &mut Pcg) {
    let edge = rng.pick(&[1.0, 0.1, 3.0]);
    let point = |i: usize, j: usize, k: usize| vec3(i as f32, j as f32, k as f32) * edge;
    for (i, j, k) in (0..125).map(|n| (n % 5, n / 5 % 5, n / 25)) {
        let (min, max) = (point(i, j, k), point(i + 1, j + 1, k + 1));
        if rng.chance(0.8) {
            scene.cuboids.push(Cuboid { min, max, rotation: Vec3::ZERO, material: 0 });
        }
        let [x, y, z] = (max - min).to_array().map(|v| v);
        let [x, y, z] = [Vec3::X * x, Vec3::Y * y, Vec3::Z * z];
        let (u, v) = rng.pick(&[(x, y), (y, z), (z, x)]);
        scene.quads.push(Quad { corner: min, u, v, material: 0 });
        let (u, v) = rng.pick(&[(x, y), (y, z), (z, x)]);
        scene.meshes.push(mesh(&[[min, min + u, min + u + v], [min, min + u + v, min + v]]));
        if rng.chance(0.3) {
            // It touches the four edges.
            let (center, radius, inner_radius) = (min + (u + v) * 0.5, edge * 0.5, edge * rng.pick(&[0.0, 0.25]));
            scene.discs.push(Disc { center, normal: u.cross(v), radius, inner_radius, material: 0 });
        }
        if rng.chance(0.2) {
            // It touches the six neighbours.
            scene.spheres.push(sphere(min, edge * 0.5));
        }
    }
}

fn slivers(scene: &mut Description, rng: &mut Pcg) {
    let corners: Vec<_> = (0..80)
        .map(|_| {
            let (a, [length, width]) = (rng.cube(), [rng.pick(&[0.1, 1.0, 10.0]), rng.pick(&[1e-2, 1e-4, 1e-6, 1e-7])]);
            let (along, aside) = (rng.unit() * length, rng.unit() * width);
            rng.pick(&[[a, a + along, a + along * 0.5 + aside], [a, a + aside, a + along], [a, a + along, a + along]])
        })
        .collect();
    scene.meshes.push(mesh(&corners));
    // Something behind, above and below.
    (0..10).for_each(|_| scene.spheres.push(sphere(rng.cube() * 3.0, 0.2)));
    for _ in 0..10 {
        let (corner, u) = (rng.cube(), rng.unit());
        scene.quads.push(Quad { corner, u, v: u.any_orthonormal_vector() * 1e-3, material: 0 });
    }
}

fn quads(scene: &mut Description, rng: &mut Pcg) {
    let far = rng.pick(&[0.0, 1.0, 100.0]);
    let far = rng.cube() * far;
    for _ in 0..25 {
        let length = rng.pick(&[0.3, 1.0, 5.0]);
        let (corner, u, any) = (far + rng.cube(), rng.unit() * length, rng.unit());
        let v = rng.pick(&[u.any_orthonormal_vector(), u * 0.5 + any * 0.01, any, u.cross(Vec3::Y)]);
        let v = v * rng.pick(&[1.0, 0.1, 1e-3]);
        if u.cross(v).length() < 1e-5 * u.length() * v.length() {
            continue;
        }
        scene.quads.push(Quad { corner, u, v, material: 0 });
        // Others start where it ends.
        for step in rng.pick(&[&[][..], &[u], &[u, -u], &[v, -v, u + v], &[u * 1.01, u * 1.001]]) {
            scene.quads.push(Quad { corner: corner + *step, u: v, v: rng.unit() * 0.5, material: 0 });
        }
    }
    let parallel = |q: &Quad| q.u.cross(q.v).length() < 1e-5 * q.u.length() * q.v.length();
    scene.quads.retain(|q| !parallel(q));
}

fn inscribed(scene: &mut Description, rng: &mut Pcg) {
    for i in 0..8 {
        let at = rng.cube() * 4.0;
        let at = rng.pick(&[vec3(i as f32 * 2.0, 0.0, 0.0), at]);
        let size = rng.pick(&[1.0, 0.25, 0.3]);
        let material = 0;
        let mut half = Vec3::splat(size);
        match rng.below(6) {
            0 => scene.spheres.push(sphere(at, size)),
            1 => {
                let minor_radius = size * rng.pick(&[0.5, 0.25, 0.1]);
                let major_radius = size - minor_radius;
                half.y = minor_radius;
                scene.tori.push(Torus { center: at, axis: Vec3::Y, major_radius, minor_radius, material });
            }
            2 | 3 => {
                let iterations = rng.below(4) as u32;
                scene.fractals.push(Fractal { center: at, radius: size, iterations, material });
            }
            4 => {
                let (base, apex) = (at - Vec3::Y * size, at + Vec3::Y * size);
                scene.cylinders.push(Cylinder { base, apex, radius: size, caps: true, sides: Sides::Both, material });
            }
            _ => {
                let (base, apex) = (at - Vec3::Y * size, at + Vec3::Y * size);
                let (base_radius, apex_radius, sides) = (size, 0.0, Sides::Both);
                scene.cones.push(Cone { base, base_radius, apex, apex_radius, caps: true, sides, material });
            }
        }
        let (min, max) = (at - half, at + half);
        if rng.chance(0.5) {
            scene.cuboids.push(Cuboid { min, max, rotation: Vec3::ZERO, material });
        }
        let [x, y, z] = [Vec3::X * (max.x - min.x), Vec3::Y * (max.y - min.y), Vec3::Z * (max.z - min.z)];
        for (corner, u, v) in [(min, x, y), (min, y, z), (min, z, x), (max, -x, -y), (max, -y, -z), (max, -z, -x)] {
            match rng.below(3) {
                0 => scene.quads.push(Quad { corner, u, v, material }),
                1 => scene
                    .meshes
                    .push(mesh(&[[corner, corner + u, corner + u + v], [corner, corner + u + v, corner + v]])),
                _ => {}
            }
        }
    }
}

fn sides(scene: &mut Description, rng: &mut Pcg) {
    let mut sides = || rng.pick(&[Sides::Both, Sides::Front, Sides::Back]);
    scene.spheres.iter_mut().for_each(|s| s.sides = sides());
    scene.cylinders.iter_mut().for_each(|c| c.sides = sides());
    scene.cones.iter_mut().for_each(|c| c.sides = sides());
    scene.meshes.iter_mut().for_each(|m| m.sides = sides());
}

fn exponential(scene: &mut Description, rng: &mut Pcg) {
    let base: f32 = rng.pick(&[2.0, 1.5, 4.0]);
    let [from, to] = rng.pick(&[[-18, 18], [-36, 0], [0, 18]]);
    let random = rng.unit();
    let along = rng.pick(&[Vec3::X, Vec3::ONE, vec3(1.0, -1.0, 0.0), random]);
    for _ in 0..rng.pick(&[1, 3]) {
        let shape = rng.cube();
        for e in from..to {
            let place = base.powi(e);
            let size = rng.pick(&[place * 0.4, place * 0.01, place]).max(1e-10);
            any(scene, along * place, shape, size, rng);
        }
    }
}
