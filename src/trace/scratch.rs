//! Room to work in, kept from batch to batch; one a thread.

use super::candidates::{AnyOrigin, CommonOrigin, Lists};
use super::tree::State;

/// Memory that both queries need beside the scene and the rays. Its contents matter only while a batch is traced.
#[derive(Default)]
pub struct Scratch {
    /// For batches whose rays share their origin.
    pub(super) common: Lists<CommonOrigin>,
    /// For those whose rays do not.
    pub(super) any: Lists<AnyOrigin>,
    tree: Option<Box<State>>,
}

/// A copy starts out empty.
impl Clone for Scratch {
    fn clone(&self) -> Self {
        Self::default()
    }
}

impl std::fmt::Debug for Scratch {
    fn fmt(&self, f: &mut std::fmt::Formatter) -> std::fmt::Result {
        f.debug_struct("Scratch").finish_non_exhaustive()
    }
}

impl Scratch {
    /// Memory for the way through a tree.
    #[inline(always)]
    pub(super) fn tree(&mut self) -> &mut State {
        self.tree.get_or_insert_with(room)
    }
}

/// Apart, as the state lies on the stack while it is made: a frame of that size costs every call of who has it.
#[cold]
#[inline(never)]
fn room() -> Box<State> {
    Box::default()
}
