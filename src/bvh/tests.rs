//! Tests of the whole tree.

use glam::{Vec3, vec3};

use super::build::{Tree, build};
use super::layout::layout;
use super::refs::collect;
use super::*;
use crate::geometry::{Cuboids, Primitives, Sides, Spheres, Triangles};
use crate::math::NONE;

/// Primitives of three kinds; every storage has a place for each, so that ids tell where it is.
#[derive(Default)]
struct Items {
    items: Vec<Item>,
    spheres: Spheres,
    triangles: Triangles,
    cuboids: Cuboids,
}

#[derive(Clone, Copy)]
enum Item {
    Triangle([Vec3; 3]),
    Sphere(Vec3, f32),
    Other(Aabb),
}

/// The id of the first.
const FIRST: u32 = 7;

impl Items {
    fn new(items: Vec<Item>) -> Self {
        let mut all = Self::default();
        items.into_iter().for_each(|item| all.push(item));
        all
    }

    fn push(&mut self, item: Item) {
        self.items.push(item);
        let sphere = if let Item::Sphere(center, radius) = item { (center, radius) } else { (Vec3::ZERO, 1.0) };
        self.spheres.push(sphere.0, sphere.1, Sides::Both, 0);
        self.triangles.push(if let Item::Triangle(corners) = item { corners } else { [Vec3::ZERO; 3] }, Sides::Both, 0);
        let Aabb { min, max } = if let Item::Other(bounds) = item { bounds } else { Aabb::EMPTY };
        self.cuboids.push(min, max, Vec3::ZERO, 0);
    }
}

impl Source for Items {
    fn len(&self) -> usize {
        self.items.len()
    }
    fn bounds(&self, i: usize) -> Aabb {
        match self.items[i] {
            Item::Triangle(corners) => corners.into_iter().fold(Aabb::EMPTY, Aabb::extend),
            Item::Sphere(c, r) => Aabb { min: c - r, max: c + r },
            Item::Other(bounds) => bounds,
        }
    }
    fn class(&self, i: usize) -> Class {
        match self.items[i] {
            Item::Triangle(_) => Class::new(Kind::Triangles, 0),
            Item::Sphere(..) => Class::new(Kind::Spheres, 0),
            Item::Other(_) => Class::new(Kind::Cuboids, 0),
        }
    }
    fn id(&self, i: usize) -> u32 {
        i as u32 + FIRST
    }
    fn blocks(&self, ids: &[Vec<[u32; BLOCK]>]) -> Blocks {
        let of = |kind: Kind| &ids[kind as usize - 1][..];
        Blocks {
            spheres: BlockList::of(&self.spheres, FIRST, of(Kind::Spheres)),
            triangles: BlockList::of(&self.triangles, FIRST, of(Kind::Triangles)),
            cuboids: BlockList::of(&self.cuboids, FIRST, of(Kind::Cuboids)),
            ..Blocks::default()
        }
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
    Items::new((0..len).map(item).collect())
}

fn boxes(boxes: impl IntoIterator<Item = [Vec3; 2]>) -> Items {
    Items::new(boxes.into_iter().map(|[min, max]| Item::Other(Aabb { min, max })).collect())
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
        assert!(depth <= MAX_DEPTH, "{depth}");
        assert!(check.seen.iter().all(|&n| n == 1), "every primitive is in exactly one block");
        assert_eq!(check.visited, bvh.nodes.len());
        assert_eq!(check.blocks, bvh.blocks.counts().iter().sum::<usize>());
        bvh
    }

    /// The exact box around the primitives below, and how many nodes there are on the longest way down.
    fn child(&mut self, child: Child) -> (Aabb, usize) {
        let i = child.index();
        match child.kind() {
            Kind::Node => self.node(i),
            kind => {
                let (items, blocks) = (self.source, &self.bvh.blocks);
                match kind {
                    Kind::Triangles => same(&items.triangles, &blocks.triangles.blocks[i]),
                    Kind::Spheres => same(&items.spheres, &blocks.spheres.blocks[i]),
                    _ => same(&items.cuboids, &blocks.cuboids.blocks[i]),
                }
                let id = *blocks.ids(child);
                self.block(id, kind);
                (self.bounds(&id), 0)
            }
        }
    }

    fn index(id: u32) -> usize {
        (id - FIRST) as usize
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

    fn block(&mut self, id: [u32; BLOCK], kind: Kind) {
        self.blocks += 1;
        let len = id.iter().take_while(|&&id| id != NONE).count();
        assert!(len > 0 && id[len..].iter().all(|&id| id == NONE));
        assert!(id[..len].is_sorted_by(|a, b| a < b));
        for &id in &id[..len] {
            let i = Self::index(id);
            assert_eq!(self.source.class(i).kind(), kind);
            self.seen[i] += 1;
        }
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

/// Asserts that a block holds the numbers of its primitives, and in its unused lanes those of the first.
fn same<K: Primitives>(kind: &K, block: &Block<K>) {
    for lane in 0..BLOCK {
        let id = if lane < block.len() { block.id[lane] } else { block.id[0] };
        let (stored, shape) = (block.primitive(lane), kind.shape(Check::index(id)));
        K::zip(&stored, &shape, |a: &f32, b: &f32| assert!(a.to_bits() == b.to_bits()));
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

    let bvh = Check::of(&Items::new(vec![Item::Sphere(Vec3::ONE, 1.0)]));
    assert_eq!((bvh.root, bvh.depth), (Child::new(Kind::Spheres, 0), 0));
    assert_eq!(bvh.stats().sah, Kind::Spheres.cost(1));
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

/// The least there can be: blocks of eight, and nodes of eight children.
#[test]
fn what_coincides_fills_blocks_and_nodes() {
    for (len, blocks, nodes, depth) in
        [(1, 1, 0, 0), (8, 1, 0, 0), (9, 2, 1, 1), (64, 8, 1, 1), (65, 9, 2, 2), (4096, 512, 73, 3)]
    {
        let bvh = Check::of(&Items::new(vec![Item::Sphere(Vec3::ONE, 2.0); len]));
        assert_eq!(
            (bvh.blocks.counts().iter().sum::<usize>(), bvh.nodes.len(), bvh.depth),
            (blocks, nodes, depth),
            "{len}"
        );
    }
    // Two classes are parted, and what only has the same middle is.
    let several = (0..1000).map(|i| match i % 3 {
        0 => Item::Sphere(Vec3::ONE, 2.0),
        1 => Item::Other(Aabb { min: Vec3::NEG_ONE, max: Vec3::splat(3.0) }),
        _ => Item::Sphere(Vec3::ONE, 1.0 + i as f32),
    });
    Check::of(&Items::new(several.collect()));
}

#[test]
fn one_huge_primitive_does_not_spoil_the_rest() {
    let alone = mixed(2000);
    let mut with = mixed(2000);
    with.push(Item::Sphere(Vec3::splat(3e30), 1e29));
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
    let free = build(collect(&items), MAX_DEPTH);
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
        assert!(one.nodes == other.nodes);
        let ids = |bvh: &Bvh| -> Vec<[u32; BLOCK]> {
            let children = bvh.nodes.iter().flat_map(|node| node.child);
            children.map(|child| *bvh.blocks.ids(child)).collect()
        };
        assert_eq!(ids(&one), ids(&other));
        assert_eq!((one.root, one.bounds, one.depth), (other.root, other.bounds, other.depth));
    }
}

/// The least cost of a binary subtree as at most `children` children, by trying everything.
fn least(tree: &Tree, source: &Items, node: usize, first: usize, children: usize) -> f64 {
    let n = tree.nodes[node];
    let len = n.len as usize;
    let class = source.class(tree.order[first] as usize);
    let one_class = tree.order[first..first + len].iter().all(|&i| source.class(i as usize) == class);
    let block = if len <= BLOCK && one_class { n.bounds.area_f64() * class.cost(len) } else { f64::INFINITY };
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
        let tree = build(collect(&items), MAX_DEPTH);
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
fn children_are_what_they_were_made() {
    for i in [0, 1, 12345, MAX_PRIMITIVES - 1] {
        for kind in Kind::BLOCKS.iter().copied().chain([Kind::Node]) {
            let child = Child::new(kind, i);
            assert!(child.kind() == kind && child.index() == i && child != Child::EMPTY);
        }
    }
    assert_eq!(Child::EMPTY.kind(), Kind::Nothing);
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
    let stats = Check::of(&Items::new([0.0, 0.01, 100.0].map(far).to_vec())).stats();
    assert_eq!((stats.primitives, stats.nodes, stats.children), (3, 1, 2.0));
    assert_eq!(stats.blocks.iter().sum::<usize>(), 2);
    assert_eq!((stats.fill, stats.bytes, stats.depth), (1.5, 256 + 2 * 160, 1));
    // The blocks' boxes are small beside the root's.
    assert!(stats.sah > NODE_COST && stats.sah < NODE_COST + 0.1);
    let text = stats.to_string();
    assert!(
        text.starts_with("1 nodes with 2.0 children each, blocks: 2 of spheres, with 1.5 primitives each"),
        "{text}"
    );
    assert!(text.contains("192 bytes a primitive, depth 1"), "{text}");
}
