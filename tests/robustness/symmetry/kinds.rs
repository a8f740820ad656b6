//! The symmetries of every kind of primitive.
//!
//! A mirror at a plane of two axes changes signs, a power of two exponents, another order ids: none of them a rounding.
//!
//! | | mirrored | times a power of two | in another order |
//! |---|---|---|---|
//! | all but fractals | exact | exact | exact |
//! | fractals | exact, but for a ray in a plane of the grid | exact | exact |
//!
//! Exact means the same bits: of t, but for its exponent when scaled, of normals, and of pictures. Why the exception: a
//! ray in a plane of a fractal's grid sees the cells above it, and in the mirror still those above. Of a mesh, a vertex
//! normal that is exactly across the triangle's own has no side to be turned to, which would be one more exception;
//! there is none in these scenes.

use glam::{Vec3, vec3};
use raypacket::render::{Camera, Film, Kernel, PrimaryHits, primary_hits, render};
use raypacket::scene::{Cone, Cuboid, Cylinder, Description, Disc, Fractal, Light, Mesh, Quad, Scene, Sides, Torus};
use raypacket::trace::Probe;

use super::SIZE;
use crate::common::{Pcg, compiled, empty, film_bits, light, mesh, plane, sphere, white};

/// A kind's name, and what puts one of its primitives into a scene.
type Kind = (&'static str, fn(&mut Description, &mut Pcg));

const KINDS: [Kind; 11] = [
    ("planes", |s, rng| s.planes.push(plane(rng.unit() * 3.0, rng.range(4.0, 9.0)))),
    ("spheres", |s, rng| s.spheres.push(sphere(rng.cube() * 2.0, rng.range(0.1, 0.6)))),
    ("triangles", |s, rng| {
        let a = rng.cube() * 2.0;
        let corners = [a, a + rng.cube() * 1.5, a + rng.cube() * 1.5];
        s.meshes.push(Mesh { sides: rng.pick(&[Sides::Both, Sides::Front, Sides::Back]), ..mesh(&[corners]) });
    }),
    ("quads", |s, rng| s.quads.push(Quad { corner: rng.cube() * 2.0, u: rng.cube(), v: rng.cube(), material: 0 })),
    ("boxes", |s, rng| s.cuboids.push(cuboid(Vec3::ZERO, rng))),
    ("turned boxes", |s, rng| {
        let rotation = rng.cube() * 180.0;
        s.cuboids.push(cuboid(rotation, rng));
    }),
    ("cylinders", |s, rng| {
        let base = rng.cube() * 2.0;
        let (apex, radius) = (base + rng.cube(), rng.range(0.05, 0.4));
        let [caps, sides] = [rng.chance(0.5), rng.chance(0.7)];
        let sides = if sides { Sides::Both } else { Sides::Front };
        s.cylinders.push(Cylinder { base, apex, radius, caps, sides, material: 0 });
    }),
    ("cones", |s, rng| {
        let base = rng.cube() * 2.0;
        let apex = base + rng.cube();
        let (base_radius, apex_radius) = (rng.range(0.05, 0.4), rng.pick(&[0.0, 0.03, 0.5]));
        let sides = if rng.chance(0.7) { Sides::Both } else { Sides::Back };
        s.cones.push(Cone { base, base_radius, apex, apex_radius, caps: rng.chance(0.5), sides, material: 0 });
    }),
    ("tori", |s, rng| {
        let major_radius = rng.range(0.2, 0.7);
        let minor_radius = major_radius * rng.pick(&[0.1, 0.4, 1.0]);
        s.tori.push(Torus { center: rng.cube() * 2.0, axis: rng.cube(), major_radius, minor_radius, material: 0 });
    }),
    ("fractals", |s, rng| {
        let (center, radius) = (rng.cube() * 2.0, rng.range(0.2, 0.6));
        s.fractals.push(Fractal { center, radius, iterations: rng.below(4) as u32, material: 0 });
    }),
    ("discs", |s, rng| {
        let (center, normal, radius) = (rng.cube() * 2.0, rng.cube(), rng.range(0.2, 0.7));
        let inner_radius = radius * rng.pick(&[0.0, 0.2, 0.6]);
        s.discs.push(Disc { center, normal, radius, inner_radius, material: 0 });
    }),
];

fn cuboid(rotation: Vec3, rng: &mut Pcg) -> Cuboid {
    let (p, half) = (rng.cube() * 2.0, vec3(rng.range(0.05, 0.5), rng.range(0.05, 0.5), rng.range(0.05, 0.5)));
    Cuboid { min: p - half, max: p + half, rotation, material: 0 }
}

/// How many primitives a scene has; no multiple of a width.
const COUNT: usize = 27;

/// A scene of each kind, of half mirroring material and with two lights; and a closed mesh with vertex normals.
fn scenes() -> Vec<Description> {
    let around = Description {
        lights: vec![light(vec3(4.1, 5.3, 6.7)), Light { power: vec3(0.2, 0.3, 0.5), ..light(vec3(-3.3, 1.9, 0.7)) }],
        materials: vec![white(0.5)],
        ..empty()
    };
    let mut rng = Pcg::new(77);
    let mut scenes: Vec<_> = KINDS
        .iter()
        .map(|(name, add)| {
            let mut scene = Description { name: (*name).into(), ..around.clone() };
            (0..COUNT).for_each(|_| add(&mut scene, &mut rng));
            scene
        })
        .collect();
    scenes.push(Description { name: "mesh".into(), meshes: vec![pebble(&mut rng)], ..around });
    scenes
}

/// A closed mesh of triangles that share their vertices, with normals at those.
fn pebble(rng: &mut Pcg) -> Mesh {
    let (rows, columns) = (7, 9);
    let turn = std::f32::consts::TAU / columns as f32;
    let mut mesh = Mesh::default();
    for row in 0..=rows {
        let polar = std::f32::consts::PI * row as f32 / rows as f32;
        let (across, up) = if row % rows == 0 { (0.0, polar.cos()) } else { (polar.sin(), polar.cos()) };
        for column in 0..columns {
            let (sin, cos) = (turn * column as f32).sin_cos();
            let n = vec3(cos * across, up, sin * across);
            // The poles are one point each: the triangles between are without area.
            let radius = if row % rows == 0 { 1.5 } else { rng.range(1.2, 1.8) };
            mesh.positions.push(n * radius + vec3(0.1, -0.2, 0.3));
            mesh.normals.push(n);
        }
    }
    for i in 0..rows * columns {
        let right = i / columns * columns + (i + 1) % columns;
        let [a, b, c, d] = [i, right, right + columns, i + columns].map(|v| v as u32);
        mesh.triangles.extend([[a, b, c], [a, c, d]]);
    }
    mesh
}

/// Eyes outside of it all and in its midst, and what they see.
struct Views(Vec<(PrimaryHits, Vec<u32>)>);

impl Views {
    fn new(scene: &Description, scale: f32, flip: Vec3, kernel: Kernel) -> Self {
        let compiled = compiled(scene);
        let view = |eye: Vec3| {
            let mut description = scene.camera;
            (description.eye, description.look_at) = (eye * scale, vec3(0.11, -0.23, 0.31) * scale);
            let camera = super::image(&Camera::new(&description, SIZE[0] as f32 / SIZE[1] as f32), flip);
            let mut film = Film::new(SIZE[0], SIZE[1]);
            render(&compiled, &camera, kernel, 1, &mut film, &|_| ());
            (primary_hits(&compiled, &camera, kernel, SIZE[0], SIZE[1]), film_bits(&film))
        };
        Self([vec3(1.3, 2.1, 5.2), vec3(0.37, -0.71, 0.93)].map(view).into())
    }

    /// Asserts that the `image` has the same films; and that of every hit it has the distance times `scale`, the
    /// normal times `flip` and the primitive whose id becomes this one's by `id`.
    fn expect(&self, image: &Self, scale: f32, flip: Vec3, id: impl Fn(u32) -> u32, what: &str) {
        let hit = self.0.iter().flat_map(|(hits, _)| &hits.t).filter(|t| t.is_finite()).count();
        assert!(hit > 500, "{what}: {hit} hits");
        for ((hits, film), (found, found_film)) in self.0.iter().zip(&image.0) {
            let bits = |t: f32| t.to_bits();
            assert!(hits.t.iter().map(|t| bits(t * scale)).eq(found.t.iter().map(|&t| bits(t))), "{what}: t");
            assert!(hits.primitive.iter().copied().eq(found.primitive.iter().map(|&i| id(i))), "{what}: ids");
            let normals = hits.normal.iter().map(|&n| Vec3::from(n) * flip);
            assert!(normals.eq(found.normal.iter().map(|&n| Vec3::from(n))), "{what}: normals");
            assert!(film == found_film, "{what}: pictures");
        }
    }
}

/// −1 for an axis, 1 for the others.
fn flip(axis: usize) -> Vec3 {
    let mut flip = Vec3::ONE;
    flip[axis] = -1.0;
    flip
}

/// The mirror image at the plane across an axis. A mesh's winding turns over, and so its sides do.
fn mirrored(scene: &Description, axis: usize) -> Description {
    let mut scene = scene.clone();
    let m = |v: &mut Vec3| *v *= flip(axis);
    [&mut scene.camera.eye, &mut scene.camera.look_at].into_iter().for_each(m);
    scene.lights.iter_mut().for_each(|l| m(&mut l.position));
    scene.planes.iter_mut().for_each(|p| m(&mut p.normal));
    scene.spheres.iter_mut().for_each(|s| m(&mut s.center));
    for mesh in &mut scene.meshes {
        mesh.positions.iter_mut().chain(&mut mesh.normals).for_each(m);
        mesh.sides = match mesh.sides {
            Sides::Both => Sides::Both,
            Sides::Front => Sides::Back,
            Sides::Back => Sides::Front,
        };
    }
    scene.quads.iter_mut().for_each(|q| [&mut q.corner, &mut q.u, &mut q.v].into_iter().for_each(m));
    for c in &mut scene.cuboids {
        (c.min[axis], c.max[axis]) = (-c.max[axis], -c.min[axis]);
        // A turn about the axis itself stays, those about the others turn back.
        c.rotation *= -flip(axis);
    }
    scene.cylinders.iter_mut().for_each(|c| [&mut c.base, &mut c.apex].into_iter().for_each(m));
    scene.cones.iter_mut().for_each(|c| [&mut c.base, &mut c.apex].into_iter().for_each(m));
    scene.tori.iter_mut().for_each(|t| [&mut t.center, &mut t.axis].into_iter().for_each(m));
    scene.fractals.iter_mut().for_each(|f| m(&mut f.center));
    scene.discs.iter_mut().for_each(|d| [&mut d.center, &mut d.normal].into_iter().for_each(m));
    scene
}

/// All lengths times `by`.
fn scaled(scene: &Description, by: f32) -> Description {
    let mut scene = scene.clone();
    [&mut scene.camera.eye, &mut scene.camera.look_at].into_iter().for_each(|v| *v *= by);
    scene.lights.iter_mut().for_each(|l| l.position *= by);
    scene.planes.iter_mut().for_each(|p| p.distance *= by);
    scene.spheres.iter_mut().for_each(|s| (s.center, s.radius) = (s.center * by, s.radius * by));
    scene.meshes.iter_mut().flat_map(|m| &mut m.positions).for_each(|p| *p *= by);
    scene.quads.iter_mut().flat_map(|q| [&mut q.corner, &mut q.u, &mut q.v]).for_each(|v| *v *= by);
    scene.cuboids.iter_mut().flat_map(|c| [&mut c.min, &mut c.max]).for_each(|v| *v *= by);
    scene.cylinders.iter_mut().for_each(|c| c.radius *= by);
    scene.cylinders.iter_mut().flat_map(|c| [&mut c.base, &mut c.apex]).for_each(|v| *v *= by);
    scene.cones.iter_mut().flat_map(|c| [&mut c.base_radius, &mut c.apex_radius]).for_each(|r| *r *= by);
    scene.cones.iter_mut().flat_map(|c| [&mut c.base, &mut c.apex]).for_each(|v| *v *= by);
    scene.tori.iter_mut().flat_map(|t| [&mut t.major_radius, &mut t.minor_radius]).for_each(|r| *r *= by);
    scene.tori.iter_mut().for_each(|t| t.center *= by);
    scene.fractals.iter_mut().for_each(|f| (f.center, f.radius) = (f.center * by, f.radius * by));
    scene.discs.iter_mut().flat_map(|d| [&mut d.radius, &mut d.inner_radius]).for_each(|r| *r *= by);
    scene.discs.iter_mut().for_each(|d| d.center *= by);
    scene
}

#[test]
fn mirrored_at_the_planes_of_two_axes() {
    for scene in scenes() {
        for kernel in Kernel::ALL {
            let views = Views::new(&scene, 1.0, Vec3::ONE, kernel);
            for axis in 0..3 {
                let image = Views::new(&mirrored(&scene, axis), 1.0, flip(axis), kernel);
                let what = format!("{} across axis {axis}, {}", scene.name, kernel.name());
                views.expect(&image, 1.0, flip(axis), |id| id, &what);
            }
        }
    }
}

#[test]
fn a_power_of_two_as_large() {
    for scene in scenes() {
        let views = Views::new(&scene, 1.0, Vec3::ONE, Kernel::X8);
        for power in [-24, 7, 30] {
            let scale = 2.0_f32.powi(power);
            let image = Views::new(&scaled(&scene, scale), scale, Vec3::ONE, Kernel::X8);
            views.expect(&image, scale, Vec3::ONE, |id| id, &format!("{} times {scale}", scene.name));
        }
    }
}

#[test]
fn in_another_order() {
    /// Puts element `order[i]` at i.
    fn put<T: Clone>(list: &mut Vec<T>, order: &[usize]) {
        if !list.is_empty() {
            *list = order.iter().map(|&i| list[i].clone()).collect();
        }
    }
    let mut rng = Pcg::new(9);
    for scene in scenes() {
        let views = Views::new(&scene, 1.0, Vec3::ONE, Kernel::X8);
        let count = scene.primitives();
        let reversed: Vec<_> = (0..count).rev().collect();
        let mut shuffled = reversed.clone();
        (1..count).for_each(|i| shuffled.swap(i, rng.below(i + 1)));
        for order in [reversed, shuffled] {
            let mut other = scene.clone();
            put(&mut other.planes, &order);
            put(&mut other.spheres, &order);
            match &mut other.meshes[..] {
                [mesh] => put(&mut mesh.triangles, &order),
                _ => put(&mut other.meshes, &order),
            }
            put(&mut other.quads, &order);
            put(&mut other.cuboids, &order);
            put(&mut other.cylinders, &order);
            put(&mut other.cones, &order);
            put(&mut other.tori, &order);
            put(&mut other.fractals, &order);
            put(&mut other.discs, &order);
            let id = |id: u32| order.get(id as usize).map_or(id, |&i| i as u32);
            let image = Views::new(&other, 1.0, Vec3::ONE, Kernel::X8);
            views.expect(&image, 1.0, Vec3::ONE, id, &scene.name);
        }
    }
}

/// What both queries say about a ray.
fn answers(scene: &Scene, [origin, direction]: [Vec3; 2]) -> (Option<(u32, u32)>, [bool; 2]) {
    let mut probe = Probe::default();
    let hit = probe.intersect(scene, origin, direction);
    let blocked = [1.5, 5.0].map(|t_max| probe.occluded(scene, origin, direction, t_max));
    (hit.map(|hit| (hit.t.to_bits(), hit.primitive)), blocked)
}

/// A unit direction with one or two zeros, and with zeros of either sign.
fn with_zeros(rng: &mut Pcg) -> Vec3 {
    let mut d = rng.unit();
    for _ in 0..1 + rng.below(2) {
        d[rng.below(3)] = 0.0;
    }
    let zero = rng.pick(&[0.0, -0.0]);
    d.try_normalize().unwrap_or(Vec3::NEG_Z).map(|c| if c == 0.0 { zero } else { c })
}

/// Rays along the axes and in the planes of two of them, from within and without: a zero's mirror image is a zero of the
/// other sign.
#[test]
fn mirrored_rays_with_zeros() {
    for scene in scenes() {
        let original = compiled(&scene);
        let mut hits = 0;
        for axis in 0..3 {
            let image = compiled(&mirrored(&scene, axis));
            let mut rng = Pcg::new(5);
            for _ in 0..1500 {
                let direction = with_zeros(&mut rng);
                let origin = rng.cube() * 2.0 - direction * rng.pick(&[0.0, 4.0]);
                let expected = answers(&original, [origin, direction]);
                let found = answers(&image, [origin, direction].map(|v| v * flip(axis)));
                hits += usize::from(found.0.is_some());
                assert_eq!(found, expected, "{} across axis {axis}: {origin} {direction}", scene.name);
            }
        }
        assert!(hits > 500, "{}: {hits}", scene.name);
    }
}

/// Rays with d.z = 0 at the very edges of triangles, where axes across the ray that turn with a sign would decide anew.
#[test]
fn edges_across_z() {
    let mut rng = Pcg::new(6);
    let [mut hit, mut missed] = [0, 0];
    for _ in 0..4000 {
        let corners = [rng.cube(), rng.cube(), rng.cube()];
        let mut scene = empty();
        scene.meshes.push(mesh(&[corners]));
        let direction = vec3(rng.range(-1.0, 1.0), rng.range(-1.0, 1.0), 0.0).normalize();
        let to = corners[0].lerp(corners[1], rng.range(0.1, 0.9));
        let origin = to - direction * 3.0;
        let expected = answers(&compiled(&scene), [origin, direction]);
        let found = answers(&compiled(&mirrored(&scene, 2)), [origin, direction].map(|v| v * flip(2)));
        assert_eq!(found, expected, "{corners:?} {origin} {direction}");
        match found.0 {
            Some(_) => hit += 1,
            None => missed += 1,
        }
    }
    assert!(hit > 500 && missed > 500, "{hit} {missed}");
}

/// The exception for fractals: along the upper face of a bore there is the solid above, in the mirror the bore.
#[test]
fn fractals_are_seen_from_below_in_their_planes() {
    let mut scene = empty();
    scene.fractals.push(Fractal { center: Vec3::ZERO, radius: 1.5, iterations: 1, material: 0 });
    let hit = |y: f32| Probe::default().intersect(&compiled(&scene), vec3(5.0, y, 0.0), Vec3::NEG_X).map(|hit| hit.t);
    assert_eq!([hit(0.5), hit(-0.5)], [Some(3.5), None]);
}
