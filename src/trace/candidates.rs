//! The primitives that a batch of rays may meet, gathered into records that lie one after another.

use super::bounds::Bounds;
use crate::geometry::*;
use crate::kinds::for_each_kind;
use crate::math::{Lanes, Vec3};
use crate::scene::Scene;
use crate::trace::query::Query;

/// The form in which a candidate is kept until the packets come.
pub trait Form {
    /// A primitive's record for a test.
    type Of<K: Primitives, T: Test<K>>: Copy;
    /// Primitive `i` of a kind, for rays from `origin`, if they have one.
    fn record<K: Primitives, T: Test<K>>(test: T, kind: &K, i: usize, origin: Vec3<f32>) -> Self::Of<K, T>;
    /// As seen from a packet's origins.
    fn seen<K: Primitives, T: Test<K>, L: Lanes>(
        test: T,
        record: &Self::Of<K, T>,
        variant: K::Variant,
        origin: Vec3<L>,
    ) -> T::Seen<L>;
}

/// For rays that share their origin: its terms are done.
#[derive(Clone, Copy, Debug)]
pub struct CommonOrigin;

impl Form for CommonOrigin {
    type Of<K: Primitives, T: Test<K>> = T::Seen<f32>;
    #[inline(always)]
    fn record<K: Primitives, T: Test<K>>(test: T, kind: &K, i: usize, origin: Vec3<f32>) -> T::Seen<f32> {
        test.seen(&kind.shape(i), kind.variant(i), origin)
    }
    #[inline(always)]
    fn seen<K: Primitives, T: Test<K>, L: Lanes>(_: T, seen: &T::Seen<f32>, _: K::Variant, _: Vec3<L>) -> T::Seen<L> {
        T::splat_seen(seen)
    }
}

/// For rays that do not: as stored.
#[derive(Clone, Copy, Debug)]
pub struct AnyOrigin;

impl Form for AnyOrigin {
    type Of<K: Primitives, T: Test<K>> = K::Shape<f32>;
    #[inline(always)]
    fn record<K: Primitives, T: Test<K>>(_: T, kind: &K, i: usize, _: Vec3<f32>) -> K::Shape<f32> {
        kind.shape(i)
    }
    #[inline(always)]
    fn seen<K: Primitives, T: Test<K>, L: Lanes>(
        test: T,
        shape: &K::Shape<f32>,
        variant: K::Variant,
        origin: Vec3<L>,
    ) -> T::Seen<L> {
        test.seen(&K::splat(shape), variant, origin)
    }
}

/// A candidate: its record, its variant, and its id.
pub type Candidate<F, K, T> = (<F as Form>::Of<K, T>, <K as Primitives>::Variant, u32);

/// Candidates of one kind, in rising order of their ids.
pub struct List<F: Form, K: Primitives> {
    /// For the default method.
    pub standard: Vec<Candidate<F, K, Standard>>,
    /// For the method that was asked for instead.
    pub named: Vec<Candidate<F, K, K::Named>>,
}

impl<F: Form, K: Primitives> Default for List<F, K> {
    fn default() -> Self {
        Self { standard: Vec::new(), named: Vec::new() }
    }
}

impl<F: Form, K: Primitives> List<F, K> {
    /// Gathers what of a kind, whose first primitive has the id `first`, a batch with these bounds may meet.
    #[inline(always)]
    fn fill<Q: Query, L: Lanes>(&mut self, kind: &K, first: u32, bounds: &Bounds) {
        self.standard.clear();
        if let Some(test) = kind.named() {
            return self.fill_named::<Q, L>(test, kind, first, bounds);
        }
        let origin = bounds.origin.middle;
        met::<K, L>(
            kind,
            bounds,
            #[inline(always)]
            |i| {
                let record = F::record(Standard, kind, i, origin);
                self.standard.push((record, Q::variant(kind.variant(i)), first + i as u32));
            },
        );
    }

    #[inline(never)]
    fn fill_named<Q: Query, L: Lanes>(&mut self, test: K::Named, kind: &K, first: u32, bounds: &Bounds) {
        self.named.clear();
        let origin = bounds.origin.middle;
        met::<K, L>(
            kind,
            bounds,
            #[inline(always)]
            |i| {
                let record = F::record(test, kind, i, origin);
                self.named.push((record, Q::variant(kind.variant(i)), first + i as u32));
            },
        );
    }

    fn is_empty(&self) -> bool {
        self.standard.is_empty() && self.named.is_empty()
    }
}

/// Shows all primitives of a kind that a batch may meet, in order.
#[inline(always)]
fn met<K: Primitives, L: Lanes>(kind: &K, bounds: &Bounds, mut show: impl FnMut(usize)) {
    match kind.cull() {
        Cull::Planes(planes) => {
            for i in 0..planes.len() {
                if !bounds.miss_plane(planes, i) {
                    show(i);
                }
            }
        }
        Cull::Triangles(all) => {
            for i in 0..all.len() {
                if !bounds.miss_triangle(all, i) {
                    show(i);
                }
            }
        }
        Cull::Balls(balls) => bounds.balls_met::<L>(balls, &mut show),
    }
}

macro_rules! lists {
    (
        unbounded { ($planes:ident: $Planes:ident, $($_p:tt)*) }
        bounded {
            ($spheres:ident: $Spheres:ident, $($_s:tt)*)
            ($triangles:ident: $Triangles:ident, $($_t:tt)*)
            $(($field:ident: $Storage:ident, $($_f:tt)*))*
        }
    ) => {
        /// Candidates by kind; ids rise from kind to kind.
        pub struct Lists<F: Form> {
            pub $planes: List<F, $Planes>,
            pub $spheres: List<F, $Spheres>,
            pub $triangles: List<F, $Triangles>,
            $(pub $field: List<F, $Storage>,)*
            /// Whether there are any of those after the triangles.
            pub more: bool,
        }

        impl<F: Form> Default for Lists<F> {
            fn default() -> Self {
                Self {
                    $planes: List::default(),
                    $spheres: List::default(),
                    $triangles: List::default(),
                    $($field: List::default(),)*
                    more: false,
                }
            }
        }

        impl<F: Form> Lists<F> {
            /// Gathers what the batch with these bounds may meet.
            #[inline(always)]
            pub fn fill<Q: Query, L: Lanes>(&mut self, scene: &Scene, bounds: &Bounds) {
                self.$planes.fill::<Q, L>(&scene.$planes, scene.first.$planes, bounds);
                self.$spheres.fill::<Q, L>(&scene.$spheres, scene.first.$spheres, bounds);
                self.$triangles.fill::<Q, L>(&scene.$triangles, scene.first.$triangles, bounds);
                self.more = scene.plan.rare && self.fill_more::<Q, L>(scene, bounds);
            }

            /// Whether there are any.
            #[inline(never)]
            fn fill_more<Q: Query, L: Lanes>(&mut self, scene: &Scene, bounds: &Bounds) -> bool {
                $(self.$field.fill::<Q, L>(&scene.$field, scene.first.$field, bounds);)*
                false $(|| !self.$field.is_empty())*
            }
        }
    };
}
for_each_kind!(lists);
