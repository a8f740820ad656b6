//! The values of a scene file, and faults in them.

use glam::Vec3;

pub(in crate::scene) use crate::scene::read::strict::Exactly;

/// A key of an element, and the problem with it.
pub(crate) struct Fault(pub &'static str, pub String);

/// A vector or colour.
pub(crate) type Triple = Exactly<f32, 3>;

impl From<Triple> for Vec3 {
    fn from(triple: Triple) -> Self {
        triple.0.into()
    }
}

impl From<Vec3> for Triple {
    fn from(v: Vec3) -> Self {
        Exactly(v.into())
    }
}
