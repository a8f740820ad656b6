//! What is measured: the kinds of primitives, and scenes of one kind each.

use glam::{Vec3, vec3};
use raypacket::geometry::{
    Cones, Cuboids, Cylinders, Discs, Fractals, Planes, Primitives, Quads, Spheres, Tori, Triangles,
};
use raypacket::scene::{self, Description, Scene, Sides};

use crate::scenes::{self, Pcg, empty, mesh};

/// Primitives of a scene.
pub const PRIMITIVES: usize = 16;

/// A kind of primitive.
pub trait Kind {
    const NAME: &'static str;
    /// Where it has several tests: the name with the default one's.
    const METHOD: &'static str = Self::NAME;
    /// How far off the surface a hit may lie, in ε (8 + t), whatever the method; 8 as the middles of all but planes are
    /// nearer to the origin.
    const OFF: f64;
    type Stored: Primitives;
    fn stored(scene: &Scene) -> &Self::Stored;
    /// Adds one, with the origin outside.
    fn add(scene: &mut Description, rng: &mut Draw);
}

/// A source of random primitives.
pub struct Draw<'a> {
    rng: &'a mut Pcg,
    /// How far apart they are: within 4 to 7 of the origin, along −z, with 1.
    spread: f32,
}

impl Draw<'_> {
    fn ahead(&mut self) -> Vec3 {
        let spread = self.spread;
        let [x, y] = [0; 2].map(|_| self.rng.range(-2.0, 2.0) * spread);
        vec3(x, y, -5.0 + (self.rng.range(-1.0, 1.0) - 1.0) * spread + 1.0)
    }
}

impl std::ops::Deref for Draw<'_> {
    type Target = Pcg;
    fn deref(&self) -> &Pcg {
        self.rng
    }
}

impl std::ops::DerefMut for Draw<'_> {
    fn deref_mut(&mut self) -> &mut Pcg {
        self.rng
    }
}

/// A scene of one kind.
pub fn sixteen<K: Kind>(rng: &mut Pcg) -> Description {
    scene::<K>(PRIMITIVES, 1.0, rng)
}

/// A scene of ten thousand of one kind, some sizes apart.
pub fn many<K: Kind>(rng: &mut Pcg) -> Description {
    scene::<K>(10_000, 24.0, rng)
}

fn scene<K: Kind>(count: usize, spread: f32, rng: &mut Pcg) -> Description {
    let mut scene = empty();
    scene.name = K::NAME.into();
    let mut draw = Draw { rng, spread };
    (0..count).for_each(|_| K::add(&mut scene, &mut draw));
    scene
}

macro_rules! kind {
    ($type:ident, $name:literal $(by $method:literal)?, $field:ident: $stored:ty, $off:expr, |$scene:ident, $rng:ident| $add:expr) => {
        pub struct $type;
        impl Kind for $type {
            const NAME: &'static str = $name;
            $(const METHOD: &'static str = concat!($name, "/", $method);)?
            const OFF: f64 = $off;
            type Stored = $stored;
            fn stored(scene: &Scene) -> &$stored {
                &scene.$field
            }
            fn add($scene: &mut Description, $rng: &mut Draw) {
                $add;
            }
        }
    };
}

// 4 ε t for the height, and as much for the slope. Floors, so that what looks up misses them.
kind!(Plane, "plane", planes: Planes, 8.0, |scene, rng| {
    let normal = vec3(rng.range(-0.1, 0.1), 1.0, rng.range(-0.1, 0.1));
    scene.planes.push(scenes::plane(normal, rng.range(3.0, 6.0)));
});

// The discriminant is off by 8 ε |f|² at the most, and the hit by that over the radius: below 8 ε · 64 / 0.2.
kind!(Sphere, "sphere" by "stable", spheres: Spheres, 320.0, |scene, rng| {
    scene.spheres.push(scenes::sphere(rng.ahead(), rng.range(0.2, 0.9)));
});

// 8 ε (|o − a| + edge) / sin of the smallest angle: below 8 ε · 12 / 0.2.
kind!(Triangle, "triangle" by "watertight", triangles: Triangles, 60.0, |scene, rng| {
    // Close to equilateral, and turned towards the origin more or less.
    let around = [vec3(0.0, 1.0, 0.0), vec3(0.87, -0.5, 0.0), vec3(-0.87, -0.5, 0.0)];
    let center = rng.ahead();
    scene.meshes.push(mesh(&[around.map(|corner| center + corner + 0.3 * rng.cube())]));
});

// As for triangles.
kind!(Quad, "quad", quads: Quads, Triangle::OFF, |scene, rng| {
    let [u, v] = [Vec3::X, Vec3::Y].map(|e| e + 0.3 * rng.cube());
    scene.quads.push(scene::Quad { corner: rng.ahead(), u, v, material: 0 });
});

// 3 ε t, and 2 ε t for the direction's length.
kind!(AlignedBox, "box/aligned", cuboids: Cuboids, 5.0, |scene, rng| {
    cuboid(scene, Vec3::ZERO, rng);
});

// 5 ε |o − centre| + 7 ε t + 2 ε |furthest corner|, and 2 ε t for the direction's length.
kind!(TurnedBox, "box/turned", cuboids: Cuboids, 9.0, |scene, rng| {
    let rotation = 180.0 * rng.cube();
    cuboid(scene, rotation, rng);
});

// 8 ε (|o − base| + length + radius) + 6 ε t, below 8 ε · 9.5 + 6 ε t; twice that at a tangent.
kind!(OpenCylinder, "cylinder/open", cylinders: Cylinders, 2.0 * 9.5, |scene, rng| cylinder(scene, false, rng));
kind!(CappedCylinder, "cylinder/capped", cylinders: Cylinders, OpenCylinder::OFF, |scene, rng| {
    cylinder(scene, true, rng);
});

// 12 ε (|o − narrow end| + length + radius) + 8 ε t, below 12 ε · 11.2 + 8 ε t; twice that at a tangent.
kind!(OpenCone, "cone/open", cones: Cones, 2.0 * 17.0, |scene, rng| cone(scene, false, rng));
kind!(CappedCone, "cone/capped", cones: Cones, OpenCone::OFF, |scene, rng| cone(scene, true, rng));

// 12 ε (R + r) + 4 ε |o − center|, below 12 ε · 1.2 + 4 ε · 7, and 2 ε t for the direction's length; twice that at a
// tangent.
kind!(Torus, "torus", tori: Tori, 2.0 * 5.5, |scene, rng| {
    let (center, axis) = (rng.ahead(), rng.unit());
    let (major_radius, minor_radius) = (rng.range(0.4, 0.9), rng.range(0.1, 0.3));
    scene.tori.push(scene::Torus { center, axis, major_radius, minor_radius, material: 0 });
});

// 4 ε |o − center| + 5 ε radius, and 2 ε t for the direction's length.
kind!(Fractal, "fractal", fractals: Fractals, 5.0, |scene, rng| {
    let (center, radius) = (rng.ahead(), rng.range(0.3, 0.8));
    scene.fractals.push(scene::Fractal { center, radius, iterations: 3, material: 0 });
});

// 8 ε (|o − center| + radius), below 8 ε · (t + 2 · 0.9), and 2 ε t for the direction's length. Half of them rings.
kind!(Disc, "disc", discs: Discs, 10.0, |scene, rng| {
    let (center, normal, radius) = (rng.ahead(), Vec3::Z + 0.3 * rng.cube(), rng.range(0.6, 0.9));
    let inner_radius = rng.pick(&[0.0, 0.2]);
    scene.discs.push(scene::Disc { center, normal, radius, inner_radius, material: 0 });
});

fn cuboid(scene: &mut Description, rotation: Vec3, rng: &mut Draw) {
    let (center, half) = (rng.ahead(), Vec3::splat(0.5) + 0.3 * rng.cube());
    scene.cuboids.push(scene::Cuboid { min: center - half, max: center + half, rotation, material: 0 });
}

fn cylinder(scene: &mut Description, caps: bool, rng: &mut Draw) {
    let [base, apex] = ends(rng);
    let radius = rng.range(0.2, 0.7);
    scene.cylinders.push(scene::Cylinder { base, apex, radius, caps, sides: Sides::Both, material: 0 });
}

/// Every other one with a tip.
fn cone(scene: &mut Description, caps: bool, rng: &mut Draw) {
    let [base, apex] = ends(rng);
    let (base_radius, apex_radius) = (rng.range(0.4, 0.9), rng.pick(&[0.0, 0.2]));
    let sides = Sides::Both;
    scene.cones.push(scene::Cone { base, base_radius, apex, apex_radius, caps, sides, material: 0 });
}

fn ends(rng: &mut Draw) -> [Vec3; 2] {
    let base = rng.ahead();
    [base, base + rng.range(0.8, 1.8) * rng.unit()]
}
