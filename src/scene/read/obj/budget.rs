//! The most that the mesh files of a scene may take together.

/// The most that is read from all mesh and material files of a scene together.
///
/// Reading a mesh as programs write them takes 0.5 to 0.6 bytes of memory a byte of the file (measured with height
/// fields of 100 MB, with and without normals). The most is taken by faces whose corners are all vertices of their own,
/// or that need a normal beside faces that bring theirs: about 150 bytes a triangle, of which all mesh files have at
/// most 2²⁵ together.
pub const MAX_OBJ_BYTES: u64 = 1 << 30;

/// The most triangles of all mesh files together. A polygon may make one of every two bytes.
pub(super) const MAX_TRIANGLES: usize = 1 << 25;

/// The bytes and triangles that the mesh files of a scene may still take.
pub(in crate::scene::read) struct Budget {
    pub(super) bytes: u64,
    pub(super) triangles: usize,
}

impl Default for Budget {
    fn default() -> Self {
        Self { bytes: MAX_OBJ_BYTES, triangles: MAX_TRIANGLES }
    }
}
