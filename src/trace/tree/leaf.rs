//! The primitives of a block against a group, a packet or a ray: one text for all kinds, but for what triangles have of
//! their own.

use super::alone::Alone;
use super::beams::RAYS;
use super::behind::{Behind, Met};
use super::bits::Bits;
use super::walk::Walk;
use crate::bvh::{BLOCK, Block, BlockList, Child, Kind};
use crate::geometry::face::Aim as Faces;
use crate::geometry::*;
use crate::kinds::for_each_kind;
use crate::math::{LaneMask, Lanes, NONE};
use crate::trace::packet::{Packet, hits};
use crate::trace::query::Query;
use std::marker::PhantomData;
use std::ops::Range;
use wide::{f32x8, f32x16};

/// Rays on their way that meet a block.
pub trait Visitor {
    /// Tests primitives of a block of a kind; whether any hit was taken.
    fn visit<Q: Query, K: Leaf>(&self, walk: &mut Walk, kind: &K, block: &Block<K>, variant: K::Variant) -> bool;
}

/// Groups of rays behind beams, which are tested in packets of `L::WIDTH`.
pub struct Together<'a, L> {
    groups: &'a dyn Behind,
    lanes: PhantomData<L>,
}

impl<'a, L> Together<'a, L> {
    /// Of any kind: which it is matters only for the boxes.
    pub fn new(groups: &'a dyn Behind) -> Self {
        Self { groups, lanes: PhantomData }
    }
}

/// Sixteen rays, each with its own interval.
pub struct Sixteen {
    /// The first.
    pub at: usize,
    /// Those that meet the block.
    pub lanes: u32,
}

/// A kind as the tree tests it.
pub trait Leaf: Bounded {
    /// Whether edges tell which groups meet one.
    const EDGES: bool = false;

    /// A block against groups.
    #[inline(always)]
    fn groups<Q: Query, L: Lanes>(walk: &mut Walk, block: &Block<Self>, variant: Self::Variant, met: &Met) -> bool {
        self::groups::<Q, Self, _, L>(walk, Standard, block, variant, met)
    }

    /// A block against sixteen rays.
    #[inline(always)]
    fn sixteen<Q: Query>(walk: &mut Walk, block: &Block<Self>, variant: Self::Variant, rays: &Sixteen) -> bool {
        let used = used(block);
        if rays.lanes.count_ones() <= used.count_ones() {
            // One ray against all primitives costs as much as one primitive against all rays.
            let mut taken = false;
            for lane in Bits(rays.lanes) {
                let ray = Alone::new(walk, rays.at + lane);
                taken |= eight::<Q, Self, _>(walk, Standard, block, variant, &ray);
            }
            return taken;
        }
        packets::<Q, Self, _, f32x16>(walk, Standard, block, variant, used, rays.at..rays.at + f32x16::WIDTH)
    }

    /// A block against one ray.
    #[inline(always)]
    fn alone<Q: Query>(walk: &mut Walk, block: &Block<Self>, variant: Self::Variant, ray: &Alone) -> bool {
        eight::<Q, Self, _>(walk, Standard, block, variant, ray)
    }
}

impl<L: Lanes> Visitor for Together<'_, L> {
    #[inline(always)]
    fn visit<Q: Query, K: Leaf>(&self, walk: &mut Walk, kind: &K, block: &Block<K>, variant: K::Variant) -> bool {
        let met = self.groups.met(&K::extent(&columns(block)), used(block), K::EDGES && kind.named().is_none());
        met.primitives != 0 && test_groups::<Q, K, L>(walk, kind, block, variant, &met)
    }
}

#[inline(never)]
fn test_groups<Q: Query, K: Leaf, L: Lanes>(
    walk: &mut Walk,
    kind: &K,
    block: &Block<K>,
    variant: K::Variant,
    met: &Met,
) -> bool {
    match kind.named() {
        None => K::groups::<Q, L>(walk, block, variant, met),
        Some(test) => groups_named::<Q, K, L>(walk, test, block, variant, met),
    }
}

impl Visitor for Sixteen {
    #[inline(always)]
    fn visit<Q: Query, K: Leaf>(&self, walk: &mut Walk, kind: &K, block: &Block<K>, variant: K::Variant) -> bool {
        let range = self.at..self.at + f32x16::WIDTH;
        match kind.named() {
            None => K::sixteen::<Q>(walk, block, variant, self),
            Some(test) => packets_named::<Q, K, f32x16>(walk, test, block, variant, used(block), range),
        }
    }
}

impl Visitor for Alone {
    #[inline(always)]
    fn visit<Q: Query, K: Leaf>(&self, walk: &mut Walk, kind: &K, block: &Block<K>, variant: K::Variant) -> bool {
        match kind.named() {
            None => K::alone::<Q>(walk, block, variant, self),
            Some(test) => eight_named::<Q, K>(walk, test, block, variant, self),
        }
    }
}

/// The lanes with a primitive.
#[inline(always)]
pub fn used<K: Primitives>(block: &Block<K>) -> u32 {
    !LaneMask::bits(f32x8::id_mask(&block.id, NONE)) & 0xff
}

/// All primitives of a block, one a lane.
#[inline(always)]
pub fn columns<K: Primitives>(block: &Block<K>) -> K::Shape<f32x8> {
    K::map(&block.shape, |column: &[f32; BLOCK]| f32x8::from(*column))
}

/// Groups against the primitives whose boxes they meet.
#[inline(always)]
fn groups<Q: Query, K: Bounded, T: Test<K>, L: Lanes>(
    walk: &mut Walk,
    test: T,
    block: &Block<K>,
    variant: K::Variant,
    met: &Met,
) -> bool {
    let mut taken = false;
    for lane in Bits(met.primitives) {
        let lane = lane & (BLOCK - 1);
        let shape = K::splat(&block.primitive(lane));
        for group in Bits(met.groups[lane]) {
            for at in (RAYS * group..RAYS * (group + 1)).step_by(L::WIDTH) {
                let packet = Packet::of(walk.rays, at);
                let faces = Faces::new(packet.direction);
                if let Some((t, inside)) = hits::<K, T, L>(test, &shape, variant, &packet, &faces) {
                    taken |= walk.state.take::<Q, L>(at, t, inside, block.id[lane]);
                }
            }
        }
    }
    taken
}

/// [`groups`] by a method that was asked for.
#[inline(never)]
fn groups_named<Q: Query, K: Bounded, L: Lanes>(
    walk: &mut Walk,
    test: K::Named,
    block: &Block<K>,
    variant: K::Variant,
    met: &Met,
) -> bool {
    groups::<Q, K, _, L>(walk, test, block, variant, met)
}

/// Packets against the primitives of some lanes.
#[inline(always)]
fn packets<Q: Query, K: Bounded, T: Test<K>, L: Lanes>(
    walk: &mut Walk,
    test: T,
    block: &Block<K>,
    variant: K::Variant,
    lanes: u32,
    range: Range<usize>,
) -> bool {
    let mut taken = false;
    for at in range.step_by(L::WIDTH) {
        let packet = Packet::<L>::of(walk.rays, at);
        let faces = Faces::new(packet.direction);
        for lane in Bits(lanes) {
            let lane = lane & (BLOCK - 1);
            let shape = K::splat(&block.primitive(lane));
            if let Some((t, inside)) = hits::<K, T, L>(test, &shape, variant, &packet, &faces) {
                taken |= walk.state.take::<Q, L>(at, t, inside, block.id[lane]);
            }
        }
    }
    taken
}

/// [`packets`] by a method that was asked for.
#[inline(never)]
fn packets_named<Q: Query, K: Bounded, L: Lanes>(
    walk: &mut Walk,
    test: K::Named,
    block: &Block<K>,
    variant: K::Variant,
    lanes: u32,
    range: Range<usize>,
) -> bool {
    packets::<Q, K, _, L>(walk, test, block, variant, lanes, range)
}

/// One ray against all primitives.
#[inline(always)]
fn eight<Q: Query, K: Bounded, T: Test<K>>(
    walk: &mut Walk,
    test: T,
    block: &Block<K>,
    variant: K::Variant,
    ray: &Alone,
) -> bool {
    let packet = Packet::splat::<f32x8>(walk.rays, ray.i);
    let faces = Faces::new(packet.direction);
    let found = hits::<K, T, f32x8>(test, &columns(block), variant, &packet, &faces);
    found.is_some_and(|(t, inside)| take_eight::<Q>(walk, ray.i, t, inside, &block.id))
}

/// [`eight`] by a method that was asked for.
#[inline(never)]
fn eight_named<Q: Query, K: Bounded>(
    walk: &mut Walk,
    test: K::Named,
    block: &Block<K>,
    variant: K::Variant,
    ray: &Alone,
) -> bool {
    eight::<Q, K, _>(walk, test, block, variant, ray)
}

/// Takes ray `i`'s hits of a block, where `inside` is true.
#[inline(always)]
pub fn take_eight<Q: Query>(walk: &mut Walk, i: usize, t: f32x8, inside: f32x8, ids: &[u32; BLOCK]) -> bool {
    let t = t.to_array();
    let mut taken = false;
    for lane in Bits(LaneMask::bits(inside)) {
        let lane = lane & (BLOCK - 1);
        // Unused lanes repeat the first.
        if ids[lane] != NONE {
            taken |= walk.state.take::<Q, f32>(i, t[lane], true, ids[lane]);
        }
    }
    taken
}

macro_rules! leaves {
    (unbounded { $($unbounded:tt)* } bounded { $(($field:ident: $Storage:ident, $($rest:tt)*))* }) => {
        $(leaf!($field $Storage);)*

        /// Shows the block that a child is to a visitor; whether any hit was taken.
        #[inline(always)]
        pub fn block<Q: Query, V: Visitor>(walk: &mut Walk, child: Child, visitor: &V) -> bool {
            let (scene, blocks, i) = (walk.scene, &walk.bvh.blocks, child.index());
            match child.kind() {
                $(Kind::$Storage => visit!($field Q, V, walk, &scene.$field, &blocks.$field, i, visitor),)*
                Kind::Node | Kind::Nothing => false,
            }
        }
    };
}

/// Triangles are tested in a way of their own ([`super::triangles`]).
macro_rules! leaf {
    (triangles $Storage:ident) => {};
    ($field:ident $Storage:ident) => {
        impl Leaf for $Storage {}
    };
}

/// The kinds that most scenes have are compiled in place.
macro_rules! visit {
    (spheres $($rest:tt)*) => { visit!(@here $($rest)*) };
    (triangles $($rest:tt)*) => { visit!(@here $($rest)*) };
    (@here $Q:ident, $V:ident, $walk:expr, $kind:expr, $list:expr, $i:expr, $visitor:expr) => {
        $visitor.visit::<$Q, _>($walk, $kind, &$list.blocks[$i], $Q::variant($list.variant($i)))
    };
    ($field:ident $Q:ident, $V:ident, $walk:expr, $kind:expr, $list:expr, $i:expr, $visitor:expr) => {
        apart::<$Q, _, $V>($walk, $kind, $list, $i, $visitor)
    };
}

#[inline(never)]
fn apart<Q: Query, K: Leaf, V: Visitor>(walk: &mut Walk, kind: &K, list: &BlockList<K>, i: usize, visitor: &V) -> bool {
    visitor.visit::<Q, K>(walk, kind, &list.blocks[i], Q::variant(list.variant(i)))
}

for_each_kind!(leaves);
