//! Tests of the whole tree.

use glam::{Vec3, vec3};

use super::build::{Tree, build};
use super::layout::layout;
use super::refs::collect;
use super::*;
use crate::geometry::methods::SphereMethod;
use crate::geometry::{Sides, Triangles, sphere, triangle};
use crate::math::Vec3 as Lane3;

/// Primitives of all classes; ids rise faster than indices.
#[derive(Default)]
struct Items(Vec<Item>);

#[derive(Clone, Copy)]
enum Item {
    Triangle([Vec3; 3]),
    Sphere(Vec3, f32),
    Other(Aabb),
}

impl Source for Items {
    fn len(&self) -> usize {
        self.0.len()
    }
    fn bounds(&self, i: usize) -> Aabb {
        match self.0[i] {
            Item::Triangle(corners) => corners.into_iter().fold(Aabb::EMPTY, Aabb::extend),
            Item::Sphere(c, r) => Aabb { min: c - r, max: c + r },
            Item::Other(bounds) => bounds,
        }
    }
    fn class(&self, i: usize) -> Class {
        match self.0[i] {
            Item::Triangle(_) => Class::Triangle,
            Item::Sphere(..) => Class::Sphere,
            Item::Other(_) => Class::Other,
        }
    }
    fn id(&self, i: usize) -> u32 {
        3 * i as u32 + 7
    }
    fn triangle(&self, i: usize) -> [Vec3; 3] {
        let Item::Triangle(corners) = self.0[i] else { panic!("{i} is no triangle") };
        corners
    }
    fn sphere(&self, i: usize) -> (Vec3, f32) {
        let Item::Sphere(center, radius) = self.0[i] else { panic!("{i} is no sphere") };
        (center, radius)
    }
}

/// Numbers from 0 to 1.
struct Random(u64);

impl Random {
    fn next(&mut self) -> f32 {
        self.0 = self.0.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (self.0 >> 40) as f32 / (1 << 24) as f32
    }
    fn point(&mut self) -> Vec3 {
        vec3(self.next(), self.next(), self.next()) * 2.0 - 1.0
    }
}

fn mixed(len: usize) -> Items {
    let mut random = Random(len as u64);
    let item = |_| {
        let (p, size) = (random.point(), 0.05 * random.next());
        match (random.next() * 3.0) as u32 {
            0 => Item::Triangle([p, p + random.point() * size, p + random.point() * size]),
            1 => Item::Sphere(p, size),
            _ => Item::Other(Aabb { min: p, max: p + size }),
        }
    };
    Items((0..len).map(item).collect())
}

fn boxes(boxes: impl IntoIterator<Item = [Vec3; 2]>) -> Items {
    Items(boxes.into_iter().map(|[min, max]| Item::Other(Aabb { min, max })).collect())
}

/// Everything that a traversal relies on.
struct Check<'a> {
    bvh: &'a Bvh,
    source: &'a Items,
    seen: Vec<usize>,
    visited: usize,
    blocks: usize,
}

impl Check<'_> {
    fn of(source: &Items) -> Bvh {
        let bvh = Bvh::build(source);
        let mut check = Check { bvh: &bvh, source, seen: vec![0; source.len()], visited: 0, blocks: 0 };
        let (bounds, depth) = check.child(bvh.root);
        assert_eq!(bounds, bvh.bounds);
        assert_eq!(depth, bvh.depth);
        assert!(depth <= MOST_DEPTH, "{depth}");
        assert!(check.seen.iter().all(|&n| n == 1), "every primitive is in exactly one block");
        assert_eq!(check.visited, bvh.nodes.len());
        assert_eq!(check.blocks, bvh.triangles.len() + bvh.spheres.len() + bvh.others.len());
        bvh
    }

    /// The exact box around the primitives below, and how many nodes there are on the longest way down.
    fn child(&mut self, child: Child) -> (Aabb, usize) {
        let i = child.index();
        match child.kind() {
            Kind::Node => self.node(i),
            Kind::Triangles => {
                let block = self.bvh.triangles[i];
                let corners = |lane| block.corners.map(|c| Vec3::from(c.map(|column| column[lane])));
                let len = self.block(block.id, |s, i, lane| s.triangle(i) == corners(lane));
                assert!((len..BLOCK).all(|lane| corners(lane) == [Vec3::ZERO; 3]));
                (self.bounds(&block.id), 0)
            }
            Kind::Spheres => {
                let block = self.bvh.spheres[i];
                let center = |lane| Vec3::from(block.center.map(|column| column[lane]));
                let len = self.block(block.id, |s, i, lane| s.sphere(i) == (center(lane), block.radius[lane]));
                assert!((len..BLOCK).all(|lane| center(lane) == Vec3::ZERO && block.radius[lane].is_nan()));
                (self.bounds(&block.id), 0)
            }
            Kind::Others => {
                let id = self.bvh.others[i].id;
                self.block(id, |s, i, _| s.class(i) == Class::Other);
                (self.bounds(&id), 0)
            }
        }
    }

    fn index(id: u32) -> usize {
        assert_eq!(id % 3, 1);
        (id as usize - 7) / 3
    }

    /// The union of the boxes of a block's primitives, as the builder reads them.
    fn bounds(&self, id: &[u32; BLOCK]) -> Aabb {
        let bounds = |&id: &u32| {
            let Aabb { min, max } = self.source.bounds(Self::index(id));
            let clamp = |v: Vec3, nan: f32| {
                v.to_array().map(|x| if x.is_nan() { nan } else { x.clamp(f32::MIN, f32::MAX) }).into()
            };
            Aabb { min: clamp(min, f32::MIN), max: clamp(max, f32::MAX) }
        };
        id.iter().filter(|&&id| id != NONE).map(bounds).fold(Aabb::EMPTY, Aabb::union)
    }

    fn block(&mut self, id: [u32; BLOCK], same: impl Fn(&Items, usize, usize) -> bool) -> usize {
        self.blocks += 1;
        let len = id.iter().take_while(|&&id| id != NONE).count();
        assert!(len > 0 && id[len..].iter().all(|&id| id == NONE));
        assert!(id[..len].is_sorted_by(|a, b| a < b));
        for (lane, &id) in id[..len].iter().enumerate() {
            let i = Self::index(id);
            assert!(same(self.source, i, lane));
            self.seen[i] += 1;
        }
        len
    }

    fn node(&mut self, i: usize) -> (Aabb, usize) {
        self.visited += 1;
        let node = self.bvh.nodes[i];
        let (mut all, mut deepest) = (Aabb::EMPTY, 0);
        assert!(node.len() >= 2);
        for lane in 0..node.len() {
            assert!(node.child[lane].kind() != Kind::Node || node.child[lane].index() > i);
            let (bounds, depth) = self.child(node.child[lane]);
            assert_eq!(node.bounds(lane), bounds, "the box holds all that is below, and is no larger");
            all = all.union(bounds);
            deepest = deepest.max(depth);
        }
        for lane in node.len()..WIDTH {
            assert_eq!(node.child[lane], Child::EMPTY);
            assert_eq!(node.bounds(lane), Aabb::EMPTY);
        }
        (all, deepest + 1)
    }
}

#[test]
fn mixed_classes_of_every_number() {
    for len in (1..40).chain([100, 1000, 5000]) {
        Check::of(&mixed(len));
    }
}

#[test]
fn nothing_and_one() {
    let bvh = Bvh::build(&Items::default());
    assert_eq!((bvh.root, bvh.depth, bvh.bytes(), bvh.bounds), (Child::EMPTY, 0, 0, Aabb::EMPTY));
    assert_eq!(bvh.stats().sah, 0.0);

    let bvh = Check::of(&Items(vec![Item::Sphere(Vec3::ONE, 1.0)]));
    assert_eq!((bvh.root, bvh.depth), (Child::spheres(0), 0));
    assert_eq!(bvh.stats().sah, BLOCK_COST + PRIMITIVE_COST);
}

#[test]
fn bad_inputs() {
    let mut random = Random(1);
    let n = 3000;
    let point = |p: Vec3| [p, p];
    let equal = boxes((0..n).map(|_| [Vec3::ZERO, Vec3::ONE]));
    let points = boxes((0..n).map(|_| point(Vec3::ONE)));
    let collinear = boxes((0..n).map(|i| point(Vec3::X * i as f32)));
    let diagonal = boxes((0..n).map(|i| point(Vec3::ONE * (i % 1000) as f32)));
    let flat = boxes((0..n).map(|_| point(random.point() * vec3(1.0, 0.0, 1.0))));
    let nested = boxes((0..n).map(|i| [Vec3::splat(-(i as f32)), Vec3::splat(i as f32)]));
    let exponential = boxes((-149..128).cycle().take(n).map(|e| point(Vec3::ONE * (e as f32).exp2())));
    let growing = boxes((-149..127).map(|e| [Vec3::ZERO, Vec3::ONE * (e as f32).exp2()]));
    let huge = boxes((0..n).map(|_| point(random.point() * 1e30)));
    let largest = boxes((0..n).map(|_| point(random.point() * f32::MAX)));
    let widest = boxes((0..n).map(|i| [Vec3::splat(f32::MIN), vec3(i as f32, f32::MAX, f32::MAX)]));
    let tiny = boxes((0..n).map(|_| point(random.point() * 1e-44)));
    let zeros = boxes((0..n).map(|i| point(vec3(if i % 2 == 0 { -0.0 } else { 0.0 }, 0.0, (i % 7) as f32))));
    let far = boxes((0..n).map(|i| [Vec3::NEG_INFINITY, vec3(i as f32, f32::INFINITY, 0.0)]));
    let nan = boxes((0..n).map(|i| point(vec3(f32::NAN, i as f32, 0.0))));
    let among = boxes((0..n).map(|i| point(if i == 99 { Vec3::splat(1e30) } else { random.point() })));
    for items in [
        equal,
        points,
        collinear,
        diagonal,
        flat,
        nested,
        exponential,
        growing,
        huge,
        largest,
        widest,
        tiny,
        zeros,
        far,
        nan,
        among,
    ] {
        Check::of(&items);
    }
}

#[test]
fn one_huge_primitive_does_not_spoil_the_rest() {
    let alone = mixed(2000);
    let mut with = mixed(2000);
    with.0.push(Item::Sphere(Vec3::splat(3e30), 1e29));
    let [alone, with] = [alone, with].map(|items| Check::of(&items));
    // As many nodes and blocks, give or take those that the root needs.
    assert!(with.nodes.len().abs_diff(alone.nodes.len()) <= 8, "{} {}", with.nodes.len(), alone.nodes.len());
    assert!(with.depth <= alone.depth + 1);
}

fn depth(tree: &Tree, node: usize, len: usize) -> usize {
    let children = |left: usize| [(node + 1, left), (node + 2 * left, len - left)];
    match tree.nodes[node].len as usize {
        1 => 0,
        _ if tree.nodes[node].choices.is_leaf() => 0,
        _ => {
            1 + children(tree.nodes[node + 1].len as usize).map(|(at, n)| depth(tree, at, n)).into_iter().max().unwrap()
        }
    }
}

#[test]
fn depth_is_bounded_by_halving() {
    // Three of a size, sizes 32 times apart: a plane between bins separates the largest from all others.
    let sizes = (-28..24).flat_map(|e| [32f32.powi(e); 3]);
    let items = boxes(sizes.map(|size| [Vec3::X * size, Vec3::X * size]));
    let free = build(collect(&items), MOST_DEPTH);
    let len = items.len();
    assert!(depth(&free, 0, len) > 12, "{}", depth(&free, 0, len));
    for levels in 8..12 {
        let depth = depth(&build(collect(&items), levels), 0, len);
        assert!(depth <= levels, "{depth} {levels}");
    }
}

#[test]
fn the_same_tree_whatever_the_threads() {
    // Enough to bin in parallel.
    let items = mixed(80_000);
    let on = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| Bvh::build(&items))
    };
    let one = on(1);
    for threads in [2, 3] {
        let other = on(threads);
        assert!(one.nodes == other.nodes && one.triangles == other.triangles && one.others == other.others);
        let bits = |s: &SphereBlock| (s.id, s.radius.map(f32::to_bits), s.center);
        assert!(one.spheres.iter().map(bits).eq(other.spheres.iter().map(bits)));
        assert_eq!((one.root, one.bounds, one.depth), (other.root, other.bounds, other.depth));
    }
}

/// The least cost of a binary subtree as at most `children` children, by trying everything.
fn least(tree: &Tree, source: &Items, node: usize, first: usize, children: usize) -> f64 {
    let n = tree.nodes[node];
    let len = n.len as usize;
    let class = source.class(tree.order[first] as usize);
    let one_class = tree.order[first..first + len].iter().all(|&i| source.class(i as usize) == class);
    let block = if len <= BLOCK && one_class {
        n.bounds.area_f64() * (BLOCK_COST + PRIMITIVE_COST * len as f64)
    } else {
        f64::INFINITY
    };
    if n.choices.is_leaf() {
        return block;
    }
    let left = tree.nodes[node + 1].len as usize;
    let apart = |children: usize| {
        (1..children)
            .map(|k| {
                least(tree, source, node + 1, first, k)
                    + least(tree, source, node + 2 * left, first + left, children - k)
            })
            .fold(f64::INFINITY, f64::min)
    };
    let one = block.min(n.bounds.area_f64() * NODE_COST + apart(WIDTH));
    (2..=children).map(apart).fold(one, f64::min)
}

#[test]
fn wide_nodes_and_blocks_are_the_cheapest_there_are() {
    for len in [5, 9, 14, 18] {
        let items = mixed(len);
        let tree = build(collect(&items), MOST_DEPTH);
        let cost = least(&tree, &items, 0, 0, 1) / tree.nodes[0].bounds.area_f64();
        let sah = layout(&items, &tree).stats().sah;
        assert!((sah - cost).abs() <= 1e-12 * cost, "{len}: {sah} {cost}");
    }
}

#[test]
fn clusters_stay_apart() {
    let mut random = Random(5);
    let cluster = |at: f32, random: &mut Random| -> Vec<_> {
        (0..100).map(|_| random.point() + Vec3::X * at).map(|p| [p, p + 0.1]).collect()
    };
    let all = [-1000.0, 0.0, 1000.0].into_iter().flat_map(|at| cluster(at, &mut random));
    let bvh = Check::of(&boxes(all));
    let root = bvh.nodes[0];
    assert!((0..root.len()).all(|lane| root.ends[1][0][lane] - root.ends[0][0][lane] < 10.0));
}

#[test]
fn unused_lanes_are_never_hit() {
    let (s, t) = (SphereBlock::EMPTY, TriangleBlock::EMPTY);
    let center = Lane3::new(s.center[0][7], s.center[1][7], s.center[2][7]);
    let mut triangles = Triangles::default();
    triangles.push(t.corners.map(|c| Vec3::from(c.map(|column| column[7]))), Sides::Both, 0);
    let record = crate::geometry::Primitives::record(&triangles, 0);

    let mut random = Random(9);
    let mut hits = 0;
    for scale in [0.0, 1e-40, 1e-20, 1e-3, 1.0, 1e10, 1e18, 1e20, 1e38] {
        for _ in 0..200 {
            let origin = random.point() * scale;
            // Some straight at the lane's place, some along an axis, the others anywhere.
            for d in [random.point(), -origin.normalize_or(Vec3::X), Vec3::X, Vec3::NEG_Z] {
                let d = d.normalize_or(Vec3::Y);
                let (o, lanes) = (Lane3::from(origin), Lane3::from(d));
                for sides in [Sides::Both, Sides::Front, Sides::Back] {
                    let seen = sphere::SeenSphere::new(center, s.radius[7], sides, SphereMethod::Stable, o);
                    for method in [sphere::stable, sphere::one_sided, sphere::quadratic, sphere::geometric] {
                        assert!(method(&seen, lanes, 0.0, f32::INFINITY).is_none(), "{origin} {d}");
                    }
                }
                // A radius of 0 would be hit.
                let point = sphere::SeenSphere::new(center, 0.0, Sides::Both, SphereMethod::Stable, o);
                hits += usize::from(sphere::stable(&point, lanes, 0.0, f32::INFINITY).is_some());

                let seen = <Triangles as crate::geometry::Primitives>::seen(&record, o);
                assert!(triangle::watertight(&seen, &triangle::Aim::new(lanes), 0.0, f32::INFINITY).is_none());
                let seen = triangle::SeenEdges::new(&record, o);
                assert!(triangle::moller_trumbore(&seen, lanes, 0.0, f32::INFINITY).is_none());
            }
        }
    }
    assert!(hits > 0);
}

#[test]
fn children_are_what_they_were_made() {
    for i in [0, 1, 12345, MOST_PRIMITIVES - 1] {
        let made = [Child::node(i), Child::triangles(i), Child::spheres(i), Child::others(i)];
        assert_eq!(made.map(Child::kind), [Kind::Node, Kind::Triangles, Kind::Spheres, Kind::Others]);
        assert!(made.into_iter().all(|child| child.index() == i && child != Child::EMPTY));
    }
}

#[test]
fn areas_and_centers() {
    assert_eq!(Aabb::EMPTY.area(), 0.0);
    assert!(Aabb::EMPTY.is_empty() && !Aabb { min: Vec3::ONE, max: Vec3::ONE }.is_empty());
    let a = Aabb { min: Vec3::ZERO, max: vec3(1.0, 2.0, 3.0) };
    assert_eq!(a.area(), 11.0);
    assert_eq!(a.center(), vec3(0.5, 1.0, 1.5));
    let all = Aabb { min: Vec3::splat(f32::MIN), max: Vec3::splat(f32::MAX) };
    assert_eq!((all.area(), all.center()), (f32::INFINITY, Vec3::ZERO));
    assert!(all.contains(a) && !a.contains(all) && a.contains(Aabb::EMPTY));
    let line = Aabb { min: Vec3::NEG_INFINITY, max: vec3(f32::INFINITY, f32::NEG_INFINITY, 0.0) };
    assert!(!line.area().is_nan());
}

#[test]
fn figures_of_a_tree() {
    let far = |i: f32| Item::Sphere(Vec3::X * i, 0.1);
    let stats = Check::of(&Items([0.0, 0.01, 100.0].map(far).to_vec())).stats();
    assert_eq!((stats.primitives, stats.nodes, stats.blocks, stats.children), (3, 1, [0, 2, 0], 2.0));
    assert_eq!((stats.fill, stats.bytes, stats.depth), (1.5, 256 + 2 * 160, 1));
    // The blocks' boxes are small beside the root's.
    assert!(stats.sah > NODE_COST && stats.sah < NODE_COST + 0.1);
    let text = stats.to_string();
    assert!(text.starts_with("1 nodes with 2.0 children each, 0 + 2 + 0 blocks"), "{text}");
    assert!(text.contains("192 bytes a primitive, depth 1"), "{text}");
}
