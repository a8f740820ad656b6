//! The data that a traversal works on.

use super::state::State;
use crate::bvh::{Bvh, Places};
use crate::math::RayBatch;
use crate::scene::Scene;
use crate::trace::prefetch::Prefetch;

/// A batch on its way through the tree. The traversals are generic over the query `Q`; `MIXED` says that a beam or
/// packet has an axis with both directions.
pub struct Walk<'a> {
    pub scene: &'a Scene,
    pub bvh: &'a Bvh,
    pub places: Places<'a>,
    pub rays: &'a RayBatch,
    pub prefetch: Prefetch<'a>,
    pub state: &'a mut State,
}
