//! The rays of the matrix: batches that are easy, hard, or partly broken.

use glam::{Vec3, vec3};
use raypacket::geometry::{Cull, Primitives};
use raypacket::math::BATCH;
use raypacket::scene::Scene;
use raypacket::trace::{NONE, RayBatch};

use crate::common::Pcg;
use crate::oracle::{Answer, Ray};
use crate::scenes::Place;

/// Where the rays of a batch start.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Origins {
    /// At one point, and the batch says so: whatever else its columns hold must not be read.
    Flagged,
    /// At one point, unsaid.
    Shared,
    /// Close together.
    Near,
    /// Anywhere.
    Apart,
}

/// Where they go.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Directions {
    /// Within a cone, from narrow to wide.
    Coherent,
    /// Anywhere.
    Random,
    /// To the outlines of primitives, and along planes, where culling and tests are decided by a few ε.
    Grazing,
    /// The same, but most are turned away from it to one side, as rays of a batch that is culled are.
    OneSided,
    /// Along axes and diagonals, with 0 and −0.
    Axes,
}

/// A kind of batch.
#[derive(Clone, Copy, Debug)]
pub struct Kind {
    pub origins: Origins,
    pub directions: Directions,
    /// Whether some rays have NaN and infinite components.
    pub broken: bool,
}

impl Kind {
    /// Every combination.
    pub fn all() -> impl Iterator<Item = Kind> {
        let origins = [Origins::Flagged, Origins::Shared, Origins::Near, Origins::Apart];
        let directions =
            [Directions::Coherent, Directions::Random, Directions::Grazing, Directions::OneSided, Directions::Axes];
        origins.into_iter().flat_map(move |origins| {
            let with = move |directions| [false, true].map(|broken| Kind { origins, directions, broken });
            directions.into_iter().flat_map(with)
        })
    }
}

/// What the rays of one batch have in common.
struct Bundle {
    base: Vec3,
    /// How far from `base` rays start.
    spread: f32,
    axis: Vec3,
    width: f32,
    /// The share of rays of [`Directions::OneSided`] that are not turned.
    straight: f32,
    /// The primitive whose outline all rays go for, if they do.
    target: Option<u32>,
    /// For [`Directions::OneSided`]: the way to the outline, and the side to turn to.
    edge: Option<[Vec3; 2]>,
}

/// A random batch of `len` rays.
pub fn batch(kind: Kind, len: usize, scene: &Scene, place: Place, rng: &mut Pcg) -> RayBatch {
    let bundle = Bundle::new(kind, scene, place, rng);
    let inactive = rng.pick(&[0.0, 0.0, 0.1, 0.5, 1.0]);
    let mut rays = RayBatch::default();
    for i in 0..len {
        let origin = bundle.origin(kind, scene, place, rng);
        let direction = bundle.direction(kind, scene, origin, rng);
        let t_min = if rng.chance(0.1) { place.scale * rng.range(0.0, 2.0) } else { 0.0 };
        let t_max = if rng.chance(0.2) { place.scale * rng.range(0.0, 4.0) } else { f32::INFINITY };
        rays.push(origin, direction, t_min, t_max);
        if kind.broken && rng.chance(0.25) {
            spoil(&mut rays, i, kind.origins == Origins::Flagged, rng);
        }
    }
    rays.common_origin = kind.origins == Origins::Flagged;
    for i in 0..len {
        if rng.chance(0.15) {
            end_at_hit(scene, &mut rays, i, rng);
        }
        if rng.chance(inactive) {
            deactivate(&mut rays, i, rng);
        }
    }
    poison_unread(&mut rays);
    rays
}

impl Bundle {
    fn new(kind: Kind, scene: &Scene, place: Place, rng: &mut Pcg) -> Self {
        let one_sided = kind.directions == Directions::OneSided;
        let target = any_primitive(scene, rng).filter(|_| one_sided || rng.chance(0.5));
        let base = match target {
            Some(id) if one_sided && kind.origins == Origins::Near => on(scene, id, place, rng),
            _ => start(scene, place, rng),
        };
        let axis = rng.unit();
        let edge = target.filter(|_| one_sided).map(|id| {
            let [way, side] = outline(scene, id, base, axis, rng);
            [way.try_normalize().unwrap_or(axis), side * rng.pick(&[1.0, -1.0])]
        });
        Self {
            base,
            spread: place.scale * rng.pick(&[0.3, 0.01, 1e-5, 1e-15]),
            axis,
            width: rng.pick(&[0.5, 0.1, 0.01, 1e-4, 1e-7]),
            straight: rng.pick(&[0.3, 0.1, 0.0]),
            target,
            edge,
        }
    }

    fn origin(&self, kind: Kind, scene: &Scene, place: Place, rng: &mut Pcg) -> Vec3 {
        match (kind.origins, self.edge) {
            (Origins::Flagged | Origins::Shared, _) => self.base,
            (Origins::Near, Some([_, side])) => {
                self.base + side * (self.spread * rng.range(0.0, 1.0) * rng.pick(&[0.0, 1.0]))
            }
            (Origins::Near, None) => self.base + rng.cube() * self.spread,
            (Origins::Apart, _) => start(scene, place, rng),
        }
    }

    fn direction(&self, kind: Kind, scene: &Scene, origin: Vec3, rng: &mut Pcg) -> Vec3 {
        // A few ε off, to either side.
        let off = rng.unit() * rng.pick(&[0.0, 0.0, 1e-7, 1e-6, 1e-4]);
        match kind.directions {
            Directions::Coherent => (self.axis + rng.cube() * self.width).normalize(),
            Directions::Random => rng.unit(),
            Directions::Grazing => {
                let target = self.target.or_else(|| any_primitive(scene, rng));
                let axis = self.axis + rng.cube() * self.width;
                let way = target.map_or(axis, |id| outline(scene, id, origin, axis, rng)[0]);
                (way.normalize_or(self.axis) + off).normalize()
            }
            Directions::OneSided => {
                let [way, side] = self.edge.unwrap_or([self.axis, self.axis]);
                if rng.chance(self.straight) {
                    return (way + rng.unit() * rng.pick(&[0.0, 1e-7])).normalize();
                }
                (way + side * (self.width * rng.range(0.1, 1.0))).normalize()
            }
            Directions::Axes => loop {
                let v = Vec3::from_array([0, 1, 2].map(|_| rng.pick(&[0.0, -0.0, 0.0, -0.0, 1.0, -1.0])));
                if v != Vec3::ZERO {
                    return v.normalize();
                }
            },
        }
    }
}

fn any_primitive(scene: &Scene, rng: &mut Pcg) -> Option<u32> {
    let count = scene.first.discs as usize + scene.discs.len();
    (count > 0).then(|| rng.below(count) as u32)
}

/// Anywhere in the scene, often on a primitive or at the world's origin, sometimes far off.
fn start(scene: &Scene, place: Place, rng: &mut Pcg) -> Vec3 {
    match rng.below(8) {
        0..3 => any_primitive(scene, rng).map_or(place.center, |id| on(scene, id, place, rng)),
        3 => place.center,
        4 => vec3(0.0, -0.0, 0.0),
        5 => place.center + rng.unit() * (place.scale * 50.0),
        _ => place.point(rng),
    }
}

/// A point on primitive `id`, but for rounding.
fn on(scene: &Scene, id: u32, place: Place, rng: &mut Pcg) -> Vec3 {
    let first = &scene.first;
    if id >= first.quads {
        let (center, radius) = ball(scene, id);
        let from = center + rng.unit() * (radius * 2.0);
        let to = center + rng.unit() * (radius * rng.pick(&[0.0, 0.5, 0.9]));
        let direction = (to - from).normalize_or(Vec3::X);
        distance(scene, id, from, direction).map_or(to, |t| from + direction * t)
    } else if id >= first.triangles {
        let [a, e1, e2] = scene.triangles.corner_and_edges((id - first.triangles) as usize);
        rng.pick(&[a, a + e1, a + e1 * 0.25 + e2 * 0.5])
    } else if id >= first.spheres {
        let i = (id - first.spheres) as usize;
        scene.spheres.center(i) + rng.unit() * scene.spheres.radius(i)
    } else {
        let (n, p) = (scene.planes.normal(id as usize), place.point(rng));
        p - n * ((n.dot(p) + scene.planes.distance[id as usize]) / n.length_squared())
    }
}

/// A way from `origin` to the outline of primitive `id`, or along it, and a unit vector across the outline there.
fn outline(scene: &Scene, id: u32, origin: Vec3, axis: Vec3, rng: &mut Pcg) -> [Vec3; 2] {
    let first = &scene.first;
    if id >= first.quads {
        let (center, radius) = ball(scene, id);
        let to = center - origin;
        let aside = to.cross(axis).normalize_or(Vec3::Y);
        // Between a way through the primitive, if this is one, and one past it.
        let (mut met, mut past) = (to, to + aside * (radius * 1.5));
        for _ in 0..40 {
            let middle = (met + past) * 0.5;
            let hit = distance(scene, id, origin, middle.normalize_or(axis)).is_some();
            (met, past) = if hit { (middle, past) } else { (met, middle) };
        }
        [rng.pick(&[met, past]), aside]
    } else if id >= first.triangles {
        let [a, e1, e2] = scene.triangles.corner_and_edges((id - first.triangles) as usize);
        let normal = e1.cross(e2);
        if rng.chance(0.3) {
            return [axis.cross(normal), normal.normalize_or_zero()];
        }
        let along = rng.range(0.0, 1.0);
        let (corner, edge) = rng.pick(&[(a, e1), (a, e2), (a + e1, e2 - e1)]);
        let way = corner + edge * along - origin;
        [way, way.cross(edge).normalize_or_zero()]
    } else if id >= first.spheres {
        let i = (id - first.spheres) as usize;
        let (to, radius) = (scene.spheres.center(i) - origin, scene.spheres.radius(i));
        let sine = radius / to.length();
        let aside = to.cross(axis).normalize_or_zero();
        let way = if sine < 1.0 { to * (1.0 - sine * sine).sqrt() + aside * (sine * to.length()) } else { aside };
        [way, (way.normalize_or_zero() * way.dot(to) / way.length() - to).normalize_or_zero()]
    } else {
        let normal = scene.planes.normal(id as usize);
        [axis.cross(normal), normal.normalize()]
    }
}

/// Evaluates an expression for a bounded primitive other than spheres and triangles.
macro_rules! with_body {
    ($scene:expr, $id:expr, |$kind:ident, $i:ident| $body:expr) => {{
        let (scene, id): (&Scene, u32) = ($scene, $id);
        let first = &scene.first;
        macro_rules! on {
            ($field:ident) => {{
                let ($kind, $i) = (&scene.$field, (id - first.$field) as usize);
                $body
            }};
        }
        match id {
            id if id >= first.discs => on!(discs),
            id if id >= first.fractals => on!(fractals),
            id if id >= first.tori => on!(tori),
            id if id >= first.cones => on!(cones),
            id if id >= first.cylinders => on!(cylinders),
            id if id >= first.cuboids => on!(cuboids),
            _ => on!(quads),
        }
    }};
}

/// The ball around it.
fn ball(scene: &Scene, id: u32) -> (Vec3, f32) {
    with_body!(scene, id, |kind, i| match kind.cull() {
        Cull::Balls(balls) => (balls.center(i), balls.radius[i]),
        _ => unreachable!("bodies have balls"),
    })
}

/// Where a ray meets it, by its own test.
fn distance(scene: &Scene, id: u32, origin: Vec3, direction: Vec3) -> Option<f32> {
    fn nearest<K: Primitives>(kind: &K, i: usize, origin: Vec3, direction: Vec3) -> Option<f32> {
        kind.test::<f32>(i, origin.into(), direction.into(), 0.0, f32::INFINITY).map(|(t, _)| t)
    }
    with_body!(scene, id, |kind, i| nearest(kind, i, origin, direction))
}

/// Makes a component of ray `i` NaN or infinite.
fn spoil(rays: &mut RayBatch, i: usize, flagged: bool, rng: &mut Pcg) {
    let bad = rng.pick(&[f32::NAN, f32::INFINITY, f32::NEG_INFINITY]);
    let axis = rng.below(3);
    match rng.below(3) {
        0 if !flagged => rays.origin[axis][i] = bad,
        1 => rays.t_min[i] = bad.abs(),
        _ => rays.direction[axis][i] = bad,
    }
}

/// Lets ray `i` start or end at the very distance of its nearest hit, which the interval then leaves out.
fn end_at_hit(scene: &Scene, rays: &mut RayBatch, i: usize, rng: &mut Pcg) {
    match Answer::new(scene, &Ray::of(rays, i)) {
        Answer::Hit(t, id) if id != NONE && rng.chance(0.5) => rays.t_max[i] = t,
        Answer::Hit(t, id) if id != NONE => rays.t_min[i] = t,
        _ => {}
    }
}

fn deactivate(rays: &mut RayBatch, i: usize, rng: &mut Pcg) {
    rays.t_max[i] = rng.pick(&[-1.0, f32::NAN, f32::NEG_INFINITY, -1e-30]);
    if rng.chance(0.5) {
        for axis in 0..3 {
            rays.direction[axis][i] = rng.pick(&[f32::NAN, 1e30]);
            if !rays.common_origin {
                rays.origin[axis][i] = rng.pick(&[f32::NAN, -1e30]);
            }
        }
    }
}

/// Puts NaN wherever nothing may be read.
fn poison_unread(rays: &mut RayBatch) {
    for axis in 0..3 {
        let first = if rays.common_origin { 1 } else { rays.len };
        rays.origin[axis][first..BATCH].fill(f32::NAN);
        rays.direction[axis][rays.len..BATCH].fill(f32::NAN);
    }
    rays.t_min[rays.len..BATCH].fill(f32::NAN);
}
