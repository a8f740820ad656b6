//! That the lift is enough for shadow rays, and that a third of it is not: rays of a surface's own points, which it must not
//! block.

use super::*;
use crate::geometry::{Planes, Primitives, Spheres};
use crate::measure::random::Pcg;
use crate::scene::Sides;
use glam::Vec3 as V;

/// How many shadow rays the surface of their own points blocks, from the light and from the point. `place` gives an eye,
/// what it looks at, and a light.
fn blocked<K: Primitives>(kind: &K, offsets: &Offsets, place: impl Fn(&mut Pcg) -> [V; 3]) -> usize {
    let mut rng = Pcg::new(9);
    let mut blocked = 0;
    for _ in 0..100_000 {
        let [eye, to, light] = place(&mut rng);
        let direction = (to - eye).normalize();
        let Some((t, true)) = kind.test::<f32>(0, eye.into(), direction.into(), 0.0, f32::INFINITY) else { continue };
        let surface = kind.surface::<f32>(0, Vec3::from(direction).mul_add(t, eye.into()));
        let normal = if V::from(surface.normal).dot(direction) > 0.0 { -surface.normal } else { surface.normal };
        let lift = offsets.lift(surface.point, surface.reach);
        let spawned = [
            shadow_from_light(offsets, light.into(), surface.point, normal, lift),
            shadow_from_point(offsets, light.into(), surface.point, normal, lift),
        ];
        for ray in spawned.iter().filter(|ray| ray.cosine > 0.0) {
            let met = kind.test::<f32>(0, ray.origin, ray.direction, 0.0, ray.t_max);
            blocked += usize::from(met.is_some_and(|(_, inside)| inside));
        }
    }
    blocked
}

/// The blocked rays of a huge sphere seen from nearby, of a plane far from the origin, and of a plane with lights far away;
/// with so much of the lift's parts that are due to the reach, the coordinates and a ray's length.
fn counts(parts: [f32; 3]) -> [usize; 3] {
    let derived = Offsets::of(&Methods::default());
    let offsets = Offsets {
        reach: derived.reach * parts[0],
        coordinate: derived.coordinate * parts[1],
        length: derived.length * parts[2],
        ..derived
    };
    let (mut huge, mut far, mut near) = (Spheres::default(), Planes::default(), Planes::default());
    let normal = V::new(1.0, 3.0, 2.0).normalize();
    huge.push(V::NEG_Y * 1000.0, 1000.0, Sides::Both, 0);
    far.push(normal, -3000.0, 0);
    near.push(normal, -0.1, 0);
    let across = normal.any_orthonormal_vector();
    let on_plane = |height: f32, size: f32, rng: &mut Pcg| {
        normal * height + across * rng.range(-size, size) + normal.cross(across) * rng.range(-size, size)
    };
    let above = |rng: &mut Pcg, from: f32, to: f32| 10f32.powf(rng.range(from, to));
    [
        blocked(&huge, &offsets, |rng| {
            let to = V::new(rng.range(-1.0, 1.0), 0.0, rng.range(-1.0, 1.0));
            let light = V::new(rng.range(-1.0, 1.0), above(rng, -4.0, 0.0), rng.range(-1.0, 1.0));
            [to + V::Y + rng.cube() * 0.5, to, to + light]
        }),
        blocked(&far, &offsets, |rng| {
            let to = on_plane(3000.0, 100.0, rng);
            [to + normal + rng.cube() * 0.5, to, to + normal * above(rng, -3.0, 1.0) + on_plane(0.0, 10.0, rng)]
        }),
        blocked(&near, &offsets, |rng| {
            let to = on_plane(0.1, 0.1, rng);
            [to + normal + rng.cube() * 0.5, to, to + normal * above(rng, -3.0, 3.0) + on_plane(0.0, 1000.0, rng)]
        }),
    ]
}

#[test]
fn the_lift_is_enough_and_a_third_of_it_is_not() {
    assert_eq!(counts([1.0; 3]), [0; 3]);
    assert!(counts([0.33; 3])[1] > 10, "{:?}", counts([0.33; 3]));
}

/// Every part by itself: without the greater part of it, the rays that it is there for are blocked.
#[test]
fn every_part_of_the_lift_is_needed() {
    let [reach, _, _] = counts([0.1, 1.0, 1.0]);
    let [_, coordinate, _] = counts([1.0, 0.33, 1.0]);
    let [_, _, length] = counts([1.0, 1.0, 0.05]);
    assert!(reach > 100 && coordinate > 10 && length > 5, "{reach} {coordinate} {length}");
}
