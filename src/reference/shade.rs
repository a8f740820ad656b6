//! Whitted shading: the light that arrives along a ray.
use super::{Tracer, texture, turned};
use crate::scene::{Light, MIN_WEIGHT, Material, Pigment};
use glam::DVec3;
use std::f64::consts::PI;

/// How roughly a path is followed. All but [`Rounding::FINE`] is there to ask how a picture looks to a tracer that
/// computes with fewer digits.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rounding {
    /// How far a secondary ray starts off its surface, relative to the size of the numbers involved: |p|, the sphere's
    /// radius, the triangle's longest edge.
    pub lift: f64,
    /// How far secondary rays are off where they hit, relative to the same size.
    pub shift: DVec3,
}

impl Rounding {
    /// As fine as `f64` allows.
    ///
    /// A hit point is put back onto its surface before use, which leaves an error of a few 2^-53 of the numbers
    /// involved. The lift is some thousand times that, and 1e-12 of the scene: far below any `f32` step.
    pub const FINE: Self = Self { lift: 1.0 / (1u64 << 40) as f64, shift: DVec3::ZERO };
}

/// The least (r·l)^shininess that counts, by the scene format: 2⁻⁶⁰.
const LEAST_GLOSS: f64 = 1.0 / (1u64 << 60) as f64;

/// The state that a ray carries through the recursion.
#[derive(Clone, Copy)]
struct Way<'a> {
    rounding: &'a Rounding,
    /// The number of segments so far; the eye ray is 1.
    depth: u32,
    /// The weight of the ray in its pixel.
    weight: f64,
    /// The share of the ray that absorption has left, by channel.
    tint: DVec3,
    /// The materials of the bodies that it is in, the one it entered last at the end.
    inside: &'a [usize],
}

/// A point on a surface, as shading sees it.
struct Point<'a> {
    /// Exactly on the surface but for rounding.
    position: DVec3,
    /// From where it sees lights.
    raised: DVec3,
    /// Unit normal of the surface, turned against the ray.
    normal: DVec3,
    /// Unit normal for shading, on the same side.
    smooth: DVec3,
    /// Whether the ray came from the surface's front.
    front: bool,
    /// How far it came.
    distance: f64,
    /// The size of the numbers that made `position`.
    scale: f64,
    /// The primitive's own.
    extent: f64,
    material: &'a Material,
    index: usize,
    base: DVec3,
}

/// The media before and behind a surface.
struct Passage {
    /// The material of the body that the ray came through.
    from: Option<usize>,
    /// Index of refraction before the surface, divided by the one behind it.
    eta: f64,
    /// The bodies that a ray is in behind it.
    inside: Vec<usize>,
}

/// The most crossings of a ray with one primitive.
const MAX_CROSSINGS: usize = 100;
/// Where the rays go that tell which bodies are around a point.
const VOTERS: [[f64; 3]; 3] = [[1.0, 3.0, 2.0], [-2.7193, 1.4157, -3.1481], [1.7331, -2.2373, 0.5791]];

impl Tracer {
    /// The linear radiance seen from `origin` along the unit `direction`.
    pub fn radiance(&self, origin: DVec3, direction: DVec3) -> DVec3 {
        self.radiance_rounded(origin, direction, &Rounding::FINE)
    }

    /// The linear radiance seen from `origin` along the unit `direction`, as it looks with more rounding.
    pub fn radiance_rounded(&self, origin: DVec3, direction: DVec3, rounding: &Rounding) -> DVec3 {
        let inside = self.around(origin);
        self.radiance_along(
            origin,
            direction,
            Way { rounding, depth: 1, weight: 1.0, tint: DVec3::ONE, inside: &inside },
        )
    }

    fn radiance_along(&self, origin: DVec3, direction: DVec3, way: Way<'_>) -> DVec3 {
        let Some(point) = self.visible(origin, direction, way) else {
            return texture::sky(&self.sky, direction) * self.left(way.inside.last().copied(), f64::INFINITY);
        };
        let material = point.material;
        let passage = self.passage(&point, way.inside);
        let left = self.left(passage.from, point.distance);
        let mirrored = reflect(direction, point.smooth);
        let ambient = self.settings.ambient.as_dvec3() * point.base;
        let lit: DVec3 = self.lights.iter().map(|light| self.direct(light, &point, mirrored, way.rounding)).sum();
        let [reflectance, transmission] = [material.reflectance, material.transmission].map(f64::from);
        let own = if material.additive { 1.0 } else { 1.0 - reflectance - transmission };
        let mut sum = own * (ambient + lit);
        if way.depth < self.settings.max_depth {
            let (f, refracted) = dielectric(direction, &point, passage.eta, material.additive);
            let next = |part: f64, origin: DVec3, direction: Option<DVec3>, inside: &[usize]| {
                let (weight, tint) = (way.weight * part, way.tint * left);
                let follow = weight > 0.0 && (!self.refracts || weight * tint.max_element() >= f64::from(MIN_WEIGHT));
                let next = Way { depth: way.depth + 1, weight, tint, inside, ..way };
                direction.filter(|_| follow).map_or(DVec3::ZERO, |d| part * self.radiance_along(origin, d, next))
            };
            let above = point.lifted(way.rounding, 1.0);
            let mirrored = if mirrored.dot(point.normal) > 0.0 { mirrored } else { reflect(direction, point.normal) };
            sum += next(reflectance + transmission * f, above, Some(mirrored), way.inside);
            let below = point.lifted(way.rounding, -1.0);
            sum += next(transmission * (1.0 - f), below, refracted, &passage.inside);
        }
        sum * left
    }

    /// The share of a ray that absorption leaves by channel, after `distance` in a body of this material.
    fn left(&self, body: Option<usize>, distance: f64) -> DVec3 {
        let absorption = body.map_or(DVec3::ZERO, |m| self.materials[m].absorption.as_dvec3());
        absorption.map(|sigma| if sigma > 0.0 { (-sigma * distance).exp() } else { 1.0 })
    }

    fn passage(&self, point: &Point<'_>, inside: &[usize]) -> Passage {
        let ior = |body: Option<&usize>| body.map_or(1.0, |&m| f64::from(self.materials[m].ior));
        let from = inside.last().copied();
        let mut after = inside.to_vec();
        if point.material.transmission <= 0.0 {
            return Passage { from, eta: 1.0, inside: after };
        }
        if point.front {
            after.push(point.index);
            return Passage { from, eta: ior(inside.last()) / ior(after.last()), inside: after };
        }
        // Who leaves what was never entered must have been in it from the start.
        let from = match inside.iter().rposition(|&m| m == point.index) {
            Some(at) => {
                after.remove(at);
                from
            }
            None => Some(point.index),
        };
        Passage { from, eta: ior(from.as_ref()) / ior(after.last()), inside: after }
    }

    /// The materials of the bodies around a point, outermost first. A ray through an edge may count it wrong, and so the
    /// rays vote.
    fn around(&self, point: DVec3) -> Vec<usize> {
        if !self.refracts {
            return Vec::new();
        }
        let votes = VOTERS.map(|direction| self.left_behind(point, DVec3::from(direction).normalize()));
        let bodies = |vote: &Vec<usize>| {
            let mut bodies = vote.clone();
            bodies.sort_unstable();
            bodies
        };
        let [first, second, third] = &votes;
        let outvoted = bodies(first) != bodies(second) && bodies(second) == bodies(third);
        if outvoted { second.clone() } else { first.clone() }
    }

    /// The materials of the bodies that a ray leaves without having entered them, the last one first. Each primitive is
    /// followed alone.
    fn left_behind(&self, point: DVec3, direction: DVec3) -> Vec<usize> {
        let mut crossings: Vec<(f64, usize, bool)> = Vec::new();
        for primitive in &self.primitives {
            let material = primitive.material();
            if self.materials[material].transmission <= 0.0 {
                continue;
            }
            let mut way = 0.0;
            for _ in 0..MAX_CROSSINGS {
                let Some(t) = primitive.distance(point + way * direction, direction) else { break };
                let place = primitive.project(point + (way + t) * direction);
                crossings.push((way + t, material, primitive.normal(place).dot(direction) > 0.0));
                way += t + Rounding::FINE.lift * place.length().max(primitive.extent());
            }
        }
        crossings.sort_by(|a, b| a.0.total_cmp(&b.0));
        let (mut entered, mut left) = (Vec::new(), Vec::new());
        for (_, material, leaves) in crossings {
            match (leaves, entered.iter().rposition(|&m| m == material)) {
                (false, _) => entered.push(material),
                (true, Some(at)) => drop(entered.remove(at)),
                (true, None) => left.insert(0, material),
            }
        }
        left
    }

    fn visible(&self, origin: DVec3, direction: DVec3, way: Way<'_>) -> Option<Point<'_>> {
        let hit = self.intersect(origin, direction, f64::INFINITY)?;
        let mut rough = origin + hit.t * direction;
        let scale = rough.length().max(self.extent(hit.primitive));
        if way.depth > 1 {
            rough += slid(way.rounding.shift * scale, direction, hit.normal);
        }
        let primitive = &self.primitives[hit.primitive as usize];
        let position = primitive.project(rough);
        let material = &self.materials[primitive.material()];
        let outward = primitive.normal(position);
        let normal = turned(outward, direction);
        let smooth = turned(primitive.shading_normal(position), -normal);
        let base = match material.pigment {
            Pigment::Color(color) => color.as_dvec3(),
            Pigment::Checker { colors, size } => checker(colors, primitive.checker(position) / f64::from(size)),
            Pigment::Texture { texture, size, wrap } => {
                let [u, v] = primitive.uv(position).to_array();
                let edges = primitive.edges(position);
                texture::sample(&self.textures[texture], [u, v], edges, f64::from(size), wrap)
            }
        };
        Some(Point {
            position,
            raised: primitive.seen_from(position, normal),
            normal,
            smooth,
            front: outward.dot(direction) <= 0.0,
            distance: hit.t,
            scale,
            extent: primitive.extent(),
            material,
            index: primitive.material(),
            base,
        })
    }

    /// The radiance that one light adds: E (base n·l + specular max(0, r·l)^shininess), unless something is in the way.
    fn direct(&self, light: &Light, point: &Point<'_>, mirrored: DVec3, rounding: &Rounding) -> DVec3 {
        let position = light.position.as_dvec3();
        let to_light = position - point.raised;
        let Some(l) = to_light.try_normalize() else { return DVec3::ZERO };
        let cosine = point.smooth.dot(l);
        if cosine <= 0.0 || self.shadowed(point, position, rounding) {
            return DVec3::ZERO;
        }
        let power = light.power.as_dvec3();
        let irradiance = if self.settings.attenuation { power / (4.0 * PI * to_light.length_squared()) } else { power };
        let shininess = f64::from(point.material.shininess);
        let gloss = mirrored.dot(l).max(0.0).powf(shininess);
        let gloss = if gloss < LEAST_GLOSS { 0.0 } else { gloss };
        let highlight = f64::from(point.material.specular) * gloss;
        irradiance * (point.base * cosine + DVec3::splat(highlight))
    }

    /// Whether anything lies between the surface and a light, the two ends left out.
    fn shadowed(&self, point: &Point<'_>, light: DVec3, rounding: &Rounding) -> bool {
        let start = point.raised + (point.lifted(rounding, 1.0) - point.position);
        let (direction, distance) = (light - start).normalize_and_length();
        // A surface through the light itself does not block it.
        let slack = rounding.lift * (distance + light.length());
        self.blocked(start, direction, distance - slack)
    }
}

impl Point<'_> {
    /// Where a secondary ray starts: off the surface by more than the rounding of its position, on the side that the
    /// ray came from (1) or on the other (−1).
    fn lifted(&self, rounding: &Rounding, side: f64) -> DVec3 {
        self.position + side * rounding.lift * self.size() * self.normal
    }

    /// The size that the lift is relative to. Of a transparent body's only what counts along the normal: a rougher lift would
    /// excuse a picture that does not show how thin the body is.
    fn size(&self) -> f64 {
        match self.material.transmission > 0.0 {
            true => self.extent + (self.normal * self.position).abs().element_sum(),
            false => self.scale,
        }
    }
}

/// How far the hit point slides on its surface, to first order, when the ray is shifted.
fn slid(shift: DVec3, direction: DVec3, normal: DVec3) -> DVec3 {
    // The normal faces the ray. Next to grazing, a curved surface ends the slide before the plane would.
    let slope = normal.dot(direction).min(-1e-3);
    shift - direction * (shift.dot(normal) / slope)
}

/// Fresnel's reflectance for unpolarised light, and the direction of the refracted ray unless all is reflected. An
/// additive material has a reflectance of 0 up to there.
fn dielectric(direction: DVec3, point: &Point<'_>, eta: f64, additive: bool) -> (f64, Option<DVec3>) {
    let bent = |normal: DVec3| {
        let c = (-normal.dot(direction)).max(0.0);
        let sine2 = eta * eta * (1.0 - c * c);
        (c, (sine2 < 1.0).then(|| (1.0 - sine2).sqrt()))
    };
    // An interpolated normal that faces away from the ray counts as one across it.
    let (c, through) = bent(point.smooth);
    let Some(through) = through else { return (1.0, None) };
    let snell = |c: f64, through: f64, normal: DVec3| (eta * direction + (eta * c - through) * normal).normalize();
    let refracted = snell(c, through, point.smooth);
    let refracted = match bent(point.normal) {
        _ if refracted.dot(point.normal) < 0.0 => refracted,
        // An interpolated normal that bends a ray back gives way to the surface's own.
        (c, Some(through)) => snell(c, through, point.normal),
        (_, None) => return (1.0, None),
    };
    if additive {
        return (0.0, Some(refracted));
    }
    let perpendicular = (eta * c - through) / (eta * c + through);
    let parallel = (c - eta * through) / (c + eta * through);
    ((perpendicular.powi(2) + parallel.powi(2)) / 2.0, Some(refracted))
}

fn reflect(direction: DVec3, normal: DVec3) -> DVec3 {
    direction - 2.0 * direction.dot(normal) * normal
}

/// The first colour in cells whose indices sum to an even number.
fn checker(colors: [glam::Vec3; 2], cell: DVec3) -> DVec3 {
    let sum = cell.floor().element_sum();
    colors[usize::from(sum.rem_euclid(2.0) != 0.0)].as_dvec3()
}
