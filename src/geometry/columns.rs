//! Vectors in three columns, one a component.

use glam::Vec3;

/// Vector `i`.
#[inline(always)]
pub(super) fn at(columns: &[Vec<f32>; 3], i: usize) -> Vec3 {
    Vec3::new(columns[0][i], columns[1][i], columns[2][i])
}

/// Adds a vector.
pub(super) fn push(columns: &mut [Vec<f32>; 3], v: Vec3) {
    columns.iter_mut().zip(v.to_array()).for_each(|(column, value)| column.push(value));
}
