//! That every part of a shadow ray's lift is needed, to within a factor of three, and is enough.

use super::*;
use crate::geometry::{Planes, Primitives, Spheres};
use crate::measure::random::Pcg;
use crate::scene::Sides;
use glam::Vec3 as V;

/// How many of the shadow rays of a surface's own points it blocks itself, by rays from the light and from the point. `place`
/// gives an eye, a point and a light.
fn blocked<K: Primitives>(kind: &K, offsets: &Offsets, place: impl Fn(&mut Pcg) -> [V; 3]) -> [usize; 2] {
    let mut rng = Pcg::new(9);
    let mut blocked = [0; 2];
    for _ in 0..20_000 {
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
        for (ray, blocked) in spawned.iter().zip(&mut blocked) {
            let lit = ray.cosine > 0.0;
            let met = kind.test::<f32>(0, ray.origin, ray.direction, 0.0, ray.t_max);
            *blocked += usize::from(lit && met.is_some_and(|(_, inside)| inside));
        }
    }
    blocked
}

#[test]
fn experiment() {
    let derived = Offsets::of(&Methods::default());
    for parts in [
        [1.0, 1.0, 1.0],
        [0.5, 1.0, 1.0],
        [0.33, 1.0, 1.0],
        [0.25, 1.0, 1.0],
        [0.1, 1.0, 1.0],
        [1.0, 0.5, 1.0],
        [1.0, 0.33, 1.0],
        [1.0, 0.25, 1.0],
        [1.0, 0.1, 1.0],
        [1.0, 1.0, 0.5],
        [1.0, 1.0, 0.33],
        [1.0, 1.0, 0.25],
        [1.0, 1.0, 0.1],
        [0.33, 0.33, 0.33],
        [0.25, 0.25, 0.25],
    ] {
        let offsets = Offsets {
            reach: derived.reach * parts[0],
            coordinate: derived.coordinate * parts[1],
            length: derived.length * parts[2],
            ..derived
        };
        let mut huge = Spheres::default();
        huge.push(V::NEG_Y * 1000.0, 1000.0, Sides::Both, 0);
        let mut small = Spheres::default();
        small.push(V::new(300.0, -700.0, 500.0), 0.1, Sides::Both, 0);
        let mut far = Planes::default();
        let normal = V::new(1.0, 3.0, 2.0).normalize();
        far.push(normal, -3000.0, 0);
        let mut near = Planes::default();
        near.push(normal, -0.1, 0);
        let tangents = [normal.any_orthonormal_vector(), normal.cross(normal.any_orthonormal_vector())];
        let on = |d: f32, size: f32, rng: &mut Pcg| {
            normal * d + tangents[0] * rng.range(-size, size) + tangents[1] * rng.range(-size, size)
        };
        let huge_near = blocked(&huge, &offsets, |rng| {
            let to = V::new(rng.range(-1.0, 1.0), 0.0, rng.range(-1.0, 1.0));
            [
                to + V::Y + rng.cube() * 0.5,
                to,
                to + V::new(rng.range(-1.0, 1.0), 10f32.powf(rng.range(-4.0, 0.0)), rng.range(-1.0, 1.0)),
            ]
        });
        let small_far = blocked(&small, &offsets, |rng| {
            let c = V::new(300.0, -700.0, 500.0);
            let u = rng.unit();
            [c + u * 2.0, c + rng.cube() * 0.1, c + u + rng.unit()]
        });
        let plane_far = blocked(&far, &offsets, |rng| {
            let to = on(3000.0, 100.0, rng);
            [to + normal + rng.cube() * 0.5, to, to + normal * 10f32.powf(rng.range(-3.0, 1.0)) + on(0.0, 10.0, rng)]
        });
        let plane_light = blocked(&near, &offsets, |rng| {
            let to = on(0.1, 0.1, rng);
            [to + normal + rng.cube() * 0.5, to, to + normal * 10f32.powf(rng.range(-3.0, 3.0)) + on(0.0, 1000.0, rng)]
        });
        println!(
            "{parts:?}: huge {huge_near:?} small far {small_far:?} plane far {plane_far:?} plane, far light {plane_light:?}"
        );
    }
}
