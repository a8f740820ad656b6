//! What sixteen rays find at a node.

/// Where each ray enters each child, and which meet it.
#[derive(Clone, Debug, Default)]
pub struct Entries {
    /// Per child.
    pub enter: [Enter; 8],
    /// Per child, the rays as bits.
    pub met: [u32; 8],
}

/// Where each of sixteen rays enters a box.
#[derive(Clone, Copy, Debug, Default)]
#[repr(align(64))]
pub struct Enter(pub [f32; 16]);
