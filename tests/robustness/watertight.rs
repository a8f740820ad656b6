//! No ray leaves a closed mesh through its edges or corners, wherever the mesh is; the textbook's test lets some out.

use glam::{Vec3, vec3};
use raypacket::geometry::Primitives;
use raypacket::geometry::triangle::{SeenEdges, moller_trumbore};
use raypacket::math::{Blocked, HitBatch, NONE, RayBatch};
use raypacket::scene::{Description, Mesh, Scene};
use raypacket::trace::{Scratch, intersect, occluded};
use wide::f32x8;

use crate::common::{Pcg, compiled, empty};

/// Rays for each of the two queries and each place: 10 million in all.
const RAYS: usize = 2_500_000;

/// Where the textbook's test loses rays, as the far corner of a large world.
const FAR: Vec3 = vec3(148_376.0, 1234.0, -223_423.0);

/// An icosahedron whose triangles are cut into four, `levels` times over, with corners at all distances around 1.
fn rock(levels: usize, center: Vec3, size: f32) -> Description {
    let g = (1.0 + 5.0f32.sqrt()) / 2.0;
    let mut positions: Vec<Vec3> = [(-1.0, g), (1.0, g), (-1.0, -g), (1.0, -g)]
        .iter()
        .flat_map(|&(a, b)| [vec3(a, b, 0.0), vec3(0.0, a, b), vec3(b, 0.0, a)])
        .collect();
    // Neighbours are 2 apart; a face is three that are.
    let near = |a: usize, b: usize| (positions[a].distance(positions[b]) - 2.0).abs() < 0.1;
    let mut triangles = Vec::new();
    for a in 0..12 {
        for b in a + 1..12 {
            triangles.extend((b + 1..12).filter(|&c| near(a, b) && near(b, c) && near(a, c)).map(|c| [a, b, c]));
        }
    }
    assert_eq!(triangles.len(), 20);
    for _ in 0..levels {
        let mut middles = std::collections::HashMap::new();
        let mut middle = |a: usize, b: usize| {
            *middles.entry([a.min(b), a.max(b)]).or_insert_with(|| {
                positions.push((positions[a] + positions[b]).normalize() * positions[a].length());
                positions.len() - 1
            })
        };
        triangles = triangles
            .iter()
            .flat_map(|&[a, b, c]| {
                let [ab, bc, ca] = [middle(a, b), middle(b, c), middle(c, a)];
                [[a, ab, ca], [b, bc, ab], [c, ca, bc], [ab, bc, ca]]
            })
            .collect();
    }
    let mut rng = Pcg::new(levels as u64);
    for p in &mut positions {
        *p = center + p.normalize() * (size * rng.range(0.9, 1.1));
    }
    let triangles = triangles.iter().map(|t| t.map(|i| i as u32)).collect();
    let mut scene = empty();
    scene.meshes.push(Mesh { positions, triangles, ..Mesh::default() });
    scene
}

/// A way from `origin` to an edge or corner of the mesh, or next to one.
fn aimed(mesh: &Mesh, origin: Vec3, rng: &mut Pcg) -> Vec3 {
    let corners = mesh.triangles[rng.below(mesh.triangles.len())].map(|i| mesh.positions[i as usize]);
    let along = rng.pick(&[0.0, 0.0, 0.5, rng.clone().range(0.0, 1.0)]);
    let target = corners[0] + (corners[1] - corners[0]) * along;
    let off = rng.unit() * rng.pick(&[0.0, 1e-7, 1e-6]);
    ((target - origin).normalize() + off).normalize()
}

/// Fires batches from inside the mesh, half of them from one point each, and counts the rays that get out.
fn leaks(
    description: &Description,
    center: Vec3,
    size: f32,
    mut escaped: impl FnMut(&Scene, &RayBatch) -> usize,
) -> usize {
    let scene = compiled(description);
    let mesh = &description.meshes[0];
    let mut rng = Pcg::new(77);
    let mut batch = RayBatch::default();
    let mut leaks = 0;
    for round in 0..RAYS / 256 {
        batch.clear();
        let at = |rng: &mut Pcg| center + rng.unit() * (size * rng.range(0.0, 0.5));
        let base = at(&mut rng);
        for _ in 0..256 {
            let origin = if round % 2 == 0 { base } else { at(&mut rng) };
            let direction = aimed(mesh, origin, &mut rng);
            batch.push(origin, direction, 0.0, f32::INFINITY);
        }
        leaks += escaped(&scene, &batch);
    }
    leaks
}

fn by_default(scene: &Scene, rays: &RayBatch, scratch: &mut Scratch, shadow: bool) -> usize {
    if shadow {
        let mut blocked = Blocked::default();
        occluded::<f32x8>(scene, rays, &mut blocked, scratch);
        return rays.len - blocked.count();
    }
    let mut hits = HitBatch::default();
    intersect::<f32x8>(scene, rays, &mut hits, scratch);
    hits.primitive[..rays.len].iter().filter(|&&id| id == NONE).count()
}

fn stays_tight(center: Vec3, size: f32) {
    let description = rock(1, center, size);
    let mut scratch = Scratch::default();
    for shadow in [false, true] {
        let leaks = leaks(&description, center, size, |scene, rays| by_default(scene, rays, &mut scratch, shadow));
        assert_eq!(leaks, 0, "of {RAYS} rays at {center}, shadow {shadow}");
    }
}

#[test]
fn at_the_origin() {
    stays_tight(Vec3::ZERO, 1.0);
}

#[test]
fn far_from_the_origin() {
    stays_tight(FAR, 10.0);
}

/// Seen that the test above can fail: Möller's and Trumbore's test lets rays out there.
#[test]
fn the_textbook_leaks() {
    let description = rock(1, FAR, 10.0);
    let escape = |scene: &Scene, rays: &RayBatch| {
        let out = |i: &usize| {
            let [origin, d] =
                [&rays.origin, &rays.direction].map(|c| Vec3::from_array([0, 1, 2].map(|axis| c[axis][*i])));
            let hit = |k| {
                let seen = SeenEdges::new(&scene.triangles.shape(k), origin.into());
                moller_trumbore::<f32>(&seen, d.into(), 0.0, f32::INFINITY).is_some()
            };
            !(0..scene.triangles.len()).any(hit)
        };
        // One of a batch is enough to see it fail.
        (0..rays.len).step_by(64).filter(out).count()
    };
    let leaks = leaks(&description, FAR, 10.0, escape);
    assert!(leaks > 0, "the textbook's test held");
}
