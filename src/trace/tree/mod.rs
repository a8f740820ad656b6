//! The two queries by way of the [`Bvh`](crate::bvh::Bvh): rays that run together descend as a group behind a beam that holds them all,
//! others as packets whose rays have each its own interval, and one at a time where few of a packet are left.
//!
//! A batch stays whole while its rays lie no farther apart, where they start and at the far side of the scene, than the
//! tree's blocks are large; else it is cut into as many parts as bring it there, and what is down to [`batch::GROUP`] rays and still
//! much wider becomes a packet. So a group meets few boxes that some of its rays miss. (Large packets by one bound for
//! all: Boulos, Wald, Benthin 2006; single rays against eight boxes: Wald, Benthin, Boulos, *Getting Rid of Packets*, 2008;
//! both: Benthin, Wald, Woop, Ernst, Mark, *Combining Single and Packet-Ray Tracing*, 2012.)
//!
//! Every box and beam on the way down is wider than anything the primitives' tests can find ([`beam`]), and of equal
//! distances the lowest id is kept: so the answers for rays of finite numbers are those of testing everything, to the bit,
//! whatever the tree, the groups and the order. A ray from beyond 2⁶⁸ hits nothing ([`state`]).

mod batch;
mod beam;
mod group;
mod leaf;
mod line;
mod packet;
mod single;
mod stack;
mod state;
mod triangles;
mod walk;

pub use batch::trace;
pub use state::State;
