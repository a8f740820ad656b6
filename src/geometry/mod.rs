//! TODO.
/// Axes.
pub fn frame(_n: glam::Vec3) -> [glam::Vec3; 2] {
    todo!()
}
