//! Rays that leave a surface do not meet it again where they start, whatever its size and place: no acne.

use glam::{DVec3, Vec3, vec3};
use raypacket::geometry::Primitives;
use raypacket::scene::{Description, Scene};
use raypacket::shade::{Segment, SegmentKind, path};

use crate::common::{Pcg, ROUNDOFF, compiled, empty, light, mesh, plane, sphere, white};
use crate::{SCALES, upward};

/// Eye rays a primitive, scale and place.
const RAYS: usize = 1000;

/// A random point of a surface, and the normal there.
type PointAndNormal = dyn Fn(&mut Pcg) -> (Vec3, Vec3);

/// One mirroring primitive, and the rays that look at it.
struct Lone {
    scene: Scene,
    /// A point of the surface and its normal, on the side where the lights are.
    point: Box<PointAndNormal>,
    scale: f32,
    /// Whether the eye may be on the other side as well.
    two_sided: bool,
    name: String,
}

/// How far lights are from the surface, in scales: next to it, near, far, and so far that rays start at the surface.
const LIGHTS: [f32; 4] = [0.01, 2.0, 500.0, 1e6];

impl Lone {
    fn new(
        mut description: Description,
        scale: f32,
        name: String,
        point: impl Fn(&mut Pcg) -> (Vec3, Vec3) + 'static,
    ) -> Self {
        description.materials = vec![white(0.5)];
        description.settings.max_depth = 2;
        let mut rng = Pcg::new(7);
        for distance in LIGHTS.into_iter().flat_map(|d| [d; 3]) {
            let (at, normal) = point(&mut rng);
            description.lights.push(light(at + upward(normal, &mut rng) * (distance * scale)));
        }
        let two_sided = description.spheres.is_empty();
        Self { scene: compiled(&description), point: Box::new(point), scale, two_sided, name }
    }

    /// The segments that a random eye ray sets off, if it hits: the eye is up to 10 scales away.
    fn segments(&self, rng: &mut Pcg) -> Option<Vec<Segment>> {
        let (to, normal) = (self.point)(rng);
        let side = if self.two_sided && rng.chance(0.2) { -normal } else { normal };
        let eye = to + upward(side, rng) * (self.scale * rng.range(0.1, 10.0));
        let direction = (to - eye).try_normalize()?;
        if !self.side_is_clear(eye, direction) {
            return None;
        }
        let segments = path(&self.scene, eye, direction);
        segments[0].to.map(|_| segments)
    }

    /// Whether an eye ray that meets the sphere does so less flatly than the rounding of the hit point, √3 ε M off
    /// for a largest coordinate M, can tell from leaving it. Matters where M is a million radii.
    fn side_is_clear(&self, eye: Vec3, direction: Vec3) -> bool {
        if self.scene.spheres.is_empty() {
            return true;
        }
        let (center, radius) = (self.scene.spheres.center(0).as_dvec3(), f64::from(self.scene.spheres.radius(0)));
        let (f, d) = (eye.as_dvec3() - center, direction.as_dvec3().normalize());
        let sine = (f - d * f.dot(d)).length() / radius;
        let size = center.abs().max_element() + radius;
        (1.0 - sine * sine).max(0.0).sqrt() > 2.0 * 3.0_f64.sqrt() * ROUNDOFF * size / radius
    }

    /// That nothing of it stands in its own light or mirror image.
    fn stays_clear(&self) {
        let mut rng = Pcg::new(1);
        let [mut hits, mut shadows] = [0, 0];
        for _ in 0..RAYS {
            let Some(segments) = self.segments(&mut rng) else { continue };
            hits += 1;
            for s in &segments[1..] {
                assert_ne!(s.kind, SegmentKind::Shadow { blocked: true }, "{}: {segments:?}", self.name);
                let back = s.kind == SegmentKind::Reflection && s.to.is_some();
                assert!(!back, "{}: {segments:?}", self.name);
                shadows += usize::from(s.kind != SegmentKind::Reflection);
            }
        }
        assert!(hits > RAYS / 4 && shadows > RAYS / 2, "{}: {hits} hits, {shadows} shadow rays", self.name);
    }
}

/// Places for a thing of size `scale`: at the origin, and away from it in both its own and absolute measure.
fn places(scale: f32, farthest: f32) -> impl Iterator<Item = Vec3> {
    let away = vec3(0.6, -0.7, 0.4);
    [0.0, 1.0, 1e3, farthest].into_iter().map(move |far| away * (far * scale))
}

#[test]
fn planes() {
    for scale in SCALES {
        for center in places(scale, 1e6) {
            for normal in [Vec3::Y, vec3(1.0, 2.0, -3.0), vec3(1e-4, 0.0, 3e-4)] {
                let mut scene = empty();
                scene.planes.push(plane(normal, -normal.dot(center)));
                let unit = normal.normalize();
                let point = move |rng: &mut Pcg| (center + rng.unit().cross(unit) * scale, unit);
                Lone::new(scene, scale, format!("plane {normal} of scale {scale} at {center}"), point).stays_clear();
            }
        }
    }
}

#[test]
fn spheres_from_outside() {
    for scale in SCALES {
        for center in places(scale, 1e6) {
            let mut scene = empty();
            scene.spheres.push(sphere(center, scale));
            let point = move |rng: &mut Pcg| {
                let normal = rng.unit();
                (center + normal * scale, normal)
            };
            Lone::new(scene, scale, format!("sphere of {scale} at {center}"), point).stays_clear();
        }
    }
}

/// A planet whose surface passes the world's origin: what rounds is its radius, the points have small coordinates.
#[test]
fn spheres_from_outside_next_to_the_origin() {
    for scale in SCALES {
        for down in [Vec3::NEG_Y, vec3(0.36, 0.48, 0.8), vec3(-0.6, 0.7, 0.3)] {
            let planet = 1e4 * scale;
            let center = down * planet;
            let mut scene = empty();
            scene.spheres.push(sphere(center, center.length()));
            let point = move |rng: &mut Pcg| {
                let flat = rng.unit().cross(down).normalize() * (scale * rng.range(0.0, 10.0));
                let normal = (flat - center).normalize();
                (flat, normal)
            };
            Lone::new(scene, scale, format!("planet of {planet} towards {down}"), point).stays_clear();
        }
    }
}

#[test]
fn triangles() {
    for scale in SCALES {
        for center in places(scale, 1e6) {
            for corners in [
                [vec3(-1.0, 0.0, -1.0), vec3(1.0, 0.0, -1.0), vec3(0.0, 0.0, 1.0)],
                [vec3(1.0, 0.3, -0.2), vec3(-0.5, 0.9, 0.4), vec3(-0.1, -1.0, 0.7)],
            ] {
                let corners = corners.map(|c| center + c * scale);
                let [a, b, c] = corners;
                let mut scene = empty();
                scene.meshes.push(mesh(&[corners]));
                let normal = (b - a).cross(c - a).normalize();
                let point = move |rng: &mut Pcg| {
                    let u = rng.range(0.0, 1.0);
                    (a + (b - a) * u + (c - a) * (rng.range(0.0, 1.0) * (1.0 - u)), normal)
                };
                Lone::new(scene, scale, format!("triangle of {scale} at {center}"), point).stays_clear();
            }
        }
    }
}

/// Long thin triangles, as meshes have them.
#[test]
fn slivers() {
    thin_triangles(&[0.1, 1e-2]);
}

#[test]
fn thinner_slivers() {
    thin_triangles(&[3e-3, 1e-3, 1e-4]);
}

/// Triangles whose smallest angle is one of `angles`.
fn thin_triangles(angles: &[f32]) {
    for scale in SCALES {
        for &angle in angles {
            for turn in 0..8 {
                let mut rng = Pcg::new(turn);
                let along = rng.unit();
                let across = along.cross(rng.unit()).normalize();
                let a = rng.cube() * scale;
                let [b, c] = [along, along + across * angle].map(|e| a + e * scale);
                let mut scene = empty();
                scene.meshes.push(mesh(&[[a, b, c]]));
                let normal = (b - a).cross(c - a).normalize();
                let point = move |rng: &mut Pcg| {
                    let u = rng.range(0.0, 1.0);
                    (a + (b - a) * (u * 0.5) + (c - a) * ((1.0 - u) * 0.5), normal)
                };
                let name = format!("sliver {turn} of {scale} with angle {angle}");
                Lone::new(scene, scale, name, point).stays_clear();
            }
        }
    }
}

/// Inside, a mirrored ray meets the far side, and a light inside is seen from everywhere.
#[test]
fn spheres_from_inside() {
    for scale in SCALES {
        for center in places(scale, 1e3) {
            let mut description = empty();
            description.materials = vec![white(0.5)];
            description.settings.max_depth = 2;
            description.spheres.push(sphere(center, scale));
            let mut rng = Pcg::new(3);
            for depth in [0.999, 0.5, 0.0] {
                description.lights.push(light(center + rng.unit() * (depth * scale)));
            }
            let scene = compiled(&description);
            for _ in 0..RAYS {
                let eye = center + rng.unit() * (scale * rng.range(0.0, 0.99));
                let segments = path(&scene, eye, rng.unit());
                inside(&segments, center, scale);
            }
        }
    }
}

fn inside(segments: &[Segment], center: Vec3, radius: f32) {
    let point = segments[0].to.expect("a sphere has no holes").as_dvec3();
    let cosine = (point - center.as_dvec3()).normalize().dot(segments[0].direction.as_dvec3());
    let mut reflections = 0;
    for s in &segments[1..] {
        assert_ne!(s.kind, SegmentKind::Shadow { blocked: true }, "{radius} at {center}: {segments:?}");
        if s.kind == SegmentKind::Reflection {
            reflections += 1;
            let length = distance(s.from, s.to.expect("a sphere has no holes"));
            // The chord is 2 r cos θ. The rounding of a place 1000 radii off is 1e-4 radii, the lift 5e-4: where the
            // half chord is ten times that, a ray that stops short of a quarter has met its own start.
            let half = f64::from(radius) * cosine;
            assert!(cosine < 0.01 || length > 0.5 * half, "{radius} at {center}: {segments:?}");
        }
    }
    assert_eq!(reflections, 1);
}

fn distance(a: Vec3, b: Vec3) -> f64 {
    DVec3::distance(a.as_dvec3(), b.as_dvec3())
}
