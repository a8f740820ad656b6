//! The slice's map: where on the pane a point of the world lies, seen from above.
//!
//! x runs to the right and z down, so that a camera looking along −z looks up the pane.

use super::outline::{Extent, Outline};
use super::section::{Section, flat};
use crate::kinds::for_each_kind;
use crate::scene::Description;
use glam::{DVec2, Vec3};

/// Things further from the eye than this many times its distance to look_at do not count for the scale.
const NEARBY: f64 = 4.0;
/// Space around what is shown, as a part of it.
const MARGIN: f64 = 0.2;

/// The part of the world that is shown: chosen once for a scene, moved along when the eye leaves it, never rescaled.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Map {
    center: DVec2,
    /// Half the width and height of what has to fit.
    half: DVec2,
}

/// A map laid on a pane.
#[derive(Clone, Copy, Debug)]
pub struct Layout {
    /// The point (x, z) of the world in the pane's middle.
    pub center: DVec2,
    middle: DVec2,
    /// Pixels a world unit.
    pub scale: f64,
}

impl Map {
    /// A map of the scene's surroundings: the eye, what it looks at, and the lights and primitives nearby.
    /// Planes have no end and do not count; neither does what is huge or far, or nothing would be left of the rest.
    pub fn new(description: &Description) -> Self {
        let (eye, look_at) = (description.camera.eye, description.camera.look_at);
        let distance = (look_at.as_dvec3() - eye.as_dvec3()).length();
        let distance = if distance.is_finite() && distance > 0.0 { distance } else { 1.0 };
        let (mut low, mut high) = (flat(eye).min(flat(look_at)), flat(eye).max(flat(look_at)));
        let mut include = |from: DVec2, to: DVec2| {
            let furthest = (from - flat(eye)).abs().max((to - flat(eye)).abs()).max_element();
            // A NaN is not below anything, so it is left out too.
            if furthest <= NEARBY * distance {
                (low, high) = (low.min(from), high.max(to));
            }
        };
        for light in &description.lights {
            include(flat(light.position), flat(light.position));
        }
        bodies(description).for_each(|Extent { low, high }| include(low, high));
        // When everything is in one line of sight from above, its length has to do for the width too.
        let half = (high - low) / 2.0;
        let least = half.max_element().max(distance * 0.25);
        Self { center: (low + high) / 2.0, half: half.max(DVec2::splat(least * 0.5)) * (1.0 + MARGIN) }
    }

    /// Moves the map as little as it takes to keep the eye on it.
    pub fn follow(&mut self, eye: Vec3) {
        let eye = flat(eye);
        if eye.is_finite() {
            let slack = self.half / (1.0 + MARGIN);
            self.center = self.center.clamp(eye - slack, eye + slack);
        }
    }

    /// Lays the map on a pane so that everything fits and the middles meet.
    pub fn layout(&self, width: usize, height: usize) -> Layout {
        let middle = DVec2::new(width as f64, height as f64) / 2.0;
        Layout { center: self.center, middle, scale: (middle / self.half).min_element() }
    }
}

/// How far all spread but the planes; a mesh is one.
fn bodies(description: &Description) -> impl Iterator<Item = Extent> + '_ {
    macro_rules! all {
        ($($bounds:ident { $(($storage:ident: $Storage:ident, $field:ident: $Kind:ident, $module:ident))* })*) => {
            std::iter::empty()$($(.chain(description.$field.iter().filter_map(Outline::extent)))*)*
        };
    }
    for_each_kind!(all)
}

impl Layout {
    /// Where a point (x, z) of the world lies on the pane, in pixels.
    pub fn place(&self, point: DVec2) -> DVec2 {
        (point - self.center) * self.scale + self.middle
    }

    /// The section of the horizontal plane at height `y` that the pane shows.
    pub fn section(&self, y: f32) -> Section {
        Section { y: y.into(), center: self.center, radius: self.reach(), pixel: 1.0 / self.scale }
    }

    /// How far from the middle anything on the pane is, in world units.
    fn reach(&self) -> f64 {
        self.middle.length() / self.scale
    }

    /// The longest of 1, 2, 5, 10 … world units that takes at most `pixels` on the pane.
    pub fn round_length(&self, pixels: f64) -> f64 {
        let most = pixels / self.scale;
        let decade = 10f64.powf(most.log10().floor());
        [5.0, 2.0, 1.0].into_iter().map(|factor| factor * decade).find(|length| *length <= most).unwrap_or(decade)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{CameraDescription, Cone, Cuboid, Cylinder, Disc, Fractal, Quad, Sides, Sphere, Torus};

    fn scene(spheres: &[(Vec3, f32)]) -> Description {
        let spheres = spheres
            .iter()
            .map(|&(center, radius)| Sphere { center, radius, sides: Sides::Both, material: 0 })
            .collect();
        Description { spheres, ..Description::default() }
    }

    fn on_pane(layout: &Layout, point: Vec3) -> bool {
        let place = layout.place(flat(point));
        place.cmpge(DVec2::ZERO).all() && place.cmple(DVec2::new(512.0, 400.0)).all()
    }

    #[test]
    fn nearby_things_fit_and_far_ones_do_not_count() {
        let near = [(Vec3::new(3.0, 0.0, 0.0), 1.0), (Vec3::new(-6.0, 0.0, -5.0), 2.0)];
        let map = Map::new(&scene(&near));
        let layout = map.layout(512, 400);
        for point in [Vec3::new(4.0, 0.0, 1.0), Vec3::new(-8.0, 0.0, -7.0), Vec3::new(0.0, 1.0, 5.0)] {
            assert!(on_pane(&layout, point), "{point}");
        }
        let far = [(Vec3::new(1e6, 0.0, 0.0), 1.0), (Vec3::ZERO, 1e6), (Vec3::NAN, 1.0)];
        assert_eq!(Map::new(&scene(&[&near[..], &far].concat())), map);
    }

    #[test]
    fn every_body_counts_by_its_extent() {
        let (base, apex, caps, sides, material) = (Vec3::X, Vec3::new(5.0, 3.0, 0.0), true, Sides::Both, 0);
        let d = Description {
            quads: vec![Quad { corner: base, u: Vec3::Y, v: -Vec3::Z * 3.0, material }],
            cuboids: vec![Cuboid { min: -Vec3::ONE, max: Vec3::ONE, rotation: Vec3::Y * 45.0, material }],
            cylinders: vec![Cylinder { base, apex, radius: 5.0, caps, sides, material }],
            cones: vec![Cone { base, base_radius: 0.0, apex, apex_radius: 5.0, caps, sides, material }],
            tori: vec![Torus { center: base, axis: Vec3::X * 3.0, major_radius: 2.0, minor_radius: 0.5, material }],
            fractals: vec![Fractal { center: apex, radius: 2.0, iterations: 3, material }],
            discs: vec![Disc { center: base, normal: apex - base, radius: 5.0, inner_radius: 1.0, material }],
            ..Description::default()
        };
        // The axis of length 5 rises by 3: its discs of radius 5 spread by 3 along x.
        let expected = [
            [1.0, -3.0, 1.0, 0.0],
            [-(2f64.sqrt()), -(2f64.sqrt()), 2f64.sqrt(), 2f64.sqrt()],
            [-2.0, -5.0, 8.0, 5.0],
            [1.0, -5.0, 8.0, 5.0],
            [0.5, -2.5, 1.5, 2.5],
            [3.0, -2.0, 7.0, 2.0],
            [-2.0, -5.0, 4.0, 5.0],
        ];
        let found: Vec<[f64; 4]> = bodies(&d).map(|Extent { low, high }| [low.x, low.y, high.x, high.y]).collect();
        assert_eq!(found.len(), expected.len());
        for (found, expected) in found.iter().flatten().zip(expected.iter().flatten()) {
            assert!((found - expected).abs() < 1e-12, "{found} is not {expected}");
        }
        let reach = |map: &Map| (map.center - map.half, map.center + map.half);
        let (low, high) = reach(&Map::new(&d));
        assert!(low.x < -2.0 && low.y < -5.0 && high.x > 8.0 && high.y > 5.0);
    }

    #[test]
    fn right_is_right_and_ahead_is_up() {
        let layout = Map::new(&scene(&[])).layout(512, 400);
        let (eye, ahead, right) =
            (layout.place(DVec2::ZERO), layout.place(DVec2::new(0.0, -1.0)), layout.place(DVec2::new(1.0, 0.0)));
        assert!(ahead.y < eye.y && ahead.x == eye.x && right.x > eye.x && right.y == eye.y);
    }

    #[test]
    fn the_map_follows_without_a_jump() {
        let mut map = Map::new(&scene(&[(Vec3::ZERO, 2.0)]));
        let start = map;
        map.follow(Vec3::new(0.0, 1.0, 5.0));
        assert_eq!(map, start, "the home eye moves nothing");
        let scale = map.layout(512, 400).scale;
        let mut before = map.center;
        for i in 0..1000 {
            let eye = Vec3::new(0.1 * i as f32, 1.0, 5.0 + 0.05 * i as f32);
            map.follow(eye);
            assert!(on_pane(&map.layout(512, 400), eye) && map.center.distance(before) < 0.2);
            before = map.center;
        }
        map.follow(Vec3::NAN);
        assert_eq!((map.center, map.layout(512, 400).scale), (before, scale));
    }

    #[test]
    fn odd_scenes_and_panes_have_a_map() {
        for (eye, look_at) in [
            (Vec3::ZERO, Vec3::ZERO),
            (Vec3::Y, Vec3::ZERO),
            (Vec3::splat(1e6), Vec3::splat(1e6 + 1.0)),
            (Vec3::ZERO, Vec3::X * 1e-3),
        ] {
            let camera = CameraDescription { eye, look_at, ..CameraDescription::default() };
            let map = Map::new(&Description { camera, ..Description::default() });
            let layout = map.layout(512, 400);
            assert!(layout.scale.is_finite() && layout.scale > 0.0 && on_pane(&layout, eye));
            map.layout(0, 0);
            map.layout(1, 30_000);
        }
    }

    #[test]
    fn scale_bars_are_round() {
        for (scale, length) in [(1.0, 50.0), (10.0, 5.0), (100.0, 0.5), (64.0, 1.0), (1e-6, 5e7), (33.0, 2.0)] {
            let layout = Layout { center: DVec2::ZERO, middle: DVec2::ZERO, scale };
            assert!((layout.round_length(80.0) / length - 1.0).abs() < 1e-9, "{scale}");
        }
    }
}
