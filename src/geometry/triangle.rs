//! The triangle with corners a, b, c; its front is where they run counter-clockwise. A triangle without area is hit by
//! no ray, or, as N is rounded, by one that meets the line it has shrunk to; one seen edge-on likewise.
//!
//! Three methods:
//!
//! - [`watertight`]: the default. After Woop, Benthin, Wald, *Watertight Ray/Triangle Intersection*, JCGT 2 (2013),
//!   §3: the corners are sheared along the ray's largest component, each by itself and so alike for all triangles that
//!   share it, and the sign of every edge function x y' − y x' is exact, since both products round the same way; so no
//!   ray slips between triangles that share an edge or a corner. Two deviations: an edge function of 0 is not computed
//!   again in `f64`, but counts as inside on both sides; and t = a·N / d·N, or where that says little, which is for thin
//!   triangles and those seen nearly edge-on, where the line runs over the triangle ([`Flat`]). What cannot be placed on
//!   the triangle is no hit.
//! - [`moller_trumbore`] (*Fast, Minimum Storage Ray/Triangle Intersection*, 1997) with its determinants expanded along
//!   the direction instead of the edges: with T = o − a, e1 = b − a, e2 = c − a and N = e1 × e2, det = d·N,
//!   u = d·(T × e2) / det, v = d·(e1 × T) / det, t = −T·N / det. Rounding may open a crack of some ε |T| between two
//!   triangles that share an edge.
//!
//! - [`edge_planes`]: the side of a direction to the three planes through the origin and an edge, d·(b × c) and so on,
//!   which rays of one origin share (Davidovič, Engelhardt, Georgiev, Slusallek, Dachsbacher, *3D Rasterization*, 2012, §2).
//!   Alike on both sides of an edge, as every product rounds alike. But b × c cancels: the plane is off by ε |b|² over the
//!   edge's length, so that from 10,000 sizes away it hits what it likes.
//!
//! The plane is missed by at most 8 ε (|o − a| + longest edge) / sin of the smallest angle, by all. A hit by the default is
//! at most 32 ε D off the triangle itself, however it lies, with D the largest coordinate of a corner from the origin.

use super::face;
use super::methods::TriangleMethod;
use super::numbers::numbers;
use super::{Bounded, Cull, Footing, LaneHits, Mapping, Number, Primitives, Sides, Surface, Test, columns, flat};
use crate::math::{LaneMask, Lanes, NONE, Vec3, map3};
use wide::f32x8;

/// Triangles, column by column.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Triangles {
    /// The corners a, b, c, a column a component.
    pub corners: [[Vec<f32>; 3]; 3],
    /// Unit normals, zero for a triangle without area; for shading.
    pub unit: Vec<glam::Vec3>,
    /// The longest edge over the sine of the angle at the first corner: what the rounding of the test is
    /// proportional to, as N's is to |e1| |e2|.
    pub reach: Vec<f32>,
    /// Which side of each is there.
    pub sides: Vec<Sides>,
    /// Indices into the scene's materials.
    pub material: Vec<u32>,
    /// Unit normals at the corners; none where no triangle has any.
    pub normals: Attribute<glam::Vec3>,
    /// Texture coordinates at the corners; none where no triangle has any.
    pub uvs: Attribute<glam::Vec2>,
    /// How all are tested.
    pub method: TriangleMethod,
}

/// An attribute of vertices beside their position, shared by the triangles around them.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Attribute<T> {
    /// By vertex.
    pub values: Vec<T>,
    /// The corners' vertices, for every triangle up to the last that has any; [`NONE`] for one that has not.
    pub corners: Vec<[u32; 3]>,
}

impl<T: Copy> Attribute<T> {
    /// Gives triangle `i`, which is later than all that have this attribute so far, its corners' vertices.
    pub fn set(&mut self, i: usize, corners: [u32; 3]) {
        self.corners.resize(i, [NONE; 3]);
        self.corners.push(corners);
    }

    /// The values at triangle `i`'s corners.
    #[inline(always)]
    fn at(&self, i: usize) -> Option<[T; 3]> {
        let corners = self.corners.get(i).filter(|c| c[0] != NONE)?;
        Some(map3(*corners, |c| self.values[c as usize]))
    }
}

numbers! {
    /// A triangle as stored.
    TriangleShape {
        /// a, b, c by component.
        corners: [[T; 3]; 3],
    }
    /// A triangle as seen from the rays' origin, for [`watertight`].
    SeenTriangle {
        /// a, b, c, from the origin.
        corners: [Vec3; 3],
        /// N = (b − a) × (c − a).
        n: Vec3,
        /// a·N, a from the origin.
        height: T,
    }
    /// A triangle as seen from the rays' origin, for [`moller_trumbore`].
    SeenEdges {
        /// N = e1 × e2.
        n: Vec3,
        /// T × e2.
        u: Vec3,
        /// e1 × T.
        v: Vec3,
        /// −T·N.
        height: T,
    }
    /// A triangle as seen from the rays' origin, for [`edge_planes`].
    SeenEdgePlanes {
        /// The normals of the planes through the origin and an edge.
        planes: [Vec3; 3],
        /// N.
        n: Vec3,
        /// a·N, a from the origin.
        height: T,
    }
}

impl<L: Lanes> TriangleShape<L> {
    /// a, b, c.
    #[inline(always)]
    pub fn corners(&self) -> [Vec3<L>; 3] {
        map3(self.corners, |[x, y, z]| Vec3::new(x, y, z))
    }
}

/// A triangle as its methods see it.
#[derive(Clone, Copy, Debug)]
pub enum NamedTriangle<T: Copy> {
    /// [`watertight`].
    Corners(SeenTriangle<T>),
    /// [`moller_trumbore`].
    Edges(SeenEdges<T>),
    /// [`edge_planes`].
    Planes(SeenEdgePlanes<T>),
}

/// A unit direction, its axis of the largest component and the shear that turns it into that axis.
#[derive(Clone, Copy, Debug)]
pub struct Aim<L: Lanes> {
    /// d.
    pub direction: Vec3<L>,
    /// The axis of the largest component, if that is the same in all lanes; of equal ones the first.
    pub major: Option<usize>,
    /// The next two components after the largest, over it.
    pub shear: [L; 2],
    /// Where the largest is x, and where y.
    on: [L::Mask; 2],
}

impl<L: Lanes> Aim<L> {
    /// For unit directions.
    #[inline(always)]
    pub fn new(direction: Vec3<L>) -> Self {
        let Vec3 { x, y, z } = direction;
        let (ax, ay, az) = (x.abs(), y.abs(), z.abs());
        let on_x = ax.ge(ay) & ax.ge(az);
        let on_y = !on_x & ay.ge(az);
        let on = [on_x, on_y];
        let [p, q, r] = in_order(direction, on);
        let major = match () {
            _ if on_x.all() => Some(0),
            _ if on_y.all() => Some(1),
            _ if !(on_x | on_y).any() => Some(2),
            _ => None,
        };
        Self { direction, major, shear: [p / r, q / r], on }
    }
}

impl Aim<f32> {
    /// The axis of a direction's largest component; of equal ones the first.
    #[inline(always)]
    pub fn major_of(direction: Vec3<f32>) -> usize {
        let (x, y, z) = (direction.x.abs(), direction.y.abs(), direction.z.abs());
        if x >= y && x >= z { 0 } else { 2 - usize::from(y >= z) }
    }
}

/// The components after the largest, and that.
#[inline(always)]
fn in_order<L: Lanes>(v: Vec3<L>, [on_x, on_y]: [L::Mask; 2]) -> [L; 3] {
    let Vec3 { x, y, z } = v;
    let pick = |first: L, second: L, third: L| first.select(on_x, second.select(on_y, third));
    [pick(y, z, x), pick(z, x, y), pick(x, y, z)]
}

impl<L: Lanes> From<Vec3<L>> for Aim<L> {
    #[inline(always)]
    fn from(direction: Vec3<L>) -> Self {
        Self::new(direction)
    }
}

impl Triangles {
    /// Adds a triangle by its corners.
    pub fn push(&mut self, corners: [glam::Vec3; 3], sides: Sides, material: u32) {
        self.corners.iter_mut().zip(corners).for_each(|(column, corner)| columns::push(column, corner));
        self.sides.push(sides);
        self.material.push(material);
        // In f64, where no product of lengths overflows or vanishes.
        let [a, b, c] = corners;
        let [e1, e2] = [(b - a).as_dvec3(), (c - a).as_dvec3()];
        let n = e1.cross(e2);
        let longest = e1.length().max(e2.length()).max((e2 - e1).length());
        self.unit.push(n.try_normalize().unwrap_or_default().as_vec3());
        self.reach.push((longest * (e1.length() * e2.length() / n.length()).max(1.0)) as f32);
    }

    /// The corners of triangle `i`.
    #[inline(always)]
    pub fn corners(&self, i: usize) -> [glam::Vec3; 3] {
        let [a, b, c] = &self.corners;
        map3([a, b, c], |corner| columns::at(corner, i))
    }

    /// The first corner and the edges from there to the others.
    #[inline(always)]
    pub fn corner_and_edges(&self, i: usize) -> [glam::Vec3; 3] {
        let [a, b, c] = self.corners(i);
        [a, b - a, c - a]
    }

    /// The barycentric coordinates of b and c at a point of the plane.
    #[inline(always)]
    fn barycentric<L: Lanes>(&self, i: usize, point: Vec3<L>) -> [L; 2] {
        flat::coordinates(self.corner_and_edges(i), self.unit[i], point)
    }

    /// The unit normal for shading, interpolated where there are vertex normals, and on the side of the geometric one
    /// that `surface` has, turned or not.
    #[inline(always)]
    pub fn shading_normal<L: Lanes>(&self, i: usize, surface: &Surface<L>) -> Vec3<L> {
        self.smooth(i, surface).map_or(surface.normal, |[normal, _]| normal)
    }

    /// Where there are vertex normals: that for shading, and how far it is from the point to the surface that the
    /// vertices' tangent planes make, where that is on the side of `surface`'s normal.
    ///
    /// Hanika, *Hacking the Shadow Terminator*, Ray Tracing Gems II (2021), ch. 4: the point's projections onto the
    /// tangent planes that it is beneath, interpolated as normals are. A point beneath none stays.
    #[inline(always)]
    pub fn smooth<L: Lanes>(&self, i: usize, surface: &Surface<L>) -> Option<[Vec3<L>; 2]> {
        let normals = map3(self.normals.at(i)?, Vec3::splat);
        let [u, v] = self.barycentric(i, surface.point);
        let weights = [L::splat(1.0) - u - v, u, v];
        let [a, b, c] = normals;
        let n = c.mul_add(v, b.mul_add(u, a * weights[0]));
        let length2 = n.dot(n);
        let unit = n * (L::splat(1.0) / length2.sqrt());
        let other = n.dot(surface.normal).lt(L::zero());
        // Normals that cancel out leave the triangle's own.
        let unit = (-unit).select(other, unit).select(length2.gt(L::splat(1e-12)), surface.normal);
        let corners = map3(self.corners(i), Vec3::splat);
        let mut rise = Vec3::splat(glam::Vec3::ZERO);
        for k in 0..3 {
            let normal = (-normals[k]).select(other, normals[k]);
            let beneath = (corners[k] - surface.point).dot(normal).max(L::zero());
            rise = normal.mul_add(beneath * weights[k], rise);
        }
        Some([unit, rise])
    }
}

impl Bounded for Triangles {
    const BOXED: bool = false;
    const COST: [f64; 2] = [1.5, 0.05];
    #[inline(always)]
    fn extent<L: Lanes>(triangle: &TriangleShape<L>) -> [Vec3<L>; 2] {
        let [a, b, c] = triangle.corners();
        [a.min(b.min(c)), a.max(b.max(c))]
    }
}

impl Primitives for Triangles {
    type Shape<T: Number> = TriangleShape<T>;
    type Variant = Sides;
    type Seen<T: Copy> = SeenTriangle<T>;
    type Aim<L: Lanes> = Aim<L>;
    type Named = TriangleMethod;

    #[inline(always)]
    fn materials(&self) -> &[u32] {
        &self.material
    }
    #[inline]
    fn cull(&self) -> Cull<'_> {
        Cull::Triangles(self)
    }
    #[inline(always)]
    fn shape(&self, i: usize) -> TriangleShape<f32> {
        TriangleShape { corners: map3(self.corners(i), |corner| corner.to_array()) }
    }
    #[inline(always)]
    fn variant(&self, i: usize) -> Sides {
        self.sides[i]
    }
    #[inline(always)]
    fn zip<A: Number, B: Number, C: Number>(
        a: &TriangleShape<A>,
        b: &TriangleShape<B>,
        f: impl Fn(&A, &B) -> C,
    ) -> TriangleShape<C> {
        a.zip(b, f)
    }
    #[inline(always)]
    fn seen<L: Lanes>(triangle: &TriangleShape<L>, _: Sides, origin: Vec3<L>) -> SeenTriangle<L> {
        let n = normal(triangle.corners());
        let corners = map3(triangle.corners(), |corner| corner - origin);
        SeenTriangle { corners, n, height: corners[0].dot(n) }
    }
    #[inline(always)]
    fn splat_seen<L: Lanes>(seen: &SeenTriangle<f32>) -> SeenTriangle<L> {
        seen.map(|number| L::splat(*number))
    }
    #[inline(always)]
    fn nearest<L: Lanes>(seen: &SeenTriangle<L>, sides: Sides, aim: &Aim<L>, t_min: L, t_max: L) -> LaneHits<L> {
        one_sided(watertight(seen, aim, t_min, t_max), sides, seen.n, aim)
    }
    #[inline(always)]
    fn named(&self) -> Option<TriangleMethod> {
        (self.method != TriangleMethod::Watertight).then_some(self.method)
    }

    #[inline(always)]
    fn surface<L: Lanes>(&self, i: usize, point: Vec3<L>) -> Surface<L> {
        flat::surface(self.unit[i], self.corners(i)[0], self.reach[i], point)
    }
    #[inline(always)]
    fn footing<L: Lanes>(&self, i: usize, surface: &Surface<L>) -> Option<Footing<L>> {
        let [a, b, c] = self.corners(i).map(|corner| corner.as_dvec3());
        let [u, v, w] = [c - b, a - c, b - a];
        let edges = [u.length(), v.length(), w.length()];
        let around: f64 = edges.iter().sum();
        let middle = (a * edges[0] + b * edges[1] + c * edges[2]) / around;
        Some(flat::footing(middle.as_vec3(), (u.cross(v).length() / around) as f32, surface))
    }
    #[inline(always)]
    fn uv<L: Lanes>(&self, i: usize, surface: &Surface<L>) -> [L; 2] {
        let [u, v] = self.barycentric(i, surface.point);
        let Some([a, b, c]) = self.uvs.at(i) else { return [u, v] };
        let w = L::splat(1.0) - u - v;
        let at = |a: f32, b: f32, c: f32| L::splat(c).mul_add(v, L::splat(b).mul_add(u, L::splat(a) * w));
        [at(a.x, b.x, c.x), at(a.y, b.y, c.y)]
    }
    #[inline(always)]
    fn mapping<L: Lanes>(&self, i: usize, _: &Surface<L>) -> Mapping<L> {
        if self.uvs.at(i).is_some() { Mapping::endless() } else { Mapping::face() }
    }
    #[inline(always)]
    fn checker<L: Lanes>(&self, i: usize, surface: &Surface<L>) -> Vec3<L> {
        flat::checker(self.unit[i], surface.point)
    }
}

impl Test<Triangles> for TriangleMethod {
    type Seen<T: Copy> = NamedTriangle<T>;
    #[inline(always)]
    fn seen<L: Lanes>(self, triangle: &TriangleShape<L>, sides: Sides, origin: Vec3<L>) -> NamedTriangle<L> {
        match self {
            Self::Watertight => NamedTriangle::Corners(Triangles::seen(triangle, sides, origin)),
            Self::MollerTrumbore => NamedTriangle::Edges(SeenEdges::new(triangle, origin)),
            Self::EdgePlanes => {
                let SeenTriangle { corners, n, height } = Triangles::seen(triangle, sides, origin);
                NamedTriangle::Planes(SeenEdgePlanes { planes: planes(corners), n, height })
            }
        }
    }
    #[inline(always)]
    fn splat_seen<L: Lanes>(seen: &NamedTriangle<f32>) -> NamedTriangle<L> {
        match seen {
            NamedTriangle::Corners(seen) => NamedTriangle::Corners(seen.map(|number| L::splat(*number))),
            NamedTriangle::Edges(seen) => NamedTriangle::Edges(seen.map(|number| L::splat(*number))),
            NamedTriangle::Planes(seen) => NamedTriangle::Planes(seen.map(|number| L::splat(*number))),
        }
    }
    #[inline(always)]
    fn nearest<L: Lanes>(self, seen: &NamedTriangle<L>, sides: Sides, aim: &Aim<L>, t_min: L, t_max: L) -> LaneHits<L> {
        let (hit, n) = match seen {
            NamedTriangle::Corners(seen) => (watertight(seen, aim, t_min, t_max), seen.n),
            NamedTriangle::Edges(seen) => (moller_trumbore(seen, aim.direction, t_min, t_max), seen.n),
            NamedTriangle::Planes(seen) => (edge_planes(seen, aim.direction, t_min, t_max), seen.n),
        };
        one_sided(hit, sides, n, aim)
    }
}

/// Keeps the hits on sides that are there, of hits for rays that come from either side.
#[inline(always)]
fn one_sided<L: Lanes>(hit: LaneHits<L>, sides: Sides, n: Vec3<L>, aim: &Aim<L>) -> LaneHits<L> {
    let (t, inside) = hit?;
    if sides == Sides::Both {
        return Some((t, inside));
    }
    let inside = inside & shown(sides, n.dot(aim.direction));
    inside.any().then_some((t, inside))
}

/// N = (b − a) × (c − a).
#[inline(always)]
pub fn normal<L: Lanes>([a, b, c]: [Vec3<L>; 3]) -> Vec3<L> {
    (b - a).cross(c - a)
}

/// The default; see the module's text.
#[inline(always)]
pub fn watertight<L: Lanes>(seen: &SeenTriangle<L>, aim: &Aim<L>, t_min: L, t_max: L) -> LaneHits<L> {
    let inside = covers(&seen.corners, aim);
    if !inside.any() {
        return None;
    }
    let [a, b, c] = seen.corners;
    let flat = Flat::new(seen.n, seen.height, a.min(b).min(c), a.max(b).max(c));
    let (t, inside) = flat.distance(aim.direction, inside, || seen.corners);
    let inside = inside & t.gt(t_min) & t.lt(t_max);
    inside.any().then_some((t, inside))
}

/// The first half of [`watertight`]: where the rays' lines pass through a triangle.
#[inline(always)]
pub fn covers<L: Lanes>(corners: &[Vec3<L>; 3], aim: &Aim<L>) -> L::Mask {
    let ordered = match aim.major {
        Some(0) => map3(*corners, |c| [c.y, c.z, c.x]),
        Some(1) => map3(*corners, |c| [c.z, c.x, c.y]),
        Some(_) => map3(*corners, |c| [c.x, c.y, c.z]),
        None => map3(*corners, |c| in_order(c, aim.on)),
    };
    covers_ordered(&ordered, aim.shear)
}

/// [`covers`] for corners whose components are ordered: the two after the directions' largest, then that one.
#[inline(always)]
pub fn covers_ordered<L: Lanes>(corners: &[[L; 3]; 3], [sx, sy]: [L; 2]) -> L::Mask {
    let [[ax, ay], [bx, by], [cx, cy]] = map3(*corners, |[p, q, r]| [r.neg_mul_add(sx, p), r.neg_mul_add(sy, q)]);
    // Not fused: a product that is not rounded would be compared with one that is.
    let (u, v, w) = (cx * by - cy * bx, ax * cy - ay * cx, bx * ay - by * ax);
    let (least, most) = (u.min(v).min(w), u.max(v).max(w));
    least.ge(L::zero()) | most.le(L::zero())
}

/// A triangle's plane and box as seen from the rays' origin, for the second half of [`watertight`].
///
/// The plane alone does not tell how far a hit is: edge-on, or where a triangle is thin or smaller than the rounding of its
/// distance, t is off by any number of ε, and where all edge functions vanish a line may pass however far by. So where the
/// plane's t is unsure it is taken from the edges. And a hit lies in the triangle's box, wider by 32 ε of its
/// farthest corner's distance along any axis, as a line that touches an edge may pass it by 20 ε.
#[derive(Clone, Copy, Debug)]
pub struct Flat<L> {
    /// N.
    pub n: Vec3<L>,
    height: L,
    low: Vec3<L>,
    high: Vec3<L>,
    /// Up to which |d·N| t is unsure.
    steep: L,
}

impl<L: Lanes> Flat<L> {
    /// N, a·N, and the corners' least and greatest components, all from the origin.
    #[inline(always)]
    pub fn new(n: Vec3<L>, height: L, low: Vec3<L>, high: Vec3<L>) -> Self {
        let Vec3 { x, y, z } = high.max(-low);
        let pad = x.max(y).max(z) * L::splat(face::PAD);
        let pad = Vec3::new(pad, pad, pad);
        let size = high - low;
        let size = size.x.max(size.y).max(size.z);
        // N is off by some 3 ε of the edges' product.
        let steep = size * size * L::splat(STEEP);
        Self { n, height, low: low - pad, high: high + pad, steep }
    }

    /// A triangle by its corners.
    #[inline(always)]
    pub fn of([a, b, c]: [Vec3<f32>; 3], origin: Vec3<L>) -> Self {
        let from = |v: Vec3<f32>| Vec3::splat(v.into()) - origin;
        let n = Vec3::splat(normal([a, b, c]).into());
        Self::new(n, from(a).dot(n), from(a.min(b).min(c)), from(a.max(b).max(c)))
    }

    /// The second half of [`watertight`]: how far away, for lines that pass through; and where they hit. `corners` are
    /// seen from the origin, and only asked for where the plane does not suffice.
    #[inline(always)]
    pub fn distance(
        &self,
        direction: Vec3<L>,
        inside: L::Mask,
        corners: impl FnOnce() -> [Vec3<L>; 3],
    ) -> (L, L::Mask) {
        let along = self.n.dot(direction);
        let t = self.height / along;
        let inside = inside & !along.eq(L::zero());
        let unsure = inside & (along.abs().le(self.steep) | !self.holds(direction * t));
        if !unsure.any() {
            return (t, inside);
        }
        let (placed, met) = place(&corners(), direction, t);
        (placed.select(unsure, t), inside & (!unsure | (met & self.holds(direction * placed))))
    }

    /// Where a point is in the box.
    #[inline(always)]
    fn holds(&self, Vec3 { x, y, z }: Vec3<L>) -> L::Mask {
        let Self { low, high, .. } = self;
        x.ge(low.x) & x.le(high.x) & y.ge(low.y) & y.le(high.y) & z.ge(low.z) & z.le(high.z)
    }
}

/// From which |d·N|, in squares of the triangle's greatest extent along an axis, the plane's t will do.
const STEEP: f32 = 1.0 / 32.0;

impl Flat<f32x8> {
    /// Triangle `lane` in every lane.
    #[inline(always)]
    pub fn one<L: Lanes>(&self, lane: usize) -> Flat<L> {
        let pick = |v: &f32x8| L::splat(v.as_array()[lane & 7]);
        let all = |v: &Vec3<f32x8>| Vec3::new(pick(&v.x), pick(&v.y), pick(&v.z));
        let Self { n, height, low, high, steep } = self;
        Flat { n: all(n), height: pick(height), low: all(low), high: all(high), steep: pick(steep) }
    }
}

/// How far along lines that pass through a triangle they are on it, and where they are at all.
///
/// Along one of the two axes across the line, the one over which the sheared triangle spans more, its edges pass the line
/// at two places. Along the other axis these lie on either side of the line, and the hit is where the segment between them
/// does neither. Where they lie on one, by rounding, it is the nearer place; where both coincide, any point between
/// them will do, and `t` chooses. Each is a step between two points of the triangle, so that the result is never off it by
/// more than the corners are by shearing. That is for lines that the edge functions let pass; where these vanish, a line
/// that no edge passes misses.
#[inline(never)]
fn place<L: Lanes>(corners: &[Vec3<L>; 3], direction: Vec3<L>, t: L) -> (L, L::Mask) {
    let Aim { shear: [sx, sy], on, .. } = Aim::new(direction);
    let major = in_order(direction, on)[2];
    let sheared = map3(*corners, |corner| {
        let [p, q, r] = in_order(corner, on);
        [r.neg_mul_add(sx, p), r.neg_mul_add(sy, q), r]
    });
    let [a, b, c] = sheared;
    let span = |axis: usize| a[axis].max(b[axis]).max(c[axis]) - a[axis].min(b[axis]).min(c[axis]);
    let swap = span(1).gt(span(0));
    let span = span(0).max(span(1));
    let [a, b, c] = map3(sheared, |[x, y, r]| [y.select(swap, x), x.select(swap, y), r]);
    let (zero, far) = (L::zero(), L::splat(f32::INFINITY));
    let (mut low, mut high, mut near, mut last) = ([far, zero], [-far, zero], far, -far);
    for ([x, y, r], [next_x, next_y, next_r]) in [(a, b), (b, c), (c, a)] {
        let passes = ((x.le(zero) & next_x.ge(zero)) | (x.ge(zero) & next_x.le(zero))) & !x.eq(next_x);
        let part = x / (x - next_x);
        let (y, r) = ((next_y - y).mul_add(part, y), (next_r - r).mul_add(part, r));
        let (lower, higher) = (passes & y.lt(low[0]), passes & y.gt(high[0]));
        low = [y.select(lower, low[0]), r.select(lower, low[1])];
        high = [y.select(higher, high[0]), r.select(higher, high[1])];
        near = r.select(passes, far).min(near);
        last = r.select(passes, -far).max(last);
    }
    // Smaller than rounding: all corners are at one place.
    let small = span.eq(zero);
    near = a[2].min(b[2]).min(c[2]).select(small, near);
    last = a[2].max(b[2]).max(c[2]).select(small, last);
    let apart = high[0] - low[0];
    // Not fused, so that it is the same in a mirror.
    let between = (low[1] * high[0] - high[1] * low[0]) / apart;
    let r = between.select(apart.gt(zero), t * major).max(near).min(last);
    (r / major, near.le(last))
}

/// Where a triangle is there for rays that run `along` N: from the front against it.
#[inline(always)]
pub fn shown<L: Lanes>(sides: Sides, along: L) -> L::Mask {
    match sides {
        Sides::Both => L::zero().le(L::zero()),
        Sides::Front => along.lt(L::zero()),
        Sides::Back => along.gt(L::zero()),
    }
}

impl<L: Lanes> SeenEdges<L> {
    /// A triangle as seen from `origin`.
    #[inline(always)]
    pub fn new(triangle: &TriangleShape<L>, origin: Vec3<L>) -> Self {
        let [a, b, c] = triangle.corners();
        let (t, e1, e2) = (origin - a, b - a, c - a);
        let n = e1.cross(e2);
        Self { n, u: t.cross(e2), v: e1.cross(t), height: -t.dot(n) }
    }
}

/// See the module's text.
#[inline(always)]
pub fn moller_trumbore<L: Lanes>(seen: &SeenEdges<L>, direction: Vec3<L>, t_min: L, t_max: L) -> LaneHits<L> {
    let inverse = L::splat(1.0) / seen.n.dot(direction);
    let t = seen.height * inverse;
    let inside = t.gt(t_min) & t.lt(t_max);
    if !inside.any() {
        return None;
    }
    let u = seen.u.dot(direction) * inverse;
    let v = seen.v.dot(direction) * inverse;
    let inside = inside & L::zero().le(u.min(v)) & (u + v).le(L::splat(1.0));
    inside.any().then_some((t, inside))
}

/// The normals of the planes through the origin and an edge, of a triangle by its corners, from the origin.
#[inline(always)]
fn planes<L: Lanes>([a, b, c]: [Vec3<L>; 3]) -> [Vec3<L>; 3] {
    // Not fused, so that b × a is −(a × b) to the bit.
    let normal =
        |p: Vec3<L>, q: Vec3<L>| Vec3::new(p.y * q.z - p.z * q.y, p.z * q.x - p.x * q.z, p.x * q.y - p.y * q.x);
    [normal(b, c), normal(c, a), normal(a, b)]
}

/// See the module's text.
#[inline(always)]
pub fn edge_planes<L: Lanes>(seen: &SeenEdgePlanes<L>, direction: Vec3<L>, t_min: L, t_max: L) -> LaneHits<L> {
    let [u, v, w] = map3(seen.planes, |plane| plane.dot(direction));
    let (least, most) = (u.min(v).min(w), u.max(v).max(w));
    let t = seen.height / seen.n.dot(direction);
    let inside = (least.ge(L::zero()) | most.le(L::zero())) & t.gt(t_min) & t.lt(t_max);
    inside.any().then_some((t, inside))
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::{Vec3 as V, vec3};

    fn hit(corners: [V; 3], origin: V, direction: V) -> Option<f32> {
        let mut triangles = Triangles::default();
        triangles.push(corners, Sides::Both, 0);
        let shape = triangles.shape(0);
        let (o, aim) = (Vec3::from(origin), Aim::new(direction.into()));
        let by = |method: TriangleMethod| {
            let seen = method.seen(&shape, Sides::Both, o);
            method.nearest(&seen, Sides::Both, &aim, 0.0, f32::INFINITY).map(|(t, _)| t)
        };
        let found = by(TriangleMethod::Watertight);
        assert_eq!(by(TriangleMethod::MollerTrumbore), found);
        assert_eq!(by(TriangleMethod::EdgePlanes), found);
        found
    }

    const UNIT: [V; 3] = [V::ZERO, V::X, V::Y];

    #[test]
    fn both_sides_and_either_winding() {
        let [a, b, c] = UNIT;
        for corners in [[a, b, c], [a, c, b], [b, c, a]] {
            assert_eq!(hit(corners, vec3(0.25, 0.25, 2.0), V::NEG_Z), Some(2.0));
            assert_eq!(hit(corners, vec3(0.25, 0.25, -2.0), V::Z), Some(2.0));
            assert_eq!(hit(corners, vec3(0.25, 0.25, -2.0), V::NEG_Z), None);
            assert_eq!(hit(corners, vec3(0.75, 0.75, 2.0), V::NEG_Z), None);
            assert_eq!(hit(corners, vec3(-0.01, 0.5, 2.0), V::NEG_Z), None);
        }
    }

    #[test]
    fn edges_and_corners_belong_to_the_triangle() {
        for p in [V::ZERO, V::X, V::Y, vec3(0.5, 0.0, 0.0), vec3(0.0, 0.5, 0.0), vec3(0.5, 0.5, 0.0)] {
            assert_eq!(hit(UNIT, p + V::Z, V::NEG_Z), Some(1.0), "{p}");
        }
    }

    #[test]
    fn parallel_rays_and_degenerate_triangles_miss() {
        assert_eq!(hit(UNIT, vec3(-1.0, 0.2, 0.0), V::X), None);
        assert_eq!(hit(UNIT, vec3(-1.0, 0.2, 1.0), V::X), None);
        assert_eq!(hit([V::ZERO, V::X, V::X * 2.0], vec3(0.5, 0.0, 1.0), V::NEG_Z), None);
        assert_eq!(hit([V::ONE; 3], vec3(1.0, 1.0, 3.0), V::NEG_Z), None);
    }

    /// A triangle on the unit circle whose normals lean outward by 30°: in its middle, each tangent plane is sin 30° above,
    /// along its own normal, so that the mean is sin 30° cos 30° above.
    #[test]
    fn points_rise_to_the_tangent_planes() {
        let corners = [0.0, 1.0 / 3.0, 2.0 / 3.0].map(|turns: f64| {
            let (y, x) = (turns * std::f64::consts::TAU).sin_cos();
            glam::dvec3(x, y, 0.0)
        });
        let (sin, cos) = (0.5f64, 0.75f64.sqrt());
        let mut triangles = Triangles::default();
        triangles.push(corners.map(|c| c.as_vec3()), Sides::Both, 0);
        triangles.normals.values = corners.iter().map(|c| (*c * sin + glam::dvec3(0.0, 0.0, cos)).as_vec3()).collect();
        triangles.normals.set(0, [0, 1, 2]);
        let rise = |normal: V, point: V| {
            let surface = Surface { point: Vec3::<f32>::from(point), normal: normal.into(), reach: 0.0 };
            triangles.smooth(0, &surface).map(|pair| pair.map(V::from)).unwrap()
        };
        let [normal, height] = rise(V::Z, V::ZERO);
        assert!(normal.abs_diff_eq(V::Z, 1e-6) && height.abs_diff_eq(V::Z * (sin * cos) as f32, 1e-6), "{height}");
        // From behind it is hollow, and at a corner there is nothing to rise to.
        let [normal, height] = rise(V::NEG_Z, V::ZERO);
        assert!(normal.abs_diff_eq(V::NEG_Z, 1e-6) && height == V::ZERO, "{height}");
        let [normal, height] = rise(V::Z, V::X);
        assert!(normal.abs_diff_eq(vec3(0.5, 0.0, cos as f32), 1e-6) && height.length() < 1e-6, "{normal} {height}");
    }
}
