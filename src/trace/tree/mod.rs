//! The two queries by way of the [`Bvh`](crate::bvh::Bvh): rays that run together descend in groups behind beams that hold them,
//! others as packets whose rays have each its own interval, and one at a time where few of a packet are left.
//!
//! A batch is sixteen groups of sixteen rays, with a beam around each. The groups descend together: a child is tested
//! against the beam around all of them first, then against all sixteen at once ([`beams`]), and a group goes on only
//! where its own beam meets the box. So a box costs two tests for the whole batch, and a primitive only the packets that
//! come near it; of triangles seen from one point, their edges tell which packets pass by or through ([`edges`]). A group
//! whose rays lie too far apart for a beam becomes a packet; single rays are what is left of those.
//! (One bound for many rays: Boulos, Wald, Benthin 2006; single rays against eight boxes: Wald, Benthin, Boulos, *Getting
//! Rid of Packets*, 2008; packets that end as single rays: Benthin, Wald, Woop, Ernst, Mark, *Combining Single and
//! Packet-Ray Tracing*, 2012.)
//!
//! On the way down a processor loses most of its time by guessing wrong: whether a box is met, or a triangle covers any
//! ray, is as good as random. So tests that do not hang on each other are all made first, their answers noted as bits
//! without a branch, and one loop goes through what was found ([`packet`], [`covered`]).
//!
//! Every box and beam on the way down is wider than anything the primitives' tests can find ([`beam`]), and of equal
//! distances the lowest id is kept: so the answers for rays of finite numbers are those of testing everything, to the bit,
//! whatever the tree, the groups and the order. A ray from beyond 2⁶⁸ hits nothing ([`state`]).

mod alone;
mod batch;
mod beam;
mod beams;
mod behind;
mod bits;
mod boxes;
mod covered;
mod edges;
mod entries;
mod group;
mod leaf;
mod line;
#[cfg(test)]
mod margin_tests;
mod packet;
mod single;
mod stack;
mod state;
#[cfg(test)]
mod tests;
mod triangles;
mod walk;

pub use batch::trace;
pub use state::State;
